//! A drive: torques, steering, wheels, gyro and pose, on one grid of steps.

use hierarchical_fit::CaseError as WheeledError;
use inference::interpolate;
use inference::robust::median;
use odometry::file::Series;
use odometry::held::Command;
use odometry::pose_jumps::without_jumps;
use odometry::rates::on_grid;
use robot_model::wheels::MOST_CASTERS;

use crate::casters;
use crate::noise::{self, Noise};
use crate::robot::AnyWheels;
use crate::settings::{Grid, SETTINGS};
use crate::units::mistaken;

const RULES: Grid = SETTINGS.grid;
/// Step of the grid, s.
pub(crate) const STEP: f64 = RULES.step;

/// What was recorded of a drive; series that are not there are empty.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Measured {
    /// Torque of each motor, N m.
    pub torque: Vec<Series>,
    /// Angle of each steering joint, rad.
    pub steering: Vec<Series>,
    /// Turning of each wheel that is measured: angle, rad, or speed, rad/s.
    pub wheels: Vec<Series>,
    /// Whether wheels are given as speeds.
    pub is_speed: bool,
    /// Yaw rate, rad/s.
    pub gyro: Series,
    /// x, y, m, and yaw, rad.
    pub pose: [Series; 3],
}

/// A drive of a robot on the grid of the model.
#[derive(Debug, Clone, PartialEq)]
pub struct Drive {
    /// Its name in messages.
    pub name: String,
    pub(crate) torque: Vec<Command>,
    pub(crate) steering: Vec<Command>,
    /// Angle of each measured wheel.
    pub(crate) wheels: Vec<Command>,
    /// Heading by the gyro.
    pub(crate) gyro: Option<Command>,
    /// Pose at the beginning of each step; NaN where it was not seen. Empty of a drive without pose.
    pub(crate) pose: Vec<[f64; 3]>,
    /// How noisy its pose is.
    pub(crate) noise: Noise,
    /// Angles of casters at the beginning of each step; empty of a robot without.
    pub(crate) casters: Vec<[f64; MOST_CASTERS]>,
    /// When some channel was missing, s from the start.
    gaps: Vec<[f64; 2]>,
    pub(crate) steps: usize,
    /// Time of the first row, s.
    pub(crate) start: f64,
    /// What was done to it before the comparison, for people.
    pub told: Vec<String>,
}

impl Drive {
    /// A drive from what was recorded, from when all torques are known until one is no more.
    ///
    /// # Errors
    /// Torques, angles or wheels that are missing or no numbers, a drive that is too short, and, of one that is not held out, one
    /// without anything to compare the torques with.
    pub fn new(name: &str, robot: &AnyWheels, of: &Measured, is_held_out: bool) -> Result<Self, WheeledError> {
        let wrong = |what: String| WheeledError::Drive { drive: name.to_owned(), what };
        let has_pose = of.pose.iter().all(|s| !s.time.is_empty());
        let (motors, joints) = (robot.motors.len(), robot.joints.len());
        if of.torque.len() != motors || of.steering.len() != joints {
            let (t, s) = (of.torque.len(), of.steering.len());
            return Err(wrong(format!("{t} torques and {s} steering angles for {motors} motors and {joints} joints")));
        }
        if !is_held_out && of.wheels.iter().all(|s| s.time.is_empty()) && !has_pose {
            return Err(wrong(
                "there is neither a wheel that is measured nor a pose; name the column of one under [[wheel]] or [columns]"
                    .to_owned(),
            ));
        }
        let inputs = || of.torque.iter().chain(&of.steering);
        if let Some(series) =
            inputs().chain(&of.wheels).chain([&of.gyro]).find(|s| s.value.iter().any(|x| !x.is_finite()))
        {
            let at = series.value.iter().position(|x| !x.is_finite()).map_or(0.0, |k| series.time[k]);
            return Err(wrong(format!("a torque, angle or speed at {at} s is no number; cut the drive there")));
        }
        let spans: Vec<[f64; 2]> = inputs().filter_map(Series::span).collect();
        if spans.len() < motors + joints || motors == 0 {
            return Err(wrong("the torque of a motor, or the angle of a steering joint, has no values".to_owned()));
        }
        let [start, end] =
            spans.iter().fold([f64::MIN, f64::MAX], |[a, b], [from, until]| [a.max(*from), b.min(*until)]);
        let rows = of.torque[0].time.len();
        let apart = median(of.torque[0].time.windows(2).map(|t| t[1] - t[0])).unwrap_or(0.0);
        if apart > RULES.apart {
            return Err(wrong(format!(
                "its rows are {apart:.0} s apart, at most {} can be compared; if the time is in another unit, state it under \
                 [columns]: time_unit = \"ms\" (or us, ns)",
                RULES.apart
            )));
        }
        if rows < RULES.rows || end - start < STEP * RULES.rows as f64 {
            return Err(wrong(format!("{rows} rows, but at least {} are needed; record longer", RULES.rows)));
        }
        if let Some(apart) = noise::apart(&of.pose).filter(|apart| *apart > RULES.pose_gap) {
            return Err(wrong(format!(
                "its poses are {apart:.2} s apart, and at most {} s are bridged; record the pose more often, or take x, y and yaw out of \
                 [columns] to compare wheels and gyro alone",
                RULES.pose_gap
            )));
        }
        let steps = ((end - start) / STEP) as usize;
        let held = |s: &Series| {
            let times: Vec<f64> = s.time.iter().map(|t| t - start).collect();
            Command::held((&times, &s.value), steps, STEP)
        };
        let summed = |s: &Series, is_rate: bool| {
            let whole = if is_rate { Series { time: s.time.clone(), value: s.integral() } } else { s.clone() };
            let at = |k: usize| interpolate(&whole.time, &whole.value, start + STEP * k as f64);
            let sums: Vec<f64> = (0..=steps).map(at).collect();
            let rate = |a: usize, b: usize| (sums[b] - sums[a]) / STEP;
            let ends = [rate(0, 1), rate(steps - 1, steps)];
            Command::summed(sums, ends, STEP)
        };
        let all = || inputs().chain(&of.wheels).chain([&of.gyro]).filter(|s| !s.time.is_empty());
        let mut gaps: Vec<[f64; 2]> = Vec::new();
        for series in all() {
            let pairs = series.time.windows(2).filter(|t| t[1] - t[0] > RULES.gap);
            gaps.extend(pairs.map(|t| [t[0] - start, t[1] - start]));
            let [from, until] = series.span().unwrap_or([start, end]);
            gaps.extend([[f64::MIN, from - start - RULES.gap], [until - start + RULES.gap, f64::MAX]]);
        }
        let times = &of.pose[0].time;
        let row = |k: usize| of.pose.each_ref().map(|s| s.value.get(k).copied().unwrap_or(f64::NAN));
        let mut pose: Vec<[f64; 3]> = (0..times.len()).map(row).collect();
        let told = without_jumps(times, &mut pose).map(|what| format!("recording '{name}': {what}"));
        let seen = times.iter().zip(pose).map(|(t, pose)| (t - start, pose));
        let mut drive = Self {
            name: name.to_owned(),
            torque: of.torque.iter().map(held).collect(),
            steering: of.steering.iter().map(|s| summed_angle(s, start, steps)).collect(),
            wheels: of.wheels.iter().map(|s| summed(s, of.is_speed)).collect(),
            gyro: (!of.gyro.time.is_empty()).then(|| summed(&of.gyro, true)),
            pose: if has_pose { on_grid(seen, steps, STEP, RULES.pose_gap) } else { Vec::new() },
            noise: if has_pose { Noise::of(&of.pose) } else { Noise::default() },
            casters: Vec::new(),
            gaps,
            steps,
            start,
            told: told.into_iter().collect(),
        };
        if let Some(what) = mistaken(&drive, robot, of.is_speed) {
            return Err(wrong(what));
        }
        drive.casters = casters::angles(&drive, robot);
        Ok(drive)
    }

    /// From its first row to its last, s.
    pub fn duration(&self) -> f64 {
        STEP * self.steps as f64
    }

    /// Whether its pose was measured.
    pub fn has_pose(&self) -> bool {
        !self.pose.is_empty()
    }

    /// Whether all channels but the pose are there from one step to another.
    pub(crate) fn is_whole(&self, from: usize, until: usize) -> bool {
        let (from, until) = (STEP * from as f64, STEP * until as f64);
        self.gaps.iter().all(|[a, b]| *b <= from || *a >= until)
    }
}

/// An angle as an integral whose means are the angle on a line between its instants.
fn summed_angle(s: &Series, start: f64, steps: usize) -> Command {
    let at = |k: usize| interpolate(&s.time, &s.value, start + STEP * (k as f64 + 0.5));
    let mut sums = vec![0.0];
    for k in 0..steps {
        sums.push(sums[k] + STEP * at(k));
    }
    let ends = [at(0), at(steps - 1)];
    Command::summed(sums, ends, STEP)
}
