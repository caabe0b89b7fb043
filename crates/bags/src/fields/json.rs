//! Fields of a JSON message by the same paths as those of CDR.

use serde_json::Value;

use super::cell::Cell;
use super::path::{NAME_LISTS, Part, Path};

/// Reads a message into one cell per path; `None` when it is no JSON object or a field is no number.
pub(super) fn read(message: &[u8], paths: &[Path], cells: &mut [Cell]) -> Option<()> {
    let root = parse(message)?;
    for (path, cell) in paths.iter().zip(cells) {
        *cell = match find(&root, path) {
            Some(value) => number(value)?,
            None => Cell::Gap,
        };
    }
    Some(())
}

/// A message as JSON; `None` when it is no object, or too large: JSON takes many times its length in memory.
pub(super) fn parse(message: &[u8]) -> Option<Value> {
    /// Bytes.
    const LARGEST: usize = 4 << 20;
    let root: Value = (message.len() <= LARGEST).then(|| serde_json::from_slice(message).ok())??;
    root.is_object().then_some(root)
}

fn find<'v>(root: &'v Value, path: &[Part]) -> Option<&'v Value> {
    let (mut here, mut beside) = (root, root);
    for part in path {
        here = match part {
            Part::Field(name) => {
                beside = here;
                here.get(name)?
            }
            Part::Index(index) => here.get(index)?,
            Part::Name(name) => {
                let names = NAME_LISTS.iter().find_map(|list| beside.get(list)?.as_array())?;
                let mut found = names.iter().enumerate().filter(|(_, other)| other.as_str() == Some(name));
                let index = found.next()?.0;
                if found.next().is_some() {
                    return None;
                }
                here.get(index)?
            }
        };
    }
    Some(here)
}

/// A value as a cell: a number, true or false, seconds and nanoseconds; null is a gap.
pub(super) fn number(value: &Value) -> Option<Cell> {
    Some(match value {
        Value::Null => Cell::Gap,
        Value::Bool(yes) => Cell::Whole((*yes).into()),
        Value::Number(number) => {
            let whole = number.as_i64().map(i128::from).or_else(|| number.as_u64().map(i128::from));
            match whole {
                Some(whole) => Cell::Whole(whole),
                None => Cell::Real(number.as_f64()?),
            }
        }
        Value::Object(_) => {
            let ns = value.get("nanosec").or_else(|| value.get("nsec"))?.as_u64()?;
            Cell::Whole(i128::from(value.get("sec")?.as_i64()?) * 1_000_000_000 + i128::from(ns))
        }
        Value::String(_) | Value::Array(_) => return None,
    })
}
