//! How well a robot file knows its numbers.

use super::{File, MotorRow};
use crate::robot::{AnyWheels, Sigmas};
use crate::settings::{Known, SETTINGS};

const KNOWN: Known = SETTINGS.known;

pub(super) fn usual_sigmas(wheels: usize) -> Sigmas {
    Sigmas {
        mass: KNOWN.mass,
        com: KNOWN.com,
        yaw_inertia: KNOWN.yaw_inertia,
        radius: vec![KNOWN.radius; wheels],
        place: KNOWN.place,
        direction: KNOWN.direction,
        coulomb: Vec::new(),
        viscous: Vec::new(),
        gain: KNOWN.gain,
        lag: KNOWN.lag,
        steering: KNOWN.steering,
        steering_gain: KNOWN.steering_gain,
        drag: 0.0,
        rolling: KNOWN.rolling,
        caster_rolling: KNOWN.caster_rolling,
        slip: KNOWN.slip,
        grip: KNOWN.grip,
        slope: KNOWN.slope,
        pose_direction: KNOWN.pose_direction,
        pose_origin: KNOWN.pose_origin,
    }
}

/// What the owner states of how well the robot is known, or what is usual.
pub(super) fn sigmas(read: &File, robot: &AnyWheels) -> Result<Sigmas, String> {
    let usual = usual_sigmas(read.wheel.len());
    let above = |name: &str, stated: Option<f64>, unit: f64, usual: f64| match stated {
        Some(sigma) if sigma.is_nan() || sigma <= 0.0 => Err(format!(
            "{name} is {sigma}; it has to be above 0: give one sigma of how well this is known, or leave it out"
        )),
        Some(sigma) => Ok(sigma * unit),
        None => Ok(usual),
    };
    let (known, degree) = (&read.known, 1.0_f64.to_radians());
    let motors = |of: &dyn Fn(&MotorRow) -> Option<f64>, name: &str, scale: f64| {
        read.motor.iter().map(|m| above(name, of(m), 1.0, KNOWN.friction * scale)).collect::<Result<Vec<f64>, String>>()
    };
    Ok(Sigmas {
        mass: above("sigma of mass", read.mass.sigma, 1.0 / read.mass.value, usual.mass)?,
        com: above("centre_of_mass_sigma", read.centre_of_mass_sigma, 1.0, KNOWN.com * robot.size())?,
        yaw_inertia: above(
            "sigma of yaw_inertia",
            read.yaw_inertia.sigma,
            1.0 / read.yaw_inertia.value,
            usual.yaw_inertia,
        )?,
        radius: read
            .wheel
            .iter()
            .map(|w| above("radius_sigma", w.radius_sigma, 1.0 / w.radius, KNOWN.radius))
            .collect::<Result<_, _>>()?,
        place: above("place_share of [known]", known.place_share, 1.0, usual.place)?,
        direction: above("direction_deg of [known]", known.direction_deg, degree, usual.direction)?,
        coulomb: motors(&|m| m.coulomb_sigma, "coulomb_sigma", robot.torque_scale())?,
        viscous: motors(&|m| m.viscous_sigma, "viscous_sigma", robot.viscous_scale())?,
        gain: above("torque_share of [known]", known.torque_share, 1.0, usual.gain)?,
        lag: above("lag of [known]", known.lag, 1.0, usual.lag)?,
        steering: above("steering_deg of [known]", known.steering_deg, degree, usual.steering)?,
        steering_gain: above("steering_share of [known]", known.steering_share, 1.0, usual.steering_gain)?,
        drag: above("sigma of drag", read.drag.as_ref().and_then(|drag| drag.sigma), 1.0, KNOWN.drag * robot.weight())?,
        rolling: above("rolling_resistance of [known]", known.rolling_resistance, 1.0, usual.rolling)?,
        slip: above("slip_share of [known]", known.slip_share, 1.0, usual.slip)?,
        grip: above("adhesion_share of [known]", known.adhesion_share, 1.0, usual.grip)?,
        slope: above("slope_deg of [known]", known.slope_deg, degree, usual.slope)?,
        pose_direction: above("yaw_sigma_deg of [point]", read.point.yaw_sigma_deg, degree, usual.pose_direction)?,
        pose_origin: above("sigma of [point]", read.point.sigma, 1.0, usual.pose_origin)?,
        ..usual
    })
}
