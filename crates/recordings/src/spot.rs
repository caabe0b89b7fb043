//! A place in a text that somebody has written: mappings, robot files.

use std::fmt;

/// A place in a text file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Spot {
    /// The file, or the name of what is built in.
    pub file: String,
    /// Line and column, from 1, where they are known; columns count characters.
    pub at: Option<(u32, u32)>,
}

impl Spot {
    /// A file of which no place is known.
    pub fn file(file: &str) -> Self {
        Self { file: file.to_owned(), at: None }
    }

    /// The place of a byte of a file's text.
    ///
    /// ```
    /// let spot = recordings::Spot::of_byte("map.toml", "a = 1\nb = 2\n", 8);
    /// assert_eq!(spot.to_string(), "map.toml: line 2, column 3");
    /// ```
    pub fn of_byte(file: &str, text: &str, byte: usize) -> Self {
        let (mut line, mut column) = (1, 1);
        for (_, character) in text.char_indices().take_while(|(start, _)| *start < byte) {
            (line, column) = if character == '\n' { (line + 1, 1) } else { (line, column + 1) };
        }
        Self { file: file.to_owned(), at: Some((line, column)) }
    }
}

impl fmt::Display for Spot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.at {
            Some((line, column)) => write!(f, "{}: line {line}, column {column}", self.file),
            None => f.write_str(&self.file),
        }
    }
}
