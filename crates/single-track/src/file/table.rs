//! Drives from the columns of tables.

use crate::drive::{Columns, Drive};
use crate::file::robot::RobotFile;
use hierarchical_fit::{CaseError as CarError, Table, or_nan};

impl RobotFile {
    /// A drive from the columns of a table; its name is that of the table.
    ///
    /// A table without the columns of the pose is a drive without pose. Empty cells were not seen.
    ///
    /// # Errors
    /// Columns that are missing, cells that are no numbers, and what [`Drive::of_car`] refuses.
    pub fn drive(&self, table: &Table) -> Result<Drive, CarError> {
        Drive::of_car(&table.drive, &self.columns_of(table)?, &self.car)
    }

    /// A drive whose pose is to be predicted from its commands: nothing else needs to be there. Where the pose was seen for long
    /// enough to give a velocity, the prediction begins.
    ///
    /// # Errors
    /// As [`RobotFile::drive`].
    pub fn held_out(&self, table: &Table) -> Result<Drive, CarError> {
        Drive::held_out(&table.drive, &self.columns_of(table)?)
    }

    /// Steering command, −1 to 1, per unit of its column.
    pub(crate) fn steering_per_unit(&self) -> f64 {
        match self.columns.steering_unit.as_str() {
            "rad" => 1.0 / self.full_asked,
            "deg" => 1.0_f64.to_radians() / self.full_asked,
            _ => 1.0,
        }
    }

    fn columns_of(&self, table: &Table) -> Result<Columns, CarError> {
        let wrong = |what: String| CarError::Drive { drive: table.drive.clone(), what };
        let needed = |column: &str| table.needed(column).map(or_nan);
        let optional = |column: &Option<String>| -> Result<Vec<f64>, CarError> {
            let Some(column) = column else { return Ok(Vec::new()) };
            Ok(table.optional(column)?.map(or_nan).unwrap_or_default())
        };

        let names = &self.columns;
        let per_unit = self.steering_per_unit();
        let [x, y, yaw] = [optional(&names.x)?, optional(&names.y)?, optional(&names.yaw)?];
        let pose = x.iter().zip(&y).zip(&yaw).map(|((x, y), yaw)| [*x, *y, *yaw]).collect();
        let second = odometry::file::seconds_in(names.time_unit.as_deref()).map_err(wrong)?;
        let seconds = |column: Vec<f64>| column.into_iter().map(|t| t * second).collect();
        Ok(Columns {
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
