//! How large, where and when: what is said about each hidden effect.

use std::collections::BTreeMap;

use case_files::answers::AnswerCause;
use examiner::{EffectTruth, Truth};
use report::words::NINETY;
use serde::Serialize;

use super::statistics::mean;
use super::{FIRST, RankedAnswer};

/// Step of time in which presence is compared, s.
const STEP: f64 = 0.02;
/// The place of an effect that began at an instant and stayed.
const FROM_AN_INSTANT: &str = "time";

/// A hidden effect and what is said about it. An effect that is not among the first three named has no size and no side,
/// and its place is not found.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(in crate::blind) struct Part {
    pub(in crate::blind) effect: String,
    /// Among the first three that are named.
    pub(in crate::blind) named: bool,
    /// Error of the size relative to the true one.
    pub(in crate::blind) size_error: Option<f64>,
    /// Whether the 90 % interval of the size holds the true one.
    pub(in crate::blind) size_held: Option<bool>,
    pub(in crate::blind) side_right: Option<bool>,
    /// Intersection over union of the times at which it was present, mean over the recordings; of local effects.
    pub(in crate::blind) overlap: Option<f64>,
    /// Distance of the instants from which it was present, s; one for each recording in which one is reported.
    pub(in crate::blind) onset_errors: Vec<f64>,
    /// Recordings in which it began at an instant.
    pub(in crate::blind) onsets: usize,
}

/// Intervals by recording, s.
type Intervals = BTreeMap<String, Vec<[f64; 2]>>;

/// Every hidden effect with what is said about it.
/// Recordings last `duration` seconds.
pub(super) fn parts(truth: &Truth, duration: f64, answer: RankedAnswer<'_>) -> Vec<Part> {
    let first: Vec<&str> = answer.named().into_iter().take(FIRST).collect();
    let one = |e: &EffectTruth| {
        let entry = answer.ranked.iter().find(|c| c.effect == e.id && first.contains(&c.effect.as_str()));
        let when: Intervals = truth
            .recordings
            .iter()
            .filter_map(|(run, r)| r.intervals_s.get(&e.id).map(|spans| (run.clone(), spans.clone())))
            .collect();
        part(e, &when, duration, entry.copied())
    };
    truth.effects.iter().map(one).collect()
}

fn part(hidden: &EffectTruth, when: &Intervals, duration: f64, entry: Option<&AnswerCause>) -> Part {
    let size = entry.and_then(|c| c.magnitude);
    let reported = entry.and_then(|c| c.intervals.as_ref());
    let from_an_instant = hidden.place.as_deref() == Some(FROM_AN_INSTANT);
    let starts = when.iter().filter(|_| from_an_instant).filter_map(|(run, spans)| Some((run, spans.first()?[0])));
    Part {
        effect: hidden.id.clone(),
        named: entry.is_some(),
        size_error: size.map(|m| ((m - hidden.magnitude) / hidden.magnitude).abs()),
        size_held: size
            .zip(entry.and_then(|c| c.sigma))
            .map(|(m, sigma)| (m - hidden.magnitude).abs() <= NINETY * sigma),
        side_right: hidden.side.as_ref().and_then(|side| Some(entry?.side.as_ref() == Some(side))),
        overlap: if when.is_empty() { None } else { overlap(when, duration, reported) },
        onset_errors: starts
            .clone()
            .filter_map(|(run, start)| Some((reported?.get(run)?.first()?[0] - start).abs()))
            .collect(),
        onsets: starts.count(),
    }
}

/// Mean over the recordings in which either says that the effect was there; 0 where nothing is reported at all.
fn overlap(when: &Intervals, duration: f64, reported: Option<&Intervals>) -> Option<f64> {
    let Some(reported) = reported else { return Some(0.0) };
    let ratios: Vec<f64> = when
        .iter()
        .filter_map(|(run, spans)| in_time(duration, spans, reported.get(run).map_or(&[], Vec::as_slice)))
        .collect();
    mean(&ratios)
}

/// Intersection over union of two sets of intervals, if either holds an instant of a recording.
fn in_time(duration: f64, a: &[[f64; 2]], b: &[[f64; 2]]) -> Option<f64> {
    let inside = |spans: &[[f64; 2]], t: f64| spans.iter().any(|[from, until]| *from <= t && t < *until);
    let (mut both, mut either) = (0_usize, 0_usize);
    for step in 0..(duration / STEP).ceil() as usize {
        let t = step as f64 * STEP;
        let (a, b) = (inside(a, t), inside(b, t));
        both += usize::from(a && b);
        either += usize::from(a || b);
    }
    (either > 0).then(|| both as f64 / either as f64)
}

#[cfg(test)]
mod tests {
    use super::super::testing::cause;
    use super::*;

    fn hidden(fields: &str) -> EffectTruth {
        let text = format!(r#"{{"id": "e", "severity": 1, "excess": 2.0, {fields}}}"#);
        serde_json::from_str(&text).expect("an effect")
    }

    fn spans(list: &[(&str, [f64; 2])]) -> Intervals {
        list.iter().map(|(run, span)| ((*run).to_owned(), vec![*span])).collect()
    }

    #[test]
    fn overlap_is_intersection_over_union() {
        // Steps at 0, 0.02, ...: [1, 3) holds 100, [2, 5) 150, both 50, either 200.
        assert_eq!(in_time(24.0, &[[1.0, 3.0]], &[[2.0, 5.0]]), Some(0.25));
        assert_eq!(in_time(24.0, &[[1.0, 2.0], [3.0, 4.0]], &[[1.0, 2.0], [3.0, 4.0]]), Some(1.0));
        assert_eq!((in_time(24.0, &[[0.0, 1.0]], &[]), in_time(24.0, &[], &[])), (Some(0.0), None));
        assert_eq!(in_time(2.0, &[[1.0, 2.0]], &[[1.0, 9.0]]), Some(1.0), "nothing is after the end");
        let when = spans(&[("run_1", [1.0, 3.0]), ("run_2", [0.0, 2.0])]);
        // Where nothing is reported for a recording, nothing of it is found.
        assert_eq!(overlap(&when, 24.0, Some(&spans(&[("run_1", [2.0, 5.0])]))), Some(0.125));
        assert_eq!(overlap(&when, 24.0, None), Some(0.0));
    }

    #[test]
    fn sizes_sides_and_onsets_are_compared() {
        let truth = hidden(r#""side": "left", "magnitude": -2.0, "where": "time""#);
        let when = spans(&[("run_1", [6.0, 24.0]), ("run_2", [8.0, 24.0])]);
        let mut reported = cause("e", 0.9);
        reported.magnitude = Some(-2.5);
        reported.sigma = Some(0.25);
        reported.side = Some("right".to_owned());
        reported.intervals = Some(spans(&[("run_1", [6.5, 24.0])]));
        let p = part(&truth, &when, 24.0, Some(&reported));
        assert_eq!((p.size_error, p.size_held, p.side_right), (Some(0.25), Some(false), Some(false)));
        assert_eq!((p.onset_errors.as_slice(), p.onsets), ([0.5].as_slice(), 2));
        reported.sigma = Some(0.31);
        assert_eq!(part(&truth, &when, 24.0, Some(&reported)).size_held, Some(true));
        let p = part(&truth, &when, 24.0, None);
        assert_eq!((p.named, p.size_error, p.side_right, p.overlap), (false, None, None, Some(0.0)));
        assert_eq!((p.onset_errors.len(), p.onsets), (0, 2));
        let p = part(&hidden(r#""side": null, "magnitude": 1.0, "where": "patch""#), &when, 24.0, Some(&reported));
        assert_eq!((p.side_right, p.onsets), (None, 0));
        assert_eq!(part(&truth, &Intervals::new(), 24.0, Some(&reported)).overlap, None);
    }
}
