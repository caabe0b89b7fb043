//! What is asked of a wide set: robots, sensors and visits of every sort.

use super::figures::{List, QUANTITIES};
use super::score::statistics::{largest, mean, median};
use super::score::{Kind, Row, STRATA};
use super::totals::Totals;
use crate::output::Asked::{AtLeast, AtMost};
use crate::output::Figure;

/// Effects of which fewer are hidden have no figure of their own.
const ENOUGH: usize = 20;
/// Cases below which a stratum has no calibration error of its own: a few bins of a few cases say nothing.
const STRATUM: usize = 30;

/// All figures of a wide set.
pub(super) fn figures(rows: &[Row], failed: usize) -> Vec<Figure> {
    let part = |f: &dyn Fn(&Row) -> bool| Totals::of(&rows.iter().filter(|r| f(r)).collect::<Vec<_>>());
    let with = |r: &Row| r.conditions.references > 0;
    let of_kind = |kind: Kind| part(&|r| with(r) && r.kind == kind);
    let mut list = List::new(rows);
    list.free("cases", Some(rows.len() as f64), "");
    list.asked("cases that failed", Some(failed as f64), "", AtMost(0.0));

    // With references.
    let stayed = part(&|r| with(r) && r.conditions.moved == 0.0);
    let moved = part(&|r| with(r) && r.conditions.moved > 0.0);
    list.rate("nothing hidden, constants stayed: false alarm", stayed.alarmed, AtMost(0.01));
    list.rate("nothing hidden, constants moved: false alarm", moved.alarmed, AtMost(0.02));
    let single = of_kind(Kind::Single);
    list.rate("one effect: right or its class", single.class, AtLeast(0.95));
    list.rate("one effect: truth inside the 90 % set", single.in_set, AtLeast(0.9));
    list.of_many("one effect: answers in the 90 % set, mean", mean(&single.set_sizes), "", AtMost(1.5));
    list.rate("two effects: both in the first three", of_kind(Kind::Pair).both_of_pair, AtLeast(0.9));
    list.rate("three effects: all in the 90 % set", of_kind(Kind::Triple).three_in_set, AtLeast(0.7));
    let outsiders = of_kind(Kind::Outsider);
    list.rate("outside the vocabulary: unknown, or its own name", outsiders.outsiders_unknown, AtLeast(0.9));
    list.rate("outside the vocabulary: invented cause", outsiders.invented, AtMost(0.05));

    // Without.
    let without = |kind: Kind| part(&|r| !with(r) && r.kind == kind);
    let single = without(Kind::Single);
    list.rate("no reference, nothing hidden: false alarm", without(Kind::Null).alarmed, AtMost(0.05));
    list.rate("no reference, one effect: right or its class", single.class, AtLeast(0.8));
    list.rate("no reference, one effect: called unknown", single.called_unknown, AtMost(0.07));
    list.rate("no reference, outside the vocabulary: unknown", without(Kind::Outsider).outsiders_unknown, AtLeast(0.7));

    // Numbers.
    let all = part(&|_| true);
    sizes(&mut list, rows, &all);
    list.of_many("expected calibration error", all.calibration_error, "", AtMost(0.03));
    for stratum in &STRATA {
        let t = part(&|r| (stratum.holds)(&r.conditions));
        if t.cases >= STRATUM {
            list.of_many(
                &format!("expected calibration error, {}", stratum.name),
                t.calibration_error,
                "",
                AtMost(0.08),
            );
        }
    }
    for (of, quantity) in QUANTITIES.iter().enumerate() {
        list.median(&format!("gap closed, {quantity}, median"), &all.closed[of], "", AtLeast(0.95));
        list.rate(&format!("worse than re-tuned by 5 %, {quantity}"), all.worse[of], AtMost(0.02));
    }
    list.free("time of a case on one core, median", median(&all.core_seconds), "s");
    list.free("time of a case on one core, longest", largest(&all.core_seconds), "s");
    list.free("memory of a case, most", largest(&all.memory), "MiB");
    list.figures()
}

/// Intervals of sizes: all, and of each effect that is hidden often enough.
fn sizes(list: &mut List, rows: &[Row], all: &Totals) {
    list.of_many("size inside its 90 % interval", all.size_held.share(), "", AtLeast(0.87));
    list.of_many("the same, not too wide", all.size_held.share(), "", AtMost(0.93));
    let parts = || rows.iter().flat_map(|r| &r.parts);
    let effects: std::collections::BTreeSet<&str> = parts().map(|p| p.effect.as_str()).collect();
    for effect in effects {
        let held: inference::rate::Rate = parts().filter(|p| p.effect == effect).filter_map(|p| p.size_held).collect();
        if held.count >= ENOUGH {
            list.rate(&format!("size inside its 90 % interval, {effect}"), held, AtLeast(0.8));
        }
    }
}
