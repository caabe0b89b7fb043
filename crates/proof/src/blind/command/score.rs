//! One answer against what was hidden, in the program's own words.

use examiner::command::{CommandTruth, Hidden};
use serde_json::Value;

use crate::blind::causes;

/// Above this probability a cause is named: this kind has no classes.
const LIKELY: f64 = 0.5;

/// What came of a case.
pub(in crate::blind) type Row = causes::Row<Hidden>;

/// The name of the cause that something hidden is.
fn cause(hidden: Hidden) -> &'static str {
    match hidden {
        Hidden::DeadTime => "transport_delay",
        Hidden::Lag => "motor_lag",
        Hidden::Gains | Hidden::TurnLimit | Hidden::Ramps => "drive_command",
        Hidden::Track => "effective_track",
        Hidden::Radius => "rolling_radius",
        Hidden::TurnSlip => "turning_slip",
        Hidden::SideRadius => "wheel_radius_mismatch",
    }
}

fn list<'a>(v: &'a Value, keys: &[&str]) -> &'a [Value] {
    keys.iter().fold(v, |v, key| &v[*key]).as_array().map_or(&[], Vec::as_slice)
}

/// Scores an answer; null is a refusal.
pub(super) fn row(truth: &CommandTruth, d: &Value, processor_seconds: Option<f64>) -> Row {
    let text = |v: &Value| v.as_str().unwrap_or_default().to_owned();
    let likely = list(d, &["ranked"]).iter().filter(|c| c["probability"].as_f64().is_some_and(|p| p > LIKELY));
    let answers = ["none", "unknown"];
    let named: Vec<String> = likely.map(|c| text(&c["effect"])).filter(|id| !answers.contains(&id.as_str())).collect();
    let causes: Vec<&str> = truth.hidden.iter().map(|h| cause(*h)).collect();
    let parameters = list(d, &["response", "parameters"]);
    let error = |(name, value): (&String, &f64)| {
        let told = parameters.iter().find(|p| p["id"] == name.as_str())?;
        let half = told["half_width"].as_f64().filter(|half| *half > 0.0)?;
        Some((name.clone(), (told["value"].as_f64()? - value) / half))
    };
    let forecast = list(d, &["free_runs"])
        .iter()
        .find(|f| f["quantity"].as_str().is_some_and(|q| q.starts_with("position (rms)")));
    Row {
        case: truth.case.clone(),
        robot: None,
        hidden: truth.hidden.clone(),
        verdict: d["verdict"].as_str().unwrap_or("refused").to_owned(),
        headline: list(d, &["sentences"]).first().map(text).unwrap_or_default(),
        found: causes.iter().map(|c| named.iter().any(|n| n == c)).collect(),
        invented: named.iter().filter(|n| !causes.contains(&n.as_str())).cloned().collect(),
        named,
        errors: truth.numbers.iter().filter_map(error).collect(),
        forecast: forecast.and_then(|f| Some(f["corrected"].as_f64()? / f["nominal"].as_f64()?)),
        processor_seconds,
        onset: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_cause_is_found_by_its_name_and_a_number_by_its_interval() {
        let truth = CommandTruth {
            case: "c001".into(),
            hidden: vec![Hidden::DeadTime, Hidden::Track],
            numbers: [("dead_time".to_owned(), 0.2), ("track_factor".to_owned(), 1.5)].into(),
        };
        let say = json!({ "verdict": "explained", "sentences": ["x"],
            "ranked": [{ "effect": "transport_delay", "probability": 0.99 }, { "effect": "body_lag", "probability": 0.7 },
                { "effect": "effective_track", "probability": 0.3 }, { "effect": "unknown", "probability": 0.6 }],
            "response": { "parameters": [{ "id": "dead_time", "value": 0.21, "half_width": 0.02 }] },
            "free_runs": [{ "quantity": "position (rms), m", "nominal": 0.4, "corrected": 0.1 }] });
        let row = row(&truth, &say, None);
        assert_eq!((row.found, row.invented), (vec![true, false], vec!["body_lag".to_owned()]));
        assert!(row.errors.len() == 1 && (row.errors[0].1 - 0.5).abs() < 1e-9, "{:?}", row.errors);
        assert!(row.forecast.is_some_and(|f| (f - 0.25).abs() < 1e-9));
    }
}
