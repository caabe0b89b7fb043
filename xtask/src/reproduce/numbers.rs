//! What `reproduce` prints and writes as numbers.

use std::fmt::Write;

use serde_json::json;
use sim::table1::{Check, NAMES, PAPER};

use super::Outcome;
use crate::output::Figure;

/// What the terminal shows.
pub(super) fn text(o: &Outcome) -> String {
    let mut out = format!("{}\n{}\n\nTable 1, rad/s", o.recipe.title, o.setting());
    let mut row = |name: &str, cells: [String; 4]| {
        let _ = write!(out, "\n{name:<30}");
        for cell in cells {
            let _ = write!(out, "{cell:>10}");
        }
    };
    let digits = |v: f64| format!("{v:.4}");
    row("", NAMES.map(String::from));
    row("paper", PAPER.map(digits));
    for (n, name) in
        ["ours, smallest", "      5 %", "      median", "      95 %", "      largest"].into_iter().enumerate()
    {
        row(name, std::array::from_fn(|i| o.table.get(i).map_or_else(String::new, |d| digits(d.quantiles[n]))));
    }
    row(
        "percentile of the paper's, %",
        std::array::from_fn(|i| o.table.get(i).map_or_else(String::new, |d| format!("{:.1}", d.percentile))),
    );
    row("constant regressor, no network", o.constant.table1().map(digits));
    let _ = writeln!(out, "\n\nTolerance (the unit and property tests belong to it: cargo test --workspace)");
    for c in &o.checks {
        let mark = if c.pass { "met   " } else { "MISSED" };
        let _ =
            writeln!(out, "  ({}) {mark} {:<46} {:>12} {:<1}  asked {}", c.rule, c.name, found(c), c.unit, c.target);
    }
    let _ = writeln!(
        out,
        "\nLargest path error {:.3} m, smallest wheel load {:.1} N.\nPlant {:.2} s, identifiers {:.2} s.",
        o.run.largest_path_error, o.run.smallest_load, o.seconds[0], o.seconds[1]
    );
    let _ = writeln!(out, "\n{}\n\n{}", o.recipe.disclosure.trim(), o.verdict());
    out
}

/// A value with as many digits as are worth reading.
pub(super) fn found(check: &Check) -> String {
    let value = check.value;
    if value != 0.0 && !(1e-3..1e4).contains(&value.abs()) { format!("{value:.1e}") } else { format!("{value:.3}") }
}

/// The flat list of `summary.json`.
pub(super) fn summary(o: &Outcome) -> Vec<Figure> {
    let mut list: Vec<Figure> = o
        .checks
        .iter()
        .map(|c| Figure {
            name: format!("({}) {}", c.rule, c.name),
            value: c.value,
            unit: c.unit.into(),
            target: Some(c.target.clone()),
            pass: Some(c.pass),
        })
        .collect();
    for (d, constant) in o.table.iter().zip(o.constant.table1()) {
        for (q, value) in ["min", "5%", "median", "95%", "max"].into_iter().zip(d.quantiles) {
            list.push(Figure::free(format!("{} {q}", d.name), value, "rad/s"));
        }
        list.push(Figure::free(format!("{} percentile of the paper's value", d.name), d.percentile, "%"));
        list.push(Figure::free(format!("{} constant regressor", d.name), constant, "rad/s"));
    }
    list.push(Figure::free("largest path error", o.run.largest_path_error, "m"));
    list.push(Figure::free("smallest wheel load", o.run.smallest_load, "N"));
    list.push(Figure::free("time of the plant", o.seconds[0], "s"));
    list.push(Figure::free("time of the identifiers", o.seconds[1], "s"));
    list
}

/// Everything, for `numbers.json`.
pub(super) fn numbers(o: &Outcome) -> serde_json::Value {
    let table: Vec<_> = o
        .table
        .iter()
        .map(|d| json!({"name": d.name, "unit": "rad/s", "paper": d.paper, "min_5_50_95_max": d.quantiles, "paper_percentile": d.percentile}))
        .collect();
    let draws: Vec<_> = o
        .draws
        .iter()
        .map(|d| {
            let regressor = d.output.map(|o| o.mean_regressor_square);
            json!({"draw": d.number, "indices": d.table1(), "mean_regressor_square": regressor})
        })
        .collect();
    json!({
        "set": format!("{:?}", o.args.set),
        "seed": o.args.seed,
        "recipe": o.recipe,
        "table1": table,
        "constant_regressor": o.constant.table1(),
        "event_starts_s": o.run.windows.start,
        "draws": draws,
    })
}
