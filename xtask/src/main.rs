//! Development commands: `cargo xtask COMMAND`.

use std::process::ExitCode;

use clap::{Parser, Subcommand};

mod bag;
mod binary;
mod blind;
mod book;
mod child;
mod compare;
mod document;
mod effect;
mod evidence;
mod examples;
mod growth;
mod instructions;
mod learn;
mod mujoco;
mod next;
mod output;
mod reproduce;
mod stale;

/// Development commands of Lacuna.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask")]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Reproduce Table 1 and the figures of Hendzel & Trojnacki 2014.
    Reproduce(reproduce::Args),
    /// Compare adaptive laws on laps they have not seen: which keep what they learn.
    Learn(learn::Args),
    /// Draw blind cases, seal their truth, diagnose and score them; or write answers for given case folders.
    Blind(Box<blind::Args>),
    /// Diagnose real recordings with the effect concealed, then open the witness.
    Evidence(evidence::Args),
    /// Run exported models in MuJoCo on held-out inputs and compare with the truth.
    Mujoco(mujoco::Args),
    /// Write the file of a new effect, to be filled with its law.
    Effect(effect::Args),
    /// Build the documentation as a book that opens offline.
    Book(book::Args),
    /// Ask whether it pays to follow the advice on the next drive.
    Next(next::Args),
    /// Measure time and memory of `lacuna check` on a large bag.
    Bag(bag::Args),
    /// Measure our kernels beside C, SciPy, numba, PySINDy and MuJoCo.
    Compare(compare::Args),
    /// Measure what `lacuna` costs as recordings become longer and more, and with how many cores.
    Growth(growth::Args),
    /// Count instructions of the hot kernels and compare them with those on record.
    Instructions(instructions::Args),
}

fn main() -> ExitCode {
    let outcome = match Cli::parse().command {
        Command::Reproduce(args) => reproduce::run(args),
        Command::Learn(args) => learn::run(args),
        Command::Blind(args) => blind::run(&args),
        Command::Evidence(args) => evidence::run(&args),
        Command::Mujoco(args) => mujoco::run(&args),
        Command::Effect(args) => effect::run(&args),
        Command::Book(args) => book::run(&args),
        Command::Next(args) => next::run(&args),
        Command::Bag(args) => bag::run(&args),
        Command::Compare(args) => compare::run(&args),
        Command::Growth(args) => growth::run(&args),
        Command::Instructions(args) => instructions::run(&args),
    };
    match outcome {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}
