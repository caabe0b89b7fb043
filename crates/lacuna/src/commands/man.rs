//! `lacuna man`: manual pages, one for the program and one for each command.

use std::fs;
use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::{Args as ClapArgs, CommandFactory};
use clap_mangen::Man;

use super::Outcome;
use crate::Cli;
use crate::console::emit;

const EXAMPLES: &str = "\
Examples:
  lacuna man > lacuna.1
  lacuna man --out ~/.local/share/man/man1

Exit codes: 0 done, 1 failed, 2 wrong usage.";

/// Arguments of `lacuna man`.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// Folder for lacuna.1, lacuna-check.1, ...; without it the first goes to
    /// standard output.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// Writes the manual pages.
pub(crate) fn run(args: &Args) -> Result<Outcome> {
    let mut program = Cli::command();
    // Gives the commands their full names, such as `lacuna-check`.
    program.build();
    let Some(folder) = &args.out else {
        let (_, page) = page(program)?;
        emit(&page)?;
        return Ok(Outcome::Done);
    };
    fs::create_dir_all(folder).with_context(|| format!("cannot create '{}'", folder.display()))?;
    let commands: Vec<clap::Command> =
        program.get_subcommands().filter(|command| command.get_name() != "help").cloned().collect();
    let count = commands.len() + 1;
    for command in std::iter::once(program).chain(commands) {
        let (name, page) = page(command)?;
        let file = folder.join(name);
        fs::write(&file, page).with_context(|| format!("cannot write '{}'", file.display()))?;
    }
    emit(&format!("{count} pages written to {}\n", folder.display()))?;
    Ok(Outcome::Done)
}

/// A page with the name of its file.
fn page(command: clap::Command) -> Result<(String, String)> {
    let man = Man::new(command);
    let mut page = Vec::new();
    man.render(&mut page)?;
    Ok((man.get_filename(), String::from_utf8_lossy(&page).into_owned()))
}
