//! What a drawn case is to look like.

use crate::{EffectId, LawKind, Manoeuvre, Outsider, TyreLaw};

/// The size of the robot.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum RobotClass {
    /// About 5 kg.
    Small,
    /// About 20 kg.
    Medium,
    /// 50 to 75 kg, the size of a Husky.
    Large,
}

/// How hard the case is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Setting {
    /// Clear effects, friction steady from run to run.
    Normal,
    /// Effects 0.4 times as large and 2.5 times the spread from run to run.
    Weak,
}

impl Setting {
    /// Its name in the truth.
    pub fn name(self) -> &'static str {
        match self {
            Self::Normal => "normal",
            Self::Weak => "weak",
        }
    }
}

/// Severity of an effect.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Severity {
    /// Just worth knowing.
    Mild,
    /// Clear.
    Medium,
    /// Dominates the mismatch.
    Strong,
}

impl Severity {
    /// All, from mild to strong.
    pub const ALL: [Self; 3] = [Self::Mild, Self::Medium, Self::Strong];

    /// Its number in the truth: 0, 1 or 2.
    pub fn number(self) -> u8 {
        match self {
            Self::Mild => 0,
            Self::Medium => 1,
            Self::Strong => 2,
        }
    }
}

/// What makes an effect local that may be so in more than one way.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Place {
    /// It is met in a disc on the ground.
    Patch,
    /// It sets in at an instant of each recording.
    Time,
}

/// What is hidden in the recordings.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Content {
    /// Nothing.
    Null,
    /// These effects of the vocabulary, three at most.
    Effects(Vec<EffectId>),
    /// One effect of the vocabulary, whichever the seed draws.
    AnySingle,
    /// Two of the vocabulary, whichever the seed draws.
    AnyPair,
    /// Something that is not in the vocabulary.
    Outsider(Outsider),
    /// The same, whichever the seed draws.
    AnyOutsider,
    /// A law of another grammar.
    Law(LawKind),
}

/// Everything about a case that is not drawn.
#[derive(Debug, Clone, PartialEq)]
#[expect(clippy::struct_excessive_bools, reason = "sensors and laws that are there or not")]
pub struct Settings {
    /// What is hidden.
    pub content: Content,
    /// Its severity; drawn if not given.
    pub severity: Option<Severity>,
    /// Normal or weak; drawn if not given.
    pub setting: Option<Setting>,
    /// The tyre law of the true robot; drawn if not given.
    pub law: Option<TyreLaw>,
    /// The size of the robot, unless its mass is given.
    pub class: RobotClass,
    /// Middle of the mass, kg, between 2 and 500; lengths, inertias and friction follow those of the classes.
    pub mass_kg: Option<f64>,
    /// Whether the robot stands on two driven wheels and casters instead of four wheels.
    pub casters: bool,
    /// Rows per second: 50, 100 or 200 (any divisor of 4000 works).
    pub row_rate_hz: f64,
    /// Whether pose samples are there.
    pub pose: bool,
    /// Whether accelerometer samples are there.
    pub accelerometer: bool,
    /// Factor on all sensor noise but quantisation.
    pub noise: f64,
    /// Whether three in a hundred samples of gyro, accelerometer and pose err by five times the noise.
    pub heavy_tails: bool,
    /// Length of reference runs and recordings; held-out runs last 5/6 of it.
    pub duration_s: f64,
    /// Number of reference runs; none is possible.
    pub references: usize,
    /// Number of recordings; three or four if not given.
    pub recordings: Option<usize>,
    /// Number of held-out runs.
    pub heldout: usize,
    /// Factor on the size of effects, beside the setting.
    pub size: f64,
    /// Smallest ratio of the free-run error without the effect to that with it; draws below are
    /// drawn again. Zero admits effects below the noise.
    pub least_excess: f64,
    /// What makes an effect local that may be so in more than one way; drawn if not given.
    pub place: Option<Place>,
    /// Between which shares of a recording an effect sets in that does so.
    pub onset: [f64; 2],
    /// Kinds of drive of the recordings in turn; all kinds mixed if empty. References and held-out runs stay mixed.
    pub drives: Vec<Manoeuvre>,
    /// Factor on the gain of the robot's controller after the references.
    pub controller_gain: f64,
    /// How many sigmas at most each constant of the robot moves after the references: re-tuning explains that.
    pub moved: f64,
    /// Whether laws have other exponents and courses than usual: stiction, drag, drift with time, wheels out of true.
    pub other_laws: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            content: Content::AnySingle,
            severity: None,
            setting: None,
            law: None,
            class: RobotClass::Medium,
            mass_kg: None,
            casters: false,
            row_rate_hz: 100.0,
            pose: true,
            accelerometer: true,
            noise: 1.0,
            heavy_tails: false,
            duration_s: 24.0,
            references: 3,
            recordings: None,
            heldout: 2,
            size: 1.0,
            least_excess: 1.3,
            place: None,
            onset: [0.25, 0.65],
            drives: Vec::new(),
            controller_gain: 1.0,
            moved: 0.0,
            other_laws: false,
        }
    }
}
