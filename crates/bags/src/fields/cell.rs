//! What a path leads to.

/// What a field of a message, or a cell of a table, holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Cell {
    /// Nothing: the list is too short, the name is not in it, or the number is NaN, ROS's word for "not known".
    Gap,
    /// A number.
    Real(f64),
    /// A whole number, or a stamp in ns.
    Whole(i128),
}

impl Cell {
    /// A number as a cell; NaN is a gap.
    pub fn real(value: f64) -> Self {
        if value.is_nan() { Self::Gap } else { Self::Real(value) }
    }

    /// As a number, stamps in ns; `None` for a gap.
    pub fn number(self) -> Option<f64> {
        match self {
            Self::Gap => None,
            Self::Real(value) => Some(value),
            Self::Whole(value) => Some(value as f64),
        }
    }
}
