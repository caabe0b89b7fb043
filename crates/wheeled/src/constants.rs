//! The constants on which motion and reports of a robot depend, and what may be wrong with them.

use catalogue::odometry as odo;
use catalogue::{CauseSpec, wheeled as spec};
use hierarchical_fit::{Cause, Possible, Spread, Valued};

use crate::robot::AnyWheels;
use crate::settings::{SETTINGS, Skidding};

/// What a constant is; numbers are places in the lists of wheels, motors and joints.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(missing_docs, reason = "their names and units stand in the table of constants")]
pub enum Quantity {
    Gain(usize),
    Lag,
    Delay,
    Coulomb(usize),
    Viscous(usize),
    Mass,
    ComX,
    ComY,
    YawInertia,
    Radius(usize),
    Across,
    Along,
    Direction(usize),
    SteeringZero(usize),
    SteeringGain(usize),
    Slip,
    Brush,
    Lateral,
    Rest,
    Drag,
    Grip,
    Rolling,
    RollerDrag,
    CasterRolling,
    CasterPivot,
    SlopeX,
    SlopeY,
    GyroScale,
    GyroBias,
    PoseX,
    PoseY,
    PoseDirection,
    Clock,
}

/// A constant: a deviation `θ` from what is given, as a factor `e^θ` or as a sum.
#[derive(Debug, Clone, PartialEq)]
pub struct Constant {
    /// What it is.
    pub quantity: Quantity,
    /// Its name.
    pub name: String,
    /// Unit of its value.
    pub unit: &'static str,
    /// Its value as stated, or as usual.
    pub given: f64,
    /// Whether the deviation is the logarithm of a factor.
    pub is_factor: bool,
    /// How far it may be from that.
    pub spread: Spread,
    /// The cause that it stands for, and of which part of the robot.
    pub cause: (&'static CauseSpec, Option<String>),
}

impl Valued for Constant {
    fn name(&self) -> &str {
        &self.name
    }

    fn unit(&self) -> &'static str {
        self.unit
    }

    fn is_factor(&self) -> bool {
        self.is_factor
    }

    fn value(&self, deviation: f64) -> f64 {
        if self.is_factor { self.given * deviation.exp() } else { self.given + deviation }
    }

    fn of_another_law(&self, value: f64) -> f64 {
        match self.quantity {
            Quantity::Slip => SETTINGS.told.slip * value.abs(),
            Quantity::Lag | Quantity::Delay => SETTINGS.told.time,
            _ => 0.0,
        }
    }
}

/// What the drives hold beside torques and wheels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Has {
    pub(crate) pose: bool,
    pub(crate) gyro: bool,
}

/// All constants of a robot of which drives hold a pose and a gyro, or not.
#[expect(clippy::too_many_lines, reason = "a table")]
pub fn constants(robot: &AnyWheels, has_pose: bool, has_gyro: bool) -> Vec<Constant> {
    use Quantity as Q;
    let (sigmas, usual, scatter) = (&robot.sigmas, SETTINGS.usual, SETTINGS.scatter);
    let plant = &robot.plant;
    let mut out: Vec<Constant> = Vec::new();
    let mut add = |quantity: Q,
                   (name, of, unit): (&str, Option<&String>, &'static str),
                   (given, is_factor, least): (f64, bool, f64),
                   [sigma, usual, scatter]: [f64; 3],
                   cause: &'static CauseSpec| {
        let far = SETTINGS.fitting.farthest * (usual + sigma);
        // What cannot be below or above some value is not.
        let most = match quantity {
            Q::Brush => 1.0 - given,
            Q::YawInertia => (robot.largest_yaw_inertia() / given).ln(),
            _ => far,
        };
        let bounds = [(-far).max(least - given), far.min(most)];
        let of_part = of.map_or_else(|| name.to_owned(), |part| format!("{name} of {part}"));
        out.push(Constant {
            quantity,
            name: of_part,
            unit,
            given,
            is_factor,
            spread: Spread { sigma, usual, scatter, bounds },
            cause: (cause, of.cloned()),
        });
    };
    let any = f64::NEG_INFINITY;
    let motors: Vec<_> = plant.motors.iter().flatten().zip(&robot.motors).enumerate().collect();
    for &(k, (motor, name)) in &motors {
        let name = Some(name);
        add(
            Q::Gain(k),
            ("factor on the torque", name, "1"),
            (motor.gain, true, any),
            [sigmas.gain, usual.gain, scatter.gain],
            &spec::MOTOR_TORQUE_SCALE,
        );
        add(
            Q::Coulomb(k),
            ("dry friction", name, "N m"),
            (motor.coulomb, false, 0.0),
            [sigmas.coulomb[k], usual.friction * robot.torque_scale(), scatter.friction * robot.torque_scale()],
            &spec::MOTOR_DRY_FRICTION,
        );
        add(
            Q::Viscous(k),
            ("viscous friction", name, "N m s/rad"),
            (motor.viscous, false, 0.0),
            [sigmas.viscous[k], usual.friction * robot.viscous_scale(), scatter.friction * robot.viscous_scale()],
            &spec::MOTOR_VISCOUS_FRICTION,
        );
    }
    let lag = motors.first().map_or(0.0, |(_, (motor, _))| motor.lag);
    let lags = [sigmas.lag, usual.lag, scatter.lag];
    add(Q::Lag, ("time constant of the motors", None, "s"), (lag, false, 0.0), lags, &spec::MOTOR_TORQUE_LAG);
    add(Q::Delay, ("dead time of the motors", None, "s"), (0.0, false, 0.0), lags, &spec::MOTOR_TORQUE_LAG);

    let mass = [sigmas.mass, usual.mass, scatter.geometry];
    add(Q::Mass, ("mass", None, "kg"), (plant.mass, true, any), mass, &spec::BODY_MASS);
    let com = [sigmas.com, usual.com * robot.size(), scatter.geometry];
    let open = skidding(robot);
    let forward = |[sigma, usual, scatter]: [f64; 3]| [sigma.hypot(open.middle * robot.size()), usual, scatter];
    add(Q::ComX, ("centre of mass, forward", None, "m"), (plant.com[0], false, any), forward(com), &spec::BODY_COM);
    add(Q::ComY, ("centre of mass, left", None, "m"), (plant.com[1], false, any), com, &spec::BODY_COM);
    let inertia = [sigmas.yaw_inertia, usual.yaw_inertia, scatter.geometry];
    add(
        Q::YawInertia,
        ("yaw inertia", None, "kg m²"),
        (plant.yaw_inertia, true, any),
        inertia,
        &spec::BODY_YAW_INERTIA,
    );

    let wheels: Vec<_> = plant.wheels.iter().flatten().zip(&robot.wheels).enumerate().collect();
    for &(k, (wheel, name)) in &wheels {
        if wheel.motor.is_some() || robot.measured.contains(&k) {
            let radius = [sigmas.radius[k], usual.radius, scatter.geometry];
            add(
                Q::Radius(k),
                ("radius", Some(name), "m"),
                (wheel.radius, true, any),
                radius,
                &odo::RADIUS_OF_ONE_WHEEL,
            );
        }
        if wheel.joint.is_none() {
            let direction = [sigmas.direction.hypot(open.direction), usual.direction, scatter.direction];
            add(
                Q::Direction(k),
                ("direction", Some(name), "rad"),
                (wheel.direction, false, any),
                direction,
                &spec::WHEEL_DIRECTION,
            );
        }
    }
    let places = [sigmas.place.hypot(open.place), usual.place, scatter.geometry];
    for (axis, quantity, name) in
        [(1, Q::Across, "distances across the robot"), (0, Q::Along, "distances along the robot")]
    {
        if plant.wheels.iter().flatten().any(|w| w.place[axis] != 0.0) {
            add(quantity, (name, None, "1"), (1.0, true, any), places, &odo::WHEEL_DISTANCE);
        }
    }
    for (k, (joint, name)) in plant.joints.iter().flatten().zip(&robot.joints).enumerate() {
        let zero = [sigmas.steering, usual.steering, scatter.direction];
        let gain = [sigmas.steering_gain, usual.steering_gain, scatter.gain];
        add(
            Q::SteeringZero(k),
            ("steering zero", Some(name), "rad"),
            (joint.offset, false, any),
            zero,
            &odo::STEERING_ZERO,
        );
        add(Q::SteeringGain(k), ("steering gain", Some(name), "1"), (joint.gain, true, any), gain, &odo::STEERING_GAIN);
    }

    let ground = &plant.ground;
    let slip = [sigmas.slip, usual.slip, scatter.slip];
    add(
        Q::Slip,
        ("slip at the largest force", None, "1"),
        (ground.slip_at_peak, true, any),
        slip,
        &spec::TYRE_STIFFNESS,
    );
    // Laws of tyres differ, and no robot is wrong for that: as causes they are as wide as what is known of them.
    let law = SETTINGS.tyre;
    let brush = [law.brush_share, law.brush_share, law.brush_scatter];
    add(
        Q::Brush,
        ("share of the brush model in the tyres' law", None, "1"),
        (ground.brush_share, false, 0.0),
        brush,
        &spec::TYRE_STIFFNESS,
    );
    if wheels.iter().any(|(_, (w, _))| w.roller.is_none()) {
        let lateral = [law.lateral_stiffness, law.lateral_stiffness, law.lateral_scatter];
        add(
            Q::Lateral,
            ("cornering stiffness of tyres over their longitudinal stiffness", None, "1"),
            (ground.lateral_stiffness, true, any),
            lateral,
            &spec::TYRE_STIFFNESS,
        );
    }
    let rest = [law.rest_speed, law.rest_speed, scatter.slip];
    add(
        Q::Rest,
        ("speed below which tyres slip as if at it", None, "m/s"),
        (ground.rest_speed, true, any),
        rest,
        &spec::TYRE_STIFFNESS,
    );
    // Of wheels that roll, grip and slip at the largest force are one stiffness.
    if robot.skids() {
        let grip = [sigmas.grip.hypot(open.grip), usual.grip, scatter.grip];
        add(
            Q::Grip,
            ("friction coefficient of the ground", None, "1"),
            (ground.adhesion, true, any),
            grip,
            &spec::GROUND_GRIP,
        );
    }
    let rolling = [sigmas.rolling, usual.rolling, scatter.rolling];
    add(Q::Rolling, ("rolling resistance", None, "1"), (ground.rolling, false, 0.0), rolling, &spec::ROLLING_DRAG);
    let drag = [sigmas.drag, usual.drag * robot.weight(), scatter.drag * robot.weight()];
    add(
        Q::Drag,
        ("drag over the square of the speed", None, "N s²/m²"),
        (plant.drag, false, 0.0),
        drag,
        &spec::BODY_DRAG,
    );
    if wheels.iter().any(|(_, (w, _))| w.roller.is_some()) {
        add(
            Q::RollerDrag,
            ("drag of rollers", None, "1"),
            (ground.roller_drag, false, 0.0),
            rolling,
            &spec::ROLLER_DRAG,
        );
    }
    if let Some(caster) = plant.casters.iter().flatten().next() {
        let drag = [sigmas.caster_rolling, usual.rolling, scatter.rolling];
        let (given, pivot) = (caster.rolling, caster.pivot_friction);
        add(
            Q::CasterRolling,
            ("rolling resistance of casters", None, "1"),
            (given, false, 0.0),
            drag,
            &spec::CASTER_ROLLING_DRAG,
        );
        let held = SETTINGS.known.pivot * caster.trail * plant.mass * ground.gravity;
        let usual = [held, usual.pivot * caster.trail * plant.mass * ground.gravity, scatter.friction * held];
        add(
            Q::CasterPivot,
            ("friction of a caster's pivot", None, "N m"),
            (pivot, false, 0.0),
            usual,
            &spec::CASTER_PIVOT_FRICTION,
        );
    }
    if has_gyro {
        let (known, bias) = (SETTINGS.known.gyro_scale, SETTINGS.known.gyro_bias);
        let (scale, of_bias) = ([known, usual.gyro_scale, scatter.gain], [bias, usual.gyro_bias, scatter.gyro_bias]);
        add(Q::GyroScale, ("scale of the gyro", None, "1"), (1.0, true, any), scale, &odo::GYRO_SCALE);
        add(Q::GyroBias, ("bias of the gyro", None, "rad/s"), (0.0, false, any), of_bias, &odo::GYRO_BIAS);
    }
    if has_pose {
        let slope = [sigmas.slope, usual.slope, scatter.slope];
        let [x, y] = ground.slope.map(|pull| -pull / ground.gravity);
        add(Q::SlopeX, ("slope along x", None, "rad"), (x, false, any), slope, &spec::GROUND_SLOPE);
        add(Q::SlopeY, ("slope along y", None, "rad"), (y, false, any), slope, &spec::GROUND_SLOPE);
        let origin = [sigmas.pose_origin, usual.pose_origin, scatter.pose_origin];
        let ahead = (robot.point[0], false, any);
        add(Q::PoseX, ("tracked point, forward", None, "m"), ahead, forward(origin), &odo::POSE_ORIGIN);
        add(Q::PoseY, ("tracked point, left", None, "m"), (robot.point[1], false, any), origin, &odo::POSE_ORIGIN);
        let direction = [sigmas.pose_direction, usual.pose_direction, scatter.direction];
        add(
            Q::PoseDirection,
            ("direction of the tracked axes", None, "rad"),
            (robot.point[2], false, any),
            direction,
            &odo::POSE_MOUNTING,
        );
        let clock = [SETTINGS.known.clock, usual.clock, scatter.clock];
        add(
            Q::Clock,
            ("robot's channels come late by", None, "s"),
            (0.0, false, any),
            clock,
            &odo::COUNTS_CLOCK_OFFSET,
        );
    }
    out
}

/// How far the constants of a robot are open because its wheels skid.
fn skidding(robot: &AnyWheels) -> Skidding {
    let none = Skidding { place: 0.0, middle: 0.0, grip: 0.0, direction: 0.0 };
    if robot.skids() { SETTINGS.skidding } else { none }
}

/// The causes that can show: of one part, and of all parts alike.
pub(crate) fn causes(constants: &[Constant], has_references: bool) -> Vec<Cause> {
    let mut out: Vec<Cause> = Vec::new();
    for (k, c) in constants.iter().enumerate() {
        // A constant of which nothing is known, by its owner or by references, cannot be wrong.
        if !has_references && c.spread.sigma >= c.spread.usual {
            continue;
        }
        let (spec, of) = &c.cause;
        let direction = (vec![(k, 1.0)], c.spread.usual);
        let is_alone = constants.iter().filter(|other| other.cause.0 == *spec).count() == 1;
        let of = of.clone().filter(|_| !is_alone);
        if let Some(cause) = out.iter_mut().find(|cause| cause.spec == *spec && cause.of.is_none() && of.is_none()) {
            cause.directions.push(direction);
            continue;
        }
        let most = c.spread.bounds[1];
        let possible = Possible { constant: k, least: f64::NEG_INFINITY, most };
        let possible = (c.quantity == Quantity::YawInertia).then_some(possible);
        out.push(Cause { spec, of, directions: vec![direction], possible });
    }
    let all = [
        (&spec::MOTOR_TORQUE_SCALE, &spec::MOTOR_TORQUE_SCALE),
        (&spec::MOTOR_DRY_FRICTION, &spec::MOTOR_DRY_FRICTION),
        (&spec::MOTOR_VISCOUS_FRICTION, &spec::MOTOR_VISCOUS_FRICTION),
        (&odo::RADIUS_OF_ONE_WHEEL, &odo::RADIUS_OF_ALL_WHEELS),
    ];
    for (one, all) in all {
        let parts: Vec<&Cause> = out.iter().filter(|cause| cause.spec == one && cause.of.is_some()).collect();
        if parts.len() > 1 {
            let together = parts.iter().flat_map(|cause| cause.directions[0].0.iter().copied()).collect();
            let usual = parts[0].directions[0].1;
            out.push(Cause { spec: all, of: None, directions: vec![(together, usual)], possible: None });
        }
    }
    out
}
