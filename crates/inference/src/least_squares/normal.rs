//! Normal equations, blocks of nuisance numbers eliminated, and the step they promise.

use faer::Mat;

use crate::algebra::{inverse_spd, solve_spd};

/// A free parameter where a fit stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parameter {
    /// Its value.
    pub value: f64,
    /// Unit of its steps and of its column.
    pub scale: f64,
    /// Least and largest value.
    pub bounds: [f64; 2],
    /// Longest step, scales: a linear column says nothing beyond.
    pub longest: f64,
    /// Added to its diagonal: a whiff of a prior keeps what the data do not determine where it is.
    pub ridge: f64,
}

impl Parameter {
    /// A parameter that may take any value.
    #[must_use]
    pub fn unbounded(value: f64, scale: f64) -> Self {
        let bounds = [f64::NEG_INFINITY, f64::INFINITY];
        Self { value, scale, bounds, longest: f64::INFINITY, ridge: 0.0 }
    }

    /// Its value after a step of `delta` scales.
    pub(super) fn moved(&self, delta: f64) -> f64 {
        let move_ = delta.clamp(-self.longest, self.longest) * self.scale;
        (self.value + move_).clamp(self.bounds[0], self.bounds[1])
    }

    /// Whether a step would leave its bounds from where it stands.
    fn leaves(&self, delta: f64) -> bool {
        (self.value <= self.bounds[0] && delta < 0.0) || (self.value >= self.bounds[1] && delta > 0.0)
    }
}

/// Normal equations `H δ = −g` with what back-substitution of eliminated blocks needs.
#[derive(Debug, Clone)]
pub struct Normal {
    /// Curvature H.
    pub matrix: Mat<f64>,
    /// Downhill slope −g, one column.
    pub gradient: Mat<f64>,
    /// Log-determinant of the eliminated blocks.
    pub log_determinant: f64,
    /// Fall of the quadratic cost by the eliminated numbers alone.
    pub gain: f64,
    /// By block: solution of its own equations for each kept parameter and for its slope.
    eliminated: Vec<Mat<f64>>,
}

impl Normal {
    /// Equations without eliminated blocks.
    #[must_use]
    pub fn new(matrix: Mat<f64>, gradient: Mat<f64>) -> Self {
        Self { matrix, gradient, log_determinant: 0.0, gain: 0.0, eliminated: Vec::new() }
    }

    /// Equations of `n` parameters of which nothing is known: what a sum begins with.
    #[must_use]
    pub fn zero(n: usize) -> Self {
        Self::new(Mat::zeros(n, n), Mat::zeros(n, 1))
    }

    /// Equations from which a block of nuisance numbers is eliminated (Schur complement).
    ///
    /// `own` is the block's curvature with its prior, `right` its cross terms with each kept parameter and,
    /// last, its downhill slope. `None` if the block is not positive definite.
    #[must_use]
    pub fn reduced(mut self, own: &Mat<f64>, right: &Mat<f64>) -> Option<Self> {
        let n = self.matrix.nrows();
        let (solved, log_determinant) = solve_spd(own, right)?;
        let cross = right.subcols(0, n);
        self.matrix -= cross.transpose() * solved.subcols(0, n);
        self.gradient -= cross.transpose() * solved.subcols(n, 1);

        self.gain += (0..own.nrows()).map(|i| 0.5 * right[(i, n)] * solved[(i, n)]).sum::<f64>();
        self.log_determinant += log_determinant;
        self.eliminated.push(solved);
        Some(self)
    }

    /// Adds equations of other data for the same parameters.
    pub fn add(&mut self, other: Self) {
        self.matrix += &other.matrix;
        self.gradient += &other.gradient;
        self.log_determinant += other.log_determinant;
        self.gain += other.gain;
        self.eliminated.extend(other.eliminated);
    }

    /// Adds the prior `½ dᵀ I d` of the first parameters, which stand `d` away from its centre.
    pub fn add_prior(&mut self, information: &Mat<f64>, d: &[f64]) {
        for i in 0..d.len() {
            let mut slope = 0.0;
            for j in 0..d.len() {
                self.matrix[(i, j)] += information[(i, j)];
                slope += information[(i, j)] * d[j];
            }
            self.gradient[(i, 0)] -= slope;
        }
    }

    /// Adds each parameter's ridge.
    pub(super) fn stiffen(&mut self, parameters: &[Parameter]) {
        for (i, p) in parameters.iter().enumerate() {
            self.matrix[(i, i)] += p.ridge;
        }
    }

    /// Levenberg–Marquardt step in scales: a parameter at a bound that the step would cross is held, and let go
    /// once if its slope points inwards when the others have moved.
    ///
    /// `None` if the equations are not positive definite.
    pub fn step(&self, parameters: &[Parameter], damping: f64) -> Option<Mat<f64>> {
        let n = self.matrix.nrows();
        let (mut held, mut let_go) = (vec![false; n], vec![false; n]);
        loop {
            let m = Mat::from_fn(n, n, |i, j| {
                let diagonal = i == j;
                if held[i] || held[j] {
                    f64::from(diagonal)
                } else {
                    self.matrix[(i, j)] * if diagonal { 1.0 + damping } else { 1.0 }
                }
            });
            let g = Mat::from_fn(n, 1, |i, _| if held[i] { 0.0 } else { self.gradient[(i, 0)] });
            let delta = solve_spd(&m, &g)?.0;
            if let Some(crossing) = (0..n).find(|&i| !held[i] && parameters[i].leaves(delta[(i, 0)])) {
                held[crossing] = true;
                continue;
            }

            let points_inwards = |i: usize| {
                let moved: f64 = (0..n).map(|j| self.matrix[(i, j)] * delta[(j, 0)]).sum();
                !parameters[i].leaves(self.gradient[(i, 0)] - moved)
            };
            match (0..n).find(|&i| held[i] && !let_go[i] && points_inwards(i)) {
                Some(i) => (held[i], let_go[i]) = (false, true),
                None => return Some(delta),
            }
        }
    }

    /// Values where a step of `delta` scales leads, cut at the longest step and at the bounds.
    pub fn values(parameters: &[Parameter], delta: &Mat<f64>) -> Vec<f64> {
        parameters.iter().enumerate().map(|(i, p)| p.moved(delta[(i, 0)])).collect()
    }

    /// Fall of the cost that the linearised problem promises of an undamped step: `−½ δᵀg`.
    pub fn promised(&self, delta: &Mat<f64>) -> f64 {
        (0..delta.nrows()).map(|i| 0.5 * delta[(i, 0)] * self.gradient[(i, 0)]).sum()
    }

    /// Steps of the eliminated numbers that go with a step of the kept ones, block by block; what each would do alone is
    /// shortened by `1 + λ` as damping shortens that of the kept ones, so that enough damping leads downhill.
    pub fn back_substituted(&self, delta: &Mat<f64>, damping: f64) -> Vec<Vec<f64>> {
        let n = delta.nrows();
        let of = |solved: &Mat<f64>, i: usize| {
            let back: f64 = (0..n).map(|j| solved[(i, j)] * delta[(j, 0)]).sum();
            solved[(i, n)] / (1.0 + damping) - back
        };
        self.eliminated.iter().map(|solved| (0..solved.nrows()).map(|i| of(solved, i)).collect()).collect()
    }

    /// Covariance of the parameters, in scales: the inverse of the curvature; `None` if it is singular.
    pub fn covariance(&self) -> Option<Mat<f64>> {
        inverse_spd(&self.matrix)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Equations of three numbers of which the last is the nuisance.
    #[test]
    fn an_eliminated_block_moves_as_it_would_in_the_whole() {
        let h = faer::mat![[4.0, 1.0, 2.0], [1.0, 3.0, 0.5], [2.0, 0.5, 5.0]];
        let g = faer::mat![[1.0], [-2.0], [0.7]];
        let whole = solve_spd(&h, &g).expect("positive definite").0;

        let kept = Normal::new(h.submatrix(0, 0, 2, 2).to_owned(), g.submatrix(0, 0, 2, 1).to_owned());
        let right = faer::mat![[h[(2, 0)], h[(2, 1)], g[(2, 0)]]];
        let reduced = kept.reduced(&faer::mat![[h[(2, 2)]]], &right).expect("positive definite");
        let delta = reduced.step(&[Parameter::unbounded(0.0, 1.0); 2], 0.0).expect("positive definite");

        approx::assert_relative_eq!(delta[(0, 0)], whole[(0, 0)], epsilon = 1e-13);
        approx::assert_relative_eq!(delta[(1, 0)], whole[(1, 0)], epsilon = 1e-13);
        approx::assert_relative_eq!(reduced.back_substituted(&delta, 0.0)[0][0], whole[(2, 0)], epsilon = 1e-13);
        let promised: f64 = (0..3).map(|i| 0.5 * whole[(i, 0)] * g[(i, 0)]).sum();
        approx::assert_relative_eq!(reduced.promised(&delta) + reduced.gain, promised, epsilon = 1e-13);
        approx::assert_relative_eq!(reduced.log_determinant, 5.0_f64.ln(), epsilon = 1e-14);
    }

    /// Far from the minimum of an eliminated number its own step can lead uphill, whatever the kept ones do.
    #[test]
    fn damping_shortens_what_an_eliminated_block_does_alone() {
        let h = Normal::new(faer::mat![[4.0]], faer::mat![[0.0]]);
        let reduced = h.reduced(&faer::mat![[2.0]], &faer::mat![[1.0, 6.0]]).expect("positive definite");
        let alone = |damping: f64| reduced.back_substituted(&faer::mat![[0.0]], damping)[0][0];
        approx::assert_relative_eq!(alone(0.0), 3.0, epsilon = 1e-12);
        approx::assert_relative_eq!(alone(2.0), 1.0, epsilon = 1e-12);
    }

    #[test]
    fn a_parameter_at_its_bound_is_held_and_the_rest_solved_again() {
        let normal = Normal::new(faer::mat![[2.0, 1.0], [1.0, 2.0]], faer::mat![[3.0], [0.0]]);
        let mut parameters = [Parameter::unbounded(1.0, 1.0); 2];
        let free = normal.step(&parameters, 0.0).expect("positive definite");
        assert!(free[(0, 0)] > 0.0 && free[(1, 0)] < 0.0);
        parameters[0].bounds[1] = 1.0;
        let held = normal.step(&parameters, 0.0).expect("positive definite");
        assert_eq!((held[(0, 0)], held[(1, 0)]), (0.0, 0.0));
    }

    /// The whole step crosses both bounds; with the second held, the first leads back inside.
    #[test]
    fn a_held_parameter_is_let_go_when_its_slope_points_inwards() {
        let normal = Normal::new(faer::mat![[2.0, -1.8], [-1.8, 2.0]], faer::mat![[-0.5], [3.0]]);
        let at_bound = Parameter { bounds: [-10.0, 1.0], ..Parameter::unbounded(1.0, 1.0) };
        let step = normal.step(&[at_bound; 2], 0.0).expect("positive definite");
        approx::assert_relative_eq!(step[(0, 0)], -0.25, epsilon = 1e-12);
        assert_eq!(step[(1, 0)], 0.0);
    }
}
