//! Normal equations of a fit, every run's own numbers eliminated, and where a step leads.

use faer::Mat;
use inference::least_squares::{Normal, Parameter, Step};
use rayon::prelude::*;
use robot_model::tunable::COUNT as NUISANCES;

use crate::fit::{Columns, DEVIATING, OFFSET_CHANNEL, OFFSETS, PER_RUN, Point, Problem};
use crate::settings::fit::{Deviations, Fit, SETTINGS};
use crate::simulate::Response;
use crate::windows::CHANNELS;
use inference::hypothesis::Free;

const DEVIATIONS: Deviations = SETTINGS.deviations;
const FIT: Fit = SETTINGS.fit;

impl Problem<'_> {
    /// Normal equations of θ, then `effects`, at `base`, with every run's own numbers eliminated.
    pub(crate) fn normal(&self, point: &Point, base: &Response, theta: &Columns, effects: &Columns) -> Option<Normal> {
        let parts: Vec<Normal> = (0..self.cuts.len())
            .into_par_iter()
            .map(|r| self.normal_of_run(point, base, theta, effects, r))
            .collect::<Option<Vec<_>>>()?;

        let mut sum = Normal::zero(NUISANCES + effects.0.len());
        for part in parts {
            sum.add(part);
        }
        Some(sum)
    }

    fn normal_of_run(
        &self,
        point: &Point,
        base: &Response,
        theta: &Columns,
        effects: &Columns,
        r: usize,
    ) -> Option<Normal> {
        let columns: Vec<&Response> = theta.0.iter().chain(&effects.0).collect();
        let (n, all) = (columns.len(), columns.len() + OFFSETS + 1);
        // Gram of [θ, effects, offsets, residual], weighted.
        let mut gram = Mat::<f64>::zeros(all, all);
        let root = self.variance.map(|v| 1.0 / v.sqrt());
        for (s, segment) in self.cuts[r].segments.iter().enumerate() {
            let weight = self.weight(r, s, self.q(r, s, &base[r][s])).sqrt();
            let rows: Vec<usize> = (0..segment.observed.len()).filter(|&i| segment.valid[i]).collect();
            let mut a = Mat::zeros(rows.len(), all);
            let mut fill = |c: usize, value: &dyn Fn(usize) -> f64| {
                for (v, &k) in a.col_as_slice_mut(c).iter_mut().zip(&rows) {
                    *v = value(k) * root[k % CHANNELS] * weight;
                }
            };
            for (c, column) in columns.iter().enumerate() {
                let column = &column[r][s];
                fill(c, &|k| column[k]);
            }
            for o in 0..OFFSETS {
                fill(n + o, &|k| if OFFSET_CHANNEL[o] == k % CHANNELS { DEVIATIONS.offsets[o] } else { 0.0 });
            }
            let base = &base[r][s];
            fill(n + OFFSETS, &|k| segment.observed[k] - base[k]);
            gram += a.transpose() * &a;
        }

        // A run's own numbers: deviations move like θ, scaled; offsets are columns of their own.
        let expand = |u: usize| {
            if u < DEVIATING.len() { (DEVIATING[u], self.run_scale(u)) } else { (n + u - DEVIATING.len(), 1.0) }
        };
        let residual = all - 1;
        let own = Mat::from_fn(PER_RUN, PER_RUN, |i, j| {
            let ((a, x), (b, y)) = (expand(i), expand(j));
            gram[(a, b)] * x * y + if i == j { 1.0 } else { 0.0 }
        });
        let right = Mat::from_fn(PER_RUN, n + 1, |i, j| {
            let (a, x) = expand(i);
            if j < n { gram[(a, j)] * x } else { gram[(a, residual)] * x - point.run[r][i] }
        });

        let kept = gram.submatrix(0, 0, n, n).to_owned();
        Normal::new(kept, gram.submatrix(0, residual, n, 1).to_owned()).reduced(&own, &right)
    }

    /// Adds the prior of θ to normal equations.
    pub(crate) fn with_prior(&self, point: &Point, normal: &mut Normal) {
        let off: [f64; NUISANCES] = std::array::from_fn(|i| point.theta[i] - self.centre[i]);
        normal.add_prior(&self.information, &off);
    }

    /// What a fit may move: θ, then the effects' free values.
    pub(crate) fn parameters(point: &Point, free: &[Free]) -> Vec<Parameter> {
        let bounds = [-FIT.farthest, FIT.farthest];
        let theta = point.theta.iter().map(|&t| Parameter { bounds, ..Parameter::unbounded(t, 1.0) });
        let effects = free.iter().zip(&point.effects).map(|(f, &value)| Parameter {
            value,
            scale: f.unit,
            bounds: f.bounds,
            longest: FIT.longest,
            ridge: FIT.whiff,
        });
        theta.chain(effects).collect()
    }

    /// The point at the end of a step; every run's own numbers follow.
    pub(crate) fn advanced(point: &Point, step: &Step<'_>) -> Point {
        let mut p = point.clone();
        let (theta, effects) = step.values.split_at(NUISANCES);
        p.theta.copy_from_slice(theta);
        p.effects.copy_from_slice(effects);

        for (own, moves) in p.run.iter_mut().zip(step.normal.back_substituted(step.delta)) {
            for (u, m) in own.iter_mut().zip(moves) {
                *u += m;
            }
        }
        p
    }
}
