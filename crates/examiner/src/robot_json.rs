//! robot.json: what the user knows.

use serde_json::{Map, Value, json};

use crate::casters::Casters;
use crate::robot::{Constants, GRAVITY, SIGMAS};
use crate::sensors::Sheet;

/// The robot as its user describes it.
pub(crate) fn describe(c: &Constants, sheet: &Sheet, row_rate: f64) -> Value {
    let row_ms = 1000.0 / row_rate;
    let note = format!(
        "wheel_speed is the difference of the quantised angle over the last {row_ms} ms; IMU and \
         pose run on their own clocks and each sample is written in the first row at or after its \
         instant; accelerometer gives specific force at the reference point"
    );
    let mut robot = json!({
        "description": "four-wheeled skid-steer, front and rear wheel of each side belt-coupled, \
            one motor and one encoder per side (on the rear wheel); axes x forward, y left, z up; \
            reference point = geometric centre",
        "mass_kg": c.mass,
        "yaw_inertia_kg_m2": c.yaw_inertia,
        "com_height_m": c.height,
        "com_x_m": c.centre[0],
        "com_y_m": c.centre[1],
        "half_wheelbase_m": c.half_base,
        "half_track_m": c.half_track,
        "wheel_radius_m": c.radius,
        "wheel_inertia_kg_m2": c.wheel_inertia,
        "motor_inertia_at_wheel_kg_m2_per_side": c.motor_inertia,
        "wheel_mass_kg": (6.0 * c.mass).round() / 100.0,
        "adhesion_coefficient": c.adhesion,
        "slip_ratio_at_peak_guess": c.peak_slip,
        "rolling_resistance_coefficient": c.rolling,
        "drivetrain_coulomb_Nm_per_side": c.coulomb[0],
        "drivetrain_viscous_Nms_per_rad_per_side": c.viscous[0],
        "rear_hitch_x_m": c.hitch,
        "motor": {
            "torque_constant_Nm_per_A": 0.035,
            "gear_ratio": 28.0,
            "efficiency": 0.82,
            "current_loop_time_constant_s": c.current_lag,
            "torque_limit_Nm_per_side": c.torque_limit,
            "note": "torque_* columns are the set-point current times torque constant, gear ratio \
                and efficiency (wheel side, whole side); the delivered torque is not measured"
        },
        "relative_uncertainty_1sigma": {
            "mass_kg": SIGMAS.mass,
            "yaw_inertia_kg_m2": SIGMAS.yaw_inertia,
            "com_height_m": SIGMAS.height,
            "adhesion_coefficient": SIGMAS.adhesion,
            "rolling_resistance_coefficient": SIGMAS.rolling,
            "drivetrain_coulomb_Nm_per_side": SIGMAS.coulomb,
            "drivetrain_coulomb_left_right_difference": SIGMAS.side_difference,
            "drivetrain_viscous_Nms_per_rad_per_side": SIGMAS.viscous,
            "torque_constant_Nm_per_A": SIGMAS.torque_constant,
            "motor_inertia_at_wheel_kg_m2_per_side": SIGMAS.motor_inertia,
            "com_x_y_m_absolute": SIGMAS.centre,
            "run_to_run_friction": SIGMAS.run_to_run,
        },
        "sensors": {
            "encoder_counts_per_wheel_rev": sheet.counts as u32,
            "gyro_std_rad_s": sheet.gyro,
            "gyro_bias_std_rad_s": sheet.gyro_bias,
            "accel_std_m_s2": sheet.accel,
            "accel_bias_std_m_s2": sheet.accel_bias,
            "torque_std_Nm": sheet.torque,
            "torque_step_Nm": sheet.torque_step,
            "pose_xy_std_m": sheet.place,
            "pose_yaw_std_rad": sheet.yaw,
            "imu_rate_Hz": sheet.imu_rate,
            "pose_rate_Hz": sheet.pose_rate,
            "row_rate_Hz": row_rate,
            "note": note,
        },
        "gravity_m_s2": GRAVITY,
    });
    if let (Some(casters), Some(robot)) = (&c.casters, robot.as_object_mut()) {
        describe_casters(robot, casters);
    }
    robot
}

/// What a robot on casters says instead of a wheelbase.
fn describe_casters(robot: &mut Map<String, Value>, casters: &Casters) {
    let [[x, y], [second_x, second_y]] = casters.places;
    robot.remove("half_wheelbase_m");
    robot.remove("rear_hitch_x_m");
    robot.extend([
        (
            "description".to_owned(),
            json!(
                "two driven wheels on one axle, one motor and one encoder each, and casters; axes x forward, y left, z \
                up; reference point = middle of the axle"
            ),
        ),
        ("chassis".to_owned(), json!("differential")),
        ("caster_x_m".to_owned(), json!(x)),
        ("caster_y_m".to_owned(), json!(y)),
        ("second_caster_x_m".to_owned(), json!(second_x)),
        ("second_caster_y_m".to_owned(), json!(second_y)),
        ("caster_trail_m".to_owned(), json!(casters.trail)),
        ("caster_rolling_coefficient".to_owned(), json!(casters.rolling)),
    ]);
}
