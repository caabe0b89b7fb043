//! `lacuna screen`: passes once over recordings of any number and length, and tells which are unlike the references.

use anyhow::{Result, bail};
use case_files::envelope::Program;
use case_files::long::{Budget, Screened};
use clap::Args as ClapArgs;
use diagnosis::long::Screen;
use inference::KnownEffects;
use pages::text_table::TextTable;
use report::sections::heading;
use report::sections::listed;
use serde_json::json;
use verdict::ComparedWith;

use super::Outcome;
use super::diagnose::{Input, Located, located};
use crate::console::{Progress, emit, emit_json};

const EXAMPLES: &str = "\
Examples:
  lacuna screen case/
  lacuna screen --robot robot.toml --reference monday/ --recordings year/
  lacuna screen case/ --json screened.json       every minute, with its figure

Recordings are passed over once, minute by minute, in memory that does not grow.
Relations among drive, wheels, yaw rate and acceleration are learned from the
references (without any, from the first minutes). `unlike` says how badly they
fit a minute: its mean squared residual, divided by the usual one.
It says where to look, not what is missing: that is for `lacuna diagnose`.

Exit codes: 0 done, 1 failed, 2 wrong usage, 3 done but some input was lost.";

/// Rows of the table at most; everything is in the JSON.
const ROWS: usize = 12;

/// Arguments of `lacuna screen`.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    #[command(flatten)]
    input: Input,
    /// Write everything as JSON to a file; `-` is standard output, instead of the text.
    #[arg(long, value_name = "FILE|-")]
    json: Option<String>,
}

/// Screens recordings.
pub(crate) fn run(args: &Args, verbose: bool) -> Result<Outcome> {
    let progress = Progress::of(&[("screening the recordings", 0.0)], verbose);
    progress.stage("screening the recordings");
    if !args.input.visit.is_empty() {
        bail!(
            "`lacuna screen` compares every minute with all references, of whatever visit; leave out --visit, which \
             `lacuna diagnose` takes"
        );
    }
    let Located { robot, paths: [reference, recordings, _], mapping } = located(&args.input, KnownEffects::default())?;
    let budget = args.input.budget.map(Budget::of_minutes).unwrap_or_default();
    let screened = budget.screen(&robot, [&reference, &recordings], &mapping, &args.input.reading.options())?;
    drop(progress);
    if let Some(target) = &args.json {
        let told = json!({
            "format": 1,
            "program": Program::default(),
            "robot": robot.name,
            "mapping": mapping.name,
            "screened": &screened,
        });
        emit_json(target, &told)?;
    }
    if args.json.as_deref() != Some("-") {
        emit(&text(&screened))?;
    }
    Ok(Outcome::of(&screened.lost))
}

fn text(screened: &Screened) -> String {
    let coverage = &screened.coverage;
    let law = match coverage.compared_with {
        ComparedWith::References => "the relations among signals in the references",
        ComparedWith::Beginning => "the relations among signals in the first minutes",
        ComparedWith::Nothing => "nothing, since a drive signal or the motion of the wheels is missing",
    };
    let hours = coverage.screened / 3600.0;
    let mut out = heading(&format!("{} stretches, {hours:.2} h, compared with {law}.", screened.pieces.len()));
    if let [Some(least), Some(lower), Some(median), Some(upper), Some(largest)] = coverage.unlike {
        out += &format!(
            "Mean squared residual (1 is usual): {least:.2} least, {lower:.2} lower quartile, \
             {median:.2} median, \
             {upper:.2} upper quartile, {largest:.2} largest.\n"
        );
    }
    let mut worst: Vec<&Screen> = screened.pieces.iter().filter(|p| p.unlike.is_some()).collect();
    worst.sort_by(|a, b| b.unlike.unwrap_or(0.0).total_cmp(&a.unlike.unwrap_or(0.0)));
    let mut table =
        TextTable::new(&["recording (least alike first)", ">from, s", ">until, s", ">residual (1 is usual)"]);
    for piece in worst.into_iter().take(ROWS) {
        let [from, until] = piece.interval.map(|t| format!("{t:.0}"));
        table.row([piece.recording.clone(), from, until, format!("{:.2}", piece.unlike.unwrap_or(f64::NAN))]);
    }
    out += &format!("\n{}", table.render());
    out += &listed("Lost input", &screened.lost);
    out
}
