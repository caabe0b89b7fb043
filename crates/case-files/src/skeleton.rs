//! The skeleton of a mapping for a table: what can be inferred is in it, what only somebody who knows the robot can say
//! is left open.

use recordings::{ColumnContents, Signal, TableContents, TableFormat, UnitBy};

const FIRST_LINES: [&str; 3] = [
    "# Skeleton by `lacuna check --write-mapping`: of a table nobody but you knows what a column means. For each column that",
    "# is a signal take the `#` away, put the signal's name in place of SIGNAL and its unit in place of UNIT; add sign = -1",
    "# where it counts the other way, and kind = \"set-point\" for what was asked for and not measured.",
];

/// What was inferred of how a table is written, in sentences.
pub fn inferred(table: &TableContents) -> Vec<String> {
    let mut out = Vec::new();
    if let TableFormat::Csv { delimiter, decimal_comma } = table.format {
        let decimal = if decimal_comma { "comma" } else { "point" };
        out.push(format!("fields stand between {}, numbers have a decimal {decimal}", named(delimiter)));
    }
    if table.headless {
        out.push("the first line is numbers: names of the columns are missing; write them above it".to_owned());
    }
    if let Some((column, time)) = table.time().and_then(|column| Some((column, column.time?))) {
        let by = match time.unit_by {
            UnitBy::Name => "as it says",
            UnitBy::Size => "as times since 1970 are so large",
            UnitBy::Nothing => "as most are; nothing says so",
        };
        out.push(format!("{} is the time: it rises; in {}, {by}", column.name, time.unit));
    } else {
        out.push("no column looks like a time: none rises from row to row".to_owned());
    }
    out
}

const fn named(delimiter: u8) -> &'static str {
    match delimiter {
        b',' => "commas",
        b';' => "semicolons",
        b'\t' => "tabs",
        _ => "bars",
    }
}

/// The skeleton for a file.
pub fn mapping(name: &str, file: &str, table: &TableContents) -> String {
    let known: Vec<String> = Signal::ALL.iter().map(|s| format!("{s} ({})", s.unit().symbol())).collect();
    let mut lines: Vec<String> = FIRST_LINES.map(str::to_owned).to_vec();
    lines.extend(wrapped("# Signals:", &known));
    lines.extend(inferred(table).iter().map(|sentence| format!("# Inferred: {sentence}")));
    let ending = file.rsplit_once('.').map_or("csv", |(_, ending)| ending);
    lines.push(format!("name = {}\n\n[[files]]\npattern = {}", quoted(name), quoted(&format!("*.{ending}"))));
    if let TableFormat::Csv { delimiter, decimal_comma } = table.format {
        lines.push(format!("delimiter = {}", quoted(&char::from(delimiter).to_string())));
        lines.extend(decimal_comma.then(|| "decimal = \",\"".to_owned()));
    }
    let time = table.time();
    lines.push(match time.and_then(|column| Some((column, column.time?))) {
        Some((column, time)) => format!("time = {{ column = {}, unit = \"{}\" }}", quoted(&column.name), time.unit),
        None => "# Rows per second, where no column is the time:\n# time = { rate_hz = RATE }".to_owned(),
    });
    lines.push("\n[files.signals]".to_owned());
    let is_time = |column: &ColumnContents| time.is_some_and(|time| time.name == column.name);
    lines.extend(table.columns.iter().filter(|column| column.numbers > 0 && !is_time(column)).map(line));
    lines.join("\n") + "\n"
}

/// A column as a comment to be completed.
fn line(column: &ColumnContents) -> String {
    let range = column.range.map_or(String::new(), |(least, most)| format!(", {least} to {most}"));
    // A name with an end of line in it would end the comment.
    let name = quoted(&column.name.replace(['\n', '\r'], " "));
    format!("# SIGNAL = {{ column = {name}, unit = \"UNIT\" }}  # {} numbers{range}", column.numbers)
}

/// A TOML string in one line.
fn quoted(text: &str) -> String {
    toml::Value::from(text).to_string()
}

/// Words in lines of comment.
fn wrapped(start: &str, words: &[String]) -> Vec<String> {
    /// Characters of a line.
    const WIDTH: usize = 118;
    let mut lines = vec![start.to_owned()];
    for (index, word) in words.iter().enumerate() {
        let comma = if index + 1 < words.len() { "," } else { "" };
        match lines.last_mut().filter(|line| line.len() + word.len() + comma.len() < WIDTH) {
            Some(line) => line.extend([" ", word, comma]),
            None => lines.push(format!("#   {word}{comma}")),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use recordings::{Mapping, table_contents};

    use super::mapping;

    #[test]
    fn a_skeleton_asks_for_signals_and_parses_once_they_are_there() {
        let text = "t_ms;w \"z\"\n0,0;1,5\n10,0;\n20,0;2,5\n";
        let table = table_contents("a.csv", &mut Cursor::new(text)).unwrap();
        let skeleton = mapping("mine", "x/a.csv", &table);
        let error = Mapping::parse("m.toml", &skeleton).unwrap_err().to_string();
        assert!(error.contains("has no signal; give at least one"), "{error}\n{skeleton}");
        let done = skeleton.replace("# SIGNAL", "gyro_z").replace("UNIT\" }", "deg/s\" }");
        let parsed = Mapping::parse("m.toml", &done).unwrap_or_else(|e| panic!("{e}\n{done}"));
        let file = &parsed.files[0];
        assert_eq!((file.pattern.as_str(), file.delimiter, file.decimal_comma), ("*.csv", b';', true));
        assert_eq!((file.time.column.as_deref(), file.time.ns_per_unit), (Some("t_ms"), 1_000_000));
        assert_eq!(file.columns[0].column, "w \"z\"");
    }
}
