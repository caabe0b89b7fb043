//! The slope under the robot from the turning rates of its body and from the straight load.
//!
//! The upward direction in the body turns by `u̇ = −ω × u`, for small tilts `u̇x = −ω_y + ω_z u_y` and
//! `u̇y = ω_x − ω_z (u_x + a)`, where the forward axis of the unit leans up by `a` in the body; the straight load shows
//! `S = S₀ (1 + c) + m g r u_x` in the direction of travel, an accelerometer `u_x + a`. A linear Kalman filter and
//! Rauch–Tung–Striebel smoother over `u_x`, `u_y`, two gyro offsets, the slow change `c` of the rolling load, and `a`
//! (J. S. Meditch, *Stochastic Optimal Linear Estimation and Control*, 1969, ch. 6).

use inference::interpolate;
use inference::robust::{MAD_TO_SIGMA, median};
use nalgebra::{SMatrix, SVector};

use crate::run::SpeedRun;
use crate::settings::{CHANGES, MEASURING, NAMING, changes::Filter};
use crate::straight::Reading;

type State = SVector<f64, 6>;
type Square = SMatrix<f64, 6, 6>;

const FILTER: Filter = CHANGES.attitude;

/// Takes what the accelerometer shows on the references, its own tilt in the body, out of the recordings.
pub(crate) fn set_level(references: &[SpeedRun], recordings: &mut [SpeedRun]) {
    let rates = references.iter().filter_map(|run| run.body_rates.as_ref());
    let Some(tilt) = median(rates.filter_map(|rates| rates.level.as_ref()).flatten().copied()) else { return };
    for rates in recordings.iter_mut().filter_map(|run| run.body_rates.as_mut()) {
        rates.level.iter_mut().flatten().for_each(|level| *level -= tilt);
        rates.level_sigma = MEASURING.mounting.known;
    }
}

/// Means of the accelerometer that do not overlap: steps at which they are taken, and their error, rad.
fn level_of(level: &[f64], step: f64) -> (usize, f64) {
    let every = ((MEASURING.rows.level_mean / step) as usize).max(1);
    let means: Vec<f64> = level.iter().step_by(every).copied().collect();
    let moved = median(means.windows(2).map(|w| (w[1] - w[0]).abs())).unwrap_or(0.0);
    (every, (MAD_TO_SIGMA / std::f64::consts::SQRT_2 * moved).max(FILTER.from_level))
}

/// How far a tilt walks by the noise of its turning rate, rad/√s: by how much more what it turns differs from window to window where
/// windows are longer, so that neither an offset nor vibration, which comes back, counts.
fn noise_walk(rate: &[f64], step: f64) -> f64 {
    let variance = |window: f64| {
        let rows = ((window / step) as usize).max(1);
        let turned: Vec<f64> = rate.chunks_exact(rows).map(|window| step * window.iter().sum::<f64>()).collect();
        let scatter = median(turned.windows(2).map(|w| (w[1] - w[0]).abs())).unwrap_or(0.0);
        0.5 * (MAD_TO_SIGMA * scatter).powi(2)
    };
    let [short, long] = FILTER.noise_windows;
    if (rate.len() as f64) * step < FILTER.noise_least * long {
        return 0.0;
    }
    ((variance(long) - variance(short)) / (long - short)).max(0.0).sqrt()
}

/// The slope along the heading at the rows of a recording, uphill positive.
#[derive(Debug, Clone)]
pub(crate) struct Attitude {
    /// rad.
    pub(crate) pitch: Vec<f64>,
    /// One sigma, rad.
    pub(crate) sigma: Vec<f64>,
    /// The same by the turning rates alone, without the loads: it drifts, rad.
    pub(crate) by_rates: Vec<f64>,
    /// How far the nose has risen by its own turning `∫ (b_y − ω_y) dt`, rad: a roll that a turn makes a pitch is none.
    pub(crate) nose: Vec<f64>,
    /// How far the body has turned about its vertical axis, rad.
    pub(crate) turned: Vec<f64>,
    /// Against the rest of the recording only: no accelerometer tells the level of a body on ground that gives way.
    pub(crate) relative: bool,
}

/// A filter's estimate after a step, and what it had expected before.
struct Step {
    x: State,
    p: Square,
    expected_x: State,
    expected_p: Square,
    transition: Square,
}

/// One scalar measurement `z = h·x` of variance `r`.
fn update(x: &mut State, p: &mut Square, h: &State, z: f64, r: f64) {
    let ph = *p * h;
    let gain = ph / (h.dot(&ph) + r);
    *x += gain * (z - h.dot(x));
    *p -= gain * ph.transpose();
}

/// Slope at the rows; `None` without all three turning rates. `usual` is the straight load on level ground, N m, and
/// `weight` the torque of the robot's weight at a wheel's radius `m g r`, N m. On the stretches `sloping`, from and until
/// in s, the ground does not count as level.
pub(crate) fn attitude(
    run: &SpeedRun,
    readings: &[Option<Reading>],
    usual: f64,
    weight: f64,
    sloping: &[[f64; 2]],
) -> Option<Attitude> {
    let with_loads = estimate(run, readings, usual, weight, sloping)?;
    let by_rates = estimate(run, &vec![None; readings.len()], usual, weight, sloping)?;
    // Where the load is another from end to end the ground may tilt the body, too.
    let exact = readings.iter().flatten().filter(|r| r.is_exact()).map(|r| r.value());
    let middle = median(exact).map_or(1.0, |middle| middle / usual);
    let levelled = run.body_rates.as_ref().is_some_and(|rates| rates.level.is_some());
    let relative = !levelled && middle > NAMING.priors.unnamed_straight;
    Some(Attitude { by_rates: by_rates.pitch, nose: by_rates.nose, relative, ..with_loads })
}

/// The filter and smoother; of readings that are none it takes the turning rates alone.
fn estimate(
    run: &SpeedRun,
    readings: &[Option<Reading>],
    usual: f64,
    weight: f64,
    sloping: &[[f64; 2]],
) -> Option<Attitude> {
    let rates = run.body_rates.as_ref()?;
    let lag = &run.alignment.as_ref()?.lag;
    let period = run.period();
    let (first, dt) = (*rates.time.first()?, rates.step);
    let rows = rates.time.len();

    // Readings by the step of the gyro's clock at which they were taken.
    let mut seen: Vec<Vec<usize>> = vec![Vec::new(); rows];
    for (i, _) in readings.iter().enumerate().filter(|(_, r)| r.is_some()) {
        let step = ((run.time[i] + lag[i] - first) / dt).round();
        // What was driven while the gyro was off says nothing of its attitude.
        if step >= 0.0 && (step as usize) < rows {
            seen[step as usize].push(i);
        }
    }

    // What walks between steps: tilt, offsets, rolling load.
    let exact = readings.iter().flatten().filter(|r| r.is_exact()).map(|r| r.value());
    let middle = median(exact).map_or(1.0, |middle| middle / usual);
    let excess = (middle - 1.0).abs();
    let rolling = FILTER.rolling.max(FILTER.excess * excess) * usual / weight;
    let keep = 1.0 - dt / FILTER.rolling_time;
    let mut walk = Square::zeros();
    // The pitch walks by the noise of the rate about the left axis, the roll by that about the forward axis. Where an accelerometer
    // holds both, what rocks the body is no noise.
    let of_noise = |axis: usize| if rates.level.is_some() { 0.0 } else { noise_walk(&rates.rate[axis], dt) };
    let [of_roll, of_pitch] = [0, 1].map(|axis| FILTER.tilt_walk.max(of_noise(axis)));
    for (k, q) in [of_pitch, of_roll, FILTER.offset_walk, FILTER.offset_walk].into_iter().enumerate() {
        walk[(k, k)] = q * q * dt;
    }
    walk[(4, 4)] = rolling * rolling * (1.0 - keep * keep);

    let level = rates.level.as_ref().map(|level| (level, level_of(level, dt)));
    let typical_lag = median(lag.iter().copied()).unwrap_or(0.0);
    let slopes = |t: f64| sloping.iter().any(|[from, until]| *from <= t - typical_lag && t - typical_lag <= *until);

    // Forward: expect by the turning rates, correct by the loads.
    // Without an accelerometer the lean shows in turns alone, in which it was looked for.
    let lean = if rates.level.is_some() { rates.level_sigma } else { 0.0 }.max(MEASURING.mounting.known);
    let first_offset = if rates.is_zero_known { FILTER.first_offset } else { FILTER.unknown_offset };
    let mut x = State::zeros();
    let [tilt, offset] = [FILTER.first_tilt, first_offset];
    let sigmas = State::from([tilt, tilt, offset, offset, rolling, lean]);
    let mut p = Square::from_diagonal(&sigmas.component_mul(&sigmas));
    let mut steps: Vec<Step> = Vec::with_capacity(rows);
    for (k, seen) in seen.iter().enumerate() {
        let [wx, wy, wz] = [0, 1, 2].map(|axis| rates.rate[axis][k]);
        let mut transition = Square::identity();
        transition[(0, 1)] = wz * dt;
        transition[(1, 0)] = -wz * dt;
        transition[(0, 2)] = dt;
        transition[(1, 3)] = -dt;
        transition[(4, 4)] = keep;
        // A unit that leans shows a part of the turning about its forward axis.
        transition[(1, 5)] = -wz * dt;
        x = transition * x + State::from([-wy * dt, wx * dt, 0.0, 0.0, 0.0, 0.0]);
        p = transition * p * transition.transpose() + walk;
        let (expected_x, expected_p) = (x, p);

        if !slopes(first + dt * k as f64) {
            let variance = FILTER.level * FILTER.level * FILTER.level_every / dt;
            for axis in 0..2 {
                update(&mut x, &mut p, &State::ith(axis, 1.0), 0.0, variance);
            }
        }
        if let Some((level, (every, sigma))) = level
            && k % every == 0
        {
            let h = State::from([1.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
            let miss = level[k] - h.dot(&x);
            let variance = sigma * sigma * (1.0 + (miss / FILTER.far_off).powi(2));
            update(&mut x, &mut p, &h, level[k], variance);
        }
        for &i in seen {
            let h = State::from([run.speed[0][i].signum(), 0.0, 0.0, 0.0, 1.0, 0.0]);
            let Some(reading) = readings[i] else { continue };
            let z = (reading.value() - usual) / weight;
            let miss = z - h.dot(&x);
            let variance = FILTER.from_load * FILTER.from_load / period;
            match reading {
                Reading::Exact(_) => {
                    update(&mut x, &mut p, &h, z, variance * (1.0 + (miss / FILTER.far_off).powi(2)));
                }
                Reading::AtMost(_) if miss < 0.0 => update(&mut x, &mut p, &h, z, variance),
                Reading::AtMost(_) => {}
            }
        }
        steps.push(Step { x, p, expected_x, expected_p, transition });
    }

    // Backward: what came later corrects what was known before.
    for k in (0..rows.saturating_sub(1)).rev() {
        let (before, after) = steps.split_at_mut(k + 1);
        let (now, next) = (&mut before[k], &after[0]);
        let gain = now.p * next.transition.transpose() * next.expected_p.try_inverse()?;
        now.x += gain * (next.x - next.expected_x);
        now.p += gain * (next.p - next.expected_p) * gain.transpose();
    }

    // On the rows, where the gyro was on.
    let pitch: Vec<f64> = steps.iter().map(|s| s.x[0]).collect();
    let sigma: Vec<f64> = steps.iter().map(|s| s.p[(0, 0)].max(0.0).sqrt()).collect();
    let nose = integral(rates.rate[1].iter().zip(&steps).map(|(wy, s)| dt * (s.x[2] - wy)));
    let turned = integral(rates.rate[2].iter().map(|wz| dt * wz));
    let last = first + dt * rows as f64;
    let at_rows = |z: &[f64], unknown: f64| -> Vec<f64> {
        let at = |t: f64| if t > first - dt && t < last { interpolate(&rates.time, z, t) } else { unknown };
        run.time.iter().zip(lag).map(|(t, l)| at(t + l)).collect()
    };
    let sigma = at_rows(&sigma, f64::INFINITY);
    let held = |z: &[f64]| run.time.iter().zip(lag).map(|(t, l)| interpolate(&rates.time, z, t + l)).collect();
    let [nose, turned] = [held(&nose), held(&turned)];
    Some(Attitude { pitch: at_rows(&pitch, 0.0), sigma, by_rates: Vec::new(), nose, turned, relative: false })
}

/// Running sums.
fn integral(steps: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut sum = 0.0;
    steps
        .map(|step| {
            sum += step;
            sum
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tilt_walks_by_the_noise_of_a_rate_and_not_by_vibration_or_in_a_short_drive() {
        // White noise by a generator of equal digits in every run: uniform, of 0.02 rad/s rms.
        let mut state = 7_u64;
        let mut uniform = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            ((state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5) * 12.0_f64.sqrt()
        };
        let white: Vec<f64> = (0..3000).map(|_| 0.02 * uniform()).collect();
        let expected = 0.02 * 0.1_f64.sqrt();
        let walk = noise_walk(&white, 0.1);
        assert!((0.7 * expected..1.4 * expected).contains(&walk), "{walk} of {expected}");
        assert_eq!(noise_walk(&white[..300], 0.1), 0.0);
        let vibration: Vec<f64> = (0..3000).map(|k| 0.05 * (2.9 * f64::from(k)).sin()).collect();
        assert!(noise_walk(&vibration, 0.1) < 0.5 * expected, "{}", noise_walk(&vibration, 0.1));
    }
}
