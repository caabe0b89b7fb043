//! Fields of messages by path: `angular_velocity.z`, `velocity[0]`, `velocity[wheel_left_joint]`, `header.stamp`.

mod cdr;
mod cell;
mod definitions;
mod field;
mod json;
mod names;
mod path;
mod plan;
mod reader;
mod run;
mod schema;
mod steps;
mod survey;

pub use cell::Cell;
pub use field::Field;
pub use path::{HEADER_STAMP, LOG_TIME};
pub use reader::{FieldError, FieldReader};
pub(crate) use survey::Survey;
