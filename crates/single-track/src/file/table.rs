//! Drives from tables of comma-separated values.

use crate::drive::{Drive, Table};
use crate::file::robot::RobotFile;
use hierarchical_fit::CaseError as CarError;

impl RobotFile {
    /// A drive from a table with a line of column names; its name is that of the file.
    ///
    /// A table without the columns of the pose is a drive without pose. Empty cells were not seen.
    ///
    /// # Errors
    /// Columns that are missing, cells that are no numbers, and what [`Drive::new`] refuses.
    pub fn drive(&self, name: &str, table: &str) -> Result<Drive, CarError> {
        Drive::new(name, &self.columns_of(name, table)?)
    }

    /// A drive whose pose is to be predicted from its commands: nothing else needs to be there. Where the pose was seen for long
    /// enough to give a velocity, the prediction begins.
    ///
    /// # Errors
    /// As [`RobotFile::drive`].
    pub fn held_out(&self, name: &str, table: &str) -> Result<Drive, CarError> {
        Drive::held_out(name, &self.columns_of(name, table)?)
    }

    /// Steering command, −1 to 1, per unit of its column.
    pub(crate) fn steering_per_unit(&self) -> f64 {
        match self.columns.steering_unit.as_str() {
            "rad" => 1.0 / self.car.full_steering.value,
            "deg" => 1.0_f64.to_radians() / self.car.full_steering.value,
            _ => 1.0,
        }
    }

    fn columns_of(&self, name: &str, table: &str) -> Result<Table, CarError> {
        let wrong = |what: String| CarError::Drive { drive: name.to_owned(), what };
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(table.as_bytes());
        let header = reader.headers().map_err(|e| wrong(format!("no line of column names: {e}")))?.clone();
        let rows: Vec<csv::StringRecord> =
            reader.records().collect::<Result<_, _>>().map_err(|e| wrong(format!("a row cannot be read: {e}")))?;
        let place = |column: &str| header.iter().position(|h| h == column);
        let cells = |column: &str, at: usize| -> Result<Vec<f64>, CarError> {
            let cell = |(row, record): (usize, &csv::StringRecord)| {
                let cell = record.get(at).unwrap_or("");
                if cell.is_empty() {
                    return Ok(f64::NAN);
                }
                let value = cell.parse::<f64>();
                value.map_err(|_| wrong(format!("row {}, column '{column}': '{cell}' is no number", row + 1)))
            };
            rows.iter().enumerate().map(cell).collect()
        };
        let needed = |column: &str| {
            let at = place(column).ok_or_else(|| {
                let there: Vec<&str> = header.iter().collect();
                wrong(format!("no column '{column}'; it has {}: correct [columns] of the robot file", there.join(", ")))
            })?;
            cells(column, at)
        };
        let optional = |column: &Option<String>| match column {
            Some(column) => place(column).map_or_else(|| Ok(Vec::new()), |at| cells(column, at)),
            None => Ok(Vec::new()),
        };

        let names = &self.columns;
        let per_unit = self.steering_per_unit();
        let [x, y, yaw] = [optional(&names.x)?, optional(&names.y)?, optional(&names.yaw)?];
        let pose = x.iter().zip(&y).zip(&yaw).map(|((x, y), yaw)| [*x, *y, *yaw]).collect();
        let second = odometry::file::seconds_in(names.time_unit.as_deref()).map_err(wrong)?;
        let seconds = |column: Vec<f64>| column.into_iter().map(|t| t * second).collect();
        Ok(Table {
            time: seconds(needed(&names.time)?),
            pose,
            throttle: needed(&names.throttle)?,
            steering: needed(&names.steering)?.into_iter().map(|s| s * per_unit).collect(),
            enabled: optional(&names.enabled)?,
            car_time: seconds(optional(&names.car_time)?),
            gyro: optional(&names.gyro)?,
            encoder: optional(&names.encoder)?,
        })
    }
}
