//! What `reproduce` writes as numbers.

use serde_json::json;

use super::{Ensemble, Outcome};
use crate::output::Figure;

/// The flat list of `summary.json`.
pub(super) fn summary(o: &Outcome) -> Vec<Figure> {
    let mut list: Vec<Figure> = o
        .judged()
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
    for e in &o.rows {
        for (d, constant) in e.table.iter().zip(e.constant.table1()) {
            let name = |what: &str| format!("{}: {} {what}", e.name, d.name);
            for (q, value) in ["min", "5%", "median", "95%", "max"].into_iter().zip(d.quantiles) {
                list.push(Figure::free(name(q), value, "rad/s"));
            }
            list.push(Figure::free(name("percentile of the paper's value"), d.percentile, "%"));
            list.push(Figure::free(name("constant regressor"), constant, "rad/s"));
        }
    }
    for e in &o.variations {
        for d in &e.table {
            list.push(Figure::free(format!("{}: {} median", e.name, d.name), d.quantiles[2], "rad/s"));
        }
    }
    list.push(Figure::free("largest path error", o.run.largest_path_error, "m"));
    list.push(Figure::free("smallest wheel load", o.run.smallest_load, "N"));
    list.push(Figure::free("time", o.seconds, "s"));
    list
}

/// Everything, for `numbers.json`.
pub(super) fn all(o: &Outcome) -> serde_json::Value {
    json!({
        "seed": o.args.seed,
        "recipe": o.recipe,
        "event_starts_s": o.run.windows.start,
        "sets": o.rows.iter().map(|e| ensemble(e, true)).collect::<Vec<_>>(),
        "variations": o.variations.iter().map(|e| ensemble(e, false)).collect::<Vec<_>>(),
    })
}

fn ensemble(e: &Ensemble, with_draws: bool) -> serde_json::Value {
    let table: Vec<_> = e
        .table
        .iter()
        .map(|d| {
            json!({"name": d.name, "unit": "rad/s", "paper": d.paper, "min_5_50_95_max": d.quantiles,
                   "paper_percentile": d.percentile})
        })
        .collect();
    let mut value = json!({"name": e.name, "table1": table, "constant_regressor": e.constant.table1()});
    if with_draws {
        let draws: Vec<_> = e
            .draws
            .iter()
            .map(|d| {
                let regressor = d.output.map(|o| o.mean_regressor_square);
                let (peak, quiet) = (d.output.map(|o| o.peak), d.output.map(|o| o.quiet_rms));
                json!({"draw": d.number, "indices": d.table1(), "mean_regressor_square": regressor,
                       "peaks": peak, "quiet_rms": quiet})
            })
            .collect();
        value["draws"] = draws.into();
    }
    value
}
