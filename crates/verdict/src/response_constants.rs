//! Constants of the response of a command-driven robot: what they are called and where they may lie.

use crate::{ResponseModel, Word};

/// A constant of a response.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ResponseConstant {
    /// Its id.
    pub id: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Value of the simulation "wheels do what is commanded, the body rolls without slip".
    pub neutral: f64,
    /// Least and largest value that is sensible.
    pub bounds: [f64; 2],
    /// Size of a usual change, for steps of a fit.
    pub scale: f64,
}

const fn constant(
    id: &'static str,
    unit: &'static str,
    neutral: f64,
    bounds: [f64; 2],
    scale: f64,
) -> ResponseConstant {
    ResponseConstant { id, unit, neutral, bounds, scale }
}

/// No limit.
const NONE: f64 = f64::INFINITY;

/// Constants between command and wheel.
pub const DRIVE_CONSTANTS: [ResponseConstant; 13] = [
    constant("dead_time", "s", 0.0, [0.0, 1.0], 0.1),
    constant("forward_gain", "-", 1.0, [0.05, 20.0], 0.5),
    constant("turn_gain", "-", 1.0, [0.05, 20.0], 0.5),
    constant("turn_limit", "rad/s", NONE, [0.05, 200.0], 1.0),
    constant("forward_limit", "rad/s", NONE, [0.05, 200.0], 1.0),
    constant("wheel_limit", "rad/s", NONE, [0.05, 200.0], 1.0),
    constant("forward_ramp", "rad/s^2", NONE, [0.05, 2000.0], 1.0),
    constant("turn_ramp", "rad/s^2", NONE, [0.05, 2000.0], 1.0),
    constant("side_ramp", "rad/s^2", NONE, [0.05, 2000.0], 1.0),
    constant("lag", "s", 0.0, [0.0, 3.0], 0.1),
    constant("natural_frequency", "rad/s", NONE, [0.5, 60.0], 2.0),
    constant("damping", "-", 1.0, [0.1, 5.0], 0.3),
    constant("side_gain", "-", 0.0, [-0.5, 0.5], 0.05),
];
/// Constants between wheel and body.
pub const GROUND_CONSTANTS: [ResponseConstant; 7] = [
    ResponseConstant { id: "radius_factor", unit: "-", neutral: 1.0, bounds: [0.2, 3.0], scale: 0.2 },
    ResponseConstant { id: "track_factor", unit: "-", neutral: 1.0, bounds: [0.2, 20.0], scale: 0.2 },
    ResponseConstant { id: "centre_offset", unit: "m", neutral: 0.0, bounds: [-1.0, 1.0], scale: 0.05 },
    ResponseConstant { id: "turn_slip", unit: "s^2/rad^2", neutral: 0.0, bounds: [0.0, 20.0], scale: 0.2 },
    ResponseConstant { id: "body_lag", unit: "s", neutral: 0.0, bounds: [0.0, 2.0], scale: 0.1 },
    ResponseConstant { id: "side_radius", unit: "-", neutral: 0.0, bounds: [-0.3, 0.3], scale: 0.02 },
    ResponseConstant { id: "turn_slip_linear", unit: "s/rad", neutral: 0.0, bounds: [0.0, 20.0], scale: 0.2 },
];

/// A response that cannot be.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ResponseError {
    /// A constant that no response has.
    #[error("response takes a finite number for each of {known}, but '{name}' is none of these")]
    NoSuchConstant {
        /// What was named.
        name: String,
        /// Those that there are.
        known: Word,
    },
    /// A constant beyond what is sensible.
    #[error("`{name}` is {value}, but must lie between {least} and {most}; correct it")]
    OutOfBounds {
        /// The constant.
        name: String,
        /// Its value.
        value: f64,
        /// Least value.
        least: f64,
        /// Largest value.
        most: f64,
    },
}

impl ResponseModel {
    /// Checks every constant.
    ///
    /// # Errors
    /// A constant that no response has, or one beyond what is sensible.
    pub fn checked(&self) -> Result<(), ResponseError> {
        let all = || DRIVE_CONSTANTS.iter().chain(&GROUND_CONSTANTS);
        for (name, &value) in &self.constants {
            let constant = all().find(|c| c.id == name).ok_or_else(|| ResponseError::NoSuchConstant {
                name: name.clone(),
                known: all().map(|c| c.id).collect::<Vec<_>>().join(", ").into(),
            })?;
            let [least, most] = constant.bounds;
            if !(least..=most).contains(&value) {
                return Err(ResponseError::OutOfBounds { name: name.clone(), value, least, most });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn checked(name: &str, value: f64) -> Result<(), ResponseError> {
        ResponseModel { constants: [(name.to_owned(), value)].into(), ..ResponseModel::default() }.checked()
    }

    #[test]
    fn a_difference_of_the_sides_and_an_offset_may_point_either_way() {
        for (name, most) in [("side_gain", 0.5), ("centre_offset", 1.0), ("side_radius", 0.3)] {
            for value in [-most, -0.02, 0.0, 0.02, most] {
                assert_eq!(checked(name, value), Ok(()), "{name} {value}");
            }
            for value in [-1.01 * most, 1.01 * most] {
                assert!(checked(name, value).is_err(), "{name} {value}");
            }
        }
        // What does nothing is sensible, of every constant that can be neutral with a number.
        for constant in DRIVE_CONSTANTS.iter().chain(&GROUND_CONSTANTS).filter(|c| c.neutral.is_finite()) {
            assert_eq!(checked(constant.id, constant.neutral), Ok(()), "{}", constant.id);
        }
    }

    #[test]
    fn a_response_with_a_constant_that_cannot_be_is_refused_with_what_could_be() {
        let text = |refused: Result<(), ResponseError>| refused.expect_err("cannot be").to_string();
        assert_eq!(text(checked("dead_time", -0.1)), "`dead_time` is -0.1, but must lie between 0 and 1; correct it");
        assert_eq!(text(checked("lag", 4.0)), "`lag` is 4, but must lie between 0 and 3; correct it");
        assert!(checked("track_factor", f64::NAN).is_err());
        let unknown = text(checked("dead_tim", 0.1));
        assert!(unknown.ends_with("but 'dead_tim' is none of these"), "{unknown}");
        assert!(unknown.contains("dead_time, forward_gain,") && unknown.contains(", turn_slip_linear,"), "{unknown}");
        assert_eq!(ResponseModel::default().checked(), Ok(()));
    }
}
