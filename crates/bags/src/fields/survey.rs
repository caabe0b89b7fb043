//! Which numeric fields a topic's messages have: the columns that a mapping can name.

use std::collections::HashSet;

use re_cdr::{ByteOrder, CdrReader};
use serde_json::Value;

use super::cdr::{self, Undecodable, Walk};
use super::field::{Field, MOST_TOLD, add};
use super::known::Known;
use super::path::{HEADER_STAMP, MOST_NAMES, NAME_LISTS};
use super::schema::{self, Layout, Type};
use crate::source::payload;
use crate::topic::Topic;

/// Looks at messages of a topic and remembers what fields there are.
pub(crate) struct Survey {
    way: Result<Way, String>,
    fields: Vec<Field>,
    /// Messages that did not decode.
    pub(crate) undecodable: u64,
}

enum Way {
    /// No message was walked to its end yet.
    Cdr(Layout),
    /// One was, so that all fields are known.
    Known(Known),
    Json(HashSet<String>),
}

impl Survey {
    /// A survey of a topic.
    pub(crate) fn new(topic: &Topic) -> Self {
        let way = match topic.encoding.as_str() {
            "json" => Ok(Way::Json(HashSet::new())),
            "cdr" => schema::of(topic).map(Way::Cdr),
            other => Err(format!("messages are encoded as `{other}`; only cdr and json are read")),
        };
        Self { way, fields: Vec::new(), undecodable: 0 }
    }

    /// Looks at a message; the stamp of its header in ns, where it is one of CDR that has one.
    pub(crate) fn look(&mut self, message: &[u8]) -> Option<i128> {
        let Ok(way) = &mut self.way else { return None };
        let looked = payload(message).and_then(|message| match way {
            Way::Known(known) => known.look(&message, &mut self.fields).ok(),
            Way::Cdr(layout) => {
                let mut looking = Looking { layout, next: 0, steps: 0, stamp: None, fields: &mut self.fields };
                cdr::walk(&message, &mut looking).ok()?;
                let stamp = looking.stamp;
                *way = Way::Known(Known::new(layout));
                Some(stamp)
            }
            Way::Json(known) => {
                let root = super::json::parse(&message)?;
                look_at_json(&root, "", &root, known, &mut self.fields);
                Some(None)
            }
        });
        self.undecodable += u64::from(looked.is_none());
        looked?
    }

    /// The fields, or why the topic cannot be read.
    pub(crate) fn finish(self) -> Result<Vec<Field>, String> {
        self.way.map(|_| self.fields)
    }
}

/// A walk that meets the numeric fields in the same order in each message.
struct Looking<'a> {
    layout: &'a Layout,
    /// Which field comes next.
    next: usize,
    /// Fields of items looked at: messages within messages may be told without end.
    steps: usize,
    /// The header's stamp in ns.
    stamp: Option<i128>,
    fields: &'a mut Vec<Field>,
}

impl Walk for Looking<'_> {
    fn walk<B: ByteOrder>(&mut self, reader: &mut CdrReader<'_, B>) -> Result<(), Undecodable> {
        let layout = self.layout;
        self.message(reader, layout, &mut String::new())
    }
}

impl Looking<'_> {
    fn message<B: ByteOrder>(
        &mut self,
        reader: &mut CdrReader<'_, B>,
        layout: &Layout,
        path: &mut String,
    ) -> Result<(), Undecodable> {
        let names_at = layout.names();
        let mut names: Vec<String> = Vec::new();
        let outer = path.len();
        for (index, (name, ty)) in layout.fields.iter().enumerate() {
            if outer > 0 {
                path.push('.');
            }
            path.push_str(name);
            match ty {
                Type::Number(_) => {
                    cdr::skip(reader, ty)?;
                    self.found(path, None, &[]);
                }
                Type::Message(inner) if inner.is_stamp() => {
                    let (seconds, ns) = cdr::stamp(reader)?;
                    if path == HEADER_STAMP {
                        self.stamp = Some(seconds * 1_000_000_000 + ns);
                    }
                    self.found(path, None, &[]);
                }
                Type::Message(inner) => self.message(reader, inner, path)?,
                Type::List { of, size } => {
                    let count = cdr::length(reader, *size, of)?;
                    if names_at == Some(index) && count <= MOST_NAMES {
                        names = (0..count)
                            .map(|_| Ok(reader.read_str()?.to_owned()))
                            .collect::<Result<_, Undecodable>>()?;
                    } else {
                        cdr::skip_items(reader, of, count)?;
                        let named = if names.len() == count { names.as_slice() } else { &[] };
                        self.list(path, of, count, named);
                    }
                }
                Type::Text | Type::WideText => cdr::skip(reader, ty)?,
            }
            path.truncate(outer);
        }
        Ok(())
    }

    /// A list of numbers, or the numeric fields of a list of messages; lists within lists are left out.
    fn list(&mut self, path: &mut String, of: &Type, count: usize, names: &[String]) {
        match of {
            Type::Number(_) => self.found(path, Some(count), names),
            Type::Message(layout) => {
                let outer = path.len();
                path.push_str("[]");
                self.items(layout, path, count, names);
                path.truncate(outer);
            }
            Type::Text | Type::WideText | Type::List { .. } => {}
        }
    }

    fn items(&mut self, layout: &Layout, path: &mut String, count: usize, names: &[String]) {
        let outer = path.len();
        for (name, ty) in &layout.fields {
            self.steps += 1;
            if self.steps > MOST_TOLD {
                break;
            }
            path.push('.');
            path.push_str(name);
            match ty {
                Type::Number(_) => self.found(path, Some(count), names),
                Type::Message(inner) if inner.is_stamp() => self.found(path, Some(count), names),
                Type::Message(inner) => self.items(inner, path, count, names),
                Type::Text | Type::WideText | Type::List { .. } => {}
            }
            path.truncate(outer);
        }
    }

    fn found(&mut self, path: &str, length: Option<usize>, names: &[String]) {
        if self.next >= MOST_TOLD {
            return;
        }
        if self.next == self.fields.len() {
            self.fields.push(Field { path: path.to_owned(), lengths: length.map(|n| (n, n)), names: Vec::new() });
        }
        add(&mut self.fields[self.next], length, names);
        self.next += 1;
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
