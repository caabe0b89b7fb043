#![doc = include_str!("../README.md")]

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use harness::{binary, child, document, exit_code, output};

mod bag;
mod blind;
mod car;
mod evidence;
mod law;
mod mujoco;
mod next;
mod odometry;

pub use evidence::drive_layout;

/// Commands that prove.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask")]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Draw blind cases, seal their truth, diagnose and score them; or write answers for given case folders.
    Blind(Box<blind::Args>),
    /// Diagnose real recordings with the effect concealed, then open the witness.
    Evidence(evidence::Args),
    /// Run exported models in MuJoCo on held-out inputs and compare with the truth.
    Mujoco(mujoco::Args),
    /// Ask whether it pays to follow the advice on the next drive.
    Next(next::Args),
    /// Calibrate open recordings of wheel counts and poses, and forecast sessions left out.
    Odometry(odometry::Args),
    /// Forecast left-out drives of an open 1:10 car from throttle and steering, beside classical models.
    Car(car::Args),
    /// Leave a name of the catalogue out, and ask what law is found in its place.
    Law(law::Args),
    /// Measure time and memory of `lacuna check` on a large bag.
    Bag(bag::Args),
}

/// Runs the command that the program's arguments name. The exit code is 0 where all that is asked is met, 1 where it is
/// not or something failed, 2 for a wrong usage.
pub fn run() -> ExitCode {
    exit_code(match Cli::parse().command {
        Command::Blind(args) => blind::run(&args),
        Command::Evidence(args) => evidence::run(&args),
        Command::Mujoco(args) => mujoco::run(&args),
        Command::Next(args) => next::run(&args),
        Command::Odometry(args) => odometry::run(&args),
        Command::Car(args) => car::run(&args),
        Command::Law(args) => law::run(&args),
        Command::Bag(args) => bag::run(&args),
    })
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::Cli;

    #[test]
    fn every_command_is_listed_by_xtask_in_the_same_words_and_tells_what_it_takes() {
        let mut cli = Cli::command();
        let about = |c: &clap::Command| c.get_about().map(ToString::to_string).unwrap_or_default();
        let own: Vec<(String, String)> = cli.get_subcommands().map(|c| (c.get_name().to_owned(), about(c))).collect();
        let listed = harness::commands::of("proof");
        assert_eq!(own, listed.iter().map(|(n, a)| ((*n).to_owned(), (*a).to_owned())).collect::<Vec<_>>());

        cli.build();
        for (name, _) in listed {
            let help = cli.find_subcommand_mut(name).expect("listed").render_help().to_string();
            assert!(help.contains(&format!("cargo xtask {name} [OPTIONS]")), "{help}");
        }
    }
}
