//! What may make wheel motion and pose disagree: directions in the space of the constants.

use crate::constants::{Constant, Quantity};
use crate::wheel::WheeledRobot;
use catalogue::odometry as spec;
use hierarchical_fit::{Cause, Possible};

/// The causes that can show in a robot's drives.
pub(crate) fn causes(robot: &WheeledRobot, constants: &[Constant]) -> Vec<Cause> {
    let mut out: Vec<Cause> = Vec::new();
    let radii: Vec<usize> =
        (0..constants.len()).filter(|&k| matches!(constants[k].quantity, Quantity::Radius(_))).collect();
    let usual = radii.iter().map(|&k| constants[k].usual).fold(f64::INFINITY, f64::min);
    let all = (radii.iter().map(|&k| (k, 1.0)).collect(), usual);
    out.push(Cause { spec: &spec::RADIUS_OF_ALL_WHEELS, of: None, directions: vec![all], possible: None });

    let measured = robot.measured();
    for (k, constant) in constants.iter().enumerate() {
        let spec = match constant.quantity {
            Quantity::Radius(_) if radii.len() < 2 => continue,
            Quantity::Radius(_) => &spec::RADIUS_OF_ONE_WHEEL,
            Quantity::Direction(_) => &spec::DIRECTION_OF_ONE_WHEEL,
            Quantity::Across | Quantity::Along | Quantity::Reach => &spec::WHEEL_DISTANCE,
            Quantity::SteeringOffset => &spec::STEERING_ZERO,
            Quantity::SteeringGain => &spec::STEERING_GAIN,
            Quantity::Mounting => &spec::POSE_MOUNTING,
            Quantity::OriginX | Quantity::OriginY => &spec::POSE_ORIGIN,
            Quantity::RollerSlip => &spec::ROLLER_SLIP,
            Quantity::TurnSlip | Quantity::TurnSlipRate | Quantity::TurnSlipPower => &spec::SLIP_IN_TURNS,
            Quantity::RateSlip => &spec::SLIP_WITH_TURNING,
            Quantity::SpeedSlip | Quantity::SpeedTurnSlip | Quantity::WheelSpeedSlip => &spec::SLIP_WITH_SPEED,
            Quantity::Sideslip | Quantity::CorneringForward | Quantity::CorneringSideways => &spec::CORNERING_SLIP,
            Quantity::ClockOffset => &spec::COUNTS_CLOCK_OFFSET,
            Quantity::ClockRate(_) => &spec::CLOCK_RATE,
            Quantity::GyroScale => &spec::GYRO_SCALE,
            Quantity::GyroBias => &spec::GYRO_BIAS,
        };
        let of = match constant.quantity {
            Quantity::Radius(wheel) | Quantity::Direction(wheel) => Some(robot.wheels[measured[wheel]].name.clone()),
            Quantity::Across | Quantity::Along | Quantity::Reach => Some(constant.name.clone()),
            _ => None,
        };
        let direction = (vec![(k, 1.0)], constant.usual);
        let is_loss = matches!(constant.quantity, Quantity::TurnSlip | Quantity::RollerSlip);
        match out.iter_mut().find(|cause| cause.spec == spec && of.is_none()) {
            Some(cause) => cause.directions.push(direction),
            None => out.push(Cause {
                spec,
                of,
                directions: vec![direction],
                possible: is_loss.then(|| Possible::at_least_zero(k)),
            }),
        }
    }
    // Clocks that run apart agree at some instant, which may be any.
    let offset = constants.iter().position(|c| c.quantity == Quantity::ClockOffset);
    if let Some((cause, k)) = out.iter_mut().find(|cause| cause.spec == &spec::CLOCK_RATE).zip(offset) {
        cause.directions.push((vec![(k, 1.0)], constants[k].usual));
    }
    out
}
