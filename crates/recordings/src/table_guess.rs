//! How a CSV file is written: its delimiter and decimal sign, guessed by its first lines.

use crate::cell;

/// What may stand between fields; earlier ones win where lines say nothing else.
const DELIMITERS: [u8; 4] = [b',', b';', b'\t', b'|'];
/// Lines looked at.
const LINES: usize = 200;

/// Delimiter, and true for a decimal comma. The last line counts only where the file `is_whole`.
pub(crate) fn written(header: &str, body: &[u8], is_whole: bool) -> (u8, bool) {
    let mut lines: Vec<&[u8]> = body.split(|byte| b"\r\n".contains(byte)).collect();
    if !is_whole {
        lines.pop();
    }
    lines.retain(|line| !line.trim_ascii().is_empty());
    lines.truncate(LINES);
    let fields = |line: &[u8], delimiter: u8| line.split(|&byte| byte == delimiter).count();
    // The one that splits most lines as it splits the header; of equals the one that splits into more fields.
    let score = |&delimiter: &u8| {
        let width = fields(header.as_bytes(), delimiter);
        let alike = lines.iter().filter(|line| fields(line, delimiter) == width).count();
        (width > 1, alike, width)
    };
    let best = DELIMITERS.iter().rev().max_by_key(|&delimiter| score(delimiter)).copied().unwrap_or(b',');
    let delimiter = if score(&best).0 { best } else { b',' };
    (delimiter, delimiter != b',' && has_comma(&lines, delimiter))
}

/// True when more cells are numbers with a decimal comma than with a point.
fn has_comma(lines: &[&[u8]], delimiter: u8) -> bool {
    let cells = || lines.iter().flat_map(|line| line.split(move |&byte| byte == delimiter));
    let number = |cell: &[u8], comma| {
        let cell = cell::with_point(cell, comma).ok();
        cell.and_then(|cell| cell::number(&cell).ok().flatten()).is_some()
    };
    let with = |sign: u8| cells().filter(|cell| cell.contains(&sign) && number(cell, sign == b',')).count();
    with(b',') > with(b'.')
}

/// True when all names are numbers, so that the line with the names is missing.
pub(crate) fn is_headless(names: &[String], comma: bool) -> bool {
    let number = |name: &String| {
        let cell = cell::with_point(name.as_bytes(), comma).ok();
        cell.and_then(|cell| cell::number(&cell).ok().flatten()).is_some()
    };
    !names.is_empty() && names.iter().all(number)
}

#[cfg(test)]
mod tests {
    use super::written;

    #[test]
    fn delimiter_and_decimal_sign() {
        let of = |text: &str| {
            let (header, body) = text.split_once('\n').unwrap();
            written(header, body.as_bytes(), true)
        };
        assert_eq!(of("t,v\n0.1,2\n0.2,3\n"), (b',', false));
        assert_eq!(of("t;v\n0,1;2\n0,2;3,5\n"), (b';', true));
        assert_eq!(of("t;v\n0.1;2\n"), (b';', false));
        assert_eq!(of("t\tv\n0,1\t2,5\n"), (b'\t', true));
        // Commas in a name do not make it the delimiter.
        assert_eq!(of("t;speed, left;x\n0,1;2,5;1,0\n"), (b';', true));
        assert_eq!(of("one\n1\n2\n"), (b',', false));
        assert_eq!(of("t,v\n"), (b',', false));
    }
}
