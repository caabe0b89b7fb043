#![doc = include_str!("../README.md")]

mod case;
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
mod measure;
mod motor;
mod outsider;
mod plant;
mod random;
mod robot;
mod robot_json;
mod run;
mod sensors;
mod set;
mod settings;
mod truth;
mod tyre;

pub use case::{Again, Case, DrawnCase};
pub use course::Course;
pub use drive::Manoeuvre;
pub use effect::EffectId;
pub use error::Error;
pub use free::error as free_run_error;
pub use outsider::Outsider;
pub use set::{Mix, Plan, set};
pub use settings::{Content, Place, RobotClass, Setting, Settings, Severity};
pub use truth::{EffectTruth, HeldoutTruth, RecordingTruth, Truth, sha256};
pub use tyre::TyreLaw;
