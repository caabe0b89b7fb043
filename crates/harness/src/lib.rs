#![doc = include_str!("../README.md")]
//!
//! # How a command is started
//!
//! ```text
//! cargo xtask COMMAND ── xtask (light) ──┬─ reproduce, effect, mutants, browser
//!                                        └─ measuring, proof, book: packages of their own, started by cargo
//! ```
//!
//! # Feature
//!
//! `watch`: the examined program and its SHA-256 (`binary`), processes whose time and memory are measured (`child`). The
//! light program has no use for them, and reading `/proc` is ten crates.

use std::process::ExitCode;

#[cfg(feature = "watch")]
pub mod binary;
#[cfg(feature = "watch")]
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
