//! What a verdict tells and a file cannot hold.

use inference::robust::NINETY;
use verdict::Diagnosis;

/// A constant that a verdict tells, with its value.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Told {
    /// Its name.
    pub(super) name: String,
    /// Its value.
    pub(super) value: f64,
    /// Half width of its 90 % interval, if it is known.
    pub(super) half_width: Option<f64>,
}

/// By how much a constant that no cause was named for has to differ from what is stated to be told, in its unit.
const SHOWS: f64 = 1e-3;

/// A constant that a file cannot hold.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Unheld {
    pub(super) told: Told,
    /// Its unit; "1" for none.
    pub(super) unit: &'static str,
    /// What to do instead.
    pub(super) remedy: &'static str,
}

/// What a verdict tells: constants that it re-tuned, and those of the causes that it names.
pub(super) fn told(diagnosis: &Diagnosis) -> Vec<Told> {
    let retuned = diagnosis.retuned.iter().map(|r| Told {
        name: r.constant.clone(),
        value: r.to,
        half_width: Some(r.half_width),
    });
    let named = diagnosis.ranked.iter().flat_map(|cause| &cause.parameters).map(|(name, e)| Told {
        name: name.clone(),
        value: e.value,
        half_width: e.sigma.map(|sigma| NINETY * sigma),
    });
    let mut out: Vec<Told> = Vec::new();
    for told in retuned.chain(named) {
        if out.iter().all(|other| other.name != told.name) {
            out.push(told);
        }
    }
    out
}

impl Told {
    /// A constant that was fitted beside those of the causes.
    pub(super) fn fitted(diagnosis: &Diagnosis, name: &str) -> Option<Self> {
        let value = *diagnosis.tuning.get(name)?;
        Some(Self { name: name.to_owned(), value, half_width: None })
    }

    /// Whether it differs from what a target takes for granted.
    pub(super) fn differs_from(&self, neutral: f64) -> bool {
        (self.value - neutral).abs() > self.half_width.unwrap_or(SHOWS)
    }
}

impl Unheld {
    /// "rate of the clocks is 0.00135 ± 0.00017 (90 %), which a robot file cannot hold: correct the time stamps by it."
    pub(super) fn sentence(&self, holder: &str) -> String {
        let Self { told: Told { name, value, half_width }, unit, remedy } = self;
        let unit = if *unit == "1" { String::new() } else { format!(" {unit}") };
        // Two digits of the interval, or three of a value without one.
        let least = half_width.unwrap_or(0.1 * value).abs().max(1e-9);
        let digits = (1.0 - least.log10().floor()).clamp(0.0, 9.0) as usize;
        let interval = half_width.map_or_else(String::new, |half| format!(" ± {half:.digits$}"));
        let level = if half_width.is_some() { " (90 %)" } else { "" };
        format!("{name} is {value:.digits$}{interval}{unit}{level}, which {holder} cannot hold: {remedy}.")
    }
}
