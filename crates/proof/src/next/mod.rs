//! `cargo xtask next`: whether it pays to follow the advice on the next drive.
//!
//! ```text
//! drawn robot with a hidden effect --one calm recording--> diagnosis that leaves several causes, with its advice
//!   + the advised drive | a random drive of the menu | a random speed profile   (the same robot, the same length)
//!   --> three second diagnoses: is the hidden effect now named, alone?
//! ```

use std::path::PathBuf;

use anyhow::{Context, Result, ensure};
use clap::Args as ClapArgs;
use examiner::{Mix, Plan, Settings};
use rayon::prelude::*;

use crate::document::{to_markdown, to_text};
use crate::output;

mod case;
mod follow;
mod tables;

use case::Tried;

/// Arguments of `cargo xtask next`.
#[derive(Debug, ClapArgs)]
pub(crate) struct Args {
    /// Number of robots that are drawn; those whose first diagnosis is clear are left out.
    #[arg(long, default_value_t = 60, value_parser = clap::builder::RangedU64ValueParser::<usize>::new().range(1..))]
    count: usize,
    /// Seed of the draws.
    #[arg(long, default_value_t = 2029)]
    seed: u64,
    /// Length of the further drive, s.
    #[arg(long, default_value_t = 4.3)]
    seconds: f64,
    /// Only these cases.
    #[arg(long, value_delimiter = ',')]
    only: Vec<String>,
    /// Also write docs/next.md.
    #[arg(long)]
    docs: bool,
}

/// Runs the command; true if all that is asked is met.
pub(crate) fn run(args: &Args) -> Result<bool> {
    let folder = output::folder("next")?;
    let plans = plans(args);
    ensure!(!plans.is_empty(), "no case of this set has such a name; names begin with x001");
    let bar = output::progress(plans.len() as u64, "robots")?;
    let tried: Vec<(String, Result<Option<Tried>>)> = plans
        .par_iter()
        .map(|plan| {
            let tried = case::run(plan, &folder.join(&plan.name), args.seconds);
            bar.inc(1);
            (plan.name.clone(), tried)
        })
        .collect();
    bar.finish_and_clear();
    let (mut kept, mut failed) = (Vec::new(), 0);
    for (name, outcome) in tried {
        match outcome.with_context(|| format!("case {name}")) {
            Ok(found) => kept.extend(found),
            Err(e) => {
                failed += 1;
                eprintln!("{e:#}");
            }
        }
    }
    let figures = tables::figures(plans.len(), &kept);
    let sections = tables::all(plans.len(), &kept);
    output::write(&folder, "summary.json", &serde_json::to_string_pretty(&figures)?)?;
    output::write(&folder, "cases.json", &serde_json::to_string_pretty(&kept)?)?;
    println!("{}", to_text(&sections));
    if args.docs {
        let path: PathBuf = output::docs("next.md");
        std::fs::write(&path, to_markdown("The next drive", &tables::intro(args, &figures), &sections))
            .with_context(|| format!("cannot write '{}'", path.display()))?;
    }
    Ok(failed == 0 && figures.iter().all(|f| f.pass != Some(false)))
}

/// Robots with one hidden effect each, all effects in turn.
fn plans(args: &Args) -> Vec<Plan> {
    let settings = Settings {
        duration_s: case::SECONDS,
        references: case::REFERENCES,
        recordings: Some(2),
        heldout: 1,
        ..Settings::default()
    };
    let mix = Mix { null: 0.0, single: 1.0, pair: 0.0, outsider: 0.0, triple: 0.0 };
    let mut plans = examiner::set(args.seed, args.count, mix, &settings);
    plans.retain(|p| args.only.is_empty() || args.only.contains(&p.name));
    plans
}
