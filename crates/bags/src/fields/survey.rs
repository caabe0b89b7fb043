//! Which numeric fields a topic's messages have: the columns that a mapping can name.

use std::collections::HashSet;

use serde_json::Value;

use super::field::{Field, MOST_TOLD, add};
use super::path::NAME_LISTS;
use super::schema;
use super::steps::Steps;
use crate::source::payload;
use crate::topic::Topic;

/// Looks at messages of a topic and remembers what fields there are.
pub(crate) struct Survey {
    way: Result<Way, String>,
    fields: Vec<Field>,
    /// Messages that decoded, and those that did not.
    decoded: u64,
    pub(crate) undecodable: u64,
}

enum Way {
    Cdr(Steps),
    Json(HashSet<String>),
}

impl Survey {
    /// A survey of a topic.
    pub(crate) fn new(topic: &Topic) -> Self {
        let way = match topic.encoding.as_str() {
            "json" => Ok((Way::Json(HashSet::new()), Vec::new())),
            "cdr" => schema::of(topic)
                .and_then(|layout| Steps::new(&layout))
                .map(|(steps, fields)| (Way::Cdr(steps), fields)),
            other => Err(format!("messages are encoded as `{other}`; only cdr and json are read")),
        };
        let (way, fields) = match way {
            Ok((way, fields)) => (Ok(way), fields),
            Err(message) => (Err(message), Vec::new()),
        };
        Self { way, fields, decoded: 0, undecodable: 0 }
    }

    /// Looks at a message; the stamp of its header in ns, where it is one of CDR that has one.
    pub(crate) fn look(&mut self, message: &[u8]) -> Option<i128> {
        let Ok(way) = &mut self.way else { return None };
        let looked = payload(message).and_then(|message| match way {
            Way::Cdr(steps) => steps.look(&message, &mut self.fields).ok(),
            Way::Json(known) => {
                let root = super::json::parse(&message)?;
                look_at_json(&root, "", &root, known, &mut self.fields);
                Some(None)
            }
        });
        self.decoded += u64::from(looked.is_some());
        self.undecodable += u64::from(looked.is_none());
        looked?
    }

    /// The fields, none where no message decoded, or why the topic cannot be read.
    pub(crate) fn finish(self) -> Result<Vec<Field>, String> {
        self.way.map(|_| if self.decoded > 0 { self.fields } else { Vec::new() })
    }
}

fn look_at_json(value: &Value, path: &str, beside: &Value, known: &mut HashSet<String>, fields: &mut Vec<Field>) {
    let mut found = |length: Option<usize>, names: &[String]| {
        if known.len() < MOST_TOLD && known.insert(path.to_owned()) {
            fields.push(Field { path: path.to_owned(), lengths: length.map(|n| (n, n)), names: Vec::new() });
        }
        if let Some(field) = fields.iter_mut().find(|field| field.path == path) {
            add(field, length, names);
        }
    };
    match value {
        Value::Number(_) | Value::Bool(_) => found(None, &[]),
        Value::Array(items) if items.iter().all(|item| item.is_number() || item.is_null()) => {
            let list = NAME_LISTS.iter().find_map(|list| beside.get(list)?.as_array());
            let names: Vec<String> =
                list.into_iter().flatten().filter_map(|name| name.as_str().map(str::to_owned)).collect();
            found(Some(items.len()), if names.len() == items.len() { &names } else { &[] });
        }
        Value::Object(_) if !path.is_empty() && super::json::number(value).is_some() => found(None, &[]),
        Value::Object(map) => {
            for (name, inner) in map {
                let inside = if path.is_empty() { name.clone() } else { format!("{path}.{name}") };
                look_at_json(inner, &inside, value, known, fields);
            }
        }
        Value::Null | Value::String(_) | Value::Array(_) => {}
    }
}
