//! Line charts from plain numbers.

use plotly::common::{DashType, Line as Stroke, Mode, Orientation, Title};
use plotly::configuration::DisplayModeBar;
use plotly::layout::{Annotation, Axis, Legend, Margin};
use plotly::{Configuration, Layout, Plot, Scatter};

/// About so many points per line are kept: a page then opens quickly, and peaks stay visible.
const POINTS: usize = 2000;

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
}

impl Line {
    /// A solid line.
    pub fn new(name: impl Into<String>, x: &[f64], y: &[f64]) -> Self {
        Self { name: name.into(), x: x.to_vec(), y: y.to_vec(), dashed: false }
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

impl Chart {
    /// The chart as the JSON that plotly.js draws, safe inside a script element.
    pub(crate) fn to_json(&self) -> String {
        let mut plot = Plot::new();
        for line in &self.lines {
            // A path may return to the same abscissa, so extremes per interval of x mean nothing there.
            let kept = if self.equal_scales { every_nth(&line.y) } else { extremes(&line.y) };
            let pick = |v: &[f64]| kept.iter().filter_map(|i| v.get(*i)).map(|v| six_digits(*v)).collect::<Vec<_>>();
            let stroke = Stroke::new().width(1.4).dash(if line.dashed { DashType::Dash } else { DashType::Solid });
            plot.add_trace(Scatter::new(pick(&line.x), pick(&line.y)).mode(Mode::Lines).name(&line.name).line(stroke));
        }
        let axis = |label: &str| Axis::new().title(Title::with_text(label)).zero_line(false).auto_margin(true);
        let y_axis = if self.equal_scales { axis(&self.y_label).scale_anchor("x") } else { axis(&self.y_label) };
        let marks =
            self.marks.iter().map(|(x, y, text)| Annotation::new().x(*x).y(*y).text(text).arrow_size(0.6)).collect();
        plot.set_layout(
            Layout::new()
                .x_axis(axis(&self.x_label))
                .y_axis(y_axis)
                .annotations(marks)
                .legend(Legend::new().orientation(Orientation::Horizontal).y(1.14))
                .margin(Margin::new().left(58).right(12).top(24).bottom(44))
                .height(320),
        );
        plot.set_configuration(Configuration::new().responsive(true).display_mode_bar(DisplayModeBar::False));
        plot.to_json().replace("</", "<\\/")
    }
}

/// Indices of the smallest and the largest value of each of [`POINTS`]/2 intervals, in order.
fn extremes(y: &[f64]) -> Vec<usize> {
    if y.len() <= POINTS {
        return (0..y.len()).collect();
    }
    let width = y.len().div_ceil(POINTS / 2);
    let mut kept = Vec::with_capacity(POINTS + 2);
    kept.push(0);
    for (n, part) in y.chunks(width).enumerate() {
        let place = |best: Option<(usize, &f64)>| n * width + best.map_or(0, |(i, _)| i);
        let low = place(part.iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1)));
        let high = place(part.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)));
        kept.extend([low.min(high), low.max(high)]);
    }
    kept.push(y.len() - 1);
    kept.dedup();
    kept
}

fn every_nth(y: &[f64]) -> Vec<usize> {
    (0..y.len()).step_by(y.len().div_ceil(POINTS).max(1)).collect()
}

/// Six significant digits: more are not seen in a figure.
fn six_digits(v: f64) -> f64 {
    format!("{v:.5e}").parse().unwrap_or(v)
}

#[cfg(test)]
mod tests {
    use super::{POINTS, extremes, six_digits};

    #[test]
    fn thinning_keeps_ends_peaks_and_order() {
        let mut y: Vec<f64> = (0..32_000).map(|i| (f64::from(i) * 1e-3).sin() * 0.1).collect();
        y[12_345] = 5.0;
        let kept = extremes(&y);
        assert!(kept.len() <= POINTS + 2 && kept.contains(&12_345));
        assert!(kept.windows(2).all(|p| p[0] < p[1]));
        assert_eq!((kept[0], kept[kept.len() - 1]), (0, 31_999));
        assert_eq!(extremes(&[1.0, 2.0]), vec![0, 1]);
    }

    #[test]
    fn digits_are_limited() {
        assert_eq!(six_digits(1.0 / 3.0), 0.333_333);
        assert!(six_digits(f64::NAN).is_nan());
    }
}
