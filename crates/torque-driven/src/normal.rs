//! Normal equations of a fit, every run's own numbers eliminated, and the step they promise.

use faer::Mat;
use rayon::prelude::*;
use robot_model::tunable::COUNT as NUISANCES;

use crate::fit::{Columns, DEVIATING, OFFSET_CHANNEL, OFFSET_SIGMA, OFFSETS, PER_RUN, Point, Problem};
use crate::simulate::Response;
use crate::windows::CHANNELS;
use inference::hypothesis::Free;
use inference::linalg::solve_spd;

/// Normal equations reduced to θ and the effects, with what back-substitution needs.
pub(crate) struct Normal {
    pub(crate) matrix: Mat<f64>,
    pub(crate) gradient: Mat<f64>,
    /// Per run: solution of the eliminated block for each kept column and the gradient.
    eliminated: Vec<Mat<f64>>,
    /// Log-determinant of the eliminated blocks.
    pub(crate) log_determinant: f64,
    /// Fall of the quadratic cost by the eliminated numbers alone.
    pub(crate) gain: f64,
}

/// Normal equations of one run.
struct RunNormal {
    matrix: Mat<f64>,
    gradient: Mat<f64>,
    solved: Mat<f64>,
    log_determinant: f64,
    gain: f64,
}

impl Problem<'_> {
    /// Normal equations of θ, then `effects`, at `base`, with every run's own numbers eliminated.
    pub(crate) fn normal(&self, point: &Point, base: &Response, theta: &Columns, effects: &Columns) -> Option<Normal> {
        let parts: Vec<RunNormal> = (0..self.cuts.len())
            .into_par_iter()
            .map(|r| self.normal_of_run(point, base, theta, effects, r))
            .collect::<Option<Vec<_>>>()?;
        let n = NUISANCES + effects.0.len();
        let mut sum = Normal {
            matrix: Mat::zeros(n, n),
            gradient: Mat::zeros(n, 1),
            eliminated: Vec::with_capacity(parts.len()),
            log_determinant: 0.0,
            gain: 0.0,
        };
        for p in parts {
            sum.matrix += &p.matrix;
            sum.gradient += &p.gradient;
            sum.eliminated.push(p.solved);
            sum.log_determinant += p.log_determinant;
            sum.gain += p.gain;
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
    ) -> Option<RunNormal> {
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
                fill(n + o, &|k| if OFFSET_CHANNEL[o] == k % CHANNELS { OFFSET_SIGMA[o] } else { 0.0 });
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
        let (solved, log_determinant) = solve_spd(&own, &right)?;
        let cross = right.subcols(0, n);
        let reduced = gram.submatrix(0, 0, n, n) - cross.transpose() * solved.subcols(0, n);
        let gradient = gram.submatrix(0, residual, n, 1) - cross.transpose() * solved.subcols(n, 1);
        let gain = (0..PER_RUN).map(|i| 0.5 * right[(i, n)] * solved[(i, n)]).sum();
        Some(RunNormal { matrix: reduced, gradient, solved, log_determinant, gain })
    }

    /// Adds the prior of θ to normal equations.
    pub(crate) fn with_prior(&self, point: &Point, normal: &mut Normal) {
        for i in 0..NUISANCES {
            let mut g = 0.0;
            for j in 0..NUISANCES {
                normal.matrix[(i, j)] += self.information[(i, j)];
                g += self.information[(i, j)] * (point.theta[j] - self.centre[j]);
            }
            normal.gradient[(i, 0)] -= g;
        }
    }

    /// Levenberg–Marquardt step: a free value at a bound that the step would cross is held.
    pub(crate) fn bounded_step(point: &Point, normal: &Normal, free: &[Free], damping: f64) -> Option<Mat<f64>> {
        let n = normal.matrix.nrows();
        let mut held = vec![false; free.len()];
        loop {
            let fixed = |i: usize| i >= NUISANCES && held[i - NUISANCES];
            let m = Mat::from_fn(n, n, |i, j| {
                let diagonal = i == j;
                if fixed(i) || fixed(j) {
                    f64::from(diagonal)
                } else {
                    normal.matrix[(i, j)] * if diagonal { 1.0 + damping } else { 1.0 }
                }
            });
            let g = Mat::from_fn(n, 1, |i, _| if fixed(i) { 0.0 } else { normal.gradient[(i, 0)] });
            let delta = solve_spd(&m, &g)?.0;
            let crossing = free.iter().enumerate().find(|(i, f)| {
                let (e, d) = (point.effects[*i], delta[(NUISANCES + i, 0)]);
                !held[*i] && ((e <= f.bounds[0] && d < 0.0) || (e >= f.bounds[1] && d > 0.0))
            });
            match crossing {
                Some((i, _)) => held[i] = true,
                None => return Some(delta),
            }
        }
    }

    pub(crate) fn advanced(point: &Point, delta: &Mat<f64>, normal: &Normal, free: &[Free]) -> Point {
        let mut p = point.clone();
        for (k, t) in p.theta.iter_mut().enumerate() {
            *t = (*t + delta[(k, 0)]).clamp(-6.0, 6.0);
        }
        for (i, f) in free.iter().enumerate() {
            // At most two units at once: a linear column says nothing beyond.
            let d = delta[(NUISANCES + i, 0)].clamp(-2.0, 2.0) * f.unit;
            p.effects[i] = (p.effects[i] + d).clamp(f.bounds[0], f.bounds[1]);
        }
        let n = delta.nrows();
        for (u, solved) in p.run.iter_mut().zip(&normal.eliminated) {
            for (i, u) in u.iter_mut().enumerate() {
                let back: f64 = (0..n).map(|j| solved[(i, j)] * delta[(j, 0)]).sum();
                *u += solved[(i, n)] - back;
            }
        }
        p
    }
}
