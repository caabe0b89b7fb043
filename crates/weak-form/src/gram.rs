//! The Gram matrix of windows.

use crate::{Shape, WeakFormError};

/// `H = Σ_w g_w g_wᵀ` over windows `g_w` of C columns: symmetric, C × C, in the products of the signals' units.
#[derive(Debug, Clone, PartialEq)]
pub struct Gram {
    shape: Shape,
    /// Lower triangle, row by row.
    lower: Vec<f64>,
    windows: u64,
}

impl Gram {
    pub(crate) fn from_parts(shape: Shape, lower: Vec<f64>, windows: u64) -> Self {
        Self { shape, lower, windows }
    }

    /// What its windows are.
    pub fn shape(&self) -> Shape {
        self.shape
    }

    /// How many windows it holds.
    pub fn windows(&self) -> u64 {
        self.windows
    }

    /// The lower triangle, row by row: (0, 0), (1, 0), (1, 1), (2, 0), ...: `C (C + 1)/2` numbers.
    pub fn lower(&self) -> &[f64] {
        &self.lower
    }

    /// The number of a row and a column, in either order; `None` where there is none.
    pub fn at(&self, row: usize, column: usize) -> Option<f64> {
        let (i, j) = (row.max(column), row.min(column));
        self.lower.get(i * (i + 1) / 2 + j).copied()
    }

    /// `Σ_c H_cc`.
    pub fn trace(&self) -> f64 {
        (0..self.shape.columns()).filter_map(|c| self.at(c, c)).sum()
    }

    /// Adds the windows of another part of a recording, or of another recording.
    ///
    /// The bits of a sum depend on its order: add parts in a fixed one.
    ///
    /// # Errors
    /// A matrix of another shape.
    pub fn add(&mut self, other: &Self) -> Result<(), WeakFormError> {
        if self.shape != other.shape {
            return Err(WeakFormError::OtherShape { ours: self.shape, theirs: other.shape });
        }
        for (a, b) in self.lower.iter_mut().zip(&other.lower) {
            *a += b;
        }
        self.windows += other.windows;
        Ok(())
    }
}
