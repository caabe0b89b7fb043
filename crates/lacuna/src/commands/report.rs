//! `lacuna report`: a diagnosis as a page.

use std::io::Write;
use std::path::PathBuf;

use anyhow::{Context, Result};
use case_files::report_page::page_of_file;
use clap::Args as ClapArgs;

use super::Outcome;

const EXAMPLES: &str = "\
Examples:
  lacuna diagnose case/ --json verdict.json
  lacuna report verdict.json -o page.html
  lacuna report verdict.json -o - > page.html

The page is one file that opens in any browser and needs no network.

Exit codes: 0 done, 1 failed, 2 wrong usage.";

/// Arguments of `lacuna report`.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// What `lacuna diagnose ... --json VERDICT.json` wrote.
    #[arg(value_name = "VERDICT.json")]
    verdict: PathBuf,
    /// The page; `-` is standard output.
    #[arg(short, long, value_name = "PAGE.html|-")]
    out: String,
}

/// Makes the page.
pub(crate) fn run(args: &Args) -> Result<Outcome> {
    write_page(&args.out, &page_of_file(&args.verdict)?)?;
    Ok(Outcome::Done)
}

/// Writes a page to a file, or to standard output for `-`.
pub(crate) fn write_page(target: &str, page: &str) -> Result<()> {
    if target == "-" {
        // Byte for byte: what strips colours from text would take parts of the scripts for colours.
        return std::io::stdout().write_all(page.as_bytes()).context("cannot write to standard output");
    }
    std::fs::write(target, page).with_context(|| format!("cannot write '{target}'"))
}
