//! Free runs of the plant over the segments of a recording.

use robot_model::presence::Presence;
use robot_model::{Active, Effect, Plant, Robot, State};

use crate::windows::{CHANNELS, Cut, PARTS, Segment};

/// An effect at values, present somewhere.
#[derive(Clone)]
pub(crate) struct Dose {
    pub(crate) effect: &'static dyn Effect<f64>,
    pub(crate) values: Vec<f64>,
    pub(crate) presence: Presence<f64>,
}

impl Dose {
    pub(crate) fn active(&self) -> Active<f64> {
        Active::new(self.effect, &self.values, self.presence)
    }
}

/// Torque command over `[t, t + h]` delayed by `delay`: the mean of the held set-points, continuous in the delay.
pub(crate) fn command(torque: &[[f64; 2]], period: f64, t: f64, h: f64, delay: f64) -> [f64; 2] {
    let at = |i: f64| if i < 0.0 { [0.0; 2] } else { torque[(i as usize).min(torque.len() - 1)] };
    // A microsecond of slack: row borders are exact multiples of the step up to rounding.
    let (a, b) = ((t - delay) / period + 1e-6, (t + h - delay) / period - 1e-6);
    let (i, j) = (a.floor(), b.floor());
    if i >= j {
        return at(i);
    }
    let share = ((j - a) / (b - a)).clamp(0.0, 1.0);
    let (x, y) = (at(i), at(j));
    [x[0] * share + y[0] * (1.0 - share), x[1] * share + y[1] * (1.0 - share)]
}

/// The plant's state at the start of a segment, with the drive as it was left.
fn initial(plant: &Plant<'_, f64>, cut: &Cut, segment: &Segment, drive: &State<f64>) -> State<f64> {
    let s = &segment.start;
    let (sin, cos) = s.yaw.sin_cos();
    let mut state = State {
        time: segment.row as f64 * cut.period,
        position: s.position,
        heading: [cos, sin],
        yaw_rate: s.yaw_rate,
        wheel_speed: s.wheel_speed,
        front_speed: s.wheel_speed,
        wheel_angle: s.wheel_angle,
        torque: drive.torque,
        lagged: drive.lagged,
        ..State::default()
    };
    plant.set_velocity(&mut state, s.velocity);
    state
}

/// Runs the plant freely over every segment: predicted windows in the layout of [`Segment::observed`].
///
/// Motor lag, delay and torque history run on across restarts. With `part` given, the doses are present only
/// during that part of each segment. `step` is the integration step, s.
pub(crate) fn free_run(cut: &Cut, robot: &Robot<f64>, doses: &[Dose], part: Option<usize>, step: f64) -> Vec<Vec<f64>> {
    let always: Vec<Active<f64>> = doses.iter().map(Dose::active).collect();
    let substeps = (cut.period / step).round().max(1.0) as usize;
    let h = cut.period / substeps as f64;
    let mut drive = State::default();
    let mut out = Vec::with_capacity(cut.segments.len());
    for segment in &cut.segments {
        let local: Vec<Active<f64>>;
        let active = if let Some(q) = part {
            let rows = (segment.windows * cut.rows_per_window) as f64;
            let border = |q: usize| (segment.row as f64 + rows * q as f64 / PARTS as f64) * cut.period;
            local = doses
                .iter()
                .map(|d| {
                    Active::new(
                        d.effect,
                        &d.values,
                        Presence { from: border(q) - 1e-6, until: border(q + 1) - 1e-6, ..d.presence },
                    )
                })
                .collect();
            &local
        } else {
            &always
        };
        let plant = Plant::new(robot, active, h);
        let delay = plant.drive().delay;
        let mut s = initial(&plant, cut, segment, &drive);
        let mut y = vec![0.0; segment.windows * CHANNELS];
        for w in 0..segment.windows {
            let first = segment.row + w * cut.rows_per_window;
            let before = s.wheel_angle;
            let mut sum = [0.0; 5];
            for k in first..first + cut.rows_per_window {
                for i in 0..substeps {
                    let t = k as f64 * cut.period + i as f64 * h;
                    plant.step(&mut s, command(&cut.torque, cut.period, t, h, delay));
                    let mut r = plant.readings(&s);
                    plant.sense(&mut r);
                    for (sum, v) in sum.iter_mut().zip([r.gyro, r.velocity[0], r.velocity[1], r.accel[0], r.accel[1]]) {
                        *sum += v;
                    }
                }
            }
            let n = (cut.rows_per_window * substeps) as f64;
            let row = &mut y[w * CHANNELS..(w + 1) * CHANNELS];
            row[0] = (s.wheel_angle[0] - before[0]) / (n * h);
            row[1] = (s.wheel_angle[1] - before[1]) / (n * h);
            for (y, v) in row[2..].iter_mut().zip(sum) {
                *y = v / n;
            }
        }
        drive = s;
        out.push(y);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{PERIOD, cutting, driven, robot};
    use crate::windows::cut;

    const H: f64 = 1e-3;
    const TORQUE: [[f64; 2]; 4] = [[1.0, -1.0], [3.0, -3.0], [2.0, 5.0], [0.0, 7.0]];

    fn left(t: f64, delay: f64) -> f64 {
        command(&TORQUE, PERIOD, t, H, delay)[0]
    }

    #[test]
    fn a_command_is_held_for_the_row_that_follows() {
        for k in 0..4 {
            for i in 0..10 {
                let t = k as f64 * PERIOD + f64::from(i) * H;
                assert_eq!(command(&TORQUE, PERIOD, t, H, 0.0), TORQUE[k]);
            }
        }
        // The last set-point stays; before the first there is none.
        assert_eq!(left(1.0, 0.0), 0.0);
        assert_eq!(left(0.0, 0.02), 0.0);
    }

    #[test]
    fn a_delay_is_fractional_and_continuous() {
        assert_eq!(left(0.012, 0.0035), TORQUE[0][0]);
        approx::assert_relative_eq!(left(0.013, 0.0035), 2.0, epsilon = 0.01);
        assert_eq!(left(0.014, 0.0035), TORQUE[1][0]);
        let (mut last, step) = (left(0.025, -0.02), 1e-5);
        for i in -1999..3000 {
            let now = left(0.025, f64::from(i) * step);
            // The largest jump between set-points is 2 N m.
            assert!((now - last).abs() <= 2.0 * 1.01 * step / H, "delay {i}: {last} to {now}");
            last = now;
        }
    }

    #[test]
    fn a_negative_delay_looks_ahead() {
        assert_eq!(left(0.005, -PERIOD), TORQUE[1][0]);
        assert_eq!(left(0.005, -2.0 * PERIOD), TORQUE[2][0]);
    }

    #[test]
    fn a_free_run_reproduces_a_drive_of_the_plant_itself() {
        let robot = robot();
        let cut = cut(&driven(&robot, &[], 20.0), &cutting());
        let free = free_run(&cut, &robot, &[], None, 1e-3);
        let (mut sum, mut size, mut n) = ([0.0; CHANNELS], [0.0; CHANNELS], 0.0);
        for (segment, free) in cut.segments.iter().zip(&free) {
            for (i, (o, p)) in segment.observed.iter().zip(free).enumerate() {
                assert!(segment.valid[i] || (segment.row == 0 && i % CHANNELS >= 5));
                sum[i % CHANNELS] += (o - p).powi(2);
                size[i % CHANNELS] += o * o;
                n += 1.0 / CHANNELS as f64;
            }
        }
        // rad/s, rad/s, rad/s, m/s, m/s, m/s², m/s²: a tenth of typical residuals of a real drive.
        let most = [0.03, 0.03, 0.01, 0.01, 0.01, 0.05, 0.05];
        for c in 0..CHANNELS {
            let rms = f64::sqrt(sum[c] / n);
            assert!(rms < most[c], "channel {c}: rms {rms}");
            assert!(f64::sqrt(size[c] / n) > most[c], "channel {c} is not driven");
        }
    }
}
