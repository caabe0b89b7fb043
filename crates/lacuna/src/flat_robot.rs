//! The flat JSON form of a robot: one key per value, its unit in the key's name, relative sigmas beside.

use std::collections::BTreeMap;
use std::path::Path;

use robot_model::Robot;
use robot_model::robot::{Drive, USUAL_REST_SPEED, USUAL_SLIDING_SHARE};
use serde::Deserialize;

use crate::robot_file::USUAL_POSE_SIGMA;
use crate::robot_parameters::refused;
use crate::robot_text::RobotText;
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
    half_wheelbase_m: f64,
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

/// The file's keys of the model's quantities.
const KEYS: [(&str, &str); 18] = [
    ("mass", "mass_kg"),
    ("yaw_inertia", "yaw_inertia_kg_m2"),
    ("com_height", "com_height_m"),
    ("com_x", "com_x_m"),
    ("com_y", "com_y_m"),
    ("half_wheelbase", "half_wheelbase_m"),
    ("half_track", "half_track_m"),
    ("wheel_radius", "wheel_radius_m"),
    ("wheel_inertia", "wheel_inertia_kg_m2"),
    ("motor_inertia", "motor_inertia_at_wheel_kg_m2_per_side"),
    ("adhesion", "adhesion_coefficient"),
    ("slip_at_peak", "slip_ratio_at_peak_guess"),
    ("rolling_resistance", "rolling_resistance_coefficient"),
    ("coulomb (left)", "drivetrain_coulomb_Nm_per_side"),
    ("viscous (left)", "drivetrain_viscous_Nms_per_rad_per_side"),
    ("drive.lag", "current_loop_time_constant_s"),
    ("drive.limit", "torque_limit_Nm_per_side"),
    ("gravity", "gravity_m_s2"),
];

/// A robot without a name has that of its file, whatever the folders.
fn name_of(file: &str) -> String {
    Path::new(file).file_stem().map_or_else(|| file.to_owned(), |stem| stem.to_string_lossy().into_owned())
}

impl FlatRobot {
    /// The robot of this file.
    pub(crate) fn spec(self, source: RobotText<'_>) -> Result<RobotSpec, RobotFileError> {
        let robot = Robot {
            mass: self.mass_kg,
            yaw_inertia: self.yaw_inertia_kg_m2,
            com: [self.com_x_m, self.com_y_m, self.com_height_m],
            half_wheelbase: self.half_wheelbase_m,
            half_track: self.half_track_m,
            wheel_radius: self.wheel_radius_m,
            wheel_inertia: self.wheel_inertia_kg_m2,
            motor_inertia: self.motor_inertia_at_wheel_kg_m2_per_side,
            adhesion: self.adhesion_coefficient,
            slip_at_peak: self.slip_ratio_at_peak_guess,
            rest_speed: USUAL_REST_SPEED,
            sliding_share: USUAL_SLIDING_SHARE,
            lateral_factor: 1.0,
            rolling_resistance: self.rolling_resistance_coefficient,
            coulomb: [self.drivetrain_coulomb; 2],
            viscous: [self.drivetrain_viscous; 2],
            stribeck: 0.0,
            hitch_x: self.rear_hitch_x_m.unwrap_or(-self.half_wheelbase_m),
            drive: Drive {
                gain: 1.0,
                lag: self.motor.current_loop_time_constant_s,
                extra_lag: 0.0,
                delay: 0.0,
                limit: self.motor.torque_limit,
                dead_band: 0.0,
            },
            gravity: self.gravity_m_s2,
        }
        .checked()
        .map_err(|error| {
            let name = refused(&error);
            let key = KEYS.iter().find(|k| k.0 == name).map_or(name, |k| k.1);
            RobotFileError::Model { place: source.at(key), key: key.to_owned(), source: error }
        })?;
        self.check_spreads(source)?;
        // A file's sigma widens by what the model itself gets wrong: never below the usual one.
        let u = &self.relative_uncertainty_1sigma;
        let coulomb = u.drivetrain_coulomb.map(|c| c.hypot(u.drivetrain_coulomb_left_right_difference.unwrap_or(0.0)));
        let given = |id: &str| match id {
            "adhesion" => u.adhesion_coefficient,
            "rolling_resistance" => u.rolling_resistance_coefficient,
            "coulomb_left" | "coulomb_right" => coulomb,
            "viscous" => u.drivetrain_viscous,
            "yaw_inertia" => u.yaw_inertia_kg_m2,
            "com_x" | "com_y" => u.com_x_y_m_absolute,
            "motor_inertia" => u.motor_inertia_at_wheel_kg_m2_per_side,
            "torque_constant" => u.torque_constant,
            "mass" => u.mass_kg,
            "com_height" => u.com_height_m,
            _ => None,
        };
        let mut sigma = robot_model::tunable::usual_sigma();
        for (s, t) in sigma.iter_mut().zip(robot_model::tunable::tunables::<f64>()) {
            *s = given(t.id).map_or(*s, |g| g.max(*s));
        }
        Ok(RobotSpec {
            name: name_of(source.file),
            description: self.description.clone(),
            causality: Causality::TorqueDriven,
            robot,
            effects: Vec::new(),
            response: None,
            sources: BTreeMap::new(),
            sigma,
            pose_sigma: self.sensors.pose_xy_std_m.unwrap_or(USUAL_POSE_SIGMA),
            torque_per_current: None,
        })
    }

    /// Refuses a spread that is not larger than zero, where one is given.
    fn check_spreads(&self, source: RobotText<'_>) -> Result<(), RobotFileError> {
        let u = &self.relative_uncertainty_1sigma;
        // Keys that stand twice in a file (a value and its spread) are found at the value: the key says which is meant.
        let spreads = [
            ("adhesion_coefficient", u.adhesion_coefficient),
            ("rolling_resistance_coefficient", u.rolling_resistance_coefficient),
            ("drivetrain_coulomb_Nm_per_side", u.drivetrain_coulomb),
            ("drivetrain_viscous_Nms_per_rad_per_side", u.drivetrain_viscous),
            ("yaw_inertia_kg_m2", u.yaw_inertia_kg_m2),
            ("com_x_y_m_absolute", u.com_x_y_m_absolute),
            ("motor_inertia_at_wheel_kg_m2_per_side", u.motor_inertia_at_wheel_kg_m2_per_side),
            ("torque_constant_Nm_per_A", u.torque_constant),
            ("mass_kg", u.mass_kg),
            ("com_height_m", u.com_height_m),
        ];
        let bad = |key: &str, value: f64, of: &str| RobotFileError::Value {
            place: source.at(of),
            key: format!("{of}.{key}"),
            what: "the number",
            value,
            must: "larger than zero",
        };
        for (key, value) in spreads {
            if let Some(value) = value.filter(|v| *v <= 0.0) {
                return Err(bad(key, value, "relative_uncertainty_1sigma"));
            }
        }
        match self.sensors.pose_xy_std_m {
            Some(value) if value <= 0.0 => Err(bad("pose_xy_std_m", value, "sensors")),
            _ => Ok(()),
        }
    }
}
