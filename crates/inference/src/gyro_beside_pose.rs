//! What share of a robot's turning its gyro shows, where a pose shows all of it.
//!
//! Over windows that follow each other the heading of the pose changes by `Δψ`, and the gyro's rate adds up to
//! `s Δψ + b T − τ Δω`: its scale `s`, its zero `b` over a window of length `T`, and a clock that is late by `τ`, over which the yaw rate
//! changes by `Δω` from one end of a window to the other. Ordinary least squares, once more without outliers.

use faer::Mat;
use robot_model::effects::gyro_scale::SPEC;
use verdict::{Cause, GyroBesidePose};

use crate::algebra::{inverse_spd, solve_spd};
use crate::interpolate;
use crate::robust::{MAD_TO_SIGMA, NINETY, median, median_absolute_deviation, normal_cdf, rms};
use crate::settings::{GyroAndPose, Settings};

const RULES: GyroAndPose = Settings::DEFAULT.gyro_beside_pose;

/// Over what the gyro and the pose of drives show of the same turning.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GyroShare {
    /// The gyro's turning over that of the pose.
    pub share: f64,
    /// One sigma of it.
    pub sigma: f64,
}

/// A signal: its instants, s, which rise, and its values.
pub type Signal<'a> = (&'a [f64], &'a [f64]);

/// Scale of a gyro, rad/s, beside the heading of a pose, rad, unwrapped; `None` where too little was turned to tell, where both do not show
/// one turning, or where the heading is reckoned from the wheels: `differences` of their speeds then tell as much, and no pose.
pub fn gyro_share(
    (instants, rates): Signal<'_>,
    (seen, headings): Signal<'_>,
    differences: Signal<'_>,
) -> Option<GyroShare> {
    if is_reckoned(differences, (seen, headings)) {
        return None;
    }
    let begin = instants.first()?.max(*seen.first()?);
    let end = instants.last()?.min(*seen.last()?);
    let turned = integral(instants, rates);
    // Where either of them is missing its turning is not known.
    let is_whole = |times: &[f64], from: f64, until: f64| {
        let inside = &times[times.partition_point(|t| *t < from)..times.partition_point(|t| *t <= until)];
        let ends = [from, until];
        let all = ends[..1].iter().chain(inside).chain(&ends[1..]);
        all.clone().zip(all.skip(1)).all(|(a, b)| b - a <= RULES.gap)
    };
    let count = ((end - begin) / RULES.window).floor().max(0.0) as usize;
    // Of a clock that is late by `late`.
    let windows_of = |late: f64| -> Vec<[f64; 4]> {
        let of = |k: usize| {
            let from = begin + RULES.window * k as f64;
            let until = from + RULES.window;
            let change = |t: &[f64], z: &[f64], by: f64| interpolate(t, z, until + by) - interpolate(t, z, from + by);
            let is_known = is_whole(instants, from, until) && is_whole(seen, from, until);
            let turning = [change(instants, rates, late), change(instants, &turned, late)];
            is_known.then(|| [change(seen, headings, 0.0), RULES.window, turning[0], turning[1]])
        };
        (0..count).filter_map(of).collect()
    };
    let (mut late, mut windows) = (0.0, windows_of(0.0));
    for _ in 1..RULES.rounds {
        late -= fitted(&windows)?.values[2];
        windows = windows_of(late);
    }
    if rms(windows.iter().map(|w| w[0]))? < RULES.least {
        return None;
    }
    let first = fitted(&windows)?;
    let left: Vec<f64> = windows.iter().map(|w| first.left(w)).collect();
    let most = RULES.outlier * MAD_TO_SIGMA * median_absolute_deviation(&left)?;
    let kept: Vec<[f64; 4]> = windows.into_iter().zip(left).filter(|(_, e)| e.abs() <= most).map(|(w, _)| w).collect();
    let Fitted { values, sigma } = fitted(&kept)?;
    let [least, most] = RULES.one_turning;
    (sigma < RULES.surest && (least..=most).contains(&values[0])).then_some(GyroShare { share: values[0], sigma })
}

/// Whether a heading is reckoned from the wheels: it turns as the difference of their speeds does, by one factor, where the turning of a
/// body scatters about that as its wheels slip.
fn is_reckoned((instants, differences): Signal<'_>, (seen, headings): Signal<'_>) -> bool {
    let by_wheels = integral(instants, differences);
    let count = seen.last().zip(seen.first()).map_or(0.0, |(last, first)| (last - first) / RULES.window) as usize;
    let change = |t: &[f64], z: &[f64], k: usize| {
        let from = seen[0] + RULES.window * k as f64;
        interpolate(t, z, from + RULES.window) - interpolate(t, z, from)
    };
    let both: Vec<[f64; 2]> =
        (0..count).map(|k| [change(instants, &by_wheels, k), change(seen, headings, k)]).collect();
    let sum = |i: usize, k: usize| both.iter().map(|b| b[i] * b[k]).sum::<f64>();
    let factor = sum(0, 1) / sum(0, 0);
    let left = both.iter().map(|[wheels, body]| (body - factor * wheels).powi(2)).sum::<f64>();
    // Speeds that are logged seldom add up to the heading more roughly than the robot reckoned it.
    let period = median(instants.windows(2).map(|w| w[1] - w[0])).unwrap_or(0.0);
    left < RULES.reckoned.max(RULES.reckoned_of_rows * period).powi(2) * sum(1, 1)
}

/// What a rate adds up to since the first of its instants.
fn integral(instants: &[f64], rates: &[f64]) -> Vec<f64> {
    let mut out = vec![0.0; instants.len()];
    for k in 1..instants.len() {
        out[k] = out[k - 1] + 0.5 * (rates[k] + rates[k - 1]) * (instants[k] - instants[k - 1]);
    }
    out
}

/// Scale, zero and lateness, and one sigma of the scale.
struct Fitted {
    values: [f64; 3],
    sigma: f64,
}

impl Fitted {
    fn left(&self, window: &[f64; 4]) -> f64 {
        window[3] - (0..3).map(|k| self.values[k] * window[k]).sum::<f64>()
    }
}

fn fitted(windows: &[[f64; 4]]) -> Option<Fitted> {
    if windows.len() < RULES.windows {
        return None;
    }
    let sum = |i: usize, k: usize| windows.iter().map(|w| w[i] * w[k]).sum::<f64>();
    // A gyro that is never late leaves nothing to tell by how much.
    let normal = Mat::from_fn(3, 3, |i, k| sum(i, k) + if i == k { f64::EPSILON } else { 0.0 });
    let (x, _) = solve_spd(&normal, &Mat::from_fn(3, 1, |i, _| sum(i, 3)))?;
    let values = [0, 1, 2].map(|k| x[(k, 0)]);
    let of = Fitted { values, sigma: 0.0 };
    let variance = windows.iter().map(|w| of.left(w).powi(2)).sum::<f64>() / (windows.len() - 3) as f64;
    Some(Fitted { sigma: (variance * inverse_spd(&normal)?[(0, 0)]).sqrt(), ..of })
}

/// Shares of several drives together.
pub fn together(shares: impl IntoIterator<Item = GyroShare>) -> Option<GyroShare> {
    let (mut sum, mut weight) = (0.0, 0.0);
    for GyroShare { share, sigma } in shares {
        let own = (sigma.powi(2) + RULES.drive.powi(2)).recip();
        sum += own * share;
        weight += own;
    }
    (weight > 0.0).then(|| GyroShare { share: sum / weight, sigma: weight.sqrt().recip() })
}

/// What the gyro shows in recordings beside what it shows in references, or beside all of the turning; `None` where recordings do not say.
pub fn compared(
    references: impl IntoIterator<Item = GyroShare>,
    recordings: impl IntoIterator<Item = GyroShare>,
) -> Option<GyroBesidePose> {
    let before = together(references);
    let GyroShare { share, sigma } = together(recordings)?;
    let usual = before.unwrap_or(GyroShare { share: 1.0, sigma: RULES.of_sheets });
    let sigma = sigma.hypot(usual.sigma);
    let off = (share - usual.share).abs();
    Some(GyroBesidePose {
        share,
        half: NINETY * sigma,
        references: before.map(|b| b.share),
        is_off: off > SPEC.interest * usual.share && off > RULES.clear * sigma,
    })
}

/// By how much the scale of a gyro is off.
fn off(gyro: &GyroBesidePose) -> f64 {
    gyro.share / gyro.references.unwrap_or(1.0) - 1.0
}

/// A gyro whose scale is off, as a cause.
pub fn cause(gyro: &GyroBesidePose) -> Cause {
    let sigma = gyro.half / NINETY / gyro.references.unwrap_or(1.0);
    Cause {
        magnitude: Some(off(gyro)),
        sigma: Some(sigma),
        unit: SPEC.parameters[0].unit.into(),
        ..Cause::plain(SPEC.id, SPEC.name, (1.0 - 2.0 * normal_cdf(-off(gyro).abs() / sigma)).min(RULES.surely))
    }
}

/// What is told of a gyro whose scale is off.
pub fn told(gyro: &GyroBesidePose) -> String {
    let before = gyro.references.map_or_else(String::new, |b| format!(", in the references {:.1} %", 100.0 * b));
    format!(
        "Missing: gyro scale error by {:+.3} \u{b1} {:.3} (90 %): the gyro shows {:.1} % of the turning that the pose shows{before}.",
        off(gyro),
        gyro.half / gyro.references.unwrap_or(1.0),
        100.0 * gyro.share
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A minute of turns to and fro: what a gyro of this scale, zero, rad/s, and lateness, s, shows, beside the heading.
    fn share(scale: f64, zero: f64, late: f64) -> Option<GyroShare> {
        beside_wheels(scale, zero, late, 0.1)
    }

    /// The same beside wheels that slip by a share that comes and goes.
    fn beside_wheels(scale: f64, zero: f64, late: f64, slip: f64) -> Option<GyroShare> {
        let time: Vec<f64> = (0..6000).map(|k| 0.01 * f64::from(k)).collect();
        let rate = |t: f64| 0.5 * (0.9 * t).sin() + 0.3 * (0.37 * t).cos();
        let heading = |t: f64| -0.5 / 0.9 * (0.9 * t).cos() + 0.3 / 0.37 * (0.37 * t).sin();
        let scatter = |k: usize| 0.002 * [0.8, -1.1, 0.4, -0.1, 0.9, -0.9][k % 6];
        let rates: Vec<f64> = time.iter().map(|t| scale * rate(t - late) + zero).collect();
        let seen: Vec<f64> = time.iter().step_by(7).copied().collect();
        let headings: Vec<f64> = seen.iter().enumerate().map(|(k, t)| heading(*t) + scatter(k)).collect();
        let wheels: Vec<f64> = time.iter().map(|t| 1.3 * rate(*t) * (1.0 + slip * (0.2 * t).sin())).collect();
        gyro_share((&time, &rates), (&seen, &headings), (&time, &wheels))
    }

    #[test]
    fn a_heading_that_is_reckoned_from_the_wheels_tells_nothing_of_a_gyro_nor_does_one_of_another_sign() {
        assert!(beside_wheels(1.08, 0.0, 0.0, 0.1).is_some());
        assert_eq!(beside_wheels(1.08, 0.0, 0.0, 0.0), None);
        assert_eq!(share(-1.0, 0.0, 0.0), None, "the gyro is turned over");
        assert_eq!(share(57.3, 0.0, 0.0), None, "it counts degrees");
    }

    #[test]
    fn a_scale_is_told_from_a_zero_and_from_a_late_clock() {
        for (scale, zero, late) in [(1.0, 0.0, 0.0), (1.08, 0.0, 0.0), (0.95, 0.02, 0.0), (1.03, 0.0, 0.12)] {
            let found = share(scale, zero, late).expect("enough turning");
            assert!((found.share - scale).abs() < (3.0 * found.sigma).max(2e-3), "{scale} {zero} {late}: {found:?}");
            assert!(found.sigma < 5e-3);
        }
    }

    #[test]
    fn drives_without_turning_or_without_a_pose_for_most_of_the_time_tell_nothing() {
        let time: Vec<f64> = (0..600).map(|k| 0.1 * f64::from(k)).collect();
        let scatter: Vec<f64> = (0..600).map(|k| 0.002 * [0.8, -1.1, 0.4, -0.1, 0.9][k % 5]).collect();
        let wheels = (&time[..], &[0.0; 600][..]);
        assert_eq!(gyro_share((&time, &scatter), (&time, &scatter), wheels), None);
        let turned: Vec<f64> = time.iter().map(|t| t.sin()).collect();
        let now_and_then: Vec<f64> = time.iter().step_by(20).copied().collect();
        let rate: Vec<f64> = time.iter().map(|t| t.cos()).collect();
        let seen: Vec<f64> = turned.iter().step_by(20).copied().collect();
        assert_eq!(gyro_share((&time, &rate), (&now_and_then, &seen), wheels), None);
        assert!(gyro_share((&time, &rate), (&time, &turned), wheels).is_some());
    }

    #[test]
    fn a_change_is_told_only_where_it_is_clear_and_matters() {
        let of = |share: f64| Some(GyroShare { share, sigma: 0.002 });
        let gyro = compared(of(1.0), of(1.08)).expect("both");
        let cause = cause(&gyro);
        assert!(gyro.is_off && (cause.magnitude.unwrap_or(0.0) - 0.08).abs() < 1e-9 && cause.probability > 0.98);
        assert!(told(&gyro).contains("+0.080") && told(&gyro).contains("108.0 %"), "{}", told(&gyro));
        let is_off = |before: Option<f64>, now: f64| compared(before.and_then(of), of(now)).is_some_and(|g| g.is_off);
        assert!(!is_off(Some(1.08), 1.08), "as on the references");
        assert!(!is_off(Some(1.0), 1.012), "too little to matter");
        assert!(!is_off(None, 1.03), "gyros are calibrated no better");
        assert!(is_off(None, 1.08));
        assert_eq!(compared(of(1.0), None), None);
    }
}
