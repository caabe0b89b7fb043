//! How an answer is counted, in the words of the verdict.

use std::collections::{BTreeMap, BTreeSet};

use inference::rate::Rate;
use verdict::{Answers, Cause, Diagnosis, FoundFrom, LookAlike, RehearsedSize, Verdict};

/// Answers that name no cause.
const NO_CAUSES: [&str; 2] = ["none", "unknown"];

/// Kinds of answers to a replica in which something, or nothing, was hidden.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// The hidden effect was named first.
    First,
    /// Another was named first, the hidden one beside it or in one class with another.
    InSet,
    /// Something that is not in the catalogue.
    Unknown,
    /// Nothing is missing.
    Nothing,
    /// Only others were named.
    Wrong,
    /// No answer.
    Withheld,
}

/// An answer as it is counted.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Scored {
    pub(crate) kind: Kind,
    /// Names other than the hidden effect's that the answer holds.
    pub(crate) others: BTreeSet<String>,
    /// Why there is no answer, where the diagnosis failed.
    pub(crate) failure: Option<String>,
}

impl Scored {
    /// A diagnosis that could not be made.
    pub(crate) fn failed(why: String) -> Self {
        Self { kind: Kind::Withheld, others: BTreeSet::new(), failure: Some(why) }
    }

    /// An answer that nothing is missing.
    pub(crate) fn nothing() -> Self {
        Self { kind: Kind::Nothing, others: BTreeSet::new(), failure: None }
    }

    /// Scores an answer; `hidden` is the effect that was hidden, if any.
    ///
    /// Named are the most probable cause, every cause that is more likely than not, and the members
    /// of their classes.
    pub(crate) fn new(answer: &Diagnosis, hidden: Option<&str>) -> Self {
        let without = |kind| Self { kind, others: BTreeSet::new(), failure: None };
        match answer.verdict {
            Verdict::NoMismatch => return Self::nothing(),
            Verdict::Unknown => return without(Kind::Unknown),
            Verdict::Withheld => return without(Kind::Withheld),
            Verdict::Explained => {}
        }

        let causes = || answer.ranked.iter().filter(|cause| !NO_CAUSES.contains(&cause.effect.as_str()));
        let first = causes().next().map(|cause| cause.effect.as_str());
        let is_likely = |cause: &&Cause| cause.probability > 0.5;
        let likely = causes().filter(is_likely).map(|cause| cause.effect.as_str());
        let alike = answer.indistinguishable.iter().flatten().map(String::as_str);
        let named: BTreeSet<&str> = likely.chain(first).chain(alike).collect();

        Self::of_names(first, named, hidden)
    }

    /// Scores names that an answer holds, one of them before the others.
    pub(crate) fn of_names(first: Option<&str>, named: BTreeSet<&str>, hidden: Option<&str>) -> Self {
        let kind = match hidden {
            Some(hidden) if first == Some(hidden) => Kind::First,
            Some(hidden) if named.contains(hidden) => Kind::InSet,
            _ => Kind::Wrong,
        };
        let others = named.into_iter().filter(|name| Some(*name) != hidden).map(str::to_owned).collect();
        Self { kind, others, failure: None }
    }
}

/// Counts answers.
pub(crate) fn count<'s>(all: impl IntoIterator<Item = &'s Scored>) -> Answers {
    let mut out = Answers::default();
    for scored in all {
        out.replicas += 1;
        let of_kind = match scored.kind {
            Kind::First => &mut out.first,
            Kind::InSet => &mut out.in_set,
            Kind::Unknown => &mut out.unknown,
            Kind::Nothing => &mut out.nothing,
            Kind::Wrong => &mut out.wrong,
            Kind::Withheld => &mut out.withheld,
        };
        *of_kind += 1;
        for other in &scored.others {
            *out.others.entry(other.clone()).or_default() += 1;
        }
        out.failures.extend(scored.failure.clone());
    }
    out.failures.sort_unstable();
    out.failures.dedup();
    out
}

/// Share of replicas whose answer holds the hidden effect, and its 95 % interval after Wilson.
pub(crate) fn share_found(answers: &Answers) -> [f64; 3] {
    let rate = Rate { hits: answers.found(), count: answers.replicas };
    let [low, high] = rate.interval();
    [rate.share().unwrap_or(0.0), low, high]
}

/// The smallest simulated size from which on at least the wanted share is found at every larger one
/// too. Nothing is interpolated: between the sizes nobody looked.
pub(crate) fn found_from(sizes: &[RehearsedSize], wanted: f64) -> FoundFrom {
    let found = sizes.iter().rev().take_while(|size| size.found[0] >= wanted).count();
    match sizes.get(sizes.len() - found) {
        None => FoundFrom::Never,
        Some(first) if found == sizes.len() => FoundFrom::Below(first.size),
        Some(first) => FoundFrom::Size(first.size),
    }
}

/// Other names in the answers that name anything, the most frequent first.
pub(crate) fn look_alikes(sizes: &[RehearsedSize]) -> Vec<LookAlike> {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for (name, count) in sizes.iter().flat_map(|size| &size.answers.others) {
        *counts.entry(name).or_default() += count;
    }
    let of = sizes.iter().map(|size| size.answers.found() + size.answers.wrong).sum();
    let mut out: Vec<LookAlike> =
        counts.into_iter().map(|(effect, count)| LookAlike { effect: effect.to_owned(), count, of }).collect();
    // By name among equals: the order of a map, which sorting keeps.
    out.sort_by_key(|alike| std::cmp::Reverse(alike.count));
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn answer(verdict: Verdict, ranked: &[(&str, f64)], classes: &[&[&str]]) -> Diagnosis {
        Diagnosis {
            verdict,
            ranked: ranked.iter().map(|(effect, p)| Cause::plain(effect, effect, *p)).collect(),
            indistinguishable: classes.iter().map(|c| c.iter().map(|m| (*m).to_owned()).collect()).collect(),
            ..Diagnosis::withheld()
        }
    }

    fn scored(verdict: Verdict, ranked: &[(&str, f64)], classes: &[&[&str]], hidden: Option<&str>) -> (Kind, String) {
        let scored = Scored::new(&answer(verdict, ranked, classes), hidden);
        (scored.kind, scored.others.into_iter().collect::<Vec<_>>().join(" "))
    }

    #[test]
    fn answers_are_counted_in_the_words_of_the_verdict() {
        let of = |verdict, ranked: &[(&str, f64)], classes: &[&[&str]]| scored(verdict, ranked, classes, Some("grade"));
        let explained = |ranked: &[(&str, f64)]| of(Verdict::Explained, ranked, &[]);
        assert_eq!(explained(&[("grade", 0.9), ("none", 0.1)]), (Kind::First, String::new()));
        assert_eq!(
            explained(&[("none", 0.3), ("grade", 0.2)]).0,
            Kind::First,
            "the first cause, whatever stands before"
        );
        assert_eq!(explained(&[("payload", 0.9), ("grade", 0.8)]), (Kind::InSet, "payload".to_owned()));
        assert_eq!(explained(&[("payload", 0.9), ("grade", 0.4)]), (Kind::Wrong, "payload".to_owned()));
        let class = of(Verdict::Explained, &[("payload", 0.9)], &[&["payload", "grade"]]);
        assert_eq!(class, (Kind::InSet, "payload".to_owned()));
        assert_eq!(of(Verdict::Unknown, &[("grade", 0.9)], &[]), (Kind::Unknown, String::new()));
        assert_eq!(of(Verdict::NoMismatch, &[("grade", 0.4)], &[]), (Kind::Nothing, String::new()));
        assert_eq!(of(Verdict::Withheld, &[], &[]), (Kind::Withheld, String::new()));
    }

    #[test]
    fn what_is_named_where_nothing_is_hidden_is_a_false_alarm() {
        let named = Scored::new(&answer(Verdict::Explained, &[("grade", 0.9)], &[]), None);
        let none = Scored::new(&answer(Verdict::NoMismatch, &[("none", 0.9)], &[]), None);
        let unknown = Scored::new(&answer(Verdict::Unknown, &[("unknown", 0.9)], &[]), None);
        let counted = count([&named, &none, &unknown, &Scored::failed("too short".to_owned())]);
        assert_eq!((counted.replicas, counted.alarmed(), counted.found()), (4, 2, 0));
        assert_eq!((counted.others["grade"], counted.failures.as_slice()), (1, ["too short".to_owned()].as_slice()));
    }

    fn sizes(found: &[usize]) -> Vec<RehearsedSize> {
        let one = |(place, first): (usize, &usize)| {
            let others = BTreeMap::from([("payload".to_owned(), 1), ("grade".to_owned(), place)]);
            let answers = Answers { replicas: 4, first: *first, wrong: 4 - first, others, ..Answers::default() };
            let found = share_found(&answers);
            RehearsedSize { multiple: 1.0, size: place as f64, answers, found, driven: 1.0 }
        };
        found.iter().enumerate().map(one).collect()
    }

    #[test]
    fn found_from_is_a_simulated_size_above_which_none_is_missed() {
        assert_eq!(found_from(&sizes(&[0, 1, 2, 4]), 0.5), FoundFrom::Size(2.0));
        assert_eq!(
            found_from(&sizes(&[3, 1, 2, 4]), 0.5),
            FoundFrom::Size(2.0),
            "luck at a small size counts for nothing"
        );
        assert_eq!(found_from(&sizes(&[2, 2, 4]), 0.5), FoundFrom::Below(0.0));
        assert_eq!(found_from(&sizes(&[4, 4, 1]), 0.5), FoundFrom::Never);
        assert_eq!(found_from(&[], 0.5), FoundFrom::Never);
    }

    #[test]
    fn shares_carry_wilsons_interval() {
        let [share, low, high] = share_found(&Answers { replicas: 10, first: 6, in_set: 2, ..Answers::default() });
        assert!(share == 0.8 && (low - 0.4902).abs() < 5e-5 && (high - 0.9433).abs() < 5e-5);
    }

    #[test]
    fn look_alikes_come_by_frequency() {
        let alike = look_alikes(&sizes(&[0, 4, 4, 4]));
        let listed: Vec<_> = alike.iter().map(|a| (a.effect.as_str(), a.count, a.of)).collect();
        assert_eq!(listed, [("grade", 6, 16), ("payload", 4, 16)]);
    }
}
