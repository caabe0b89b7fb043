//! The flat JSON form of a robot: one key per value, its unit in the key's name, relative sigmas beside.

use std::collections::BTreeMap;
use std::path::Path;

use inference::KnownEffects;
use recordings::Spot;
use robot_model::tunable::USUAL_POSE_SIGMA;
use robot_model::{Chassis, ModelError, Robot};
use serde::Deserialize;

use crate::keys::USUAL_GEOMETRY_SIGMA;
use crate::keys::{Given, spreads};
use crate::text::RobotText;
use crate::{Causality, RobotFileError, RobotSpec};

/// A robot with one key per value. Keys that nothing here needs are named too, so that a misspelt one is refused.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(dead_code, reason = "keys that are read only to be known")]
pub(crate) struct FlatRobot {
    description: Option<String>,
    mass_kg: f64,
    yaw_inertia_kg_m2: f64,
    com_height_m: f64,
    #[serde(default)]
    com_x_m: f64,
    #[serde(default)]
    com_y_m: f64,
    chassis: Option<Chassis>,
    half_wheelbase_m: Option<f64>,
    caster_x_m: Option<f64>,
    caster_y_m: Option<f64>,
    second_caster_x_m: Option<f64>,
    second_caster_y_m: Option<f64>,
    caster_trail_m: Option<f64>,
    caster_rolling_coefficient: Option<f64>,
    half_track_m: f64,
    wheel_radius_m: f64,
    wheel_inertia_kg_m2: f64,
    motor_inertia_at_wheel_kg_m2_per_side: f64,
    wheel_mass_kg: Option<f64>,
    adhesion_coefficient: f64,
    slip_ratio_at_peak_guess: f64,
    rolling_resistance_coefficient: f64,
    #[serde(rename = "drivetrain_coulomb_Nm_per_side")]
    drivetrain_coulomb: f64,
    #[serde(rename = "drivetrain_viscous_Nms_per_rad_per_side")]
    drivetrain_viscous: f64,
    rear_hitch_x_m: Option<f64>,
    motor: Motor,
    #[serde(default)]
    relative_uncertainty_1sigma: Uncertainty,
    #[serde(default)]
    sensors: Sensors,
    #[serde(default = "earth")]
    gravity_m_s2: f64,
}

fn earth() -> f64 {
    9.81
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(dead_code, reason = "keys that are read only to be known")]
struct Motor {
    #[serde(rename = "torque_constant_Nm_per_A")]
    torque_constant: Option<f64>,
    gear_ratio: Option<f64>,
    efficiency: Option<f64>,
    current_loop_time_constant_s: f64,
    #[serde(rename = "torque_limit_Nm_per_side")]
    torque_limit: f64,
    note: Option<String>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
#[allow(dead_code, reason = "keys that are read only to be known")]
struct Uncertainty {
    mass_kg: Option<f64>,
    yaw_inertia_kg_m2: Option<f64>,
    com_height_m: Option<f64>,
    adhesion_coefficient: Option<f64>,
    rolling_resistance_coefficient: Option<f64>,
    #[serde(rename = "drivetrain_coulomb_Nm_per_side")]
    drivetrain_coulomb: Option<f64>,
    drivetrain_coulomb_left_right_difference: Option<f64>,
    #[serde(rename = "drivetrain_viscous_Nms_per_rad_per_side")]
    drivetrain_viscous: Option<f64>,
    #[serde(rename = "torque_constant_Nm_per_A")]
    torque_constant: Option<f64>,
    motor_inertia_at_wheel_kg_m2_per_side: Option<f64>,
    com_x_y_m_absolute: Option<f64>,
    run_to_run_friction: Option<f64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
#[allow(dead_code, reason = "keys that are read only to be known")]
struct Sensors {
    pose_xy_std_m: Option<f64>,
    pose_yaw_std_rad: Option<f64>,
    #[serde(rename = "pose_rate_Hz")]
    pose_rate: Option<f64>,
    encoder_counts_per_wheel_rev: Option<f64>,
    gyro_std_rad_s: Option<f64>,
    gyro_bias_std_rad_s: Option<f64>,
    accel_std_m_s2: Option<f64>,
    accel_bias_std_m_s2: Option<f64>,
    #[serde(rename = "imu_rate_Hz")]
    imu_rate: Option<f64>,
    #[serde(rename = "torque_std_Nm")]
    torque_std: Option<f64>,
    #[serde(rename = "torque_step_Nm")]
    torque_step: Option<f64>,
    #[serde(rename = "row_rate_Hz")]
    row_rate: Option<f64>,
    note: Option<String>,
}

/// A robot without a name has that of its file, whatever the folders.
fn name_of(file: &str) -> String {
    Path::new(file).file_stem().map_or_else(|| file.to_owned(), |stem| stem.to_string_lossy().into_owned())
}

/// A value of the file: its key, the constant that it gives, and how many of it the constant is.
struct Entry {
    key: &'static str,
    constant: &'static str,
    value: f64,
    times: f64,
}

impl FlatRobot {
    /// What the file says of the robot's constants.
    fn values(&self) -> Vec<Entry> {
        let all = [
            ("mass_kg", "mass", Some(self.mass_kg)),
            ("yaw_inertia_kg_m2", "yaw_inertia", Some(self.yaw_inertia_kg_m2)),
            ("com_height_m", "com_height", Some(self.com_height_m)),
            ("com_x_m", "com_x", Some(self.com_x_m)),
            ("com_y_m", "com_y", Some(self.com_y_m)),
            ("half_wheelbase_m", "wheelbase", self.half_wheelbase_m),
            ("caster_x_m", "caster_x", self.caster_x_m),
            ("caster_y_m", "caster_y", self.caster_y_m),
            ("second_caster_x_m", "second_caster_x", self.second_caster_x_m),
            ("second_caster_y_m", "second_caster_y", self.second_caster_y_m),
            ("caster_trail_m", "caster_trail", self.caster_trail_m),
            ("caster_rolling_coefficient", "caster_rolling", self.caster_rolling_coefficient),
            ("half_track_m", "track", Some(self.half_track_m)),
            ("wheel_radius_m", "wheel_radius", Some(self.wheel_radius_m)),
            ("wheel_inertia_kg_m2", "wheel_inertia", Some(self.wheel_inertia_kg_m2)),
            (
                "motor_inertia_at_wheel_kg_m2_per_side",
                "motor_inertia",
                Some(self.motor_inertia_at_wheel_kg_m2_per_side),
            ),
            ("adhesion_coefficient", "adhesion", Some(self.adhesion_coefficient)),
            ("slip_ratio_at_peak_guess", "slip_at_peak", Some(self.slip_ratio_at_peak_guess)),
            ("rolling_resistance_coefficient", "rolling_resistance", Some(self.rolling_resistance_coefficient)),
            ("drivetrain_coulomb_Nm_per_side", "coulomb", Some(self.drivetrain_coulomb)),
            ("drivetrain_viscous_Nms_per_rad_per_side", "viscous", Some(self.drivetrain_viscous)),
            ("rear_hitch_x_m", "hitch_x", self.rear_hitch_x_m),
            ("current_loop_time_constant_s", "motor_lag", Some(self.motor.current_loop_time_constant_s)),
            ("torque_limit_Nm_per_side", "torque_limit", Some(self.motor.torque_limit)),
            ("gravity_m_s2", "gravity", Some(self.gravity_m_s2)),
        ];
        let times = |key: &str| if key.starts_with("half_") { 2.0 } else { 1.0 };
        let present = all.into_iter().filter_map(|(key, constant, value)| Some((key, constant, value?)));
        present.map(|(key, constant, value)| Entry { key, constant, value, times: times(key) }).collect()
    }

    /// What the file says of spreads: its key, the robot file's, and the number, relative but for the centre of mass.
    fn spreads(&self) -> Vec<(&'static str, &'static str, f64)> {
        let u = &self.relative_uncertainty_1sigma;
        let all = [
            ("adhesion_coefficient", "adhesion", u.adhesion_coefficient),
            ("rolling_resistance_coefficient", "rolling_resistance", u.rolling_resistance_coefficient),
            ("drivetrain_coulomb_Nm_per_side", "coulomb", u.drivetrain_coulomb),
            ("drivetrain_viscous_Nms_per_rad_per_side", "viscous", u.drivetrain_viscous),
            ("yaw_inertia_kg_m2", "yaw_inertia", u.yaw_inertia_kg_m2),
            ("com_x_y_m_absolute", "com_x", u.com_x_y_m_absolute),
            ("com_x_y_m_absolute", "com_y", u.com_x_y_m_absolute),
            ("motor_inertia_at_wheel_kg_m2_per_side", "motor_inertia", u.motor_inertia_at_wheel_kg_m2_per_side),
            ("torque_constant_Nm_per_A", "torque_gain", u.torque_constant),
            ("mass_kg", "mass", u.mass_kg),
            ("com_height_m", "com_height", u.com_height_m),
        ];
        all.into_iter().filter_map(|(key, constant, spread)| Some((key, constant, spread?))).collect()
    }

    /// The robot of this file.
    pub(crate) fn spec(self, source: RobotText<'_>, known: KnownEffects) -> Result<RobotSpec, RobotFileError> {
        let values = self.values();
        let constants: Vec<(&'static str, f64)> = values.iter().map(|v| (v.constant, v.value * v.times)).collect();
        let robot = Robot::on_chassis(self.chassis.unwrap_or_default(), &constants)
            .map_err(|error| refusal(error, &values, source))?;
        self.check_spreads(source)?;
        Ok(RobotSpec {
            name: name_of(source.file),
            sigma: self.sigma(),
            pose_sigma: self.sensors.pose_xy_std_m.unwrap_or(USUAL_POSE_SIGMA),
            description: self.description,
            causality: Causality::TorqueDriven,
            robot,
            is_chassis_stated: self.chassis.is_some(),
            effects: Vec::new(),
            known,
            response: None,
            sources: BTreeMap::new(),
            torque_per_current: None,
            geometry_sigma: [USUAL_GEOMETRY_SIGMA; 2],
        })
    }

    /// One sigma of every tuning. A file's widens by what the model itself gets wrong: never below the usual one.
    fn sigma(&self) -> [f64; robot_model::tunable::COUNT] {
        let between_sides = self.relative_uncertainty_1sigma.drivetrain_coulomb_left_right_difference.unwrap_or(0.0);
        let given: Vec<Given> = self
            .spreads()
            .into_iter()
            .map(|(_, key, spread)| {
                let sigma = if key == "coulomb" { spread.hypot(between_sides) } else { spread };
                // Of one, a spread is what it is of anything relatively.
                Given { key, value: 1.0, sigma: Some(sigma) }
            })
            .collect();
        let (given, usual) = (spreads(&given), spreads(&[]));
        std::array::from_fn(|i| given[i].max(usual[i]))
    }

    /// Refuses a spread that is not larger than zero, where one is given.
    fn check_spreads(&self, source: RobotText<'_>) -> Result<(), RobotFileError> {
        // Keys that stand twice in a file (a value and its spread) are found at the value: the key says which is meant.
        let bad = |key: &str, value: f64, of: &str| RobotFileError::Value {
            place: source.at(of),
            key: format!("{of}.{key}"),
            what: "the number",
            value,
            must: "larger than zero",
        };
        if let Some((key, _, value)) = self.spreads().into_iter().find(|(.., spread)| *spread <= 0.0) {
            return Err(bad(key, value, "relative_uncertainty_1sigma"));
        }
        match self.sensors.pose_xy_std_m {
            Some(value) if value <= 0.0 => Err(bad("pose_xy_std_m", value, "sensors")),
            _ => Ok(()),
        }
    }
}

/// What is wrong with a constant, by the file's own key and value.
fn refusal(error: ModelError, values: &[Entry], source: RobotText<'_>) -> RobotFileError {
    let whole = |message: String| RobotFileError::Syntax { place: Spot::file(source.file), message };
    let found = match &error {
        // Of the two that a chassis needs; the others are needed by the form.
        ModelError::Missing { name, unit } => {
            let key = if *name == "wheelbase" { "half_wheelbase_m" } else { "caster_x_m" };
            let (key, expected) = (key.to_owned(), (*unit).to_owned());
            return RobotFileError::Missing { place: Spot::file(source.file), key, expected };
        }
        ModelError::Foreign { name, .. } | ModelError::Caster { name, .. } => {
            let given = values.iter().find(|v| v.constant == *name);
            let place = given.map_or_else(|| Spot::file(source.file), |v| source.at(v.key));
            return RobotFileError::Syntax { place, message: error.to_string() };
        }
        ModelError::Value { name, must, .. } => {
            let row = Robot::<f64>::CONSTANTS.iter().find(|row| row.id == *name);
            values.iter().find(|v| row.is_some_and(|row| row.is_called(v.constant))).map(|v| (v, *must))
        }
        _ => None,
    };
    match found {
        Some((v, must)) => {
            RobotFileError::Model { place: source.at(v.key), key: v.key.to_owned(), value: v.value, must }
        }
        None => whole(error.to_string()),
    }
}
