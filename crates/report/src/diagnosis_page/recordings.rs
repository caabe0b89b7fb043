//! Every recording beside its simulations, over time.

use inference::robust;
use verdict::{Compared, Diagnosis, Trace};

use crate::figure::{Drawing, Figure, Role, Row, RowLine, TimePlot};
use crate::page::{Cell, Page};
use crate::thin;
use crate::words::number;

/// A step in time that is this much longer than the usual one is a gap.
const GAP: f64 = 1.5;

/// Adds the section.
pub(super) fn add(page: &mut Page, d: &Diagnosis) {
    page.section("Recordings", "Every recording beside its simulations");
    if d.traces.is_empty() {
        page.paragraph("This diagnosis keeps no simulated signals, so that recordings cannot be shown beside them.");
        return;
    }
    page.note(
        "Drag to zoom, or use Ctrl and the wheel; a double click shows all. With the keyboard: arrow keys move the cursor, \
         plus and minus zoom, 0 shows all.",
    );
    for (i, trace) in d.traces.iter().enumerate() {
        let left_out = if trace.left_out { "left out of the fit of its correction" } else { "" };
        page.folded(&trace.recording, left_out, i == 0, |page| page.figure(&figure(d, trace)));
    }
}

/// Simulations of a signal with the name of their column.
pub(super) fn simulated(c: &Compared) -> [(Role, &Vec<Option<f64>>); 3] {
    [(Role::Before, &c.nominal), (Role::Retuned, &c.retuned), (Role::After, &c.corrected)]
}

/// Root mean squared difference of two signals where both are known.
pub(super) fn rms(a: &[Option<f64>], b: &[Option<f64>]) -> Option<f64> {
    robust::rms(a.iter().zip(b).filter_map(|(a, b)| Some((*a)? - (*b)?)))
}

/// A recording with all its signals.
fn figure(d: &Diagnosis, trace: &Trace) -> Figure {
    let table = trace.channels.iter().map(|c| {
        let errors = simulated(c).map(|(_, y)| Cell::from(rms(&c.recorded, y).map_or(String::new(), number)));
        std::iter::once(Cell::from(format!("{}, {}", c.signal, c.unit))).chain(errors).collect()
    });
    let marked = d.located.spans.iter().any(|s| s.recording == trace.recording);
    let marked = if marked { " Marked below a signal: where it mismatches the calibrated simulation." } else { "" };
    let restarted = if trace.restarts.len() > 1 {
        " The simulations run without measurements and start again from the measured state where \
         their lines are broken."
    } else {
        ""
    };
    Figure {
        title: String::new(),
        caption: format!("{}, recorded and simulated.{restarted}{marked}{}", trace.recording, thinning(trace)),
        table: (vec!["rms difference", "as it is", "re-tuned", "corrected"], table.collect()),
        drawing: Drawing::Time(plot(d, trace, &trace.channels.iter().collect::<Vec<_>>(), true)),
    }
}

fn thinning(trace: &Trace) -> String {
    let size = thin::group(trace.time.len(), thin::POINTS);
    if size == 1 {
        return String::new();
    }
    format!(" Of every {size} of its {} windows the least and the greatest are kept.", trace.time.len())
}

/// Some signals of a recording over time.
pub(super) fn plot(d: &Diagnosis, trace: &Trace, channels: &[&Compared], retuned: bool) -> TimePlot {
    let size = thin::group(trace.time.len(), thin::POINTS);
    let kept = thin::places(trace.time.len(), size);
    // The place that stands for a window, or the first one after it.
    let place = |window: &usize| kept.partition_point(|k| k < window);
    let steps = || trace.time.windows(2).map(|p| p[1] - p[0]);
    let mut sorted: Vec<f64> = steps().collect();
    sorted.sort_by(f64::total_cmp);
    let usual = sorted.get(sorted.len() / 2).copied().unwrap_or(f64::INFINITY);
    let gaps: Vec<usize> = steps().enumerate().filter(|(_, s)| *s > GAP * usual).map(|(i, _)| i + 1).collect();
    let row = |c: &&Compared| {
        let line = |role, y: &[Option<f64>]| {
            let y: Vec<Option<f64>> = y.iter().map(|v| v.and_then(thin::six_digits)).collect();
            (y.len() == trace.time.len()).then(|| RowLine { role, y: thin::extremes(&y, size) })
        };
        let simulated = simulated(c).into_iter().filter(|(role, _)| retuned || *role != Role::Retuned);
        let lines = simulated.filter_map(|(role, y)| line(role, y));
        let own = d.located.spans.iter().filter(|s| s.recording == trace.recording && s.signal == c.signal);
        Row {
            name: c.signal.to_string(),
            unit: c.unit.to_string(),
            lines: line(Role::Recorded, &c.recorded).into_iter().chain(lines).collect(),
            spans: own.map(|s| s.interval).collect(),
        }
    };
    TimePlot {
        link: trace.recording.clone(),
        time: kept.iter().filter_map(|i| thin::six_digits(trace.time[*i])).collect(),
        gaps: gaps.iter().map(place).collect(),
        restarts: trace.restarts.iter().map(place).collect(),
        rows: channels.iter().map(row).collect(),
    }
}
