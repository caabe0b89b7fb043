//! A picture of slopes: what the witness saw over time, and what had been claimed before it was opened, as SVG.

use plotters::prelude::*;

use crate::drawing::{CORRECTED, FRAME, INK, PAPER, PictureError, SOFT, failed};

/// A slope that was claimed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Claimed {
    /// From, until, s.
    pub interval: [f64; 2],
    /// Slope and half of its 90 % interval, degrees.
    pub slope: f64,
    /// Half of its 90 % interval, degrees.
    pub half: f64,
    /// The slope is at most this.
    pub bound: bool,
}

/// What a picture shows.
#[derive(Debug, Clone, Default)]
pub struct Slopes<'a> {
    /// What it is about.
    pub title: &'a str,
    /// Times of the witness, s, and its slopes, degrees.
    pub witness: (&'a [f64], &'a [f64]),
    /// What was claimed.
    pub claimed: Vec<Claimed>,
    /// Where nothing could be seen, s.
    pub hidden: Vec<[f64; 2]>,
}

/// Width and height, px.
const SIZE: [u32; 2] = [900, 300];
/// Letters, as the SVG backend wants them (it writes them smaller by 1.24), px.
const LETTERS: f64 = 1.24 * 13.0;
/// The ordinate reaches at least this far, degrees.
const LEAST: f64 = 4.0;
/// The witness is drawn with about so many points.
const POINTS: usize = 1500;

/// Draws the witness as a line, claims as bands with their value, hidden stretches in grey.
///
/// # Errors
/// When the drawing library fails.
pub fn svg(s: &Slopes<'_>) -> Result<String, PictureError> {
    let mut out = String::new();
    {
        let root = SVGBackend::with_string(&mut out, (SIZE[0], SIZE[1])).into_drawing_area();
        root.fill(&PAPER).map_err(failed)?;
        let letters = || FontDesc::new(FontFamily::SansSerif, LETTERS, FontStyle::Normal);
        let ink = TextStyle::from(letters()).color(&INK);
        let (time, slope) = s.witness;
        let last = time.last().copied().unwrap_or(1.0).max(1.0);
        let reach = s.claimed.iter().map(|c| c.slope.abs() + if c.bound { 0.0 } else { c.half });
        let most = slope.iter().map(|x| x.abs()).chain(reach).fold(LEAST, f64::max).ceil();
        let mut chart = ChartBuilder::on(&root)
            .caption(s.title, ink.clone())
            .margin(12)
            .x_label_area_size(40)
            .y_label_area_size(52)
            .build_cartesian_2d(0.0..last, -most..most)
            .map_err(failed)?;
        chart
            .configure_mesh()
            .x_desc("time, s")
            .y_desc("slope, degrees")
            .label_style(ink.clone())
            .axis_desc_style(ink)
            .axis_style(SOFT)
            .bold_line_style(FRAME)
            .light_line_style(TRANSPARENT)
            .draw()
            .map_err(failed)?;
        let band =
            |[a, b]: [f64; 2], [low, high]: [f64; 2], style: ShapeStyle| Rectangle::new([(a, low), (b, high)], style);
        let grey = s.hidden.iter().map(|h| band(*h, [-most, most], FRAME.mix(0.5).filled()));
        chart.draw_series(grey).map_err(failed)?;
        let bands = s.claimed.iter().map(|c| {
            let range = if c.bound { [-most, c.slope] } else { [c.slope - c.half, c.slope + c.half] };
            band(c.interval, range, CORRECTED.mix(0.3).filled())
        });
        chart.draw_series(bands).map_err(failed)?;
        let values = s.claimed.iter().map(|c| {
            PathElement::new(vec![(c.interval[0], c.slope), (c.interval[1], c.slope)], CORRECTED.stroke_width(3))
        });
        chart.draw_series(values).map_err(failed)?;
        let every = (time.len() / POINTS).max(1);
        let line: Vec<(f64, f64)> = time.iter().copied().zip(slope.iter().copied()).step_by(every).collect();
        chart.draw_series([PathElement::new(line, INK.stroke_width(1))]).map_err(failed)?;
        root.present().map_err(failed)?;
    }
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn claims_bounds_and_hidden_stretches_are_drawn() {
        let time: Vec<f64> = (0..100).map(f64::from).collect();
        let slope: Vec<f64> = time.iter().map(|t| if *t > 50.0 { -4.0 } else { 0.0 }).collect();
        let claimed = vec![
            Claimed { interval: [50.0, 70.0], slope: -4.0, half: 1.5, bound: false },
            Claimed { interval: [80.0, 90.0], slope: -2.0, half: 0.0, bound: true },
        ];
        let all = Slopes { title: "a & b", witness: (&time, &slope), claimed, hidden: vec![[10.0, 20.0]] };
        let svg = svg(&all).expect("draws");
        crate::drawing::well_formed(&svg);
        let rectangles = svg.matches("<rect").count();
        let nothing = super::svg(&Slopes { claimed: Vec::new(), hidden: Vec::new(), ..all }).expect("draws");
        assert_eq!(rectangles - nothing.matches("<rect").count(), 3);
    }
}
