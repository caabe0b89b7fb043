//! Findings in sentences: what every comparison whose sessions give normal equations says alike.

use catalogue::for_people;
use inference::words::two_decimals;
use verdict::{Diagnosis, FreeRun, Retuned};

use crate::cause::Cause;
use crate::found::{Answer, Estimate, NamedCause};
use crate::said::{Unconfirmed, beyond_references};
use crate::settings::SETTINGS;
use crate::telling::{Found, Unaccounted, UnevenSensor, gains};

/// How a kind of comparison calls what it compares.
#[derive(Debug, Clone, Copy)]
pub struct Wording<'a> {
    /// That motion and model agree: "the robot moves as the torques of its motors imply".
    pub agree: &'a str,
    /// That they do not.
    pub disagree: &'a str,
    /// Of what errors are told as shares: "errors after a second".
    pub errors: &'a str,
    /// The machine: "robot".
    pub machine: &'a str,
    /// What drives should share: "floor and load".
    pub conditions: &'a str,
    /// Share of the motion beyond which the columns are to be checked first.
    pub most: f64,
    /// Ids of the effects whose size is a factor on counts.
    pub scales: &'a [&'static str],
    /// Whether the drives came with references.
    pub has_references: bool,
}

impl Wording<'_> {
    /// What stands for right, "is known" and "leaves" after it.
    fn right(&self) -> [&'static str; 3] {
        if self.has_references {
            ["the references", "are known", "leave"]
        } else {
            ["the robot file", "is known", "leaves"]
        }
    }
}

impl Found<'_> {
    /// All sentences about what was found but for forecasts: the answer first, then its numbers.
    pub fn sentences(&self, words: &Wording<'_>, told: &Diagnosis) -> Vec<String> {
        let mut out: Vec<String> = self.undecided().into_iter().collect();
        out.push(self.headline(words));
        if self.answer == Answer::Retune {
            out.extend(told.retuned.iter().map(|r| format!("{}.", r.sentence())));
        }
        out.extend(self.unconfirmed());
        out.extend(self.doubted());
        out.extend(self.causes(words, &told.free_runs));
        out.extend(self.perhaps());
        if self.answer == Answer::Named && !told.retuned.is_empty() {
            let most = told.retuned.iter().take(SETTINGS.naming.beside);
            let changes: Vec<String> = most.map(Retuned::change).collect();
            let [stated, _, leaves] = words.right();
            out.push(format!(
                "Constants that were re-tuned as well, within what {stated} {leaves} open, the farthest first: {}.",
                changes.join("; ")
            ));
        }
        out
    }

    /// The first sentence.
    fn headline(&self, words: &Wording<'_>) -> String {
        let [given, tuned, best] = self.shares.map(|s| 100.0 * s);
        let [stated, is_known, leaves] = words.right();
        let Wording { agree, disagree, errors, machine, conditions, .. } = words;
        match self.answer {
            Answer::Nothing => format!(
                "{} {agree}, as well as {stated} {is_known} ({errors}: {given:.1} % of the motion, {tuned:.1} % re-tuned).",
                self.nothing()
            ),
            Answer::Retune => {
                let far = self.retuned.iter().map(|e| e.sigmas.abs()).fold(0.0, f64::max);
                let how = if far > SETTINGS.naming.told_far {
                    format!("once constants are set up to {far:.1} sigmas from {stated}")
                } else {
                    format!("once constants are set within what {stated} {leaves} open")
                };
                format!("Re-tune: {agree} {how} ({errors}: {given:.1} % of the motion, {tuned:.1} % re-tuned).")
            }
            Answer::Named => format!(
                "{disagree} by more than {stated} {leaves} open: {} ({errors}: {given:.1} % of the motion, {tuned:.1} % re-tuned, \
                 {best:.1} % with what is named).",
                self.names()
            ),
            Answer::Unknown => match self.unknown {
                Unaccounted::Scattered(times) => format!(
                    "Unknown: the drives of this {machine} differ from each other by {times:.0} times what is usual or more, so that no \
                     cause that all of them share can be trusted ({errors}: {given:.1} % of the motion, {best:.1} % with the best \
                     answer). Diagnose drives of one day, {conditions} by themselves."
                ),
                Unaccounted::Refuted => format!(
                    "Something is missing that the candidates do not account for: with them drives that were left out of the fit are \
                     forecast worse than as stated ({errors}: {given:.1} % of the motion, {tuned:.1} % re-tuned)."
                ),
                Unaccounted::Uneven(UnevenSensor { sensor, quantity, unit, limit, small, large }) => format!(
                    "Something is missing that none of the causes accounts for: the {sensor} shows {small:.2} times the {quantity} \
                     that the pose gives up to {limit:.2} {unit}, and {large:.2} times beyond. No scale of a sensor \
                     does that: one that reaches its end does, or wheels that slip."
                ),
                Unaccounted::SlipsBelowZero => format!(
                    "Something is missing that none of the causes accounts for: several slips below zero fit best, which slip does not do \
                     ({errors}: {given:.1} % of the motion, {best:.1} % with them). Tyres that scrub in turns look like this: the effective \
                     track then depends on how fast the robot turns."
                ),
                Unaccounted::Left { of_references } => format!(
                    "Something is missing that none of the causes accounts for ({errors}: {given:.1} % of the motion, {best:.1} % with the \
                     best answer).{}{}",
                    beyond_references(self.shares[2], of_references).unwrap_or_default(),
                    if self.shares[2] > words.most {
                        " Nothing that drives is off by so much: check the order, the signs and the units of the columns first."
                    } else {
                        ""
                    }
                ),
            },
        }
    }

    /// What was named and is not told.
    fn unconfirmed(&self) -> Option<String> {
        let Unconfirmed { labels, standing } = self.unconfirmed?;
        let names: Vec<String> = labels.iter().map(|label| for_people(label)).collect();
        Some(format!(
            "Not part of the answer, because forecasts do not confirm it: {}. With it, drives left out of the fit are forecast with {:.2} times the error of the simulation \
             as stated, and {:.2} times that of the re-tuned one. Record more drives, and longer ones, to decide.",
            names.join("; "),
            standing.over_nominal,
            standing.over_retuned
        ))
    }

    /// Names of the named causes, with their places.
    fn names(&self) -> String {
        let names: Vec<String> = self.named.iter().map(|c| for_people(&c.label)).collect();
        names.join("; ")
    }

    /// A sentence for each named cause, with its numbers and those that cannot be told from it.
    fn causes<'a>(&'a self, words: &'a Wording<'a>, free_runs: &'a [FreeRun]) -> impl Iterator<Item = String> + 'a {
        self.named.iter().enumerate().map(move |(k, named)| {
            let values = named.estimates.iter().map(|e| {
                let stated = if words.has_references { "in the references" } else { "given as" };
                let from = if e.given == 0.0 { String::new() } else { format!(", {stated} {:.4}", e.given) };
                format!("{} {}{from}", e.name, number(e))
            });
            let alike = match self.alike(k, free_runs) {
                alike if alike.is_empty() => String::new(),
                alike => {
                    let names: Vec<String> = alike.iter().map(|label| for_people(label)).collect();
                    format!("; these drives cannot tell it from {}", names.join(", "))
                }
            };
            let familiar = if words.scales.contains(&named.spec.id) { familiar(named) } else { String::new() };
            let gain = if gains(named) { NO_SLIP } else { "" };
            let name = verdict::sentence_case(&for_people(&named.label));
            let name = if self.answer == Answer::Unknown { format!("Candidate only: {name}") } else { name };
            let onset = named.onset.as_ref().map_or_else(String::new, |onset| format!("; {onset}"));
            format!("{name}: {}{familiar}{gain}{onset}{alike}.", values.collect::<Vec<_>>().join("; "))
        })
    }
}

/// What references and recordings lack alike, where they do.
pub fn lacking_in_all<'a>(causes: impl Iterator<Item = &'a Cause>) -> Option<String> {
    let all: Vec<String> = causes.map(|cause| format!("{} ({})", cause.spec.name, cause.label())).collect();
    (!all.is_empty()).then(|| {
        format!(
            "references and recordings alike ask for {}: the robot file is wrong about this in all drives, so that it is no \
             difference between them; correct the robot file",
            all.join(" and ")
        )
    })
}

/// Sentences about recordings that say the same of several, each once: "recording 'a': it" and "recording 'b': it" as "recordings 'a', 'b':
/// it".
pub fn of_recordings(told: impl IntoIterator<Item = String>) -> Vec<String> {
    let mut out: Vec<(Vec<String>, String)> = Vec::new();
    for sentence in told {
        let split = sentence.strip_prefix("recording '").and_then(|rest| rest.split_once("': "));
        let (name, said) = split.map_or((None, sentence.as_str()), |(name, said)| (Some(format!("'{name}'")), said));
        match out.iter_mut().find(|(names, other)| other == said && names.is_empty() == name.is_none()) {
            Some((names, _)) => names.extend(name.filter(|name| !names.contains(name))),
            None => out.push((name.into_iter().collect(), said.to_owned())),
        }
    }
    let told = |(names, said): (Vec<String>, String)| match names.as_slice() {
        [] => said,
        [one] => format!("recording {one}: {said}"),
        several => format!("recordings {}: {said}", several.join(", ")),
    };
    out.into_iter().map(told).collect()
}

/// What is said of a slip below zero.
const NO_SLIP: &str = ", below zero: the body gets ahead of its wheels the more, the faster, which slip does not do; look at \
                       track, tyres and clocks";

/// "0.0842 ± 0.0003 m", with two digits of the interval.
fn number(e: &Estimate) -> String {
    let unit = if e.unit == "1" { String::new() } else { format!(" {}", e.unit) };
    let digits = two_decimals(e.half_width);
    format!("{:.digits$} ± {:.digits$}{unit} (90 %)", e.value, e.half_width)
}

/// Tells a factor on counts that is a familiar one.
fn familiar(named: &NamedCause) -> String {
    let Some(first) = named.estimates.first() else { return String::new() };
    let factor = first.value / first.given;
    let near = SETTINGS.naming.factors.iter().find(|f| (factor / **f).ln().abs() < SETTINGS.naming.familiar);
    near.map_or_else(String::new, |near| {
        format!(
            ", which is the factor {near:.3}: look at counts per turn (edges that are counted), gear, or diameter for radius"
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use catalogue::answer::UNKNOWN;

    /// An answer of which all else is yet to be told.
    fn found<'a>(answer: Answer) -> Found<'a> {
        Found {
            answer,
            named: &[],
            others: &[],
            constants: &[],
            retuned: &[],
            rival: None,
            shares: [0.3, 0.2, 0.1],
            beside_references: None,
            beside_usual: None,
            unconfirmed: None,
            unknown: Unaccounted::Left { of_references: None },
        }
    }

    #[test]
    fn a_cause_that_is_likelier_than_none_and_not_named_leads() {
        let told = |answer, probability| {
            let others = [("pose_origin".to_owned(), probability)];
            Found { others: &others, ..found(answer) }.undecided()
        };
        let leads = told(Answer::Retune, 0.7).expect("a sentence");
        assert!(
            leads.contains("place of the pose's origin in the robot has a probability of 0.70, nothing one of 0.30"),
            "{leads}"
        );
        assert_eq!([told(Answer::Retune, 0.4), told(Answer::Named, 0.7)], [None, None]);

        let begins = |probability| {
            let others = [("pose_origin".to_owned(), probability)];
            Found { others: &others, ..found(Answer::Nothing) }.nothing()
        };
        assert_eq!([begins(0.7), begins(0.4)], ["If nothing is missing,", "Nothing is missing:"]);
    }

    #[test]
    fn what_is_likelier_than_not_and_too_little_to_be_named_is_told_beside_what_is_named() {
        let others = [("pose_origin".to_owned(), 0.6), ("steering_zero (front)".to_owned(), 0.2)];
        let told = |answer| Found { others: &others, ..found(answer) }.perhaps();
        let named = told(Answer::Named).expect("a sentence");
        assert!(named.ends_with("named: place of the pose's origin in the robot (0.60)."), "{named}");
        assert_eq!(told(Answer::Nothing), None);
    }

    #[test]
    fn what_several_recordings_share_is_told_once() {
        let told = ["recording 'a': x is guessed", "recording 'b': x is guessed", "recording 'b': y", "z", "z"];
        let merged = of_recordings(told.map(str::to_owned));
        assert_eq!(merged, ["recordings 'a', 'b': x is guessed", "recording 'b': y", "z"]);
    }

    #[test]
    fn what_leaves_more_than_references_do_is_doubted_and_told() {
        let doubted = |left: f64, usual: Option<f64>| {
            let beside_references = usual.map(|usual| [left, usual]);
            let told = Found { shares: [left; 3], beside_references, ..found(Answer::Nothing) };
            let ranked = told.verdict(Vec::new()).ranked;
            let total: f64 = ranked.iter().map(|c| c.probability).sum();
            approx::assert_relative_eq!(total, 1.0, epsilon = 1e-12);
            let unknown = ranked.into_iter().find(|c| c.effect == UNKNOWN.id);
            assert_eq!(told.nothing() == "Nothing is missing:", told.doubted().is_none());
            (unknown.map_or(0.0, |c| c.probability), told.doubted())
        };
        let (unknown, told) = doubted(0.02, Some(0.006));
        approx::assert_relative_eq!(unknown, 0.45 * (0.02 / 0.006 - 2.0) / 2.0, epsilon = 1e-12);
        assert!(told.is_some_and(|t| {
            t.contains("2.0 % of the motion are left of the recordings and 0.6 % of the references, 3.3")
        }));
        assert_eq!(doubted(0.02, Some(0.012)), (0.0, None), "it is usual");
        let by_usual = |left: f64| Found { beside_usual: Some([left, 0.03]), ..found(Answer::Retune) };
        approx::assert_relative_eq!(by_usual(0.045).doubt(), 0.225, epsilon = 1e-12);
        assert!(by_usual(0.045).doubted().is_some_and(|told| told.contains("sound robots leave less than 3.0 %")));
        assert_eq!((by_usual(0.02).doubt(), by_usual(0.02).doubted()), (0.0, None));
        assert_eq!(doubted(0.003, Some(0.001)), (0.0, None), "it is next to nothing");
        assert_eq!(doubted(0.02, None), (0.0, None));
    }

    #[test]
    fn what_was_re_tuned_is_told_beside_what_is_named_and_candidates_of_the_unknown_are_called_so() {
        let estimate = |name: &str, sigmas: f64| Estimate {
            name: name.to_owned(),
            unit: "m",
            given: 1.0,
            value: 1.0 + 0.1 * sigmas,
            half_width: 0.05,
            sigmas,
        };
        let named = [NamedCause {
            spec: &catalogue::odometry::STEERING_ZERO,
            label: "steering_zero (front)".to_owned(),
            probability: 0.99,
            alike: Vec::new(),
            estimates: vec![estimate("zero", 9.0)],
            intervals: Vec::new(),
            onset: None,
        }];
        let constants = [estimate("zero", 9.0), estimate("still", 0.1), estimate("near", 1.0), estimate("far", 2.0)];
        let words = Wording {
            agree: "both agree",
            disagree: "Both disagree",
            errors: "errors",
            machine: "robot",
            conditions: "floor",
            most: 0.5,
            scales: &[],
            has_references: false,
        };
        let told = |answer| {
            let found = Found { named: &named, constants: &constants, ..found(answer) };
            found.sentences(&words, &found.verdict(Vec::new()))
        };
        assert_eq!(
            told(Answer::Named),
            [
                "Both disagree by more than the robot file leaves open: zero of the steering (front) (errors: 30.0 % of the motion, \
                 20.0 % re-tuned, 10.0 % with what is named).",
                "Zero of the steering (front): zero 1.900 ± 0.050 m (90 %), given as 1.0000.",
                "Constants that were re-tuned as well, within what the robot file leaves open, the farthest first: far from 1.000 m to 1.200 ± 0.050 m \
                 (90 %); near from 1.000 m to 1.100 ± 0.050 m (90 %)."
            ]
        );
        assert!(told(Answer::Unknown)[1].starts_with("Candidate only: "));

        let re_tuned = |sigmas: f64| {
            let retuned = [estimate("far", sigmas)];
            Found { retuned: &retuned, ..found(Answer::Retune) }.headline(&words)
        };
        assert!(re_tuned(2.0).contains("both agree once constants are set within what the robot file leaves open"));
        assert!(re_tuned(3.84).contains("once constants are set up to 3.8 sigmas from the robot file"));
    }
}
