//! What to record next.

use verdict::Manoeuvre;
use verdict::{Advice, Diagnosis};

use crate::chart::{Chart, Line};
use crate::page::{Cell, Page};
use crate::words::probability;

/// Drives that are listed.
const SHOWN: usize = 12;
/// Entropy below which nothing is open, bits.
const LEAST_ENTROPY: f64 = 0.005;
/// Points of a profile's curve.
const POINTS: usize = 200;

/// Adds the section; without advice what the diagnosis itself says about it, and nothing where it says nothing.
pub(super) fn add(page: &mut Page, d: &Diagnosis) {
    let own: Vec<&String> = d.sentences.iter().filter(|s| s.contains("record:")).collect();
    if d.next.is_none() && own.is_empty() {
        return;
    }
    page.section("Next", "What to record next");
    for sentence in own {
        page.paragraph(sentence);
    }
    if let Some(advice) = &d.next {
        advised(page, advice);
    }
}

fn advised(page: &mut Page, advice: &Advice) {
    if let Some(reason) = &advice.withheld {
        page.paragraph(&sentence(reason));
    }
    if advice.rivals.len() > 1 {
        let names: Vec<String> =
            advice.rivals.iter().map(|r| format!("{} ({})", r.name, probability(r.probability))).collect();
        page.paragraph(&format!(
            "Still possible: {}. The uncertainty among them is {:.2} bits.",
            names.join(", "),
            advice.entropy_bits
        ));
    }
    let worth = |m: &&Manoeuvre| m.expected_bits > 0.0 || m.narrows.is_some();
    if let Some(best) = advice.best().filter(worth) {
        page.paragraph(&format!("Drive next: {}. {}", best.name, best.why));
        page.charts(&profile(best));
    }
    // Where nothing is to be told apart, what is left is how well the size would be known.
    let open = advice.entropy_bits > LEAST_ENTROPY;
    let row = |m: &Manoeuvre| -> Option<Vec<Cell>> {
        let name = if m.joins { m.name.clone() } else { format!("{} (the robot is changed for it)", m.name) };
        if open {
            let splits = m.splits.as_ref().map_or_else(|| "-".to_owned(), |[a, b]| format!("{a} from {b}"));
            return Some(vec![name.into(), format!("{:.2}", m.expected_bits).into(), splits.into()]);
        }
        Some(vec![name.into(), format!("{:.0} %", 100.0 * m.narrows?).into()])
    };
    let rows: Vec<Vec<Cell>> = advice.manoeuvres.iter().take(SHOWN).filter_map(row).collect();
    if rows.is_empty() {
        return;
    }
    if open {
        page.table(&["drive", "expected bits", "tells apart best"], &rows);
    } else {
        page.table(&["drive", "uncertainty of the size after it, share of what it is now"], &rows);
    }
    for limit in &advice.limits {
        page.note(&sentence(limit));
    }
    page.note("The command lacuna next, with --profile drive.csv, writes the speeds of a drive.");
}

/// A reason as a sentence.
fn sentence(reason: &str) -> String {
    format!("{}.", verdict::sentence_case(reason.trim_end_matches('.')))
}

/// Wanted speed and yaw rate over time.
fn profile(drive: &Manoeuvre) -> [Chart; 2] {
    let time: Vec<f64> = (0..=POINTS).map(|i| i as f64 * drive.length() / POINTS as f64).collect();
    let chart = |which: usize, caption: &str, unit: &str| Chart {
        caption: caption.to_owned(),
        x_label: "time, s".to_owned(),
        y_label: unit.to_owned(),
        lines: vec![Line::new(unit, &time, &time.iter().map(|t| drive.wanted(*t)[which]).collect::<Vec<_>>())],
        ..Chart::default()
    };
    [chart(0, "Speed of the drive", "m/s"), chart(1, "Yaw rate of the drive", "rad/s")]
}
