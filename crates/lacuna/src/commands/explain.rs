//! `lacuna explain`: all that is known about a name that a verdict can contain.

use super::{Outcome, Usage};
use crate::console::{emit, emit_json, heading};
use anyhow::Result;
use case_files::envelope::Program;
use catalogue::{CauseSpec, Entry};
use clap::Args as ClapArgs;
use pages::text_table::TextTable;
use recordings::suggest;
use robot_file::catalogue_json::FORMAT;
use robot_file::catalogue_json::cause_json;
use robot_file::catalogue_json::effect_json;
use robot_model::EffectSpec;
use serde_json::{Value, json};

const EXAMPLES: &str = "\
Examples:
  lacuna explain payload
  lacuna explain effective_track
  lacuna explain gyro_bias --json -

Exit codes: 0 done, 1 failed, 2 wrong usage.";

/// Arguments of `lacuna explain`.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// Id of the effect or cause, as `lacuna effects` lists it.
    effect: String,
    /// Write it as JSON to a file; `-` is standard output, instead of the text.
    #[arg(long, value_name = "FILE|-")]
    json: Option<String>,
}

/// Explains an effect or a cause.
pub(crate) fn run(args: &Args) -> Result<Outcome> {
    let id = args.effect.to_lowercase().replace(['-', ' '], "_");
    let Some(entry) = catalogue::find(&id) else {
        let ids: Vec<&str> = catalogue::names().collect();
        let hint = suggest::hint(&id, &ids);
        return Err(Usage(format!("no effect is called `{}`; {hint}", args.effect)).into());
    };

    if let Some(target) = &args.json {
        emit_json(target, &as_json(&entry))?;
    }
    if args.json.as_deref() != Some("-") {
        let known = entry.effect.map(effect).into_iter().chain(entry.cause.map(cause));
        emit(&known.collect::<Vec<_>>().join("\n"))?;
    }
    Ok(Outcome::Done)
}

fn as_json(entry: &Entry) -> Value {
    let mut out = json!({ "format": FORMAT, "program": Program::default() });
    if let Some(effect) = entry.effect {
        out["effect"] = effect_json(effect);
    }
    if let Some(cause) = entry.cause {
        out["cause"] = cause_json(cause);
    }
    out
}

/// A heading and what is known, line by line; what is empty is left out.
fn lines(name: &str, id: &str, known: &[(&str, &str)]) -> String {
    let known = known.iter().filter(|(_, text)| !text.is_empty());
    known.fold(heading(&format!("{name} ({id})")), |out, (key, text)| out + &format!("  {key:<13}{text}\n"))
}

fn cause(spec: &CauseSpec) -> String {
    lines(
        spec.name,
        spec.id,
        &[
            ("robots", spec.robots),
            ("meaning", spec.meaning),
            ("size", spec.size),
            ("unit", if spec.size.is_empty() { "" } else { spec.unit }),
            ("recognised", spec.recognised),
            ("revealed by", spec.revealed_by),
            ("resembles", spec.resembles),
        ],
    )
}

fn effect(spec: &EffectSpec) -> String {
    let unit = spec.strengths().next().map_or("-", |i| spec.parameters[i].unit);
    let unit = if unit == "-" { String::new() } else { format!(" {unit}") };
    let interest =
        if spec.interest > 0.0 { format!("{}{unit}{}", spec.interest, spec.sized_by.words()) } else { String::new() };
    let text = lines(
        spec.name,
        spec.id,
        &[
            ("kind", spec.kind.name()),
            ("law", spec.law),
            ("one sees", spec.seen),
            ("sign", if spec.signed { "either" } else { "" }),
            ("axes", &spec.axes.join(", ")),
            ("looked for", &spec.scopes.forms().collect::<Vec<_>>().join("; ")),
            ("on", spec.on()),
            ("revealed by", spec.revealed_by),
            ("resembles", spec.resembles),
            ("shows in", spec.redundancy.shows_in().unwrap_or_default()),
            ("matters from", &interest),
            ("source", spec.source),
        ],
    );

    let mut table = TextTable::new(&["parameter", "unit", ">lowest", ">highest", ">neutral", "role", "bounds in"]);
    for p in spec.parameters {
        table.row([
            p.name.to_owned(),
            p.unit.to_owned(),
            p.bounds[0].to_string(),
            p.bounds[1].to_string(),
            p.neutral.to_string(),
            p.role.name().to_owned(),
            p.counted_in().to_owned(),
        ]);
    }
    text + "\n" + &table.render()
}
