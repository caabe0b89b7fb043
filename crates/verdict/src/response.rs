//! The response of a command-driven robot: command to wheel, wheel to body.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::Word;

/// A fitted constant of the response.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Parameter {
    /// Element that it belongs to.
    pub element: Element,
    /// Its name.
    pub id: Word,
    /// Unit.
    pub unit: Word,
    /// Fitted value.
    pub value: f64,
    /// Half of its 90 % interval, by a sandwich estimate with command steps as clusters, widened by what made-up robots
    /// showed.
    pub half_width: Option<f64>,
    /// What the simulation has; `None` is no limit.
    pub simulated: Option<f64>,
    /// Whether the fit stopped at the end of what is sensible.
    pub at_bound: bool,
}

/// What left-out windows say about an element.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Earned {
    /// The element.
    pub element: Element,
    /// Rise of the left-out loss without it, relative.
    pub rise: f64,
    /// Its standard error over command steps.
    pub standard_error: f64,
    /// Probability that it is there.
    pub probability: f64,
}

/// A physical element: constants that stand or fall together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Element {
    /// Command to wheel: dead time.
    DeadTime,
    /// Gains of the commanded forward speed and turning.
    Gain,
    /// Limit of the commanded turning.
    TurnLimit,
    /// Limit of the commanded forward speed.
    ForwardLimit,
    /// Limit of a wheel's speed and how both sides are scaled at it.
    WheelLimit,
    /// Limits of acceleration.
    Ramp,
    /// Lag of the speed control.
    Lag,
    /// Sides that answer with different gains.
    SideGain,
    /// Wheel to body: rolling radius, or a longitudinal slip that is always there.
    Radius,
    /// Effective track.
    Track,
    /// Distance of the centre of rotation from the pose sensor, forward.
    Offset,
    /// Forward speed lost in turns.
    TurnSlip,
    /// Body that follows its wheels late.
    BodyLag,
    /// Sides that roll with different radii.
    SideRadius,
}

impl Element {
    /// Whether it sits between command and wheel.
    pub const fn is_drive(self) -> bool {
        (self as usize) < (Self::Radius as usize)
    }
}

/// A structure that was tried beside the chosen one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Alternative {
    /// What was changed.
    pub what: String,
    /// Rise of the loss on left-out windows over the chosen structure's, relative.
    pub rise: f64,
    /// Its standard error over command steps.
    pub standard_error: f64,
}

/// How both sides are kept below a wheel's limit.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Scaling {
    /// Each side is cut off on its own.
    EachSide,
    /// Both sides by the same factor: the path keeps its curvature.
    #[default]
    Proportional,
    /// Turning keeps, forward speed gives way.
    TurnFirst,
    /// Forward speed keeps, turning gives way.
    ForwardFirst,
}

/// From the command over the wheels to the body: what a robot file holds under `response`. By default the wheels do
/// what is commanded and the body rolls without slip on the nominal track.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ResponseModel {
    /// How both sides are kept below a wheel's limit.
    pub scaling: Scaling,
    /// Sides are scaled after the acceleration limits, else before.
    pub scaled_after_ramps: bool,
    /// Acceleration limits hold each side, else forward speed and turning.
    pub side_ramps: bool,
    /// The lag is of second order, else of first.
    pub second_order: bool,
    /// Constants that differ from "does what is commanded, rolls without slip", by id ([`crate::Parameter`]).
    pub constants: BTreeMap<String, f64>,
}

impl Scaling {
    /// All of them, the usual one first.
    pub const ALL: [Self; 4] = [Self::Proportional, Self::EachSide, Self::TurnFirst, Self::ForwardFirst];

    /// In words.
    pub const fn words(self) -> &'static str {
        match self {
            Self::EachSide => "each side is cut off on its own",
            Self::Proportional => "both sides are scaled down together, in proportion",
            Self::TurnFirst => "turning is kept and forward speed gives way",
            Self::ForwardFirst => "forward speed is kept and turning gives way",
        }
    }

    /// Forward speed and turning with both sides within `limit`.
    #[must_use]
    // Stands in the innermost loop of other crates, which are optimised more than this one.
    #[inline]
    pub fn hold(self, [v, d]: [f64; 2], limit: f64) -> [f64; 2] {
        let cut = |x: f64, l: f64| x.clamp(-l, l);
        match self {
            Self::EachSide => {
                let (l, r) = (cut(v - d, limit), cut(v + d, limit));
                [0.5 * (l + r), 0.5 * (r - l)]
            }
            Self::Proportional => {
                let k = (limit / (v.abs() + d.abs()).max(1e-9)).min(1.0);
                [v * k, d * k]
            }
            Self::TurnFirst => {
                let d = cut(d, limit);
                [cut(v, limit - d.abs()), d]
            }
            Self::ForwardFirst => {
                let v = cut(v, limit);
                [v, cut(d, limit - v.abs())]
            }
        }
    }
}

/// The response of a command-driven robot.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Response {
    /// Windows of 2 s that were fitted, and command steps that they belong to.
    pub windows: usize,
    /// Command steps: the independent blocks.
    pub steps: usize,
    /// Windows that no fit has seen.
    pub held_out_windows: usize,
    /// How both sides are held below a wheel's limit, where there is one.
    pub scaling: Option<Word>,
    /// Whether the other ways to hold them forecast left-out windows worse.
    pub scaling_is_told: bool,
    /// Whether sides are scaled after the acceleration limits.
    pub scaled_after_ramps: bool,
    /// Fitted constants.
    pub parameters: Vec<Parameter>,
    /// What every element that was tried earned on left-out windows.
    pub elements: Vec<Earned>,
    /// Structures of the drive that were tried.
    pub alternatives: Vec<Alternative>,
    /// Free constants of the corrected simulation and of the placebo.
    pub constants: [usize; 2],
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_from_the_command_to_the_wheel_is_of_the_drive_and_all_after_it_of_the_ground() {
        use Element::{
            BodyLag, DeadTime, ForwardLimit, Gain, Lag, Offset, Radius, Ramp, SideGain, SideRadius, Track, TurnLimit,
            TurnSlip, WheelLimit,
        };
        for element in [DeadTime, Gain, TurnLimit, ForwardLimit, WheelLimit, Ramp, Lag, SideGain] {
            assert!(element.is_drive(), "{element:?}");
        }
        for element in [Radius, Track, Offset, TurnSlip, BodyLag, SideRadius] {
            assert!(!element.is_drive(), "{element:?}");
        }
    }

    /// Sides are forward speed less and plus turning.
    #[test]
    fn every_way_of_scaling_keeps_both_sides_within_the_limit_and_what_its_words_say() {
        // Asked with sides of 2 and 10, 10 and 2, -2 and -10; then a turn that alone is beyond the limit.
        let asked = [[6.0, 4.0], [6.0, -4.0], [-6.0, -4.0], [4.0, 8.0]];
        let held = |way: Scaling| asked.map(|pair| way.hold(pair, 6.0));
        assert_eq!(held(Scaling::EachSide), [[4.0, 2.0], [4.0, -2.0], [-4.0, -2.0], [1.0, 5.0]]);
        assert_eq!(held(Scaling::TurnFirst), [[2.0, 4.0], [2.0, -4.0], [-2.0, -4.0], [0.0, 6.0]]);
        assert_eq!(held(Scaling::ForwardFirst), [[6.0, 0.0], [6.0, 0.0], [-6.0, 0.0], [4.0, 2.0]]);
        for ([v, d], [forward, turn]) in asked.into_iter().zip(held(Scaling::Proportional)) {
            assert!((forward.abs() + turn.abs() - 6.0).abs() < 1e-12, "the faster side drives at the limit");
            assert!((forward * d - turn * v).abs() < 1e-12 && forward * v > 0.0, "the path keeps its curvature");
        }
        for way in Scaling::ALL {
            for pair in [[1.0, 2.0], [-1.0, 3.0], [0.0, 0.0]] {
                assert_eq!(way.hold(pair, 6.0), pair, "{way:?} within the limit");
                assert_eq!(way.hold(pair, f64::INFINITY), pair, "{way:?} without a limit");
            }
        }
    }

    #[test]
    fn each_way_of_scaling_is_told_by_what_it_keeps_and_what_it_gives() {
        assert!(Scaling::EachSide.words().contains("on its own"));
        assert!(Scaling::Proportional.words().contains("in proportion"));
        assert_eq!(Scaling::TurnFirst.words(), "turning is kept and forward speed gives way");
        assert_eq!(Scaling::ForwardFirst.words(), "forward speed is kept and turning gives way");
    }
}
