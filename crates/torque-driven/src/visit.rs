//! Visits: drives of one day, place and load. Within a visit constants stay; between visits they may move.

use crate::run::Run;
use crate::settings::decision::{MovesBetweenVisits, SETTINGS};

const MOVES: MovesBetweenVisits = SETTINGS.moves;

/// The visit that a run is of.
///
/// Runs of the same name are of the same visit, references and recordings alike. Runs without one are of one visit of their
/// own, references of another than recordings.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Visit {
    /// Its name.
    pub name: String,
    /// How it is known.
    pub known_by: KnownBy,
}

/// How it is known which runs are of one visit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum KnownBy {
    /// The user said it.
    User,
    /// Their files lie in one folder, and others in others.
    Folder,
    /// They were started within hours of each other, and others were not.
    StartTime,
}

impl KnownBy {
    /// In words.
    fn words(self) -> &'static str {
        match self {
            Self::User => "as --visit says",
            Self::Folder => "by the folders in which the files lie",
            Self::StartTime => "by the times at which the drives were started",
        }
    }
}

/// What tells one visit from another.
#[derive(Clone, Copy, PartialEq)]
enum Key<'a> {
    Named(&'a str),
    /// Of runs without a name: whether they are references.
    Unnamed(bool),
}

impl<'a> Key<'a> {
    fn of(visit: Option<&'a Visit>, is_reference: bool) -> Self {
        visit.map_or(Self::Unnamed(is_reference), |visit| Self::Named(&visit.name))
    }
}

/// The visits of runs.
pub(crate) fn visits_of(runs: &[Run]) -> Vec<Option<Visit>> {
    runs.iter().map(|run| run.visit.clone()).collect()
}

/// Which visit each reference and each recording is of: those of the references have the first numbers.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct VisitNumbers {
    /// Of each reference.
    pub(crate) references: Vec<usize>,
    /// Of each recording.
    pub(crate) recordings: Vec<usize>,
    /// How many visits the references are of.
    pub(crate) known: usize,
}

impl VisitNumbers {
    /// Numbers the visits in the order in which they come.
    pub(crate) fn new(references: &[Option<Visit>], recordings: &[Option<Visit>]) -> Self {
        let mut seen = Vec::new();
        let references = numbered(&mut seen, references, true);
        let known = seen.len();
        let recordings = numbered(&mut seen, recordings, false);
        Self { references, recordings, known }
    }

    /// Visits of the recordings that no reference is of, each once.
    pub(crate) fn new_ones(&self) -> Vec<usize> {
        distinct(self.recordings.iter().copied().filter(|&visit| visit >= self.known))
    }

    /// Visits of the recordings that references are of too, each once.
    pub(crate) fn shared(&self) -> Vec<usize> {
        distinct(self.recordings.iter().copied().filter(|&visit| visit < self.known))
    }
}

fn numbered<'a>(seen: &mut Vec<Key<'a>>, runs: &'a [Option<Visit>], are_references: bool) -> Vec<usize> {
    let number = |visit: &'a Option<Visit>| {
        let key = Key::of(visit.as_ref(), are_references);
        seen.iter().position(|other| *other == key).unwrap_or_else(|| {
            seen.push(key);
            seen.len() - 1
        })
    };
    runs.iter().map(number).collect()
}

fn distinct(numbers: impl Iterator<Item = usize>) -> Vec<usize> {
    let mut out: Vec<usize> = numbers.collect();
    out.sort_unstable();
    out.dedup();
    out
}

/// A sentence on the visits that were assumed; `None` where nobody named any and none was found.
///
/// `factor`: by how much constants move between visits, in what is usual; `None` where no references of several visits
/// taught it.
pub(crate) fn sentence(
    references: &[Option<Visit>],
    recordings: &[Option<Visit>],
    factor: Option<f64>,
) -> Option<String> {
    let named = references.iter().chain(recordings).flatten();
    let mut known_by: Vec<KnownBy> = named.map(|visit| visit.known_by).collect();
    known_by.sort_unstable();
    known_by.dedup();
    if known_by.is_empty() {
        return None;
    }

    let numbers = VisitNumbers::new(references, recordings);
    let how: Vec<&str> = known_by.into_iter().map(KnownBy::words).collect();
    let compared = if references.is_empty() {
        format!("the recordings are of {}", listed(recordings, false))
    } else {
        format!("the references are of {}, the recordings of {}", listed(references, true), listed(recordings, false))
    };
    Some(format!(
        "visits (drives of one day, place and load): {compared}, {}; {}",
        how.join(" and "),
        consequence(&numbers, references.is_empty(), factor)
    ))
}

/// What follows from the visits for the constants.
fn consequence(numbers: &VisitNumbers, without_references: bool, factor: Option<f64>) -> String {
    let new_ones = numbers.new_ones().len();
    if without_references {
        return if new_ones > 1 {
            "constants may differ between these visits".to_owned()
        } else {
            "constants are the same in all of them".to_owned()
        };
    }
    if new_ones == 0 {
        return "constants are taken to be the same in references and recordings of one visit, so that one that differs is \
                told as a cause"
            .to_owned();
    }
    let far = factor.map_or_else(
        || "by as much as is usual".to_owned(),
        |factor| format!("{factor:.1} times as far as is usual, as those of the references did"),
    );
    format!("constants may have moved between visits, {far}")
}

/// The visits of runs by name, with the number of drives in each.
fn listed(of_runs: &[Option<Visit>], are_references: bool) -> String {
    let mut visits: Vec<(Key<'_>, usize)> = Vec::new();
    for visit in of_runs {
        let key = Key::of(visit.as_ref(), are_references);
        match visits.iter_mut().find(|(other, _)| *other == key) {
            Some((_, drives)) => *drives += 1,
            None => visits.push((key, 1)),
        }
    }
    let name = |key: &Key<'_>| match key {
        Key::Named(name) => format!("'{name}'"),
        Key::Unnamed(_) => "one without a name".to_owned(),
    };
    if let [(key, _)] = &visits[..] {
        return format!("one visit ({})", name(key));
    }
    let each = |(key, drives): &(Key<'_>, usize)| {
        format!("{}: {drives} {}", name(key), if *drives == 1 { "drive" } else { "drives" })
    };
    let shown: Vec<String> = visits.iter().take(MOVES.listed).map(each).collect();
    let rest = if visits.len() > MOVES.listed { ", ..." } else { "" };
    format!("{} visits ({}{rest})", visits.len(), shown.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn visit(name: &str, known_by: KnownBy) -> Visit {
        Visit { name: name.to_owned(), known_by }
    }

    fn of_user(visits: &[Option<&str>]) -> Vec<Option<Visit>> {
        visits.iter().map(|name| name.map(|name| visit(name, KnownBy::User))).collect()
    }

    #[test]
    fn runs_without_a_name_are_one_visit_and_references_another_than_recordings() {
        let numbers = VisitNumbers::new(&of_user(&[None, None]), &of_user(&[None, None]));
        assert_eq!((numbers.references.as_slice(), numbers.recordings.as_slice()), (&[0, 0][..], &[1, 1][..]));
        assert_eq!((numbers.new_ones(), numbers.shared()), (vec![1], Vec::new()));
    }

    #[test]
    fn a_name_joins_references_and_recordings() {
        let numbers =
            VisitNumbers::new(&of_user(&[Some("a"), Some("b"), None]), &of_user(&[Some("b"), Some("c"), None]));
        assert_eq!(numbers.references, [0, 1, 2]);
        assert_eq!(numbers.recordings, [1, 3, 4], "those without a name are no references without a name");
        assert_eq!((numbers.new_ones(), numbers.shared()), (vec![3, 4], vec![1]));
    }

    #[test]
    fn the_sentence_says_which_visits_were_assumed_and_what_follows() {
        assert_eq!(sentence(&of_user(&[None]), &of_user(&[None]), None), None);

        let one = of_user(&[Some("today"), Some("today")]);
        let same = sentence(&one, &one, None).expect("visits were named");
        assert!(same.contains("the references are of one visit ('today')"), "{same}");
        assert!(same.contains("as --visit says") && same.contains("the same in references and recordings"), "{same}");

        let days = ["monday", "monday", "tuesday"].map(|day| Some(visit(day, KnownBy::Folder)));
        let taught = sentence(&days, &of_user(&[None]), Some(1.84)).expect("visits were found");
        assert!(taught.contains("2 visits ('monday': 2 drives, 'tuesday': 1 drive)"), "{taught}");
        assert!(taught.contains("one visit (one without a name), by the folders"), "{taught}");
        assert!(taught.contains("1.8 times as far as is usual"), "{taught}");

        let alone = sentence(&[], &days, None).expect("visits were found");
        assert!(alone.contains("constants may differ between these visits"), "{alone}");
    }
}
