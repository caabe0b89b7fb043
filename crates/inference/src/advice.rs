//! What advice on the next drive has in common for all kinds of robots.

use verdict::{Advice, Contender, Manoeuvre};

use crate::expected_information::entropy;
use crate::settings::SETTINGS;

/// A gain this small, bits, is none.
pub const LEAST_BITS: f64 = SETTINGS.information.least;

/// Advice among contenders, without any drive yet.
pub fn among(rivals: impl Iterator<Item = Contender>) -> Advice {
    let rivals: Vec<Contender> = rivals.collect();
    let p: Vec<f64> = rivals.iter().map(|r| r.probability).collect();
    Advice { entropy_bits: entropy(&p), rivals, ..Advice::default() }
}

/// The best first: by bits, where nothing is to be split by what narrows the size most.
#[must_use]
pub fn sorted(mut advice: Advice) -> Advice {
    let size = |m: &Manoeuvre| m.narrows.unwrap_or(1.0);
    advice.manoeuvres.sort_by(|a, b| {
        b.expected_bits.total_cmp(&a.expected_bits).then(size(a).total_cmp(&size(b))).then(a.name.cmp(&b.name))
    });
    advice
}

/// Why no drive is worth making for telling rivals apart.
pub fn nothing_to_split(advice: &Advice) -> Option<String> {
    let most = advice.manoeuvres.iter().map(|m| m.expected_bits).fold(0.0, f64::max);
    match advice.rivals.as_slice() {
        [] => Some("no hypothesis could be fitted".to_owned()),
        [one] if one.effects.is_empty() => {
            Some("nothing is missing in the motion, and no effect is a likely alternative".to_owned())
        }
        [one] => Some(format!(
            "nothing is left to tell apart: only {} is probable; the drives are ordered by how \
             much they narrow its size",
            one.name
        )),
        _ if most < LEAST_BITS => Some("none of the candidate drives would tell these causes apart".to_owned()),
        _ => None,
    }
}
