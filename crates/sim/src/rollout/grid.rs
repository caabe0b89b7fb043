//! How the time between two rows is divided into steps.

/// Rows at a constant period, each divided into equal steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// Time between rows, s.
    pub period: f64,
    /// Steps from one row to the next.
    pub substeps: usize,
}

impl Grid {
    /// The division whose steps are nearest in number to `period / step`; both in s and larger than zero.
    pub fn nearest(period: f64, step: f64) -> Self {
        Self { period, substeps: (period / step).round().max(1.0) as usize }
    }

    /// The coarsest division whose steps are no longer than `step`; both in s and larger than zero.
    pub fn at_most(period: f64, step: f64) -> Self {
        Self { period, substeps: (period / step).ceil().max(1.0) as usize }
    }

    /// Length of a step, s.
    #[inline]
    pub fn step(&self) -> f64 {
        self.period / self.substeps as f64
    }
}
