//! Where the mismatch shows: in time, in kinds of driving, on the ground.

use verdict::{Cell as Place, Diagnosis, ResidualTorque};

use super::ground::{map, paths};
use super::timeline::timeline;
use super::top::further_sentences;
use crate::figure::Figure;
use crate::page::{Cell, Page, Tone};
use crate::words::range;

/// Adds the section.
pub(super) fn add(page: &mut Page, d: &Diagnosis) {
    page.section("Where", "Where and when it shows");
    let further = further_sentences(d);
    if let Some(side) = &d.located.side {
        page.paragraph(&format!("By the wheel speeds, the cause is on the {side} side."));
    }
    if !further.is_empty() {
        page.list(further);
    }
    match timeline(d) {
        Some(figure) => page.figure(&figure),
        // Wheel motion beside a pose, and cars, are not compared with fault-free drives window by window.
        None if d.findings.is_empty() && d.cells.is_empty() && d.steady.is_none() => {
            page.paragraph("This comparison does not tell in which stretches of time a signal differs.");
        }
        None => page.paragraph("In no stretch of time does a signal differ by clearly more than in fault-free drives."),
    }
    let figures: Vec<Figure> = map(d).into_iter().chain(paths(d)).collect();
    if figures.is_empty() {
        page.note(
            "No map over kinds of driving or over the ground can be drawn: that takes speeds and \
             positions in every window.",
        );
    } else {
        page.grid(&figures);
    }
    tables(page, d);
}

/// The numbers behind it.
fn tables(page: &mut Page, d: &Diagnosis) {
    let tone = |stands_out: bool| if stands_out { Tone::Bad } else { Tone::Plain };
    if !d.findings.is_empty() {
        let row = |f: &verdict::Finding| {
            let when = format!("{}, {:.1} to {:.1} s", f.recording, f.interval[0], f.interval[1]);
            let ratio = Cell { text: format!("{:.1}", f.ratio), tone: tone(f.significant) };
            vec![f.signal.as_str().into(), ratio, when.into()]
        };
        let rows: Vec<Vec<Cell>> = d.findings.iter().map(row).collect();
        let shown = d.findings.iter().filter(|f| f.significant).count();
        page.folded(
            "By signal",
            &format!("{shown} of {} differ from the references", d.findings.len()),
            false,
            |page| {
                page.table(&["signal", "mismatch (1: as in the references)", "largest in"], &rows);
            },
        );
    }
    if !d.cells.is_empty() {
        let row = |c: &Place| {
            let ratio = Cell { text: format!("{:.1}", c.ratio), tone: tone(c.significant) };
            vec![c.by.as_ref().into(), range(c).into(), ratio, format!("{:.0}", c.seconds).into()]
        };
        let rows: Vec<Vec<Cell>> = d.cells.iter().map(row).collect();
        let shown = d.cells.iter().filter(|c| c.significant).count();
        let more = format!(
            "{shown} of {} ranges of speed, turning, slip, heading and place \
                            differ from the references",
            d.cells.len()
        );
        page.folded("By kind of driving and place", &more, false, |page| {
            page.table(&["by", "range", "mismatch (1: as in the references)", "s"], &rows);
        });
    }
    torque(page, &d.located.torque);
}

/// Torque that the model lacks, side by side.
fn torque(page: &mut Page, all: &[ResidualTorque]) {
    if all.is_empty() {
        return;
    }
    let certified = all.iter().all(|t| t.certificate.holds);
    let more = if certified {
        "learnt by the online neural identifier; its proven error bound holds"
    } else {
        "learnt by the online neural identifier; its error bound does not hold"
    };
    let row = |t: &ResidualTorque| -> Vec<Cell> {
        let outside: Vec<String> =
            t.spans.iter().map(|s| format!("{:.1} to {:.1} s", s.interval[0], s.interval[1])).collect();
        vec![
            format!("{}, {}", t.recording, t.side).into(),
            format!("{:+.2}", t.mean).into(),
            format!("{:.2}", t.rms).into(),
            format!("{:.2} to {:.2}", t.band[0], t.band[1]).into(),
            outside.join(", ").into(),
        ]
    };
    let rows: Vec<Vec<Cell>> = all.iter().map(row).collect();
    page.folded("Torque that the model lacks", more, false, |page| {
        page.table(
            &["recording, side", "mean, N m", "rms, N m", "range in the references, N m", "outside that range"],
            &rows,
        );
    });
}
