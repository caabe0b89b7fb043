//! A picture of the next drive, as SVG: its speeds over time, and the bits that each drive of the menu is expected to gain.

use plotters::prelude::*;
use plotters::style::text_anchor::HPos;
use verdict::Advice;
use verdict::Manoeuvre;

use crate::drawing::{Area, CORRECTED, FRAME, INK, PAPER, PictureError, SOFT, bold, failed, rectangle, text};

/// Width, margin and height of the panels of speed, px.
const WIDTH: i32 = 800;
const MARGIN: i32 = 24;
const PANEL: i32 = 150;
/// Title, heading, label, px.
const TITLE: i32 = 17;
const HEADING: i32 = 15;
const LABEL: i32 = 13;
/// Letters of the charts, as the SVG backend wants them (it writes them smaller by 1.24), px.
const LETTERS: f64 = 1.24 * 12.0;
/// Height of a drive's row, its bar, the column of names, px.
const ROW: i32 = 24;
const BAR: i32 = 12;
const NAMES: i32 = 390;
const NUMBERS: i32 = 70;
/// Drives that are shown.
const SHOWN: usize = 12;
/// Points of a curve.
const POINTS: usize = 400;

const OTHER: RGBColor = RGBColor(160, 171, 182);

/// Draws one drive of the advice, and all of them by what they are expected to gain; 800 px wide, on white.
///
/// # Errors
/// When the drawing library fails.
pub fn svg(advice: &Advice, drive: &Manoeuvre) -> Result<String, PictureError> {
    let shown: Vec<&Manoeuvre> = advice.manoeuvres.iter().take(SHOWN).collect();
    let top = MARGIN + 36;
    let bars = top + 2 * PANEL + 24;
    let rows = i32::try_from(shown.len()).unwrap_or_default();
    let height = bars + 28 + ROW * rows.max(1) + MARGIN;
    let mut out = String::new();
    {
        let root = SVGBackend::with_string(&mut out, (WIDTH as u32, height as u32)).into_drawing_area();
        root.fill(&PAPER).map_err(failed)?;
        rectangle(&root, [0, 0, WIDTH - 1, height - 1], FRAME.stroke_width(1))?;
        bold(&root, &format!("Next: {}", drive.name), [MARGIN, MARGIN], TITLE)?;
        for (i, what) in ["speed, m/s", "yaw rate, rad/s"].into_iter().enumerate() {
            let at = top + PANEL * i32::try_from(i).unwrap_or_default();
            let area = root.clone().shrink((MARGIN, at), ((WIDTH - 2 * MARGIN) as u32, PANEL as u32));
            curve(&area, drive, i, what)?;
        }
        let title = format!("Bits that each drive is expected to gain, of {:.2} that are open", advice.entropy_bits);
        bold(&root, &title, [MARGIN, bars], HEADING)?;
        let most = shown.iter().map(|m| m.expected_bits).fold(1e-9, f64::max);
        for (i, m) in shown.iter().enumerate() {
            let y = bars + 28 + ROW * i32::try_from(i).unwrap_or_default();
            row(&root, m, m.name == drive.name, y, most)?;
        }
        root.present().map_err(failed)?;
    }
    Ok(out)
}

/// Wanted speed (0) or yaw rate (1) over time; shaded where the drives get no torque.
fn curve(area: &Area<'_>, drive: &Manoeuvre, which: usize, what: &str) -> Result<(), PictureError> {
    let length = drive.length().max(1e-3);
    let most = drive.profile.iter().map(|p| p[which + 1].abs()).fold(0.1, f64::max) * 1.15;
    let letters = TextStyle::from(FontDesc::new(FontFamily::SansSerif, LETTERS, FontStyle::Normal)).color(&INK);
    let mut chart = ChartBuilder::on(area)
        .margin(4)
        .x_label_area_size(34)
        .y_label_area_size(56)
        .build_cartesian_2d(0.0..length, -most..most)
        .map_err(failed)?;
    chart
        .configure_mesh()
        .x_desc("time, s")
        .y_desc(what)
        .y_labels(5)
        .label_style(letters.clone())
        .axis_desc_style(letters)
        .axis_style(SOFT)
        .bold_line_style(FRAME)
        .light_line_style(TRANSPARENT)
        .draw()
        .map_err(failed)?;
    let free = drive
        .torque_free
        .iter()
        .map(|[a, b]| Rectangle::new([(*a, -most), (b.min(length), most)], FRAME.mix(0.6).filled()));
    chart.draw_series(free).map_err(failed)?;
    let line: Vec<(f64, f64)> =
        (0..=POINTS).map(|i| i as f64 * length / POINTS as f64).map(|t| (t, drive.wanted(t)[which])).collect();
    chart.draw_series([PathElement::new(line, CORRECTED.stroke_width(2))]).map_err(failed)?;
    Ok(())
}

/// Name, bar and number of a drive.
fn row(root: &Area<'_>, m: &Manoeuvre, chosen: bool, y: i32, most: f64) -> Result<(), PictureError> {
    let name = if m.joins { m.name.clone() } else { format!("{} (robot changed for it)", m.name) };
    text(root, &name, [MARGIN, y], LABEL, if chosen { INK } else { SOFT }, HPos::Left)?;
    let whole = WIDTH - 2 * MARGIN - NAMES - NUMBERS;
    let long = (m.expected_bits / most * f64::from(whole)).round() as i32;
    let left = MARGIN + NAMES;
    let colour = if chosen { CORRECTED } else { OTHER };
    rectangle(root, [left, y + 2, left + long.clamp(1, whole), y + 2 + BAR], colour.filled())?;
    text(root, &format!("{:.2}", m.expected_bits), [WIDTH - MARGIN, y], LABEL, INK, HPos::Right)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::well_formed;

    fn drive(name: &str, bits: f64) -> Manoeuvre {
        Manoeuvre {
            name: name.to_owned(),
            why: String::new(),
            expected_bits: bits,
            splits: None,
            narrows: None,
            joins: bits > 0.2,
            optimised: false,
            start: [0.0; 3],
            profile: vec![[0.0; 3], [1.0, 0.5, 0.0], [3.0, 0.5, -0.7], [4.0, 0.0, 0.0]],
            torque_free: vec![[2.0, 3.0]],
            direction: 0.0,
        }
    }

    #[test]
    fn speeds_bits_and_coasting_are_drawn() {
        let manoeuvres = vec![drive("spins & arcs", 0.8), drive("straight", 0.1)];
        let advice = Advice { manoeuvres, entropy_bits: 1.25, ..Advice::default() };
        let svg = svg(&advice, &advice.manoeuvres[0]).expect("draws");
        well_formed(&svg);
        for expected in ["spins &amp; arcs", "of 1.25 that are open", "0.80", "straight (robot changed for it)"] {
            assert!(svg.contains(expected), "lacks {expected}");
        }
        let steady = Manoeuvre { torque_free: Vec::new(), ..drive("spins & arcs", 0.8) };
        let without = super::svg(&advice, &steady).expect("draws");
        assert_eq!(svg.matches("<rect").count(), without.matches("<rect").count() + 2);
    }
}
