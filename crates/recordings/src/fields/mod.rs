//! Fields of messages by path: `angular_velocity.z`, `velocity[0]`, `velocity[wheel_left_joint]`, `header.stamp`.

mod cdr;
mod definitions;
mod json;
mod known;
mod list;
mod names;
mod path;
mod plan;
mod run;
mod schema;

use std::rc::Rc;

use crate::bag::Topic;
use crate::cell::{CellError, rounded_ns};
use crate::samples::Row;

pub use list::Field;
pub(crate) use list::Survey;
use path::{Path, parse};
use plan::Plan;

/// The column of a message's log time.
pub(crate) const LOG_TIME: &str = "log_time";

/// The stamp in a message's header, by its driver.
pub(crate) const HEADER_STAMP: &str = "header.stamp";

/// What a path led to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Cell {
    /// Nothing: the list is too short, the name is not in it, or the number is NaN, ROS's word for "not known".
    Gap,
    Real(f64),
    /// A whole number, or a stamp in ns.
    Whole(i128),
}

/// How the wanted fields of a topic's messages are found, worked out once.
pub(crate) struct Reader {
    way: Way,
    wanted: usize,
}

enum Way {
    Cdr(Plan),
    Json(Vec<Path>),
}

/// Why a topic or a field cannot be read.
pub(crate) enum Trouble {
    /// The topic as a whole.
    Topic(String),
    /// This one of the fields.
    Field(usize, String),
}

impl Reader {
    /// A reader of these fields of a topic.
    pub(crate) fn new(topic: &Topic, fields: &[&str]) -> Result<Self, Trouble> {
        let mut paths = Vec::new();
        for (index, field) in fields.iter().enumerate() {
            paths.push(parse(field).map_err(|message| Trouble::Field(index, message))?);
        }
        let way = match topic.encoding.as_str() {
            "json" => Way::Json(paths),
            "cdr" => Way::Cdr(Plan::new(&Rc::new(schema::of(topic).map_err(Trouble::Topic)?), &paths)?),
            other => {
                return Err(Trouble::Topic(format!("messages are encoded as `{other}`; only cdr and json are read")));
            }
        };
        Ok(Self { way, wanted: fields.len() })
    }

    /// The fields of one message; `None` when it does not decode.
    pub(crate) fn read(&self, message: &[u8]) -> Option<Vec<Cell>> {
        let mut cells = Vec::new();
        self.read_into(message, &mut cells)?;
        Some(cells)
    }

    /// The fields of one message in the place of what is in `cells`; `None` when it does not decode.
    pub(crate) fn read_into(&self, message: &[u8], cells: &mut Vec<Cell>) -> Option<()> {
        let message = crate::bag::payload(message)?;
        cells.clear();
        cells.resize(self.wanted, Cell::Gap);
        match &self.way {
            Way::Cdr(plan) => plan.read(&message, cells).ok(),
            Way::Json(paths) => json::read(&message, paths, cells),
        }
    }
}

/// Reads numeric fields of a topic's messages by their paths, as a mapping's `column` names them.
///
/// ```
/// use recordings::{FieldReader, Topic};
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
/// assert_eq!(reader.read(&message), Some(vec![Some(1.5)]));
/// assert_eq!(reader.read(&message[..10]), None);
/// ```
pub struct FieldReader(Reader);

impl FieldReader {
    /// A reader of these fields.
    ///
    /// # Errors
    /// A sentence that says why the topic cannot be decoded, or which field it does not have.
    pub fn new(topic: &Topic, fields: &[&str]) -> Result<Self, String> {
        Reader::new(topic, fields).map(Self).map_err(|trouble| match trouble {
            Trouble::Topic(message) => message,
            Trouble::Field(index, message) => format!("`{}`: {message}", fields[index]),
        })
    }

    /// The fields of a message as numbers, stamps in ns; `None` inside for what is not there or NaN, `None` as a whole
    /// when the message does not decode.
    pub fn read(&self, message: &[u8]) -> Option<Vec<Option<f64>>> {
        let number = |cell| match cell {
            Cell::Gap => None,
            Cell::Real(value) => Some(value),
            Cell::Whole(value) => Some(value as f64),
        };
        Some(self.0.read(message)?.into_iter().map(number).collect())
    }

    /// The same for whole numbers and stamps, exactly: ns.
    pub fn read_whole(&self, message: &[u8]) -> Option<Vec<Option<i64>>> {
        Some(self.0.read(message)?.into_iter().map(|cell| cell.instant_ns(1).ok().flatten()).collect())
    }
}

impl std::fmt::Debug for FieldReader {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("FieldReader").field("fields", &self.0.wanted).finish_non_exhaustive()
    }
}

/// One message as a row: its fields in the order in which they were asked for.
pub(crate) struct MessageRow<'a> {
    pub(crate) cells: &'a [Cell],
    /// Number of the message in its topic, from 1.
    pub(crate) number: u64,
}

impl Row for MessageRow<'_> {
    fn number(&self, position: usize) -> Result<Option<f64>, CellError> {
        self.cells[position].number()
    }

    fn instant_ns(&self, position: usize, ns_per_unit: i64) -> Result<Option<i64>, CellError> {
        self.cells[position].instant_ns(ns_per_unit)
    }

    fn text(&self, position: usize) -> String {
        match self.cells[position] {
            Cell::Gap => String::new(),
            Cell::Real(value) => value.to_string(),
            Cell::Whole(value) => value.to_string(),
        }
    }

    fn place(&self) -> u64 {
        self.number
    }
}

impl Cell {
    /// A number as a cell; NaN is a gap.
    pub(crate) fn real(value: f64) -> Self {
        if value.is_nan() { Self::Gap } else { Self::Real(value) }
    }

    pub(crate) fn number(self) -> Result<Option<f64>, CellError> {
        match self {
            Self::Gap => Ok(None),
            Self::Real(value) if value.is_finite() => Ok(Some(value)),
            Self::Real(_) => Err(CellError::NotFinite),
            Self::Whole(value) => Ok(Some(value as f64)),
        }
    }

    pub(crate) fn instant_ns(self, ns_per_unit: i64) -> Result<Option<i64>, CellError> {
        let whole = |value: i128| value.checked_mul(i128::from(ns_per_unit)).and_then(|ns| i64::try_from(ns).ok());
        match self {
            Self::Gap => Ok(None),
            Self::Real(value) => rounded_ns(value * ns_per_unit as f64).map(Some).ok_or(CellError::NotFinite),
            Self::Whole(value) => whole(value).map(Some).ok_or(CellError::NotFinite),
        }
    }
}
