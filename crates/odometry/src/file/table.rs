//! Drives from the columns of tables.

use crate::drive::Drive;
use crate::error::OdometryError;
use crate::file::robot::RobotFile;
use crate::file::series::{Series, headings};
use hierarchical_fit::{Table, or_nan};

impl RobotFile {
    /// A drive from the columns of a table; its name is that of the table.
    ///
    /// Empty cells of the pose were not seen. Rows without a time are refused.
    ///
    /// # Errors
    /// Columns that are missing, cells that are no numbers, and what [`Drive::new`] refuses.
    pub fn drive(&self, table: &Table) -> Result<Drive, OdometryError> {
        self.read(table, true)
    }

    /// A drive whose pose is to be predicted: where the pose was seen, the prediction begins; columns and cells of the pose may be
    /// missing. Without any pose units are those of the robot file.
    ///
    /// # Errors
    /// As [`RobotFile::drive`].
    pub fn held_out(&self, table: &Table) -> Result<Drive, OdometryError> {
        self.read(table, false)
    }

    fn read(&self, table: &Table, needs_pose: bool) -> Result<Drive, OdometryError> {
        let names = &self.columns;
        let time: Vec<f64> = table.filled(&names.time)?.into_iter().map(|t| t * names.second).collect();
        let wheels: Vec<Vec<f64>> = names.wheels.iter().map(|wheel| table.filled(wheel)).collect::<Result<_, _>>()?;
        let angles = |column: Vec<f64>| column.into_iter().map(|s| s * names.angle).collect::<Vec<f64>>();
        let steering = names.steering.as_ref().map(|column| table.filled(column)).transpose()?.map(angles);

        // A gyro stands for a pose that was not recorded; one that is to be predicted is predicted from the wheels alone.
        let pose = names.pose.as_ref().filter(|pose| pose.iter().any(|column| table.has(column)));
        let session = self.session_of(&table.drive);
        if let Some(gyro) = names.gyro.as_ref().filter(|_| needs_pose && pose.is_none()) {
            let pose = self.heading_by(table.needed(gyro)?, &time);
            let drive = Drive::by_gyro(&table.drive, &self.robot, time, (names.data, &wheels), steering, pose)?;
            return Ok(drive.of_session(&session));
        }
        let seen: Vec<Vec<f64>> = match pose.or(names.pose.as_ref().filter(|_| needs_pose)) {
            Some(pose) => pose.iter().map(|column| table.needed(column).map(or_nan)).collect::<Result<_, _>>()?,
            None => vec![vec![f64::NAN; time.len()]; 3],
        };
        let pose = (0..time.len())
            .map(|row| [seen[0][row] * names.length, seen[1][row] * names.length, seen[2][row] * names.angle])
            .collect();
        let new = if needs_pose { Drive::new } else { Drive::held_out };
        Ok(new(&table.drive, &self.robot, time, (names.data, &wheels), steering, pose)?.of_session(&session))
    }

    /// Poses of which the heading is known, from the rates that a gyro shows.
    fn heading_by(&self, rates: &[Option<f64>], time: &[f64]) -> Vec<[f64; 3]> {
        let is_seen = |row: &usize| rates[*row].is_some_and(f64::is_finite);
        let seen: Vec<usize> = (0..time.len()).filter(is_seen).collect();
        let series = Series {
            time: seen.iter().map(|row| time[*row]).collect(),
            value: seen.iter().filter_map(|row| rates[*row]).collect(),
        };
        let mut pose = vec![[f64::NAN; 3]; time.len()];
        for (row, heading) in seen.into_iter().zip(headings(&series, self.columns.angle)) {
            pose[row] = heading;
        }
        pose
    }

    /// The session of a drive of this name.
    pub(crate) fn session_of(&self, name: &str) -> String {
        let separator = self.columns.session_separator.as_ref();
        separator.and_then(|s| name.rsplit_once(s.as_str())).map_or(name, |(session, _)| session).to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fmt::Write;

    fn table(rows: usize) -> String {
        let mut out = "time_s,x_m,y_m,yaw_rad,tick_right,tick_left\n".to_owned();
        for k in 0..rows {
            let t = 0.05 * k as f64;
            let pose = if k == 7 { ",,".to_owned() } else { format!("{},0.0,0.0", 0.2 * t) };
            _ = writeln!(out, "{t},{pose},106,106");
        }
        out
    }

    #[test]
    fn a_table_is_a_drive_of_its_session() {
        let file = RobotFile::built_in("differential").expect("a file").expect("a robot");
        let drive = file.drive(&testing::table("D02-01", &table(80))).expect("a drive");
        assert_eq!((drive.session.as_str(), drive.time.len()), ("D02", 80));
        assert!(drive.pose[7][0].is_nan() && drive.pose[8][0] > 0.0);
        approx::assert_relative_eq!(drive.turns[1][0], std::f64::consts::TAU * 106.0 / 2796.8, epsilon = 1e-12);
    }

    #[test]
    fn what_is_wrong_with_a_table_is_one_clear_sentence() {
        let file = RobotFile::built_in("differential").expect("a file").expect("a robot");
        let refused = |table: &str| file.drive(&testing::table("a", table)).unwrap_err().to_string();
        assert!(refused(&table(80).replace("tick_left", "left")).contains("no column 'tick_left'; it has time_s"));
        assert!(
            refused(&table(80).replace(",106,106", ",x,106")).contains("row 1, column 'tick_right': 'x' is no number")
        );
        assert!(refused(&table(9)).contains("9 rows, but at least 40"));
    }

    #[test]
    fn times_in_milliseconds_are_refused_until_the_file_says_so() {
        let (_, text) = crate::file::BUILT_IN[0];
        let plain = RobotFile::parse("robot.toml", text).expect("a robot");
        let seconds = plain.drive(&testing::table("a", &table(80))).expect("a drive");
        let milli = table(80)
            .lines()
            .map(|line| match line.split_once(',') {
                Some((t, rest)) => {
                    t.parse::<f64>().map_or_else(|_| line.to_owned(), |t| format!("{:.0},{rest}", 1e3 * t))
                }
                None => line.to_owned(),
            })
            .collect::<Vec<_>>()
            .join("\n");
        let refused = plain.drive(&testing::table("a", &milli)).unwrap_err().to_string();
        assert!(refused.contains("its rows are 50 s apart") && refused.contains("time_unit = \"ms\""), "{refused}");
        let said = text.replace("time = ", "time_unit = \"ms\"\ntime = ");
        let same = RobotFile::parse("robot.toml", &said)
            .expect("a robot")
            .drive(&testing::table("a", &milli))
            .expect("a drive");
        for (a, b) in same.time.iter().zip(&seconds.time) {
            approx::assert_relative_eq!(*a, *b, epsilon = 1e-9);
        }
    }
}
