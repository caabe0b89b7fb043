//! Sentences for people.

use catalogue::answer::{NONE, UNKNOWN};
use inference::words::{listed, probability, quantity};

use crate::fit::is_at_a_stop;
use crate::judged::Judged;
use crate::locate;
use crate::settings::decision::SETTINGS;
use verdict::{Cause, Diagnosis, LawOfFile, Retuned, SimulatorConstants, Verdict};

/// Re-tuned constants that get a sentence, at most: the rest is in the JSON.
const SENTENCES: usize = 4;

/// Whether a cause is this effect, and likely.
fn is_likely(cause: &Cause, effect: &str) -> bool {
    cause.effect == effect && cause.probability > SETTINGS.answer.likely
}

/// The headline where nothing is named and no constant stands out, by the costs of the calibrated, the re-tuned and a fault-free simulation.
fn without_a_cause([calibrated, _, fault_free]: [f64; 3]) -> String {
    let times = calibrated / fault_free.max(1.0);
    if times < SETTINGS.answer.left_as_calibrated {
        return "No mismatch: the calibrated simulation explains these recordings.".to_owned();
    }
    format!(
        "No cause is found: the calibrated simulation is off by {:.1} times as much (rms) as in the references, and constants within what \
         these leave open explain it together, none of which stands out. A reference of the day of the recordings would tell whether they moved.",
        times.sqrt()
    )
}

/// What is missing, a sentence for each likely effect; of one that either side may have, and of two likely ones that cannot be told
/// apart, one for both.
fn missing(causes: &[&Cause], indistinguishable: &[Vec<String>]) -> Vec<String> {
    let is_other_side =
        |a: &Cause, b: &Cause| a.effect == b.effect && a.side.is_some() && b.side.is_some() && a.side != b.side;
    let are_both_likely = |a: &Cause, b: &Cause| a.probability.min(b.probability) > SETTINGS.answer.likely;
    let are_of_a_class = |a: &Cause, b: &Cause| {
        a.effect != b.effect
            && indistinguishable.iter().any(|class| class.contains(&a.effect) && class.contains(&b.effect))
    };
    let is_either = |a: &Cause, b: &Cause| is_other_side(a, b) || (are_both_likely(a, b) && are_of_a_class(a, b));
    let mut out = Vec::new();
    for (k, c) in causes.iter().enumerate() {
        if causes[..k].iter().any(|before| is_either(before, c)) {
            continue;
        }
        let other = causes[k..].iter().find(|other| is_either(c, other));
        let together = (c.probability + other.map_or(0.0, |other| other.probability)).min(1.0);
        if together <= SETTINGS.answer.likely {
            continue;
        }

        let p = probability(together);
        let place = c.place.map_or(String::new(), |p| format!(" within {:.2} m of ({:.2}, {:.2}) m", p[2], p[0], p[1]));
        out.push(match other {
            Some(other) => {
                let which = if c.effect == other.effect { "which side" } else { "which" };
                let [first, second] = [c, other].map(|c| format!("{}, {}", c.name, quantity(c)));
                format!(
                    "Missing: {first}, or {second}: these recordings do not tell {which} (either: probability {p})."
                )
            }
            None => format!("Missing: {}, {}{place} (probability {p}).", c.name, quantity(c)),
        });
    }
    out
}

/// That recordings may lack something, where that is as likely as that they lack nothing, and is not named.
fn undecided(d: &Diagnosis) -> Option<String> {
    let of = |id: &str| d.ranked.iter().find(|c| c.effect == id).map_or(0.0, |c| c.probability);
    let [unknown, nothing] = [UNKNOWN.id, NONE.id].map(of);
    (d.verdict == Verdict::NoMismatch && unknown >= nothing).then(|| {
        format!(
            "These recordings do not tell whether anything is missing: something that is not in the catalogue has a probability of {}, \
             nothing one of {}. Drives in which the simulation is right (--reference) would tell.",
            probability(unknown),
            probability(nothing)
        )
    })
}

/// That nothing is missing by the robot file alone; `beyond`: constants that lie farther from it than it states.
fn by_the_file(beyond: &[Retuned]) -> String {
    if beyond.is_empty() {
        return "No mismatch: the simulation explains these recordings, its constants within the uncertainty that the robot file \
                states."
            .to_owned();
    }
    let constants: Vec<String> =
        beyond.iter().map(|c| format!("{} ({:.1} of its sigmas)", c.values(), c.sigmas.abs())).collect();
    format!(
        "Nothing that can be named is missing: the simulation explains these recordings, with constants farther from the robot file than \
         it states: {}. Without references these may also make up for laws that this robot has otherwise.",
        constants.join("; ")
    )
}

/// The answer in sentences, the most important one first.
pub(crate) fn sentences(d: &Diagnosis, judged: &Judged<'_>) -> Vec<String> {
    let mut out: Vec<String> = undecided(d).into_iter().collect();
    let calibrated = judged.problem.has_references;
    let causes: Vec<&Cause> = d.ranked.iter().filter(|c| c.effect != NONE.id && c.effect != UNKNOWN.id).collect();
    match d.verdict {
        Verdict::NoMismatch if d.retuned.is_empty() && calibrated => out.push(without_a_cause(d.costs)),
        Verdict::NoMismatch if d.retuned.is_empty() => out.push(by_the_file(&judged.beyond_the_file(&d.tuning))),
        Verdict::NoMismatch => out.push(
            "Nothing is missing: the simulation explains these recordings once its constants are re-tuned.".to_owned(),
        ),
        Verdict::Unknown => {
            out.push(if calibrated {
                "The simulation lacks something that is not in the catalogue: no effect of the \
                 catalogue explains these recordings."
                    .to_owned()
            } else {
                "No effect of the catalogue explains these recordings: either the simulation lacks something that is not in it, \
                 or tyres or drives of this robot follow other laws than the model's in fault-free drives too. Without \
                 references these cannot be told apart; give a fault-free drive with --reference."
                    .to_owned()
            });
            out.extend(judged.decision.refuted());
            let nearest = causes.first().filter(|_| judged.winner().is_some());
            out.extend(nearest.map(|c| format!("The nearest effect is {} ({}).", c.name, quantity(c))));
            let what = nearest.map_or("The re-tuned simulation", |_| "With it the simulation");
            out.extend(judged.decision.why_unknown(what, calibrated));
        }
        Verdict::Explained => {
            out.extend(missing(&causes, &d.indistinguishable));
            if out.is_empty()
                && let Some(c) = causes.first()
            {
                let of = |id: &str| d.ranked.iter().find(|c| c.effect == id).map_or(0.0, |c| c.probability);
                let nothing = of(NONE.id);
                out.push(format!(
                    "No cause stands out: something of the catalogue is missing with probability {}, nothing with {}; the \
                     likeliest cause is {}, {} ({}).",
                    probability(1.0 - nothing - of(UNKNOWN.id)),
                    probability(nothing),
                    c.name,
                    quantity(c),
                    probability(c.probability)
                ));
            }
        }
        Verdict::Withheld => out.push("These recordings permit no answer.".to_owned()),
    }
    let is_named = |law: &&LawOfFile| d.verdict == Verdict::Explained && causes.iter().any(|c| is_likely(c, &law.name));
    out.extend(
        d.own_effects
            .iter()
            .filter(is_named)
            .map(|law| format!("{} is the law of a file, with these numbers there: {}.", law.name, law.formula)),
    );
    out.extend(d.simulator.iter().flat_map(SimulatorConstants::sentences));
    if matches!(d.verdict, Verdict::NoMismatch | Verdict::Explained) {
        let farthest = d.retuned.iter().take(SENTENCES);
        let at_its_end = |constant: &Retuned| {
            let moved = d.tuning.get(&constant.constant).copied().unwrap_or(0.0);
            if is_at_a_stop(moved) { "; no fit goes further, so that something else may be behind it" } else { "" }
        };
        out.extend(farthest.map(|c| format!("Re-tune: {}{}.", c.sentence(), at_its_end(c))));
    }
    for class in &d.indistinguishable {
        let name = |id: &String| d.ranked.iter().find(|c| c.effect == *id).map_or(id, |c| &c.name).clone();
        let names: Vec<String> = class.iter().map(name).collect();
        out.push(format!(
            "These recordings cannot tell apart: {}. `lacuna next` suggests the drive that would.",
            listed(&names)
        ));
    }
    let unknown = d.ranked.iter().find(|c| c.effect == UNKNOWN.id).map_or(0.0, |c| c.probability);
    if d.verdict == Verdict::Explained && unknown > SETTINGS.answer.likely {
        out.push(format!(
            "Something else is missing as well, which is not in the catalogue (probability {}).",
            probability(unknown)
        ));
    }
    if let Some(r) = d.located.remainder.as_ref().filter(|_| d.verdict != Verdict::NoMismatch) {
        out.push(locate::sentence(r));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::{missing, without_a_cause};
    use verdict::Cause;

    #[test]
    fn an_effect_that_either_side_may_have_is_told_once_with_both_sides() {
        let of = |effect: &str, name: &str, probability: f64, size: f64| Cause {
            side: name.rsplit_once(": ").map(|(_, side)| side.to_owned().into()),
            magnitude: Some(size),
            sigma: Some(0.01),
            unit: "-".into(),
            ..Cause::plain(effect, name, probability)
        };
        let right = of("torque_constant_side", "torque constant of one side: right", 0.5, -0.13);
        let left = of("torque_constant_side", "torque constant of one side: left", 0.49, 0.15);
        let drag = of("quadratic_drag", "quadratic drag", 0.7, 3.0);
        let told = missing(&[&drag, &right, &left], &[]);
        assert_eq!(told.len(), 2, "{told:?}");
        assert!(
            told[0].starts_with("Missing: quadratic drag, ") && told[0].ends_with("(probability 0.70)."),
            "{told:?}"
        );
        let both = &told[1];
        assert!(
            both.contains("right, -0.130") && both.contains("or torque constant of one side: left, 0.150"),
            "{both}"
        );
        assert!(both.ends_with("do not tell which side (either: probability 0.99)."), "{both}");
        assert!(missing(&[&of("grade", "sloping ground", 0.4, 0.1)], &[]).is_empty());
    }

    #[test]
    fn two_likely_effects_that_cannot_be_told_apart_are_told_as_one_or_the_other() {
        let of =
            |effect: &str, probability| Cause { magnitude: Some(2.0), ..Cause::plain(effect, effect, probability) };
        let [payload, gain, drag] = [of("payload", 0.52), of("gain", 0.51), of("drag", 0.9)];
        let class = [vec!["payload".to_owned(), "gain".to_owned(), "slope".to_owned()]];
        let told = missing(&[&drag, &payload, &gain], &class);
        assert_eq!(told.len(), 2, "{told:?}");
        assert!(told[1].starts_with("Missing: payload, ") && told[1].contains(", or gain, "), "{told:?}");
        assert!(told[1].ends_with("do not tell which (either: probability 1.00)."), "{told:?}");

        assert_eq!(missing(&[&drag, &payload, &gain], &[]).len(), 3, "both are there");
        let unlikely = of("slope", 0.2);
        assert_eq!(missing(&[&payload, &unlikely], &class), missing(&[&payload], &class));
    }

    #[test]
    fn what_leaves_many_times_as_much_as_the_references_is_not_said_to_explain_recordings() {
        assert!(without_a_cause([200.0, 90.0, 100.0]).starts_with("No mismatch"));
        let told = without_a_cause([900.0, 90.0, 100.0]);
        assert!(told.starts_with("No cause is found") && told.contains("off by 3.0 times as much"), "{told}");
    }
}
