//! The answer with a cause that begins or ends.

use nalgebra::DMatrix;

use super::courses::differing;
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
    /// Constants where the cause of a hypothesis acts.
    pub(super) fn acting(&self, Weighted { hypothesis, posterior, .. }: &Weighted) -> Posterior {
        let n = self.prior.mean.len();
        let (directions, _) = directions(&self.causes[hypothesis.cause], n);
        let m = directions.ncols();
        let mut acting = DMatrix::zeros(n, n + m);
        acting.view_mut((0, 0), (n, n)).fill_with_identity();
        acting.view_mut((0, n), (n, m)).copy_from(&directions);
        let covariance = &acting * &posterior.covariance * acting.transpose();
        Posterior { mean: &acting * &posterior.mean, covariance }
    }

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
        let off = Posterior {
            mean: posterior.mean.rows(0, n).into_owned(),
            covariance: posterior.covariance.view((0, 0), (n, n)).into_owned(),
        };
        let acting = self.acting(weighted);
        let mean = self.data.bounded(&acting);
        let covariance = acting.covariance;
        if cause.possible.is_some_and(|range| mean[range.constant] <= range.least) {
            return None;
        }

        // Near the beginning or the end of all drives it is how a drive begins or ends.
        let (_, likeliest) = weighted.instants.iter().max_by(|a, b| a.0.total_cmp(&b.0))?;
        if !hypothesis.anew && self.grid.is_at_an_end(&self.series, likeliest) {
            return None;
        }
        let (gate, intervals) = when(weighted, &about.off)?;
        // A row tells of the window before it, and is half of the one and half of the other where a part of that has passed.
        let rules = SETTINGS.onset;
        let before = |at: f64, share: f64| (at - share * D::WINDOW).max(0.0);
        let change = |(known, interval): (&f64, Option<[f64; 2]>)| {
            let [least, most] = interval?;
            let interval = [before(least, rules.passed + rules.unsure), before(most, rules.passed - rules.unsure)];
            Some((before(*known, rules.passed), interval)).filter(|(time, _)| *time > 0.0)
        };
        let changes = gate.known.iter().zip(intervals).map(change).collect();
        let onset =
            Onset { cause: hypothesis.cause, changes, gate, factor: weighted.factor, off: self.data.bounded(&off) };
        // What it explains must be more than laws that are not quite those of the robot get wrong.
        let left = self.data.share_with(mean.as_slice(), &onset);
        let [always, retuned] = [&named.posterior, &named.retuned].map(|p| self.data.share(p.mean.as_slice()));
        let leaves = if hypothesis.anew {
            rules.leaves_anew
        } else if onset.is_in_one(self.data.drives.len()) {
            rules.leaves_alone
        } else {
            rules.leaves
        };
        let is_of_motion = always >= rules.errs && left <= leaves * always && left <= D::HARDLY * retuned;
        // What a sensor shows otherwise from an instant on is in its own readings.
        let is_of_readings = || {
            let with = self.data.left_with(mean.as_slice(), &onset);
            let [always, retuned] = [&named.posterior, &named.retuned].map(|p| self.data.left(p.mean.as_slice()));
            let most = D::HARDLY.min(SETTINGS.naming.seen);
            (0..with.len())
                .any(|kind| with[kind] <= leaves.min(most) * always[kind] && with[kind] <= most * retuned[kind])
        };
        if !is_of_motion && !is_of_readings() {
            return None;
        }
        let mut out = named.clone();
        let (kept, dropped): (Vec<Weighed>, Vec<Weighed>) =
            out.chosen.into_iter().partition(|w| hypothesis.always.contains(&w.cause));
        // What stood for it before still does, and what fits as well as an onset.
        let known = dropped.iter().filter(|w| w.cause == hypothesis.cause).flat_map(|w| w.class.iter().copied());
        let mut class = vec![hypothesis.cause];
        for other in known.chain(alike.iter().copied()) {
            if !class.contains(&other) && !hypothesis.always.contains(&other) {
                class.push(other);
            }
        }
        let dropped = dropped.into_iter().filter(|w| w.cause != hypothesis.cause);
        out.others.extend(dropped.map(|w| (w.cause, w.probability * logistic(-log_odds))));
        out.others.retain(|(c, _)| !class.contains(c));
        let probability = logistic(log_odds);
        out.chosen = vec![Weighed { cause: hypothesis.cause, probability, class }];
        out.chosen.extend(kept);
        out.posterior = Posterior { mean, covariance };
        (out.placebo, out.rival) = (None, None);
        Some((onset, out))
    }
}

/// Where it changes, and by drive a 90 % interval of when rows become known that tell so, where it changes within it.
pub(super) fn when(weighted: &Weighted, drives: &[Vec<Stretch>]) -> Option<(Gate, Vec<Option<[f64; 2]>>)> {
    let instants = &weighted.instants;
    let (_, best) = instants.iter().max_by(|a, b| a.0.total_cmp(&b.0))?;
    let at = |drive: usize, from: usize| match from {
        0 => 0.0,
        _ => drives[drive].get(from).map_or(f64::INFINITY, |stretch| stretch.from),
    };
    let interval = |(drive, from): (usize, &usize)| {
        let is_inside = *from > 0 && *from < drives[drive].len();
        let inside = differing(instants, best, drive).map(|(score, course)| (*score, at(drive, course[drive])));
        let inside = inside.filter(|(_, at)| at.is_finite()).collect();
        is_inside.then(|| interval_of_instants(inside, 0.5 * SETTINGS.onset.coarse))
    };
    let known = best.iter().enumerate().map(|(drive, from)| at(drive, *from)).collect();
    let intervals = best.iter().enumerate().map(interval).collect();
    Some((Gate { known, ends: weighted.hypothesis.ends }, intervals))
}

/// A 90 % interval of instants by the evidence of each, nats, wider by half a step on either side.
pub fn interval_of_instants(mut instants: Vec<(f64, f64)>, half_step: f64) -> [f64; 2] {
    instants.sort_by(|(_, a), (_, b)| a.total_cmp(b));
    let whole = log_sum_exp(&instants.iter().map(|(evidence, _)| *evidence).collect::<Vec<f64>>());
    let most = normal_cdf(NINETY);
    let mut interval = [0.0; 2];
    let mut passed = 0.0;
    for (evidence, at) in instants {
        let before = passed;
        passed += (evidence - whole).exp();
        if before < 1.0 - most && passed >= 1.0 - most {
            interval[0] = at - half_step;
        }
        if before < most && passed >= most {
            interval[1] = at + half_step;
        }
    }
    interval
}
