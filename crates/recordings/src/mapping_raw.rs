//! The shape of a mapping in TOML, before its values are checked. Spans tell the line of a complaint.

use std::collections::BTreeMap;

use serde::Deserialize;
use toml::Spanned;

/// The whole file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawMapping {
    pub(crate) name: Option<String>,
    #[serde(default)]
    pub(crate) self_describing: bool,
    pub(crate) files: Spanned<Vec<RawFile>>,
}

/// One `[[files]]` entry.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawFile {
    pub(crate) pattern: Option<Spanned<String>>,
    pub(crate) topic: Option<Spanned<String>>,
    pub(crate) clock: Option<String>,
    pub(crate) delimiter: Option<Spanned<String>>,
    pub(crate) decimal: Option<Spanned<String>>,
    pub(crate) time: Spanned<RawTime>,
    pub(crate) signals: BTreeMap<Spanned<String>, RawSignal>,
}

/// `time = { .. }`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawTime {
    pub(crate) column: Option<String>,
    pub(crate) unit: Option<Spanned<String>>,
    pub(crate) rate_hz: Option<Spanned<f64>>,
}

/// One signal's column.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawSignal {
    pub(crate) column: Spanned<String>,
    pub(crate) unit: Spanned<String>,
    pub(crate) sign: Option<Spanned<i64>>,
    pub(crate) scale: Option<Spanned<f64>>,
    #[serde(default)]
    pub(crate) magnitude_only: bool,
    pub(crate) dead_band: Option<Spanned<f64>>,
    pub(crate) kind: Option<Spanned<Kind>>,
    #[serde(default)]
    pub(crate) optional: bool,
}

/// `kind = ".."`.
#[derive(Deserialize, Clone, Copy, PartialEq)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Kind {
    SetPoint,
    Measured,
}
