//! What may begin or end while drives go on, and when.

use nalgebra::{DMatrix, DVector};

use crate::cause::Cause;
use crate::name::less;
use crate::onset::Instants;
use crate::settings::SETTINGS;
use crate::stretches::Stretch;

/// What may be: causes that are always there, and one that begins, or ends.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Hypothesis {
    pub(crate) always: Vec<usize>,
    pub(crate) cause: usize,
    pub(crate) ends: bool,
}

/// What may be in the place of a set of causes, or beside it.
pub(crate) fn hypotheses(causes: usize, set: &[usize]) -> Vec<Hypothesis> {
    let mut out = Vec::new();
    for cause in 0..causes {
        let mut rests = vec![Vec::new(), less(set, cause)];
        rests.extend(set.iter().filter(|_| !set.contains(&cause)).map(|&other| less(set, other)));
        rests.sort();
        rests.dedup();
        for always in rests {
            out.extend([false, true].map(|ends| Hypothesis { always: always.clone(), cause, ends }));
        }
    }
    out
}

/// Where a cause may begin or end in these drives.
pub(crate) fn borders(drives: &[Vec<Stretch>]) -> Vec<[usize; 2]> {
    let rules = SETTINGS.onset;
    let all = drives.iter().enumerate().flat_map(|(k, d)| (0..d.len()).map(move |from| [k, from]));
    let all: Vec<[usize; 2]> = all.collect();
    let least = (rules.least / rules.coarse).round() as usize;
    let until = all.len().saturating_sub(least);
    all.get(least..until).map(<[[usize; 2]]>::to_vec).unwrap_or_default()
}

/// Instants beside which the others hardly count.
pub(crate) fn likely(instants: &Instants) -> Vec<[usize; 2]> {
    let most = instants.iter().map(|(score, _)| *score).fold(f64::NEG_INFINITY, f64::max);
    let is_likely = |(score, _): &&(f64, [usize; 2])| *score > most - SETTINGS.onset.likely;
    instants.iter().filter(is_likely).map(|(_, at)| *at).collect()
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
