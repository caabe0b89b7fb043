//! What is known of each recording.

/// One recording of one robot.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct DiagnosedRecording {
    /// Its name.
    pub id: String,
    /// Which vehicle.
    pub robot: String,
    /// When it was recorded, ms since 1970.
    pub date: Option<i64>,
    /// What was found.
    pub finding: Finding,
}

/// What was found in a recording.
#[derive(Debug, Clone, Default, PartialEq)]
pub enum Finding {
    /// Nothing is missing.
    #[default]
    NoMismatch,
    /// These effects.
    Explained(Vec<Named>),
    /// Something that is not in the catalogue.
    Unknown,
    /// No answer is permitted, for this reason.
    Withheld(String),
    /// It could not be diagnosed, for this reason.
    Failed(String),
}

impl Finding {
    /// Whether it says that there is, or is not, a mismatch.
    pub(super) fn is_answer(&self) -> bool {
        !matches!(self, Self::Withheld(_) | Self::Failed(_))
    }

    pub(super) fn is_mismatch(&self) -> bool {
        matches!(self, Self::Explained(_) | Self::Unknown)
    }
}

/// An effect that a recording was found to have.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Named {
    /// Effect id.
    pub effect: String,
    /// Name for people, with its side.
    pub name: String,
    /// `left` or `right`, when it sits on one side.
    pub side: Option<String>,
    /// Probability.
    pub probability: f64,
    /// Size in `unit`.
    pub magnitude: Option<f64>,
    /// Its 90 % interval.
    pub interval: Option<[f64; 2]>,
    /// Unit of the size.
    pub unit: String,
}
