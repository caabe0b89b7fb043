//! What the channels of a recording say of one motion, on common rows.

use recordings::{Channel, Recording, Signal};

use crate::grid::{binned, slope};
use crate::settings::{Columns, SETTINGS};
use inference::robust::median;

const COLUMNS: Columns = SETTINGS.columns;

/// Left and right.
pub(super) type Sides = [Vec<f64>; 2];

/// The channels of a recording on rows of equal distance, NaN where a channel is missing; angles and places as speeds.
pub(super) struct Motion {
    /// Speeds of the wheels, rad/s, and the signals that they come from: set speeds where none are measured.
    pub(super) wheels: Option<(Sides, [Signal; 2])>,
    /// Set speeds, rad/s.
    pub(super) commands: Option<Sides>,
    /// Torques, N m.
    pub(super) torques: Option<Sides>,
    /// Yaw rate by the gyro, rad/s.
    pub(super) gyro: Option<Vec<f64>>,
    /// Heading, rad without jumps, and its rate, rad/s.
    pub(super) heading: Option<[Vec<f64>; 2]>,
    /// Speed of the place along world x and y, m/s.
    pub(super) travel: Option<[Vec<f64>; 2]>,
    /// Specific force forward and to the left, m/s².
    pub(super) force: Option<[Vec<f64>; 2]>,
}

impl Motion {
    /// The motion of a recording over the time that all its channels cover.
    pub(super) fn of(recording: &Recording) -> Self {
        let spans = recording.channels().iter().filter_map(Channel::span_ns);
        let (from_ns, until_ns) = spans.reduce(|a, b| (a.0.max(b.0), a.1.min(b.1))).unwrap_or_default();
        let step_ns = COLUMNS.step * 1e9;
        let count = ((until_ns - from_ns) as f64 / step_ns).max(0.0) as usize;
        let rows = |channel: &Channel| binned(channel, from_ns, step_ns, count);

        let dense = |signal: Signal| recording.get(signal).filter(|channel| is_dense(channel));
        let value = |signal: Signal| dense(signal).map(rows);
        let rate = |signal: Signal| Some(slope(&value(signal)?, COLUMNS.step));
        let turned = |channel: &Channel| {
            let clock = channel.clock();
            let unwrapped = Channel::new(channel.signal(), clock, channel.t_ns().to_vec(), channel.unwrapped()).ok()?;
            let heading = rows(&unwrapped);
            let rate = slope(&heading, COLUMNS.step);
            Some([heading, rate])
        };
        let both = |of: &dyn Fn(Signal) -> Option<Vec<f64>>, [a, b]: [Signal; 2]| Some([of(a)?, of(b)?]);

        let angles = [Signal::WheelAngleLeft, Signal::WheelAngleRight];
        let speeds = [Signal::WheelSpeedLeft, Signal::WheelSpeedRight];
        let set_speeds = [Signal::CommandSpeedLeft, Signal::CommandSpeedRight];
        let measured = both(&rate, angles).map(|rates| (rates, angles));
        let measured = measured.or_else(|| Some((both(&value, speeds)?, speeds)));
        let commands = both(&value, set_speeds);
        Self {
            wheels: measured.or_else(|| Some((commands.clone()?, set_speeds))),
            commands,
            torques: both(&value, [Signal::TorqueLeft, Signal::TorqueRight]),
            gyro: value(Signal::GyroZ),
            heading: dense(Signal::PoseYaw).and_then(turned),
            travel: both(&rate, [Signal::PoseX, Signal::PoseY]),
            force: both(&value, [Signal::AccelX, Signal::AccelY]),
        }
    }

    /// Speed forward by the place, m/s: its travel along the heading.
    pub(super) fn forward(&self) -> Option<Vec<f64>> {
        let ([x, y], [heading, _]) = (self.travel.as_ref()?, self.heading.as_ref()?);
        Some((0..x.len()).map(|k| x[k] * heading[k].cos() + y[k] * heading[k].sin()).collect())
    }
}

/// Whether samples stand so near to each other that turns show between them; the others' rates are no rates.
fn is_dense(channel: &Channel) -> bool {
    let span = channel.span_ns().map_or(0, |(from, until)| until - from) as f64 * 1e-9;
    span <= COLUMNS.sparse * channel.len() as f64
}

/// `factor a + other b`, row by row.
pub(super) fn combined(factor: f64, a: &[f64], other: f64, b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| factor * a + other * b).collect()
}

/// How alike two signals are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Likeness {
    /// Cosine of the angle between both as vectors: `Σab / √(Σa² Σb²)`, which knows no mean; 1 is proportional.
    pub(super) cosine: f64,
    /// How much larger the first one is: `√(Σa² / Σb²)`.
    pub(super) ratio: f64,
}

/// The likeness of a signal to what is expected of it; `None` with few rows or where one of both hardly moves (`least`,
/// root mean square, for the expected one).
pub(super) fn likeness(shown: &[f64], expected: &[f64], least: f64) -> Option<Likeness> {
    let finite = shown.iter().zip(expected).filter(|(a, b)| a.is_finite() && b.is_finite());
    let (n, [aa, ab, bb]) = finite.fold((0_usize, [0.0; 3]), |(n, [aa, ab, bb]), (a, b)| {
        (n + 1, [a.mul_add(*a, aa), a.mul_add(*b, ab), b.mul_add(*b, bb)])
    });
    let moves = n >= COLUMNS.rows && bb > least.powi(2) * n as f64 && aa > 0.0;
    moves.then(|| Likeness { cosine: ab / (aa * bb).sqrt(), ratio: (aa / bb).sqrt() })
}

/// [`likeness`] of what is left without the medians of both, which hold the bias of a sensor.
pub(super) fn likeness_of_changes(shown: &[f64], expected: &[f64], least: f64) -> Option<Likeness> {
    let without_median = |values: &[f64]| {
        let middle = median(values.iter().copied().filter(|v| v.is_finite()))?;
        Some(values.iter().map(|v| v - middle).collect::<Vec<f64>>())
    };
    likeness(&without_median(shown)?, &without_median(expected)?, least)
}

/// How well the direction of travel follows the heading and how well it follows the heading mirrored, each between 0 and 1:
/// `|Σ v² e^(2i(course ∓ heading))| / Σ v²`, whatever the angle between their axes, forward or backward.
pub(super) fn follows_heading(travel: &[Vec<f64>; 2], heading: &[f64]) -> Option<[f64; 2]> {
    let (mut sums, mut weight, mut count) = ([[0.0; 2]; 2], 0.0, 0_usize);
    for ((x, y), heading) in travel[0].iter().zip(&travel[1]).zip(heading) {
        let speed = x.hypot(*y);
        if !(speed > COLUMNS.moving && heading.is_finite()) {
            continue;
        }
        let course = y.atan2(*x);
        for (sum, sign) in sums.iter_mut().zip([1.0, -1.0]) {
            let (sin, cos) = (2.0 * (course - sign * heading)).sin_cos();
            sum[0] += speed.powi(2) * cos;
            sum[1] += speed.powi(2) * sin;
        }
        weight += speed.powi(2);
        count += 1;
    }
    (count >= COLUMNS.rows).then(|| sums.map(|[cos, sin]| cos.hypot(sin) / weight))
}
