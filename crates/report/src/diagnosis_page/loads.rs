//! Loads of a speed-driven robot, constants of a command-driven one.

use verdict::Diagnosis;
use verdict::Response;
use verdict::{Loads, Ratio};

use crate::figure::{Drawing, Figure, Interval, Intervals};
use crate::page::{Cell, Page};
use crate::words::number;

/// Adds what there is of both.
pub(super) fn add(page: &mut Page, d: &Diagnosis) {
    if let Some(loads) = d.steady.as_ref().filter(|l| !l.ratios.is_empty()) {
        page.section("Loads", "Loads of steady driving");
        page.figure(&ratios(loads));
    }
    if let Some(response) = d.response.as_ref().filter(|r| !r.parameters.is_empty()) {
        page.section("Response", "From command over wheels to the body");
        constants(page, response);
    }
}

/// Everything that is compared as a ratio; the asymmetry, which is a difference, is in the numbers only.
fn ratios(loads: &Loads) -> Figure {
    let row = |r: &Ratio| {
        let digits = (1 - r.half.log10().floor() as i32).clamp(0, 4) as usize;
        vec![
            r.recording.as_str().into(),
            r.quantity.name().into(),
            format!("{:.2}, {:.2}", r.speed[0], r.speed[1]).into(),
            format!("{:.digits$} ± {:.digits$} {}", r.value, r.half, r.quantity.unit()).into(),
            format!("{:.2} [{:.2}, {:.2}]", r.ratio, r.interval[0], r.interval[1]).into(),
            Cell::from(format!("{:.0}", r.seconds)),
        ]
    };
    let shown = loads.ratios.iter().filter(|r| !r.quantity.is_difference());
    let interval = |r: &Ratio| Interval {
        name: format!("{} · {}", r.recording, r.quantity.name()),
        value: two(r.ratio),
        low: two(r.interval[0]),
        high: two(r.interval[1]),
        stands_out: r.interval[0] > 1.0 || r.interval[1] < 1.0,
    };
    Figure {
        title: "Loads relative to the references".to_owned(),
        caption: "Each load of a recording divided by that of the references in the same kind of \
             driving, with its 90 % interval; 1 is no difference. Coloured: the interval does not \
             contain 1."
            .to_owned(),
        table: (
            vec!["recording", "load", "inner, outer m/s", "value (90 %)", "over reference (90 %)", "s"],
            loads.ratios.iter().map(row).collect(),
        ),
        drawing: Drawing::Intervals(Intervals {
            x: "load, times that of the references".to_owned(),
            neutral: 1.0,
            rows: shown.map(interval).collect(),
        }),
    }
}

fn constants(page: &mut Page, response: &Response) {
    page.note(&format!(
        "From {} windows of 2 s in {} command steps. The last column: by how much forecasts of left-out windows get worse \
         without it.",
        response.windows, response.steps
    ));
    let rows: Vec<Vec<Cell>> = response
        .parameters
        .iter()
        .map(|p| {
            let half = p.half_width.map_or(String::new(), |h| format!("± {}", number(h)));
            let earned = response.elements.iter().find(|e| e.element == p.element);
            vec![
                p.id.as_ref().into(),
                number(p.value).into(),
                half.into(),
                p.unit.as_ref().into(),
                p.simulated.map_or("no limit".to_owned(), number).into(),
                earned.map_or(String::new(), |e| format!("{:+.0} %", 100.0 * e.rise)).into(),
            ]
        })
        .collect();
    page.table(&["constant", "value", "90 %", "unit", "simulated", "error without it"], &rows);
}

fn two(x: f64) -> f64 {
    (100.0 * x).round() / 100.0
}
