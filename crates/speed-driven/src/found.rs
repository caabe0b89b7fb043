//! Causes that were measured where and when they are present, beside those that the loads of whole recordings name.

use std::collections::BTreeMap;

use catalogue::answer::NONE;
use catalogue::speed_driven::STANDING;
use verdict::{Cause, Diagnosis, Loads, Standstill, Verdict};

use crate::settings::{NAMING, naming::Answer};

const ANSWER: Answer = NAMING.answer;

/// Adds what was found, the strongest last to be first; the verdict follows.
pub(crate) fn add(out: &mut Diagnosis, loads: &Loads) {
    if let Some(cause) = standing(&loads.standstills) {
        if out.verdict != Verdict::Explained {
            out.indistinguishable.clear();
        }
        out.indistinguishable.insert(0, vec![cause.effect.clone()]);
        insert(out, cause);
    }
}

/// The stretch in which a body stood longest.
pub(crate) fn longest(all: &[Standstill]) -> Option<&Standstill> {
    let seconds = |s: &Standstill| s.interval[1] - s.interval[0];
    all.iter().max_by(|a, b| seconds(a).total_cmp(&seconds(b)))
}

fn standing(all: &[Standstill]) -> Option<Cause> {
    let longest = longest(all)?;
    let intervals = by_recording(all.iter().map(|s| (s.recording.as_str(), s.interval)));
    Some(Cause {
        magnitude: Some(longest.share),
        intervals: Some(intervals),
        ..Cause::plain(STANDING.id, STANDING.name, ANSWER.standing)
    })
}

fn by_recording<'a>(all: impl Iterator<Item = (&'a str, [f64; 2])>) -> BTreeMap<String, Vec<[f64; 2]>> {
    let mut out: BTreeMap<String, Vec<[f64; 2]>> = BTreeMap::new();
    for (recording, interval) in all {
        out.entry(recording.to_owned()).or_default().push(interval);
    }
    out
}

/// Ranks a cause that was measured. That nothing is missing is then no likelier than that it is not there.
fn insert(out: &mut Diagnosis, cause: Cause) {
    let left = 1.0 - cause.probability;
    for none in out.ranked.iter_mut().filter(|c| c.effect == NONE.id) {
        none.probability = none.probability.min(left);
    }
    out.ranked.retain(|c| c.effect != cause.effect);
    out.ranked.push(cause);
    out.ranked.sort_by(|a, b| b.probability.total_cmp(&a.probability));
    out.verdict = Verdict::Explained;
}
