//! The predicted response of a drive.

/// The predicted response of a held-out drive, row by row.
#[derive(Debug, Clone, PartialEq)]
pub struct Prediction {
    /// Name of the drive.
    pub name: String,
    /// Time, s.
    pub time: Vec<f64>,
    /// Wheel speed of each side, rad/s.
    pub wheel_speed: Vec<[f64; 2]>,
    /// Yaw rate as the gyro would show it, rad/s.
    pub yaw_rate: Vec<f64>,
}
