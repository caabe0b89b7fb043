//! Where a hidden law acts, and at which place all are compared.

use examiner::EffectTruth;
use law::Place;

use super::super::judge::Judged;

/// The place at which a hidden law acts; `None` of what is no law.
pub(in super::super) fn true_place(e: &EffectTruth) -> Option<Place> {
    let drive = match e.side.as_deref() {
        Some("left") => Place::TorqueLeft,
        Some("right") => Place::TorqueRight,
        _ => Place::TorqueBoth,
    };
    let of_kind = |kind: &str| match kind {
        "arctan_drag" | "warming_friction" | "wide_hysteresis" | "resonant_friction" | "fading_friction" => Some(drive),
        "turn_drag" | "logarithmic_drag" | "heading_drag" => Some(Place::ForceForward),
        "fading_turn_resistance" => Some(Place::YawMoment),
        "fading_grip" => Some(Place::GripAll),
        _ => None,
    };
    match e.id.as_str() {
        "viscous_friction" | "coulomb_friction" | "coulomb_side" | "stiction" | "rolling_resistance"
        | "thermal_drift" | "torque_constant" | "drivetrain_ripple" => Some(drive),
        "quadratic_drag" | "constant_pull" | "grade" => Some(Place::ForceForward),
        "adhesion_patch" | "slip_stiffness" => Some(Place::GripAll),
        "turning_resistance" => Some(Place::YawMoment),
        _ => e.kind.as_deref().and_then(of_kind),
    }
}

/// The place of the series: what Lacuna told, where that is right, for a friction of both drives is a force on the body as
/// well; else where the hidden law acts. Of forces on the body, and slopes, it is the fore-aft one.
pub(super) fn of(hidden: Option<&EffectTruth>, judged: &Judged) -> Place {
    let told = judged.place.as_deref().filter(|_| judged.place_right);
    let told = told.and_then(|name| Place::ALL.into_iter().find(|p| p.name() == name));
    let truly = || hidden.and_then(true_place).unwrap_or(Place::ForceForward);
    match told.unwrap_or_else(truly) {
        Place::ForceBoth | Place::SlopeX | Place::SlopeY => Place::ForceForward,
        place => place,
    }
}

#[cfg(test)]
mod tests {
    use examiner::LawKind;

    use super::super::super::{foreign, judge};
    use super::*;

    fn truth(id: &str, kind: Option<&str>, side: Option<&str>) -> EffectTruth {
        let json = serde_json::json!({
            "id": id, "kind": kind, "side": side, "severity": 1, "magnitude": 1.0, "excess": 2.0,
        });
        serde_json::from_value(json).expect("an effect")
    }

    #[test]
    fn every_hidden_law_acts_at_a_place_that_the_judge_holds_right() {
        for (id, places, _) in judge::LAWS {
            let place = true_place(&truth(id, None, Some("left"))).unwrap_or_else(|| panic!("{id} has no place"));
            let is_side = place == Place::TorqueLeft && places.contains(&"T_both");
            assert!(is_side || places.iter().any(|p| place.symbol().starts_with(p)), "{id}: {place:?}");
        }
        for kind in LawKind::ALL {
            let name = serde_json::to_value(kind).expect("a name");
            for side in [None, Some("right")] {
                let e = truth(judge::OUTSIDE, name.as_str(), side);
                let place = true_place(&e).unwrap_or_else(|| panic!("{kind:?} has no place"));
                let is_of_drives = place == Place::TorqueRight || place == Place::TorqueBoth;
                // Only drives have sides.
                let right =
                    side.is_some() && !is_of_drives || foreign::places(&e).iter().any(|p| place.name().starts_with(p));
                assert!(right, "{kind:?} {side:?}: {place:?}");
            }
        }
        assert_eq!(true_place(&truth("out_of_library", Some("gusts"), None)), None);
    }

    #[test]
    fn a_right_place_that_was_told_is_taken_and_a_wrong_one_is_not() {
        let hidden = truth("viscous_friction", None, None);
        let told = |place: Place, is_right: bool| Judged {
            place: Some(place.name().to_owned()),
            place_right: is_right,
            ..Judged::default()
        };
        assert_eq!(of(Some(&hidden), &told(Place::ForceBoth, true)), Place::ForceForward);
        assert_eq!(of(Some(&hidden), &told(Place::GripLeft, false)), Place::TorqueBoth);
        assert_eq!(of(Some(&hidden), &Judged::default()), Place::TorqueBoth);
    }
}
