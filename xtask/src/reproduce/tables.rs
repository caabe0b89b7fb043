//! The tables of the reproduction.

use pages::page::{Cell, Tone};
use sim::EVENTS;
use sim::statistics::{self, share};
use sim::table1::{Check, NAMES, PAPER, within};

use super::{Ensemble, Outcome};
use crate::document::{Section, toned};

/// All of them; the first two say what was found and how it is judged.
pub(super) fn all(o: &Outcome) -> Vec<Section> {
    vec![indices(o), tolerance(o.judged()), rules(o), windows(o), variations(o)]
}

fn digits(value: f64) -> Cell {
    format!("{value:.4}").into()
}

fn indices(o: &Outcome) -> Section {
    let header: Vec<&str> = std::iter::once("set").chain(NAMES).chain(["all within x1.5", "x2", "x3"]).collect();
    let note = "Distribution over the first layers; percentile: share of our draws below the paper's value. The last three \
                columns: share of draws with all four indices within a factor of the paper's. A constant regressor is no \
                network at all.";
    let mut section = Section::new("Table 1, rad/s", note, &header);
    let mut row = |name: String, cells: Vec<Cell>| {
        let mut row: Vec<Cell> = vec![name.into()];
        row.extend(cells);
        row.resize(header.len(), "".into());
        section.rows.push(row);
    };
    row("the paper".into(), PAPER.map(digits).into());
    for e in &o.rows {
        for (n, name) in ["smallest", "5 %", "median", "95 %", "largest"].into_iter().enumerate() {
            let mut cells: Vec<Cell> = e.table.iter().map(|d| digits(d.quantiles[n])).collect();
            if name == "median" {
                cells.extend([1.5, 2.0, 3.0].map(|f| Cell::from(format!("{:.1} %", within(&e.draws, f)))));
            }
            row(format!("{}: {name}", e.name), cells);
        }
        row(
            format!("{}: the paper's percentile", e.name),
            e.table.iter().map(|d| format!("{:.1}", d.percentile).into()).collect(),
        );
        row(format!("{}: constant regressor", e.name), e.constant.table1().map(digits).into());
    }
    section
}

fn judged(check: &Check) -> Cell {
    if check.pass { toned("met", Tone::Good) } else { toned("MISSED", Tone::Bad) }
}

fn tolerance(e: &Ensemble) -> Section {
    let note = "Rules fixed before the comparison. Rule (c) also asks that the property tests pass: cargo test.";
    let mut section = Section::new(&format!("Tolerance, set {}", e.name), note, &["rule", "found", "asked", ""]);
    for c in &e.checks {
        section.rows.push(vec![
            format!("({}) {}", c.rule, c.name).into(),
            format!("{} {}", found(c), c.unit).trim().into(),
            format!("{} {}", c.target, c.unit).trim().into(),
            judged(c),
        ]);
    }
    section
}

/// Which rules each row meets.
fn rules(o: &Outcome) -> Section {
    let note = "The tolerance is judged for set B; the others are shown beside it.";
    let mut section = Section::new("Rules by set", note, &["set", "(a)", "(b)", "(c)", "(d)", "(e)", "missed"]);
    for e in &o.rows {
        let mut row: Vec<Cell> = vec![e.name.as_str().into()];
        for rule in 'a'..='e' {
            let pass = !e.missed().any(|c| c.rule == rule);
            row.push(if pass { toned("met", Tone::Good) } else { toned("missed", Tone::Bad) });
        }
        let missed: Vec<String> = e.missed().map(|c| format!("{} {} {}", c.name, found(c), c.unit)).collect();
        row.push(missed.join("; ").into());
        section.rows.push(row);
    }
    section
}

/// A value with as many digits as are worth reading.
fn found(check: &Check) -> String {
    let value = check.value;
    if value != 0.0 && !(1e-3..1e4).contains(&value.abs()) { format!("{value:.1e}") } else { format!("{value:.3}") }
}

fn median(e: &Ensemble, of: impl Fn(&sim::Draw) -> f64) -> f64 {
    statistics::median(e.draws.iter().map(of))
}

fn windows(o: &Outcome) -> Section {
    let header: Vec<&str> = std::iter::once("set, wheel").chain(EVENTS).chain(["quiet rms"]).collect();
    let note = "Medians over the draws: the largest error in each event's window, how often it is the largest of the run, and \
                the window's share of all squared errors.";
    let mut section = Section::new("The five disturbances, rad/s", note, &header);
    for e in &o.rows {
        for wheel in 0..2 {
            let peak = |i: usize| move |d: &sim::Draw| d.output[wheel].peak[i];
            let name = |what: &str| Cell::from(format!("{}, wheel {}: {what}", e.name, wheel + 3));
            let mut row = vec![name("peak")];
            row.extend((0..5).map(|i| Cell::from(format!("{:.3}", median(e, peak(i))))));
            row.push(format!("{:.1e}", median(e, |d| d.output[wheel].quiet_rms)).into());
            section.rows.push(row);
            let largest = |i: usize| share(&e.draws, |d| peak(i)(d) >= d.output[wheel].max);
            let mut row = vec![name("largest of the run")];
            row.extend((0..5).map(|i| Cell::from(format!("{:.0} %", largest(i)))));
            row.push("".into());
            section.rows.push(row);
            let mut row = vec![name("share of squared error")];
            row.extend((0..5).map(|i| format!("{:.0} %", 100.0 * median(e, |d| d.output[wheel].share[i])).into()));
            row.push("".into());
            section.rows.push(row);
        }
    }
    section
}

/// Medians of the variations, those that move the RMSE most first.
fn variations(o: &Outcome) -> Section {
    let header: Vec<&str> =
        std::iter::once("variation").chain(NAMES).chain(["largest x3max", "x3R over default"]).collect();
    let note = "Medians over the draws, set B. In order of how much the RMSE of wheel 3 moves. What the paper leaves open \
                and moves its indices: the speed profile, the loop gain (gain, units, first layer), the wheel loop.";
    let mut section = Section::new("What moves the indices, rad/s", note, &header);
    let centre = |e: &Ensemble, i: usize| e.table.get(i).map_or(f64::NAN, |d| d.quantiles[2]);
    let default = centre(o.judged(), 2);
    let mut order: Vec<&Ensemble> = o.variations.iter().collect();
    let moved = |e: &Ensemble| (centre(e, 2) / default).ln().abs();
    order.sort_by(|a, b| moved(b).total_cmp(&moved(a)));
    for e in std::iter::once(o.judged()).filter(|_| !order.is_empty()).chain(order.iter().copied()) {
        let name = if std::ptr::eq(e, o.judged()) { "the recipe" } else { &e.name };
        let mut row: Vec<Cell> = vec![name.into()];
        row.extend(e.table.iter().map(|d| digits(d.quantiles[2])));
        row.push(e.table.first().map_or_else(String::new, |d| format!("{:.3}", d.quantiles[4])).into());
        row.push(format!("{:.2}", centre(e, 2) / default).into());
        section.rows.push(row);
    }
    section
}
