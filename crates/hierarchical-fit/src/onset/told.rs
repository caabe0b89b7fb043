//! The answer with a cause that begins or ends.

use nalgebra::{DMatrix, DVector};

use super::hypotheses::directions;
use super::search::{Equations, Sought, Weighted};
use super::{Gate, Onset};
use crate::name::{Named, Weighed};
use crate::observed::Observed;
use crate::settings::SETTINGS;
use crate::stretches::Stretch;
use crate::weigh::Posterior;
use inference::evidence::{log_sum_exp, logistic};
use inference::robust::{NINETY, normal_cdf};

impl<D: Observed> Sought<'_, D> {
    /// The answer with it.
    pub(super) fn told(
        &self,
        (weighted, about): &(Weighted, Equations),
        named: &Named,
        (log_odds, alike): (f64, &[usize]),
    ) -> Option<(Onset, Named)> {
        let Weighted { hypothesis, posterior, .. } = weighted;
        let cause = &self.causes[hypothesis.cause];
        let n = self.prior.mean.len();
        let (directions, _) = directions(cause, n);
        let m = directions.ncols();
        let off = posterior.mean.rows(0, n).into_owned();
        let mut acting = DMatrix::zeros(n, n + m);
        acting.view_mut((0, 0), (n, n)).fill_with_identity();
        acting.view_mut((0, n), (n, m)).copy_from(&directions);
        let mean = DVector::from_vec(self.data.within_bounds(&(&acting * &posterior.mean)));
        if cause.at_least_zero.is_some_and(|k| mean[k] <= 0.0) {
            return None;
        }
        let covariance = &acting * &posterior.covariance * acting.transpose();

        let (gate, interval) = when(weighted, &about.off)?;
        // A row tells of the window before it.
        let [time, least, most] = [gate.known, interval[0], interval[1]].map(|at| (at - D::WINDOW).max(0.0));
        let onset = Onset {
            cause: hypothesis.cause,
            drive: gate.drive,
            time,
            interval: [least, most],
            gate,
            factor: weighted.factor,
            ends: hypothesis.ends,
            off: DVector::from_vec(self.data.within_bounds(&off)),
        };
        let left = self.data.share_with(mean.as_slice(), &onset);
        if left > SETTINGS.onset.leaves * self.data.share(named.posterior.mean.as_slice()) {
            return None;
        }
        let mut out = named.clone();
        let (kept, dropped): (Vec<Weighed>, Vec<Weighed>) =
            out.chosen.into_iter().partition(|w| hypothesis.always.contains(&w.cause));
        out.others.retain(|(c, _)| *c != hypothesis.cause);
        let dropped = dropped.into_iter().filter(|w| w.cause != hypothesis.cause);
        out.others.extend(dropped.map(|w| (w.cause, w.probability * logistic(-log_odds))));
        let class = std::iter::once(hypothesis.cause).chain(alike.iter().copied().filter(|c| *c != hypothesis.cause));
        let mut class: Vec<usize> = class.collect();
        class.dedup();
        let probability = logistic(log_odds);
        out.chosen = vec![Weighed { cause: hypothesis.cause, probability, class }];
        out.chosen.extend(kept);
        out.posterior = Posterior { mean, covariance };
        (out.placebo, out.rival) = (None, None);
        Some((onset, out))
    }
}

/// Where it changes, and a 90 % interval of when rows become known that tell so, within that drive.
pub(super) fn when(weighted: &Weighted, drives: &[Vec<Stretch>]) -> Option<(Gate, [f64; 2])> {
    let instants = &weighted.instants;
    let (_, [drive, from]) = *instants.iter().max_by(|a, b| a.0.total_cmp(&b.0))?;
    let at = |from: usize| if from == 0 { 0.0 } else { drives[drive].get(from).map_or(0.0, |s| s.span[0]) };
    let of_drive: Vec<(f64, usize)> =
        instants.iter().filter(|(_, [d, _])| *d == drive).map(|(score, [_, k])| (*score, *k)).collect();
    let whole = log_sum_exp(&of_drive.iter().map(|(score, _)| *score).collect::<Vec<f64>>());
    let half = 0.5 * SETTINGS.onset.coarse;
    let most = normal_cdf(NINETY);
    let mut interval = [at(from); 2];
    let mut passed = 0.0;
    for (score, k) in of_drive {
        let before = passed;
        passed += (score - whole).exp();
        if before < 1.0 - most && passed >= 1.0 - most {
            interval[0] = at(k) - half;
        }
        if before < most && passed >= most {
            interval[1] = at(k) + half;
        }
    }
    Some((Gate { drive, known: at(from), ends: weighted.hypothesis.ends }, interval))
}
