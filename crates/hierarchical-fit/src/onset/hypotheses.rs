//! What may begin or end while drives go on, and when.

use nalgebra::{DMatrix, DVector};

use crate::cause::Cause;
use crate::name::less;
use crate::onset::Instants;
use crate::onset::courses::Course;
use crate::settings::SETTINGS;

/// What may be: causes that are always there, and one that begins, or ends.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Hypothesis {
    pub(crate) always: Vec<usize>,
    pub(crate) cause: usize,
    pub(crate) ends: bool,
    /// Whether it does so in each drive anew.
    pub(crate) anew: bool,
}

/// What may be in the place of a set of causes, or beside it, once or in each drive anew.
pub(crate) fn hypotheses(causes: usize, set: &[usize], may_be_anew: bool) -> Vec<Hypothesis> {
    let once_or_anew = if may_be_anew { vec![false, true] } else { vec![false] };
    let mut out = Vec::new();
    for cause in 0..causes {
        let mut rests = vec![Vec::new(), less(set, cause)];
        rests.extend(set.iter().filter(|_| !set.contains(&cause)).map(|&other| less(set, other)));
        rests.sort();
        rests.dedup();
        for always in rests {
            let forms = once_or_anew.iter().flat_map(|&anew| [false, true].map(|ends| (anew, ends)));
            out.extend(forms.map(|(anew, ends)| Hypothesis { always: always.clone(), cause, ends, anew }));
        }
    }
    out
}

/// Courses beside which the others hardly count, the best first.
pub(crate) fn likely(instants: &Instants) -> Vec<Course> {
    let most = instants.iter().map(|(score, _)| *score).fold(f64::NEG_INFINITY, f64::max);
    let mut kept: Vec<&(f64, Course)> =
        instants.iter().filter(|(score, _)| *score > most - SETTINGS.onset.likely).collect();
    kept.sort_by(|a, b| b.0.total_cmp(&a.0));
    kept.into_iter().map(|(_, course)| course.clone()).collect()
}

/// Directions of a cause, one in each column, and the variances along them.
pub(crate) fn directions(cause: &Cause, constants: usize) -> (DMatrix<f64>, DVector<f64>) {
    let mut out = DMatrix::zeros(constants, cause.directions.len());
    for (column, (direction, _)) in cause.directions.iter().enumerate() {
        for &(k, weight) in direction {
            out[(k, column)] += weight;
        }
    }
    (out, DVector::from_iterator(cause.directions.len(), cause.directions.iter().map(|(_, usual)| usual * usual)))
}
