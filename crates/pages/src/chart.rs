//! Line charts from plain numbers.

use serde::ser::{Serialize, SerializeStruct, Serializer};
use serde_json::json;

use crate::role::Role;
use crate::thin;

/// About so many points per line are kept: peaks stay visible, and pages of many lines small.
const POINTS: usize = 4000;

/// One line of a chart.
#[derive(Debug, Clone, Default)]
pub struct Line {
    /// What the legend calls it.
    pub name: String,
    /// Abscissae.
    pub x: Vec<f64>,
    /// Ordinates, as many.
    pub y: Vec<f64>,
    /// Drawn dashed.
    pub dashed: bool,
    /// Drawn in the colour of what it stands for, if it is one of these.
    pub role: Option<Role>,
    /// Drawn as points, each with its interval, instead of a line; one for each point, or none.
    pub intervals: Vec<[f64; 2]>,
}

impl Line {
    /// A solid line.
    pub fn new(name: impl Into<String>, x: &[f64], y: &[f64]) -> Self {
        Self { name: name.into(), x: x.to_vec(), y: y.to_vec(), ..Self::default() }
    }

    /// The same line, dashed.
    #[must_use]
    pub fn dashed(self) -> Self {
        Self { dashed: true, ..self }
    }
}

/// A line chart.
#[derive(Debug, Clone, Default)]
pub struct Chart {
    /// Caption below the chart.
    pub caption: String,
    /// Label of the abscissa with its unit.
    pub x_label: String,
    /// Label of the ordinate with its unit.
    pub y_label: String,
    /// Same scale on both axes, for paths.
    pub equal_scales: bool,
    /// The lines.
    pub lines: Vec<Line>,
    /// Labels at points of the chart.
    pub marks: Vec<(f64, f64, String)>,
}

impl Serialize for Chart {
    /// As the page's script reads it: thinned, abscissae that lines share once.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut abscissae: Vec<Vec<Option<f64>>> = Vec::new();
        let lines: Vec<_> = self.lines.iter().map(|line| self.line(line, &mut abscissae)).collect();
        let mut out = serializer.serialize_struct("Chart", 6)?;
        out.serialize_field("x_label", &self.x_label)?;
        out.serialize_field("y_label", &self.y_label)?;
        out.serialize_field("equal", &self.equal_scales)?;
        out.serialize_field("x", &abscissae)?;
        out.serialize_field("lines", &lines)?;
        out.serialize_field("marks", &self.marks)?;
        out.end()
    }
}

impl Chart {
    fn line(&self, line: &Line, abscissae: &mut Vec<Vec<Option<f64>>>) -> serde_json::Value {
        let count = line.x.len().min(line.y.len());
        let y: Vec<Option<f64>> = line.y[..count].iter().map(|v| thin::six_digits(*v)).collect();
        // A path may return to the same abscissa, so extremes per interval of x mean nothing there.
        let (at, y) = if self.equal_scales {
            let at: Vec<usize> = (0..count).step_by(count.div_ceil(POINTS).max(1)).collect();
            let y = at.iter().map(|i| y[*i]).collect();
            (at, y)
        } else {
            let size = thin::group(count, POINTS);
            (thin::places(count, size), thin::extremes(&y, size))
        };
        let x: Vec<Option<f64>> = at.iter().map(|i| thin::six_digits(line.x[*i])).collect();
        let place = abscissae.iter().position(|known| *known == x).unwrap_or_else(|| {
            abscissae.push(x);
            abscissae.len() - 1
        });
        json!({
            "name": line.name, "x": place, "y": y, "dashed": line.dashed, "role": line.role, "intervals": line.intervals,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{Chart, Line, POINTS};

    #[test]
    fn lines_share_their_abscissae_and_keep_their_peaks() {
        let x: Vec<f64> = (0..32_000).map(|i| f64::from(i) * 1e-3).collect();
        let mut y = x.clone();
        y[12_345] = 99.0;
        let chart = Chart { lines: vec![Line::new("a", &x, &y), Line::new("b", &x, &x)], ..Chart::default() };
        let json = serde_json::to_value(&chart).expect("serialises");
        assert_eq!(json["x"].as_array().map(Vec::len), Some(1));
        let kept = json["lines"][0]["y"].as_array().expect("a list");
        assert!(kept.len() <= POINTS && kept.contains(&99.0.into()));
    }
}
