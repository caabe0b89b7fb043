//! Robots as files, and drives as tables: text in, a robot and its drives out.
//!
//! ```toml
//! name = "my robot"
//! kind = "odometry"
//!
//! [[wheel]]
//! name = "left"
//! place = [0.0, 0.1]          # x forward, y left, m
//! radius = 0.042              # m
//! radius_sigma = 0.0005       # m, how well it is known
//! counts_per_turn = 2796.8    # gear and edges included
//! column = "tick_left"
//! source = "data sheet; tape measure"
//!
//! [columns]
//! time = "time_s"
//! wheels = "counts"           # counts since the row before, counter, angle (rad) or speed (rad/s)
//! x = "x_m"
//! y = "y_m"
//! yaw = "yaw_rad"
//! ```

mod robot;
mod series;
mod table;

pub use hierarchical_fit::{Column, Table};
pub use robot::{BUILT_IN, Columns, RobotFile, is_of_kind, seconds_in};
pub use series::{Series, Signals};
