//! What the proof shows, as tables and figures.

use pages::page::{Cell, Tone};
use sim::statistics::median;

use super::case::{Distance, Proved};
use crate::document::{Section, number, toned};
use crate::output::{Asked, Figure};

/// Share of the cases that the engine holds in which the corrected model must be closer.
const MOST: f64 = 0.5;
/// Quantities that are compared.
const QUANTITIES: [&str; 2] = ["Wheel speed", "Yaw rate"];

/// What was done, in a sentence or two.
pub(super) fn intro(seed: u64, proved: &[Proved]) -> String {
    let held: Vec<&Proved> = proved.iter().filter(|p| p.is_held()).collect();
    let closer = |p: &&&Proved| p.ratios().iter().all(|r| *r < 1.0);
    format!(
        "{} cases drawn with seed {seed}; MuJoCo holds all that was named in {} of them. Of these, the corrected model is \
         closer to the truth than the unexported one in both wheel speed and yaw rate in {}.",
        proved.len(),
        held.len(),
        held.iter().filter(closer).count()
    )
}

/// A table for each quantity.
pub(super) fn all(proved: &[Proved]) -> Vec<Section> {
    (0..2).map(|q| table(proved, q)).collect()
}

fn table(proved: &[Proved], q: usize) -> Section {
    let mut s = Section::new(
        &format!("{}: rms distance from the truth on held-out drives, rad/s", QUANTITIES[q]),
        "As it is, re-tuned and corrected: exported and run in MuJoCo. With residual: the corrected model with the forces that \
         the engine does not hold, in Python. Planar plant: lacuna's own prediction, corrected.",
        &[
            "case",
            "hidden",
            "named",
            "held",
            "as it is",
            "re-tuned",
            "corrected",
            "with residual",
            "planar plant",
            "ratio",
        ],
    );
    let text = |d: Distance| Cell::from(number(Some(d[q])));
    for p in proved {
        let ratio = p.ratios()[q];
        let tone = if ratio < 1.0 || !p.is_held() { Tone::Plain } else { Tone::Bad };
        s.rows.push(vec![
            p.name.as_str().into(),
            p.hidden.join(", ").into(),
            p.named.join(", ").into(),
            format!("{}/{}", p.held, p.named.len()).into(),
            text(p.models[0]),
            text(p.models[1]),
            text(p.models[2]),
            p.with_residual.map_or_else(|| "-".into(), text),
            text(p.plant),
            toned(number(Some(ratio)), tone),
        ]);
    }
    let middle = |of: &dyn Fn(&Proved) -> f64| Cell::from(number(Some(median(proved.iter().map(of)))));
    let mut row: Vec<Cell> = ["median", "", "", ""].map(Cell::from).into();
    row.extend((0..3).map(|k| middle(&|p| p.models[k][q])));
    row.push(middle(&|p| p.with_residual.unwrap_or(p.models[2])[q]));
    row.push(middle(&|p| p.plant[q]));
    row.push(middle(&|p| p.ratios()[q]));
    s.rows.push(row);
    s
}

/// Figures for machines; what is asked is asked of the cases that the engine holds.
pub(super) fn figures(proved: &[Proved]) -> Vec<Figure> {
    let held: Vec<&Proved> = proved.iter().filter(|p| p.is_held()).collect();
    let mut out = Vec::new();
    for q in 0..2 {
        if !held.is_empty() {
            let closer = held.iter().filter(|p| p.ratios()[q] < 1.0).count() as f64 / held.len() as f64;
            let name = format!("{}: cases in which the corrected model is closer", QUANTITIES[q]);
            out.push(Figure::free(name, closer, "").asked(Asked::AtLeast(MOST)));
        }
        let name = format!("{}: median ratio of corrected to unexported, all cases", QUANTITIES[q]);
        out.push(Figure::free(name, median(proved.iter().map(|p| p.ratios()[q])), ""));
    }
    out
}
