//! What a table holds that no mapping fits, for people.

use case_files::skeleton;
use pages::text_table::{TextTable, number};
use recordings::{ColumnContents, TableContents};

use crate::commands::listed;
use crate::console::heading;

pub(super) fn text((name, table): &(String, TableContents)) -> String {
    let mut out = TextTable::new(&["column", ">numbers", ">empty", ">other", ">min", ">max", "looks like"]);
    for column in &table.columns {
        let ends = column.range.map_or(["-".to_owned(), "-".to_owned()], |(least, most)| [least, most].map(number));
        let [least, most] = ends;
        out.row([
            column.name.clone(),
            column.numbers.to_string(),
            column.empty.to_string(),
            column.other.to_string(),
            least,
            most,
            looks_like(column),
        ]);
    }
    let size = format!("  {} rows, {} bytes, SHA-256 {}\n", table.rows, table.bytes, table.sha256);
    let inferred = listed("Inferred", &skeleton::inferred(table));
    format!("\n{}{}{size}{inferred}", heading(name), out.render())
}

fn looks_like(column: &ColumnContents) -> String {
    let time = column
        .time
        .map(|time| format!("a time: {} s at {} Hz, in {}", number(time.span_s), number(time.rate_hz), time.unit));
    let word = if column.numbers == 0 { "text" } else { "some text" };
    let text = column.example.as_ref().map(|example| format!("{word}: {example}"));
    [time, text].into_iter().flatten().collect::<Vec<_>>().join("; ")
}
