//! Cars as files, and drives as tables: text in, a car and its drives out.

mod keys;
mod robot;
mod series;
mod table;

pub use hierarchical_fit::{Column, Table};
pub use robot::{BUILT_IN, Columns, RobotFile};
