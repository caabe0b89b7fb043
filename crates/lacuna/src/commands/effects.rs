//! `lacuna effects`: the catalogue at a glance.

use anyhow::Result;
use clap::Args as ClapArgs;
use serde_json::{Value, json};

use super::Outcome;
use crate::console::{emit, emit_json};
use lacuna::cards::{FORMAT, as_json, cards};
use lacuna::envelope::Program;
use lacuna::text_table::TextTable;

const EXAMPLES: &str = "\
Examples:
  lacuna effects
  lacuna effects --json -

Exit codes: 0 done, 1 failed, 2 wrong usage.";

/// Arguments of `lacuna effects`.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// Write the cards as JSON to a file; `-` is standard output, instead of the table.
    #[arg(long, value_name = "FILE|-")]
    json: Option<String>,
}

/// Lists the effects.
pub(crate) fn run(args: &Args) -> Result<Outcome> {
    if let Some(target) = &args.json {
        let all: Vec<Value> = cards().into_iter().map(as_json).collect();
        emit_json(target, &json!({ "format": FORMAT, "program": Program::default(), "effects": all }))?;
    }
    if args.json.as_deref() != Some("-") {
        emit(&render())?;
    }
    Ok(Outcome::Done)
}

fn render() -> String {
    let mut table = TextTable::new(&["effect", "name", "kind", "parameters", "revealed by"]);
    for card in cards() {
        let parameters: Vec<String> = card
            .parameters
            .iter()
            .map(|p| if p.unit == "-" { p.name.to_owned() } else { format!("{} ({})", p.name, p.unit) })
            .collect();
        table.row([
            card.id.to_owned(),
            card.name.to_owned(),
            card.kind.name().to_owned(),
            parameters.join(", "),
            card.revealed_by.to_owned(),
        ]);
    }
    format!("{}\n`lacuna explain EFFECT` shows all about one.\n", table.render())
}
