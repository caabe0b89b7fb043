//! Drives from signals at instants of their own, as the messages of a bag have them.

use hierarchical_fit::CaseError;
use std::collections::BTreeMap;

use inference::interpolate;

use crate::counter;
use crate::drive::{Drive, WheelData, enough_rows, of_recording, radians};
use crate::error::OdometryError;
use crate::file::robot::RobotFile;
use crate::settings::{DriveRules, SETTINGS};
use crate::units;
use crate::wheel::Wheel;

const RULES: DriveRules = SETTINGS.drive;

/// A signal at instants of its own.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Series {
    /// Instants, s, rising.
    pub time: Vec<f64>,
    /// The value at each.
    pub value: Vec<f64>,
}

impl Series {
    fn at(&self, time: f64) -> f64 {
        interpolate(&self.time, &self.value, time)
    }

    /// Its integral up to each instant, by trapezoids.
    pub fn integral(&self) -> Vec<f64> {
        let Self { time, value } = self;
        summed(time.len(), |row| 0.5 * (value[row] + value[row - 1]) * (time[row] - time[row - 1]))
    }

    /// From its first instant to its last; `None` of nothing.
    pub fn span(&self) -> Option<[f64; 2]> {
        self.time.first().copied().zip(self.time.last().copied()).map(<[f64; 2]>::from)
    }
}

/// Signals by the column of the robot file that names each.
pub type Signals = BTreeMap<String, Series>;

impl RobotFile {
    /// A drive from signals: turns of the wheels and steering on lines between their instants, at those of the pose, and at their
    /// own where poses are far apart; a pose is never made up. `is_held_out`: the pose is to be predicted and may be missing.
    ///
    /// # Errors
    /// Signals that are missing, never measured at one time, or of too few instants, and what [`Drive::new`] refuses.
    pub fn drive_of(&self, name: &str, signals: &Signals, is_held_out: bool) -> Result<Drive, OdometryError> {
        let wrong = |what: String| OdometryError::Case(CaseError::Drive { drive: name.to_owned(), what });
        let names = &self.columns;
        let needed = |column: &String| {
            let missing = || wrong(format!("'{column}' has no values; correct [columns] of the robot file"));
            signals.get(column).filter(|series| !series.time.is_empty()).ok_or_else(missing)
        };

        // Angles first: a counter that wraps around has no values on a line between two instants.
        let mut told = Vec::new();
        let mut wheels = Vec::new();
        for (column, &wheel) in names.wheels.iter().zip(&self.robot.measured()) {
            let wheel = &self.robot.wheels[wheel];
            let unit = radians(&self.robot, wheel, names.data)?;
            let mut angle = angles(needed(column)?, names.data, wheel, &mut told);
            angle.value.iter_mut().for_each(|value| *value *= unit);
            wheels.push(angle);
        }
        let steering = names.steering.as_ref().map(needed).transpose()?;
        let body = self.body(name, signals, is_held_out)?;

        let spans = wheels.iter().chain(steering).filter_map(Series::span);
        let [from, until] = spans.fold([f64::MIN, f64::MAX], |[a, b], [from, until]| [a.max(from), b.min(until)]);
        let time = rows(&body.time, wheels.iter().flat_map(|wheel| &wheel.time).copied(), [from, until]);
        enough_rows(name, &time)?;
        let turned: Vec<Vec<f64>> = time.iter().map(|t| wheels.iter().map(|wheel| wheel.at(*t)).collect()).collect();
        let since_before = |row: usize| {
            let before = &turned[row.saturating_sub(1)];
            turned[row].iter().zip(before).map(|(now, before)| now - before).collect::<Vec<f64>>()
        };
        let seen = |time: &f64| body.time.binary_search_by(|t| t.total_cmp(time));
        let mut drive = Drive {
            name: name.to_owned(),
            session: self.session_of(name),
            turns: (0..time.len()).map(since_before).collect(),
            steering: steering.map(|s| time.iter().map(|t| s.at(*t) * names.angle).collect()),
            pose: time.iter().map(|t| seen(t).map_or([f64::NAN; 3], |k| body.pose[k])).collect(),
            heading_only: body.heading_only,
            time,
            told: of_recording(name, told),
        };
        // One pose is a beginning; only motion tells units.
        let is_seen = (0..drive.pose.len()).filter(|&row| drive.is_seen(row)).nth(RULES.rows).is_some();
        if !is_held_out || is_seen {
            units::guess(&mut drive, &self.robot, names.data)?;
        }
        Ok(drive)
    }
}

/// How the body moved, by a pose or by a gyro.
struct Body {
    time: Vec<f64>,
    pose: Vec<[f64; 3]>,
    heading_only: bool,
}

impl RobotFile {
    fn body(&self, name: &str, signals: &Signals, is_held_out: bool) -> Result<Body, OdometryError> {
        let wrong = |what: String| OdometryError::Case(CaseError::Drive { drive: name.to_owned(), what });
        let names = &self.columns;
        let given = |column: &String| signals.get(column).filter(|series| !series.time.is_empty());
        let gyro = names.gyro.as_ref().and_then(given);
        let pose = names.pose.as_ref().map(|[x, y, yaw]| [(x, given(x)), (y, given(y)), (yaw, given(yaw))]);
        if let Some([(_, Some(x)), (_, Some(y)), (_, Some(yaw))]) = pose {
            if x.time != y.time || x.time != yaw.time {
                return Err(wrong("x, y and yaw are not measured at one time; take them of one topic".to_owned()));
            }
            let of = |k: usize| [x.value[k] * names.length, y.value[k] * names.length, yaw.value[k] * names.angle];
            return Ok(Body { time: x.time.clone(), pose: (0..x.time.len()).map(of).collect(), heading_only: false });
        }
        // What is to be predicted is the pose by the wheels alone.
        if is_held_out {
            return Ok(Body { time: Vec::new(), pose: Vec::new(), heading_only: false });
        }
        if let Some(gyro) = gyro {
            return Ok(Body { time: gyro.time.clone(), pose: headings(gyro, names.angle), heading_only: true });
        }
        let missing =
            pose.and_then(|pose| pose.into_iter().find(|(_, series)| series.is_none()).map(|(column, _)| column));
        let column = missing.or(names.gyro.as_ref()).map_or("", String::as_str);
        Err(wrong(format!("'{column}' has no values; correct [columns] of the robot file")))
    }
}

/// Poses of which a gyro gives the heading alone; `angle`: radians per unit of its rates.
pub(crate) fn headings(rates: &Series, angle: f64) -> Vec<[f64; 3]> {
    rates.integral().into_iter().map(|heading| [f64::NAN, f64::NAN, angle * heading]).collect()
}

/// Sums of what is added in each row; nothing in the first.
fn summed(rows: usize, step: impl Fn(usize) -> f64) -> Vec<f64> {
    let mut sum = 0.0;
    let after = |row: usize| {
        sum += if row == 0 { 0.0 } else { step(row) };
        sum
    };
    (0..rows).map(after).collect()
}

/// How far a wheel has turned at each instant, in the unit of its column.
fn angles(series: &Series, data: WheelData, wheel: &Wheel, told: &mut Vec<String>) -> Series {
    let value = match data {
        WheelData::Counter | WheelData::Angle => counter::unwrapped(&series.value, data, wheel, told),
        WheelData::Counts => summed(series.time.len(), |row| series.value[row]),
        WheelData::Speed => series.integral(),
    };
    Series { time: series.time.clone(), value }
}

/// Instants of the poses, and those of the wheels where no pose is near, within a span.
fn rows(poses: &[f64], wheels: impl Iterator<Item = f64>, [from, until]: [f64; 2]) -> Vec<f64> {
    let is_far = |time: &f64| {
        let next = poses.partition_point(|pose| pose < time);
        let before = next.checked_sub(1).map(|k| poses[k]);
        match (before, poses.get(next)) {
            (Some(before), Some(next)) => next - before > RULES.dense,
            (Some(pose), None) | (None, Some(&pose)) => (time - pose).abs() > RULES.dense,
            (None, None) => true,
        }
    };
    let mut out: Vec<f64> = poses.iter().copied().chain(wheels.filter(is_far)).collect();
    out.retain(|time| (from..=until).contains(time));
    out.sort_by(f64::total_cmp);
    out.dedup();
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn robot(wheels: &str) -> RobotFile {
        let text = crate::file::BUILT_IN[0].1.replace("wheels = \"counts\"", &format!("wheels = \"{wheels}\""));
        RobotFile::parse("robot.toml", &text).expect("a robot")
    }

    /// A drive on a circle: wheels every 0.02 s, a pose every `pose_every` seconds at other instants.
    fn signals(wheel: impl Fn(f64) -> f64, pose_every: f64) -> Signals {
        let series = |every: f64, start: f64, value: &dyn Fn(f64) -> f64| {
            let time: Vec<f64> = (0..(40.0 / every) as usize).map(|k| start + every * k as f64).collect();
            Series { value: time.iter().map(|t| value(*t)).collect(), time }
        };
        let turning = 0.1;
        let file = robot("angle");
        let [x, y, yaw] = file.columns.pose.expect("a pose");
        [
            (file.columns.wheels[0].clone(), series(0.02, 0.0, &|t| wheel(4.0 * t))),
            (file.columns.wheels[1].clone(), series(0.02, 0.003, &|t| wheel(5.0 * t))),
            (x, series(pose_every, 0.011, &|t| (turning * t).sin())),
            (y, series(pose_every, 0.011, &|t| 1.0 - (turning * t).cos())),
            (yaw, series(pose_every, 0.011, &|t| turning * t)),
        ]
        .into()
    }

    #[test]
    fn wheels_are_taken_at_the_instants_of_the_pose_and_nothing_is_lost() {
        let drive = robot("angle").drive_of("a", &signals(|a| a, 0.01), false).expect("a drive");
        let last = drive.time.len() - 1;
        assert!(drive.pose.iter().flatten().all(|x| x.is_finite()));
        for (wheel, rate) in [4.0, 5.0].into_iter().enumerate() {
            let turned: f64 = drive.turns[1..].iter().map(|turns| turns[wheel]).sum();
            approx::assert_relative_eq!(turned, rate * (drive.time[last] - drive.time[0]), epsilon = 1e-9);
        }
    }

    #[test]
    fn between_poses_that_are_far_apart_there_are_rows_of_the_wheels_without_a_pose() {
        let drive = robot("angle").drive_of("a", &signals(|a| a, 0.5), false).expect("a drive");
        let seen = drive.pose.iter().filter(|p| p[0].is_finite()).count();
        assert_eq!(seen, 80);
        assert!(drive.time.len() > 3000 && drive.time.windows(2).all(|t| t[0] < t[1]));
    }

    #[test]
    fn a_counter_that_wraps_around_is_unwrapped_before_it_is_put_on_a_line() {
        let counts = |angle: f64| (angle / std::f64::consts::TAU * 2796.8).floor();
        let whole = robot("counter").drive_of("a", &signals(counts, 0.01), false).expect("a drive");
        let wrapped = robot("counter").drive_of("a", &signals(|a| counts(a) % 65_536.0, 0.01), false).expect("a drive");
        assert!(wrapped.told[0].contains("wraps around at 65536"), "{:?}", wrapped.told);
        for (a, b) in whole.turns.iter().flatten().zip(wrapped.turns.iter().flatten()) {
            approx::assert_relative_eq!(*a, *b, epsilon = 1e-9);
        }
    }

    #[test]
    fn speeds_and_counts_since_the_message_before_give_the_same_turns() {
        let angles = robot("angle").drive_of("a", &signals(|a| a, 0.01), false).expect("a drive");
        let mut speeds = signals(|a| a, 0.01);
        for (column, speed) in robot("angle").columns.wheels.iter().zip([4.0, 5.0]) {
            speeds.get_mut(column).expect("a wheel").value.iter_mut().for_each(|v| *v = speed);
        }
        let speeds = robot("speed").drive_of("a", &speeds, false).expect("a drive");
        let mut counts = signals(|a| a, 0.01);
        for (column, rate) in robot("angle").columns.wheels.iter().zip([4.0, 5.0]) {
            let per_message = 0.02 * rate / std::f64::consts::TAU * 2796.8;
            counts.get_mut(column).expect("a wheel").value.iter_mut().for_each(|v| *v = per_message);
        }
        let counts = robot("counts").drive_of("a", &counts, false).expect("a drive");
        for other in [speeds, counts] {
            for (a, b) in angles.turns.iter().flatten().zip(other.turns.iter().flatten()) {
                approx::assert_relative_eq!(*a, *b, epsilon = 1e-9);
            }
        }
    }

    #[test]
    fn what_is_missing_or_of_two_topics_is_said() {
        let file = robot("angle");
        let refused = |signals: &Signals| file.drive_of("a", signals, false).unwrap_err().to_string();
        let mut without = signals(|a| a, 0.01);
        without.remove(&file.columns.wheels[1]);
        assert!(refused(&without).contains("'tick_right' has no values; correct [columns]"), "{}", refused(&without));
        let mut apart = signals(|a| a, 0.01);
        apart.get_mut("yaw_rad").expect("yaw").time.iter_mut().for_each(|t| *t += 0.001);
        assert!(refused(&apart).contains("of one topic"), "{}", refused(&apart));
        let mut later = signals(|a| a, 0.01);
        later.get_mut(&file.columns.wheels[0]).expect("a wheel").time.iter_mut().for_each(|t| *t += 100.0);
        assert!(refused(&later).contains("0 rows"), "{}", refused(&later));
        // A pose that is to be predicted may be missing.
        let mut unseen = signals(|a| a, 0.01);
        file.columns.pose.iter().flatten().for_each(|column| drop(unseen.remove(column)));
        let drive = file.drive_of("a", &unseen, true).expect("a drive");
        assert!(drive.pose.iter().flatten().all(|x| x.is_nan()) && drive.time.len() > 3000);
    }
}
