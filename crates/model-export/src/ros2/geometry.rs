//! Wheels as ROS 2 controllers know them.

/// A length as its owner states it and as it was corrected, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Length {
    /// As stated.
    pub stated: f64,
    /// As corrected.
    pub corrected: f64,
}

impl Length {
    /// The factor from what is stated to what is right, 1.
    pub(crate) fn multiplier(self) -> f64 {
        self.corrected / self.stated
    }

    /// Whether a correction shows in the digits that are written.
    pub(crate) fn is_corrected(self) -> bool {
        rounded(self.stated) != rounded(self.corrected)
    }
}

/// Wheels of a side that turn alike.
#[derive(Debug, Clone, PartialEq)]
pub struct Side {
    /// Their joints.
    pub joints: Vec<String>,
    /// Their radius.
    pub radius: Length,
}

/// Wheels that one of the controllers holds; joints by their names in the URDF.
#[derive(Debug, Clone, PartialEq)]
pub enum Geometry {
    /// Sides that are driven: diff_drive_controller.
    Differential {
        /// Wheels of the left side.
        left: Side,
        /// Wheels of the right side.
        right: Side,
        /// Distance between the sides that turns follow; of a skid-steer robot the effective one.
        separation: Length,
    },
    /// A wheel that is driven and steered before a free axle: tricycle_controller.
    DriveAndSteer {
        /// Joint that drives.
        traction: String,
        /// Joint that steers.
        steering: String,
        /// Distance from the axle to the wheel.
        wheelbase: Length,
        /// Radius of the wheel.
        radius: Length,
    },
    /// A steered wheel before an axle of two driven ones: tricycle_steering_controller.
    Tricycle {
        /// Joints of the driven wheels.
        rear: Vec<String>,
        /// Joint that steers.
        steering: String,
        /// Distance between the driven wheels.
        track: Length,
        /// Distance from the axle to the steered wheel.
        wheelbase: Length,
        /// Radius of the steered wheel.
        front_radius: Length,
        /// Radius of the driven wheels.
        rear_radius: Length,
    },
    /// A single track: bicycle_steering_controller.
    Bicycle {
        /// Joint of the driven wheel.
        rear: String,
        /// Joint that steers.
        steering: String,
        /// Distance of the axles.
        wheelbase: Length,
        /// Radii of the steered and of the driven wheel, if they are known.
        radii: Option<[Length; 2]>,
    },
    /// Four mecanum wheels: mecanum_drive_controller.
    Mecanum {
        /// Joints: front left, front right, rear left, rear right.
        joints: [String; 4],
        /// Radius of all wheels.
        radius: Length,
        /// Distance of the wheels from the robot's middle along x and along y, added.
        reach: Length,
    },
    /// Omni wheels evenly around the middle: omni_wheel_drive_controller.
    Omni {
        /// Joints, counter-clockwise.
        joints: Vec<String>,
        /// Radius of all wheels.
        radius: Length,
        /// Distance from the middle to the wheels.
        reach: Length,
        /// Direction from the middle to the first wheel, counter-clockwise from x, rad.
        offset: f64,
    },
}

impl Geometry {
    /// Name of the controller, which is also that of its package.
    pub fn controller(&self) -> &'static str {
        match self {
            Self::Differential { .. } => "diff_drive_controller",
            Self::DriveAndSteer { .. } => "tricycle_controller",
            Self::Tricycle { .. } => "tricycle_steering_controller",
            Self::Bicycle { .. } => "bicycle_steering_controller",
            Self::Mecanum { .. } => "mecanum_drive_controller",
            Self::Omni { .. } => "omni_wheel_drive_controller",
        }
    }

    /// Type of its plugin.
    pub(crate) fn plugin(&self) -> String {
        let class = match self {
            Self::Differential { .. } => "DiffDriveController",
            Self::DriveAndSteer { .. } => "TricycleController",
            Self::Tricycle { .. } => "TricycleSteeringController",
            Self::Bicycle { .. } => "BicycleSteeringController",
            Self::Mecanum { .. } => "MecanumDriveController",
            Self::Omni { .. } => "OmniWheelDriveController",
        };
        format!("{}/{class}", self.controller())
    }

    /// Topic of its odometry.
    pub(crate) fn topic(&self) -> String {
        let last = match self {
            Self::Differential { .. } | Self::DriveAndSteer { .. } | Self::Omni { .. } => "odom",
            Self::Tricycle { .. } | Self::Bicycle { .. } | Self::Mecanum { .. } => "odometry",
        };
        format!("/{}/{last}", self.controller())
    }

    /// Whether its wheels tell a motion sideways.
    pub(crate) fn moves_sideways(&self) -> bool {
        matches!(self, Self::Mecanum { .. } | Self::Omni { .. })
    }

    /// Its lengths by the parameters that hold them.
    pub(crate) fn lengths(&self) -> Vec<(&'static str, Length)> {
        match self {
            Self::Differential { left, right, separation } => vec![
                ("wheel_separation", *separation),
                ("wheel_radius of the left side", left.radius),
                ("wheel_radius of the right side", right.radius),
            ],
            Self::DriveAndSteer { wheelbase, radius, .. } => vec![("wheelbase", *wheelbase), ("wheel_radius", *radius)],
            Self::Tricycle { track, wheelbase, front_radius, rear_radius, .. } => vec![
                ("wheel_track", *track),
                ("wheelbase", *wheelbase),
                ("front_wheels_radius", *front_radius),
                ("rear_wheels_radius", *rear_radius),
            ],
            Self::Bicycle { wheelbase, radii, .. } => {
                let names = ["front_wheel_radius", "rear_wheel_radius"];
                let radii = radii.iter().flat_map(|radii| names.into_iter().zip(*radii));
                std::iter::once(("wheelbase", *wheelbase)).chain(radii).collect()
            }
            Self::Mecanum { radius, reach, .. } => vec![
                ("kinematics.wheels_radius", *radius),
                ("kinematics.sum_of_robot_center_projection_on_X_Y_axis", *reach),
            ],
            Self::Omni { radius, reach, .. } => vec![("robot_radius", *reach), ("wheel_radius", *radius)],
        }
    }
}

/// Six significant digits: more than any calibration gives.
///
/// Below 1e-5 the mantissa keeps a point: YAML 1.1, which ROS 2 reads, takes `2e-6` for a text.
pub(crate) fn rounded(x: f64) -> f64 {
    let near: f64 = format!("{x:.5e}").parse().unwrap_or(x);
    if near == 0.0 {
        return 0.0;
    }
    if format!("{near:?}").contains('.') { near } else { near * (1.0 + f64::EPSILON) }
}
