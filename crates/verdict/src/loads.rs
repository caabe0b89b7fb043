//! Loads of steady driving, of speed-driven robots.

use serde::{Deserialize, Serialize};

use crate::{BodyPull, ClockError, FreeRun, GyroBesidePose, Pulsing, SideDrift, Tipped, Unfollowed, Word, WrongSpeed};

/// Loads of a speed-driven case.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Loads {
    /// Each recording's loads over the references'.
    pub ratios: Vec<Ratio>,
    /// Pooled over recordings that agree.
    pub pooled: Vec<Ratio>,
    /// Loads of the references.
    pub references: Vec<Load>,
    /// Answers that recordings do not permit.
    pub withheld: Vec<Withheld>,
    /// When inside a recording the straight load changes.
    pub changes: Changes,
    /// One slope under all driving, by loads and directions of travel; its pull is taken off all other loads.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub slope: Option<GroundSlope>,
    /// A pull along the body; it is taken off all other loads.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pull: Option<BodyPull>,
    /// Sides that take another torque from an instant on.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub side_changes: Vec<SideChange>,
    /// When inside a recording turning begins or ceases to cost another torque.
    pub turning_changes: Vec<TurningChange>,
    /// What a gyro shows of the turning that a pose shows, where both were recorded; turning rates here are those of the pose.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gyro: Option<GyroBesidePose>,
    /// A side whose wheels roll as if they had another radius; `None` where none is clear.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drift: Option<SideDrift>,
    /// Stretches inside recordings on other ground, each a finding of its own; the longest first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub grounds: Vec<OtherGround>,
    /// Whether the loads of the recordings are those of these grounds alone: they cover most of the driving, and the rest is like
    /// the references.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub on_grounds: bool,
    /// Where the recordings show no one value of a load or of the track: which of them agree, and what could be behind each group.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub groups: Vec<RecordingGroup>,
    /// Whether the recordings agree once the cause that is named first is taken off, though they show no one value.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub agree_by_cause: bool,
    /// Turning inferred from the loads, where neither a gyro nor a difference of the speeds is known.
    pub turning: Vec<Turning>,
    /// Wheels that were commanded to turn a body that did not.
    pub standstills: Vec<Standstill>,
    /// Stretches in which the encoder of a side shows another speed than there is; they leave all else.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub wrong_speeds: Vec<WrongSpeed>,
    /// Sides that do not turn as commanded and move the body with them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub unfollowed: Vec<Unfollowed>,
    /// Straight driving whose load pulses.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pulsing: Vec<Pulsing>,
    /// Inertial units that tip; what they show is turned upright for all else.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tipped: Vec<Tipped>,
    /// Forecasts of the recordings' last thirds.
    pub forecasts: Vec<Forecast>,
    /// Clocks that were aligned by the turns.
    pub clocks: Vec<ClockError>,
}

/// What is measured in steady driving.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// Torque of both sides in straight driving `S`, N m.
    StraightLoad,
    /// Scrub couple of a side in arcs `T`, N m: outer torque less half the straight load.
    TurningLoad,
    /// Outer torque in arcs `S/2 + T` where no straight load is known, N m.
    ArcSum,
    /// Mean torque of the sides in a spin `S/2 + T`, N m.
    SpinSum,
    /// Effective track: difference of the tyre speeds over yaw rate, m.
    EffectiveTrack,
    /// Right less left torque over their sum in straight driving.
    Asymmetry,
    /// Right less left torque over their sum in spins, each without its sign.
    SpinAsymmetry,
    /// Right less left speed that would turn the body as it turns in straight driving, over the speed.
    Drift,
}

impl Quantity {
    /// Name for people.
    pub fn name(self) -> &'static str {
        match self {
            Self::StraightLoad => "straight load",
            Self::TurningLoad => "turning load",
            Self::ArcSum => "sum of straight and turning load in arcs",
            Self::SpinSum => "sum of straight and turning load in spins",
            Self::EffectiveTrack => "effective track",
            Self::Asymmetry => "asymmetry of the straight load",
            Self::SpinAsymmetry => "asymmetry of the load in spins",
            Self::Drift => "drift in straight driving",
        }
    }

    /// SI unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::EffectiveTrack => "m",
            Self::Asymmetry | Self::SpinAsymmetry | Self::Drift => "-",
            _ => "N m",
        }
    }

    /// Compared as a difference; all others as a ratio.
    pub fn is_difference(self) -> bool {
        matches!(self, Self::Asymmetry | Self::SpinAsymmetry | Self::Drift)
    }
}

/// A measured load of one recording.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Load {
    /// Name of the recording.
    pub recording: String,
    /// What was measured.
    pub quantity: Quantity,
    /// Value and standard error.
    pub value: f64,
    /// Standard error.
    pub error: f64,
    /// Steady driving behind it, s.
    pub seconds: f64,
    /// Mean speeds at the tyres of the inner and the outer side, the outer one positive, m/s; equal when straight.
    pub speed: [f64; 2],
    /// Share of it in which the right side was the outer one: a drag on one side shows in turns to one side the other way round.
    #[serde(default = "half")]
    pub right_outer: f64,
}

/// Verdicts that do not say it are of turns to both sides.
fn half() -> f64 {
    0.5
}

/// An answer that a recording does not permit, and why.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Withheld {
    /// Name of the recording.
    pub recording: String,
    /// What cannot be determined.
    pub quantity: Quantity,
    /// Why.
    pub reason: String,
}

/// A load over the references'.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Ratio {
    /// Recording, or several joined by a comma when they are pooled.
    pub recording: String,
    /// What is compared.
    pub quantity: Quantity,
    /// Mean speeds at the tyres of the inner and the outer side, m/s.
    pub speed: [f64; 2],
    /// Slowest and fastest of the outer side's speeds that went into it, m/s.
    pub range: [f64; 2],
    /// Value in the unit of the quantity.
    pub value: f64,
    /// Half of its 90 % interval.
    pub half: f64,
    /// Ratio to the references (difference for the asymmetry).
    pub ratio: f64,
    /// 90 % interval of it.
    pub interval: [f64; 2],
    /// Steady driving behind it, s.
    pub seconds: f64,
    /// Ten seconds or more.
    pub firm: bool,
    /// The references were driven at another speed.
    pub other_speed: bool,
}

/// A change of the straight load inside a recording. Times in s on the clock of the loads.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LoadChange {
    /// Name of the recording.
    pub recording: String,
    /// From the first to the last row that shows it.
    pub interval: [f64; 2],
    /// Between these it begins; apart where turns or stops hide it.
    pub onset: [f64; 2],
    /// Between these it ends.
    pub end: [f64; 2],
    /// Straight driving that shows it, s.
    pub seconds: f64,
    /// Straight load over that of the rest; at most this if `bound`. `None` where the slope was seen by the gyro.
    pub ratio: Option<f64>,
    /// Slope that does it, uphill in the direction of travel positive, degrees; at most this if `bound`.
    pub slope: f64,
    /// Half of its 90 % interval, degrees.
    pub slope_half: f64,
    /// The currents sit in their dead band: ratio and slope are upper bounds.
    pub bound: bool,
    /// The slope is an angle against the rest of the recording only, not against the horizon: the ground gives way, and no
    /// accelerometer was recorded.
    #[serde(default)]
    pub relative: bool,
    /// Ids of the effects that may be the cause; one if it is decided.
    pub causes: Vec<Word>,
    /// What decided, or why nothing did.
    pub reason: Word,
}

/// What a recording shows of changes.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Changes {
    /// Changes of the load.
    pub found: Vec<LoadChange>,
    /// Tilts that only a turn of the robot shows: a gyro that drifts shows the same, so that they decide nothing.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tentative: Vec<LoadChange>,
    /// Driving in which no change could have been seen (turns, stops), s.
    pub hidden: Vec<Hidden>,
}

/// A stretch of driving in which no change could have been seen.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Hidden {
    /// Name of the recording.
    pub recording: String,
    /// From, until, s.
    pub interval: [f64; 2],
}

/// Recordings that agree, beside others that do not agree with them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RecordingGroup {
    /// Names of the recordings.
    pub recordings: Vec<String>,
    /// Whether anything differs from the references in one of them.
    pub differs: bool,
    /// Ids of the causes that fit these recordings alone best, the likeliest first; none where no effect of the catalogue does.
    pub causes: Vec<String>,
}

/// A stretch of a recording on other ground: changes of the straight load and of what turning costs that belong together.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct OtherGround {
    /// Name of the recording.
    pub recording: String,
    /// From the first to the last row that shows it, s on the clock of the loads.
    pub interval: [f64; 2],
    /// From the last row before it to the first one after it that show the usual ground, s: it begins and ends somewhere between.
    pub reach: [f64; 2],
    /// Its loads and its effective track over those of the references.
    pub ratios: Vec<Ratio>,
    /// Ids of the causes that fit these loads best, the likeliest first; none where no effect of the catalogue does.
    pub causes: Vec<String>,
}

impl OtherGround {
    /// Whether a stretch of a recording lies on it, in part at least.
    pub fn holds(&self, recording: &str, [from, until]: [f64; 2]) -> bool {
        self.recording == recording && from <= self.interval[1] && until >= self.interval[0]
    }
}

/// A change of what turning costs inside a recording. Times in s on the clock of the loads.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TurningChange {
    /// Name of the recording.
    pub recording: String,
    /// From the first to the last row that shows it.
    pub interval: [f64; 2],
    /// Between these it begins; apart where the robot did not turn.
    pub onset: [f64; 2],
    /// Between these it ends.
    pub end: [f64; 2],
    /// Steady turning that shows it, s.
    pub seconds: f64,
    /// Torque of the outer side (in a spin: mean of both) over the rest's.
    pub ratio: f64,
    /// Half of its 90 % interval.
    pub half: f64,
    /// The one way in which the robot turned there; `None` if it turned both ways.
    #[serde(default)]
    pub one_way: Option<Way>,
    /// Whether it may have begun while the robot stood, and lasts until the recording ends: a load may have been put on or taken off.
    #[serde(default)]
    pub from_rest: bool,
}

/// A side that takes another torque in straight driving from an instant on until the recording ends, while the other one does not.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SideChange {
    /// Name of the recording.
    pub recording: String,
    /// Left or right.
    pub side: Word,
    /// Between these it begins, s; apart where the robot did not drive straight.
    pub onset: [f64; 2],
    /// The last straight driving that shows it, s.
    pub until: f64,
    /// Torque of the side before and after, N m.
    pub torque: [f64; 2],
    /// Half of the 90 % interval of their difference, N m.
    pub half: f64,
    /// What does this.
    pub causes: Vec<Word>,
}

/// Which way a robot turns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Way {
    /// To the left: the right side is the outer one.
    Left,
    /// To the right.
    Right,
    /// On the spot, or with both sides under load: the way is not known.
    Unknown,
}

/// A stretch in which the loads say that the robot turns.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Turning {
    /// Name of the recording.
    pub recording: String,
    /// From, until, s.
    pub interval: [f64; 2],
    /// Which way.
    pub way: Way,
}

/// A slope under all driving, or something else that pulls towards one direction as it does.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct GroundSlope {
    /// Its angle, degrees.
    pub slope: f64,
    /// Half its 90 % interval, degrees.
    pub half: f64,
    /// Least and largest straight load, over that which it is compared with.
    pub ratios: [f64; 2],
    /// Stretches of straight driving that it rests on.
    pub stretches: usize,
    /// Whether an accelerometer shows that the ground is level, so that something else pulls as the slope would.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub is_level: bool,
}

/// A stretch in which the robot was commanded to drive and did not: its body stood, or its wheels did.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Standstill {
    /// Name of the recording.
    pub recording: String,
    /// From, until, s.
    pub interval: [f64; 2],
    /// Yaw rate over what the wheels' speeds and the references' effective track give; `None` where it was driven straight, and
    /// the torque tells that the body pushes against something.
    pub share: Option<f64>,
    /// Speed of the wheels over what is commanded, where something holds them; `None` where they turn.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wheels: Option<f64>,
    /// The side whose wheels are held, where only one is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub side: Option<Word>,
    /// Mean torque of the more loaded side, N m.
    pub load: f64,
    /// Whether that is next to none, so that the motors are switched off.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub is_off: bool,
    /// Torque of a side in straight driving of this recording, median, N m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub straight: Option<f64>,
}

/// Errors of the forecast of a recording's last third, rms.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Forecast {
    /// Name of the recording.
    pub recording: String,
    /// What is forecast, with its unit.
    pub quantity: Word,
    /// From, until, s.
    pub interval: [f64; 2],
    /// With the references' constants.
    pub nominal: f64,
    /// Re-tuned without the effect: the level of the first two thirds.
    pub retuned: f64,
    /// With the law and its constants from the first two thirds.
    pub corrected: f64,
    /// With wrong laws of the same freedom, by the effect that they stand for.
    pub placebos: Vec<(Word, f64)>,
}

impl Forecast {
    /// As one of the diagnosis's free runs.
    pub fn free_run(&self) -> FreeRun {
        FreeRun {
            recording: self.recording.clone(),
            quantity: format!("{}, last third", self.quantity),
            nominal: self.nominal,
            retuned: self.retuned,
            corrected: self.corrected,
            placebo: self.placebos.iter().map(|p| p.1).min_by(f64::total_cmp),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Quantity; 8] = [
        Quantity::StraightLoad,
        Quantity::TurningLoad,
        Quantity::ArcSum,
        Quantity::SpinSum,
        Quantity::EffectiveTrack,
        Quantity::Asymmetry,
        Quantity::SpinAsymmetry,
        Quantity::Drift,
    ];

    #[test]
    fn each_quantity_has_a_name_of_its_own_and_loads_are_torques() {
        assert_eq!(ALL.map(Quantity::unit), ["N m", "N m", "N m", "N m", "m", "-", "-", "-"]);
        for (word, quantity) in [("straight", ALL[0]), ("turning", ALL[1]), ("arcs", ALL[2]), ("spins", ALL[3])] {
            assert!(quantity.name().contains(word) && quantity.name().contains("load"), "{}", quantity.name());
        }
        assert_eq!((ALL[4].name(), ALL[5].name()), ("effective track", "asymmetry of the straight load"));
        let names: std::collections::BTreeSet<_> = ALL.map(Quantity::name).into();
        assert_eq!(names.len(), ALL.len(), "{names:?}");
    }

    /// The asymmetry is a share already and may be zero, so that no ratio can be taken of it.
    #[test]
    fn only_asymmetries_are_compared_as_a_difference() {
        assert_eq!(ALL.map(Quantity::is_difference), [false, false, false, false, false, true, true, true]);
    }
}
