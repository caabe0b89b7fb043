//! Covariances of velocities and poses from errors of forecasts.

use crate::ros2::geometry::{Geometry, rounded};

/// Rate at which controllers publish odometry unless they are told otherwise, Hz.
pub(crate) const RATE: f64 = 50.0;
/// Variance of what no wheel tells (height, roll, pitch), as the examples of ROS write it; m² or rad², and per s².
pub(crate) const UNMEASURED: f64 = 1e6;

/// Errors of poses that were forecast from wheels alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Forecast {
    /// Length of the forecasts, s.
    pub after: f64,
    /// One sigma of the position along each axis, m.
    pub position: f64,
    /// One sigma of the heading, rad.
    pub heading: f64,
}

/// Errors after short and after long forecasts of drives that no fit has seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scatter {
    /// After the short ones, which the covariance of velocities comes from.
    pub short: Forecast,
    /// After the longest ones, which the covariance of poses comes from.
    pub long: Forecast,
    /// How many recordings or sessions were forecast.
    pub drives: usize,
}

impl Scatter {
    /// Diagonal of the covariance of velocities, m²/s² and rad²/s².
    ///
    /// An error that is white from sample to sample adds up as `σ_p² = T f (σ_v/f)²`, so that `σ_v² = σ_p² f / T`.
    pub(crate) fn twist(&self, geometry: &Geometry) -> [f64; 6] {
        let Forecast { after, position, heading } = self.short;
        let variance = |sigma: f64| rounded(sigma * sigma * RATE / after);
        let along = variance(position);
        let across = if geometry.moves_sideways() { along } else { UNMEASURED };
        [along, across, UNMEASURED, UNMEASURED, UNMEASURED, variance(heading)]
    }

    /// Diagonal of the covariance of poses, m² and rad²: as after the longest forecasts.
    pub(crate) fn pose(&self) -> [f64; 6] {
        let Forecast { position, heading, .. } = self.long;
        let place = rounded(position * position);
        [place, place, UNMEASURED, UNMEASURED, UNMEASURED, rounded(heading * heading)]
    }

    /// Where the covariances come from, in lines.
    pub(crate) fn told(&self) -> Vec<String> {
        let Self { short, long, drives } = self;
        let mm =
            |f: &Forecast| format!("{:.2} mm and {:.2} mrad after {} s", 1e3 * f.position, 1e3 * f.heading, f.after);
        vec![
            format!(
                "Covariances come from {drives} recordings or sessions that were left out of the fit: one sigma of \
                 poses from wheels alone is {} and {}, the error of the measured pose included.",
                mm(short),
                mm(long)
            ),
            format!(
                "twist covariance: var(v) = var(p) f / T, errors white from sample to sample, f = {RATE} Hz, T = {} s; \
                 at another rate f multiply by f/{RATE}.",
                short.after
            ),
            format!(
                "pose covariance: that after {} s; it grows for ever, so that filters should take the velocities. \
                 {UNMEASURED:e} stands for what no wheel tells.",
                long.after
            ),
        ]
    }
}
