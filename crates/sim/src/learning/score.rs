//! What is measured of a contender.

use robot_model::paper::Structured;

use super::free_run::HORIZONS;

/// Scores of one contender with one draw of first layers and noise. Errors are against the true wheel speeds, rad/s, both
/// wheels together where not said otherwise.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Score {
    /// RMSE of each training lap.
    pub lap: Vec<f64>,
    /// Table 1 of the first lap: largest errors and RMSE of wheels 3 and 4.
    pub table1: [f64; 4],
    /// RMSE on each unseen lap with the weights frozen that the training left.
    pub frozen: Vec<f64>,
    /// The smallest RMSE that any frozen weights of the regressor reach on each unseen lap, chosen with hindsight.
    pub hindsight: Vec<f64>,
    /// RMSE on each unseen lap while following and learning on.
    pub online: Vec<f64>,
    /// RMS of predictions on each unseen lap with the weights that acted at their starts, per horizon.
    pub ahead_acting: Vec<[f64; HORIZONS.len()]>,
    /// The same with the weights that the training left.
    pub ahead_kept: Vec<[f64; HORIZONS.len()]>,
    /// Largest relative residual of the certificates over all laps.
    pub residual: f64,
    /// Whether every mean-square bound held.
    pub bounds_hold: bool,
    /// The constants of Eq. 8 that both outputs kept, if the contender knows of any.
    pub constants: Option<[Structured<f64>; 2]>,
}
