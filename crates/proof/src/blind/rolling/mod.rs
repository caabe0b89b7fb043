//! `cargo xtask blind --kind odometry`, and `--kind gyro`: wheel counts beside a pose or a gyro alone, with something hidden.

use std::marker::PhantomData;
use std::path::PathBuf;

use examiner::rolling::{RollingPlan, RollingTruth, Seen};
use serde_json::Value;

use super::causes::{self, Asks};
use super::drawn::Subject;
use crate::document::Section;
use crate::output::Figure;

mod score;

/// What shows how the body moves, with the page of such cases and what is forecast.
pub(super) trait Beside {
    const SEEN: Seen;
    const PAGE: [&'static str; 2];
    /// Figure of the forecasts, and the beginning of the quantity's name in the verdict.
    const FORECAST: [&'static str; 2];
}

/// A pose.
pub(super) struct Pose;

impl Beside for Pose {
    const SEEN: Seen = Seen::Pose;
    const PAGE: [&'static str; 2] = ["blind-odometry.md", "Blind cases, wheel motion beside a pose"];
    const FORECAST: [&'static str; 2] =
        ["position after 10 s, left out: corrected over stated, median", "position after 10 s"];
}

/// A gyro alone.
pub(super) struct Gyro;

impl Beside for Gyro {
    const SEEN: Seen = Seen::Gyro;
    const PAGE: [&'static str; 2] = ["blind-gyro.md", "Blind cases, wheel motion beside a gyro alone"];
    const FORECAST: [&'static str; 2] =
        ["heading after 10 s, left out: corrected over stated, median", "heading after 10 s"];
}

/// Robots of which wheel motion is known, and this beside it.
pub(super) struct Rolling<B>(PhantomData<B>);

impl<B: Beside> Subject for Rolling<B> {
    type Plan = RollingPlan;
    type Truth = RollingTruth;
    type Row = score::Row;
    const PAGE: [&'static str; 2] = B::PAGE;
    const LAW: &'static str = "bodies that move first and wheels that follow";

    fn plans(seed: u64, count: usize, references: usize) -> Vec<RollingPlan> {
        RollingPlan::set(seed, count, B::SEEN, references)
    }

    fn name(plan: &RollingPlan) -> &str {
        &plan.name
    }

    fn draw(plan: &RollingPlan) -> (Vec<(PathBuf, Vec<u8>)>, RollingTruth) {
        let case = plan.draw();
        (case.files, case.truth)
    }

    fn row(truth: &RollingTruth, diagnosis: &Value, processor_seconds: Option<f64>) -> score::Row {
        score::row(truth, diagnosis, B::FORECAST[1], processor_seconds)
    }

    fn figures(rows: &[score::Row]) -> Vec<Figure> {
        let [forecast, _] = B::FORECAST;
        causes::figures(rows, &Asks { named: "hidden: named, or its class", held: [0.87, 0.93], forecast })
    }

    fn tables(rows: &[score::Row]) -> Vec<Section> {
        causes::tables(rows)
    }
}
