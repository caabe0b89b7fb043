//! Residuals, columns and normal equations.

use faer::Mat;
use robot_model::Robot;

use super::free::{Observed, Run, WIDTH};
use super::{CHANNELS, OutputError};
use crate::settings::output_error::SETTINGS;

/// The problem linearised at a point.
#[derive(Clone)]
pub(super) struct Equations {
    /// `JᵀJ` and `Jᵀe`, with `e = (y − ŷ)/σ` and `J = ∂(ŷ/σ)/∂δ`.
    pub(super) matrix: Mat<f64>,
    pub(super) gradient: Mat<f64>,
    /// `Σ e²`.
    pub(super) cost: f64,
    /// How many numbers are compared.
    pub(super) numbers: usize,
}

/// `(y − ŷ)/σ` of a row.
#[inline(always)]
fn residual(observed: &[f64; CHANNELS], shown: &Observed, weight: &[f64; CHANNELS]) -> [f64; CHANNELS] {
    // The angle from the run's heading to the observed one, in (−π, π].
    let (sin, cos) = observed[2].sin_cos();
    let [x, y, c, n, rate, left, right] = *shown;
    let yaw = (sin * c - cos * n).atan2(cos * c + sin * n);
    let e = [observed[0] - x, observed[1] - y, yaw, observed[3] - rate, observed[4] - left, observed[5] - right];
    std::array::from_fn(|i| e[i] * weight[i])
}

/// `(ŷ' − ŷ)/σ` of a row, for a shift so small that an angle is its sine.
#[inline(always)]
fn difference(shifted: &Observed, shown: &Observed, weight: &[f64; CHANNELS]) -> [f64; CHANNELS] {
    let yaw = shifted[3] * shown[2] - shifted[2] * shown[3];
    let d = [shifted[0] - shown[0], shifted[1] - shown[1], yaw, shifted[4] - shown[4], shifted[5] - shown[5]];
    std::array::from_fn(|i| weight[i] * if i == 5 { shifted[6] - shown[6] } else { d[i] })
}

impl OutputError<'_> {
    fn weight(&self) -> [f64; CHANNELS] {
        self.sigma.map(|sigma| 1.0 / sigma)
    }

    /// The robot at `delta` and one shifted robot for each constant; `None` if one of them cannot be.
    fn robots(&self, delta: &[f64]) -> Option<Vec<Robot<f64>>> {
        let shifted = (0..self.constants.len()).map(|j| {
            let mut delta = delta.to_vec();
            delta[j] += self.constants[j].step();
            self.changed(&delta)
        });
        std::iter::once(self.changed(delta)).chain(shifted).collect()
    }

    /// `(y − ŷ)/σ` of every number that was recorded, by a run of each recording by itself; `None` if a number is not finite.
    pub(super) fn residuals(&self, delta: &[f64]) -> Option<Vec<f64>> {
        let shown = self.run_alone(&self.changed(delta)?);
        let weight = self.weight();
        let mut all = Vec::new();
        for (recording, shown) in self.recordings.iter().zip(&shown) {
            for (observed, shown) in recording.observed.iter().zip(shown) {
                let e = residual(observed, shown, &weight);
                all.extend(e.iter().zip(observed).filter(|(_, o)| o.is_finite()).map(|(e, _)| *e));
            }
        }
        all.iter().all(|e| e.is_finite()).then_some(all)
    }

    /// Linearises at `delta`, all robots side by side; otherwise the place of the recording whose run is not finite.
    pub(super) fn linearised(&self, delta: &[f64]) -> Result<Equations, usize> {
        self.each_row(delta, |_, _| ())
    }

    /// Linearises and gives each row's residuals and columns to whom it may concern.
    pub(super) fn each_row(&self, delta: &[f64], mut tell: impl FnMut(f64, &[f64])) -> Result<Equations, usize> {
        let robots = self.robots(delta).ok_or(0_usize)?;
        let (n, weight) = (self.constants.len(), self.weight());
        let per_step: Vec<f64> = self.constants.iter().map(|c| 1.0 / c.step()).collect();

        let mut lower = vec![0.0; n * (n + 1) / 2];
        let (mut gradient, mut cost, mut numbers) = (vec![0.0; n], 0.0, 0);
        let mut columns = vec![[0.0; CHANNELS]; n];
        let mut row_of = vec![0.0; n];

        let at_once = (SETTINGS.equations.vectors * WIDTH / (n + 1)).max(1);
        for (part, recordings) in self.recordings.chunks(at_once).enumerate() {
            let runs: Vec<Run<'_>> = recordings
                .iter()
                .flat_map(|recording| robots.iter().map(move |robot| Run { robot, recording }))
                .collect();
            let shown = self.run(&runs);
            for (r, (recording, shown)) in recordings.iter().zip(shown.chunks_exact(n + 1)).enumerate() {
                for (k, observed) in recording.observed.iter().enumerate() {
                    let e = residual(observed, &shown[0][k], &weight);
                    for (column, shifted) in columns.iter_mut().zip(&shown[1..]) {
                        *column = difference(&shifted[k], &shown[0][k], &weight);
                    }
                    for c in (0..CHANNELS).filter(|c| observed[*c].is_finite()) {
                        for ((x, column), per_step) in row_of.iter_mut().zip(&columns).zip(&per_step) {
                            *x = column[c] * per_step;
                        }
                        cost += e[c] * e[c];
                        numbers += 1;
                        let mut sums = lower.iter_mut();
                        for (i, x) in row_of.iter().enumerate() {
                            gradient[i] += x * e[c];
                            for (y, sum) in row_of[..=i].iter().zip(&mut sums) {
                                *sum += x * y;
                            }
                        }
                        tell(e[c], &row_of);
                    }
                }
                if !cost.is_finite() || !lower.iter().all(|x| x.is_finite()) {
                    return Err(part * at_once + r);
                }
            }
        }

        let at = |i: usize, j: usize| lower[i.max(j) * (i.max(j) + 1) / 2 + i.min(j)];
        Ok(Equations {
            matrix: Mat::from_fn(n, n, at),
            gradient: Mat::from_fn(n, 1, |i, _| gradient[i]),
            cost,
            numbers,
        })
    }
}
