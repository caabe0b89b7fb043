//! The constants of a robot of which the motion of its body depends, and how well they are known.

use crate::drive::Drive;
use crate::kinematics::{Geometry, Kinematics};
use crate::motion::Laws;
use crate::settings::SETTINGS;
use crate::wheel::WheeledRobot;

/// What a constant is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Logarithm of the factor on the radius of a measured wheel.
    Radius(usize),
    /// Angle of a measured wheel with rollers to its stated direction, rad.
    Direction(usize),
    /// Logarithm of the factor on distances across the robot.
    Across,
    /// Logarithm of the factor on distances along the robot.
    Along,
    /// Logarithm of the factor on the distance of all wheels from the centre.
    Reach,
    /// Added to the steering angle, rad.
    SteeringOffset,
    /// Logarithm of the factor on the steering angle.
    SteeringGain,
    /// Direction of the pose's x axis in the robot, rad.
    Mounting,
    /// Place of the pose's origin in the robot, x, m.
    OriginX,
    /// The same, y.
    OriginY,
    /// Share of sideways motion that rollers lose.
    RollerSlip,
    /// Share of the way that is lost in turns.
    TurnSlip,
    /// Logarithm of the factor on the turning rate at which slip in turns has half its size.
    TurnSlipRate,
    /// Logarithm of the power with which slip in turns grows in slow turns.
    TurnSlipPower,
    /// Share of turning that is lost, per turning rate, s/rad.
    RateSlip,
    /// Share of the way that is lost in straight driving, per speed, s/m.
    SpeedSlip,
    /// Share of turning that is lost, per speed of the body, s/m.
    SpeedTurnSlip,
    /// What of the slip that grows with speed each wheel has by its own speed, s/m.
    WheelSpeedSlip,
    /// Sideways slip velocity per sideways acceleration, s.
    Sideslip,
    /// Turning lost per sideways acceleration of forward motion, rad s/m.
    CorneringForward,
    /// The same of sideways motion.
    CorneringSideways,
    /// By how much the clock of the counts is behind that of the pose, s.
    ClockOffset,
    /// By which share the clock of the counts is slow.
    ClockRate(ClockZero),
    /// Logarithm of the factor by which a gyro shows turning.
    GyroScale,
    /// Turning that a gyro shows at rest, rad/s.
    GyroBias,
}

/// What the drives of a case measure of the body's motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Measured {
    /// A pose, in some drive.
    pub pose: bool,
    /// The heading by a gyro alone, in some drive.
    pub heading: bool,
}

impl Measured {
    /// A pose in every drive.
    pub const POSE: Self = Self { pose: true, heading: false };
    /// A pose in some drives and a heading alone in others.
    pub const BOTH: Self = Self { pose: true, heading: true };

    /// What these drives measure.
    pub fn by<'a>(drives: impl Iterator<Item = &'a Drive>) -> Self {
        drives.fold(Self { pose: false, heading: false }, |found, drive| Self {
            pose: found.pose || !drive.heading_only,
            heading: found.heading || drive.heading_only,
        })
    }
}

/// At which instant of a drive clocks are apart by their offset alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ClockZero {
    /// The first row: logs that were started together agree there, so that drives of any length have one offset.
    Start,
    /// The middle: logs that were matched at both ends by hand are best known there.
    Middle,
}

impl Quantity {
    /// What it multiplies, where it is kept as the logarithm of a factor.
    pub(crate) fn multiplied(self, robot: &WheeledRobot) -> Option<f64> {
        let places = |axis: usize| robot.wheels.iter().map(move |w| w.place[axis]);
        let extent = |axis: usize| places(axis).fold(f64::MIN, f64::max) - places(axis).fold(f64::MAX, f64::min);
        match self {
            Self::Radius(wheel) => Some(robot.wheels[robot.measured()[wheel]].radius),
            Self::Across => Some(extent(1)),
            Self::Along => Some(extent(0)),
            Self::Reach => inference::robust::mean(robot.wheels.iter().map(|w| w.place[0].hypot(w.place[1]))),
            Self::SteeringGain | Self::TurnSlipPower | Self::GyroScale => Some(1.0),
            Self::TurnSlipRate => Some(SETTINGS.slip.turning),
            _ => None,
        }
    }
}

/// A constant, how well it is known, and by how much sessions differ.
#[derive(Debug, Clone, PartialEq)]
pub struct Constant {
    /// What it is.
    pub quantity: Quantity,
    /// Its name in answers.
    pub name: String,
    /// Unit in which it is told; sigmas of what is kept as the logarithm of a factor are relative.
    pub unit: &'static str,
    /// One sigma of what is known before any drive.
    pub sigma: f64,
    /// One sigma of the value that it has as a cause.
    pub usual: f64,
    /// One sigma by which sessions differ.
    pub scatter: f64,
}

/// The constants that can show in a robot's drives in which this is measured.
pub fn constants(robot: &WheeledRobot, measured: Measured) -> Vec<Constant> {
    let (known, usual, scatter) = (SETTINGS.known, SETTINGS.usual, SETTINGS.scatter);
    let sigmas = robot.sigmas;
    let mut out = Vec::new();
    let mut add = |quantity, name: &str, unit, sigma: f64, usual: f64, scatter: f64| {
        out.push(Constant { quantity, name: name.to_owned(), unit, sigma, usual, scatter });
    };

    for (k, &wheel) in robot.measured().iter().enumerate() {
        let name = format!("radius of {}", robot.wheels[wheel].name);
        let sigma = sigmas.radius.unwrap_or(known.radius);
        add(Quantity::Radius(k), &name, "m", sigma, usual.radius, scatter.radius);
    }
    // A wheel without rollers slides whichever way it points: the others roll the robot on.
    for (k, &wheel) in robot.measured().iter().enumerate().filter(|(_, wheel)| robot.wheels[**wheel].roller != 0.0) {
        let name = format!("direction of {}", robot.wheels[wheel].name);
        add(Quantity::Direction(k), &name, "rad", known.direction, usual.direction, scatter.direction);
    }
    let across = sigmas.across.unwrap_or(known.distance);
    let along = sigmas.along.unwrap_or(known.distance);
    if robot.is_omni() {
        let sigma = across.min(along);
        add(Quantity::Reach, "distance from centre to wheels", "m", sigma, usual.distance, scatter.distance);
    } else {
        add(Quantity::Across, "track", "m", across, usual.distance, scatter.distance);
        add(Quantity::Along, "wheelbase", "m", along, usual.distance, scatter.distance);
    }
    if robot.is_steered() {
        let sigma = sigmas.steering.unwrap_or(known.steering);
        add(Quantity::SteeringOffset, "steering zero", "rad", sigma, usual.steering, scatter.steering);
        let sigma = sigmas.steering_gain.unwrap_or(known.steering_gain);
        add(Quantity::SteeringGain, "steering gain", "1", sigma, usual.steering_gain, scatter.steering);
    }

    let mounting = sigmas.mounting.unwrap_or(known.mounting);
    let origin = sigmas.origin.unwrap_or(known.origin);
    add(Quantity::Mounting, "direction of the pose's frame", "rad", mounting, usual.mounting, scatter.mounting);
    add(Quantity::OriginX, "place of the pose's origin, x", "m", origin, usual.origin, scatter.origin);
    add(Quantity::OriginY, "place of the pose's origin, y", "m", origin, usual.origin, scatter.origin);
    if robot.has_rollers() {
        add(Quantity::RollerSlip, "slip of the rollers sideways", "1", known.slip, usual.slip, scatter.slip);
    }
    add(Quantity::TurnSlip, "slip in turns", "1", known.slip, usual.slip, scatter.slip);
    let name = "turning rate of half the slip in turns";
    add(Quantity::TurnSlipRate, name, "rad/s", known.slip_shape, usual.slip_rate, scatter.slip_shape);
    let name = "power of the slip in slow turns";
    add(Quantity::TurnSlipPower, name, "1", known.slip_shape, usual.slip_power, scatter.slip_shape);
    add(Quantity::RateSlip, "slip growing with turning", "s/rad", known.growing, usual.turning, scatter.growing);
    add(Quantity::SpeedSlip, "slip growing with speed", "s/m", known.growing, usual.speed, scatter.growing);
    let of_speed = [
        (Quantity::SpeedTurnSlip, "turning lost at speed"),
        (Quantity::WheelSpeedSlip, "slip by each wheel's own speed"),
    ];
    for (quantity, name) in of_speed {
        add(quantity, name, "s/m", known.growing, usual.speed, scatter.growing);
    }
    let cornering = [
        (Quantity::Sideslip, "sideways slip in curves", "s"),
        (Quantity::CorneringForward, "turning lost in curves", "rad s/m"),
        (Quantity::CorneringSideways, "turning lost in sideways curves", "rad s/m"),
    ];
    let sideways = if robot.has_rollers() { 3 } else { 2 };
    for (quantity, name, unit) in cornering.into_iter().take(sideways) {
        add(quantity, name, unit, known.growing, usual.cornering, scatter.growing);
    }
    add(Quantity::ClockOffset, "offset of the clocks", "s", known.offset, usual.offset, scatter.offset);
    add(Quantity::ClockRate(ClockZero::Middle), "rate of the clocks", "1", known.rate, usual.rate, scatter.rate);

    if measured.heading {
        add(Quantity::GyroScale, "scale of the gyro", "1", known.gyro_scale, usual.gyro_scale, scatter.gyro_scale);
        add(Quantity::GyroBias, "bias of the gyro", "rad/s", known.gyro_bias, usual.gyro_bias, scatter.gyro_bias);
    }

    out.retain(|constant| acts(robot, constant.quantity) && (measured.pose || turns(constant.quantity)));
    out
}

/// Whether a constant changes how the body turns, and not only where it goes.
fn turns(quantity: Quantity) -> bool {
    use Quantity as Q;
    match quantity {
        Q::Mounting
        | Q::OriginX
        | Q::OriginY
        | Q::RollerSlip
        | Q::Sideslip
        | Q::SpeedSlip
        | Q::TurnSlip
        | Q::TurnSlipRate
        | Q::TurnSlipPower => false,
        Q::Radius(_)
        | Q::Direction(_)
        | Q::Across
        | Q::Along
        | Q::Reach
        | Q::SteeringOffset
        | Q::SteeringGain
        | Q::RateSlip
        | Q::SpeedTurnSlip
        | Q::WheelSpeedSlip
        | Q::CorneringForward
        | Q::CorneringSideways
        | Q::ClockOffset
        | Q::ClockRate(_)
        | Q::GyroScale
        | Q::GyroBias => true,
    }
}

/// Whether a constant of the geometry changes any motion of this robot.
fn acts(robot: &WheeledRobot, quantity: Quantity) -> bool {
    if !matches!(quantity, Quantity::Across | Quantity::Along | Quantity::Reach) {
        return true;
    }
    let given = Laws::given(robot);
    let moved = given.with(&[(quantity, 1.0)]);
    let motions = |geometry: &Geometry| -> Vec<[f64; 3]> {
        let kinematics = Kinematics::new(robot, geometry);
        let wheels = geometry.radius.len();
        let turn = |k: usize| (0..wheels).map(|j| f64::from(u8::from(j == k))).collect::<Vec<f64>>();
        let steering = SETTINGS.wheels.steering;
        (0..wheels).flat_map(|k| steering.map(|angle| kinematics.motion(&turn(k), angle))).collect()
    };
    let (before, after) = (motions(&given.geometry), motions(&moved.geometry));
    let differ = |(a, b): (&[f64; 3], &[f64; 3])| a.iter().zip(b).any(|(a, b)| (a - b).abs() > 1e-9 * a.abs());
    before.iter().zip(&after).any(differ)
}
