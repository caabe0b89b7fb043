//! `cargo xtask blind --kind car`: throttle, steering and a pose of cars, with something hidden.

use std::path::PathBuf;

use examiner::car::{CarPlan, CarTruth};
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

/// Cars of which commands and a pose are known.
pub(super) struct Cars;

impl Subject for Cars {
    type Plan = CarPlan;
    type Truth = CarTruth;
    type Row = score::Row;
    const PAGE: [&'static str; 2] = ["blind-car.md", "Blind cases of cars"];
    const LAW: &'static str = "a two-axle car on brush tyres";

    fn plans(seed: u64, count: usize, references: usize) -> Vec<CarPlan> {
        CarPlan::set(seed, count, references)
    }

    fn name(plan: &CarPlan) -> &str {
        &plan.name
    }

    fn draw(plan: &CarPlan) -> (Vec<(PathBuf, Vec<u8>)>, CarTruth) {
        let case = plan.draw();
        (case.files, case.truth)
    }

    fn row(truth: &CarTruth, diagnosis: &Value, processor_seconds: Option<f64>) -> score::Row {
        score::row(truth, diagnosis, processor_seconds)
    }

    fn figures(rows: &[score::Row]) -> Vec<Figure> {
        causes::figures(rows, &ASKS)
    }

    fn tables(rows: &[score::Row]) -> Vec<Section> {
        causes::tables(rows)
    }
}
