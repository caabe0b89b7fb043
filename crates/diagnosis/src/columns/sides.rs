//! Two columns, left and right, held against what they must show.

use std::array::from_fn;

use recordings::{Recording, Signal, parse_unit};
use robot_model::Robot;

use super::motion::{Sides, combined, likeness};
use crate::settings::{Columns, SETTINGS};
use inference::robust::mean;

const COLUMNS: Columns = SETTINGS.columns;

/// `gyro_z (column 'wz')`.
pub(super) fn named(recording: &Recording, signal: Signal) -> String {
    let column = recording.get(signal).map_or("", |channel| channel.column());
    format!("{signal} (column '{column}')")
}

pub(super) fn both(recording: &Recording, [a, b]: [Signal; 2]) -> String {
    format!("{} and {}", named(recording, a), named(recording, b))
}

/// What can be wrong with the columns of two sides.
const MISTAKES: [Mistake; 6] = [
    Mistake { exchanged: false, signs: [-1.0, 1.0] },
    Mistake { exchanged: false, signs: [1.0, -1.0] },
    Mistake { exchanged: false, signs: [-1.0, -1.0] },
    Mistake { exchanged: true, signs: [1.0, 1.0] },
    Mistake { exchanged: true, signs: [-1.0, 1.0] },
    Mistake { exchanged: true, signs: [1.0, -1.0] },
];

/// Columns of two sides as they may have been mapped by mistake.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Mistake {
    exchanged: bool,
    /// Signs of what is mapped to left and right.
    signs: [f64; 2],
}

impl Mistake {
    const NONE: Self = Self { exchanged: false, signs: [1.0; 2] };

    /// The columns as they would be without this mistake.
    fn undone(self, shown: &Sides) -> Sides {
        from_fn(|side| {
            let from = if self.exchanged { 1 - side } else { side };
            shown[from].iter().map(|v| self.signs[from] * v).collect()
        })
    }

    /// How well the columns show what they must, were this the mistake: mean cosine of the sums of both sides, and of
    /// their differences, of those of the two in which anything moves.
    fn cosine(self, shown: &Sides, expected: &Sides, least: f64) -> Option<f64> {
        let [left, right] = self.undone(shown);
        let of_sums_and_differences = [1.0, -1.0].map(|sign| {
            let expected = combined(1.0, &expected[0], sign, &expected[1]);
            Some(likeness(&combined(1.0, &left, sign, &right), &expected, least)?.cosine)
        });
        mean(of_sums_and_differences.into_iter().flatten())
    }

    /// What to change.
    fn remedy(self, recording: &Recording, signals: [Signal; 2]) -> String {
        let negative: Vec<String> =
            (0..2).filter(|&side| self.signs[side] < 0.0).map(|side| named(recording, signals[side])).collect();
        let sign = format!("write `sign = -1` for {} in the mapping", negative.join(" and "));
        match (self.exchanged, negative.is_empty()) {
            (true, true) => format!("exchange {} in the mapping", both(recording, signals)),
            (true, false) => format!("{sign}, and exchange {}", both(recording, signals)),
            (false, _) => sign,
        }
    }
}

/// By which factor columns in another unit are too large.
pub(super) enum Factors {
    /// About one of these: nothing else is as far off.
    OneOf(Vec<f64>),
    /// Any, but set-points may be much larger than what is delivered: too large are only those beyond this limit.
    Beyond(f64),
}

impl Factors {
    /// Of speeds of wheels in rpm, degrees and turns per second, and metres per second.
    pub(super) fn of_speeds(robot: &Robot<f64>) -> Self {
        let units = ["rpm", "deg/s", "rev/s"].into_iter().filter_map(parse_unit).map(|unit| 1.0 / unit.factor);
        Self::OneOf(units.chain([robot.wheel_radius]).collect())
    }

    /// Whether columns with this largest value may be too large by this ratio.
    fn explain(&self, ratio: f64, largest: f64) -> bool {
        match self {
            Self::OneOf(factors) => factors.iter().any(|f| (ratio / f).ln().abs() < COLUMNS.near.ln()),
            Self::Beyond(limit) => ratio < 1.0 || largest > *limit,
        }
    }
}

/// Two columns and what the other channels say that they must show.
pub(super) struct Compared<'a> {
    pub(super) recording: &'a Recording,
    pub(super) signals: [Signal; 2],
    pub(super) shown: &'a Sides,
    pub(super) expected: &'a Sides,
    /// What says so.
    pub(super) by: &'static str,
    /// Root mean square of [`Self::expected`] below which nothing is said.
    pub(super) least: f64,
    /// What to do about columns in another unit.
    pub(super) units: &'static str,
    /// By which factor columns may be too large.
    pub(super) factors: Factors,
}

impl Compared<'_> {
    /// The mistake that makes the columns agree with what they must show, where as they are they do not; or that they are in
    /// another unit.
    pub(super) fn contradiction(&self) -> Option<String> {
        self.mistake().or_else(|| self.other_unit())
    }

    fn mistake(&self) -> Option<String> {
        let cosine = |mistake: Mistake| mistake.cosine(self.shown, self.expected, self.least);
        let as_mapped = cosine(Mistake::NONE)?;
        let tried = MISTAKES.into_iter().filter_map(|mistake| Some((mistake, cosine(mistake)?)));
        let (best, corrected) = tried.max_by(|a, b| a.1.total_cmp(&b.1))?;
        (as_mapped < COLUMNS.unlike && corrected > COLUMNS.alike).then(|| {
            format!(
                "{} contradict {} (cosine {as_mapped:.2}; corrected, it would be {corrected:.2}): {}",
                both(self.recording, self.signals),
                self.by,
                best.remedy(self.recording, self.signals)
            )
        })
    }

    /// By the sums of both sides: what turns pushes aside, of which little is known, is not in them.
    fn other_unit(&self) -> Option<String> {
        let [shown, expected] = [self.shown, self.expected].map(|[left, right]| combined(0.5, left, 0.5, right));
        let found = likeness(&shown, &expected, self.least)?;
        let ratio = found.ratio;
        let sizes = self.shown.iter().flatten().filter(|v| v.is_finite()).map(|v| v.abs());
        let is_other = self.factors.explain(ratio, sizes.fold(0.0, f64::max));
        let clear = found.cosine > COLUMNS.alike && ratio.ln().abs() > COLUMNS.unit.ln() && is_other;
        clear.then(|| {
            format!(
                "{} follow {}, but with {ratio:.4} times its size: {}",
                both(self.recording, self.signals),
                self.by,
                self.units
            )
        })
    }
}
