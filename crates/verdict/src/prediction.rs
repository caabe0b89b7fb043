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

/// A drive as a robot does it on its inputs alone, and how far off it is where the pose was measured.
#[derive(Debug, Clone, PartialEq)]
pub struct SimulatedPath {
    /// Name of the drive.
    pub name: String,
    /// Time, s.
    pub time: Vec<f64>,
    /// x and y, m, and heading, rad, row by row; not a number where none is simulated.
    pub pose: Vec<[f64; 3]>,
    /// Errors of runs that begin anew again and again from the measured pose, of rising lengths.
    pub ahead: Vec<ErrorAhead>,
}

/// Errors of runs of one length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ErrorAhead {
    /// Their length, s.
    pub after: f64,
    /// Median distance from the measured position, m; `None` where no run is so long, or no position was measured.
    pub position: Option<f64>,
    /// The same of the heading, rad.
    pub heading: Option<f64>,
}

impl ErrorAhead {
    /// Errors by length of medians that may be missing as a whole, or that of the position alone.
    pub fn of<const N: usize>(lengths: [f64; N], medians: [Option<[Option<f64>; 2]>; N]) -> Vec<Self> {
        let of = |(after, m): (f64, Option<[Option<f64>; 2]>)| {
            let [position, heading] = m.unwrap_or_default();
            Self { after, position, heading }
        };
        lengths.into_iter().zip(medians).map(of).collect()
    }
}
