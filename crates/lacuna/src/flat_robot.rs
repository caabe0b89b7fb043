//! The flat JSON form of a robot: one key per value, its unit in the key's name, relative sigmas beside.

use robot_model::Robot;
use robot_model::robot::{Drive, USUAL_SLIDING_SHARE};
use serde::Deserialize;
use serde::de::IgnoredAny;

use crate::robot_file::{Causality, RobotFileError, RobotSpec};

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
#[serde(default)]
struct Sensors {
    pose_xy_std_m: Option<f64>,
    #[serde(flatten)]
    _others: std::collections::BTreeMap<String, IgnoredAny>,
}

impl FlatRobot {
    pub(crate) fn spec(self, file: &str) -> Result<RobotSpec, RobotFileError> {
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
        .map_err(|source| RobotFileError::Model { file: file.to_owned(), source })?;
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
        let mut sigma = diagnosis::case::usual_sigma();
        for (s, t) in sigma.iter_mut().zip(robot_model::tunable::tunables::<f64>()) {
            *s = given(t.id).map_or(*s, |g| g.max(*s));
        }
        Ok(RobotSpec {
            name: file.to_owned(),
            causality: Causality::TorqueDriven,
            robot,
            sigma,
            pose_sigma: self.sensors.pose_xy_std_m.unwrap_or(0.004),
            torque_per_current: None,
        })
    }
}
