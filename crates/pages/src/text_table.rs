//! Tables of plain text, and how numbers are written in them.

/// A number with four digits that count, without an exponent where that is readable.
pub fn number(x: f64) -> String {
    let size = x.abs();
    if x == 0.0 {
        "0".to_owned()
    } else if (1e-4..1e5).contains(&size) {
        let decimals = (3 - size.log10().floor() as i32).clamp(0, 7) as usize;
        format!("{x:.decimals$}")
    } else {
        format!("{x:.2e}")
    }
}

/// A table with a line of names; columns are as wide as their widest cell.
#[derive(Debug)]
pub struct TextTable {
    right: Vec<bool>,
    rows: Vec<Vec<String>>,
}

impl TextTable {
    /// A table with these columns; a name that begins with `>` is aligned to the right.
    pub fn new(columns: &[&str]) -> Self {
        let names = columns.iter().map(|c| c.trim_start_matches('>').to_owned());
        Self { right: columns.iter().map(|c| c.starts_with('>')).collect(), rows: vec![names.collect()] }
    }

    /// Adds a row, one cell per column.
    pub fn row(&mut self, cells: impl IntoIterator<Item = String>) {
        self.rows.push(cells.into_iter().collect());
    }

    /// The table, indented by two.
    pub fn render(&self) -> String {
        let width = |c: usize| {
            let cells = self.rows.iter().filter_map(|r| r.get(c));
            cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
        };
        let widths: Vec<usize> = (0..self.right.len()).map(width).collect();
        let mut out = String::new();
        for row in &self.rows {
            let mut line = String::new();
            for ((cell, width), right) in row.iter().zip(&widths).zip(&self.right) {
                let pad = " ".repeat(width - cell.chars().count());
                let (before, after) = if *right { (pad.as_str(), "") } else { ("", pad.as_str()) };
                for part in ["  ", before, cell, after] {
                    line += part;
                }
            }
            out += line.trim_end();
            out += "\n";
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::{TextTable, number};

    #[test]
    fn numbers_keep_four_digits() {
        assert_eq!(number(0.012_345), "0.01235");
        assert_eq!(number(1234.5), "1234");
        assert_eq!(number(-2.0), "-2.000");
        assert_eq!(number(0.0), "0");
        assert_eq!(number(1.0e-7), "1.00e-7");
    }

    #[test]
    fn columns_line_up() {
        let mut t = TextTable::new(&["name", ">size"]);
        t.row(["µ".to_owned(), "12".to_owned()]);
        assert_eq!(t.render(), "  name  size\n  µ       12\n");
    }
}
