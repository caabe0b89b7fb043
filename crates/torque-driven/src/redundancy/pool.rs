//! What is common to all checks: least squares in a run, and runs judged against the references.

use faer::Mat;
use inference::robust;

use crate::settings::redundancy::{Pool, SETTINGS};
use inference::algebra::solve_spd;

const POOL: Pool = SETTINGS.pool;

/// A number with one sigma.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Measured {
    pub(super) value: f64,
    pub(super) sigma: f64,
}

/// Sigma of a median over that of a mean.
const MEDIAN: f64 = 1.25;

impl Measured {
    /// Whether it is large enough to act on and far enough from zero to be believed.
    pub(super) fn is_reportable(&self, interest: f64) -> bool {
        self.value.abs() > interest && self.value.abs() > POOL.sure * self.sigma
    }
}

fn values(of: &[Measured]) -> Vec<f64> {
    of.iter().map(|m| m.value).collect()
}

fn determined(runs: &[Option<Measured>], interest: f64) -> Vec<Measured> {
    runs.iter().flatten().copied().filter(|m| m.sigma < POOL.determined * interest).collect()
}

/// Median and the sigma of it by the spread.
pub(super) fn median(v: &[f64]) -> Option<(f64, f64)> {
    let m = robust::median(v.iter().copied())?;
    let spread = v.iter().map(|x| (x - m).powi(2)).sum::<f64>() / (v.len().max(2) - 1) as f64;
    Some((m, (spread / v.len() as f64).sqrt()))
}

/// What the runs show by themselves: their median, no surer than their spread and their own sigmas let it be.
///
/// A run that does not determine the number to a share of the size that matters has no say.
pub(super) fn alone(runs: &[Option<Measured>], interest: f64) -> Option<Measured> {
    let determined = determined(runs, interest);
    let (value, spread) = median(&values(&determined))?;
    let n = determined.len() as f64;
    let own = (determined.iter().map(|m| m.sigma * m.sigma).sum::<f64>() / n / n).sqrt();
    Some(Measured { value, sigma: spread.max(own) })
}

/// How far the recordings differ from the references, by medians; `None` when either determines nothing.
///
/// A run that does not determine the number to a share of the size that matters has no say.
pub(super) fn beyond(
    recordings: &[Option<Measured>],
    references: &[Option<Measured>],
    interest: f64,
) -> Option<Measured> {
    let mut middle = [0.0; 2];
    let mut squares = POOL.worth * (POOL.usual_spread * interest).powi(2);
    let (mut own, mut count, mut share) = (0.0, 0.0, 0.0);
    for (middle, group) in middle.iter_mut().zip([recordings, references]) {
        let determined = determined(group, interest);
        *middle = median(&values(&determined))?.0;
        squares += determined.iter().map(|m| (m.value - *middle).powi(2)).sum::<f64>();
        own += determined.iter().map(|m| m.sigma * m.sigma).sum::<f64>();
        count += determined.len() as f64;
        share += 1.0 / determined.len() as f64;
    }
    let spread = (squares / (POOL.worth + count - 2.0)).max(own / count);
    Some(Measured { value: middle[0] - middle[1], sigma: MEDIAN * (spread * share).sqrt() })
}

/// How far the recordings differ from the references, or, where there are none to ask, from zero by more than is usual, one sigma.
pub(super) fn beyond_usual(
    recordings: &[Option<Measured>],
    references: &[Option<Measured>],
    (usual, interest): (f64, f64),
) -> Option<Measured> {
    if references.is_empty() {
        return alone(recordings, interest).map(|m| Measured { sigma: m.sigma.hypot(usual), ..m });
    }
    beyond(recordings, references, interest)
}

/// Least squares of `rows` of columns and value, each coefficient with its sigma; `alike` rows tell as much as one.
pub(super) fn least_squares<const N: usize>(rows: &[([f64; N], f64)], alike: f64) -> Option<[Measured; N]> {
    let count = rows.len() as f64 / alike;
    if count < (N + 2) as f64 {
        return None;
    }
    let mut scale = [0.0_f64; N];
    for (row, _) in rows {
        for (scale, x) in scale.iter_mut().zip(row) {
            *scale += x * x;
        }
    }
    let scale = scale.map(|s| if s > 0.0 { s.sqrt() } else { 1.0 });
    let mut m = Mat::from_fn(N, N, |i, j| if i == j { POOL.ridge } else { 0.0 });
    let mut b: Mat<f64> = Mat::zeros(N, 1);
    for (row, y) in rows {
        for i in 0..N {
            b[(i, 0)] += row[i] / scale[i] * y;
            for j in 0..N {
                m[(i, j)] += row[i] / scale[i] * row[j] / scale[j];
            }
        }
    }
    let (x, _) = solve_spd(&m, &b)?;
    let (inverse, _) = solve_spd(&m, &Mat::identity(N, N))?;
    let miss = |(row, y): &([f64; N], f64)| y - (0..N).map(|i| row[i] / scale[i] * x[(i, 0)]).sum::<f64>();
    let left: f64 = rows.iter().map(|r| miss(r).powi(2)).sum::<f64>() / (count - N as f64);
    Some(std::array::from_fn(|i| Measured {
        value: x[(i, 0)] / scale[i],
        sigma: (left * inverse[(i, i)].max(0.0)).sqrt() / scale[i],
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(values: &[f64]) -> Vec<Option<Measured>> {
        values.iter().map(|&value| Some(Measured { value, sigma: 0.01 })).collect()
    }

    #[test]
    fn a_difference_is_reported_beyond_the_spread_of_the_runs() {
        let quiet = beyond(&all(&[1.3, 1.31, 1.29]), &all(&[1.0, 1.01, 0.99]), 0.2).expect("told");
        approx::assert_abs_diff_eq!(quiet.value, 0.3, epsilon = 1e-12);
        assert!(quiet.is_reportable(0.2) && !quiet.is_reportable(0.4));
        let noisy = beyond(&all(&[1.1, 1.3, 1.7]), &all(&[0.7, 1.0, 1.2]), 0.2).expect("told");
        assert!(!noisy.is_reportable(0.2), "{noisy:?}");
    }

    #[test]
    fn runs_that_determine_nothing_have_no_say() {
        let vague = Some(Measured { value: 9.0, sigma: 5.0 });
        let mut runs = all(&[1.0, 1.0]);
        runs.extend([vague, None, vague]);
        approx::assert_abs_diff_eq!(beyond(&runs, &all(&[1.0]), 0.2).expect("told").value, 0.0);
        assert!(beyond(&[vague], &all(&[1.0]), 0.2).is_none() && beyond(&[], &[], 0.2).is_none());
    }

    #[test]
    fn least_squares_has_the_coefficients_and_their_sigmas() {
        // 2 + 3 x with an error of ±0.1 that neither column sees.
        let rows: Vec<([f64; 2], f64)> = (0..400)
            .map(|i| (f64::from(i / 2) * 0.01 - 1.0, if i % 2 == 0 { 0.1 } else { -0.1 }))
            .map(|(x, e)| ([1.0, x], 2.0 + 3.0 * x + e))
            .collect();
        let [a, b] = least_squares(&rows, 1.0).expect("determined");
        approx::assert_abs_diff_eq!(a.value, 2.0, epsilon = 1e-6);
        approx::assert_abs_diff_eq!(b.value, 3.0, epsilon = 1e-6);
        approx::assert_abs_diff_eq!(a.sigma, 0.1 / 20.0, epsilon = 1e-4);
        // A column twice is not determined, one that is nowhere neither.
        let twice: Vec<([f64; 3], f64)> = rows.iter().map(|(r, y)| ([r[0], r[1], r[1]], *y)).collect();
        assert!(least_squares(&twice, 1.0).is_none_or(|x| x[2].sigma > 10.0));
        assert!(least_squares(&rows[..3], 1.0).is_none());
    }
}
