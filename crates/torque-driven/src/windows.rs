//! Windows of 0.1 s and the segments from which the model runs free.

use inference::hypothesis::Dose;
use inference::robust::mean;
use sim::rollout::Start;

use crate::channel::{Channel, Channels};
use crate::motion::{GyroError, Smoothed, frozen_rows};
use crate::run::Run;
use crate::settings::preparation::{SETTINGS, Starts, Windows};
use crate::smooth::{interpolate, local_fit};

const WINDOWS: Windows = SETTINGS.windows;
const STARTS: Starts = SETTINGS.starts;
/// Length of a window, s.
pub(crate) const WINDOW: f64 = WINDOWS.length;
/// Parts of a segment in which a local presence is resolved.
pub(crate) const PARTS: usize = WINDOWS.parts;

/// A stretch over which the model runs free.
#[derive(Debug, Clone)]
pub(crate) struct Segment {
    /// First row.
    pub(crate) row: usize,
    /// Number of windows.
    pub(crate) windows: usize,
    /// State of the robot at its start, from all sensors.
    pub(crate) start: Start,
    /// Window by window; zero where not valid.
    pub(crate) observed: Vec<Channels<f64>>,
    pub(crate) valid: Vec<Channels<bool>>,
    /// Wheel positions in the middle of each window, for local presence.
    pub(crate) wheels: Vec<[[f64; 2]; 4]>,
    /// Mean |yaw rate| and |v|, range of the wheel speeds: what kind of driving this is.
    pub(crate) regime: [f64; 3],
    /// Numbers that are valid.
    pub(crate) count: f64,
}

impl Segment {
    /// How hard the driving is, in what is usual: by its regime, and by how fast it turns times how fast its wheels do, which a body that
    /// turns while it drives feels as sideways acceleration.
    pub(crate) fn hardness(&self) -> [f64; 4] {
        let cornering = |(shown, valid): (&Channels<f64>, &Channels<bool>)| {
            let wheels = mean(Channel::WHEELS.into_iter().filter(|c| valid[*c]).map(|c| shown[c]))?;
            valid[Channel::YawRate].then(|| (wheels * shown[Channel::YawRate]).abs())
        };
        let cornering = mean(self.observed.iter().zip(&self.valid).filter_map(cornering)).unwrap_or(0.0);
        let [turning, speed, range] = self.regime;
        [turning, speed, range, cornering / (WINDOWS.turning * WINDOWS.range)]
    }

    /// Whether a channel was recorded in any of its windows.
    pub(crate) fn shows(&self, channel: Channel) -> bool {
        self.valid.iter().any(|valid| valid[channel])
    }
}

/// A run cut into segments.
#[derive(Debug, Clone)]
pub(crate) struct Cut {
    pub(crate) name: String,
    /// Number of the visit that it is of.
    pub(crate) visit: Option<usize>,
    /// Time of the first row, s.
    pub(crate) from: f64,
    /// What the simulation of it is given beside its robot.
    pub(crate) given: Vec<Dose>,
    pub(crate) period: f64,
    pub(crate) rows_per_window: usize,
    pub(crate) torque: Vec<[f64; 2]>,
    pub(crate) segments: Vec<Segment>,
    /// Smoothed path (x, y) and yaw at each window border, for pictures and places.
    pub(crate) path: Vec<[f64; 3]>,
}

impl Cut {
    /// Time of a row, or between rows, s.
    pub(crate) fn time(&self, row: f64) -> f64 {
        self.from + row * self.period
    }

    /// Doses of a hypothesis after those that the simulation is given.
    pub(crate) fn with_given(&self, doses: Vec<Dose>) -> Vec<Dose> {
        if self.given.is_empty() { doses } else { self.given.iter().cloned().chain(doses).collect() }
    }

    /// When it ends, s.
    pub(crate) fn end(&self) -> f64 {
        self.time(self.torque.len() as f64)
    }

    /// The same as one segment, over which the model runs free from the first state alone.
    pub(crate) fn whole(&self) -> Self {
        let mut out = self.clone();
        let mut all = std::mem::take(&mut out.segments).into_iter();
        if let Some(first) = all.next() {
            let whole = all.fold(first, |mut whole, next| {
                whole.windows += next.windows;
                whole.count += next.count;
                whole.observed.extend(next.observed);
                whole.valid.extend(next.valid);
                whole.wheels.extend(next.wheels);
                whole
            });
            out.segments.push(whole);
        }
        out
    }
}

/// What cutting needs to know.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CutOptions {
    /// Length of a segment, s.
    pub(crate) segment: f64,
    /// Noise of a pose, m.
    pub(crate) pose_sigma: f64,
    pub(crate) gyro: GyroError,
    pub(crate) wheel_radius: f64,
    /// Where the robot touches the ground, from its geometric centre, m.
    pub(crate) contacts: [[f64; 2]; 4],
}

/// Cuts a run into segments of windows.
pub(crate) fn cut(run: &Run, o: &CutOptions) -> Cut {
    let per_window = ((WINDOW / run.period).round() as usize).max(1);
    let per_segment = ((o.segment / WINDOW).round() as usize).max(PARTS);
    let windows = (run.rows() - 1) / per_window;
    let smoothed = Smoothed::new(run, o.gyro, o.pose_sigma);
    let frozen = [frozen_rows(&run.angle[0]), frozen_rows(&run.angle[1])];
    let mut segments = Vec::new();
    // The last window of a run is dropped: the pose smoother has no data beyond it.
    let mut first = 0;
    while first + per_segment < windows {
        segments.push(segment(run, o, &smoothed, &frozen, first, per_segment, per_window));
        first += per_segment;
    }
    let path = (0..=windows)
        .map(|w| {
            let t = (w * per_window) as f64 * run.period;
            let [x, y] = smoothed.position(t);
            [x, y, interpolate(&smoothed.yaw, t / run.period)]
        })
        .collect();
    Cut {
        name: run.name.clone(),
        visit: None,
        from: run.from,
        given: Vec::new(),
        period: run.period,
        rows_per_window: per_window,
        torque: run.torque.clone(),
        segments,
        path,
    }
}

fn segment(
    run: &Run,
    o: &CutOptions,
    smoothed: &Smoothed,
    frozen: &[Vec<bool>; 2],
    first: usize,
    windows: usize,
    per_window: usize,
) -> Segment {
    let row = first * per_window;
    let start = start_state(run, o, smoothed, frozen, row);
    let length = per_window as f64 * run.period;
    let mut observed = vec![Channels::all(0.0); windows];
    let mut valid = vec![Channels::all(false); windows];
    let mut regime = [0.0; 3];
    let mut extremes = (f64::MAX, f64::MIN);

    for w in 0..windows {
        let (a, b) = (row + w * per_window, row + (w + 1) * per_window);
        let mut set = |channel: Channel, v: Option<f64>| {
            if let Some(v) = v.filter(|v| v.is_finite()) {
                observed[w][channel] = v;
                valid[w][channel] = true;
            }
        };
        for (j, wheel) in Channel::WHEELS.into_iter().enumerate() {
            let beside = WINDOWS.beside_frozen;
            let near = |k: usize| frozen[j][k.saturating_sub(beside)..(k + beside + 1).min(run.rows())].contains(&true);
            let v = (!near(a) && !near(b))
                .then_some(())
                .and(run.angle[j][b].zip(run.angle[j][a]))
                .map(|(x, y)| (x - y) / length);
            if let Some(v) = v {
                extremes = (extremes.0.min(v), extremes.1.max(v));
            }
            set(wheel, v);
        }

        let mean = |channel: &[Option<f64>]| {
            let (n, sum) = channel[a + 1..=b].iter().flatten().fold((0.0, 0.0), |(n, s), v| (n + 1.0, s + v));
            (n > 0.0).then(|| sum / n)
        };
        let gyro = mean(&run.gyro).map(|g| (g - o.gyro.bias) / (1.0 + o.gyro.scale));
        set(Channel::YawRate, gyro);
        let v = smoothed.velocity((a + b) as f64 * 0.5 * run.period, run.period);
        set(Channel::ForwardVelocity, v.map(|v| v[0]));
        set(Channel::LateralVelocity, v.map(|v| v[1]));
        set(Channel::ForwardAcceleration, mean(&run.accel[0]));
        set(Channel::LateralAcceleration, mean(&run.accel[1]));

        regime[0] += gyro.unwrap_or(0.0).abs() / (WINDOWS.turning * windows as f64);
        regime[1] += v.map_or(0.0, |v| v[0].abs()) / (WINDOWS.speed * windows as f64);
    }
    regime[2] = ((extremes.1 - extremes.0) / WINDOWS.range).max(0.0);

    let wheels = (0..windows)
        .map(|w| {
            let t = (row as f64 + (w as f64 + 0.5) * per_window as f64) * run.period;
            let p = smoothed.position(t);
            let (s, c) = interpolate(&smoothed.yaw, t / run.period).sin_cos();
            o.contacts.map(|[x, y]| [p[0] + c * x - s * y, p[1] + s * x + c * y])
        })
        .collect();

    let count = valid.iter().flat_map(Channels::iter).filter(|&&v| v).count() as f64;
    Segment { row, windows, start, observed, valid, wheels, regime, count }
}

fn start_state(run: &Run, o: &CutOptions, smoothed: &Smoothed, frozen: &[Vec<bool>; 2], row: usize) -> Start {
    let t = row as f64 * run.period;
    let around = |half: f64| {
        let h = (half / run.period).round().max(1.0) as usize;
        row.saturating_sub(h)..(row + h + 1).min(run.rows())
    };
    let mut start =
        Start { position: smoothed.position(t), yaw: interpolate(&smoothed.yaw, t / run.period), ..Start::default() };

    for j in 0..2 {
        // Wider when the encoder is frozen here, so that there is something to fit.
        let fit = STARTS.wheel.into_iter().find_map(|half| {
            let points: Vec<(f64, f64)> = around(half)
                .filter(|&k| !frozen[j][k])
                .filter_map(|k| run.angle[j][k].map(|a| ((k as f64 - row as f64) * run.period, a)))
                .collect();
            (points.len() >= STARTS.least_rows).then(|| local_fit(&points)).flatten()
        });
        if let Some((angle, speed)) = fit {
            start.wheel_angle[j] = angle;
            start.wheel_speed[j] = speed;
        }
    }

    let points: Vec<(f64, f64)> = around(STARTS.gyro)
        .filter_map(|k| {
            run.gyro[k].map(|g| ((k as f64 - 0.5 - row as f64) * run.period, (g - o.gyro.bias) / (1.0 + o.gyro.scale)))
        })
        .collect();
    start.yaw_rate = local_fit(&points).map_or(0.0, |f| f.0);

    // Without a pose, the wheels tell the forward velocity up to their slip.
    let rolled = o.wheel_radius * 0.5 * (start.wheel_speed[0] + start.wheel_speed[1]);
    start.velocity = smoothed.velocity(t, run.period).unwrap_or([rolled, 0.0]);

    // A robot whose wheels do not turn at the first row stands.
    if row == 0 {
        let still = |a: &[Option<f64>]| {
            let shown = || a.iter().flatten();
            let moved = |x: &f64| (x - shown().next().unwrap_or(x)).abs();
            shown().take(STARTS.standing_rows).all(|x| moved(x) < STARTS.standing)
        };
        if still(&run.angle[0]) && still(&run.angle[1]) {
            start =
                Start { position: start.position, yaw: start.yaw, wheel_angle: start.wheel_angle, ..Start::default() };
        }
    }
    start
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{blank, cutting};
    use testing::PERIOD;

    /// Wheels at 5 and 6 rad/s, gyro at 0.2 rad/s, accelerometer at (0.1, 0.3) m/s².
    fn steady(rows: usize) -> Run {
        let mut run = blank(rows);
        for k in 0..rows {
            let t = k as f64 * PERIOD;
            run.angle[0][k] = Some(5.0 * t);
            run.angle[1][k] = Some(6.0 * t);
            run.gyro[k] = Some(0.2);
            run.accel[0][k] = Some(0.1);
            run.accel[1][k] = Some(0.3);
        }
        run
    }

    #[test]
    fn an_angle_is_frozen_when_it_stands_while_moving_and_then_jumps() {
        let mut angle: Vec<Option<f64>> = (0..40).map(|k| Some(0.1 * f64::from(k))).collect();
        for k in 11..=13 {
            angle[k] = angle[10];
        }
        let frozen = frozen_rows(&angle);
        let at: Vec<usize> = (0..40).filter(|&k| frozen[k]).collect();
        assert_eq!(at, [11, 12, 13]);
    }

    #[test]
    fn standing_and_starting_are_not_frozen() {
        let angle: Vec<Option<f64>> = (0..60).map(|k| Some(1e-3 * f64::from((k - 30).max(0)).powi(2))).collect();
        assert!(frozen_rows(&angle).iter().all(|f| !f));
        assert!(frozen_rows(&[None, Some(1.0), None]).iter().all(|f| !f));
        assert!(frozen_rows(&[Some(1.0); 30]).iter().all(|f| !f));
    }

    #[test]
    fn windows_hold_the_known_values_and_missing_channels_are_masked() {
        let run = steady(2400);
        let gyro = GyroError { bias: 0.05, scale: 0.5 };
        let cut = cut(&run, &CutOptions { gyro, ..cutting() });
        // 239 whole windows, segments of twenty, the last window kept free.
        assert_eq!((cut.rows_per_window, cut.segments.len(), cut.path.len()), (10, 11, 240));
        for (i, s) in cut.segments.iter().enumerate() {
            assert_eq!((s.row, s.windows), (200 * i, 20));
            assert_eq!(s.count, 20.0 * 5.0);
            for (observed, valid) in s.observed.iter().zip(&s.valid) {
                for channel in Channel::ALL {
                    let expected = match channel {
                        Channel::LeftWheel => Some(5.0),
                        Channel::RightWheel => Some(6.0),
                        Channel::YawRate => Some((0.2 - 0.05) / 1.5),
                        Channel::ForwardVelocity | Channel::LateralVelocity => None,
                        Channel::ForwardAcceleration => Some(0.1),
                        Channel::LateralAcceleration => Some(0.3),
                    };
                    approx::assert_abs_diff_eq!(observed[channel], expected.unwrap_or(0.0), epsilon = 1e-9);
                    assert_eq!(valid[channel], expected.is_some(), "{channel:?}");
                }
            }
            approx::assert_abs_diff_eq!(s.start.wheel_speed[0], 5.0, epsilon = 1e-6);
            approx::assert_abs_diff_eq!(s.start.wheel_speed[1], 6.0, epsilon = 1e-6);
            approx::assert_abs_diff_eq!(s.start.wheel_angle[1], 12.0 * i as f64, epsilon = 1e-6);
            approx::assert_abs_diff_eq!(s.start.yaw_rate, 0.1, epsilon = 1e-9);
            // Without a pose the wheels tell how fast it drives.
            approx::assert_abs_diff_eq!(s.start.velocity[0], 0.55, epsilon = 1e-6);
        }
    }

    #[test]
    fn windows_beside_frozen_rows_are_masked_on_that_side_only() {
        let mut run = steady(1000);
        for k in 326..336 {
            run.angle[1][k] = run.angle[1][325];
        }
        let cut = cut(&run, &cutting());
        let s = &cut.segments[1];
        // The border at row 330 is frozen: the windows before and after it go.
        let masked: Vec<usize> = (0..s.windows).filter(|&w| !s.valid[w][Channel::RightWheel]).collect();
        assert_eq!(masked, [12, 13]);
        assert!(s.valid.iter().all(|valid| valid[Channel::LeftWheel]));
    }

    #[test]
    fn a_pose_gives_body_velocity_and_place() {
        let mut run = steady(1200);
        // A circle of 2.5 m at 0.5 m/s.
        for k in (1..1200).step_by(10) {
            let yaw = 0.2 * (k as f64 - 0.5) * PERIOD;
            let place = [2.5 * yaw.sin(), 2.5 * (1.0 - yaw.cos()), yaw];
            for (channel, v) in run.pose.iter_mut().zip(place) {
                channel[k] = Some(v);
            }
        }
        let cut = cut(&run, &cutting());
        for s in &cut.segments {
            approx::assert_abs_diff_eq!(s.start.velocity[0], 0.5, epsilon = 0.01);
            approx::assert_abs_diff_eq!(s.start.velocity[1], 0.0, epsilon = 0.01);
            let yaw = 0.2 * s.row as f64 * PERIOD;
            approx::assert_abs_diff_eq!(s.start.yaw, yaw, epsilon = 0.01);
            approx::assert_abs_diff_eq!(s.start.position[0], 2.5 * yaw.sin(), epsilon = 0.01);
            for w in 1..s.windows - 1 {
                approx::assert_abs_diff_eq!(s.observed[w][Channel::ForwardVelocity], 0.5, epsilon = 0.01);
                approx::assert_abs_diff_eq!(s.observed[w][Channel::LateralVelocity], 0.0, epsilon = 0.01);
            }
        }
    }
}
