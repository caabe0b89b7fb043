//! Pose from counts alone on drives that no fit has seen.

use crate::drive::Drive;
use crate::motion::relative;
use crate::settings::SETTINGS;
use crate::windows::windows;
use inference::robust::median;

/// Errors of forecasts of one length: position, m, and heading, rad, one of each beginning.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Errors {
    /// Distance between forecast and measured position, m.
    pub position: Vec<f64>,
    /// Difference of headings, rad, without its sign.
    pub heading: Vec<f64>,
}

impl Errors {
    /// Medians of position, m, and heading, rad; `None` where no drive is long enough, and no position where only headings
    /// were measured.
    pub fn medians(&self) -> Option<[Option<f64>; 2]> {
        Some([median(self.position.iter().copied()), Some(median(self.heading.iter().copied())?)])
    }

    /// Adds those of other drives.
    pub fn extend(&mut self, other: Self) {
        self.position.extend(other.position);
        self.heading.extend(other.heading);
    }
}

/// Lengths of forecasts, s.
pub const LENGTHS: [f64; 3] = SETTINGS.forecast.lengths;

/// Errors of forecasts of each of [`LENGTHS`], beginning every second, by what counts alone say of a drive.
pub(crate) fn forecast(drive: &Drive, path: &[[f64; 3]]) -> [Errors; 3] {
    LENGTHS.map(|length| {
        let mut out = Errors::default();
        for window in windows(drive, length, SETTINGS.forecast.every) {
            let [x, y, yaw] = relative(path[window.from], path[window.to]);
            if !drive.heading_only {
                out.position.push((x - window.moved[0]).hypot(y - window.moved[1]));
            }
            out.heading.push((yaw - window.moved[2]).abs());
        }
        out
    })
}
