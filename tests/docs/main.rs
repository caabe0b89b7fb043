//! Every command in the documentation runs, what it shows is what comes out, and every link leads somewhere.
//!
//! A `sh` block is run line by line, page by page, in a folder of its own. `text` blocks below it are what comes out: each
//! of their lines must come, in this order; `...` stands for what was left out. Words behind `sh`:
//!
//! * `example`: files that the reader has; the arguments are checked, nothing is run.
//! * `long`: takes minutes; run where `LACUNA_LONG_DOCS` is set, otherwise the arguments are checked.
//! * `exit=3`: the exit code of the last command, where it is not 0.
//!
//! `text,above` is what an earlier command of the page said, and is not compared.
//! A block of another language with `file=NAME` behind it is written to that file first.
//!
//! What needs data that are no part of this repository is not run where they are not beside it: then the test is shown as
//! ignored, though all else ran and held.

#![expect(clippy::unnecessary_wraps, reason = "all tests have one type, also those that are never skipped")]

mod blocks;
mod command;
mod compare;
mod links;
mod run;

use std::path::{Path, PathBuf};

use rayon::prelude::*;
use skipping::{Outcome, Skipped};

/// The workspace.
fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// All pages: of the workspace, of the documentation, of the crates.
fn pages() -> Vec<PathBuf> {
    let mut out = vec![root().join("README.md"), root().join("CHANGELOG.md")];
    let mut folders = vec![root().join("docs"), root().join("crates")];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "md") {
                out.push(path);
            }
        }
    }
    out.sort();
    out
}

/// A page as messages call it.
fn shown(page: &Path) -> String {
    page.strip_prefix(root()).unwrap_or(page).display().to_string()
}

fn every_command_in_the_documentation_runs() -> Outcome {
    let programs = run::Programs::find();
    let tally: Vec<run::Tally> = pages().par_iter().map(|page| run::page(&programs, page)).collect();
    let mut all = run::Tally::default();
    for tally in tally {
        all.add(tally);
    }
    eprintln!(
        "commands in the documentation: {} run, {} with their arguments checked only, {} skipped",
        all.run,
        all.checked.len(),
        all.skipped.len()
    );
    for line in &all.checked {
        eprintln!("  not run: {line}");
    }
    for line in &all.skipped {
        eprintln!("  skipped, its data are not beside the repository: {line}");
    }

    assert!(all.failures.is_empty(), "\n{}", all.failures.join("\n\n"));
    assert!(all.run >= 8, "the documentation has lost its commands");
    match all.skipped.len() {
        0 => Ok(()),
        n => {
            Err(Skipped::because(format!("{n} commands need ../shared beside the repository; {} others ran", all.run)))
        }
    }
}

fn every_link_leads_somewhere() -> Outcome {
    let dead: Vec<String> = pages().iter().flat_map(|page| links::dead(page)).collect();
    assert!(dead.is_empty(), "\n{}", dead.join("\n"));
    Ok(())
}

skipping::tests![
    every_command_in_the_documentation_runs,
    every_link_leads_somewhere,
    blocks::commands_are_found_with_what_they_show,
    command::every_way_to_start_lacuna_is_the_same,
    compare::words_to_the_letter_numbers_within_reason,
    links::headings_are_named_as_pages_name_them,
];
