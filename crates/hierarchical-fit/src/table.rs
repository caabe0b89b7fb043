//! Columns of a drive by the names that a robot file gives them.

use std::collections::BTreeMap;

use crate::error::CaseError;

/// Columns of a drive by their names.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Table {
    /// Name of the drive in messages.
    pub drive: String,
    /// Names of all columns that the file has, in its order.
    pub names: Vec<String>,
    /// Columns that were read.
    pub columns: BTreeMap<String, Column>,
}

/// One column of a drive.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Column {
    /// Its cells; `None` of an empty one, NaN where the file says so.
    pub cells: Vec<Option<f64>>,
    /// First cell that holds no number: its row, from 1, and what it holds.
    pub unread: Option<(usize, String)>,
}

impl Table {
    /// Columns without empty cells, as a program has them; NaN where a value was not seen.
    pub fn new<'a>(drive: &str, columns: impl IntoIterator<Item = (&'a str, Vec<f64>)>) -> Self {
        let mut out = Self { drive: drive.to_owned(), ..Self::default() };
        for (name, values) in columns {
            out.names.push(name.to_owned());
            let cells = values.into_iter().map(Some).collect();
            out.columns.insert(name.to_owned(), Column { cells, unread: None });
        }
        out
    }

    /// A column that has to be there.
    ///
    /// # Errors
    /// Where it is not, or a cell of it holds no number.
    pub fn needed(&self, column: &str) -> Result<&[Option<f64>], CaseError> {
        let lacks = || {
            let there = self.names.join(", ");
            self.wrong(format!("no column '{column}'; it has {there}: correct [columns] of the robot file"))
        };
        self.optional(column)?.ok_or_else(lacks)
    }

    /// A column that has to be there and have no empty cell.
    ///
    /// # Errors
    /// As [`Table::needed`], and of an empty cell.
    pub fn filled(&self, column: &str) -> Result<Vec<f64>, CaseError> {
        let filled = |(row, cell): (usize, &Option<f64>)| {
            cell.ok_or_else(|| {
                let row = row + 1;
                self.wrong(format!("row {row}, column '{column}': the cell is empty; fill it, or cut the drive there"))
            })
        };
        self.needed(column)?.iter().enumerate().map(filled).collect()
    }

    /// A column that may be missing.
    ///
    /// # Errors
    /// Where a cell of it holds no number.
    pub fn optional(&self, column: &str) -> Result<Option<&[Option<f64>]>, CaseError> {
        let Some(read) = self.columns.get(column) else { return Ok(None) };
        match &read.unread {
            Some((row, text)) => Err(self.wrong(format!("row {row}, column '{column}': '{text}' is no number"))),
            None => Ok(Some(&read.cells)),
        }
    }

    /// Whether the file has a column.
    pub fn has(&self, column: &str) -> bool {
        self.columns.contains_key(column)
    }

    fn wrong(&self, what: String) -> CaseError {
        CaseError::Drive { drive: self.drive.clone(), what }
    }
}

/// Numbers of cells; NaN of an empty one.
pub fn or_nan(cells: &[Option<f64>]) -> Vec<f64> {
    cells.iter().map(|cell| cell.unwrap_or(f64::NAN)).collect()
}
