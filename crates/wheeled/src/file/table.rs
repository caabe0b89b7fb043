//! Drives from the columns of tables, and from the messages of bags.

use hierarchical_fit::{CaseError as WheeledError, Table};
use std::collections::BTreeMap;

use odometry::file::{Series, Signals};

use crate::drive::{Drive, Measured};
use crate::file::RobotFile;

impl RobotFile {
    /// A drive from the columns of a table; its name is that of the table. Empty cells were not measured.
    ///
    /// # Errors
    /// Columns that are missing, cells that are no numbers, and what [`Drive::new`] refuses.
    pub fn drive(&self, table: &Table, is_held_out: bool) -> Result<Drive, WheeledError> {
        self.drive_of(&table.drive, &self.signals(table, is_held_out)?, is_held_out)
    }

    /// A drive from signals at instants of their own, as the messages of a bag have them.
    ///
    /// # Errors
    /// Torques or angles that are missing, and what [`Drive::new`] refuses.
    pub fn drive_of(&self, name: &str, signals: &Signals, is_held_out: bool) -> Result<Drive, WheeledError> {
        let wrong = |what: String| WheeledError::Drive { drive: name.to_owned(), what };
        let scaled = |series: &Series, unit: f64| Series {
            time: series.time.clone(),
            value: series.value.iter().map(|x| x * unit).collect(),
        };
        let needed = |column: &String, unit: f64| {
            let missing = || wrong(format!("'{column}' has no values; correct the columns of the robot file"));
            signals.get(column).filter(|s| !s.time.is_empty()).map(|s| scaled(s, unit)).ok_or_else(missing)
        };
        let optional =
            |column: &String, unit: f64| signals.get(column).map_or_else(Series::default, |s| scaled(s, unit));
        let names = &self.columns;
        let pose =
            names.pose.as_ref().map(|[x, y, yaw]| [optional(x, 1.0), optional(y, 1.0), optional(yaw, names.angle)]);
        let pose = pose.unwrap_or_default();
        if pose[0].time != pose[1].time || pose[0].time != pose[2].time {
            return Err(wrong("x, y and yaw are not measured at one time; take them of one topic".to_owned()));
        }
        let measured = Measured {
            torque: names.torque.iter().map(|(c, unit)| needed(c, *unit)).collect::<Result<_, _>>()?,
            steering: names.joints.iter().map(|(c, unit)| needed(c, *unit)).collect::<Result<_, _>>()?,
            // Of a drive that is held out they say how a prediction begins, where they are there.
            wheels: if is_held_out && names.wheels.iter().any(|c| !signals.contains_key(c)) {
                Vec::new()
            } else {
                names.wheels.iter().map(|c| needed(c, names.turning)).collect::<Result<_, _>>()?
            },
            is_speed: names.is_speed,
            gyro: names.gyro.as_ref().map(|c| optional(c, names.rate)).unwrap_or_default(),
            pose,
        };
        Drive::new(name, &self.robot, &measured, is_held_out)
    }

    fn signals(&self, table: &Table, is_held_out: bool) -> Result<Signals, WheeledError> {
        let names = &self.columns;
        let time: Vec<f64> = table.filled(&names.time)?.into_iter().map(|t| t * names.second).collect();
        let rises = |row: usize| time[row].is_finite() && (row == 0 || time[row] > time[row - 1]);
        if let Some(row) = (0..time.len()).find(|row| !rises(*row)) {
            let what = format!("time does not rise in row {}; sort the rows, or remove repeated ones", row + 1);
            return Err(WheeledError::Drive { drive: table.drive.clone(), what });
        }
        let wheels = names.wheels.iter().filter(|_| !is_held_out);
        for column in names.torque.iter().chain(&names.joints).map(|(column, _)| column).chain(wheels) {
            table.needed(column)?;
        }
        let mut out: Signals = BTreeMap::new();
        for column in self.names() {
            let measured = time.iter().zip(table.optional(column)?.unwrap_or_default());
            let (time, value): (Vec<f64>, Vec<f64>) = measured.filter_map(|(t, cell)| cell.map(|x| (*t, x))).unzip();
            if !time.is_empty() {
                out.insert(column.to_owned(), Series { time, value });
            }
        }
        Ok(out)
    }
}

#[cfg(test)]
mod tests {
    use crate::file::{BUILT_IN, RobotFile};

    #[test]
    fn what_is_wrong_with_a_table_is_one_clear_sentence() {
        let (_, text) = BUILT_IN[0];
        let file = RobotFile::parse("robot.toml", text).expect("a robot");
        let rows = |n: usize| -> String {
            let row = |k: usize| format!("{:.2},1.0,0.1,3.0,0.2,{:.3},0.0,0.1\n", 0.02 * k as f64, 0.01 * k as f64);
            let head = "time_s,torque_front,steer_rad,speed_front,gyro_z,x_m,y_m,yaw_rad\n";
            head.to_owned() + &(0..n).map(row).collect::<String>()
        };
        let drive = file.drive(&testing::table("a", &rows(200)), false).expect("a drive");
        assert!(drive.has_pose() && (drive.duration() - 3.98).abs() < 0.03, "{}", drive.duration());
        let refused = |table: &str| file.drive(&testing::table("a", table), false).unwrap_err().to_string();
        assert!(
            refused(&rows(200).replace("torque_front", "torque")).contains("no column 'torque_front'; it has time_s")
        );
        assert!(refused(&rows(200).replace("time_s", "t")).contains("no column 'time_s'; it has t, torque_front"));
        assert!(
            refused(&rows(200).replace("0.06,1.0", "0.06,one")).contains("column 'torque_front': 'one' is no number")
        );
        assert!(refused(&rows(200).replace("0.06,1.0", "0.02,1.0")).contains("time does not rise in row 4"));
        assert!(refused(&rows(20)).contains("20 rows, but at least 50 are needed"));
        assert!(refused(&rows(200).replace("0.06,1.0", "0.06,NaN")).contains("is no number; cut the drive there"));
        // Speeds have a unit of their own: that of angles is none of theirs.
        let turned = |of: &str| {
            let text = text.replace("wheels = \"speed\"", &format!("wheels = \"speed\"\n{of}"));
            let drive =
                RobotFile::parse("robot.toml", &text).expect("a robot").drive(&testing::table("a", &rows(200)), false);
            drive.expect("a drive").wheels[0].sum(2.0)
        };
        let plain = turned("");
        for (unit, factor) in [("rad/s", 1.0), ("turn/s", std::f64::consts::TAU), ("rpm", std::f64::consts::TAU / 60.0)]
        {
            approx::assert_relative_eq!(turned(&format!("speed_unit = \"{unit}\"")), factor * plain, epsilon = 1e-9);
        }
        approx::assert_relative_eq!(turned("angle_unit = \"deg\""), plain, epsilon = 1e-9);
        // A pose that is to be predicted, and wheels, may be missing.
        let row = |k: u32| format!("{:.2},1.0,0.1\n", 0.02 * f64::from(k));
        let held_out = "time_s,torque_front,steer_rad\n".to_owned() + &(0..200).map(row).collect::<String>();
        let drive = file.drive(&testing::table("a", &held_out), true).expect("a drive");
        assert!(!drive.has_pose() && drive.wheels.is_empty());
        // Where they are there, a prediction begins at the velocity that they show.
        let seen = file.drive(&testing::table("a", &rows(200)), true).expect("a drive");
        assert!(!seen.wheels.is_empty());
        let milli = text.replace("time = \"time_s\"", "time = \"time_s\"\ntime_unit = \"ms\"");
        let milli = RobotFile::parse("robot.toml", &milli).expect("a robot");
        let scaled: String = rows(200)
            .lines()
            .map(|line| match line.split_once(',') {
                Some((t, rest)) if !t.starts_with('t') => {
                    format!("{:.0},{rest}\n", 1e3 * t.parse::<f64>().expect("a number"))
                }
                _ => format!("{line}\n"),
            })
            .collect();
        assert!(refused(&scaled).contains("its rows are 20 s apart"), "{}", refused(&scaled));
        let same = milli.drive(&testing::table("a", &scaled), false).expect("a drive");
        approx::assert_relative_eq!(same.duration(), drive.duration(), epsilon = 1e-9);
    }
}
