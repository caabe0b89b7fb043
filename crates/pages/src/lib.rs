#![doc = include_str!("../README.md")]

pub mod chart;
pub mod escape;
pub mod figure;
pub mod page;
pub mod reproduction;
mod role;
mod shell;
mod table;
pub mod text_table;
pub mod thin;
