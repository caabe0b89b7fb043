//! In which driving and where on the ground the mismatch shows.

use verdict::{Diagnosis, Trace};

use crate::figure::{Drawing, Figure, Map, PathOf, Paths};
use crate::thin;

/// Points of a path that are drawn.
const PATH_POINTS: usize = 2500;
/// Columns and rows of the map of kinds of driving, about.
const COLUMNS: usize = 9;

/// A quantity of each window: the first of these signals that was recorded, or the mean of two.
fn quantity(trace: &Trace, names: &[&str]) -> Option<(String, Vec<Option<f64>>)> {
    names.iter().find_map(|name| {
        let own: Vec<_> = trace.channels.iter().filter(|c| c.signal.contains(name)).collect();
        let first = own.first()?;
        let mean = |i: usize| {
            let values: Option<Vec<f64>> = own.iter().map(|c| c.recorded.get(i).copied().flatten()).collect();
            values.map(|v| v.iter().sum::<f64>() / v.len() as f64)
        };
        Some((format!("{name}, {}", first.unit), (0..trace.time.len()).map(mean).collect()))
    })
}

/// Mean mismatch over speed and turning, of all recordings.
pub(super) fn map(d: &Diagnosis) -> Option<Figure> {
    let mut labels = None;
    let mut windows: Vec<([f64; 2], f64, f64)> = Vec::new();
    for trace in &d.traces {
        let (x, speed) = quantity(trace, &["forward velocity", "wheel speed"])?;
        let (y, turning) = quantity(trace, &["yaw rate"])?;
        labels = Some((x, y));
        let step = trace.time.windows(2).map(|p| p[1] - p[0]).fold(f64::INFINITY, f64::min);
        let known = |i: usize| Some(([speed[i]?, turning[i]?], trace.before.get(i).copied().flatten()?, step));
        windows.extend((0..trace.time.len()).filter_map(known));
    }
    let (x, y) = labels?;
    let edges = |axis: usize| -> Option<Vec<f64>> {
        let values = || windows.iter().map(|w| w.0[axis]);
        let (low, high) = (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
        let width = nice((high - low) / COLUMNS as f64)?;
        let first = (low / width).floor() as i64;
        let last = (high / width).floor() as i64 + 1;
        Some((first..=last).map(|k| k as f64 * width).filter_map(thin::six_digits).collect())
    };
    let (x_edges, y_edges) = (edges(0)?, edges(1)?);
    let columns = x_edges.len() - 1;
    let mut sums = vec![(0.0, 0.0, 0.0); columns * (y_edges.len() - 1)];
    for ([speed, turning], mismatch, step) in &windows {
        let at = |edges: &[f64], v: f64| edges.partition_point(|e| *e <= v).clamp(1, edges.len() - 1) - 1;
        let sum = &mut sums[at(&y_edges, *turning) * columns + at(&x_edges, *speed)];
        *sum = (sum.0 + mismatch, sum.1 + 1.0, sum.2 + step);
    }
    let mean = |s: &(f64, f64, f64)| (s.1 > 0.0).then(|| s.0 / s.1).and_then(thin::six_digits);
    Some(Figure {
        title: "In which driving".to_owned(),
        caption: format!(
            "Mean squared mismatch of the simulation as it is, divided by that of the references \
             in the same kind of driving (1: no more than there); by {x} and {y}."
        ),
        table: (Vec::new(), Vec::new()),
        drawing: Drawing::Map(Map {
            values: sums.iter().map(mean).collect(),
            seconds: sums.iter().map(|s| s.2).collect(),
            x,
            y,
            x_edges,
            y_edges,
        }),
    })
}

/// The next wider of 1, 2, 5 times a power of ten.
fn nice(width: f64) -> Option<f64> {
    (width > 0.0 && width.is_finite()).then(|| {
        let power = 10.0_f64.powf(width.log10().floor());
        [1.0, 2.0, 5.0, 10.0].into_iter().map(|f| f * power).find(|w| *w >= width).unwrap_or(width)
    })
}

/// The paths on the ground, coloured by the mismatch, with the places that were found.
pub(super) fn paths(d: &Diagnosis) -> Option<Figure> {
    let path = |t: &Trace| {
        let every = t.path.len().div_ceil(PATH_POINTS).max(1);
        let at = || (0..t.path.len()).step_by(every);
        (t.path.len() == t.time.len() && !t.path.is_empty()).then(|| PathOf {
            name: t.recording.clone(),
            link: t.recording.clone(),
            time: at().map(|i| t.time[i]).collect(),
            path: at().map(|i| t.path[i]).collect(),
            value: at().map(|i| t.before.get(i).copied().flatten()).collect(),
        })
    };
    // Without mismatches a path would look as usual.
    let runs: Vec<PathOf> = d.traces.iter().filter(|t| !t.before.is_empty()).filter_map(path).collect();
    let discs: Vec<[f64; 3]> = d.ranked.iter().filter(|c| c.probability > 0.5).filter_map(|c| c.place).collect();
    let place = match discs.as_slice() {
        [[x, y, r], ..] => format!(" Dashed: the place that was found, within {r:.2} m of ({x:.2}, {y:.2}) m."),
        [] => String::new(),
    };
    (!runs.is_empty()).then(|| Figure {
        title: "On the ground".to_owned(),
        caption: format!(
            "Paths of the recordings, coloured by the mismatch of the simulation as it is, \
             divided by that of the references.{place}"
        ),
        table: (Vec::new(), Vec::new()),
        drawing: Drawing::Path(Paths { runs, discs }),
    })
}
