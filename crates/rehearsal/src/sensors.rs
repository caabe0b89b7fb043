//! Noise and rates of the recordings' sensors, and what such sensors show of a simulated drive.

use inference::robust::{MAD_TO_SIGMA, median};
use recordings::{Recording, Signal};
use torque_driven::Run;
use verdict::SensorNoise;

use crate::random::{Purpose, Stream};
use crate::settings::{Noises, SETTINGS};

const NOISE: Noises = SETTINGS.noise;

/// The channels of a run, in the order in which noise is drawn.
pub(crate) const CHANNELS: [Signal; 8] = [
    Signal::WheelAngleLeft,
    Signal::WheelAngleRight,
    Signal::GyroZ,
    Signal::AccelX,
    Signal::AccelY,
    Signal::PoseX,
    Signal::PoseY,
    Signal::PoseYaw,
];

/// A channel of a run by its place in [`CHANNELS`].
pub(crate) fn channel(run: &Run, place: usize) -> &Vec<Option<f64>> {
    match place {
        0 | 1 => &run.angle[place],
        2 => &run.gyro,
        3 | 4 => &run.accel[place - 3],
        _ => &run.pose[(place - 5).min(2)],
    }
}

/// The same, to be changed.
fn channel_mut(run: &mut Run, place: usize) -> &mut Vec<Option<f64>> {
    match place {
        0 | 1 => &mut run.angle[place],
        2 => &mut run.gyro,
        3 | 4 => &mut run.accel[place - 3],
        _ => &mut run.pose[(place - 5).min(2)],
    }
}

/// One sigma of each channel; `None` of those that no run holds.
pub(crate) type Sigmas = [Option<f64>; CHANNELS.len()];

/// Noise of all channels as the runs show it: places of the pose as the robot file states them,
/// `pose_sigma` in m, others as measured, and as usual where a simulator's log shows none.
pub(crate) fn noise(runs: &[&Run], pose_sigma: f64) -> (Sigmas, Vec<SensorNoise>) {
    let mut sigmas = Sigmas::default();
    let mut told = Vec::new();
    for (place, signal) in CHANNELS.into_iter().enumerate() {
        let of_runs = || runs.iter().map(|run| samples(channel(run, place)));
        let Some(rate) = median(runs.iter().filter_map(|run| rate(channel(run, place), run.period))) else { continue };
        let usual = match signal {
            Signal::WheelAngleLeft | Signal::WheelAngleRight => NOISE.angle,
            Signal::GyroZ => NOISE.gyro,
            Signal::AccelX | Signal::AccelY => NOISE.acceleration,
            Signal::PoseYaw => NOISE.heading,
            _ => pose_sigma,
        };
        let shown = median(of_runs().filter_map(|samples| measured(&samples))).filter(|s| *s > NOISE.none * usual);
        let (sigma, source) = match (signal, shown) {
            (Signal::PoseX | Signal::PoseY, _) => (pose_sigma, "robot file"),
            (_, Some(sigma)) => (sigma, "measured"),
            (_, None) => (usual, "usual: the recordings show none"),
        };
        sigmas[place] = Some(sigma);
        let (channel, unit) = (signal.name().into(), signal.unit().symbol().into());
        told.push(SensorNoise { channel, sigma, unit, rate, source: source.into() });
    }
    (sigmas, told)
}

fn samples(channel: &[Option<f64>]) -> Vec<f64> {
    channel.iter().copied().flatten().collect()
}

/// Samples per second of a channel whose rows are `period` s apart; `None` of one that is missing.
fn rate(channel: &[Option<f64>], period: f64) -> Option<f64> {
    let first = channel.iter().position(Option::is_some)?;
    let last = channel.iter().rposition(Option::is_some)?;
    let count = channel.iter().flatten().count();
    (last > first).then(|| (count - 1) as f64 / ((last - first) as f64 * period))
}

/// Sigma of white noise on a smooth signal: `1.4826 median|Δ³y| / √20`, since Δ³ of noise of one
/// sigma has variance 1 + 9 + 9 + 1, and of a smooth signal next to none; `None` of too few
/// samples.
fn measured(y: &[f64]) -> Option<f64> {
    if y.len() < NOISE.least_samples {
        return None;
    }
    let third = y.windows(4).map(|w| (w[3] - 3.0 * w[2] + 3.0 * w[1] - w[0]).abs());
    let variance = [1.0_f64, 3.0, 3.0, 1.0].map(|c| c * c).iter().sum::<f64>();
    median(third).map(|d| MAD_TO_SIGMA * d / variance.sqrt())
}

/// Standard normal numbers for every sample of a drive, channel by channel.
pub(crate) struct Noise(Vec<Vec<f64>>);

impl Noise {
    /// Noise for a template, fixed by the seed, the replica and the drive.
    pub(crate) fn draw(template: &Run, seed: u64, path: [usize; 2]) -> Self {
        let one = |place: usize| {
            let mut stream = Stream::new(seed, Purpose::Noise, &[path[0], path[1], place]);
            channel(template, place).iter().map(|sample| sample.map_or(0.0, |_| stream.normal())).collect()
        };
        Self((0..CHANNELS.len()).map(one).collect())
    }
}

/// What the template's sensors show of a simulated drive: its rows, its gaps, noise of these sigmas.
///
/// Encoders are read at the row; samples of other clocks are written in the first row after their
/// instant, on average half a row late.
pub(crate) fn shown(template: &Run, ideal: &Recording, sigmas: &Sigmas, noise: &Noise) -> Run {
    let mut run = template.clone();
    run.from = 0.0;
    for (place, signal) in CHANNELS.into_iter().enumerate() {
        let (Some(sigma), Some(values)) = (sigmas[place], ideal.get(signal).map(recordings::Channel::values)) else {
            continue;
        };
        let is_angle = matches!(signal, Signal::WheelAngleLeft | Signal::WheelAngleRight);
        for (row, sample) in channel_mut(&mut run, place).iter_mut().enumerate() {
            let before = if is_angle { row } else { row.saturating_sub(1) };
            let taken = values.get(row).zip(values.get(before)).map(|(now, before)| 0.5 * (now + before));
            *sample = sample.and(taken).map(|y| y + sigma * noise.0[place][row]);
        }
    }
    run
}

/// How far the wheels of a run turn, forth and back, rad: by rows some time apart, so that noise adds nothing.
pub(crate) fn way(run: &Run) -> f64 {
    let apart = ((NOISE.apart / run.period).round() as usize).max(1);
    let of = |angle: &Vec<Option<f64>>| -> f64 {
        let sparse: Vec<f64> = angle.iter().step_by(apart).copied().flatten().collect();
        sparse.windows(2).map(|w| (w[1] - w[0]).abs()).sum()
    };
    run.angle.iter().map(of).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_on_a_smooth_signal_is_measured_and_the_signal_is_not() {
        let mut stream = Stream::new(1, Purpose::Noise, &[7]);
        let smooth: Vec<f64> = (0..2000).map(|k| (0.02 * f64::from(k)).sin()).collect();
        let noisy: Vec<f64> = smooth.iter().map(|y| y + 0.006 * stream.normal()).collect();
        let sigma = measured(&noisy).expect("enough samples");
        assert!((sigma / 0.006 - 1.0).abs() < 0.1, "{sigma}");
        assert!(measured(&smooth).expect("enough samples") < 1e-5);
        assert_eq!(measured(&noisy[..10]), None);
    }

    #[test]
    fn rates_are_those_of_the_samples_that_are_there() {
        let every_tenth: Vec<Option<f64>> = (0..1000).map(|k| (k % 10 == 3).then_some(1.0)).collect();
        assert!((rate(&every_tenth, 0.01).expect("there") - 10.0).abs() < 1e-9);
        assert_eq!(rate(&[None, None], 0.01), None);
    }
}
