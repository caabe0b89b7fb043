//! What befalls recordings on the way: late and drifting clocks, heavy tails, coarse steps, lost rows, an early end.

use examiner::DrawnCase;
use torque_driven::Run;

/// A channel of which each sample comes late by some rows.
pub(crate) fn late(channel: &[Option<f64>], rows: usize) -> Vec<Option<f64>> {
    let kept = channel.len().saturating_sub(rows);
    let start = channel.len() - kept;
    std::iter::repeat_n(None, start).chain(channel[..kept].iter().copied()).collect()
}

/// A channel whose clock is fast by a share: its samples are stamped ever later.
pub(crate) fn drifting(channel: &[Option<f64>], share: f64) -> Vec<Option<f64>> {
    let mut out = vec![None; channel.len()];
    for (k, v) in channel.iter().enumerate() {
        let row = (k as f64 * (1.0 + share)).round() as usize;
        if let (Some(slot), Some(v)) = (out.get_mut(row), v) {
            *slot = Some(*v);
        }
    }
    out
}

/// Changes the pose of every run.
pub(crate) fn on_pose(runs: &mut [Run], change: impl Fn(&[Option<f64>]) -> Vec<Option<f64>>) {
    for channel in runs.iter_mut().flat_map(|r| &mut r.pose) {
        *channel = change(channel);
    }
}

/// Changes the gyro of every run.
pub(crate) fn on_gyro(runs: &mut [Run], change: impl Fn(&[Option<f64>]) -> Vec<Option<f64>>) {
    for run in runs {
        run.gyro = change(&run.gyro);
    }
}

/// Uniform numbers in 0..1 by `SplitMix64`.
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Adds Cauchy noise of half the stated sigma, cut at 50 of it: outliers that no normal law lets expect.
pub(crate) fn heavy_tails(runs: &mut [Run], seed: u64) {
    let mut dice = Dice(seed);
    let mut spoil = |channel: &mut [Option<f64>], sigma: f64| {
        for v in channel.iter_mut().flatten() {
            *v += 0.5 * sigma * (std::f64::consts::PI * (dice.roll() - 0.5)).tan().clamp(-50.0, 50.0);
        }
    };
    for run in runs {
        spoil(&mut run.gyro, 0.006);
        run.accel.iter_mut().for_each(|c| spoil(c, 0.08));
        run.pose.iter_mut().for_each(|c| spoil(c, 0.004));
    }
}

/// Quantises far more coarsely than the robot file says: 512 counts a turn, 0.02 rad/s, 0.02 m and rad.
pub(crate) fn coarse_steps(runs: &mut [Run]) {
    // To the nearest step: rounding down would be an offset, which is there to be told.
    let round = |channel: &mut [Option<f64>], step: f64| {
        for v in channel.iter_mut().flatten() {
            *v = (*v / step).round() * step;
        }
    };
    for run in runs {
        run.angle.iter_mut().for_each(|c| round(c, std::f64::consts::TAU / 512.0));
        round(&mut run.gyro, 0.02);
        run.pose.iter_mut().for_each(|c| round(c, 0.02));
    }
}

/// Loses rows of every file in bursts of up to twelve, about a tenth of all.
pub(crate) fn lost_rows(drawn: &mut DrawnCase, seed: u64) {
    let mut dice = Dice(seed);
    for (path, bytes) in &mut drawn.files {
        if path.extension().is_none_or(|e| e != "csv") {
            continue;
        }
        let text = std::str::from_utf8(bytes).expect("text");
        let mut out = String::with_capacity(text.len());
        let mut missing = 0;
        for (k, line) in text.lines().enumerate() {
            if k > 20 && missing == 0 && dice.roll() < 0.017 {
                missing = 1 + (12.0 * dice.roll()) as usize;
            }
            if missing > 0 {
                missing -= 1;
            } else {
                out += line;
                out.push('\n');
            }
        }
        *bytes = out.into_bytes();
    }
}

/// A run from one instant to another, s.
pub(crate) fn between(run: &Run, [from, until]: [f64; 2]) -> Run {
    let row = |t: f64| ((t / run.period) as usize).min(run.rows());
    let rows = row(from)..row(until);
    let mut out = run.clone();
    out.torque = run.torque[rows.clone()].to_vec();
    let channels = out.angle.iter_mut().chain([&mut out.gyro]).chain(&mut out.accel).chain(&mut out.pose);
    channels.for_each(|c| *c = c[rows.clone()].to_vec());
    out
}
