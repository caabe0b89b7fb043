//! `lacuna`: recordings go in, a verdict with evidence comes out.

#![allow(
    clippy::format_push_string,
    reason = "text for people: short, and `write!` to a string would ask for a result"
)]

use std::process::ExitCode;

use clap::{Parser, Subcommand};

mod commands;
mod console;

use commands::{Outcome, Usage, check, convert, diagnose, effects, explain, export, identify, predict, simulate};

const EXAMPLES: &str = "\
Examples:
  lacuna check walk/                           what is inside a bag, and how good it is
  lacuna diagnose case/                        a folder with robot.toml, reference/, recordings/
  lacuna diagnose --robot husky-a200 --mapping husky-open \\
         --reference FLOORING --recordings SANDY_LOAM
  lacuna export verdict.json --to mjcf         the corrected robot for MuJoCo
  lacuna identify robot.toml run_1.csv         the online identifier with its certificate
  lacuna effects                               what a simulation may lack
  lacuna explain payload                       one of them in full

Exit codes: 0 done, 1 failed, 2 wrong usage, 3 done but some input was lost.";

/// Says which physics a robot simulation left out.
#[derive(Debug, Parser)]
#[command(name = "lacuna", version, about, after_help = EXAMPLES)]
struct Cli {
    #[command(subcommand)]
    command: Command,
    /// Tell on standard error what is being done.
    #[arg(short, long, global = true)]
    verbose: bool,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Tell what is inside recordings, and how good it is.
    Check(check::Args),
    /// Write a recording in another format.
    Convert(convert::Args),
    /// Compare recordings with a robot's simulation and name what it lacks.
    Diagnose(diagnose::Args),
    /// Follow a recording with the online neural identifier and check its certificate.
    Identify(identify::Args),
    /// Simulate a robot file on the inputs of a recording.
    Simulate(simulate::Args),
    /// Forecast held-out drives with one or more robot files, and compare.
    Predict(predict::Args),
    /// Write a diagnosed robot as a model of a simulator, corrected.
    Export(export::Args),
    /// List the effects that a simulation may lack.
    Effects(effects::Args),
    /// Explain one effect: law, parameters, what reveals it, what it looks like.
    Explain(explain::Args),
}

fn main() -> ExitCode {
    console::catch_panics(run).unwrap_or_else(|defect| {
        console::error(&defect);
        ExitCode::FAILURE
    })
}

fn run() -> ExitCode {
    let cli = Cli::parse();
    let outcome = match &cli.command {
        Command::Check(args) => check::run(args, cli.verbose),
        Command::Convert(args) => convert::run(args),
        Command::Diagnose(args) => diagnose::run(args, cli.verbose),
        Command::Identify(args) => identify::run(args),
        Command::Simulate(args) => simulate::run(args),
        Command::Predict(args) => predict::run(args),
        Command::Export(args) => export::run(args),
        Command::Effects(args) => effects::run(args),
        Command::Explain(args) => explain::run(args),
    };
    match outcome {
        Ok(Outcome::Done) => ExitCode::SUCCESS,
        Ok(Outcome::InputLost) => ExitCode::from(3),
        Err(error) => {
            console::error(&format!("{error:#}"));
            ExitCode::from(if error.is::<Usage>() { 2 } else { 1 })
        }
    }
}
