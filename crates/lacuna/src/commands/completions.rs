//! `lacuna completions`: what a shell needs to complete commands and options.

use anyhow::Result;
use clap::{Args as ClapArgs, CommandFactory};
use clap_complete::Shell;

use super::Outcome;
use crate::Cli;
use crate::console::emit;

const EXAMPLES: &str = "\
Examples:
  lacuna completions bash > ~/.local/share/bash-completion/completions/lacuna
  lacuna completions zsh > ~/.zfunc/_lacuna
  lacuna completions fish > ~/.config/fish/completions/lacuna.fish

Exit codes: 0 done, 1 failed, 2 wrong usage.";

/// Arguments of `lacuna completions`.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// The shell.
    #[arg(value_enum)]
    shell: Shell,
}

/// Writes the completions of a shell to standard output.
pub(crate) fn run(args: &Args) -> Result<Outcome> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "lacuna", &mut script);
    emit(&String::from_utf8_lossy(&script))?;
    Ok(Outcome::Done)
}
