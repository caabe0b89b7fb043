//! Families of ways in which a diagnosis may fail: each a generated case with what must come out.
//!
//! Not here: the online identifier running beside the drive, which the identifier's own tests hold.

#[path = "../common/mod.rs"]
mod common;

mod clocks;
mod damage;
mod drives;
mod files;
mod model;
mod nothing;
mod places;
mod robot_file_only;
mod rules;
mod sensors;
mod simulators;
mod times;
mod two;
mod visits;
