//! `lacuna effects`: the catalogue at a glance.

use anyhow::Result;
use case_files::envelope::Program;
use clap::Args as ClapArgs;
use pages::text_table::TextTable;
use robot_file::catalogue_json::FORMAT;
use robot_file::catalogue_json::cause_json;
use robot_file::catalogue_json::effects_json;
use serde_json::{Value, json};

use super::Outcome;
use crate::console::{emit, emit_json};

const EXAMPLES: &str = "\
Examples:
  lacuna effects
  lacuna effects --json -

Exit codes: 0 done, 1 failed, 2 wrong usage.";

/// Arguments of `lacuna effects`.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// Write the catalogue as JSON to a file; `-` is standard output, instead of the table.
    #[arg(long, value_name = "FILE|-")]
    json: Option<String>,
}

/// Lists the effects.
pub(crate) fn run(args: &Args) -> Result<Outcome> {
    if let Some(target) = &args.json {
        let causes: Vec<Value> = catalogue::causes().map(cause_json).collect();
        emit_json(
            target,
            &json!({ "format": FORMAT, "program": Program::default(), "effects": effects_json(), "causes": causes }),
        )?;
    }
    if args.json.as_deref() != Some("-") {
        emit(&render())?;
    }
    Ok(Outcome::Done)
}

fn render() -> String {
    let mut effects = TextTable::new(&["effect", "name", "kind", "parameters", "revealed by"]);
    for spec in catalogue::effects() {
        let parameters: Vec<String> = spec
            .parameters
            .iter()
            .map(|p| if p.unit == "-" { p.name.to_owned() } else { format!("{} ({})", p.name, p.unit) })
            .collect();
        effects.row([
            spec.id.to_owned(),
            spec.name.to_owned(),
            spec.kind.name().to_owned(),
            parameters.join(", "),
            spec.revealed_by.to_owned(),
        ]);
    }

    let mut causes = TextTable::new(&["cause", "name", "robots", "unit", "revealed by"]);
    for cause in catalogue::causes() {
        causes.row([cause.id, cause.name, cause.robots, cause.unit, cause.revealed_by].map(str::to_owned));
    }

    format!(
        "{}\nCauses of command-driven and speed-driven robots, and answers that name no cause:\n\n{}\n`lacuna explain NAME` shows all about \
         one.\n",
        effects.render(),
        causes.render()
    )
}
