//! What advice on the next drive has in common for all kinds of robots.

use verdict::{Advice, Contender, Manoeuvre};

use crate::expected_information::entropy;
use crate::settings::SETTINGS;

/// A gain this small, bits, is none.
pub const LEAST_BITS: f64 = SETTINGS.information.least;

/// An answer less probable than this is no rival.
pub const LEAST_RIVAL: f64 = SETTINGS.information.least_rival;
/// Rivals at most.
pub const MOST_RIVALS: usize = SETTINGS.information.rivals;

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

#[cfg(test)]
mod tests {
    use super::*;
    use verdict::Course;

    fn rivals(p: &[f64]) -> Advice {
        let contender = |(i, p): (usize, &f64)| Contender {
            effects: if i == 0 { Vec::new() } else { vec![format!("effect {i}")] },
            name: format!("rival {i}"),
            probability: *p,
        };
        among(p.iter().enumerate().map(contender))
    }

    fn drive(name: &str, expected_bits: f64, narrows: Option<f64>) -> Manoeuvre {
        Manoeuvre { expected_bits, narrows, ..Manoeuvre::new(name, Course::default(), [0.0; 3]) }
    }

    #[test]
    fn advice_among_rivals_holds_them_and_their_entropy() {
        let advice = rivals(&[0.5, 0.25, 0.25]);
        assert_eq!(advice.rivals.len(), 3);
        approx::assert_relative_eq!(advice.entropy_bits, 1.5, epsilon = 1e-12);
    }

    #[test]
    fn drives_are_ordered_by_bits_then_by_what_narrows_most_then_by_name() {
        let manoeuvres =
            vec![drive("b", 0.1, None), drive("c", 0.1, Some(0.5)), drive("a", 0.1, None), drive("d", 0.7, Some(0.9))];
        let names: Vec<String> =
            sorted(Advice { manoeuvres, ..Advice::default() }).manoeuvres.into_iter().map(|m| m.name).collect();
        assert_eq!(names, ["d", "c", "a", "b"]);
    }

    #[test]
    fn no_drive_is_worth_making_without_two_rivals_or_where_none_gains_a_bit() {
        let reason =
            |p: &[f64], bits: f64| nothing_to_split(&Advice { manoeuvres: vec![drive("a", bits, None)], ..rivals(p) });
        assert!(reason(&[], 0.0).expect("a reason").contains("no hypothesis could be fitted"));
        assert!(reason(&[1.0], 0.0).expect("a reason").contains("nothing is missing"));
        let mut one = rivals(&[0.5, 0.5]);
        one.rivals.remove(0);
        assert!(nothing_to_split(&one).expect("a reason").contains("only rival 1 is probable"));
        assert!(reason(&[0.5, 0.5], 0.99 * LEAST_BITS).expect("a reason").contains("none of the candidate drives"));
        assert_eq!(reason(&[0.5, 0.5], LEAST_BITS), None);
    }
}
