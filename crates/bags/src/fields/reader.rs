//! Reading of fields by their paths.

use std::rc::Rc;

use super::cell::Cell;
use super::path::{Path, parse};
use super::plan::{Complaint, Plan};
use super::{json, schema};
use crate::source::payload;
use crate::topic::Topic;

/// Why a topic or one of its fields cannot be read.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum FieldError {
    /// The topic as a whole.
    #[error("{0}")]
    Topic(String),
    /// One of the fields that were asked for.
    #[error("`{field}`: {message}")]
    #[allow(missing_docs)] // the sentence is the documentation
    Field { index: usize, field: String, message: String },
}

/// Reads numeric fields of a topic's messages by their paths, as a mapping's `column` names them.
///
/// ```
/// use bags::{Cell, FieldReader, Topic};
/// let topic = Topic {
///     name: "/wheel".to_owned(),
///     message_type: "std_msgs/msg/Float64".to_owned(),
///     encoding: "cdr".to_owned(),
///     schema_encoding: String::new(),
///     schema: [].into(), // this one is built in
///     metadata: Default::default(),
/// };
/// let reader = FieldReader::new(&topic, &["data"]).unwrap();
/// let message = [0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0xF8, 0x3F];
/// assert_eq!(reader.read(&message), Some(vec![Cell::Real(1.5)]));
/// assert_eq!(reader.read(&message[..10]), None);
/// ```
#[derive(Debug)]
pub struct FieldReader {
    way: Way,
    wanted: usize,
}

/// How the fields are found, worked out once for a topic.
#[derive(Debug)]
enum Way {
    Cdr(Plan),
    Json(Vec<Path>),
}

impl FieldReader {
    /// A reader of these fields.
    ///
    /// # Errors
    /// When the topic cannot be decoded or does not have one of the fields.
    pub fn new(topic: &Topic, fields: &[&str]) -> Result<Self, FieldError> {
        let bad_field = |Complaint(index, message)| {
            let field = fields.get(index).map_or_else(String::new, |&field| field.to_owned());
            FieldError::Field { index, field, message }
        };
        let path = |(index, field): (usize, &&str)| parse(field).map_err(|message| Complaint(index, message));
        let paths: Vec<Path> = fields.iter().enumerate().map(path).collect::<Result<_, _>>().map_err(bad_field)?;

        let way = match topic.encoding.as_str() {
            "json" => Way::Json(paths),
            "cdr" => {
                let layout = schema::of(topic).map_err(FieldError::Topic)?;
                // Nobody agrees on the bytes of wide text, and what stands behind it would be guessed.
                if let Some(field) = &layout.wide {
                    return Err(FieldError::Topic(format!("field `{field}` is a wstring, which is not read")));
                }
                Way::Cdr(Plan::new(&Rc::new(layout), &paths).map_err(bad_field)?)
            }
            other => {
                return Err(FieldError::Topic(format!(
                    "messages are encoded as `{other}`; only cdr and json are read"
                )));
            }
        };
        Ok(Self { way, wanted: fields.len() })
    }

    /// The fields of a message; `None` when it does not decode.
    pub fn read(&self, message: &[u8]) -> Option<Vec<Cell>> {
        let mut cells = Vec::new();
        self.read_into(message, &mut cells)?;
        Some(cells)
    }

    /// The fields of a message in the place of what is in `cells`; `None` when it does not decode.
    pub fn read_into(&self, message: &[u8], cells: &mut Vec<Cell>) -> Option<()> {
        let message = payload(message)?;
        cells.clear();
        cells.resize(self.wanted, Cell::Gap);
        match &self.way {
            Way::Cdr(plan) => plan.read(&message, cells).ok(),
            Way::Json(paths) => json::read(&message, paths, cells),
        }
    }
}
