//! Scores of many cases.

use super::score::statistics::Rate;
use super::score::{Kind, Part, Row, bins, expected_error};

/// Bins in which confidence is compared with what is right.
pub(super) const BINS: usize = 5;

/// Scores of a part of the cases. Rates count the cases of which something can be said.
#[derive(Debug, Clone, Default)]
pub(super) struct Totals {
    pub(super) cases: usize,
    pub(super) right: Rate,
    pub(super) class: Rate,
    /// Pairs.
    pub(super) one_of_pair: Rate,
    pub(super) both_of_pair: Rate,
    /// All three of those with three, in the 90 % set.
    pub(super) three_in_set: Rate,
    /// An effect that is not hidden is told to be there.
    pub(super) invented: Rate,
    pub(super) in_set: Rate,
    pub(super) set_sizes: Vec<f64>,
    /// Cases with nothing hidden whose verdict is something else.
    pub(super) alarmed: Rate,
    /// Effects of the vocabulary.
    pub(super) missed: Rate,
    pub(super) called_unknown: Rate,
    pub(super) outsiders_unknown: Rate,
    pub(super) sort: Rate,
    pub(super) side: Rate,
    pub(super) overlaps: Vec<f64>,
    pub(super) onset_errors: Vec<f64>,
    pub(super) onsets_reported: Rate,
    pub(super) size_errors: Vec<f64>,
    pub(super) size_held: Rate,
    pub(super) briers: Vec<f64>,
    pub(super) calibration_error: Option<f64>,
    /// Wheel speed, yaw rate.
    pub(super) closed: [Vec<f64>; 2],
    pub(super) closed_from_own: [Vec<f64>; 2],
    pub(super) worse: [Rate; 2],
    /// Cases with nothing hidden.
    pub(super) over_calibrated: [Vec<f64>; 2],
    /// By the clock.
    pub(super) seconds: Vec<f64>,
    /// On one core, whatever else the machine does; by the clock where the system does not tell.
    pub(super) core_seconds: Vec<f64>,
    /// MiB.
    pub(super) memory: Vec<f64>,
}

impl Totals {
    pub(super) fn of(rows: &[&Row]) -> Self {
        let of_kind = |kinds: &'static [Kind]| rows.iter().filter(move |r| kinds.contains(&r.kind));
        let (nulls, pairs) = (of_kind(&[Kind::Null]), of_kind(&[Kind::Pair]));
        let hidden = of_kind(&[Kind::Single, Kind::Pair, Kind::Triple]);
        let parts = || rows.iter().flat_map(|r| &r.parts);
        let some = |f: &dyn Fn(&Part) -> Option<f64>| parts().filter_map(f).collect::<Vec<f64>>();
        let errors = |r: &Part| r.onset_errors.clone();
        let reported: usize = parts().map(|p| p.onset_errors.len()).sum();
        let onsets: usize = parts().map(|p| p.onsets).sum();
        // Of drives on which what is hidden makes a difference.
        let gaps = |f: &dyn Fn(&Row) -> Option<f64>| hidden.clone().filter_map(|r| f(r)).collect::<Vec<f64>>();
        Self {
            cases: rows.len(),
            right: rows.iter().map(|r| r.naming.right).collect(),
            class: rows.iter().map(|r| r.naming.class).collect(),
            one_of_pair: pairs.clone().map(|r| r.naming.any_in_three).collect(),
            both_of_pair: pairs.map(|r| r.naming.all_in_three).collect(),
            three_in_set: of_kind(&[Kind::Triple]).map(|r| r.belief.in_set).collect(),
            invented: rows.iter().map(|r| r.naming.invented).collect(),
            in_set: rows.iter().map(|r| r.belief.in_set).collect(),
            set_sizes: rows.iter().map(|r| r.belief.set_size as f64).collect(),
            alarmed: nulls.clone().map(|r| !r.naming.right).collect(),
            missed: hidden.clone().map(|r| r.verdict == Some("no mismatch")).collect(),
            called_unknown: hidden.clone().map(|r| r.verdict == Some("unknown")).collect(),
            outsiders_unknown: of_kind(&[Kind::Outsider]).map(|r| r.naming.right).collect(),
            sort: rows.iter().filter_map(|r| r.naming.sort).collect(),
            side: parts().filter_map(|p| p.side_right).collect(),
            overlaps: some(&|p| p.overlap),
            onset_errors: parts().flat_map(errors).collect(),
            onsets_reported: Rate { hits: reported, count: onsets },
            size_errors: some(&|p| p.size_error),
            size_held: parts().filter_map(|p| p.size_held).collect(),
            briers: rows.iter().map(|r| r.belief.brier).collect(),
            calibration_error: expected_error(&bins(rows, BINS)),
            closed: [0, 1].map(|of| gaps(&|r| r.heldout.closed(of))),
            closed_from_own: [0, 1].map(|of| gaps(&|r| r.heldout.closed_from_own(of))),
            worse: [0, 1].map(|of| rows.iter().filter_map(|r| r.heldout.worse(of)).collect()),
            over_calibrated: [0, 1].map(|of| nulls.clone().filter_map(|r| r.heldout.over_calibrated(of)).collect()),
            seconds: rows.iter().filter_map(|r| r.seconds).collect(),
            core_seconds: rows.iter().filter_map(|r| r.processor_seconds.or(r.seconds)).collect(),
            memory: rows.iter().filter_map(|r| r.peak_memory).map(|b| b as f64 / f64::from(1 << 20)).collect(),
        }
    }

    /// Sizes that are off by less than a quarter.
    pub(super) fn size_within_quarter(&self) -> Rate {
        self.size_errors.iter().map(|e| *e < 0.25).collect()
    }
}
