//! The analogues of Figures 5, 6 and 7 of Hendzel & Trojnacki 2014.

use crate::chart::{Chart, Line};
use crate::page::Page;

/// Histories of one draw. Pairs are wheels 3 and 4; all have one entry per `time`.
#[derive(Debug, Clone, Default)]
pub struct Signals {
    /// Time, s.
    pub time: Vec<f64>,
    /// Path of the robot, m.
    pub path: [Vec<f64>; 2],
    /// Desired path, m.
    pub desired: [Vec<f64>; 2],
    /// Torques, N m.
    pub torque: [Vec<f64>; 2],
    /// Wheel angles, rad.
    pub angle: [Vec<f64>; 2],
    /// Estimated wheel angles, rad.
    pub angle_estimate: [Vec<f64>; 2],
    /// Their errors with the measured speed, rad.
    pub angle_error: [Vec<f64>; 2],
    /// Their errors with the estimated speed, rad.
    pub angle_error_estimated_speed: [Vec<f64>; 2],
    /// Wheel speeds, rad/s.
    pub speed: [Vec<f64>; 2],
    /// Estimated wheel speeds, rad/s.
    pub speed_estimate: [Vec<f64>; 2],
    /// Their errors, rad/s.
    pub speed_error: [Vec<f64>; 2],
    /// Weights of g3 and g4, rad/s².
    pub weight: [Vec<Vec<f64>>; 2],
    /// Times of the five disturbances, s.
    pub events: Vec<f64>,
}

/// Adds the analogues of Figures 5, 6 and 7, laid out as in the paper; `note` says which draw they show.
pub fn figures(page: &mut Page, note: &str, s: &Signals) {
    page.heading("Figure 5: signals for the identification");
    page.note(note);
    page.charts(&figure5(s));
    page.heading("Figure 6: the identifier");
    page.charts(&figure6(s));
    page.heading("Figure 7: weights");
    page.charts(&figure7(s));
}

fn chart(caption: &str, y_label: &str, lines: Vec<Line>) -> Chart {
    Chart { caption: caption.into(), x_label: "t, s".into(), y_label: y_label.into(), lines, ..Chart::default() }
}

fn pair(time: &[f64], names: [&str; 2], y: &[Vec<f64>; 2]) -> Vec<Line> {
    names.into_iter().zip(y).map(|(name, y)| Line::new(name, time, y)).collect()
}

fn figure5(s: &Signals) -> Vec<Chart> {
    let t = &s.time;
    let path = Chart {
        caption: "5a: path of R".into(),
        x_label: "x, m".into(),
        y_label: "y, m".into(),
        equal_scales: true,
        lines: vec![
            Line::new("actual", &s.path[0], &s.path[1]),
            Line::new("desired", &s.desired[0], &s.desired[1]).dashed(),
        ],
        marks: Vec::new(),
    };
    vec![
        path,
        chart("5b: torques of the driven wheels", "τ, N m", pair(t, ["τ3", "τ4"], &s.torque)),
        chart("5c: wheel angles", "θ, rad", pair(t, ["θ3", "θ4"], &s.angle)),
        chart("5d: wheel speeds", "dθ/dt, rad/s", pair(t, ["dθ3/dt", "dθ4/dt"], &s.speed)),
    ]
}

fn figure6(s: &Signals) -> Vec<Chart> {
    let t = &s.time;
    let with_estimates = |names: [&str; 4], actual: &[Vec<f64>; 2], estimate: &[Vec<f64>; 2]| {
        let mut lines = pair(t, [names[0], names[1]], actual);
        lines.extend(pair(t, [names[2], names[3]], estimate).into_iter().map(Line::dashed));
        lines
    };
    let angle_errors = with_estimates(
        ["error of x1", "error of x2", "x1, estimated speed", "x2, estimated speed"],
        &s.angle_error,
        &s.angle_error_estimated_speed,
    );
    let mut errors = chart(
        "6d: errors of the wheel speeds; 1 start, 2 loop entry, 3 rolling resistance, 4 loop exit, 5 braking",
        "rad/s",
        pair(t, ["error of x3", "error of x4"], &s.speed_error),
    );
    let top = s.speed_error.iter().flatten().fold(0.0_f64, |m, e| m.max(e.abs()));
    errors.marks = s.events.iter().enumerate().map(|(i, at)| (*at, 0.6 * top, (i + 1).to_string())).collect();
    vec![
        chart(
            "6a: wheel angles and their estimates",
            "rad",
            with_estimates(["x1", "x2", "estimate of x1", "estimate of x2"], &s.angle, &s.angle_estimate),
        ),
        chart(
            "6b: errors of the wheel angles; with the measured speed (Eq. 23 as written) they vanish, \
             with the estimated speed they look like the paper's",
            "rad",
            angle_errors,
        ),
        chart(
            "6c: wheel speeds and their estimates",
            "rad/s",
            with_estimates(["x3", "x4", "estimate of x3", "estimate of x4"], &s.speed, &s.speed_estimate),
        ),
        errors,
    ]
}

fn figure7(s: &Signals) -> Vec<Chart> {
    let weights = |caption: &str, histories: &[Vec<f64>]| {
        let lines = histories.iter().enumerate().map(|(j, w)| Line::new(format!("W{}", j + 1), &s.time, w)).collect();
        chart(caption, "rad/s²", lines)
    };
    vec![weights("7a: weights of g3", &s.weight[0]), weights("7b: weights of g4", &s.weight[1])]
}
