//! `lacuna explain`: the whole card of one effect.

use anyhow::Result;
use case_files::envelope::Program;
use clap::Args as ClapArgs;
use recordings::suggest;
use report::text_table::TextTable;
use robot_file::cards::{FORMAT, as_json, cards, wears};
use robot_model::Card;
use serde_json::json;

use super::{Outcome, Usage};
use crate::console::{emit, emit_json, heading};

const EXAMPLES: &str = "\
Examples:
  lacuna explain payload
  lacuna explain gyro_bias --json -

Exit codes: 0 done, 1 failed, 2 wrong usage.";

/// Arguments of `lacuna explain`.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// Id of the effect, as `lacuna effects` lists it.
    effect: String,
    /// Write the card as JSON to a file; `-` is standard output, instead of the text.
    #[arg(long, value_name = "FILE|-")]
    json: Option<String>,
}

/// Explains an effect.
pub(crate) fn run(args: &Args) -> Result<Outcome> {
    let cards = cards();
    let id = args.effect.to_lowercase().replace(['-', ' '], "_");
    let Some(card) = cards.iter().find(|c| c.id == id) else {
        let ids: Vec<&str> = cards.iter().map(|c| c.id).collect();
        let hint = suggest::hint(&id, &ids);
        return Err(Usage(format!("no effect is called `{}`; {hint}", args.effect)).into());
    };
    if let Some(target) = &args.json {
        emit_json(target, &json!({ "format": FORMAT, "program": Program::default(), "effect": as_json(card) }))?;
    }
    if args.json.as_deref() != Some("-") {
        emit(&render(card))?;
    }
    Ok(Outcome::Done)
}

fn render(card: &Card) -> String {
    let mut out = heading(&format!("{} ({})", card.name, card.id));
    let mut line = |key: &str, text: &str| {
        if !text.is_empty() {
            out += &format!("  {key:<13}{text}\n");
        }
    };
    line("kind", card.kind.name());
    line("law", card.law);
    line("one sees", card.seen);
    line("sign", if card.signed { "either" } else { "" });
    line("axes", &card.axes.join(", "));
    line("looked for", &wears(card).join("; "));
    line("revealed by", card.revealed_by);
    line("resembles", card.resembles);
    line("shows in", card.redundancy.shows_in().unwrap_or_default());
    let unit = card.strengths().next().map_or("-", |i| card.parameters[i].unit);
    let unit = if unit == "-" { String::new() } else { format!(" {unit}") };
    if card.interest > 0.0 {
        line("matters from", &format!("{}{unit}", card.interest));
    }
    line("source", card.source);
    let mut table = TextTable::new(&["parameter", "unit", ">lowest", ">highest", ">neutral", "role", "bounds in"]);
    for p in card.parameters {
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
    out + "\n" + &table.render()
}
