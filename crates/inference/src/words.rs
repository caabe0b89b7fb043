//! Names and numbers for people.

use robot_model::EffectSpec;
use verdict::Cause;

use crate::hypothesis::{Place, Variant};
use crate::robust::NINETY;

/// A side by its index: 0 left, 1 right.
pub fn side(s: usize) -> &'static str {
    if s == 0 { "left" } else { "right" }
}

/// A name with its side, if it has one.
pub fn named(name: &str, on: Option<usize>) -> String {
    on.map_or_else(|| name.to_owned(), |s| format!("{name}: {}", side(s)))
}

/// Unit of an effect's magnitude: that of its first strength.
pub fn unit(spec: &EffectSpec) -> &'static str {
    spec.strengths().next().map_or("-", |i| spec.parameters[i].unit)
}

/// Name of an effect in one of its forms: with axis, side and place.
pub fn variant(v: &Variant) -> String {
    let spec = v.spec();
    let mut out = spec.name.to_owned();
    if let Some(a) = v.axis {
        out = format!("{out}, along {}", spec.axes[a]);
    }
    match v.place {
        Place::Whole => out,
        Place::Side(s) => named(&out, Some(s)),
        Place::Disc => out + ", at one place",
        Place::Onset => out + ", from an instant on",
    }
}

/// Names of the effects of one hypothesis.
pub fn variants<'a>(all: impl IntoIterator<Item = &'a Variant>) -> String {
    all.into_iter().map(variant).collect::<Vec<_>>().join(" with ")
}

/// A number with as many digits as its uncertainty deserves.
pub fn quantity(c: &Cause) -> String {
    let Some(m) = c.magnitude else { return String::new() };
    let unit = if c.unit == "-" { String::new() } else { format!(" {}", c.unit) };
    match c.sigma.filter(|s| *s > 0.0 && s.is_finite()) {
        Some(s) => {
            let digits = (1 - s.log10().floor() as i32).clamp(0, 6) as usize;
            format!("{m:.digits$} ± {:.digits$}{unit} (90 %)", NINETY * s)
        }
        None => format!("{m:.3}{unit}"),
    }
}

/// The drive that reveals an effect best.
pub fn revealed_by(id: &str) -> Option<&'static str> {
    robot_model::effects::catalogue::<f64>().iter().map(|e| e.spec()).find(|c| c.id == id).map(|c| c.revealed_by)
}
