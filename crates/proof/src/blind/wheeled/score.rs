//! One answer against what was hidden, in the program's own words.

use examiner::wheeled::{Layout, WheeledHidden as Hidden, WheeledTruth};
use serde_json::Value;

use crate::blind::causes;
use crate::blind::said::{Said, id_of};

/// What came of a case.
pub(in crate::blind) type Row = causes::Row<Hidden>;

/// The cause that something hidden is, without the motor or wheel that it is about.
fn cause(hidden: Hidden) -> &'static str {
    match hidden {
        Hidden::Mass => "body_mass",
        Hidden::CentreOfMass => "body_centre_of_mass",
        Hidden::DryFriction => "motor_dry_friction",
        Hidden::ViscousFriction => "motor_viscous_friction",
        Hidden::TorqueScale => "motor_torque_scale",
        Hidden::Lag => "motor_torque_lag",
        Hidden::Radius => "radius_of_one_wheel",
        Hidden::Direction => "wheel_direction",
        Hidden::SteeringZero => "steering_zero",
        Hidden::SteeringGain => "steering_gain",
        Hidden::Rolling => "rolling_drag",
        Hidden::Drag => "body_drag",
        Hidden::RollerDrag => "roller_drag",
        Hidden::CasterDrag => "caster_rolling_drag",
        Hidden::Slope => "ground_slope",
    }
}

/// Whether a label is that of something hidden, of the motor or wheel that it is about; the only motor needs no name.
fn is(label: &str, hidden: Hidden, truth: &WheeledTruth) -> bool {
    let (id, of) = id_of(label);
    let is_only = matches!(truth.layout, Layout::Tricycle | Layout::Car)
        && matches!(hidden, Hidden::DryFriction | Hidden::ViscousFriction | Hidden::TorqueScale);
    let part = truth.part.as_deref().filter(|_| !is_only);
    id == cause(hidden) && part.is_none_or(|part| of == Some(part))
}

/// What a number is called in the answer.
fn told_as(name: &str, truth: &WheeledTruth) -> String {
    let of_part = |what: &str| format!("{what} of {}", truth.part.as_deref().unwrap_or_default());
    match name {
        "com_x" => "centre of mass, forward".to_owned(),
        "coulomb" => of_part("dry friction"),
        "viscous" => of_part("viscous friction"),
        "gain" => of_part("factor on the torque"),
        "lag" => "time constant of the motors".to_owned(),
        "radius" => of_part("radius"),
        "direction" => of_part("direction"),
        "steering_zero" => "steering zero of steering".to_owned(),
        "steering_gain" => "steering gain of steering".to_owned(),
        "rolling" => "rolling resistance".to_owned(),
        "drag" => "drag over the square of the speed".to_owned(),
        "roller_drag" => "drag of rollers".to_owned(),
        "caster_rolling" => "rolling resistance of casters".to_owned(),
        "slope_x" => "slope along x".to_owned(),
        "slope_y" => "slope along y".to_owned(),
        other => other.to_owned(),
    }
}

/// Scores an answer; null is a refusal.
pub(super) fn row(truth: &WheeledTruth, d: &Value, processor_seconds: Option<f64>) -> Row {
    let said = Said::new(d);
    let stands_for = |label: &String, hidden: Hidden| said.stands_for(label, |other| is(other, hidden, truth));
    Row {
        case: truth.case.clone(),
        robot: Some(truth.layout.name()),
        hidden: truth.hidden.clone(),
        verdict: said.verdict(),
        headline: said.headline(),
        found: truth.hidden.iter().map(|h| said.named.iter().any(|label| stands_for(label, *h))).collect(),
        invented: said
            .named
            .iter()
            .filter(|label| !truth.hidden.iter().any(|h| stands_for(label, *h)))
            .cloned()
            .collect(),
        errors: truth
            .numbers
            .iter()
            .filter_map(|(name, value)| Some((name.clone(), said.error(&told_as(name, truth), *value, false)?)))
            .collect(),
        forecast: said.forecast("position after 2 s"),
        onset: Some(onset(truth, d)),
        named: said.named,
        processor_seconds,
    }
}

/// The onset of the first cause that is not there all the time, beside what was hidden.
fn onset(truth: &WheeledTruth, d: &Value) -> causes::Onset {
    let spans = d["ranked"].as_array().into_iter().flatten().find_map(|cause| cause["intervals"].as_object());
    let late = truth.onset.as_ref().and_then(|(run, at)| {
        let from = spans?.get(run)?[0][0].as_f64()?;
        (from > 0.0).then_some(from - at)
    });
    causes::Onset { is_hidden: truth.onset.is_some(), is_told: spans.is_some(), late }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_motor_is_named_by_its_name_unless_there_is_one() {
        let truth = |layout, part: &str| WheeledTruth {
            case: "w001".into(),
            layout,
            hidden: vec![Hidden::TorqueScale],
            part: Some(part.into()),
            numbers: [("gain".to_owned(), 0.8)].into(),
            onset: None,
        };
        let parameters = json!({ "factor on the torque of left": { "value": 0.81, "sigma": 0.01 } });
        let say = |label: &str| {
            json!({ "verdict": "explained", "sentences": ["x"], "indistinguishable": [], "free_runs": [],
                "ranked": [{ "effect": "motor_torque_scale", "name": label, "probability": 0.99, "parameters": parameters }] })
        };
        let six = truth(Layout::SixWheel, "left");
        let right = row(&six, &say("motor_torque_scale (left)"), None);
        assert_eq!((right.found, right.invented.len()), (vec![true], 0));
        assert!((right.errors[0].1.abs() - 1.0 / 1.645).abs() < 1e-9, "{:?}", right.errors);
        for wrong in ["motor_torque_scale (right)", "motor_torque_scale"] {
            let row = row(&six, &say(wrong), None);
            assert_eq!((row.found, row.invented.len()), (vec![false], 1));
        }
        assert_eq!(row(&truth(Layout::Car, "rear axle"), &say("motor_torque_scale"), None).found, [true]);
    }

    #[test]
    fn an_onset_is_late_by_what_is_told_of_its_recording() {
        let truth = |onset: Option<(&str, f64)>| WheeledTruth {
            case: "w001".into(),
            layout: Layout::Omni3,
            hidden: vec![Hidden::Mass],
            part: None,
            numbers: [].into(),
            onset: onset.map(|(run, at)| (run.to_owned(), at)),
        };
        let told = json!({ "ranked": [{ "intervals": null }, { "intervals": { "run_2": [[12.5, 30.0]], "run_3": [[0.0, 30.0]] } }] });
        let of = |at: Option<(&str, f64)>, told: &Value| onset(&truth(at), told);
        let is = |is_hidden, is_told, late| causes::Onset { is_hidden, is_told, late };
        assert_eq!(of(Some(("run_2", 12.0)), &told), is(true, true, Some(0.5)));
        assert_eq!(of(Some(("run_1", 12.0)), &told), is(true, true, None), "not in this recording");
        assert_eq!(of(Some(("run_3", 12.0)), &told), is(true, true, None), "there from its start");
        assert_eq!(of(None, &told), is(false, true, None));
        assert_eq!(of(None, &json!({ "ranked": [{}] })), is(false, false, None));
    }
}
