//! `lacuna merge`: what several runs of `lacuna batch` found, as one.

use std::path::PathBuf;

use anyhow::Result;
use case_files::envelope::Program;
use clap::Args as ClapArgs;
use fleet::{Store, diagnosed, merge, page};
use serde_json::json;

use super::{Outcome, overview, report};
use crate::console::{emit, emit_json};

const EXAMPLES: &str = "\
Examples:
  lacuna batch fleet/ --shard 1/2 -o out-1
  lacuna batch fleet/ --shard 2/2 -o out-2
  lacuna merge out-1 out-2 -o all --page fleet.html

The folder is then as if one run of `lacuna batch` had written it. A recording
that is in several folders counts once; with different answers it is an error.

Exit codes: 0 done, 1 failed, 2 wrong usage, 3 done but some recordings have no
  answer, or some input was lost.";

/// Arguments of `lacuna merge`.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// Folders that `lacuna batch -o` wrote.
    #[arg(required = true, num_args = 1.., value_name = "OUT")]
    parts: Vec<PathBuf>,
    /// Folder for all of it.
    #[arg(short, long, value_name = "ALL")]
    out: PathBuf,
    /// Make a page of the fleet: who differs, by what, since when; one file that opens offline.
    #[arg(long, value_name = "PAGE.html|-")]
    page: Option<String>,
    /// Write the counts as JSON to a file; `-` is standard output, instead of the text.
    #[arg(long, value_name = "FILE|-")]
    json: Option<String>,
}

/// Joins folders.
pub(crate) fn run(args: &Args) -> Result<Outcome> {
    let parts = args.parts.iter().map(|path| Store::open(path)).collect::<Result<Vec<_>>>()?;
    let all = Store::create(&args.out)?;
    let mut found = Vec::new();
    let merged = merge(&parts, &all, &mut |row| {
        if args.page.is_some() {
            found.push(diagnosed(row));
        }
    })?;
    if let Some(target) = &args.page {
        report::write_page(target, &page(&found))?;
    }
    let overview = &merged.overview;
    if let Some(target) = &args.json {
        let mut out = overview::as_json(overview);
        out["format"] = json!(1);
        out["program"] = serde_json::to_value(Program::default())?;
        out["twice"] = json!(merged.twice);
        out["table"] = json!(all.table());
        emit_json(target, &out)?;
    }
    if ![&args.json, &args.page].iter().any(|target| target.as_deref() == Some("-")) {
        let twice = if merged.twice > 0 { format!("{} given twice count once\n", merged.twice) } else { String::new() };
        emit(&format!("{}{twice}\nTable: {}\n", overview::as_text(overview), all.table().display()))?;
    }
    Ok(if overview.failed + overview.lost > 0 { Outcome::InputLost } else { Outcome::Done })
}
