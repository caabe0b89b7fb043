//! Parameters of ROS 2 controllers as YAML: the names and types of ros2_controllers 4.x, as released for ROS 2 Jazzy.
//!
//! It takes plain data, a geometry of wheels with its lengths as stated and as corrected, and knows no engine that
//! found them. From the bottom up: `geometry` (what is written), `covariance` (from errors of forecasts), `parameters`
//! (names of the controllers), `write` (one file).

mod covariance;
mod geometry;
mod parameters;
#[cfg(test)]
mod tests;
mod write;

pub use covariance::{Forecast, Scatter};
pub use geometry::{Geometry, Length, Side};
pub use write::{Controllers, NoYaml};
