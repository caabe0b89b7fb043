//! Drives from tables of comma-separated values.

use crate::drive::Drive;
use crate::error::OdometryError;
use crate::file::robot::RobotFile;
use crate::file::series::{Series, headings};
use hierarchical_fit::CaseError;

impl RobotFile {
    /// A drive from a table with a line of column names; its name is that of the file.
    ///
    /// Empty cells of the pose were not seen. Rows without a time are refused.
    ///
    /// # Errors
    /// Columns that are missing, cells that are no numbers, and what [`Drive::new`] refuses.
    pub fn drive(&self, name: &str, table: &str) -> Result<Drive, OdometryError> {
        self.read(name, table, true)
    }

    /// A drive whose pose is to be predicted: where the pose was seen, the prediction begins; columns and cells of the pose may be
    /// missing. Without any pose units are those of the robot file.
    ///
    /// # Errors
    /// As [`RobotFile::drive`].
    pub fn held_out(&self, name: &str, table: &str) -> Result<Drive, OdometryError> {
        self.read(name, table, false)
    }

    fn read(&self, name: &str, table: &str, needs_pose: bool) -> Result<Drive, OdometryError> {
        let wrong = |what: String| OdometryError::Case(CaseError::Drive { drive: name.to_owned(), what });
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(table.as_bytes());
        let header = reader.headers().map_err(|e| wrong(format!("no line of column names: {e}")))?.clone();
        let names = &self.columns;
        let place = |column: &String| {
            header.iter().position(|h| h == column).ok_or_else(|| {
                let there: Vec<&str> = header.iter().collect();
                wrong(format!("no column '{column}'; it has {}: correct [columns] of the robot file", there.join(", ")))
            })
        };
        let mut places = vec![place(&names.time)?];
        for column in names.wheels.iter().chain(&names.steering) {
            places.push(place(column)?);
        }
        // A gyro stands for a pose that was not recorded; one that is to be predicted is predicted from the wheels alone.
        let is_there = |column: &String| header.iter().any(|h| h == column);
        let pose = names.pose.as_ref().filter(|pose| pose.iter().any(is_there));
        let gyro = names.gyro.as_ref().filter(|_| needs_pose && pose.is_none());
        let body: &[String] = match (pose, gyro, &names.pose) {
            (Some(pose), _, _) => pose,
            (None, Some(gyro), _) => std::slice::from_ref(gyro),
            (None, None, Some(pose)) if needs_pose => pose,
            (None, None, _) => &[],
        };
        for column in body {
            places.push(place(column)?);
        }

        let mut columns: Vec<Vec<f64>> = vec![Vec::new(); places.len()];
        let first_of_pose = places.len() - body.len();
        for (row, record) in reader.records().enumerate() {
            let record = record.map_err(|e| wrong(format!("row {}: {e}", row + 1)))?;
            for (k, &at) in places.iter().enumerate() {
                let cell = record.get(at).unwrap_or("");
                let value = if cell.is_empty() && k >= first_of_pose { Ok(f64::NAN) } else { cell.parse::<f64>() };
                let value = value.map_err(|_| {
                    wrong(format!("row {}, column '{}': '{cell}' is no number", row + 1, header.get(at).unwrap_or("")))
                })?;
                columns[k].push(value);
            }
        }

        let wheels = &columns[1..=names.wheels.len()];
        let steering = names.steering.as_ref().map(|_| {
            let column = &columns[names.wheels.len() + 1];
            column.iter().map(|s| s * names.angle).collect::<Vec<f64>>()
        });
        let time: Vec<f64> = columns[0].iter().map(|t| t * names.second).collect();
        if gyro.is_some() {
            let rates = &columns[first_of_pose];
            let seen: Vec<usize> = (0..time.len()).filter(|&row| rates[row].is_finite()).collect();
            let of = |column: &[f64]| seen.iter().map(|&row| column[row]).collect();
            let mut pose = vec![[f64::NAN; 3]; time.len()];
            for (&row, heading) in seen.iter().zip(headings(&Series { time: of(&time), value: of(rates) }, names.angle))
            {
                pose[row] = heading;
            }
            let drive = Drive::by_gyro(name, &self.robot, time, (names.data, wheels), steering, pose)?;
            return Ok(drive.of_session(&self.session_of(name)));
        }
        let pose = (0..time.len())
            .map(|row| {
                let [x, y, yaw] = [0, 1, 2].map(|axis| columns.get(first_of_pose + axis).map_or(f64::NAN, |c| c[row]));
                [x * names.length, y * names.length, yaw * names.angle]
            })
            .collect();
        let new = if needs_pose { Drive::new } else { Drive::held_out };
        let drive = new(name, &self.robot, time, (names.data, wheels), steering, pose)?;
        Ok(drive.of_session(&self.session_of(name)))
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
        let drive = file.drive("D02-01", &table(80)).expect("a drive");
        assert_eq!((drive.session.as_str(), drive.time.len()), ("D02", 80));
        assert!(drive.pose[7][0].is_nan() && drive.pose[8][0] > 0.0);
        approx::assert_relative_eq!(drive.turns[1][0], std::f64::consts::TAU * 106.0 / 2796.8, epsilon = 1e-12);
    }

    #[test]
    fn what_is_wrong_with_a_table_is_one_clear_sentence() {
        let file = RobotFile::built_in("differential").expect("a file").expect("a robot");
        let refused = |table: &str| file.drive("a", table).unwrap_err().to_string();
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
        let seconds = plain.drive("a", &table(80)).expect("a drive");
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
        let refused = plain.drive("a", &milli).unwrap_err().to_string();
        assert!(refused.contains("its rows are 50 s apart") && refused.contains("time_unit = \"ms\""), "{refused}");
        let said = text.replace("time = ", "time_unit = \"ms\"\ntime = ");
        let same = RobotFile::parse("robot.toml", &said).expect("a robot").drive("a", &milli).expect("a drive");
        for (a, b) in same.time.iter().zip(&seconds.time) {
            approx::assert_relative_eq!(*a, *b, epsilon = 1e-9);
        }
    }
}
