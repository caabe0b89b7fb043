//! `lacuna`: recordings go in, a verdict with evidence comes out.

#![allow(
    clippy::format_push_string,
    reason = "text for people: short, and `write!` to a string would ask for a result"
)]

use std::process::ExitCode;

use clap::{Parser, Subcommand};

mod commands;
mod console;
mod mcap_out;

use commands::{
    Outcome, Usage, batch, check, completions, convert, diagnose, effects, explain, export, identify, law, man, merge,
    next, predict, rehearse, report, robot, screen, simulate,
};

const EXAMPLES: &str = "\
Examples:
  lacuna check walk/               what is inside a bag, and how good it is
  lacuna diagnose case/            robot.toml, reference/ and recordings/
  lacuna diagnose --robot husky-a200 --mapping husky-open \\
         --reference FLOORING --recordings SANDY_LOAM
  lacuna batch cases/ -o fleet/    every recording of a fleet, by itself
  lacuna next case/                which drive tells rivals apart
  lacuna rehearse case/            which effects would be found there
  lacuna export verdict.json --to mjcf
  lacuna explain payload           one effect in full

Exit codes:
  0  done
  1  failed
  2  wrong usage
  3  done, but some input was lost
  4  done, and a mismatch was found (diagnose --fail-on mismatch)";

/// Says which physics a robot simulation left out.
#[derive(Debug, Parser)]
#[command(name = "lacuna", version, after_help = EXAMPLES, max_term_width = 80)]
struct Cli {
    #[command(subcommand)]
    command: Command,
    /// Tell on standard error what is being done.
    #[arg(short, long, global = true, display_order = 999)]
    verbose: bool,
}

/// In the order in which they are used.
#[derive(Debug, Subcommand)]
enum Command {
    /// Tell what is inside recordings, and how good it is.
    Check(check::Args),
    /// Write a recording in another format.
    Convert(convert::Args),
    /// Pass once over recordings of any length and tell which are unlike the references.
    Screen(Box<screen::Args>),
    /// Compare recordings with a simulation and name what it lacks.
    Diagnose(Box<diagnose::Args>),
    /// Write a robot file that behaves like the logs of a simulator.
    Robot(robot::Args),
    /// Simulate a robot file on the inputs of a recording.
    Simulate(simulate::Args),
    /// Forecast held-out drives with one or more robot files, and compare.
    Predict(predict::Args),
    /// Diagnose every recording of a fleet, each by itself.
    Batch(batch::Args),
    /// Join what `batch` wrote, and make a page of the fleet.
    Merge(merge::Args),
    /// Make a page of what `diagnose --json` wrote.
    Report(report::Args),
    /// Show the law that a diagnosis found for what has no name, and save it.
    Law(law::Args),
    /// Say which drive would tell the remaining causes apart best.
    Next(next::Args),
    /// Say which effects would be found on a robot's own inputs, and from which size.
    Rehearse(Box<rehearse::Args>),
    /// Write a diagnosed robot as a model of a simulator, corrected.
    Export(export::Args),
    /// Follow a recording with the online neural identifier.
    Identify(identify::Args),
    /// List the effects that a simulation may lack.
    Effects(effects::Args),
    /// Explain one effect: law, parameters, what reveals it.
    Explain(explain::Args),
    /// Write what a shell needs to complete commands.
    Completions(completions::Args),
    /// Write the manual pages.
    Man(man::Args),
}

fn main() -> ExitCode {
    console::catch_panics(run).unwrap_or_else(|defect| {
        console::defect(&defect);
        ExitCode::FAILURE
    })
}

fn run() -> ExitCode {
    let cli = Cli::parse();
    let outcome = match &cli.command {
        Command::Batch(args) => batch::run(args, cli.verbose),
        Command::Merge(args) => merge::run(args),
        Command::Check(args) => check::run(args, cli.verbose),
        Command::Convert(args) => convert::run(args),
        Command::Screen(args) => screen::run(args, cli.verbose),
        Command::Diagnose(args) => diagnose::run(args, cli.verbose),
        Command::Identify(args) => identify::run(args),
        Command::Robot(args) => robot::run(args, cli.verbose),
        Command::Simulate(args) => simulate::run(args),
        Command::Predict(args) => predict::run(args),
        Command::Export(args) => export::run(args),
        Command::Next(args) => next::run(args, cli.verbose),
        Command::Rehearse(args) => rehearse::run(args, cli.verbose),
        Command::Law(args) => law::run(args),
        Command::Report(args) => report::run(args),
        Command::Effects(args) => effects::run(args),
        Command::Explain(args) => explain::run(args),
        Command::Completions(args) => completions::run(args),
        Command::Man(args) => man::run(args),
    };
    match outcome {
        Ok(Outcome::Done) => ExitCode::SUCCESS,
        Ok(Outcome::InputLost) => ExitCode::from(3),
        Ok(Outcome::Mismatch) => ExitCode::from(4),
        Err(error) => {
            console::failure(&error);
            ExitCode::from(if error.is::<Usage>() { 2 } else { 1 })
        }
    }
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::Cli;

    #[test]
    fn the_arguments_make_sense() {
        Cli::command().debug_assert();
    }

    #[test]
    fn every_command_has_examples_and_exit_codes() {
        let program = Cli::command();
        for command in program.get_subcommands() {
            let help = command.get_after_help().map(ToString::to_string).unwrap_or_default();
            let name = command.get_name();
            assert!(help.contains("Examples:\n") || help.contains("Example:\n"), "{name} has no examples");
            assert!(help.contains(&format!("lacuna {name}")), "{name}: its examples are another's");
            assert!(help.contains("Exit codes: 0 done, 1 failed, 2 wrong usage"), "{name} tells no exit codes");
        }
    }

    #[test]
    fn help_fits_eighty_columns() {
        let mut program = Cli::command();
        program.build();
        let names: Vec<String> = program.get_subcommands().map(|c| c.get_name().to_owned()).collect();
        let mut pages = vec![program.render_long_help().to_string()];
        for name in names {
            let command = program.find_subcommand_mut(&name).expect("it was listed");
            pages.push(command.render_long_help().to_string());
        }
        for page in &pages {
            for line in page.lines() {
                assert!(line.chars().count() <= 80, "{line}");
            }
        }
    }
}
