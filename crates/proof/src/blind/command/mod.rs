//! `cargo xtask blind --kind command`: command-driven cases with something hidden.

use std::path::PathBuf;

use examiner::command::{CommandPlan, CommandTruth};
use serde_json::Value;

use super::causes::{self, Asks};
use super::drawn::Subject;
use crate::document::Section;
use crate::output::Figure;

mod score;

const ASKS: Asks = Asks {
    named: "hidden: named",
    held: [0.86, 0.94],
    forecast: "position after 2 s, left out: corrected over simulated, median",
};

/// Command-driven robots.
pub(super) struct CommandDriven;

impl Subject for CommandDriven {
    type Plan = CommandPlan;
    type Truth = CommandTruth;
    type Row = score::Row;
    const PAGE: [&'static str; 2] = ["blind-command.md", "Blind cases, command-driven"];
    const LAW: &'static str = "a discrete controller with wheels of second order behind it";

    fn plans(seed: u64, count: usize, references: usize) -> Vec<CommandPlan> {
        CommandPlan::set(seed, count, references)
    }

    fn name(plan: &CommandPlan) -> &str {
        &plan.name
    }

    fn draw(plan: &CommandPlan) -> (Vec<(PathBuf, Vec<u8>)>, CommandTruth) {
        let case = plan.draw();
        (case.files, case.truth)
    }

    fn row(truth: &CommandTruth, diagnosis: &Value, processor_seconds: Option<f64>) -> score::Row {
        score::row(truth, diagnosis, processor_seconds)
    }

    fn figures(rows: &[score::Row]) -> Vec<Figure> {
        causes::figures(rows, &ASKS)
    }

    fn tables(rows: &[score::Row]) -> Vec<Section> {
        causes::tables(rows)
    }
}
