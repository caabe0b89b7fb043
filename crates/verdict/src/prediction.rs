//! The predicted response of a drive.

/// The predicted pose of a held-out drive, row by row: x and y, m, and heading, rad; not a number where none is predicted.
#[derive(Debug, Clone, PartialEq)]
pub struct PredictedPath {
    /// Name of the drive.
    pub name: String,
    /// Time, s.
    pub time: Vec<f64>,
    /// With what was named.
    pub corrected: Vec<[f64; 3]>,
    /// With constants re-tuned and nothing named.
    pub retuned: Vec<[f64; 3]>,
}

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
