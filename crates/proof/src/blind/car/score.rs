//! One answer against what was hidden, in the program's own words.

use examiner::car::{CarHidden, CarTruth};
use serde_json::Value;

use crate::blind::causes;
use crate::blind::said::{Said, id_of};

/// What came of a case.
pub(in crate::blind) type Row = causes::Row<CarHidden>;

/// The cause that something hidden is.
fn cause(hidden: CarHidden) -> &'static str {
    match hidden {
        CarHidden::SteeringGain => "steering_command_gain",
        CarHidden::SteeringCentre => "steering_centre",
        CarHidden::SteeringBend => "steering_map",
        CarHidden::SteeringDelay => "steering_delay",
        CarHidden::SteeringLag => "steering_lag",
        CarHidden::SteeringRate => "steering_rate",
        CarHidden::SteeringPlay => "steering_play",
        CarHidden::Wheelbase => "car_wheelbase",
        CarHidden::TyreSlip => "tyre_slip",
        CarHidden::GripLimit => "grip_limit",
        CarHidden::DriveGain => "drive_gain",
        CarHidden::DeadZone => "throttle_dead_zone",
        CarHidden::TrackedPoint => "tracked_point",
        CarHidden::TrackedAxes => "tracked_axes",
        CarHidden::ClockDelay => "car_clock_delay",
        CarHidden::ClockRate => "car_clock_rate",
        CarHidden::GyroScale => "car_gyro_scale",
        CarHidden::GyroBias => "car_gyro_bias",
        CarHidden::GyroDelay => "gyro_delay",
        CarHidden::EncoderScale => "car_encoder_scale",
        CarHidden::EncoderDelay => "encoder_delay",
        CarHidden::WheelSlip => "wheel_slip_in_bends",
        CarHidden::Slope => "car_ground_slope",
    }
}

/// What a number is called in the answer.
fn told_as(name: &str) -> &str {
    match name {
        "gain" => "steering angle at full command",
        "centre" => "steering angle at no command",
        "delay" => "dead time of the steering",
        "lag" => "time constant of the steering",
        "rate" => "time of the steering for a radian",
        "play" => "half of the play of the steering",
        "front_compliance" => "compliance of the front tyres",
        "rear_compliance" => "compliance of the rear tyres",
        "drive" => "acceleration at full throttle",
        "dead_zone" => "dead zone of the throttle",
        "point_x" => "place of the tracked point, forward",
        "point_y" => "place of the tracked point, left",
        "axes" => "direction of the tracked axes",
        "clock" => "the car's channels come late by",
        "clock_rate" => "share by which the car's clock is slow",
        "gyro_scale" => "scale of the gyro",
        "gyro_bias" => "bias of the gyro",
        "gyro_delay" => "delay of the gyro",
        "encoder_scale" => "encoder speed over ground speed",
        "encoder_delay" => "delay of the encoder",
        "slope_x" => "slope along x of the pose's frame",
        "slope_y" => "slope along y of the pose's frame",
        other => other,
    }
}

/// Scores an answer; null is a refusal.
pub(super) fn row(truth: &CarTruth, d: &Value, processor_seconds: Option<f64>) -> Row {
    let said = Said::new(d);
    let stands_for = |label: &String, hidden: CarHidden| said.stands_for(label, |l| id_of(l).0 == cause(hidden));
    // Tyres that give way have an end, too, whichever of the two was meant.
    let tyres = [CarHidden::TyreSlip, CarHidden::GripLimit];
    let is_there = |label: &String| {
        let mut all = truth.hidden.iter().copied().chain(tyres.into_iter().filter(|_| truth.has_tyres));
        all.any(|h| stands_for(label, h))
    };
    Row {
        case: truth.case.clone(),
        robot: None,
        hidden: truth.hidden.clone(),
        verdict: said.verdict(),
        headline: said.headline(),
        found: truth.hidden.iter().map(|h| said.named.iter().any(|label| stands_for(label, *h))).collect(),
        invented: said.named.iter().filter(|label| !is_there(label)).cloned().collect(),
        errors: truth
            .numbers
            .iter()
            .filter_map(|(name, value)| Some((name.clone(), said.error(told_as(name), *value, false)?)))
            .collect(),
        forecast: said.forecast("position after 2 s"),
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
    fn tyres_stand_for_each_other_and_nothing_else_does() {
        let truth = CarTruth {
            case: "a001".into(),
            hidden: vec![CarHidden::TyreSlip],
            has_tyres: true,
            numbers: [("front_compliance".to_owned(), 0.01)].into(),
        };
        let cause = |id: &str| {
            json!({ "effect": id, "name": id, "probability": 0.9,
                "parameters": { "compliance of the front tyres": { "value": 0.012, "sigma": 0.002 } } })
        };
        let said = json!({ "verdict": "explained", "sentences": ["x"], "indistinguishable": [],
            "ranked": [cause("grip_limit"), cause("tyre_slip"), cause("steering_lag")] });
        let row = row(&truth, &said, None);
        assert_eq!((row.found, row.invented), (vec![true], vec!["steering_lag".to_owned()]));
        assert!((row.errors[0].1 - 1.0 / 1.645).abs() < 1e-9);
    }

    #[test]
    fn every_hidden_thing_is_a_cause_of_the_catalogue() {
        for hidden in CarHidden::ALL {
            assert!(catalogue::car::ALL.iter().any(|spec| spec.id == cause(hidden)), "{hidden:?}");
        }
    }
}
