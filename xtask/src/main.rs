//! Development commands: `cargo xtask COMMAND`.
//!
//! This program is light, so that the first command in a fresh clone builds no more than it needs. What measures, or
//! needs the readers of recordings, the diagnosis or a generator of books, is a package of its own, built and started when
//! it is asked for.

use std::ffi::OsString;
use std::process::ExitCode;

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use harness::{document, exit_code, output};

mod browser;
mod effect;
mod elsewhere;
mod mutants;
mod reproduce;

/// Development commands of Lacuna.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask", subcommand_required = true, arg_required_else_help = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Reproduce Table 1 and the figures of Hendzel & Trojnacki 2014.
    Reproduce(reproduce::Args),
    /// Write the file of a new effect, to be filled with its law.
    Effect(effect::Args),
    /// Change the code that decides, one thing at a time, and ask whether a test notices.
    Mutants(mutants::Args),
    /// Open the pages in a browser and test them there.
    Browser,
}

fn main() -> ExitCode {
    // `help NAME` is `NAME --help`, also for commands that live elsewhere.
    let mut args: Vec<OsString> = std::env::args_os().collect();
    if args.len() == 3 && args[1] == "help" {
        args.swap(1, 2);
        args[2] = "--help".into();
    }

    let matches = elsewhere::listed(Cli::command()).get_matches_from(args);
    if let Some((command, rest)) = elsewhere::chosen(&matches) {
        return elsewhere::run(command, &rest);
    }

    let cli = Cli::from_arg_matches(&matches).unwrap_or_else(|error| error.exit());
    exit_code(match cli.command {
        Command::Reproduce(args) => reproduce::run(args),
        Command::Effect(args) => effect::run(&args),
        Command::Mutants(args) => mutants::run(&args),
        Command::Browser => browser::run(),
    })
}
