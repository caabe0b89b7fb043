//! A speed-driven recording: what the drive imposed and what it took.

use inference::robust::median;
use recordings::{Channel, Recording, Signal};

use crate::body_rates::{BodyRates, level};
use crate::clock::{self, Alignment};
use crate::pieces::pieces;
use crate::rows::joined;
use crate::settings::{MEASURING, measuring::Rows};
use crate::speeds::{held_at, steadied};
use crate::stamps::{origin, samples};
use inference::gyro_beside_pose::{GyroShare, gyro_share};
use inference::{DiagnosisError, interpolate};

const ROWS: Rows = MEASURING.rows;

/// One recording of a speed-driven robot. Sides: 0 left, 1 right.
#[derive(Debug, Clone)]
pub struct SpeedRun {
    /// Name of the recording.
    pub name: String,
    /// Time of each row from the recording's first stamp, s.
    pub time: Vec<f64>,
    /// Speed at the tyre of each side, m/s (set-points, if nothing else was recorded).
    pub speed: [Vec<f64>; 2],
    /// Speed that is commanded of each side, m/s, where speeds are measured and commands were recorded beside them.
    pub commanded: Option<[Vec<f64>; 2]>,
    /// Over how long measured speeds were averaged because they scatter, s.
    pub averaged: Option<f64>,
    /// Torque at the wheels of each side, N m; a magnitude if the current has no sign.
    pub torque: [Vec<f64>; 2],
    /// A torque up to this one is in the dead band: only a bound is known, N m.
    pub dead_band: f64,
    /// What a side in its dead band has at most, N m: the dead band, and more where an offset was taken off the readings.
    pub hidden: f64,
    /// Speeds are set-points, not measured.
    pub set_points: bool,
    /// Torques carry no sign.
    pub magnitude_only: bool,
    /// Yaw rate at the rows after its clock was aligned, rad/s, NaN where the gyro was off; `None` without a gyro.
    pub yaw_rate: Option<Vec<f64>>,
    /// What share of the turning that a pose shows the gyro shows; the yaw rate is then that of the pose. `None` without both.
    pub gyro_share: Option<GyroShare>,
    /// The gyro's clock against the rows'; `None` without a gyro.
    pub alignment: Option<Alignment>,
    /// Turning rates of the body about all three axes, on the gyro's clock; `None` where one is missing.
    pub body_rates: Option<BodyRates>,
    /// Nose up at the rows by an accelerometer, rad, where turning rates about one axis alone are known; `None` without one.
    pub level: Option<Vec<f64>>,
    /// Whether the robot stands at a row although it is commanded to drive: such rows say nothing of loads or tracks.
    pub standing: Vec<bool>,
    /// Whether the straight load at a row belongs to a change inside the recording, which is reported by itself.
    pub changed: Vec<bool>,
    /// Signals that were recorded and are not used.
    pub unused: Vec<Signal>,
}

impl SpeedRun {
    /// Takes set (or measured) wheel speeds and currents (or torques) from a recording.
    ///
    /// `radius` in m turns wheel speed into tyre speed, `torque_per_current` in N m/A current into torque.
    ///
    /// # Errors
    /// When speeds or currents are missing, the recording is too short, or nothing moves.
    pub fn new(recording: &Recording, radius: f64, torque_per_current: f64) -> Result<Self, DiagnosisError> {
        let name = recording.name().to_owned();
        let pair = |options: [[Signal; 2]; 2], what: &'static str| {
            options
                .iter()
                .enumerate()
                .find_map(|(i, [l, r])| Some((i, recording.get(*l)?, recording.get(*r)?)))
                .ok_or(DiagnosisError::MissingSignal { recording: name.clone(), what })
        };
        let speeds =
            [[Signal::WheelSpeedLeft, Signal::WheelSpeedRight], [Signal::CommandSpeedLeft, Signal::CommandSpeedRight]];
        let loads = [[Signal::TorqueLeft, Signal::TorqueRight], [Signal::CurrentLeft, Signal::CurrentRight]];
        let (kind, left, right) = pair(speeds, "wheel_speed or command_speed of both sides")?;
        let (load, load_left, load_right) = pair(loads, "current or torque of both sides")?;
        let factor = if load == 1 { torque_per_current } else { 1.0 };

        let set_points = kind == 1 || left.attributes().set_point;
        let rows = joined([left, right], set_points, [load_left, load_right]);
        let common = rows.stamps;
        if common.len() < ROWS.least {
            return Err(DiagnosisError::TooShort { recording: name, rows: common.len(), needed: ROWS.least });
        }
        let speed = rows.speed.map(|z| z.into_iter().map(|v| v * radius).collect::<Vec<f64>>());
        if speed.iter().flatten().all(|v| v.abs() < 1e-9) {
            return Err(DiagnosisError::NoMotion { recording: name });
        }

        let origin = origin(recording);
        let time: Vec<f64> = common.iter().map(|t| (*t - origin) as f64 * 1e-9).collect();
        let (speed, averaged) = if set_points { (speed, None) } else { steadied(&time, speed) };
        let commands = speeds[1].map(|signal| recording.get(signal));
        let commanded = match commands {
            [Some(l), Some(r)] if !set_points => Some([l, r].map(|c| held_at(c, &common, radius))),
            _ => None,
        };
        let attributes = load_left.attributes();
        let dead_band = attributes.dead_band.map_or(0.0, |d| (d + ROWS.dead_band_slack) * factor);
        let mut run = Self {
            torque: rows.load.map(|z| z.into_iter().map(|v| v * factor).collect()),
            dead_band,
            hidden: dead_band,
            set_points,
            commanded,
            averaged,
            magnitude_only: attributes.magnitude_only,
            yaw_rate: None,
            gyro_share: None,
            alignment: None,
            body_rates: BodyRates::new(recording),
            level: None,
            standing: vec![false; time.len()],
            changed: vec![false; time.len()],
            unused: Vec::new(),
            name,
            time,
            speed,
        };

        run.take_gyro(recording, left, origin);
        let forward: Vec<f64> = (0..run.time.len()).map(|i| run.forward(i)).collect();
        let speed = |a: &Alignment| (run.time.iter().zip(&a.lag).map(|(t, lag)| t + lag).collect::<Vec<_>>(), &forward);
        if run.body_rates.is_none() {
            run.level = run.alignment.as_ref().map(speed).and_then(|(rows, v)| level(recording, [&rows, v], &rows));
        }
        if let Some(mut rates) = run.body_rates.take() {
            if let Some(alignment) = &run.alignment {
                rates.take_offsets_off(&run.rests(alignment));
            }
            rates.level =
                run.alignment.as_ref().map(speed).and_then(|(rows, v)| level(recording, [&rows, v], &rates.time));
            run.body_rates = Some(rates);
        }
        let rates = [Signal::GyroX, Signal::GyroY];
        let levels = run.level.is_some() || run.body_rates.as_ref().is_some_and(|rates| rates.level.is_some());
        let is_used = |s: &Signal| {
            speeds[kind].contains(s)
                || run.commanded.is_some() && speeds[1].contains(s)
                || loads[load].contains(s)
                || *s == Signal::GyroZ
                || *s == Signal::PoseYaw && run.gyro_share.is_some()
                || run.body_rates.is_some() && rates.contains(s)
                || levels && [Signal::AccelX, Signal::AccelZ].contains(s)
        };
        run.unused = recording.channels().iter().map(Channel::signal).filter(|s| !is_used(s)).collect();
        Ok(run)
    }

    /// Takes the yaw rate of a gyro, whose clock is another one as a rule, at the rows: as a pose shows it, where there is one.
    fn take_gyro(&mut self, recording: &Recording, left: &Channel, origin: i64) {
        let Some(gyro) = recording.get(Signal::GyroZ) else { return };
        let (t, values) = samples(gyro, origin);
        let smooth = clock::box_mean(&t, values, ROWS.gyro_mean);
        let turning: Vec<f64> = self.speed[1].iter().zip(&self.speed[0]).map(|(r, l)| r - l).collect();
        let alignment = if gyro.clock() == left.clock() {
            Alignment { lag: vec![0.0; self.time.len()], left_out: Vec::new() }
        } else {
            clock::align(&self.time, &turning, &t, &smooth)
        };
        let (first, last) = (t.first().copied().unwrap_or(0.0), t.last().copied().unwrap_or(0.0));
        let at = |(a, b): (&f64, &f64)| {
            // Where the gyro was off nothing is known.
            let inside = a + b > first - ROWS.gyro_edge && a + b < last + ROWS.gyro_edge;
            if inside { interpolate(&t, &smooth, a + b) } else { f64::NAN }
        };
        self.gyro_share = recording.get(Signal::PoseYaw).and_then(|yaw| {
            let headings = yaw.unwrapped();
            gyro_share((&t, values), (&samples(yaw, origin).0, &headings), (&self.time, &turning))
        });
        let share = self.gyro_share.map_or(1.0, |of| of.share);
        self.yaw_rate = Some(self.time.iter().zip(&alignment.lag).map(|row| at(row) / share).collect());
        self.alignment = Some(alignment);
    }

    /// Stretches in which the wheels stand, from and until on the gyro's clock, s.
    fn rests(&self, alignment: &Alignment) -> Vec<[f64; 2]> {
        let is_slow = |i: usize| (0..2).all(|j| self.speed[j][i].abs() < MEASURING.zero.still);
        let is_still = |i: &usize| is_slow(*i) && self.held(*i, MEASURING.zero.still, MEASURING.zero.settled);
        let stretches = pieces(&self.time, (0..self.time.len()).filter(is_still), MEASURING.zero.gap);
        let ends = |rows: Vec<usize>| Some([*rows.first()?, *rows.last()?].map(|i| self.time[i] + alignment.lag[i]));
        stretches.into_iter().filter_map(ends).collect()
    }

    /// The recording up to a row.
    pub(crate) fn head(&self, rows: usize) -> Self {
        let cut = |z: &Vec<f64>| z[..rows].to_vec();
        Self {
            time: cut(&self.time),
            speed: [0, 1].map(|j| cut(&self.speed[j])),
            commanded: self.commanded.as_ref().map(|of| of.each_ref().map(cut)),
            torque: [0, 1].map(|j| cut(&self.torque[j])),
            yaw_rate: self.yaw_rate.as_ref().map(cut),
            level: self.level.as_ref().map(cut),
            standing: self.standing[..rows].to_vec(),
            changed: self.changed[..rows].to_vec(),
            ..self.clone()
        }
    }

    /// Whether a side reads at a row: above its dead band, or at all where it has none.
    pub(crate) fn reads(&self, i: usize, side: usize) -> bool {
        self.dead_band <= 0.0 || self.torque[side][i].abs() > self.dead_band
    }

    /// Difference of the speeds, right less left, m/s.
    pub(crate) fn difference(&self, i: usize) -> f64 {
        self.speed[1][i] - self.speed[0][i]
    }

    /// Whether the sides turn against each other at a row.
    pub(crate) fn spins(&self, i: usize) -> bool {
        self.speed[0][i] * self.speed[1][i] < 0.0
    }

    /// The faster side at a row: the outer one of a turn.
    pub(crate) fn outer(&self, i: usize) -> usize {
        usize::from(self.speed[1][i].abs() > self.speed[0][i].abs())
    }

    /// Median time between rows, s.
    pub(crate) fn period(&self) -> f64 {
        median(self.time.windows(2).map(|w| w[1] - w[0])).unwrap_or(0.0)
    }

    /// Mean speed of the sides at a row, m/s.
    pub(crate) fn forward(&self, i: usize) -> f64 {
        0.5 * (self.speed[0][i] + self.speed[1][i])
    }

    /// Whether both speeds were within `tolerance` of row `i`'s for `seconds` before it, and the body did not stand.
    pub(crate) fn held(&self, i: usize, tolerance: f64, seconds: f64) -> bool {
        let near =
            |k: usize| !self.standing[k] && (0..2).all(|j| (self.speed[j][k] - self.speed[j][i]).abs() <= tolerance);
        let long_enough = |k: &usize| self.time[i] - self.time[*k] >= seconds;
        (0..=i).rev().take_while(|&k| near(k)).any(|k| long_enough(&k))
    }

    /// Share of the usual waiting times that a change of speed takes to pass: measured speeds follow the robot, set-points
    /// run ahead of it.
    pub(crate) fn patience(&self) -> f64 {
        if self.set_points { 1.0 } else { ROWS.measured_patience }
    }

    /// Whether both speeds stay within `tolerance` for `seconds` after row `i`.
    pub(crate) fn holds(&self, i: usize, tolerance: f64, seconds: f64) -> bool {
        let mut k = i;
        while k + 1 < self.time.len() && self.time[k] - self.time[i] < seconds {
            k += 1;
            if self.standing[k] || (0..2).any(|j| (self.speed[j][k] - self.speed[j][i]).abs() > tolerance) {
                return false;
            }
        }
        self.time[k] - self.time[i] >= seconds - 1e-9
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use recordings::{Attributes, Channel, Clock};

    use super::*;

    /// Torque per current, N m/A, and the current that shows as zero below it, A.
    pub(crate) const CONSTANT: f64 = 2.8;
    pub(crate) const DEAD_BAND: f64 = 0.59;
    pub(crate) const RADIUS: f64 = 0.165;
    const RATE: f64 = 6.5;

    /// Straight load and scrub couple of a side, N m; effective track, m.
    #[derive(Clone, Copy)]
    pub(crate) struct Ground {
        pub(crate) straight: f64,
        pub(crate) turning: f64,
        pub(crate) track: f64,
    }

    /// Samples of one channel: times in s and values.
    type Samples = (Vec<f64>, Vec<f64>);

    /// Speeds of the sides (m/s) held for some seconds each, and what a drive without signs shows of it.
    pub(crate) fn recording(ground: Ground, legs: &[([f64; 2], f64)], broken: Option<usize>) -> Recording {
        let mut rows: Vec<[f64; 2]> = Vec::new();
        for (speed, seconds) in legs {
            rows.extend(std::iter::repeat_n(*speed, (seconds * RATE).round() as usize));
        }
        let time: Vec<f64> = (0..rows.len()).map(|i| i as f64 / RATE).collect();
        let torque = |[l, r]: [f64; 2], side: usize| {
            let own = [l, r][side];
            let scrub = if (r - l).abs() > 1e-9 { ground.turning * (r - l).signum() } else { 0.0 };
            own.signum() * 0.5 * ground.straight + if side == 1 { scrub } else { -scrub }
        };
        let shown = |t: f64, v: f64| {
            // A side that brakes feeds back and shows nothing.
            let current = if t * v > 0.0 { t.abs() / CONSTANT } else { 0.0 };
            if current < DEAD_BAND { 0.0 } else { current }
        };
        let column = |f: &dyn Fn([f64; 2]) -> f64| -> Samples { (time.clone(), rows.iter().map(|r| f(*r)).collect()) };
        let current =
            |side: usize| column(&|r| if broken == Some(side) { 0.0 } else { shown(torque(r, side), r[side]) });
        let gyro_time: Vec<f64> = (0..rows.len() * 15).map(|i| i as f64 / (RATE * 15.0)).collect();
        let gyro = gyro_time
            .iter()
            .map(|t| rows[((t * RATE) as usize).min(rows.len() - 1)])
            .map(|[l, r]| (r - l) / ground.track)
            .collect();
        let set = Attributes { set_point: true, ..Attributes::default() };
        let load = Attributes { magnitude_only: true, dead_band: Some(DEAD_BAND), set_point: false };
        let channel = |signal: Signal, (t, v): Samples, a: Attributes| {
            let t = t.iter().map(|t| (t * 1e9).round() as i64).collect();
            Channel::new(signal, 0, t, v).expect("a channel").with_attributes(a)
        };
        let channels = vec![
            channel(Signal::CommandSpeedLeft, column(&|r| r[0] / RADIUS), set),
            channel(Signal::CommandSpeedRight, column(&|r| r[1] / RADIUS), set),
            channel(Signal::CurrentLeft, current(0), load),
            channel(Signal::CurrentRight, current(1), load),
            channel(Signal::GyroZ, (gyro_time, gyro), Attributes::default()),
        ];
        Recording::new("run", vec![Clock { name: "one".to_owned(), nominal_rate_hz: None }], channels)
            .expect("a recording")
    }

    pub(crate) const GROUND: Ground = Ground { straight: 24.0, turning: 9.0, track: 1.05 };

    #[test]
    fn takes_set_points_and_currents_and_says_so() {
        let run = SpeedRun::new(&recording(GROUND, &[([0.5, 0.5], 10.0)], None), RADIUS, CONSTANT).expect("a run");
        assert!(run.set_points && run.magnitude_only);
        approx::assert_relative_eq!(run.speed[0][5], 0.5, epsilon = 1e-12);
        approx::assert_relative_eq!(run.torque[1][5], 12.0, epsilon = 1e-9);
        approx::assert_relative_eq!(run.dead_band, (DEAD_BAND + ROWS.dead_band_slack) * CONSTANT);
        assert_eq!(run.unused, []);
        // Speeds and gyro share a clock: nothing is to be aligned.
        assert!(run.alignment.expect("a gyro").lag.iter().all(|l| *l == 0.0));
        assert_eq!(run.body_rates, None);
    }

    #[test]
    fn what_was_recorded_and_is_not_used_is_known() {
        let plain = recording(GROUND, &[([0.5, 0.5], 10.0)], None);
        let times = plain.get(Signal::GyroZ).expect("a gyro").t_ns().to_vec();
        let level = |s: Signal| Channel::new(s, 0, times.clone(), vec![0.0; times.len()]).expect("a channel");
        let more = [Signal::AccelX, Signal::GyroX];
        let all = plain.channels().iter().cloned().chain(more.map(level)).collect();
        let full = Recording::new("run", plain.clocks().to_vec(), all).expect("a recording");
        let run = SpeedRun::new(&full, RADIUS, CONSTANT).expect("a run");
        // One rate of two is missing: the other says nothing of slopes, of which the accelerometer does.
        assert_eq!(run.unused, [Signal::GyroX]);
        assert!(run.level.is_some_and(|level| level.iter().all(|tilt| tilt.abs() < 0.1)));
    }

    #[test]
    fn the_epoch_of_the_stamps_does_not_matter() {
        const EPOCH: i64 = 1_700_000_000_123_456_789;
        let at_zero = recording(GROUND, &[([0.5, 0.5], 6.0), ([0.3, 0.6], 6.0)], None);
        let shift = |c: &Channel| {
            let t = c.t_ns().iter().map(|t| t + EPOCH).collect();
            Channel::new(c.signal(), 0, t, c.values().to_vec()).expect("a channel").with_attributes(c.attributes())
        };
        let shifted = at_zero.channels().iter().map(shift).collect();
        let later = Recording::new("run", at_zero.clocks().to_vec(), shifted).expect("a recording");
        let [a, b] = [&at_zero, &later].map(|r| SpeedRun::new(r, RADIUS, CONSTANT).expect("a run"));
        assert_eq!((a.time, a.yaw_rate, a.alignment), (b.time, b.yaw_rate, b.alignment));
    }

    #[test]
    fn knows_how_long_speeds_have_held_and_will_hold() {
        let legs = [([0.5, 0.5], 4.0), ([0.3, 0.6], 4.0)];
        let run = SpeedRun::new(&recording(GROUND, &legs, None), RADIUS, CONSTANT).expect("a run");
        let turn = run.time.partition_point(|t| *t < 4.0);
        assert!(run.held(turn, 0.02, 0.0) && !run.held(turn, 0.02, 0.1));
        assert!(run.held(turn - 1, 0.02, run.time[turn - 1]) && !run.held(turn - 1, 0.02, run.time[turn - 1] + 0.1));
        assert!(run.holds(0, 0.02, 2.0) && !run.holds(turn - 2, 0.02, 2.0));
    }

    #[test]
    fn what_cannot_be_used_is_refused() {
        let new = |r: &Recording| SpeedRun::new(r, RADIUS, CONSTANT).expect_err("refused");
        let short = recording(GROUND, &[([0.5, 0.5], 2.0)], None);
        assert!(matches!(new(&short), DiagnosisError::TooShort { rows: 13, needed: 20, .. }));
        let still = recording(GROUND, &[([0.0, 0.0], 10.0)], None);
        assert!(matches!(new(&still), DiagnosisError::NoMotion { .. }));
        let full = recording(GROUND, &[([0.5, 0.5], 10.0)], None);
        let without = |s: Signal| {
            let rest = full.channels().iter().filter(|c| c.signal() != s).cloned().collect();
            new(&Recording::new("r", full.clocks().to_vec(), rest).expect("a recording")).to_string()
        };
        assert!(without(Signal::CurrentLeft).contains("current or torque"));
        assert!(without(Signal::CommandSpeedRight).contains("command_speed"));
    }
}
