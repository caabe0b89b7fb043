//! One row, whatever it stands in: a line of text, a message, a row of Parquet.

use bags::Cell;

use crate::cell::{CellError, rounded_ns};

/// One row: cells by position.
pub(crate) trait Row {
    /// The number in a cell; `None` for an empty one.
    fn number(&self, position: usize) -> Result<Option<f64>, CellError>;
    /// The instant in a cell whose unit is `ns_per_unit` nanoseconds; `None` for an empty one.
    fn instant_ns(&self, position: usize, ns_per_unit: i64) -> Result<Option<i64>, CellError>;
    /// A cell as a message shows it.
    fn text(&self, position: usize) -> String;
    /// Where the row is, asked only for messages.
    fn place(&self) -> u64;
}

/// The number in a cell of a message or of Parquet.
pub(crate) fn number(cell: Cell) -> Result<Option<f64>, CellError> {
    let number = cell.number();
    if number.is_none_or(f64::is_finite) { Ok(number) } else { Err(CellError::NotFinite) }
}

/// The instant in such a cell, whose unit is `ns_per_unit` nanoseconds.
pub(crate) fn instant_ns(cell: Cell, ns_per_unit: i64) -> Result<Option<i64>, CellError> {
    let ns = match cell {
        Cell::Gap => return Ok(None),
        Cell::Real(value) => rounded_ns(value * ns_per_unit as f64),
        Cell::Whole(value) => value.checked_mul(i128::from(ns_per_unit)).and_then(|ns| i64::try_from(ns).ok()),
    };
    ns.map(Some).ok_or(CellError::NotFinite)
}

/// Text as a message shows it: its first characters, none that a terminal would obey.
pub(crate) fn shown(text: &str) -> String {
    /// Characters shown.
    const SHOWN: usize = 40;
    let mut shown: String = text.chars().take(SHOWN).flat_map(char::escape_debug).collect();
    if text.chars().count() > SHOWN {
        shown.push('…');
    }
    shown
}
