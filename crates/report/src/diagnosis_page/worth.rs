//! What the correction is worth on recordings that no fit has seen.

use verdict::{Diagnosis, FreeRun};

use crate::figure::{Bar, Bars, Drawing, Figure, Role};
use crate::page::{Cell, Page};
use crate::words::{free_runs, number, percent, quantities, quantity_and_unit};

/// Adds the section.
pub(super) fn add(page: &mut Page, d: &Diagnosis) {
    page.section("Proof", "What the correction is worth");
    if d.free_runs.is_empty() {
        page.paragraph("Nothing was corrected, or there was no recording to leave out: no error can be compared.");
        return;
    }
    page.note(&format!("{}.", free_runs(d)));
    let figures: Vec<Figure> = quantities(&d.free_runs).iter().map(|q| figure(d, q)).collect();
    page.grid(&figures);
}

/// The error of a recording in each simulation.
fn errors(r: &FreeRun) -> [(Role, Option<f64>); 4] {
    [
        (Role::Before, Some(r.nominal)),
        (Role::Retuned, Some(r.retuned)),
        (Role::Placebo, r.placebo),
        (Role::After, Some(r.corrected)),
    ]
}

fn figure(d: &Diagnosis, quantity: &str) -> Figure {
    let (name, unit) = quantity_and_unit(quantity);
    let runs: Vec<&FreeRun> = d.free_runs.iter().filter(|r| r.quantity == quantity).collect();
    let bar = |i: usize| {
        let each: Vec<f64> = runs.iter().filter_map(|r| errors(r)[i].1).collect();
        let mean = each.iter().sum::<f64>() / each.len().max(1) as f64;
        let role = runs.first().map(|r| errors(r)[i].0)?;
        // A mean over other recordings than those of its neighbours would compare nothing.
        (each.len() == runs.len()).then_some(Bar { role, value: mean, each })
    };
    let bars: Vec<Bar> = (0..4).filter_map(bar).collect();
    let cell = |e: Option<f64>| Cell::from(e.map_or(String::new(), number));
    let row = |r: &&FreeRun| {
        let own = errors(r).map(|(_, e)| cell(e));
        std::iter::once(Cell::from(r.recording.as_str())).chain(own).collect()
    };
    // Some quantities say themselves which error they are.
    let error = if name.contains('(') { "Error" } else { "rms error" };
    let drives = if runs.len() == 1 { String::new() } else { format!("; mean of {}, dots: each of them", runs.len()) };
    let change =
        |b: &Bar| format!("{} {}", name_of(b.role), percent(b.value / bars.first().map_or(f64::NAN, |a| a.value)));
    let changes = bars.iter().skip(1).map(change).collect::<Vec<_>>().join(", ");
    let changes = if changes.is_empty() { changes } else { format!(" Against the simulation as it is: {changes}.") };
    Figure {
        title: name,
        caption: format!("{error}, {unit}{drives}.{changes}"),
        table: (vec!["left out", "as it is", "re-tuned", "placebo", "corrected"], runs.iter().map(row).collect()),
        drawing: Drawing::Bars(Bars { unit, recordings: runs.iter().map(|r| r.recording.clone()).collect(), bars }),
    }
}

fn name_of(role: Role) -> &'static str {
    match role {
        Role::Recorded => "recorded",
        Role::Before => "as it is",
        Role::Retuned => "re-tuned only",
        Role::After => "corrected",
        Role::Placebo => "placebo",
    }
}
