//! What is told of a fleet.

use fleet::Overview;
use pages::text_table::TextTable;
use serde_json::{Value, json};

use super::listed;
use crate::console::heading;

/// Robots in the text; all are in the JSON.
const ROBOTS: usize = 30;
/// Effects of a robot in the text.
const EFFECTS: usize = 3;

/// Counts over all rows as text.
pub(crate) fn as_text(all: &Overview) -> String {
    let [explained, unknown, none, withheld] = all.verdicts;
    let mut out = format!(
        "{} recordings: {explained} explained, {unknown} unknown, {none} without mismatch, {withheld} withheld, {} failed\n",
        all.rows, all.failed
    );
    let mut table = TextTable::new(&["robot", ">recordings", ">mismatch", ">failed", "effects"]);
    for (name, robot) in all.robots.iter().take(ROBOTS) {
        let mut effects: Vec<(&String, &usize)> = robot.effects.iter().collect();
        effects.sort_by_key(|(_, count)| std::cmp::Reverse(**count));
        let more = if effects.len() > EFFECTS { ", ..." } else { "" };
        let effects: Vec<String> = effects.iter().take(EFFECTS).map(|(e, n)| format!("{e} ({n})")).collect();
        table.row([
            name.clone(),
            robot.rows.to_string(),
            robot.mismatches.to_string(),
            robot.failed.to_string(),
            effects.join(", ") + more,
        ]);
    }
    out += &format!("\n{}{}", heading("Robots"), table.render());
    let left = all.robots.len().saturating_sub(ROBOTS);
    if left > 0 {
        out += &format!("  ... and {left} more\n");
    }
    let mut failures: Vec<String> = all.failures.iter().map(|(id, why)| format!("{id}: {why}")).collect();
    if all.failed > failures.len() {
        failures.push(format!("and {} more; the table has all", all.failed - failures.len()));
    }
    out + &listed("Failed", &failures)
}

/// The same as JSON.
pub(crate) fn as_json(all: &Overview) -> Value {
    let [explained, unknown, no_mismatch, withheld] = all.verdicts;
    let robots: serde_json::Map<String, Value> = all
        .robots
        .iter()
        .map(|(name, r)| {
            let counts =
                json!({ "rows": r.rows, "mismatches": r.mismatches, "failed": r.failed, "effects": r.effects });
            (name.clone(), counts)
        })
        .collect();
    let failures: Vec<Value> = all.failures.iter().map(|(id, why)| json!({ "id": id, "error": why })).collect();
    json!({
        "rows": all.rows,
        "verdicts": {
            "explained": explained, "unknown": unknown, "no_mismatch": no_mismatch, "withheld": withheld,
        },
        "failed": all.failed,
        "lost_input": all.lost,
        "robots": robots,
        "failures": failures,
    })
}
