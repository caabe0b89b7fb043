//! `cargo xtask blind --kind odometry`, and `--kind gyro`: wheel counts beside a pose or a gyro alone, with something hidden.

use std::path::PathBuf;

use examiner::rolling::{RollingPlan, RollingTruth, Seen};
use serde_json::Value;

use super::causes::{self, Asks};
use super::drawn::Subject;
use crate::document::Section;
use crate::output::Figure;

mod score;

const ASKS: Asks = Asks {
    named: "hidden: named, or its class",
    held: [0.87, 0.93],
    forecast: "position after 10 s, left out: corrected over stated, median",
};

/// The same of turning alone.
const ASKS_OF_GYRO: Asks = Asks { forecast: "heading after 10 s, left out: corrected over stated, median", ..ASKS };

/// Robots of which wheel motion and a pose are known.
pub(super) struct Rolling;

impl Subject for Rolling {
    type Plan = RollingPlan;
    type Truth = RollingTruth;
    type Row = score::Row;
    const PAGE: [&'static str; 2] = ["blind-odometry.md", "Blind cases, wheel motion beside a pose"];
    const LAW: &'static str = "bodies that move first and wheels that follow";

    fn plans(seed: u64, count: usize) -> Vec<RollingPlan> {
        RollingPlan::set(seed, count, Seen::Pose)
    }

    fn name(plan: &RollingPlan) -> &str {
        &plan.name
    }

    fn draw(plan: &RollingPlan) -> (Vec<(PathBuf, Vec<u8>)>, RollingTruth) {
        let case = plan.draw();
        (case.files, case.truth)
    }

    fn row(truth: &RollingTruth, diagnosis: &Value, processor_seconds: Option<f64>) -> score::Row {
        score::row(truth, diagnosis, processor_seconds)
    }

    fn figures(rows: &[score::Row]) -> Vec<Figure> {
        causes::figures(rows, &ASKS)
    }

    fn tables(rows: &[score::Row]) -> Vec<Section> {
        causes::tables(rows)
    }
}

/// Robots of which wheel motion and a gyro are known.
pub(super) struct ByGyro;

impl Subject for ByGyro {
    type Plan = RollingPlan;
    type Truth = RollingTruth;
    type Row = score::Row;
    const PAGE: [&'static str; 2] = ["blind-gyro.md", "Blind cases, wheel motion beside a gyro alone"];
    const LAW: &'static str = "bodies that move first and wheels that follow";

    fn plans(seed: u64, count: usize) -> Vec<RollingPlan> {
        RollingPlan::set(seed, count, Seen::Gyro)
    }

    fn name(plan: &RollingPlan) -> &str {
        &plan.name
    }

    fn draw(plan: &RollingPlan) -> (Vec<(PathBuf, Vec<u8>)>, RollingTruth) {
        let case = plan.draw();
        (case.files, case.truth)
    }

    fn row(truth: &RollingTruth, diagnosis: &Value, processor_seconds: Option<f64>) -> score::Row {
        score::row(truth, diagnosis, processor_seconds)
    }

    fn figures(rows: &[score::Row]) -> Vec<Figure> {
        causes::figures(rows, &ASKS_OF_GYRO)
    }

    fn tables(rows: &[score::Row]) -> Vec<Section> {
        causes::tables(rows)
    }
}
