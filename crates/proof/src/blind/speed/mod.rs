//! `cargo xtask blind --kind speed`: speed-driven cases with something hidden.

use std::path::PathBuf;

use examiner::speed::{SpeedPlan, SpeedTruth};
use serde_json::Value;

use super::drawn::Subject;
use crate::document::Section;
use crate::output::Figure;

mod figures;
mod score;

/// Speed-driven robots.
pub(super) struct SpeedDriven;

impl Subject for SpeedDriven {
    type Plan = SpeedPlan;
    type Truth = SpeedTruth;
    type Row = score::Row;
    const PAGE: [&'static str; 2] = ["blind-speed.md", "Blind cases, speed-driven"];
    const LAW: &'static str = "a law of steady torques";

    fn plans(seed: u64, count: usize, _: usize) -> Vec<SpeedPlan> {
        SpeedPlan::set(seed, count)
    }

    fn name(plan: &SpeedPlan) -> &str {
        &plan.name
    }

    fn draw(plan: &SpeedPlan) -> (Vec<(PathBuf, Vec<u8>)>, SpeedTruth) {
        let case = plan.draw();
        (case.files, case.truth)
    }

    fn row(truth: &SpeedTruth, diagnosis: &Value, processor_seconds: Option<f64>) -> score::Row {
        score::row(truth, diagnosis, processor_seconds)
    }

    fn figures(rows: &[score::Row]) -> Vec<Figure> {
        figures::figures(rows)
    }

    fn tables(rows: &[score::Row]) -> Vec<Section> {
        vec![figures::wrong(rows)]
    }
}
