//! One answer against what was hidden, in the program's own words.

use examiner::rolling::{Chassis, Hidden, RollingTruth};
use serde_json::Value;

use crate::blind::causes;
use crate::blind::said::{Said, id_of};

/// What came of a case.
pub(in crate::blind) type Row = causes::Row<Hidden>;

/// The label of the cause that something hidden is, without the wheel or distance that it is about.
fn cause(hidden: Hidden) -> &'static str {
    match hidden {
        Hidden::AllRadii => "radius_of_all_wheels",
        Hidden::OneRadius => "radius_of_one_wheel",
        Hidden::Direction => "direction_of_one_wheel",
        Hidden::Distance => "wheel_distance",
        Hidden::SteeringZero => "steering_zero",
        Hidden::SteeringGain => "steering_gain",
        Hidden::TurnSlip => "slip_in_turns",
        Hidden::RateSlip => "slip_with_turning",
        Hidden::SpeedSlip => "slip_with_speed",
        Hidden::RollerSlip => "roller_slip",
        Hidden::ClockOffset => "counts_clock_offset",
        Hidden::ClockRate => "clock_rate",
        Hidden::Mounting => "pose_mounting",
        Hidden::Origin => "pose_origin",
        Hidden::LostCounts => "lost_counts",
        Hidden::GyroScale => "heading_gyro_scale",
        Hidden::GyroBias => "heading_gyro_bias",
    }
}

/// Whether a label is that of something hidden, of the wheel that it is about.
fn is(label: &str, hidden: Hidden, truth: &RollingTruth) -> bool {
    let (id, of) = id_of(label);
    let wheel = matches!(hidden, Hidden::OneRadius | Hidden::Direction | Hidden::LostCounts);
    let wheel = wheel.then_some(truth.wheel.as_deref()).flatten();
    id == cause(hidden) && wheel.is_none_or(|wheel| of == Some(wheel))
}

/// What a number is called in the answer, and the power of length that it is told in.
fn told_as(name: &str, truth: &RollingTruth) -> String {
    match name {
        "radius" => format!("radius of {}", truth.wheel.as_deref().unwrap_or_default()),
        "direction" => format!("direction of {}", truth.wheel.as_deref().unwrap_or_default()),
        "distance" => match truth.chassis {
            Chassis::Differential | Chassis::SkidSteer | Chassis::Mecanum4 => "track".to_owned(),
            Chassis::Tricycle => "wheelbase".to_owned(),
            Chassis::Omni3 | Chassis::Omni4 => "distance from centre to wheels".to_owned(),
        },
        "steering_zero" => "steering zero".to_owned(),
        "steering_gain" => "steering gain".to_owned(),
        "mounting" => "direction of the pose's frame".to_owned(),
        "origin_x" => "place of the pose's origin, x".to_owned(),
        "origin_y" => "place of the pose's origin, y".to_owned(),
        "clock_offset" => "offset of the clocks".to_owned(),
        "clock_rate" => "rate of the clocks".to_owned(),
        "gyro_scale" => "scale of the gyro".to_owned(),
        "gyro_bias" => "bias of the gyro".to_owned(),
        other => other.to_owned(),
    }
}

/// Scores an answer; null is a refusal. `forecast`: what the quantity's name in the verdict begins with.
pub(super) fn row(truth: &RollingTruth, d: &Value, forecast: &str, processor_seconds: Option<f64>) -> Row {
    let said = Said::new(d);
    let stands_for = |label: &String, hidden: Hidden| said.stands_for(label, |other| is(other, hidden, truth));
    let error = |(name, value): (&String, &f64)| {
        let error = said.error(&told_as(name, truth), *value, name.starts_with("clock"))?;
        Some((name.clone(), error))
    };
    Row {
        case: truth.case.clone(),
        robot: Some(truth.chassis.name()),
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
        errors: truth.numbers.iter().filter_map(error).collect(),
        forecast: said.forecast(forecast),
        named: said.named,
        processor_seconds,
        onset: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_cause_is_found_by_its_label_or_its_class_and_a_number_by_its_interval() {
        let truth = RollingTruth {
            case: "r001".into(),
            chassis: Chassis::Differential,
            hidden: vec![Hidden::OneRadius],
            wheel: Some("right".into()),
            numbers: [("radius".to_owned(), 0.05)].into(),
        };
        let parameters = json!({ "radius of right": { "value": 0.051, "sigma": 0.001 } });
        let say = |label: &str, class: Value| {
            json!({ "verdict": "explained", "sentences": ["x"], "indistinguishable": class,
                "ranked": [{ "effect": "radius_of_one_wheel", "name": label, "probability": 0.99, "parameters": parameters },
                    { "effect": "unknown", "name": "unknown", "probability": 0.6 }],
                "free_runs": [{ "quantity": "position after 10 s from counts alone, median, m", "nominal": 0.4,
                    "corrected": 0.1 }] })
        };
        let row = |truth: &RollingTruth, said: &Value, seconds| row(truth, said, "position after 10 s", seconds);
        let right = row(&truth, &say("radius_of_one_wheel (right)", json!([])), None);
        assert_eq!((right.found, right.invented.len()), (vec![true], 0));
        assert!((right.errors[0].1 - 1.0 / 1.645).abs() < 1e-9 && right.forecast == Some(0.25));
        let left = row(&truth, &say("radius_of_one_wheel (left)", json!([])), None);
        assert_eq!((left.found, left.invented.len()), (vec![false], 1));
        let class = json!([["radius_of_one_wheel (left)", "radius_of_one_wheel (right)"]]);
        assert_eq!(row(&truth, &say("radius_of_one_wheel (left)", class), None).found, [true]);
    }
}
