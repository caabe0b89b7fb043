//! The truth of a case, opened after its seal was checked.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use anyhow::{Context, Result};
use examiner::Truth;
use serde::Deserialize;

use super::layout::Layout;
use super::seal::Seals;

/// Wheel speeds of both sides and yaw rate, row by row.
pub(crate) type Response = Vec<[f64; 3]>;

/// All that was hidden.
#[derive(Debug, Clone)]
pub(crate) struct Opened {
    pub(crate) truth: Truth,
    /// True responses by held-out drive.
    pub(crate) responses: BTreeMap<String, Response>,
}

/// Opens the truth of a case; refuses one that was changed since it was sealed.
pub(crate) fn open(layout: &Layout, name: &str, seals: &Seals) -> Result<Opened> {
    seals.of(name)?.check_truth(layout, name)?;
    let folder = layout.truth(name);
    let path = folder.join("truth.json");
    let text = fs::read_to_string(&path).with_context(|| format!("cannot read '{}'", path.display()))?;
    let truth: Truth = serde_json::from_str(&text).with_context(|| format!("'{}' is no truth", path.display()))?;
    let responses = truth
        .heldout
        .keys()
        .map(|drive| Ok((drive.clone(), response(&folder.join("heldout").join(format!("{drive}.csv")))?)))
        .collect::<Result<_>>()?;
    Ok(Opened { truth, responses })
}

/// Reads a true or predicted response.
pub(crate) fn response(path: &Path) -> Result<Response> {
    #[derive(Deserialize)]
    struct Row {
        #[serde(rename = "wheel_speed_left_rad_s")]
        left: f64,
        #[serde(rename = "wheel_speed_right_rad_s")]
        right: f64,
        #[serde(rename = "yaw_rate_rad_s")]
        yaw: f64,
    }
    let mut reader = csv::Reader::from_path(path).with_context(|| format!("cannot read '{}'", path.display()))?;
    let rows = reader.deserialize::<Row>().map(|row| {
        row.map(|r| [r.left, r.right, r.yaw]).with_context(|| format!("'{}' is no table of responses", path.display()))
    });
    rows.collect()
}
