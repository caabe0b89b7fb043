//! What a chart says, without how it looks: the page's script draws it in the colours of the moment.

use serde::Serialize;

use crate::chart::Chart;
use crate::table::Cell;

pub use crate::role::Role;

/// A chart with all that is reported about it.
#[derive(Debug, Clone)]
pub struct Figure {
    /// Heading above it; empty for none.
    pub title: String,
    /// What it shows, in words: caption, and what those get who do not see it.
    pub caption: String,
    /// The same as numbers: header and rows; empty where the caption says it all.
    pub table: (Vec<&'static str>, Vec<Vec<Cell>>),
    /// What is drawn.
    pub drawing: Drawing,
}

/// Kinds of charts.
#[derive(Debug, Clone, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Drawing {
    /// Signals over time, above one another.
    Time(TimePlot),
    /// Errors as bars.
    Bars(Bars),
    /// Values with their intervals.
    Intervals(Intervals),
    /// Stretches of time, one lane for each signal.
    Timeline(Timeline),
    /// Mismatch over two quantities.
    Map(Map),
    /// Mismatch along paths.
    Path(Paths),
    /// Plain lines.
    Lines(Chart),
}

impl Drawing {
    /// Whether a cursor can walk along it.
    pub(crate) fn has_cursor(&self) -> bool {
        match self {
            Self::Time(_) => true,
            Self::Lines(chart) => !chart.equal_scales,
            _ => false,
        }
    }

    /// Whether zooming it makes sense.
    pub(crate) fn zooms(&self) -> bool {
        matches!(self, Self::Time(_) | Self::Lines(_) | Self::Path(_))
    }

    /// JSON that is safe inside a script element: nothing in it can end that element.
    pub(crate) fn to_json(&self) -> String {
        // Numbers, strings and lists: nothing that JSON could refuse.
        serde_json::to_string(self).unwrap_or_default().replace('<', "\\u003c")
    }
}

/// Signals of one recording.
#[derive(Debug, Clone, Default, Serialize)]
pub struct TimePlot {
    /// Plots of the same recording share cursor and zoom.
    pub link: String,
    /// Times, s.
    pub time: Vec<f64>,
    /// Before these times every line is broken.
    pub gaps: Vec<usize>,
    /// Before these times simulated lines are broken: a free run begins.
    pub restarts: Vec<usize>,
    /// Signals, from top to bottom.
    pub rows: Vec<Row>,
}

/// One signal.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Row {
    /// Its name.
    pub name: String,
    /// Its unit.
    pub unit: String,
    /// Its lines.
    pub lines: Vec<RowLine>,
    /// Stretches to be marked in this row, s.
    pub spans: Vec<[f64; 2]>,
}

/// One line of a signal.
#[derive(Debug, Clone, Serialize)]
pub struct RowLine {
    /// What it stands for.
    pub role: Role,
    /// Values; `None` in gaps.
    pub y: Vec<Option<f64>>,
}

/// Errors of one quantity.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Bars {
    /// Unit.
    pub unit: String,
    /// Names of the recordings behind each bar.
    pub recordings: Vec<String>,
    /// The bars.
    pub bars: Vec<Bar>,
}

/// One bar: a mean, and what it is the mean of.
#[derive(Debug, Clone, Serialize)]
pub struct Bar {
    /// What it stands for.
    pub role: Role,
    /// Mean.
    pub value: f64,
    /// One value for each recording.
    pub each: Vec<f64>,
}

/// Values with their intervals.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Intervals {
    /// What is shown, with its unit.
    pub x: String,
    /// The value at which nothing is missing.
    pub neutral: f64,
    /// The values.
    pub rows: Vec<Interval>,
}

/// A value with its interval.
#[derive(Debug, Clone, Serialize)]
pub struct Interval {
    /// Name.
    pub name: String,
    /// Value.
    pub value: f64,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
    /// Whether the interval leaves out what is neutral.
    pub stands_out: bool,
}

/// Stretches of time.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Timeline {
    /// One for each signal of a recording.
    pub lanes: Vec<Lane>,
}

/// One lane of a timeline.
#[derive(Debug, Clone, Serialize)]
pub struct Lane {
    /// Name of the recording; lanes of one follow one another.
    pub recording: String,
    /// What is marked.
    pub signal: String,
    /// How long the recording is, s.
    pub length: f64,
    /// Where it is marked.
    pub spans: Vec<Marked>,
}

/// A marked stretch.
#[derive(Debug, Clone, Serialize)]
pub struct Marked {
    /// From, s.
    pub from: f64,
    /// Until, s.
    pub until: f64,
    /// Colour.
    pub role: Role,
    /// What it says when pointed at.
    pub text: String,
}

/// Mismatch over two quantities: cells between edges, row by row.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Map {
    /// Name of the first quantity with its unit.
    pub x: String,
    /// Name of the second quantity with its unit.
    pub y: String,
    /// Edges of the columns.
    pub x_edges: Vec<f64>,
    /// Edges of the rows.
    pub y_edges: Vec<f64>,
    /// Mismatch over the usual; `None` where nothing was driven.
    pub values: Vec<Option<f64>>,
    /// Seconds driven.
    pub seconds: Vec<f64>,
}

/// Paths on the ground.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Paths {
    /// One for each recording.
    pub runs: Vec<PathOf>,
    /// Places that were found: x, y, radius, m.
    pub discs: Vec<[f64; 3]>,
}

/// The path of a recording.
#[derive(Debug, Clone, Serialize)]
pub struct PathOf {
    /// Name of the recording.
    pub name: String,
    /// As in [`TimePlot::link`].
    pub link: String,
    /// Times, s.
    pub time: Vec<f64>,
    /// Positions, m.
    pub path: Vec<[f64; 2]>,
    /// Mismatch over the usual.
    pub value: Vec<Option<f64>>,
}
