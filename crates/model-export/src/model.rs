//! What is exported, and what comes out.

use inference::{DiagnosisError, KnownEffects};
use robot_model::Robot;
use verdict::{Cause, EffectAt};

/// A robot with the effects that are to be part of its simulation.
#[derive(Debug, Clone, Copy)]
pub struct Model<'a> {
    /// Name.
    pub name: &'a str,
    /// Its constants, re-tuned if they are to be.
    pub robot: &'a Robot<f64>,
    /// Effects, at values.
    pub effects: &'a [EffectAt],
    /// The effects that these may be: the catalogue's, and those of one's own.
    pub known: KnownEffects,
    /// The robot before it was re-tuned: comments say what changed.
    pub before: Option<&'a Robot<f64>>,
    /// Causes that the effects come from: comments give their intervals.
    pub causes: &'a [Cause],
}

/// A model as text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Exported {
    /// The model's file.
    pub text: String,
    /// Python that adds what the engine cannot hold, where there is such a thing: MuJoCo only.
    pub residual: Option<String>,
    /// What the engine does not hold, one sentence each.
    pub notes: Vec<String>,
}

/// Why a model could not be exported.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ExportError {
    /// An effect that is not in the catalogue, or a value that it does not have.
    #[error(transparent)]
    Effect(#[from] DiagnosisError),
    /// A robot that cannot be, with its effects.
    #[error("the robot with its effects cannot exist: {0}; correct the values of the effects")]
    Robot(#[from] robot_model::ModelError),
    /// Parts without a name.
    #[error("{given} names for {there} {part}; give one for each")]
    Names {
        /// What they name.
        part: &'static str,
        /// Names.
        given: usize,
        /// Parts.
        there: usize,
    },
    /// Rollers that an engine does not have.
    #[error(
        "wheel {wheel} has rollers that lie askew, and a wheel of MuJoCo has friction along its axle and across it only: export the robot to \
         SDF, which has friction in any direction"
    )]
    Rollers {
        /// Name of the wheel.
        wheel: String,
    },
    /// XML that could not be written.
    #[error("the model could not be written as XML: {0}")]
    Xml(#[from] std::io::Error),
}
