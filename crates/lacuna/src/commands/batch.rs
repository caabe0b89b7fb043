//! `lacuna batch`: every recording of a fleet, each by itself.

use std::path::PathBuf;

use anyhow::{Result, bail, ensure};
use case_files::envelope::Program;
use case_files::long::Budget;
use case_files::{case_folder, columns_case, own_effects};
use clap::Args as ClapArgs;
use fleet::{Defaults, Event, FolderContents, Outcome as UnitOutcome, Overview, Settings, Shard, Store};
use inference::KnownEffects;
use serde_json::json;

use super::diagnose::minutes;
use super::{Outcome, OwnEffects, Reading, Usage, listed, overview, report};
use crate::console::{Counted, emit, emit_json};

const EXAMPLES: &str = "\
Examples:
  lacuna batch cases/ -o out                every recording of every case
                                            folder, at most 8 folders deep
  lacuna batch walks/ --robot robot.toml --reference good/ -o out
                                            every recording in a folder
  lacuna batch list.csv -o out --page fleet.html
  lacuna batch list.csv -o out-3 --shard 3/64
                                            one of 64 parts; join them with
                                            lacuna merge

A list is CSV (or lines of JSON, in a .jsonl file) with the columns recording
(paths, `;` between those of one run) and, where wanted, id, robot, robot_id
(which vehicle), reference (paths), mapping, date (2026-03-01, or with a time).
Paths are relative to the list.

Every recording is diagnosed by itself and kept as soon as it is done: run the
same command again after an interruption, and what is done is not done again.
OUT/rows.parquet has a row for each, OUT/json what `lacuna diagnose --json` says.

Exit codes: 0 done, 1 failed, 2 wrong usage, 3 done but some recordings have no
  answer, or some input was lost.";

/// Arguments of `lacuna batch`.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// Folder of case folders, folder of recordings (with --robot), or a list of recordings (CSV, or JSON lines).
    #[arg(value_name = "DIR|LIST")]
    input: PathBuf,
    /// Folder for the answers.
    #[arg(short, long, value_name = "OUT")]
    out: PathBuf,
    /// Robot file, or name of a built-in robot: of all recordings in DIR, or of those for which LIST names none.
    #[arg(long, value_name = "NAME|FILE")]
    robot: Option<String>,
    /// Files or folders of drives in which the simulation was right, in the same way.
    #[arg(long, value_name = "PATH", num_args = 1..)]
    reference: Vec<PathBuf>,
    /// Mapping file or name of a built-in mapping, in the same way [default: as in diagnose].
    #[arg(long, value_name = "NAME|FILE")]
    mapping: Option<String>,
    /// What to do with bad rows and cells of recordings.
    #[arg(long, value_enum, default_value_t)]
    reading: Reading,
    /// Recorded time that a diagnosis rests on at most, as in diagnose; 0 takes everything.
    #[arg(long, value_name = "MINUTES", value_parser = minutes)]
    budget: Option<f64>,
    /// Nobody changed a robot since it was right: no cause is weighed that needs a hand on it, as in diagnose.
    #[arg(long)]
    same_robot: bool,
    #[command(flatten)]
    effects: OwnEffects,
    /// Work on the I-th of N parts, from 1/N to N/N; ids decide which.
    #[arg(long, value_name = "I/N", default_value_t)]
    shard: Shard,
    /// Recordings at a time [default: one for each core].
    #[arg(long, value_name = "COUNT")]
    threads: Option<usize>,
    /// Work on at most so many recordings; run again for the rest.
    #[arg(long, value_name = "COUNT")]
    limit: Option<usize>,
    /// Make a page of the fleet: who differs, by what, since when; one file that opens offline.
    #[arg(long, value_name = "PAGE.html|-")]
    page: Option<String>,
    /// Write the counts as JSON to a file; `-` is standard output, instead of the text.
    #[arg(long, value_name = "FILE|-")]
    json: Option<String>,
}

/// Diagnoses a fleet.
pub(crate) fn run(args: &Args, verbose: bool) -> Result<Outcome> {
    let known = args.effects.known()?;
    let FolderContents { units, unread } = find(args, known)?;
    let all = units.len();
    let units: Vec<_> = units.into_iter().filter(|unit| args.shard.holds(&unit.id)).collect();
    let mine = units.len();
    let settings = Settings {
        options: inference::Options { known, same_robot: args.same_robot, ..inference::Options::default() },
        reading: args.reading.options(),
        reading_name: args.reading.name().to_owned(),
        budget: args.budget.map(Budget::of_minutes).unwrap_or_default(),
        threads: args.threads.unwrap_or_else(|| std::thread::available_parallelism().map_or(1, Into::into)),
        limit: args.limit,
    };
    let store = Store::create(&args.out)?;
    let plan = fleet::plan(units, &store, &settings)?;
    let (before, to_do, left) = (plan.done_before, plan.to_do.len(), plan.left);
    let progress = Counted::new(to_do, "recordings", verbose);
    let listener = |event: &Event<'_>| match event {
        Event::Prepared(robot, took) => progress.note(&format!("prepared {robot}"), *took),
        Event::Finished(row, took) => {
            let what = match row.outcome {
                UnitOutcome::Failed => row.error.clone().unwrap_or_default(),
                UnitOutcome::Done => row.sentences.first().cloned().unwrap_or_default(),
            };
            progress.one(&format!("{} {}: {what}", row.outcome.name(), row.id), *took);
        }
    };
    let ran = fleet::run(plan.to_do, &store, &settings, &listener)?;
    drop(progress);

    let (mut overview, mut found) = (Overview::default(), Vec::new());
    store.write_table(&mut |row| {
        overview.add(row);
        if args.page.is_some() {
            found.push(fleet::diagnosed(row));
        }
    })?;
    if let Some(target) = &args.page {
        report::write_page(target, &fleet::page(&found))?;
    }
    // Other shards and earlier lists may have left rows in the same folder.
    let others = (overview.rows + left).saturating_sub(mine);
    if let Some(target) = &args.json {
        let mut out = overview::as_json(&overview);
        out["format"] = json!(1);
        out["program"] = serde_json::to_value(Program::default())?;
        out["shard"] = json!(args.shard.to_string());
        out["units"] = json!({
            "found": all, "of_this_shard": mine, "done_before": before, "to_do": to_do, "done": ran.done,
            "failed": ran.failed, "left": left,
        });
        out["unread_files"] = json!(unread);
        out["table"] = json!(store.table());
        emit_json(target, &out)?;
    }
    if ![&args.json, &args.page].iter().any(|target| target.as_deref() == Some("-")) {
        let shard = if mine < all { format!(" of this shard ({} of {all})", args.shard) } else { String::new() };
        let mut text = format!("{mine} recordings{shard}: {before} done before, {to_do} to do");
        if left > 0 {
            text += &format!(", {left} left for another run");
        }
        text += "\n\nIn the table\n";
        text += &overview::as_text(&overview);
        if others > 0 {
            text += &format!("\n{others} of them are of another shard, or of a list that was run before\n");
        }
        text += &listed("Not read: no mapping fits", &unread);
        emit(&format!("{text}\nTable: {}\n", store.table().display()))?;
    }
    let lost = ran.failed + ran.lost + plan.lost_before + unread.len();
    Ok(if lost > 0 { Outcome::InputLost } else { Outcome::Done })
}

/// The recordings that the arguments name.
fn find(args: &Args, known: KnownEffects) -> Result<FolderContents> {
    let shown = args.input.display();
    if args.threads == Some(0) || args.limit == Some(0) {
        bail!(Usage("--threads and --limit take a number from 1 on".to_owned()));
    }
    if args.input.is_dir() && args.robot.is_none() && !args.reference.is_empty() {
        bail!(Usage(
            "the references of case folders are their own; of recordings in a folder, name --robot too".to_owned()
        ));
    }
    ensure!(
        args.input.exists(),
        "there is no folder or list '{shown}'; give a folder of case folders, a folder of recordings with --robot, or a list \
         (CSV with a column `recording`)"
    );
    let defaults =
        Defaults { robot: args.robot.clone(), reference: args.reference.clone(), mapping: args.mapping.clone() };
    // What holds for all is looked at before any work is done.
    if let Some(name) = defaults.robot.as_deref()
        && columns_case::kind_of(name)?.is_none()
    {
        own_effects::ensure_torque_driven(&case_folder::robot_with(known, name)?)?;
    }
    defaults.mapping.as_deref().map(case_folder::mapping).transpose()?;
    if args.input.is_file() {
        return Ok(FolderContents { units: fleet::manifest(&args.input, &defaults)?, unread: Vec::new() });
    }
    match &args.robot {
        Some(robot) => fleet::recordings_below(&args.input, robot, &defaults),
        None => fleet::cases_below(&args.input, args.mapping.as_deref()),
    }
}
