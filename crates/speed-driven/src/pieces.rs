//! What the searches for changes share: pieces of a series, classes of speed, names of causes.

use robot_model::effects::{grade, rolling_resistance};
use verdict::Word;

use crate::settings::MEASURING;

/// Limits of the classes of speed, m/s.
const CLASSES: [f64; 4] = MEASURING.stretches.classes;

/// Ids of the effects that change the straight load.
pub(crate) const GRADE: Word = Word::Borrowed(grade::SPEC.id);
pub(crate) const ROLLING: Word = Word::Borrowed(rolling_resistance::SPEC.id);

/// Straight load known from elsewhere, N m, by speed class; `None` where no reference was driven at such a speed.
pub(crate) type Usual = [Option<f64>; CLASSES.len() - 1];

/// The class of a speed.
pub(crate) fn class(speed: f64) -> usize {
    CLASSES.windows(2).position(|c| speed < c[1]).unwrap_or(CLASSES.len() - 2)
}

/// Consecutive indices at most `gap` seconds apart.
pub(crate) fn pieces(time: &[f64], rows: impl Iterator<Item = usize>, gap: f64) -> Vec<Vec<usize>> {
    let mut out: Vec<Vec<usize>> = Vec::new();
    for i in rows {
        match out.last_mut() {
            Some(piece) if piece.last().is_some_and(|&k| time[i] - time[k] <= gap) => piece.push(i),
            _ => out.push(vec![i]),
        }
    }
    out
}
