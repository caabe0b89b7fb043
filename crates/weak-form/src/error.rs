//! Why there is no weak form.

/// Why there is no weak form, or no law in it.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WeakFormError {
    /// A number of a shape is out of its range.
    #[error("a weak form takes {what} from {least} to {most}, but got {value}; correct it")]
    OutOfRange {
        /// Which number.
        what: &'static str,
        /// Its value.
        value: usize,
        /// Least value.
        least: usize,
        /// Largest value.
        most: usize,
    },
    /// A portion is no whole number of rows.
    #[error("a portion has {numbers} numbers, which is no multiple of the {signals} signals of a row; push whole rows")]
    NotRows {
        /// Numbers there are.
        numbers: usize,
        /// Signals of a row.
        signals: usize,
    },
    /// There is no such column.
    #[error("there is no column {column}; there are {columns}, counted from 0")]
    NoSuchColumn {
        /// The column.
        column: usize,
        /// How many there are.
        columns: usize,
    },
    /// Two Gram matrices have different shapes.
    #[error("Gram matrices of {ours:?} and {theirs:?} cannot be added; make both with the same shape")]
    OtherShape {
        /// Shape of the one.
        ours: crate::Shape,
        /// Shape of the other.
        theirs: crate::Shape,
    },
    /// The penalty of a ridge regression is no number, or negative.
    #[error("the penalty of a ridge regression is {value}, but must be a finite number of 0 or more")]
    Penalty {
        /// Its value.
        value: f64,
    },
    /// The windows do not determine the coefficients.
    #[error(
        "{windows} windows do not determine the coefficients of {regressors} columns; record more, choose fewer columns or \
         give a penalty"
    )]
    NotDetermined {
        /// Windows there are.
        windows: u64,
        /// Columns that were to explain.
        regressors: usize,
    },
}
