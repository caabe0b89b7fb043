//! What a table holds that no mapping fits.

use std::fs::File;
use std::path::PathBuf;

use anyhow::{Context, Result};
use recordings::{ColumnContents, Format, RecordingError, TableContents, TableFormat, table_contents};
use serde_json::{Value, json};

use crate::{inputs, skeleton};

/// The tables among files and in folders, and what is inside.
pub(super) fn look(paths: &[PathBuf]) -> Result<Vec<(String, TableContents)>> {
    let mut files = Vec::new();
    for path in paths {
        if path.is_dir() {
            files.extend(inputs::list(path)?.into_iter().filter(|file| file.is_file()));
        } else {
            files.push(path.clone());
        }
    }
    let names = files.iter().map(|file| file.display().to_string());
    let tables = names.filter(|name| Format::of_name(name).is_some_and(|format| !format.is_bag()));
    let inside = |name: String| {
        let mut file = File::open(&name).with_context(|| format!("cannot read '{name}'"))?;
        let contents = table_contents(&name, &mut file)?;
        Ok((name, contents))
    };
    tables.map(inside).collect()
}

/// Whether a mapping is another table's, rather than the right one for a table that is broken.
pub(super) fn is_another_ones(error: &anyhow::Error) -> bool {
    use RecordingError::{MissingColumn, MissingTopic, NoSamples, NoSignals, UnmatchedFile};
    error.downcast_ref::<RecordingError>().is_none_or(|error| {
        matches!(
            error,
            MissingColumn { .. } | MissingTopic { .. } | NoSamples { .. } | NoSignals { .. } | UnmatchedFile { .. }
        )
    })
}

/// Rows that could not be counted.
pub(super) fn lost((name, table): &(String, TableContents)) -> Option<String> {
    let rows = if table.misfits == 1 { "row has" } else { "rows have" };
    (table.misfits > 0).then(|| format!("{name}: {} {rows} not as many fields as the header", table.misfits))
}

pub(super) fn as_json((name, table): &(String, TableContents)) -> Value {
    let column = |c: &ColumnContents| {
        json!({
            "name": c.name, "numbers": c.numbers, "empty": c.empty, "other": c.other, "first_other": c.example,
            "min": c.range.map(|(least, _)| least), "max": c.range.map(|(_, most)| most),
            "time": c.time.map(|t| json!({
                "span_s": t.span_s, "rate_hz": t.rate_hz, "unit": t.unit, "unit_by": format!("{:?}", t.unit_by),
            })),
        })
    };
    let (delimiter, decimal) = match table.format {
        TableFormat::Csv { delimiter, decimal_comma } => {
            (Some(char::from(delimiter).to_string()), Some(if decimal_comma { "," } else { "." }))
        }
        TableFormat::Parquet => (None, None),
    };
    json!({
        "file": name, "bytes": table.bytes, "sha256": table.sha256, "delimiter": delimiter, "decimal": decimal,
        "header": !table.headless, "rows": table.rows, "misfits": table.misfits,
        "columns": table.columns.iter().map(column).collect::<Vec<_>>(), "inferred": skeleton::inferred(table),
    })
}
