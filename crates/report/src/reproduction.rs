//! The page of `xtask reproduce`: Table 1 and the analogues of Figures 5, 6 and 7 of Hendzel & Trojnacki 2014.

use crate::chart::{Chart, Line};
use crate::page::{Cell, Page, Tone};

/// A column of Table 1.
#[derive(Debug, Clone)]
pub struct Index {
    /// Name of the index.
    pub name: String,
    /// The paper's value, rad/s.
    pub paper: f64,
    /// Smallest, 5 %, median, 95 % and largest value over the draws, rad/s.
    pub quantiles: [f64; 5],
    /// Percentage of draws below the paper's value.
    pub percentile: f64,
    /// The value without a network, rad/s.
    pub constant: f64,
}

/// A condition of the tolerance.
#[derive(Debug, Clone)]
pub struct Condition {
    /// Letter of the rule.
    pub rule: char,
    /// What is measured.
    pub name: String,
    /// What was found, with its unit.
    pub found: String,
    /// What is asked.
    pub target: String,
    /// Whether it is met.
    pub pass: bool,
}

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

/// All that the page shows.
#[derive(Debug, Clone, Default)]
pub struct Reproduction {
    /// Title of the page.
    pub title: String,
    /// One line on robot, draws and seed.
    pub setting: String,
    /// The verdict in a sentence.
    pub verdict: String,
    /// What was chosen, when and why.
    pub disclosure: String,
    /// Table 1.
    pub indices: Vec<Index>,
    /// The tolerance.
    pub conditions: Vec<Condition>,
    /// Which draw the figures show.
    pub figures_of: String,
    /// Its histories.
    pub signals: Signals,
}

/// Writes the page as one HTML document.
pub fn page(r: &Reproduction) -> String {
    let mut page = Page::new(&r.title);
    page.paragraph(&r.verdict);
    page.note(&r.setting);
    page.heading("Table 1, rad/s");
    let header: Vec<&str> = std::iter::once("").chain(r.indices.iter().map(|i| i.name.as_str())).collect();
    page.table(&header, &table1(&r.indices));
    page.note(
        "The last row uses no network at all: a constant regressor. Indices this near to it cannot tell learning from \
         integral action.",
    );
    page.heading("Tolerance");
    let rows: Vec<Vec<Cell>> = r
        .conditions
        .iter()
        .map(|c| {
            let (text, tone) = if c.pass { ("met", Tone::Good) } else { ("missed", Tone::Bad) };
            let name = format!("({}) {}", c.rule, c.name);
            vec![name.into(), c.found.clone().into(), c.target.clone().into(), Cell { text: text.into(), tone }]
        })
        .collect();
    page.table(&["condition", "found", "asked", ""], &rows);
    page.heading("What was chosen, and when");
    page.paragraph(&r.disclosure);
    page.heading("Figure 5: signals for the identification");
    page.note(&r.figures_of);
    page.charts(&figure5(&r.signals));
    page.heading("Figure 6: the identifier");
    page.charts(&figure6(&r.signals));
    page.heading("Figure 7: weights");
    page.charts(&figure7(&r.signals));
    page.render()
}

fn table1(indices: &[Index]) -> Vec<Vec<Cell>> {
    let row = |name: &str, value: &dyn Fn(&Index) -> String| {
        std::iter::once(Cell::from(name)).chain(indices.iter().map(|i| value(i).into())).collect()
    };
    let mut rows: Vec<Vec<Cell>> = vec![row("paper", &|i| format!("{:.4}", i.paper))];
    for (n, name) in ["smallest", "5 %", "median", "95 %", "largest"].into_iter().enumerate() {
        rows.push(row(name, &|i| format!("{:.4}", i.quantiles[n])));
    }
    rows.push(row("percentile of the paper's value", &|i| format!("{:.1} %", i.percentile)));
    rows.push(row("constant regressor", &|i| format!("{:.4}", i.constant)));
    rows
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
