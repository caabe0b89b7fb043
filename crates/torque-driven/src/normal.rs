//! Normal equations of a fit, every run's own numbers eliminated, and where a step leads.

use faer::Mat;
use inference::least_squares::{Normal, Parameter, Step};
use rayon::prelude::*;
use robot_model::tunable::COUNT as NUISANCES;

use crate::channel::Channel;
use crate::fit::{Columns, Point, Problem};
use crate::run_numbers::RunNumber;
use crate::settings::fit::{Fit, SETTINGS};
use crate::simulate::Response;
use inference::hypothesis::Free;

const FIT: Fit = SETTINGS.fit;

/// Adds moves to numbers.
fn add(numbers: &mut [f64], moves: &[f64]) {
    numbers.iter_mut().zip(moves).for_each(|(u, m)| *u += m);
}

impl Problem<'_> {
    /// Normal equations of θ, then `effects`, at `base`, with every run's own numbers eliminated.
    pub(crate) fn normal(&self, point: &Point, base: &Response, theta: &Columns, effects: &Columns) -> Option<Normal> {
        Some(self.normal_with_visits(point, base, theta, effects)?.0)
    }

    /// The same, those of visits eliminated too, with the log-determinant of what visits have to themselves.
    pub(crate) fn normal_with_visits(
        &self,
        point: &Point,
        base: &Response,
        theta: &Columns,
        effects: &Columns,
    ) -> Option<(Normal, f64)> {
        let mut parts: Vec<Option<Normal>> = (0..self.cuts.len())
            .into_par_iter()
            .map(|r| self.normal_of_run(point, base, theta, effects, r).map(Some))
            .collect::<Option<Vec<_>>>()?;

        let (mut sum, mut of_visits) = (Normal::zero(NUISANCES + effects.0.len()), 0.0);
        for (visit, runs) in self.free_visits() {
            let mut own = Normal::zero(NUISANCES + effects.0.len());
            runs.into_iter().filter_map(|r| parts[r].take()).for_each(|part| own.add(part));
            let of_runs = own.log_determinant;
            let own = self.without_visit(point, own, visit)?;
            of_visits += own.log_determinant - of_runs;
            sum.add(own);
        }
        parts.into_iter().flatten().for_each(|part| sum.add(part));
        Some((sum, of_visits))
    }

    /// Normal equations of θ by some of the runs alone, what their visit has to itself left in.
    pub(crate) fn normal_of_runs(
        &self,
        point: &Point,
        base: &Response,
        theta: &Columns,
        runs: &[usize],
    ) -> Option<Normal> {
        let mut sum = Normal::zero(NUISANCES);
        for &r in runs {
            sum.add(self.normal_of_run(point, base, theta, &Columns(Vec::new()), r)?);
        }
        Some(sum)
    }

    pub(crate) fn normal_of_run(
        &self,
        point: &Point,
        base: &Response,
        theta: &Columns,
        effects: &Columns,
        r: usize,
    ) -> Option<Normal> {
        let columns: Vec<&Response> = theta.0.iter().chain(&effects.0).collect();
        let offsets: Vec<(Channel, f64)> = RunNumber::offsets().collect();
        let (n, all) = (columns.len(), columns.len() + offsets.len() + 1);
        // Gram of [θ, effects, offsets, residual], weighted.
        let mut gram = Mat::<f64>::zeros(all, all);
        let root = self.variance.map(|v| 1.0 / v.sqrt());
        for (s, segment) in self.cuts[r].segments.iter().enumerate() {
            let weight = self.weight(r, s, self.q(r, s, &base[r][s])).sqrt();
            let rows: Vec<(usize, Channel)> = (0..segment.windows)
                .flat_map(|w| Channel::ALL.map(|channel| (w, channel)))
                .filter(|&(w, channel)| segment.valid[w][channel])
                .collect();
            let mut a = Mat::zeros(rows.len(), all);
            let mut fill = |column: usize, value: &dyn Fn(usize, Channel) -> f64| {
                for (v, &(w, channel)) in a.col_as_slice_mut(column).iter_mut().zip(&rows) {
                    *v = value(w, channel) * root[channel] * weight;
                }
            };
            for (c, column) in columns.iter().enumerate() {
                let column = &column[r][s];
                fill(c, &|w, channel| column[w][channel]);
            }
            for (o, &(shifted, sigma)) in offsets.iter().enumerate() {
                fill(n + o, &|_, channel| if channel == shifted { sigma } else { 0.0 });
            }
            let base = &base[r][s];
            fill(n + offsets.len(), &|w, channel| segment.observed[w][channel] - base[w][channel]);
            gram += a.transpose() * &a;
        }

        // A run's own numbers: deviations move like θ, scaled; offsets are columns of their own.
        let mut offset = n..;
        let expanded = RunNumber::ALL.map(|number| match number {
            RunNumber::Constant { place, .. } => (place, self.run_scale(number)),
            RunNumber::Offset { .. } => (offset.next().unwrap_or(n), 1.0),
        });
        let residual = all - 1;
        let own = Mat::from_fn(expanded.len(), expanded.len(), |i, j| {
            let ((a, x), (b, y)) = (expanded[i], expanded[j]);
            gram[(a, b)] * x * y + if i == j { 1.0 } else { 0.0 }
        });
        let right = Mat::from_fn(expanded.len(), n + 1, |i, j| {
            let (a, x) = expanded[i];
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

    /// The point at the end of a step; every run's own numbers follow, and every visit's.
    pub(crate) fn advanced(&self, point: &Point, step: &Step<'_>) -> Point {
        let mut p = point.clone();
        let (theta, effects) = step.values.split_at(NUISANCES);
        p.theta.copy_from_slice(theta);
        p.effects.copy_from_slice(effects);

        // Blocks come as they were eliminated: the runs of a visit, then the visit, at last the runs without one.
        let by_step = step.normal.back_substituted(step.delta, step.damping);
        let mut at = 0;
        let mut others: Vec<usize> = (0..p.run.len()).collect();
        for (visit, runs) in self.free_visits() {
            let moves = &by_step[at + runs.len()];
            add(&mut p.visits[visit], moves);
            // Constants of these runs move with the step and with the visit.
            let mut delta = step.delta.clone();
            (0..NUISANCES).for_each(|k| delta[(k, 0)] += self.visits[visit].sigma[k] * moves[k]);
            let own = step.normal.back_substituted(&delta, step.damping);
            runs.iter().zip(&own[at..]).for_each(|(&r, moves)| add(&mut p.run[r], moves));
            others.retain(|r| !runs.contains(r));
            at += runs.len() + 1;
        }
        others.iter().zip(&by_step[at..]).for_each(|(&r, moves)| add(&mut p.run[r], moves));
        p
    }
}
