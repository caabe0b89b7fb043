//! `cargo xtask blind --kind wheeled`: torques, wheels, gyro and pose of robots of any wheels, with something hidden.

use std::path::PathBuf;

use examiner::wheeled::{WheeledPlan, WheeledTruth};
use serde_json::Value;

use super::causes::{self, Asks};
use super::drawn::Subject;
use crate::document::Section;
use crate::output::Figure;

mod score;

const ASKS: Asks = Asks {
    named: "hidden: named, or its class",
    held: [0.87, 0.93],
    forecast: "position after 2 s, left out: corrected over stated, median",
};

/// Robots of which torques, wheels, a gyro and a pose are known.
pub(super) struct AnyWheels;

impl Subject for AnyWheels {
    type Plan = WheeledPlan;
    type Truth = WheeledTruth;
    type Row = score::Row;
    const PAGE: [&'static str; 2] = ["blind-wheeled.md", "Blind cases of robots of any wheels"];
    const LAW: &'static str = "a plant of any wheels on brush tyres";

    fn plans(seed: u64, count: usize, references: usize) -> Vec<WheeledPlan> {
        WheeledPlan::set(seed, count, references)
    }

    fn name(plan: &WheeledPlan) -> &str {
        &plan.name
    }

    fn draw(plan: &WheeledPlan) -> (Vec<(PathBuf, Vec<u8>)>, WheeledTruth) {
        let case = plan.draw();
        (case.files, case.truth)
    }

    fn row(truth: &WheeledTruth, diagnosis: &Value, processor_seconds: Option<f64>) -> score::Row {
        score::row(truth, diagnosis, processor_seconds)
    }

    fn figures(rows: &[score::Row]) -> Vec<Figure> {
        causes::figures(rows, &ASKS)
    }

    fn tables(rows: &[score::Row]) -> Vec<Section> {
        causes::tables(rows)
    }
}
