//! A recording as stretches of samples without a gap.

use anyhow::{Context, Result, bail, ensure};
use case_files::case_folder::file_names;
use recordings::Read;
use robot_file::RobotSpec;

use super::choose::choose;
use super::lines::{Line, longest_ns, period_ns};

/// Fewer samples than this say nothing about an identifier.
const LEAST: usize = 20;
/// More samples than this are a mistyped step.
const MOST: f64 = 1e8;

/// Samples without a gap.
#[derive(Debug, Default)]
pub(super) struct Stretch {
    /// Time from the recording's first sample, s.
    pub(super) time: Vec<f64>,
    /// Wheel speeds, rad/s.
    pub(super) speed: Vec<[f64; 2]>,
    /// Torques from each instant to the next, N m.
    pub(super) torque: Vec<[f64; 2]>,
    /// Wheel angles, rad; empty when not recorded.
    pub(super) angle: Vec<[f64; 2]>,
}

/// What the identifier is shown.
#[derive(Debug)]
pub(super) struct Samples {
    pub(super) stretches: Vec<Stretch>,
    /// Usual time between samples, s.
    pub(super) period: f64,
    /// Period that was resampled to, s.
    pub(super) resampled: Option<f64>,
    /// Instants that lay alone in gaps, or lacked a signal.
    pub(super) dropped: usize,
    /// The state in words.
    pub(super) state: String,
    /// The input in words.
    pub(super) input: String,
}

impl Samples {
    /// Number of samples.
    pub(super) fn len(&self) -> usize {
        self.stretches.iter().map(|s| s.time.len()).sum()
    }

    /// Gaps at which the identifier starts anew.
    pub(super) fn gaps(&self) -> usize {
        self.stretches.len().saturating_sub(1)
    }

    /// Largest speed of either side, rad/s.
    pub(super) fn fastest(&self) -> f64 {
        let speeds = self.stretches.iter().flat_map(|s| &s.speed).flatten();
        speeds.fold(0.0, |a: f64, v| a.max(v.abs()))
    }
}

/// Takes the samples that the identifier needs out of a recording.
pub(super) fn sample(read: &Read, robot: &RobotSpec, step: Option<f64>) -> Result<Samples> {
    let chosen = choose(&read.recording, robot).with_context(|| file_names(read))?;
    let [left, right] = chosen.speed;
    let (longest, origin) = (longest_ns(left.t_ns()), left.t_ns().first().copied().unwrap_or(0));
    let right = Line::new(right);
    let inputs = chosen.input.map(Line::new);
    let angles = chosen.angle.map(|pair| pair.map(Line::new));

    let mut stretches = vec![Stretch::default()];
    let mut last = None::<i64>;
    for (t, left) in left.samples() {
        let row = (|| {
            let speed = [left, right.at(t)?];
            let mut torque = [inputs[0].held(t)?, inputs[1].held(t)?];
            for (u, x) in torque.iter_mut().zip(speed) {
                let sign = if chosen.unsigned && x < 0.0 { -1.0 } else { 1.0 };
                *u *= sign * chosen.input_factor;
            }
            let angle = match &angles {
                Some([l, r]) => Some([l.at(t)?, r.at(t)?]),
                None => None,
            };
            Some((speed, torque, angle))
        })();
        let Some((speed, torque, angle)) = row else {
            last = None;
            continue;
        };
        if last.is_none_or(|last| t - last > longest) {
            stretches.push(Stretch::default());
        }
        last = Some(t);
        if let Some(s) = stretches.last_mut() {
            s.time.push((t - origin) as f64 * 1e-9);
            s.speed.push(speed);
            s.torque.push(torque);
            s.angle.extend(angle);
        }
    }
    stretches.retain(|s| s.time.len() > 1);
    let period = period_ns(left.t_ns()) as f64 * 1e-9;
    let mut samples = Samples {
        dropped: left.len() - stretches.iter().map(|s| s.time.len()).sum::<usize>(),
        stretches,
        period,
        resampled: step,
        state: chosen.state_words,
        input: chosen.input_words,
    };
    let files = file_names(read);
    ensure!(
        samples.len() >= LEAST,
        "{files}: only {} samples hold {} and {} without a gap, but at least {LEAST} are needed; record longer",
        samples.len(),
        samples.state,
        samples.input
    );
    ensure!(samples.fastest() > 0.0, "{files}: the wheels never turn in this recording; record a drive");
    if let Some(step) = step {
        resample(&mut samples, step)?;
    }
    Ok(samples)
}

/// Puts every stretch on a grid of its own.
fn resample(samples: &mut Samples, step: f64) -> Result<()> {
    let length = |s: &Stretch| s.time.last().unwrap_or(&0.0) - s.time.first().unwrap_or(&0.0);
    let driven: f64 = samples.stretches.iter().map(length).sum();
    if driven / step > MOST {
        bail!("{driven:.0} s in steps of {step} s are more than {MOST:.0e} samples; choose a longer --step");
    }
    for s in &mut samples.stretches {
        *s = s.on_grid(step);
    }
    samples.stretches.retain(|s| s.time.len() > 1);
    samples.period = step;
    ensure!(samples.len() >= LEAST, "a --step of {step} s leaves fewer than {LEAST} samples; choose a shorter one");
    Ok(())
}

impl Stretch {
    /// Speeds and angles on straight lines between samples, torques held.
    fn on_grid(&self, step: f64) -> Self {
        let mut out = Self::default();
        let (Some(first), Some(last)) = (self.time.first(), self.time.last()) else {
            return out;
        };
        let steps = ((last - first) / step + 1e-9).floor() as usize;
        let mut i = 0;
        for k in 0..=steps {
            let t = first + k as f64 * step;
            while i + 2 < self.time.len() && self.time[i + 1] <= t {
                i += 1;
            }
            let share = ((t - self.time[i]) / (self.time[i + 1] - self.time[i])).clamp(0.0, 1.0);
            let line =
                |v: &[[f64; 2]]| -> [f64; 2] { std::array::from_fn(|j| v[i][j] + share * (v[i + 1][j] - v[i][j])) };
            out.time.push(t);
            out.speed.push(line(&self.speed));
            out.torque.push(self.torque[if share < 1.0 { i } else { i + 1 }]);
            if !self.angle.is_empty() {
                out.angle.push(line(&self.angle));
            }
        }
        out
    }
}
