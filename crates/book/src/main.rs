//! The documentation as a book: `docs/` becomes pages that open offline, in `target/book`.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::{Context, Result};
use clap::{Args as ClapArgs, Parser, Subcommand};
use harness::{exit_code, output};
use mdbook_driver::MDBook;
use mdbook_driver::book::BookItem;
use mdbook_driver::config::Config;

mod constants;
mod effects;
mod inward;
mod settings;

/// What the book looks like. Nothing in it is loaded from a network.
const CONFIG: &str = r#"
[book]
title = "Lacuna"
description = "Which physics a robot simulation left out"
language = "en"
src = "docs"

[build]
create-missing = false

[output.html]
no-section-label = true
# For servers; an offline book needs none.
input-404 = ""
default-theme = "light"
preferred-dark-theme = "navy"

[output.html.playground]
runnable = false

[output.html.print]
enable = false
"#;

/// The documentation as a book.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask")]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Build the documentation as a book that opens offline.
    Book(Args),
}

/// Arguments of `cargo xtask book`.
#[derive(Debug, ClapArgs)]
struct Args {
    /// Write the pages that are made from the program (docs/effects.md, docs/settings.md, docs/constants.md) first.
    #[arg(long)]
    docs: bool,
    /// Folder of the book.
    #[arg(long, value_name = "DIR", default_value = "target/book")]
    out: PathBuf,
}

fn main() -> ExitCode {
    let Command::Book(args) = Cli::parse().command;
    exit_code(run(&args))
}

/// Builds the book.
fn run(args: &Args) -> Result<bool> {
    if args.docs {
        output::write(&output::docs(""), "effects.md", &effects::page())?;
        output::write(&output::docs(""), "settings.md", &settings::page())?;
        output::write(&output::docs(""), "constants.md", &constants::page())?;
    }
    let out = output::beside(&args.out.to_string_lossy());
    build(&output::beside(""), &out)?;
    println!("{}", out.join("index.html").display());
    Ok(true)
}

/// Builds the book of a workspace.
fn build(root: &Path, out: &Path) -> Result<()> {
    let mut config: Config = CONFIG.parse()?;
    config.build.build_dir = out.to_path_buf();
    let mut book =
        MDBook::load_with_config(root, config).context("cannot read the pages that docs/SUMMARY.md lists")?;
    book.book.for_each_mut(|item| {
        if let BookItem::Chapter(chapter) = item
            && let Some(page) = &chapter.path
        {
            chapter.content = inward::inward(&chapter.content, page);
        }
    });
    book.build().context("cannot build the book")
}

#[cfg(test)]
mod tests;
