#![doc = include_str!("../README.md")]
//!
//! # Files
//!
//! * `case`, `set`, `wide`: one case from a seed, sets of cases with a given mix, and sets of robots,
//!   sensors and visits of every sort; `turns`: items in turn.
//! * `settings`: what a drawn case is to look like; `draw`: the robot, what it hides, its drives.
//! * `effect`, `hidden`, `outsider`, `events`: what can be hidden, and what must be answered by
//!   "unknown".
//! * `law`: laws of a grammar of their own, which the search for laws does not hold.
//! * `plant`, `tyre`, `contact`, `motor`, `integrate`: the true robot and its laws.
//! * `drive`, `course`, `run`, `sensors`: closed-loop drives and what sensors show of them.
//! * `robot`, `robot_json`: the robot as its user knows it.
//! * `free`, `measure`: how much a hidden effect matters, by free runs.
//! * `car`: cars with brush tyres, a servo and a motor, beside a pose.
//! * `command`: command-driven cases, with a controller, wheels and a ground of their own.
//! * `rolling`: wheel counts beside a pose or a gyro alone, of robots with two, three and four wheels, steered and omnidirectional.
//! * `speed`: speed-driven cases, with a law of steady torques, sensors and events of their own.
//! * `wheeled`: robots of any wheels under torque, with a controller, brush tyres and casters of their own.
//! * `csv`, `truth`: the files of a case, and what was hidden, for the scorer.
//! * `random`: random numbers fixed by a path of keys; `error`: what can go wrong.

pub mod car;
mod case;
mod casters;
pub mod command;
mod contact;
mod course;
mod csv;
mod draw;
mod drive;
mod effect;
mod error;
mod events;
mod free;
mod hidden;
mod integrate;
mod law;
mod measure;
mod motor;
mod outsider;
mod plant;
mod random;
mod robot;
mod robot_json;
pub mod rolling;
mod run;
mod sensors;
mod set;
mod settings;
pub mod speed;
mod truth;
mod turns;
mod tyre;
pub mod wheeled;
mod wide;

pub use case::{Again, Case, DrawnCase};
pub use course::Course;
pub use drive::Manoeuvre;
pub use effect::EffectId;
pub use error::Error;
pub use free::error as free_run_error;
pub use law::{Acting, LawKind, LawRow};
pub use outsider::Outsider;
pub use set::{Mix, Plan, set};
pub use settings::{Content, Place, RobotClass, Setting, Settings, Severity};
pub use truth::{EffectTruth, HeldoutTruth, RecordingTruth, Truth, sha256};
pub use tyre::TyreLaw;
pub use wide::wide;
