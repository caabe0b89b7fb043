//! A robot file made of a model in URDF, SDF or MJCF.

use std::path::Path;

use anyhow::{Context, Result};
use case_files::envelope::Program;
use model_import::{Asked, Imported, Number, import};
use pages::text_table::{TextTable, number};
use serde_json::json;

use super::super::Outcome;
use super::{Args, Kind, Rollers};
use crate::console::{emit, emit_json, warning};

/// Reads a model.
pub(super) fn read(args: &Args, model: &Path) -> Result<Imported> {
    let shown = model.display().to_string();
    let text = std::fs::read_to_string(model)
        .with_context(|| format!("cannot read '{shown}'; give a model in URDF, SDF or MJCF"))?;
    let asked = Asked {
        kind: args.kind.map(|kind| match kind {
            Kind::TorqueDriven => model_import::Kind::TorqueDriven,
            Kind::SpeedDriven => model_import::Kind::SpeedDriven,
            Kind::CommandDriven => model_import::Kind::CommandDriven,
            Kind::Odometry => model_import::Kind::Odometry,
            Kind::Car => model_import::Kind::Car,
            Kind::Wheeled => model_import::Kind::Wheeled,
        }),
        rollers: args.rollers.map(|rollers| match rollers {
            Rollers::Omni => model_import::Rollers::Omni,
            Rollers::Mecanum => model_import::Rollers::Mecanum,
        }),
        wheel_radius: args.wheel_radius,
        name: args.name.clone(),
    };
    Ok(import(&shown, &text, &asked)?)
}

/// Makes the robot file.
pub(super) fn run(args: &Args, model: &Path) -> Result<Outcome> {
    let made = read(args, model)?;
    if args.out != "-" {
        std::fs::write(&args.out, &made.text).with_context(|| format!("cannot write '{}'", args.out))?;
    }
    if let Some(target) = &args.json {
        let numbers: Vec<_> = made.numbers.iter().map(as_json).collect();
        let whole = json!({
            "format": 1,
            "program": Program::default(),
            "kind": made.kind.name(),
            "layout": made.layout,
            "robot_file": made.text,
            "numbers": numbers,
            "notes": made.notes,
        });
        emit_json(target, &whole)?;
    } else if args.out == "-" {
        emit(&made.text)?;
    } else {
        emit(&text(&made, model, &args.out))?;
    }
    if args.json.is_some() || args.out == "-" {
        made.notes.iter().for_each(|note| warning(note));
    }
    Ok(Outcome::Done)
}

fn as_json(n: &Number) -> serde_json::Value {
    json!({ "name": n.name, "value": n.value, "unit": n.unit, "source": n.source, "stated": n.is_stated })
}

/// What was read, and what comes next.
fn text(made: &Imported, model: &Path, out: &str) -> String {
    let mut table = TextTable::new(&["number", ">value", "unit", "from"]);
    for n in &made.numbers {
        table.row([n.name.clone(), number(n.value), n.unit.clone(), n.source.clone()]);
    }
    let guessed = made.numbers.iter().filter(|n| !n.is_stated).count();
    let notes = made.notes.iter().fold(String::new(), |all, note| all + "- " + note + ".\n");
    let guesses = match guessed {
        0 => String::new(),
        1 => "One number is a guess: correct it where you know better.\n".to_owned(),
        n => format!("{n} numbers are guesses: correct those that you know better.\n"),
    };
    format!(
        "'{}' is {}; '{out}' is a robot file of kind {}.\n\n{}\n{guesses}{notes}Next: lacuna diagnose --robot {out} \
         --recordings drives/\n",
        model.display(),
        made.layout,
        made.kind.name(),
        table.render()
    )
}
