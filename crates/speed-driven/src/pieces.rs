//! What the searches for changes share: pieces of a series, classes of speed, names of causes.

use robot_model::effects::{grade, rolling_resistance};
use verdict::Word;

use crate::settings::{CHANGES, MEASURING, NAMING};

/// Limits of the classes of speed, m/s.
const CLASSES: [f64; 4] = MEASURING.stretches.classes;

/// Ids of what changes the straight load.
pub(crate) const GRADE: Word = Word::Borrowed(grade::SPEC.id);
pub(crate) const ROLLING: Word = Word::Borrowed(rolling_resistance::SPEC.id);
/// What no effect of the catalogue does.
pub(crate) const UNLISTED: Word = Word::Borrowed(catalogue::answer::UNKNOWN.id);
/// A robot whose wheels are driven on and that stands.
pub(crate) const STANDING: Word = Word::Borrowed(catalogue::speed_driven::STANDING.id);

/// Straight loads by speed class, N m.
pub(crate) type ByClass = [Option<f64>; CLASSES.len() - 1];

/// Straight load known from elsewhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Usual {
    /// By speed class, N m; `None` where no reference was driven at such a speed.
    pub(crate) load: ByClass,
    /// Factor within which one ground may change the loads of two speed classes unequally.
    pub(crate) unequal: f64,
}

impl Usual {
    /// Measured on references, which know how the load depends on speed.
    pub(crate) fn of_references(load: ByClass) -> Self {
        Self { load, unequal: CHANGES.pieces.alike }
    }

    /// Predicted by a robot file, whose friction at one speed says little of another.
    pub(crate) fn of_file(load: ByClass) -> Self {
        Self { load, unequal: NAMING.priors.unnamed_straight }
    }

    /// The load where nothing is said of the speed, N m.
    pub(crate) fn any(&self) -> Option<f64> {
        self.load.iter().flatten().next().copied()
    }
}

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
