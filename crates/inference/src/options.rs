//! Settings of a diagnosis.

use crate::KnownEffects;
use crate::settings::{SETTINGS, Usual};

/// When a law is looked for that has no name in the catalogue.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SearchForLaw {
    /// Whatever the answer is.
    Always,
    /// Where the cause is unknown, or the best name leaves much of the mismatch.
    #[default]
    Unknown,
    /// Never.
    Never,
}

/// Settings of a diagnosis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// Integration step, s.
    pub step: f64,
    /// Length of a segment over which the model runs free, s.
    pub segment: f64,
    /// Share of the log-likelihood that counts: a segment's numbers are correlated, about one in seven is new.
    pub likelihood_power: f64,
    /// Saturation of outliers, in expected misfits of a segment.
    pub outlier_scale: f64,
    /// Length of the drives among which to advise on the next one, s; no advice if not given, for it takes a few seconds.
    pub next: Option<f64>,
    /// Whether nobody changed the robot since it was right: its mass, motors and wheels are what they were, so no such
    /// cause is weighed.
    pub same_robot: bool,
    /// When a law is looked for that has no name in the catalogue (torque-driven robots).
    pub law: SearchForLaw,
    /// An effect of the motion that is weighed as little as if the catalogue did not hold it (torque-driven robots): what
    /// would be said of a cause without a name.
    pub without: Option<&'static str>,
    /// The effects that may be named: the catalogue's, and those of one's own (torque-driven robots).
    pub known: KnownEffects,
}

impl Default for Options {
    fn default() -> Self {
        let Usual { step, segment, likelihood_power, outlier_scale } = SETTINGS.options;
        Self {
            step,
            segment,
            likelihood_power,
            outlier_scale,
            next: None,
            same_robot: false,
            law: SearchForLaw::default(),
            without: None,
            known: KnownEffects::default(),
        }
    }
}
