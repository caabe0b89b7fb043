//! A picture of how often answers are right over how sure they were, as SVG.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use serde::Serialize;

use crate::chart::{Chart, Line};
use crate::drawing::{CORRECTED, FRAME, INK, PAPER, PictureError, SOFT, failed};
use crate::figure::Role;

/// Answers of similar confidence.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Bin {
    /// Confidence above which answers count.
    pub above: f64,
    /// Confidence up to which they count.
    pub until: f64,
    /// Number of answers.
    pub count: usize,
    /// Their mean confidence.
    pub confidence: f64,
    /// Share of them that is right.
    pub right: f64,
    /// 95 % interval of that share.
    pub interval: [f64; 2],
}

/// The same picture for a page.
pub fn chart(bins: &[Bin]) -> Chart {
    let filled = || bins.iter().filter(|b| b.count > 0);
    let [x, y] = [|b: &Bin| b.confidence, |b: &Bin| b.right].map(|f| filled().map(f).collect::<Vec<f64>>());
    let answers = Line {
        intervals: filled().map(|b| b.interval).collect(),
        role: Some(Role::After),
        ..Line::new("answers", &x, &y)
    };
    let ends = [0.0, 1.0];
    Chart {
        caption:
            "How often the first answer is right, over its probability; bars: 95 % intervals after Wilson; numbers: \
                  answers. A perfect tool lies on the dashed line."
                .to_owned(),
        x_label: "probability of the first answer".to_owned(),
        y_label: "share that is right".to_owned(),
        equal_scales: true,
        lines: vec![Line { role: Some(Role::Placebo), ..Line::new("perfect", &ends, &ends).dashed() }, answers],
        marks: filled().map(|b| (b.confidence, b.right, b.count.to_string())).collect(),
    }
}

/// Width and height, px.
const SIZE: [u32; 2] = [520, 500];
/// Letters, as the SVG backend wants them (it writes them smaller by 1.24), px.
const LETTERS: f64 = 1.24 * 13.0;
/// Half the width of the bar of an interval, in confidence.
const CAP: f64 = 0.008;
/// Parts of an axis.
const TICKS: usize = 6;

/// Draws the bins that hold answers; a perfect tool lies on the diagonal.
///
/// # Errors
/// When the drawing library fails.
pub fn svg(bins: &[Bin]) -> Result<String, PictureError> {
    let mut out = String::new();
    {
        let root = SVGBackend::with_string(&mut out, (SIZE[0], SIZE[1])).into_drawing_area();
        root.fill(&PAPER).map_err(failed)?;
        let letters = || FontDesc::new(FontFamily::SansSerif, LETTERS, FontStyle::Normal);
        let ink = TextStyle::from(letters()).color(&INK);
        let mut chart = ChartBuilder::on(&root)
            .margin(16)
            .x_label_area_size(46)
            .y_label_area_size(56)
            .build_cartesian_2d(0.0..1.0, 0.0..1.0)
            .map_err(failed)?;
        chart
            .configure_mesh()
            .x_labels(TICKS)
            .y_labels(TICKS)
            .x_desc("probability of the first answer")
            .y_desc("share that is right")
            .label_style(ink.clone())
            .axis_desc_style(ink)
            .axis_style(SOFT)
            .bold_line_style(FRAME)
            .light_line_style(TRANSPARENT)
            .draw()
            .map_err(failed)?;
        let diagonal = PathElement::new([(0.0, 0.0), (1.0, 1.0)], SOFT.stroke_width(1));
        chart.plotting_area().draw(&diagonal).map_err(failed)?;
        let count = TextStyle::from(letters()).color(&SOFT).pos(Pos::new(HPos::Right, VPos::Center));
        for bin in bins.iter().filter(|b| b.count > 0) {
            let area = chart.plotting_area();
            let (x, [low, high]) = (bin.confidence, bin.interval);
            for ends in [[(x, low), (x, high)], [(x - CAP, low), (x + CAP, low)], [(x - CAP, high), (x + CAP, high)]] {
                area.draw(&PathElement::new(ends, CORRECTED.stroke_width(1))).map_err(failed)?;
            }
            area.draw(&Circle::new((x, bin.right), 5, CORRECTED.filled())).map_err(failed)?;
            // Left of the circle, where there is room also at full confidence.
            let label = Text::new(bin.count.to_string(), (x - 2.0 * CAP, bin.right), count.clone());
            area.draw(&label).map_err(failed)?;
        }
        root.present().map_err(failed)?;
    }
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::{Bin, chart, svg};
    use crate::drawing::well_formed;

    #[test]
    fn draws_what_holds_answers_and_leaves_out_what_does_not() {
        let bin = |count, confidence, right| Bin {
            above: 0.8,
            until: 1.0,
            count,
            confidence,
            right,
            interval: [0.5 * right, 1.0],
        };
        let picture = svg(&[bin(17, 0.95, 0.9), bin(0, 0.0, 0.0)]).expect("draws");
        well_formed(&picture);
        assert!(picture.contains("17") && picture.contains("probability of the first answer"));
        assert_eq!(picture.matches("<circle").count(), 1);
        well_formed(&svg(&[]).expect("draws"));
        let chart = chart(&[bin(17, 0.95, 0.9), bin(0, 0.0, 0.0)]);
        assert_eq!((chart.lines[1].y.len(), chart.marks.len()), (1, 1));
    }
}
