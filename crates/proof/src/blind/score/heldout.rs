//! What the correction is worth on drives that the diagnoser knows the inputs of only.

use std::path::Path;

use anyhow::{Result, ensure};
use examiner::free_run_error;
use serde::Serialize;

use super::super::truth::{Opened, Response, response};

/// A gap between model and truth counts if the calibrated error is so many times that of a perfect model ...
const TIMES: f64 = 1.5;
/// ... and larger by more than this: wheel speed, yaw rate, rad/s.
const FLOOR: [f64; 2] = [0.05, 0.01];
/// Predictions that are no numbers or beyond all bounds count as these, so that they can be scored.
const BOUND: f64 = 1e3;
/// A correction is worse than none if it adds more than this share to the error.
const WORSE: f64 = 1.05;

/// Errors of predicted drives, rms of wheel speed and of yaw rate over all drives of a case, rad/s.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub(in crate::blind) struct HeldOut {
    /// The user's values.
    pub(in crate::blind) nominal: [f64; 2],
    /// The true values without what is hidden.
    pub(in crate::blind) calibrated: [f64; 2],
    /// The true values with it.
    pub(in crate::blind) oracle: [f64; 2],
    /// The tool's corrected model.
    pub(in crate::blind) tool: Option<[f64; 2]>,
    /// The tool's calibrated model without correction.
    pub(in crate::blind) own: Option<[f64; 2]>,
}

impl HeldOut {
    /// From the truth of a case and a folder of predictions; a tool that predicts not all drives predicts none.
    pub(super) fn of(opened: &Opened, predictions: Option<&Path>) -> Result<Self> {
        let drives = || opened.truth.heldout.values();
        let predicted = |suffix: &str| -> Result<Option<[f64; 2]>> {
            let mut errors = Vec::new();
            for (drive, truth) in &opened.responses {
                let path = predictions.map(|folder| folder.join(format!("{drive}{suffix}.csv")));
                let Some(path) = path.filter(|p| p.is_file()) else { return Ok(None) };
                let given = response(&path)?;
                ensure!(
                    given.len() == truth.len(),
                    "'{}' has {} rows, the drive has {}",
                    path.display(),
                    given.len(),
                    truth.len()
                );
                errors.push(free_run_error(truth, &bounded(given)));
            }
            Ok(Some(rms(&errors)))
        };
        Ok(Self {
            nominal: rms(&drives().map(|h| h.nominal).collect::<Vec<_>>()),
            calibrated: rms(&drives().map(|h| h.calibrated).collect::<Vec<_>>()),
            oracle: rms(&drives().map(|h| h.oracle).collect::<Vec<_>>()),
            tool: predicted("")?,
            own: predicted(".nominal")?,
        })
    }

    /// Whether what is hidden makes a difference worth closing in a quantity (0 wheel speed, 1 yaw rate).
    pub(in crate::blind) fn has_gap(&self, of: usize) -> bool {
        self.calibrated[of] > TIMES * self.oracle[of] && self.calibrated[of] - self.oracle[of] > FLOOR[of]
    }

    /// Share of the gap that the correction closes: 1 for a perfect model, 0 for none, at least -1.
    pub(in crate::blind) fn closed(&self, of: usize) -> Option<f64> {
        self.share(of, self.calibrated)
    }

    /// The same, measured from the tool's own model without correction.
    pub(in crate::blind) fn closed_from_own(&self, of: usize) -> Option<f64> {
        self.own.filter(|own| own[of] > self.oracle[of]).and_then(|own| self.share(of, own))
    }

    fn share(&self, of: usize, before: [f64; 2]) -> Option<f64> {
        let tool = self.tool.filter(|_| self.has_gap(of))?;
        Some(((before[of] - tool[of]) / (before[of] - self.oracle[of])).clamp(-1.0, 1.0))
    }

    /// Whether the corrected model predicts worse than the tool's own model without correction.
    pub(in crate::blind) fn worse(&self, of: usize) -> Option<bool> {
        self.tool.zip(self.own).map(|(tool, own)| tool[of] > WORSE * own[of])
    }

    /// Error over that of the true values without what is hidden.
    pub(in crate::blind) fn over_calibrated(&self, of: usize) -> Option<f64> {
        self.tool.map(|tool| tool[of] / self.calibrated[of])
    }
}

/// Root mean square over drives.
fn rms(drives: &[[f64; 2]]) -> [f64; 2] {
    let n = drives.len().max(1) as f64;
    [0, 1].map(|of| (drives.iter().map(|d| d[of] * d[of]).sum::<f64>() / n).sqrt())
}

fn bounded(response: Response) -> Response {
    let number = |x: f64| match x {
        x if x.is_nan() => 0.0,
        f64::INFINITY => BOUND,
        f64::NEG_INFINITY => -BOUND,
        x => x,
    };
    response.into_iter().map(|row| row.map(number)).collect()
}

#[cfg(test)]
mod tests {
    use super::{HeldOut, bounded, rms};

    fn heldout(calibrated: f64, oracle: f64, tool: f64, own: f64) -> HeldOut {
        HeldOut {
            nominal: [9.0; 2],
            calibrated: [calibrated; 2],
            oracle: [oracle; 2],
            tool: Some([tool; 2]),
            own: Some([own; 2]),
        }
    }

    #[test]
    fn the_gap_closed_is_a_share_within_bounds() {
        let h = heldout(1.1, 0.1, 0.35, 0.6);
        assert!((h.closed(0).expect("a gap") - 0.75).abs() < 1e-12);
        assert!((h.closed_from_own(0).expect("a gap") - 0.5).abs() < 1e-12);
        assert_eq!(heldout(1.1, 0.1, 7.0, 1.0).closed(1), Some(-1.0));
        assert_eq!(heldout(1.1, 0.1, 0.05, 1.0).closed(1), Some(1.0));
        assert_eq!(heldout(1.1, 0.1, 0.35, 0.1).closed_from_own(0), None, "the own model is perfect already");
        assert_eq!(HeldOut { tool: None, ..h }.closed(0), None);
    }

    #[test]
    fn a_gap_must_be_a_factor_and_more_than_the_noise() {
        assert_eq!(heldout(0.149, 0.1, 0.1, 0.1).closed(0), None, "less than 1.5 times");
        let small = heldout(0.06, 0.02, 0.03, 0.1);
        assert_eq!(small.closed(0), None, "0.04 rad/s is noise of a wheel speed");
        assert!((small.closed(1).expect("but not of a yaw rate") - 0.75).abs() < 1e-12);
    }

    #[test]
    fn worse_means_by_more_than_five_percent() {
        assert_eq!(heldout(1.0, 0.1, 0.52, 0.5).worse(0), Some(false));
        assert_eq!(heldout(1.0, 0.1, 0.53, 0.5).worse(0), Some(true));
        assert_eq!(heldout(0.2, 0.1, 0.3, 0.5).over_calibrated(0).map(|r| (10.0 * r).round()), Some(15.0));
    }

    #[test]
    fn drives_are_pooled_by_squares_and_nonsense_is_bounded() {
        assert_eq!(rms(&[[3.0, 0.0], [4.0, 2.0]]), [12.5_f64.sqrt(), 2.0_f64.sqrt()]);
        let response = bounded(vec![[f64::NAN, f64::INFINITY, -2.0]]);
        assert_eq!(response, vec![[0.0, 1e3, -2.0]]);
    }
}
