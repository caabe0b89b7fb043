//! Neutral copies of recordings that hold only what the program may see.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, ensure};

/// A table of numbers by column name.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Table {
    pub(super) columns: Vec<String>,
    pub(super) rows: Vec<Vec<f64>>,
}

impl Table {
    /// Reads a CSV file of numbers; an empty cell is NaN.
    pub(super) fn read(path: &Path) -> Result<Self> {
        let shown = path.display();
        let mut reader = csv::Reader::from_path(path).with_context(|| format!("cannot read '{shown}'"))?;
        let columns =
            reader.headers().with_context(|| format!("'{shown}' has no header"))?.iter().map(str::to_owned).collect();
        let rows = reader
            .records()
            .enumerate()
            .map(|(i, row)| {
                let row = row.with_context(|| format!("'{shown}', line {}", i + 2))?;
                let number = |cell: &str| match cell.trim() {
                    "" => Ok(f64::NAN),
                    text => text.parse().with_context(|| format!("'{shown}', line {}: '{cell}' is no number", i + 2)),
                };
                row.iter().map(number).collect()
            })
            .collect::<Result<_>>()?;
        Ok(Self { columns, rows })
    }

    /// Position of a column.
    pub(super) fn position(&self, column: &str) -> Result<usize> {
        self.columns.iter().position(|c| c == column).with_context(|| format!("there is no column '{column}'"))
    }

    /// Values of a column.
    pub(super) fn column(&self, column: &str) -> Result<Vec<f64>> {
        let at = self.position(column)?;
        Ok(self.rows.iter().map(|row| row[at]).collect())
    }

    /// Only these columns.
    pub(super) fn only(&self, columns: &[&str]) -> Result<Self> {
        let at = columns.iter().map(|c| self.position(c)).collect::<Result<Vec<_>>>()?;
        Ok(Self {
            columns: columns.iter().map(|c| (*c).to_owned()).collect(),
            rows: self.rows.iter().map(|row| at.iter().map(|&i| row[i]).collect()).collect(),
        })
    }

    /// Rows whose time lies in `from..until`, with time beginning at zero.
    pub(super) fn between(&self, from: f64, until: f64) -> Result<Self> {
        let at = self.position("time")?;
        let inside = self.rows.iter().filter(|row| row[at] >= from && row[at] < until);
        let shifted = |row: &Vec<f64>| {
            let mut row = row.clone();
            row[at] -= from;
            row
        };
        Ok(Self { columns: self.columns.clone(), rows: inside.map(shifted).collect() })
    }

    /// This recording, then another; also returns when the other begins.
    pub(super) fn then(&self, other: &Self) -> Result<(Self, f64)> {
        ensure!(self.columns == other.columns && self.rows.len() > 1, "recordings of other columns cannot follow");
        let at = self.position("time")?;
        let last = self.rows[self.rows.len() - 1][at];
        let join = 2.0 * last - self.rows[self.rows.len() - 2][at];
        let mut out = self.clone();
        out.rows.extend(other.rows.iter().map(|row| {
            let mut row = row.clone();
            row[at] += join;
            row
        }));
        Ok((out, join))
    }

    /// Writes the table.
    pub(super) fn write(&self, path: &Path) -> Result<()> {
        let cannot = || format!("cannot write '{}'", path.display());
        if let Some(folder) = path.parent() {
            fs::create_dir_all(folder).with_context(cannot)?;
        }
        let mut writer = csv::Writer::from_path(path).with_context(cannot)?;
        writer.write_record(&self.columns).with_context(cannot)?;
        for row in &self.rows {
            writer
                .write_record(row.iter().map(|x| if x.is_nan() { String::new() } else { x.to_string() }))
                .with_context(cannot)?;
        }
        writer.flush().with_context(cannot)
    }
}

/// What of a Husky's recording the program may see.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Sight {
    /// Set speeds, currents and yaw rate.
    Yaw,
    /// The roll and pitch rates as well.
    Gyro,
    /// The accelerometer as well: everything.
    All,
    /// Currents and the mean of the set speeds.
    Currents,
}

impl Sight {
    /// Columns of the inertial unit.
    fn inertial(self) -> &'static [&'static str] {
        match self {
            Self::Yaw => &["time", "wz"],
            Self::Gyro => &["time", "wx", "wy", "wz"],
            Self::All => &["time", "wx", "wy", "wz", "ax", "ay", "az"],
            Self::Currents => &[],
        }
    }

    /// The mapping that reads what may be seen.
    pub(super) fn mapping(self) -> String {
        let signal = |column: &&str| {
            let (name, unit) = match *column {
                "wx" => ("gyro_x", "rad/s"),
                "wy" => ("gyro_y", "rad/s"),
                "wz" => ("gyro_z", "rad/s"),
                "ax" => ("accel_x", "m/s^2"),
                "ay" => ("accel_y", "m/s^2"),
                "az" => ("accel_z", "m/s^2"),
                _ => return None,
            };
            Some(format!("{name} = {{ column = \"{column}\", unit = \"{unit}\" }}\n"))
        };
        let inertial: String = self.inertial().iter().filter_map(signal).collect();
        let inertial = if inertial.is_empty() {
            String::new()
        } else {
            format!(
                "\n[[files]]\npattern = \"imu_*.csv\"\ntime = {{ column = \"time\", unit = \"s\", rate_hz = 100.0 }}\n\n[files.signals]\n{inertial}"
            )
        };
        format!("{SPEEDS}{inertial}")
    }
}

/// How a Husky's set speeds and currents are read: as the built-in mapping does.
const SPEEDS: &str = r#"name = "hidden"

[[files]]
pattern = "pro_*.csv"
time = { column = "time", unit = "s", rate_hz = 6.5 }

[files.signals]
current_left = { column = "curL", unit = "A", magnitude_only = true, dead_band = 0.59 }
current_right = { column = "curR", unit = "A", magnitude_only = true, dead_band = 0.59 }
command_speed_left = { column = "velL", unit = "m/s", scale = 6.056935190793458, kind = "set-point" }
command_speed_right = { column = "velR", unit = "m/s", scale = 6.056935190793458, kind = "set-point" }
"#;

/// Writes the neutral copy of a recording into `folder`; returns the file to be named.
pub(super) fn copy(folder: &Path, id: &str, speeds: &Table, inertial: Option<&Table>, sight: Sight) -> Result<PathBuf> {
    let mut speeds = speeds.only(&["time", "curL", "curR", "velL", "velR"])?;
    if sight == Sight::Currents {
        for row in &mut speeds.rows {
            let mean = 0.5 * (row[3] + row[4]);
            (row[3], row[4]) = (mean, mean);
        }
    }
    let file = folder.join(format!("pro_{id}.csv"));
    speeds.write(&file)?;
    if let Some(inertial) = inertial.filter(|_| sight != Sight::Currents) {
        inertial.only(sight.inertial())?.write(&folder.join(format!("imu_{id}.csv")))?;
    }
    Ok(file)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> Table {
        let columns = ["time", "curL", "curR", "velL", "velR"].map(str::to_owned).to_vec();
        Table { columns, rows: (0..4).map(|i| vec![f64::from(i) * 0.5, 1.0, 2.0, 0.1, 0.3]).collect() }
    }

    #[test]
    fn hidden_columns_are_not_in_the_copy() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = copy(folder.path(), "x", &table(), None, Sight::Currents).expect("copies");
        let seen = Table::read(&file).expect("reads");
        assert_eq!(seen.column("velL").expect("speeds"), seen.column("velR").expect("speeds"));
        assert!((seen.rows[0][3] - 0.2).abs() < 1e-12);
        let inertial = Table {
            columns: ["time", "wx", "wy", "wz", "ax", "ay", "az"].map(str::to_owned).to_vec(),
            rows: vec![vec![0.0; 7]],
        };
        copy(folder.path(), "y", &table(), Some(&inertial), Sight::Yaw).expect("copies");
        let seen = Table::read(&folder.path().join("imu_y.csv")).expect("reads");
        assert_eq!(seen.columns, ["time", "wz"]);
    }

    #[test]
    fn every_sight_has_a_mapping_that_reads() {
        for sight in [Sight::Yaw, Sight::Gyro, Sight::All, Sight::Currents] {
            recordings::Mapping::parse("hidden.toml", &sight.mapping()).expect("a mapping");
        }
    }

    #[test]
    fn recordings_are_cut_and_joined() {
        let (joined, join) = table().then(&table()).expect("joins");
        assert!((join - 2.0).abs() < 1e-12 && joined.rows.len() == 8 && (joined.rows[4][0] - 2.0).abs() < 1e-12);
        let cut = joined.between(1.0, 2.5).expect("cuts");
        assert_eq!(cut.column("time").expect("times"), [0.0, 0.5, 1.0]);
        assert!(table().column("nothing").is_err());
    }
}
