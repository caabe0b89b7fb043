//! Commands that live in packages of their own: listed here, built and started by cargo.

use std::ffi::OsString;
use std::path::Path;
use std::process::ExitCode;

use anyhow::{Context, Result};
use clap::{Arg, ArgAction, ArgMatches, Command, value_parser};
use harness::commands::{ELSEWHERE, Elsewhere};

/// What follows the name of such a command.
const REST: &str = "rest";

/// The program with these commands listed after its own. What follows their names is not read here, `--help` neither.
pub(crate) fn listed(program: Command) -> Command {
    let rest = || {
        let rest = Arg::new(REST).action(ArgAction::Append).num_args(0..).value_parser(value_parser!(OsString));
        rest.trailing_var_arg(true).allow_hyphen_values(true)
    };
    ELSEWHERE.iter().fold(program, |program, command| {
        program.subcommand(Command::new(command.name).about(command.about).disable_help_flag(true).arg(rest()))
    })
}

/// The command of these that was asked for, and what follows its name.
pub(crate) fn chosen(matches: &ArgMatches) -> Option<(&'static Elsewhere, Vec<OsString>)> {
    let (name, rest) = matches.subcommand()?;
    let command = ELSEWHERE.iter().find(|command| command.name == name)?;
    Some((command, rest.get_many(REST).unwrap_or_default().cloned().collect()))
}

/// Builds the package and runs the command, whose exit code becomes ours.
pub(crate) fn run(command: &Elsewhere, rest: &[OsString]) -> ExitCode {
    start(command, rest).unwrap_or_else(|error| {
        eprintln!("error: {error:#}");
        ExitCode::FAILURE
    })
}

fn start(command: &Elsewhere, rest: &[OsString]) -> Result<ExitCode> {
    let this = std::env::current_exe().context("cannot tell where this program is")?;
    let target = this
        .parent()
        .and_then(Path::parent)
        .context("this program lies in no target folder of cargo; run it as `cargo xtask`")?;
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let status = std::process::Command::new(cargo)
        .args(["run", "--release", "--package", command.package, "--bin", command.package])
        .args(command.features.into_iter().flat_map(|features| ["--features", features]))
        .arg("--target-dir")
        .arg(target)
        .args(["--", command.name])
        .args(rest)
        .status()
        .with_context(|| format!("cannot start cargo, which builds '{}'", command.package))?;
    let code = status.code().and_then(|code| u8::try_from(code).ok());
    Ok(code.map_or(ExitCode::FAILURE, ExitCode::from))
}

#[cfg(test)]
mod tests {
    use clap::Command;

    use super::{chosen, listed};

    #[test]
    fn what_follows_the_name_is_handed_on_as_it_is() {
        let program = || listed(Command::new("xtask"));
        for rest in [&["--quick", "--only", "a,b", "-x", "plain"][..], &["--help"], &[]] {
            let matches = program().try_get_matches_from(["xtask", "blind"].iter().chain(rest)).expect("not read here");
            let (command, handed) = chosen(&matches).expect("chosen");
            assert_eq!((command.name, command.package), ("blind", "proof"));
            assert_eq!(handed, rest);
        }
        assert!(program().try_get_matches_from(["xtask", "no-such"]).is_err());
    }
}
