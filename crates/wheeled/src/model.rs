//! The plant at values of the constants, and runs of it over a drive.

use robot_model::wheels::{MOST, Plant, Robot, State};
use robot_model::{Lanes, Scalar, real};

use crate::constants::{Constant, Quantity};
use crate::drive::{Drive, STEP};
use crate::robot::AnyWheels;
use crate::settings::{Grid, SETTINGS};

const RULES: Grid = SETTINGS.grid;
/// Values of the constants that are run side by side.
pub(crate) const LANES: usize = 8;

/// A number of which each lane may look something up for itself.
pub(crate) trait PerLane: Scalar {
    fn per_lane(self, of: impl Fn(f64) -> f64) -> Self;
}

impl PerLane for f64 {
    #[inline(always)]
    fn per_lane(self, of: impl Fn(f64) -> f64) -> Self {
        of(self)
    }
}

impl PerLane for Lanes<LANES> {
    #[inline(always)]
    fn per_lane(self, of: impl Fn(f64) -> f64) -> Self {
        Self(self.0.map(of))
    }
}

/// A robot at values of its constants.
#[derive(Debug, Clone)]
pub(crate) struct Model<T> {
    pub(crate) plant: Plant<T>,
    /// Dead time of the motors; by how much the robot's channels come late; scale and bias of the gyro.
    delay: T,
    pub(crate) clock: T,
    pub(crate) gyro: [T; 2],
    /// Tracked point and direction of its axes.
    point: [T; 2],
    pub(crate) direction: T,
}

impl<T: PerLane> Model<T> {
    /// At deviations `theta` of these constants.
    pub(crate) fn at(robot: &AnyWheels, constants: &[Constant], theta: &[T]) -> Self {
        use Quantity as Q;
        let mut r: Robot<T> = robot.plant.cast(real);
        let (mut delay, mut clock, mut gyro) = (T::zero(), T::zero(), [T::one(), T::zero()]);
        let mut point = [real(robot.point[0]), real(robot.point[1])];
        let mut direction = real(robot.point[2]);
        let mut factors = [T::one(); 2];
        for (c, deviation) in constants.iter().zip(theta) {
            let given: T = real(c.given);
            let value = if c.is_factor { given * deviation.exp() } else { given + *deviation };
            match c.quantity {
                Q::Gain(k) => r.motors[k].iter_mut().for_each(|m| m.gain = value),
                Q::Coulomb(k) => r.motors[k].iter_mut().for_each(|m| m.coulomb = value),
                Q::Viscous(k) => r.motors[k].iter_mut().for_each(|m| m.viscous = value),
                Q::Lag => r.motors.iter_mut().flatten().for_each(|m| m.lag = value),
                Q::Delay => delay = value,
                Q::Mass => r.mass = value,
                Q::ComX => r.com[0] = value,
                Q::ComY => r.com[1] = value,
                Q::YawInertia => r.yaw_inertia = value,
                Q::Radius(k) => r.wheels[k].iter_mut().for_each(|w| w.radius = value),
                Q::Across => factors[1] = value,
                Q::Along => factors[0] = value,
                Q::Direction(k) => r.wheels[k].iter_mut().for_each(|w| w.direction = value),
                Q::SteeringZero(k) => r.joints[k].iter_mut().for_each(|j| j.offset = value),
                Q::SteeringGain(k) => r.joints[k].iter_mut().for_each(|j| j.gain = value),
                Q::Slip => r.ground.slip_at_peak = value,
                Q::Brush => r.ground.brush_share = value,
                Q::Lateral => r.ground.lateral_stiffness = value,
                Q::Rest => r.ground.rest_speed = value,
                Q::Drag => r.drag = value,
                Q::Grip => r.ground.adhesion = value,
                Q::Rolling => r.ground.rolling = value,
                Q::RollerDrag => r.ground.roller_drag = value,
                Q::CasterRolling => r.casters.iter_mut().flatten().for_each(|c| c.rolling = value),
                Q::CasterPivot => r.casters.iter_mut().flatten().for_each(|c| c.pivot_friction = value),
                Q::SlopeX => r.ground.slope[0] = -(value * r.ground.gravity),
                Q::SlopeY => r.ground.slope[1] = -(value * r.ground.gravity),
                Q::GyroScale => gyro[0] = value,
                Q::GyroBias => gyro[1] = value,
                Q::PoseX => point[0] = value,
                Q::PoseY => point[1] = value,
                Q::PoseDirection => direction = value,
                Q::Clock => clock = value,
            }
        }
        for wheel in r.wheels.iter_mut().flatten() {
            wheel.place = [wheel.place[0] * factors[0], wheel.place[1] * factors[1]];
        }
        for joint in r.joints.iter_mut().flatten() {
            joint.place = [joint.place[0] * factors[0], joint.place[1] * factors[1]];
            joint.about *= factors[0];
        }
        for caster in r.casters.iter_mut().flatten() {
            caster.pivot = [caster.pivot[0] * factors[0], caster.pivot[1] * factors[1]];
        }
        let step = real::<T>(STEP / RULES.substeps as f64);
        Self { plant: Plant::new(&r, step), delay, clock, gyro, point, direction }
    }

    /// Torques and steering angles over a step of the grid.
    #[inline(always)]
    fn inputs(&self, drive: &Drive, step: usize) -> [[T; MOST]; 2] {
        let mut out = [[T::zero(); MOST]; 2];
        let time = STEP * step as f64;
        for (to, torque) in out[0].iter_mut().zip(&drive.torque) {
            *to = (self.clock - self.delay).per_lane(|late| torque.mean(time + late));
        }
        for (to, angle) in out[1].iter_mut().zip(&drive.steering) {
            *to = self.clock.per_lane(|late| angle.mean(time + late));
        }
        out
    }

    /// Motors and joints as what was commanded before a step leaves them.
    fn settled(&self, drive: &Drive, from: usize) -> State<T> {
        let mut s = State::default();
        let first = from.saturating_sub((RULES.warm / STEP).round() as usize);
        let [torque, steering] = self.inputs(drive, first);
        self.plant.settle(&mut s, &torque, &steering);
        for step in first..from {
            let [torque, steering] = self.inputs(drive, step);
            for _ in 0..RULES.substeps {
                self.plant.step_drives(&mut s, &torque, &steering);
            }
        }
        s
    }

    /// Velocity of the robot's origin in its axes, of the pose's rates in the world at this heading.
    pub(crate) fn of_origin(&self, heading: f64, rates: [f64; 3]) -> [T; 2] {
        let (sin, cos) = (real::<T>(heading) - self.direction).sin_cos();
        let ([px, py], w) = (self.point, real::<T>(rates[2]));
        let [vx, vy] = [real::<T>(rates[0]), real::<T>(rates[1])];
        [vx * cos + vy * sin + w * py, vy * cos - vx * sin - w * px]
    }

    /// Turns casters to where what the drive did before leaves them.
    fn turn_casters(s: &mut State<T>, drive: &Drive, at: usize) {
        if let Some(angles) = drive.casters.get(at) {
            s.caster = angles.map(real);
        }
    }

    /// Moves the body as wheels and gyro show it at a step.
    pub(crate) fn roll_by_wheels(&self, drive: &Drive, robot: &AnyWheels, at: usize, s: &mut State<T>) {
        s.steering = self.settled(drive, at).steering;
        let (speeds, gyro) = self.shown(drive, robot, at);
        self.plant.roll_body(s, &speeds, gyro);
    }

    /// The state at a step in which the pose was measured, with its rates in the world, m/s, rad/s.
    pub(crate) fn of_pose(
        &self,
        drive: &Drive,
        robot: &AnyWheels,
        from: usize,
        (pose, rates): ([f64; 3], [f64; 3]),
    ) -> State<T> {
        let mut s = self.settled(drive, from);
        let yaw = real::<T>(pose[2]) - self.direction;
        let (sin, cos) = yaw.sin_cos();
        s.heading = [cos, sin];
        s.yaw_rate = real(rates[2]);
        let [px, py] = self.point;
        s.position = [real::<T>(pose[0]) - cos * px + sin * py, real::<T>(pose[1]) - sin * px - cos * py];
        let mut origin = self.of_origin(pose[2], rates);
        if let Some([ahead, left, of_gyro]) = Self::share_of_wheels(drive, robot, from) {
            // Heavy wheels would else be told, which bring a body that starts at a wrong velocity to theirs.
            let seen = self.seen_by_wheels(drive, robot, (from, s.heading));
            let by_wheels = self.plant.velocity_of(&seen, [T::zero(); 2]);
            for (axis, share) in [ahead, left].into_iter().enumerate() {
                origin[axis] += (by_wheels[axis] - origin[axis]) * real(share);
            }
            s.yaw_rate += (seen.yaw_rate - s.yaw_rate) * real(of_gyro);
        }
        self.plant.set_velocity(&mut s, origin);
        Self::turn_casters(&mut s, drive, from);
        self.plant.roll_wheels(&mut s);
        if drive.is_whole(from.saturating_sub(1), from + 1) {
            self.plant.turn_wheels(&mut s, &self.shown(drive, robot, from).0);
        }
        s
    }

    /// By how much the velocity that wheels show, ahead and to the left, counts beside that of a noisy pose, and the yaw rate that a gyro
    /// shows; `None` where they hardly do, or are not there about the step.
    fn share_of_wheels(drive: &Drive, robot: &AnyWheels, from: usize) -> Option<[f64; 3]> {
        let rolls_any_way = robot.plant.wheels.iter().flatten().all(|wheel| wheel.roller.is_some());
        let determine = robot.measured.len() >= if rolls_any_way { 3 } else { 1 };
        let is_whole = drive.is_whole(from.saturating_sub(RULES.settling), from + 2 * RULES.settling);
        let [ahead, left, of_gyro] = drive.noise.share_of_wheels(rolls_any_way);
        let of_wheels = f64::from(u8::from(determine));
        let shares = [of_wheels * ahead, of_wheels * left, if drive.gyro.is_some() { of_gyro } else { 0.0 }];
        (is_whole && shares.iter().any(|s| *s > RULES.little)).then_some(shares)
    }

    /// The state at a step of a drive without a pose: at the origin, moving so that wheels and gyro show what they do once the
    /// wheels slip as they must under their torques.
    pub(crate) fn of_wheels(&self, drive: &Drive, robot: &AnyWheels, from: usize) -> State<T> {
        self.seen_by_wheels(drive, robot, (from, State::default().heading))
    }

    /// The same of a body that looks this way, which on a slope is another motion.
    fn seen_by_wheels(&self, drive: &Drive, robot: &AnyWheels, (from, heading): (usize, [T; 2])) -> State<T> {
        let mut s = self.settled(drive, from);
        s.heading = heading;
        let (speeds, gyro) = self.shown(drive, robot, from);
        self.plant.roll_body(&mut s, &speeds, gyro);
        self.plant.roll_wheels(&mut s);
        Self::turn_casters(&mut s, drive, from);

        let mut ahead = s;
        self.run(s, drive, from, RULES.settling, |_, after| ahead = *after);
        let (mut speeds, gyro) = self.shown(drive, robot, from + RULES.settling);
        for (speed, simulated) in speeds.iter_mut().zip(ahead.wheel_speed) {
            *speed = speed.map(|shown| shown - simulated);
        }
        let mut missing = State { steering: ahead.steering, ..State::default() };
        self.plant.roll_body(&mut missing, &speeds, gyro.map(|shown| shown - ahead.yaw_rate));
        let origin = |of: &State<T>| self.plant.velocity_of(of, [T::zero(); 2]);
        let ([x, y], [dx, dy]) = (origin(&s), origin(&missing));
        s.yaw_rate += missing.yaw_rate;
        self.plant.set_velocity(&mut s, [x + dx, y + dy]);
        Self::turn_casters(&mut s, drive, from);
        self.plant.roll_wheels(&mut s);
        self.plant.turn_wheels(&mut s, &self.shown(drive, robot, from).0);
        s
    }

    /// Speeds of the measured wheels and yaw rate by the gyro about a step, as they are in truth.
    fn shown(&self, drive: &Drive, robot: &AnyWheels, at: usize) -> ([Option<T>; MOST], Option<T>) {
        let (half, time) = (RULES.speeds, STEP * at as f64);
        let mean = |of: &odometry::held::Command| {
            self.clock.per_lane(|late| (of.sum(time + late + half) - of.sum(time + late - half)) / (2.0 * half))
        };
        let mut speeds = [None; MOST];
        for (k, wheel) in robot.measured.iter().zip(&drive.wheels) {
            speeds[*k] = Some(mean(wheel));
        }
        (speeds, drive.gyro.as_ref().map(|gyro| (mean(gyro) - self.gyro[1]) / self.gyro[0]))
    }

    /// Runs over steps of the grid, and gives the state after each.
    #[inline(always)]
    pub(crate) fn run(
        &self,
        mut s: State<T>,
        drive: &Drive,
        from: usize,
        steps: usize,
        mut visit: impl FnMut(usize, &State<T>),
    ) {
        for k in 0..steps {
            let [torque, steering] = self.inputs(drive, from + k);
            for _ in 0..RULES.substeps {
                self.plant.step(&mut s, &torque, &steering);
            }
            visit(k + 1, &s);
        }
    }

    /// The pose that is measured of a state, its heading as the difference to where the run began.
    pub(crate) fn tracked(&self, s: &State<T>) -> [T; 3] {
        let [x, y] = self.plant.place_of(s, self.point);
        [x, y, s.turned]
    }
}
