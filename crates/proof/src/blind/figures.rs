//! The flat list of figures with what is asked of them.

use super::score::statistics::{Rate, largest, mean, median};
use super::score::{Kind, Row};
use super::totals::Totals;
use crate::output::Asked::{AtLeast, AtMost};
use crate::output::{Asked, Figure};

/// Names of the quantities that held-out drives are compared in.
pub(super) const QUANTITIES: [&str; 2] = ["wheel speed", "yaw rate"];

/// Cases below which targets are held against intervals, not against the figures themselves: a guess; 300 is the set that
/// targets are stated for, and the quick one has 12.
pub(super) const FEW: usize = 100;

/// All figures of a set.
pub(super) fn figures(rows: &[Row], failed: usize) -> Vec<Figure> {
    let of = |kinds: &[Kind]| Totals::of(&rows.iter().filter(|r| kinds.contains(&r.kind)).collect::<Vec<_>>());
    let (all, single, pair) = (of(&Kind::ALL), of(&[Kind::Single]), of(&[Kind::Pair]));
    let mut list = List::new(rows);
    list.free("cases", Some(rows.len() as f64), "");
    for kind in Kind::ALL {
        list.free(&format!("cases, {}", kind.name()), Some(rows.iter().filter(|r| r.kind == kind).count() as f64), "");
    }
    list.asked("cases that failed", Some(failed as f64), "", AtMost(0.0));
    list.free("right, all cases", all.right.share(), "");
    list.free("top-1, singles", single.right.share(), "");
    list.rate("top-1 class, singles", single.class, AtLeast(0.95));
    list.free("top-1, pairs: first answer is one of the two", pair.right.share(), "");
    list.free("one of a pair in the first three", pair.one_of_pair.share(), "");
    list.rate("both of a pair in the first three", pair.both_of_pair, AtLeast(0.85));
    list.rate("truth inside the 90 % set of answers", all.in_set, AtLeast(0.9));
    list.free("answers in the 90 % set, mean", mean(&all.set_sizes), "");
    list.rate("nothing hidden, false alarm", all.alarmed, AtMost(0.02));
    list.bounds("nothing hidden, false alarm", all.alarmed);
    list.free("in the vocabulary, no mismatch seen", all.missed.share(), "");
    list.free("in the vocabulary, called unknown", all.called_unknown.share(), "");
    list.rate("causes outside the vocabulary called unknown", all.outsiders_unknown, AtLeast(0.9));
    list.rate("sensor distinguished from physics", all.sort, AtLeast(0.98));
    list.free("side right", all.side.share(), "");
    list.of_many("place and time, intersection over union, mean", mean(&all.overlaps), "", AtLeast(0.95));
    list.median("onset error, median", &all.onset_errors, "s", AtMost(0.3));
    list.free("onsets reported", all.onsets_reported.share(), "");
    list.median("size, relative error, median", &all.size_errors, "", AtMost(0.03));
    list.free("size within 25 %", all.size_within_quarter().share(), "");
    list.free("size inside its 90 % interval", all.size_held.share(), "");
    list.free("Brier score, mean", mean(&all.briers), "");
    list.of_many("expected calibration error", all.calibration_error, "", AtMost(0.05));
    for (of, quantity) in QUANTITIES.iter().enumerate() {
        let closed = &all.closed[of];
        list.median(&format!("gap closed, {quantity}, median"), closed, "", AtLeast([0.96, 0.95][of]));
        list.free(&format!("gap closed, {quantity}, mean"), mean(closed), "");
        let own = &all.closed_from_own[of];
        list.free(&format!("gap closed from own nominal, {quantity}, median"), median(own), "");
        list.free(&format!("corrected worse than own nominal by 5 %, {quantity}"), all.worse[of].share(), "");
        let over = &all.over_calibrated[of];
        list.median(&format!("nothing hidden, error over perfect, {quantity}, median"), over, "", AtMost(1.5));
    }
    list.of_many("time of a case on one core, median", median(&all.core_seconds), "s", AtMost(3.0));
    list.of_many("time of a case on one core, longest", largest(&all.core_seconds), "s", AtMost(10.0));
    list.free("time of a case by the clock, median", median(&all.seconds), "s");
    list.free("time of a case by the clock, longest", largest(&all.seconds), "s");
    list.asked("memory of a case, most", largest(&all.memory), "MiB", AtMost(128.0));
    list.figures()
}

/// Figures in the making; what there are no cases for is left out.
pub(super) struct List {
    figures: Vec<Figure>,
    /// So few cases that chance alone misses targets: one is missed only where its 95 % interval excludes it.
    few: bool,
}

impl List {
    pub(super) fn new(rows: &[Row]) -> Self {
        Self { figures: Vec::new(), few: rows.len() < FEW }
    }

    pub(super) fn figures(self) -> Vec<Figure> {
        self.figures
    }

    pub(super) fn free(&mut self, name: &str, value: Option<f64>, unit: &str) {
        self.figures.extend(value.map(|v| Figure::free(name, v, unit)));
    }

    pub(super) fn asked(&mut self, name: &str, value: Option<f64>, unit: &str, asked: Asked) {
        self.figures.extend(value.map(|v| Figure::free(name, v, unit).asked(asked)));
    }

    /// A figure of which a few cases say nothing: its target is not asked of them.
    pub(super) fn of_many(&mut self, name: &str, value: Option<f64>, unit: &str, asked: Asked) {
        if self.few {
            self.free(name, value, unit);
        } else {
            self.asked(name, value, unit, asked);
        }
    }

    pub(super) fn rate(&mut self, name: &str, rate: Rate, asked: Asked) {
        let [low, high] = rate.interval();
        let permits = match asked {
            AtLeast(least) => high >= least,
            AtMost(most) => low <= most,
        };
        self.asked(name, rate.share(), "", asked);
        self.permitted(rate.count > 0 && permits);
    }

    pub(super) fn median(&mut self, name: &str, values: &[f64], unit: &str, asked: Asked) {
        // The median is beyond the target where more than half of the values are.
        let beyond = values.iter().map(|v| match asked {
            AtLeast(least) => *v < least,
            AtMost(most) => *v > most,
        });
        let [low, _] = beyond.collect::<Rate>().interval();
        self.asked(name, median(values), unit, asked);
        self.permitted(!values.is_empty() && low <= 0.5);
    }

    /// Of a few cases the last target counts as met where the interval permits it.
    fn permitted(&mut self, permits: bool) {
        if let Some(last) = self.figures.last_mut().filter(|_| self.few && permits) {
            last.pass = Some(true);
        }
    }

    /// The 95 % interval of a rate.
    fn bounds(&mut self, name: &str, rate: Rate) {
        if rate.count > 0 {
            for (end, value) in ["from", "to"].into_iter().zip(rate.interval()) {
                self.free(&format!("{name}, 95 % {end}"), Some(value), "");
            }
        }
    }
}
