//! Names and numbers for people.

use robot_model::EffectSpec;
use robot_model::effect::LOST_SHARE;
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
        Place::OnsetOfSide(s) => named(&out, Some(s)) + ", from an instant on",
    }
}

/// Names one after the other; with semicolons where a name has a comma of its own.
pub fn listed(names: &[String]) -> String {
    names.join(if names.iter().any(|name| name.contains(',')) { "; " } else { ", " })
}

/// Names of the effects of one hypothesis.
pub fn variants<'a>(all: impl IntoIterator<Item = &'a Variant>) -> String {
    all.into_iter().map(variant).collect::<Vec<_>>().join(" with ")
}

/// A number with as many digits as its uncertainty deserves; that of a lost share in words, since it may be a gain.
pub fn quantity(c: &Cause) -> String {
    let Some(m) = c.magnitude else { return String::new() };
    if !c.parameters.contains_key(LOST_SHARE) {
        return number(c, m);
    }
    format!("a {} share of {}", if m < 0.0 { "gained" } else { "lost" }, number(c, m.abs()))
}

fn number(c: &Cause, m: f64) -> String {
    let unit = if c.unit == "-" { String::new() } else { format!(" {}", c.unit) };
    match c.sigma.filter(|s| *s > 0.0 && s.is_finite()) {
        Some(s) => {
            let digits = two_decimals(s);
            format!("{m:.digits$} ± {:.digits$}{unit} (90 %)", NINETY * s)
        }
        None => format!("{m:.3}{unit}"),
    }
}

/// A probability; never quite nothing or certain.
pub fn probability(p: f64) -> String {
    if p > 0.0 && p < 0.01 {
        "< 0.01".to_owned()
    } else if p < 1.0 && p > 0.99 {
        "> 0.99".to_owned()
    } else {
        format!("{p:.2}")
    }
}

/// A number with two digits that count.
pub fn two_digits(x: f64) -> String {
    let decimals = two_decimals(x);
    format!("{x:.decimals$}")
}

/// Decimals with which a number of this size has two digits that count, six at most.
pub fn two_decimals(size: f64) -> usize {
    (1 - size.abs().max(1e-6).log10().floor() as i32).clamp(0, 6) as usize
}

/// The drive that reveals an effect best.
pub fn revealed_by(id: &str) -> Option<&'static str> {
    robot_model::effects::catalogue::<f64>().iter().map(|e| e.spec()).find(|c| c.id == id).map(|c| c.revealed_by)
}

#[cfg(test)]
mod tests {
    use super::{probability, quantity};
    use robot_model::effect::LOST_SHARE;
    use verdict::{Cause, Estimate};

    #[test]
    fn names_with_commas_are_kept_apart() {
        let names = |all: &[&str]| super::listed(&all.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>());
        assert_eq!(names(&["grip of the ground", "extra mass"]), "grip of the ground, extra mass");
        assert_eq!(
            names(&["grip of the ground, from an instant on", "extra mass"]),
            "grip of the ground, from an instant on; extra mass"
        );
    }

    #[test]
    fn nothing_is_quite_certain() {
        assert_eq!([0.0, 0.001, 0.5, 0.999, 1.0].map(probability), ["0.00", "< 0.01", "0.50", "> 0.99", "1.00"]);
    }

    #[test]
    fn what_was_lost_or_gained_is_said_and_no_sign_asks_which() {
        let of = |value: f64| {
            let own = Estimate { value, sigma: None, at_bound: false };
            let parameters = [(LOST_SHARE.to_owned(), own)].into();
            Cause {
                magnitude: Some(value),
                parameters,
                unit: "-".into(),
                ..Cause::plain("adhesion_patch", "grip", 0.9)
            }
        };
        assert_eq!([0.6, -0.5].map(|v| quantity(&of(v))), ["a lost share of 0.600", "a gained share of 0.500"]);
    }
}
