//! Why a diagnosis could not be made.

/// Why a diagnosis could not be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DiagnosisError {
    /// A recording lacks a signal without which nothing can be said.
    #[error("recording '{recording}' has no signal {what}; map a column to it")]
    MissingSignal {
        /// Name of the recording.
        recording: String,
        /// The signal.
        what: &'static str,
    },
    /// A recording of a torque-driven robot has currents and no torque.
    #[error(
        "recording '{recording}' has currents and no torque, which a torque-driven robot needs; map the same columns as torque, with N m at the \
         wheels of a side per unit of the current as scale: torque_left = {{ column = \"...\", unit = \"N m\", scale = ... }}"
    )]
    CurrentsForTorque {
        /// Name of the recording.
        recording: String,
    },
    /// A recording is too short.
    #[error(
        "recording '{recording}' has {rows} rows, but at least {needed} are needed; record longer, or, where the file has many more, state \
         the unit of its times in the mapping"
    )]
    TooShort {
        /// Name of the recording.
        recording: String,
        /// Rows there are.
        rows: usize,
        /// Rows needed.
        needed: usize,
    },
    /// A recording has more holes than samples.
    #[error("recording '{recording}' spans {rows} rows with only {samples} samples; split it at its gaps")]
    Gaps {
        /// Name of the recording.
        recording: String,
        /// Rows spanned.
        rows: usize,
        /// Samples there are.
        samples: usize,
    },
    /// Nothing moves.
    #[error("the wheels never turn in recording '{recording}'; record a drive")]
    NoMotion {
        /// Name of the recording.
        recording: String,
    },
    /// A recording holds what no robot of the file can show.
    #[error("recording '{recording}': {what}")]
    Impossible {
        /// Name of the recording.
        recording: String,
        /// The channel, what it shows, what can be, and what to do.
        what: String,
    },
    /// There is nothing to compare with or to diagnose.
    #[error("the case has no {what}; at least one is needed")]
    Empty {
        /// "reference" or "recording".
        what: &'static str,
    },
    /// Too few command steps to leave some out.
    #[error(
        "the {what} hold {steps} command steps, but at least {needed} are needed; record more changes of the command"
    )]
    FewSteps {
        /// "recordings" or "references".
        what: &'static str,
        /// Steps there are.
        steps: usize,
        /// Steps needed.
        needed: usize,
    },
    /// The data do not determine the model.
    #[error(
        "the {stage} could not be solved: the robot moves too little in the recordings to \
             determine the model; record more changes of speed and turning"
    )]
    Singular {
        /// Stage of the diagnosis.
        stage: &'static str,
    },
    /// A recording gives no answer to any question.
    #[error("no recording has enough steady driving to answer: {reason}")]
    TooCalm {
        /// What is missing.
        reason: String,
    },
    /// A correction names a constant that no robot has.
    #[error("no constant '{id}' can be re-tuned; `lacuna diagnose --json` lists those that can, under 'tuning'")]
    NoSuchConstant {
        /// What was named.
        id: String,
    },
    /// A correction names an effect that is not known.
    #[error("there is no effect '{id}'; `lacuna effects` lists them, and --effects or --adopt adds one of a law file")]
    NoSuchEffect {
        /// What was named.
        id: String,
    },
    /// Effects of one's own for a robot that no free run of the plant is compared with.
    #[error(
        "effects of one's own ({names}) are weighed in free runs of the plant, which torque-driven robots alone have; this \
         one is {kind}: leave out --effects and --adopt"
    )]
    OwnEffects {
        /// Their names.
        names: String,
        /// The kind of robot.
        kind: &'static str,
    },
    /// A correction gives an effect a parameter that it does not have, or a value that is no number.
    #[error("effect '{effect}' takes a finite number for each of {known}, but '{name}' is none of these")]
    NoSuchParameter {
        /// The effect.
        effect: String,
        /// What was named.
        name: String,
        /// Its parameters.
        known: String,
    },
    /// The response to commands cannot be what its file says.
    #[error(transparent)]
    Response(#[from] verdict::ResponseError),
    /// A simulation left the numbers.
    #[error(
        "the simulation of '{recording}' gives no finite {what} after {time:.2} s; check the inputs there, and the robot's \
         constants"
    )]
    NotFinite {
        /// Name of the recording.
        recording: String,
        /// Which quantity.
        what: &'static str,
        /// When, s after the first row.
        time: f64,
    },
    /// The robot cannot be what its file says.
    #[error(transparent)]
    Model(#[from] robot_model::ModelError),
}
