//! Whether the right thing is named.

use robot_model::Kind as Place;
use robot_model::effects::catalogue;
use serde::Serialize;
use verdict::Verdict;

use super::{FIRST, Kind, RankedAnswer};

/// What is named, and whether it is right.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[expect(clippy::struct_excessive_bools, reason = "questions that are answered one by one")]
pub(in crate::blind) struct Naming {
    /// The answer in a word: the first effect, "none", "unknown", or "failed" if there is none.
    pub(in crate::blind) answer: String,
    /// Most probable effects.
    pub(in crate::blind) first: Vec<String>,
    /// The verdict is right, and so is the first effect if there is one to name.
    pub(in crate::blind) right: bool,
    /// Right, or told to be indistinguishable from what is right.
    pub(in crate::blind) class: bool,
    /// A hidden effect is among the first three.
    pub(in crate::blind) any_in_three: bool,
    /// All hidden effects are.
    pub(in crate::blind) all_in_three: bool,
    /// An effect that is not hidden is told to be there more likely than not, in the class of nothing that is.
    pub(in crate::blind) invented: bool,
    /// A sensor is blamed for a sensor's fault, the robot for the robot's; where something is blamed.
    pub(in crate::blind) sort: Option<bool>,
}

impl Naming {
    pub(super) fn of(kind: Kind, wanted: &[&str], answer: RankedAnswer<'_>) -> Self {
        let named = answer.named();
        let first = named.first().copied();
        let explained = answer.verdict == Some(Verdict::Explained);
        let right = match kind {
            Kind::Null => matches!(answer.verdict, Some(Verdict::NoMismatch | Verdict::Withheld)),
            Kind::Outsider if wanted == [super::UNKNOWN] => answer.verdict == Some(Verdict::Unknown),
            Kind::Single | Kind::Pair | Kind::Triple | Kind::Outsider => {
                explained && first.is_some_and(|e| wanted.contains(&e))
            }
        };
        let blamed = first.filter(|_| explained);
        let shares_class = |effect: &str| {
            let holding = answer.classes.iter().filter(|c| c.iter().any(|e| e == effect));
            holding.flatten().any(|e| wanted.contains(&e.as_str()))
        };
        let likely = answer.ranked.iter().filter(|c| c.probability > LIKELY && c.effect != super::NONE);
        let foreign = |e: &str| e != super::UNKNOWN && !wanted.contains(&e) && !shares_class(e);
        let invented = explained_or_unknown(answer.verdict) && likely.clone().any(|c| foreign(&c.effect));
        let in_three = |e: &&str| named.iter().take(FIRST).any(|n| n == e);
        Self {
            answer: match answer.verdict {
                None => "failed",
                Some(Verdict::Explained) => first.unwrap_or("-"),
                Some(Verdict::Unknown) => super::UNKNOWN,
                Some(Verdict::NoMismatch | Verdict::Withheld) => super::NONE,
            }
            .to_owned(),
            right,
            class: right || kind.in_catalogue() && blamed.is_some_and(shares_class),
            any_in_three: kind.in_catalogue() && wanted.iter().any(in_three),
            all_in_three: kind.in_catalogue() && wanted.iter().all(in_three),
            invented,
            sort: blamed.and_then(|b| match kind {
                Kind::Null => None,
                // No outsider is a fault of a sensor.
                Kind::Outsider => Some(!is_sensor(b)),
                Kind::Single | Kind::Pair | Kind::Triple => Some(wanted.iter().any(|w| is_sensor(w) == is_sensor(b))),
            }),
            first: named.iter().take(FIRST).map(|e| (*e).to_owned()).collect(),
        }
    }
}

/// Probability above which a cause is told to be there.
const LIKELY: f64 = 0.5;

/// Whether causes are told at all.
fn explained_or_unknown(verdict: Option<Verdict>) -> bool {
    matches!(verdict, Some(Verdict::Explained | Verdict::Unknown))
}

/// Whether an effect changes only what a sensor says.
fn is_sensor(effect: &str) -> bool {
    catalogue::<f64>().iter().any(|e| e.spec().id == effect && e.spec().kind == Place::Sensor)
}

#[cfg(test)]
mod tests {
    use verdict::Verdict;

    use super::super::testing::cause;
    use super::*;

    fn naming(kind: Kind, wanted: &[&str], verdict: Verdict, ranked: &[(&str, f64)], class: &[&str]) -> Naming {
        let causes: Vec<_> = ranked.iter().map(|(e, p)| cause(e, *p)).collect();
        let ranked: Vec<_> = causes.iter().collect();
        let classes = [class.iter().map(|e| (*e).to_owned()).collect()];
        Naming::of(kind, wanted, RankedAnswer { verdict: Some(verdict), ranked: &ranked, classes: &classes })
    }

    #[test]
    fn a_single_needs_its_effect_first_and_the_verdict() {
        let ranked = [("unknown", 0.5), ("payload", 0.4), ("grade", 0.1)];
        let of = |wanted, verdict, class: &[&str]| naming(Kind::Single, &[wanted], verdict, &ranked, class);
        let n = of("payload", Verdict::Explained, &[]);
        assert!(n.right && n.class && n.all_in_three && n.sort == Some(true) && n.answer == "payload");
        let n = of("payload", Verdict::Unknown, &[]);
        assert!(!n.right && !n.class && n.any_in_three && n.sort.is_none() && n.answer == "unknown");
        let n = of("grade", Verdict::Explained, &["payload", "grade"]);
        assert!(!n.right && n.class);
        let n = of("grade", Verdict::Explained, &["grade", "stiction"]);
        assert!(!n.class, "the class of the answer does not hold the truth");
        let n = of("gyro_bias", Verdict::Explained, &[]);
        assert!(n.sort == Some(false) && !n.any_in_three);
    }

    #[test]
    fn both_of_a_pair_are_asked_for_and_verdicts_of_the_rest() {
        let ranked = [("payload", 0.9), ("stiction", 0.3), ("grade", 0.2), ("motor_lag", 0.1)];
        let pair = |wanted: [&str; 2]| naming(Kind::Pair, &wanted, Verdict::Explained, &ranked, &[]);
        let n = pair(["grade", "payload"]);
        assert!(n.right && n.any_in_three && n.all_in_three);
        let n = pair(["motor_lag", "grade"]);
        assert!(!n.right && n.any_in_three && !n.all_in_three);
        assert!(naming(Kind::Null, &["none"], Verdict::Withheld, &[], &[]).right);
        assert!(!naming(Kind::Null, &["none"], Verdict::Unknown, &[], &[]).right);
        assert!(naming(Kind::Outsider, &["unknown"], Verdict::Unknown, &ranked, &[]).right);
        let n = naming(Kind::Outsider, &["unknown"], Verdict::Explained, &[("gyro_scale", 1.0)], &[]);
        assert!(!n.right && !n.class && n.sort == Some(false) && n.invented);
    }

    #[test]
    fn an_outsider_that_the_catalogue_names_is_right_by_that_name_and_no_other() {
        let ranked = [("battery_sag", 0.9), ("payload", 0.6)];
        let n = naming(Kind::Outsider, &["battery_sag"], Verdict::Explained, &ranked, &[]);
        assert!(n.right && n.invented, "the payload is not there");
        let n = naming(Kind::Outsider, &["unknown"], Verdict::Explained, &ranked, &[]);
        assert!(!n.right);
        let n = naming(Kind::Outsider, &["unknown"], Verdict::Unknown, &[("unknown", 0.9), ("payload", 0.4)], &[]);
        assert!(n.right && !n.invented, "what is less likely than not is not told to be there");
    }
}
