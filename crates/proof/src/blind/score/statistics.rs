//! Means and medians; shares are counted in `inference`.

use inference::robust;

pub(crate) use inference::rate::Rate;

/// Mean, if there is anything.
pub(in crate::blind) fn mean(values: &[f64]) -> Option<f64> {
    robust::mean(values.iter().copied())
}

/// Median, if there is anything.
pub(in crate::blind) fn median(values: &[f64]) -> Option<f64> {
    robust::median(values.iter().copied())
}

/// The largest, if there is anything.
pub(in crate::blind) fn largest(values: &[f64]) -> Option<f64> {
    values.iter().copied().max_by(f64::total_cmp)
}
