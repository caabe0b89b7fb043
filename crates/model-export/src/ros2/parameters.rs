//! Names of the parameters, as in the `*_parameters.yaml` files of ros2_controllers 4.x (Jazzy).

use serde::Serialize;

use crate::ros2::covariance::Scatter;
use crate::ros2::geometry::{Geometry, Side, rounded};

/// Diagonals of covariances, which most controllers name alike.
#[derive(Debug, Default, Serialize)]
pub(crate) struct Covariances {
    #[serde(skip_serializing_if = "Option::is_none")]
    pose_covariance_diagonal: Option<[f64; 6]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    twist_covariance_diagonal: Option<[f64; 6]>,
}

/// Parameters of a controller.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub(crate) enum Parameters {
    Differential {
        left_wheel_names: Vec<String>,
        right_wheel_names: Vec<String>,
        wheel_separation: f64,
        wheel_radius: f64,
        wheel_separation_multiplier: f64,
        left_wheel_radius_multiplier: f64,
        right_wheel_radius_multiplier: f64,
        #[serde(flatten)]
        covariances: Covariances,
    },
    DriveAndSteer {
        traction_joint_name: String,
        steering_joint_name: String,
        wheelbase: f64,
        wheel_radius: f64,
        #[serde(flatten)]
        covariances: Covariances,
    },
    Tricycle {
        front_steering: bool,
        rear_wheels_names: Vec<String>,
        front_wheels_names: Vec<String>,
        wheel_track: f64,
        wheelbase: f64,
        front_wheels_radius: f64,
        rear_wheels_radius: f64,
        #[serde(flatten)]
        covariances: Covariances,
    },
    Bicycle {
        front_steering: bool,
        rear_wheels_names: Vec<String>,
        front_wheels_names: Vec<String>,
        wheelbase: f64,
        #[serde(skip_serializing_if = "Option::is_none")]
        front_wheel_radius: Option<f64>,
        #[serde(skip_serializing_if = "Option::is_none")]
        rear_wheel_radius: Option<f64>,
        #[serde(flatten)]
        covariances: Covariances,
    },
    Mecanum {
        front_left_wheel_command_joint_name: String,
        front_right_wheel_command_joint_name: String,
        rear_left_wheel_command_joint_name: String,
        rear_right_wheel_command_joint_name: String,
        kinematics: MecanumKinematics,
        #[serde(flatten)]
        covariances: Covariances,
    },
    Omni {
        wheel_names: Vec<String>,
        robot_radius: f64,
        wheel_radius: f64,
        wheel_offset: f64,
        #[serde(skip_serializing_if = "Option::is_none")]
        diagonal_covariance: Option<OmniCovariances>,
    },
}

#[derive(Debug, Serialize)]
pub(crate) struct MecanumKinematics {
    wheels_radius: f64,
    #[serde(rename = "sum_of_robot_center_projection_on_X_Y_axis")]
    reach: f64,
}

#[derive(Debug, Serialize)]
pub(crate) struct OmniCovariances {
    pose: [f64; 6],
    twist: [f64; 6],
}

impl Parameters {
    /// Of a geometry, with what is known of its errors.
    pub(crate) fn new(geometry: &Geometry, scatter: Option<&Scatter>) -> Self {
        let covariances = Covariances {
            pose_covariance_diagonal: scatter.map(Scatter::pose),
            twist_covariance_diagonal: scatter.map(|s| s.twist(geometry)),
        };
        match geometry.clone() {
            Geometry::Differential { left, right, separation } => {
                // One parameter holds the stated radius of both sides; each side has a multiplier of its own.
                let stated = 0.5 * (left.radius.stated + right.radius.stated);
                let multiplier = |side: &Side| rounded(side.radius.corrected / stated);
                Self::Differential {
                    left_wheel_radius_multiplier: multiplier(&left),
                    right_wheel_radius_multiplier: multiplier(&right),
                    left_wheel_names: left.joints,
                    right_wheel_names: right.joints,
                    wheel_separation: rounded(separation.stated),
                    wheel_radius: rounded(stated),
                    wheel_separation_multiplier: rounded(separation.multiplier()),
                    covariances,
                }
            }
            Geometry::DriveAndSteer { traction, steering, wheelbase, radius } => Self::DriveAndSteer {
                traction_joint_name: traction,
                steering_joint_name: steering,
                wheelbase: rounded(wheelbase.corrected),
                wheel_radius: rounded(radius.corrected),
                covariances,
            },
            Geometry::Tricycle { rear, steering, track, wheelbase, front_radius, rear_radius } => Self::Tricycle {
                front_steering: true,
                rear_wheels_names: rear,
                front_wheels_names: vec![steering],
                wheel_track: rounded(track.corrected),
                wheelbase: rounded(wheelbase.corrected),
                front_wheels_radius: rounded(front_radius.corrected),
                rear_wheels_radius: rounded(rear_radius.corrected),
                covariances,
            },
            Geometry::Bicycle { rear, steering, wheelbase, radii } => Self::Bicycle {
                front_steering: true,
                rear_wheels_names: vec![rear],
                front_wheels_names: vec![steering],
                wheelbase: rounded(wheelbase.corrected),
                front_wheel_radius: radii.map(|[front, _]| rounded(front.corrected)),
                rear_wheel_radius: radii.map(|[_, rear]| rounded(rear.corrected)),
                covariances,
            },
            Geometry::Mecanum { joints: [front_left, front_right, rear_left, rear_right], radius, reach } => {
                Self::Mecanum {
                    front_left_wheel_command_joint_name: front_left,
                    front_right_wheel_command_joint_name: front_right,
                    rear_left_wheel_command_joint_name: rear_left,
                    rear_right_wheel_command_joint_name: rear_right,
                    kinematics: MecanumKinematics {
                        wheels_radius: rounded(radius.corrected),
                        reach: rounded(reach.corrected),
                    },
                    covariances,
                }
            }
            Geometry::Omni { joints, radius, reach, offset } => Self::Omni {
                wheel_names: joints,
                robot_radius: rounded(reach.corrected),
                wheel_radius: rounded(radius.corrected),
                wheel_offset: rounded(offset),
                diagonal_covariance: scatter.map(|s| OmniCovariances { pose: s.pose(), twist: s.twist(geometry) }),
            },
        }
    }
}

/// Parameters of `ekf_node` of robot_localization: velocities from the controller's odometry, nothing else.
#[derive(Debug, Serialize)]
pub(crate) struct Filter {
    two_d_mode: bool,
    odom0: String,
    odom0_config: [bool; 15],
}

impl Filter {
    pub(crate) fn new(geometry: &Geometry) -> Self {
        // x, y, z, roll, pitch, yaw, their rates, and accelerations along x, y, z.
        let mut fused = [false; 15];
        (fused[6], fused[7], fused[11]) = (true, geometry.moves_sideways(), true);
        Self { two_d_mode: true, odom0: geometry.topic(), odom0_config: fused }
    }
}
