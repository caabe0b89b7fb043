//! One possible cause.

use std::collections::BTreeMap;

use pyo3::prelude::*;
use report::words::NINETY;

/// One possible cause with what is known about it.
///
/// Attributes
/// ----------
/// effect : str
///     Id of the effect, as ``lacuna.effects()`` lists it.
/// name : str
///     Name for people, with side, axis and place.
/// side : {"left", "right"} or None
///     Side, when it sits on one.
/// probability : float
///     Probability that it is part of the truth.
/// magnitude, sigma : float or None
///     Size in ``unit``, signed, and one standard deviation of it.
/// interval : (float, float) or None
///     The 90 % interval of the size, ``magnitude`` -+ 1.645 ``sigma``.
/// unit : str
///     Unit of the size; ``-`` without one.
/// where : (x, y, radius) or None
///     Where on the ground, when it is a place, m.
/// when : dict of lists or None
///     When it was present in each recording, (from, until) in s; None when it was there all the time.
/// parameters : dict
///     Every number of its law by name: (value, sigma or None, whether it stopped at a bound and is no estimate).
#[pyclass(frozen, get_all, module = "lacuna")]
pub(crate) struct Cause {
    effect: String,
    name: String,
    side: Option<String>,
    probability: f64,
    magnitude: Option<f64>,
    sigma: Option<f64>,
    interval: Option<(f64, f64)>,
    unit: String,
    r#where: Option<(f64, f64, f64)>,
    when: Option<BTreeMap<String, Vec<(f64, f64)>>>,
    parameters: BTreeMap<String, (f64, Option<f64>, bool)>,
}

#[pymethods]
impl Cause {
    fn __repr__(&self) -> String {
        let size = self.magnitude.map_or(String::new(), |m| format!(", {m:.4} {}", self.unit));
        let side = self.side.as_ref().map_or(String::new(), |side| format!(", {side}"));
        format!("<lacuna.Cause {}{side}{size}, probability {:.3}>", self.effect, self.probability)
    }
}

impl From<&verdict::Cause> for Cause {
    fn from(c: &verdict::Cause) -> Self {
        let half = c.sigma.map(|s| NINETY * s).filter(|half| *half > 0.0 && half.is_finite());
        let when = |all: &BTreeMap<String, Vec<[f64; 2]>>| {
            all.iter().map(|(run, spans)| (run.clone(), spans.iter().map(|[a, b]| (*a, *b)).collect())).collect()
        };
        Self {
            effect: c.effect.clone(),
            name: c.name.clone(),
            side: c.side.as_ref().map(ToString::to_string),
            probability: c.probability,
            magnitude: c.magnitude,
            sigma: c.sigma,
            interval: c.magnitude.zip(half).map(|(m, half)| (m - half, m + half)),
            unit: c.unit.to_string(),
            r#where: c.place.map(|[x, y, radius]| (x, y, radius)),
            when: c.intervals.as_ref().map(when),
            parameters: c.parameters.iter().map(|(k, p)| (k.clone(), (p.value, p.sigma, p.at_bound))).collect(),
        }
    }
}
