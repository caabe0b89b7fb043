//! How many signals there are, and what a window is.

use std::ops::Range;

use crate::WeakFormError;
use crate::settings::{Limits, SETTINGS};

const LIMITS: Limits = SETTINGS.limits;

/// How many signals there are, and what a window is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shape {
    signals: usize,
    width: usize,
    stride: usize,
    exponent: u32,
}

impl Shape {
    /// `signals` numbers in a row, windows of `width` rows every `stride` rows, weighted by `(1 − s²)^exponent`.
    ///
    /// # Errors
    /// A number out of its range: 1 to 100 signals, 1 to 1 048 576 rows, exponents up to 64.
    pub fn new(signals: usize, width: usize, stride: usize, exponent: u32) -> Result<Self, WeakFormError> {
        for (what, value, least, most) in [
            ("a number of signals", signals, 1, LIMITS.signals),
            ("a width, rows,", width, 1, LIMITS.rows),
            ("a stride, rows,", stride, 1, LIMITS.rows),
            ("an exponent", exponent as usize, 0, LIMITS.exponent),
        ] {
            if !(least..=most).contains(&value) {
                return Err(WeakFormError::OutOfRange { what, value, least, most });
            }
        }
        Ok(Self { signals, width, stride, exponent })
    }

    /// Numbers in a row.
    pub fn signals(&self) -> usize {
        self.signals
    }

    /// Rows in a window.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows from one window's first to the next one's.
    pub fn stride(&self) -> usize {
        self.stride
    }

    /// Exponent of the bump.
    pub fn exponent(&self) -> u32 {
        self.exponent
    }

    /// Columns: the signals, then their products `z_i z_j` with `i ≤ j` in the order (0, 0), (0, 1), ..., (1, 1), ...
    pub fn columns(&self) -> usize {
        self.signals + self.signals * (self.signals + 1) / 2
    }

    /// Signals whose product a column is: one or two; `None` where there is no such column.
    pub fn factors(&self, column: usize) -> Option<(usize, Option<usize>)> {
        if column < self.signals {
            return Some((column, None));
        }
        let mut rest = column - self.signals;
        for i in 0..self.signals {
            let products = self.signals - i;
            if rest < products {
                return Some((i, Some(i + rest)));
            }
            rest -= products;
        }
        None
    }

    /// The column of the product of two signals, in either order; `None` where there is no such signal.
    pub fn product(&self, i: usize, j: usize) -> Option<usize> {
        let (i, j) = (i.min(j), i.max(j));
        // Before row i of the triangle stand rows of S, S − 1, ... products.
        (j < self.signals).then(|| self.signals + i * self.signals - i * i.saturating_sub(1) / 2 + j - i)
    }

    /// The same columns, checked.
    ///
    /// # Errors
    /// The first one that does not exist.
    pub fn columns_of(&self, columns: &[usize]) -> Result<Vec<usize>, WeakFormError> {
        let all = self.columns();
        match columns.iter().find(|c| **c >= all) {
            Some(&column) => Err(WeakFormError::NoSuchColumn { column, columns: all }),
            None => Ok(columns.to_vec()),
        }
    }

    /// Weights of a window's rows, `φ_k = (1 − s_k²)^p` with `s_k = (2k − W + 1)/(W + 1)`, without unit.
    pub fn weights(&self) -> Vec<f64> {
        let (width, middle) = (self.width as f64, (self.width - 1) as f64);
        let place = |k: usize| (2.0 * k as f64 - middle) / (width + 1.0);
        // By multiplications alone: the same bits on every machine.
        (0..self.width).map(|k| (0..self.exponent).fold(1.0, |w, _| w * (1.0 - place(k) * place(k)))).collect()
    }

    /// Windows that `rows` rows hold whole.
    pub fn windows_in(&self, rows: u64) -> u64 {
        let (width, stride) = (self.width as u64, self.stride as u64);
        if rows < width { 0 } else { (rows - width) / stride + 1 }
    }

    /// Rows that the windows `windows` of a recording need, counted from its first row.
    ///
    /// To work on parts of a recording side by side, divide its windows `0..windows_in(rows)` into ranges, push the rows of
    /// each range into a [`WeakForm`](crate::WeakForm) of its own and add the [`Gram`](crate::Gram)s: neighbours share
    /// `width − stride` rows, and every window is counted once.
    pub fn rows_of_windows(&self, windows: Range<u64>) -> Range<u64> {
        let (width, stride) = (self.width as u64, self.stride as u64);
        let from = windows.start * stride;
        if windows.is_empty() { from..from } else { from..(windows.end - 1) * stride + width }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_and_their_factors_belong_together() {
        for signals in [1, 2, 5, 13] {
            let shape = Shape::new(signals, 7, 3, 2).expect("a shape");
            for column in 0..shape.columns() {
                match shape.factors(column).expect("a column") {
                    (i, None) => assert_eq!(i, column),
                    (i, Some(j)) => {
                        assert!(i <= j);
                        assert_eq!((shape.product(i, j), shape.product(j, i)), (Some(column), Some(column)));
                    }
                }
            }
            assert_eq!(shape.factors(shape.columns()), None);
            assert_eq!(shape.product(0, signals), None);
        }
        assert_eq!(Shape::new(13, 49, 12, 4).expect("a shape").columns(), 104);
    }

    #[test]
    fn weights_are_even_and_vanish_one_row_outside() {
        let weights = Shape::new(1, 49, 12, 4).expect("a shape").weights();
        assert_eq!(weights[24], 1.0);
        let square = (24.0_f64 / 25.0).powi(2);
        approx::assert_relative_eq!(weights[0], (1.0 - square).powi(4), epsilon = 1e-18);
        for k in 0..49 {
            assert_eq!(weights[k], weights[48 - k]);
        }
    }

    #[test]
    fn windows_and_rows_agree() {
        let shape = Shape::new(1, 49, 12, 4).expect("a shape");
        assert_eq!([48, 49, 60, 61, 12000].map(|n| shape.windows_in(n)), [0, 1, 1, 2, 996]);
        assert_eq!(shape.rows_of_windows(0..996), 0..11989);
        assert_eq!(shape.rows_of_windows(10..12), 120..181);
        assert_eq!(shape.rows_of_windows(3..3), 36..36);
    }

    #[test]
    fn numbers_out_of_range_are_refused_with_their_range() {
        let error = Shape::new(13, 0, 12, 4).expect_err("no width");
        assert_eq!(error.to_string(), "a weak form takes a width, rows, from 1 to 1048576, but got 0; correct it");
        assert!(Shape::new(101, 49, 12, 4).is_err() && Shape::new(13, 49, 0, 4).is_err());
        assert!(Shape::new(13, 49, 12, 65).is_err());
    }
}
