//! `lacuna law`: the law that a diagnosis found, as a file of one's own.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};
use case_files::envelope::Envelope;
use clap::Args as ClapArgs;
use law::Law;
use serde::Serialize;
use verdict::{CommonLaw, FoundLaw, LawNumber, UnnamedCause};

use super::Outcome;
use crate::console::emit;

const EXAMPLES: &str = "\
Examples:
  lacuna diagnose case/ --json verdict.json
  lacuna law verdict.json
  lacuna law verdict.json --save my-law.toml
  lacuna diagnose other-case/ --effects my-law.toml
  lacuna law verdict.json --in-every-drive --save flaw.toml
  lacuna diagnose case/ --adopt flaw.toml

Exit codes: 0 done, 1 failed, 2 wrong usage.";

/// Arguments of `lacuna law`.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// What `lacuna diagnose ... --json VERDICT.json` wrote.
    #[arg(value_name = "VERDICT.json")]
    verdict: PathBuf,
    /// Write the law to a file: a name, formula, numbers with intervals, range seen. `--effects FILE.toml` of other commands
    /// takes it as an effect of your own.
    #[arg(long, value_name = "FILE.toml")]
    save: Option<PathBuf>,
    /// Instead of the law of what differs, the one that references and recordings have alike: what the simulation lacks in
    /// every drive. `--adopt FILE.toml` of other commands makes it part of the simulation.
    #[arg(long)]
    in_every_drive: bool,
}

/// A law as a file.
#[derive(Serialize)]
struct Card<'a> {
    /// Its name as an effect of one's own.
    name: String,
    /// Where it acts.
    place: &'a str,
    /// Share of the excess cost that it leaves.
    #[serde(skip_serializing_if = "Option::is_none")]
    left: Option<f64>,
    /// The verdict that it is of.
    verdict: String,
    /// Formula and range seen, as the crate `law` reads them.
    law: Law,
    /// Numbers with half widths of their 90 % intervals.
    numbers: &'a [LawNumber],
}

/// Prints the law, and saves it where that was asked for.
pub(crate) fn run(args: &Args) -> Result<Outcome> {
    let envelope = Envelope::open(&args.verdict)?;
    let verdict = args.verdict.to_string_lossy().into_owned();
    let cause = envelope.diagnosis.law.as_ref();
    let found = if args.in_every_drive { common(cause, &verdict)? } else { of_what_differs(cause, &verdict)? };
    let law =
        Law::of_formula(found.formula, found.seen).with_context(|| format!("the law in '{verdict}' cannot be used"))?;
    emit(&format!("{law}\n"))?;
    if let Some(target) = &args.save {
        let card =
            Card { name: name_of(target), place: found.place, left: found.left, verdict, law, numbers: found.numbers };
        std::fs::write(target, toml::to_string(&card)?)
            .with_context(|| format!("cannot write '{}'", target.display()))?;
    }
    Ok(Outcome::Done)
}

/// A law that a verdict holds.
struct Found<'a> {
    place: &'a str,
    formula: &'a str,
    seen: &'a BTreeMap<String, [f64; 2]>,
    left: Option<f64>,
    numbers: &'a [LawNumber],
}

/// The law of what differs.
fn of_what_differs<'a>(cause: Option<&'a UnnamedCause>, file: &str) -> Result<Found<'a>> {
    if let Some(law) = cause.and_then(|cause| cause.law.as_ref()) {
        let FoundLaw { place, formula, seen, left, numbers, .. } = law;
        return Ok(Found { place, formula, seen, left: Some(*left), numbers });
    }
    if let Some(events) = cause.and_then(|cause| cause.events.as_ref()) {
        bail!(
            "'{file}' holds no law but {} events at the {}, which no law predicts; its JSON lists them in `law.events`, \
             and `lacuna report` shows them",
            events.events.len(),
            events.place
        );
    }
    bail!("'{file}' holds no law; one is looked for where the cause is unknown, or with `diagnose --law always`");
}

/// The law that references and recordings have alike.
fn common<'a>(cause: Option<&'a UnnamedCause>, file: &str) -> Result<Found<'a>> {
    let law = cause.and_then(|cause| cause.in_every_drive.as_ref()).with_context(|| {
        format!(
            "'{file}' holds no law that the simulation lacks in every drive; one is looked for with references and \
             `diagnose --law always`"
        )
    })?;
    let CommonLaw { place, formula, seen, .. } = law;
    let needs_ranges = formula.parse::<Law>().is_ok_and(|law| !law.variables().is_empty());
    ensure!(
        !seen.is_empty() || !needs_ranges,
        "'{file}' does not say in which range its law was seen, as older programs wrote it; run `lacuna diagnose ... --law always \
         --json '{file}'` again"
    );
    Ok(Found { place, formula, seen, left: None, numbers: &[] })
}

/// The name of an effect that a file's name gives: small letters, digits, '-' and '_', a letter first.
fn name_of(file: &Path) -> String {
    let stem = file.file_stem().map(|s| s.to_string_lossy().to_lowercase()).unwrap_or_default();
    let plain = |c: char| if c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_' { c } else { '-' };
    let name: String = stem.chars().map(plain).collect();
    if name.starts_with(|c: char| c.is_ascii_lowercase()) { name } else { format!("law-{name}") }
}
