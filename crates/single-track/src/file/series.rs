//! Drives from signals at instants of their own, as the messages of a bag have them.

use hierarchical_fit::CaseError as CarError;
use odometry::file::{Series, Signals};

use crate::drive::{Columns, Drive};
use crate::file::robot::RobotFile;

impl RobotFile {
    /// A drive from signals: commands hold from each of their instants to the next, and what was measured is taken at its own.
    /// `is_held_out`: the pose is to be predicted, and nothing but the commands needs to be there.
    ///
    /// # Errors
    /// Commands that are missing, signals that are of no use at instants of their own, and what [`Drive::new`] refuses.
    pub fn drive_of(&self, name: &str, signals: &Signals, is_held_out: bool) -> Result<Drive, CarError> {
        let wrong = |what: String| CarError::Drive { drive: name.to_owned(), what };
        let names = &self.columns;
        if let Some(column) = &names.car_time {
            return Err(wrong(format!(
                "[columns] car_time = \"{column}\" is for tables that hold values between messages; messages have stamps of \
                 their own: leave car_time out"
            )));
        }
        let needed = |column: &String| {
            let missing = || wrong(format!("'{column}' has no values; correct [columns] of the robot file"));
            signals.get(column).filter(|series| !series.time.is_empty()).ok_or_else(missing)
        };
        let optional = |column: &Option<String>| column.as_ref().and_then(|column| signals.get(column));
        let (throttle, steering) = (needed(&names.throttle)?, needed(&names.steering)?);
        let (enabled, gyro, encoder) = (optional(&names.enabled), optional(&names.gyro), optional(&names.encoder));
        let pose = [optional(&names.x), optional(&names.y), optional(&names.yaw)];
        let [x, y, yaw] = pose.map(|series| series.cloned().unwrap_or_default());
        if x.time != y.time || x.time != yaw.time {
            return Err(wrong("x, y and yaw are not measured at one time; take them of one topic".to_owned()));
        }

        // Nobody knows what is commanded before the first message of a command, nor how long the last one holds.
        let commands: Vec<&Series> = [Some(throttle), Some(steering), enabled].into_iter().flatten().collect();
        let spans = commands.iter().filter_map(|series| series.span());
        let [from, until] = spans.fold([f64::MIN, f64::MAX], |[a, b], [from, until]| [a.max(from), b.min(until)]);
        let all = commands.iter().copied().chain([gyro, encoder].into_iter().flatten()).chain([&x]);
        let mut time: Vec<f64> = all.flat_map(|series| &series.time).copied().collect();
        time.retain(|t| (from..=until).contains(t));
        time.sort_by(f64::total_cmp);
        time.dedup();

        let held = |series: &Series| -> Vec<f64> {
            time.iter().map(|t| series.value[series.time.partition_point(|s| s <= t) - 1]).collect()
        };
        let seen = |series: Option<&Series>| -> Vec<f64> {
            let Some(series) = series else { return Vec::new() };
            let at = |t: &f64| series.time.binary_search_by(|s| s.total_cmp(t)).map_or(f64::NAN, |k| series.value[k]);
            time.iter().map(at).collect()
        };
        let per_unit = self.steering_per_unit();
        let pose = if x.time.is_empty() {
            Vec::new()
        } else {
            let [x, y, yaw] = [&x, &y, &yaw].map(|series| seen(Some(series)));
            x.iter().zip(&y).zip(&yaw).map(|((x, y), yaw)| [*x, *y, *yaw]).collect()
        };
        let table = Columns {
            pose,
            throttle: held(throttle),
            steering: held(steering).into_iter().map(|s| s * per_unit).collect(),
            enabled: enabled.map(held).unwrap_or_default(),
            car_time: Vec::new(),
            gyro: seen(gyro),
            encoder: seen(encoder),
            time,
        };
        if is_held_out { Drive::held_out(name, &table) } else { Drive::of_car(name, &table, &self.car) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn series(every: f64, start: f64, value: impl Fn(f64) -> f64) -> Series {
        let time: Vec<f64> = (0..(10.0 / every) as usize).map(|k| start + every * k as f64).collect();
        Series { value: time.iter().map(|t| value(*t)).collect(), time }
    }

    fn car(columns: &str) -> RobotFile {
        let text = format!(
            "name = \"a\"\nkind = \"car\"\nwheelbase = {{ value = 0.3 }}\n[steering]\nfull_angle = {{ value = 0.5 }}\n\
             [columns]\ntime = \"header.stamp\"\nthrottle = \"/throttle.data\"\nsteering = \"/steering.data\"\n{columns}"
        );
        RobotFile::parse("car.toml", &text).expect("a car")
    }

    const POSE: &str =
        "steering_unit = \"rad\"\ngyro = \"/imu.z\"\nx = \"/pose.x\"\ny = \"/pose.y\"\nyaw = \"/pose.yaw\"\n";

    fn signals() -> Signals {
        [
            ("/throttle.data", series(0.1, 0.0, |t| if t < 5.05 { 0.2 } else { 0.4 })),
            ("/steering.data", series(0.1, 0.02, |_| 0.25)),
            ("/imu.z", series(0.02, 0.01, |_| 1.0)),
            ("/pose.x", series(0.05, 0.03, |t| t)),
            ("/pose.y", series(0.05, 0.03, |_| 0.0)),
            ("/pose.yaw", series(0.05, 0.03, |_| 0.0)),
        ]
        .map(|(column, series)| (column.to_owned(), series))
        .into()
    }

    #[test]
    fn commands_hold_until_the_next_and_steering_is_a_share_of_its_full_angle() {
        let drive = car(POSE).drive_of("a", &signals(), false).expect("a drive");
        approx::assert_relative_eq!(drive.start, 0.02, epsilon = 1e-12);
        approx::assert_relative_eq!(drive.steering.mean(3.0), 0.5, epsilon = 1e-12);
        // 5.08 s of the recording begins 5.06 s after the first row: the throttle of 5.0 s holds until 5.1 s.
        approx::assert_relative_eq!(drive.throttle.mean(4.9), 0.2, epsilon = 1e-12);
        approx::assert_relative_eq!(drive.throttle.mean(5.2), 0.4, epsilon = 1e-12);
        let gyros = drive.messages.iter().filter(|m| m.gyro.is_some()).count();
        assert!((480..500).contains(&gyros) && drive.has_pose(), "{gyros}");
    }

    #[test]
    fn what_is_missing_or_of_no_use_is_said() {
        let refused = |file: &RobotFile, signals: &Signals| file.drive_of("a", signals, false).unwrap_err().to_string();
        let mut without = signals();
        without.remove("/throttle.data");
        assert!(refused(&car(POSE), &without).contains("'/throttle.data' has no values"));
        let held = car("car_time = \"/imu.t\"\n");
        assert!(refused(&held, &signals()).contains("leave car_time out"));
        let mut apart = signals();
        apart.get_mut("/pose.yaw").expect("a signal").time.iter_mut().for_each(|t| *t += 0.001);
        assert!(refused(&car(POSE), &apart).contains("take them of one topic"));
        assert!(refused(&car(""), &signals()).contains("neither a pose nor both a gyro and an encoder"));
        assert!(car("").drive_of("a", &signals(), true).is_ok());
    }
}
