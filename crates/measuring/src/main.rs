//! `cargo xtask learn`, `compare`, `growth`, `instructions` and `cold`.
//!
//! # Files
//!
//! ```text
//! learn/         which adaptive laws keep what they learn
//! compare/       our kernels beside those of others, in turn
//! growth/        what `lacuna` costs on longer and more recordings
//! instructions/  instructions of the hot kernels, beside those on record
//! cold/          what a fresh clone costs
//! examples.rs    the examples that are measured, built in release
//! ```

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use harness::{binary, child, document, exit_code, output};

mod cold;
mod compare;
mod examples;
mod growth;
mod instructions;
mod learn;

/// Commands that measure.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Compare adaptive laws on laps they have not seen: which keep what they learn.
    Learn(learn::Args),
    /// Measure our kernels beside C, SciPy, numba, PySINDy and MuJoCo.
    Compare(compare::Args),
    /// Measure what `lacuna` costs as recordings become longer and more, and with how many cores.
    Growth(growth::Args),
    /// Count instructions of the hot kernels and compare them with those on record.
    Instructions(instructions::Args),
    /// Measure what a fresh clone costs: the first command, the program, the tests.
    Cold(cold::Args),
}

fn main() -> ExitCode {
    exit_code(match Cli::parse().command {
        Command::Learn(args) => learn::run(args),
        Command::Compare(args) => compare::run(&args),
        Command::Growth(args) => growth::run(&args),
        Command::Instructions(args) => instructions::run(&args),
        Command::Cold(args) => cold::run(&args),
    })
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::Cli;

    #[test]
    fn every_command_is_listed_by_xtask_in_the_same_words() {
        let cli = Cli::command();
        let about = |c: &clap::Command| c.get_about().map(ToString::to_string).unwrap_or_default();
        let own: Vec<(String, String)> = cli.get_subcommands().map(|c| (c.get_name().to_owned(), about(c))).collect();
        let listed = harness::commands::of("measuring");
        assert_eq!(own, listed.iter().map(|(n, a)| ((*n).to_owned(), (*a).to_owned())).collect::<Vec<_>>());
    }
}
