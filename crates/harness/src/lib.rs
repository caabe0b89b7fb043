#![doc = include_str!("../README.md")]
//!
//! # How a command is started
//!
//! ```text
//! cargo xtask COMMAND ── xtask (light) ──┬─ reproduce, learn, compare, growth, instructions, cold
//!                                        └─ proof, book, ...: packages of their own, started by cargo
//! ```

use std::process::ExitCode;

pub mod binary;
pub mod child;
pub mod commands;
pub mod commit;
pub mod document;
pub mod output;
pub mod stale;

/// How a command tells the shell what came of it: 0 for what is met, 1 for what is missed and for an error, which it
/// prints.
pub fn exit_code(outcome: anyhow::Result<bool>) -> ExitCode {
    match outcome {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}
