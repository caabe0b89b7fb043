//! What a list of events is worth beside the truth.

use std::collections::BTreeSet;

use examiner::Truth;
use serde::Serialize;
use verdict::Diagnosis;

/// Length of a window, s.
const WINDOW: f64 = 0.1;

/// Events told beside events hidden.
#[derive(Debug, Clone, Serialize)]
pub(super) struct EventScore {
    /// Whether a list was told.
    pub(super) told: bool,
    /// Whether the sides told are those hidden.
    pub(super) side_right: bool,
    /// Windows of a side with an event: hidden, told, both.
    pub(super) windows: [usize; 3],
}

/// A window of a side of a recording.
type Window = (String, String, usize);

/// Windows whose middle lies in an interval.
fn windows(recording: &str, side: &str, [from, until]: [f64; 2]) -> impl Iterator<Item = Window> {
    let at = |t: f64| (t / WINDOW - 0.5).ceil().max(0.0) as usize;
    let (recording, side) = (recording.to_owned(), side.to_owned());
    (at(from)..at(until)).map(move |w| (recording.clone(), side.clone(), w))
}

/// Scores what was told of short events, window by window.
pub(super) fn score(truth: &Truth, d: &Diagnosis) -> EventScore {
    let mut hidden: BTreeSet<Window> = BTreeSet::new();
    for (recording, r) in &truth.recordings {
        for (of, times) in &r.intervals_s {
            let side = of.rsplit('_').next().unwrap_or_default();
            hidden.extend(times.iter().flat_map(|span| windows(recording, side, *span)));
        }
    }
    let mut told: BTreeSet<Window> = BTreeSet::new();
    let events = d.law.as_ref().and_then(|l| l.events.as_ref());
    for e in events.into_iter().flat_map(|found| &found.events) {
        let side = e.input.rsplit(' ').next().unwrap_or_default();
        told.extend(windows(&e.recording, side, [e.from, e.until]));
    }
    let sides = |all: &BTreeSet<Window>| all.iter().map(|(_, side, _)| side.clone()).collect::<BTreeSet<String>>();
    EventScore {
        told: events.is_some(),
        side_right: sides(&hidden) == sides(&told),
        windows: [hidden.len(), told.len(), hidden.intersection(&told).count()],
    }
}

#[cfg(test)]
mod tests {
    use super::windows;

    #[test]
    fn a_window_counts_where_its_middle_does() {
        let of = |span| windows("run", "left", span).map(|(.., w)| w).collect::<Vec<_>>();
        assert_eq!(of([0.0, 0.2]), [0, 1]);
        assert_eq!(of([0.04, 0.26]), [0, 1, 2], "0.05, 0.15 and 0.25 lie within");
        assert_eq!(of([0.06, 0.24]), [1]);
    }
}
