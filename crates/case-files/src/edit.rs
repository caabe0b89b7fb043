//! Numbers in the owner's TOML: comments and order stay.

use anyhow::{Context, Result};
use toml_edit::{DocumentMut, Item, TableLike, Value, value};

/// Decimal digits of a number in a file: more than any fit gives.
const DIGITS: usize = 9;

/// A document of a robot file.
pub(crate) fn document(name: &str, text: &str) -> Result<DocumentMut> {
    text.parse().with_context(|| format!("robot file '{name}' is no TOML"))
}

/// A number as it is written.
pub(crate) fn rounded(x: f64) -> f64 {
    let near: f64 = format!("{x:.*e}", DIGITS - 1).parse().unwrap_or(x);
    // No minus before a zero.
    if near == 0.0 { 0.0 } else { near }
}

/// Sets a key; comments that stand behind its value stay.
pub(crate) fn set(table: &mut dyn TableLike, key: &str, new: impl Into<Value>) {
    if let Some(old) = table.get_mut(key).and_then(Item::as_value_mut) {
        let decor = old.decor().clone();
        *old = new.into();
        *old.decor_mut() = decor;
    } else {
        table.insert(key, value(new));
    }
}

/// Says in the key `source` what changed, before what the owner says there.
pub(crate) fn set_source(table: &mut dyn TableLike, change: &str) {
    let before = table.get("source").and_then(Item::as_str).map(|old| format!("; {old}")).unwrap_or_default();
    set(table, "source", format!("{change}{before}"));
}

/// The tables of an array, however it is written.
pub(crate) fn tables(item: &mut Item) -> Vec<&mut dyn TableLike> {
    match item {
        Item::ArrayOfTables(rows) => rows.iter_mut().map(|row| row as &mut dyn TableLike).collect(),
        Item::Value(Value::Array(rows)) => {
            let inline = rows.iter_mut().filter_map(Value::as_inline_table_mut);
            inline.map(|row| row as &mut dyn TableLike).collect()
        }
        _ => Vec::new(),
    }
}

/// A sentence without line breaks, as a comment can hold it.
pub(crate) fn one_line(sentence: &str) -> String {
    sentence.replace(['\n', '\r'], " ")
}
