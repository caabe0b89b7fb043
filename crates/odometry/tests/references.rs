//! Drives in which the calibration was right stand in the place of the robot file.

#[expect(dead_code, reason = "shared with tests that hide more")]
mod drawn;

use drawn::{Hidden, Kind, drawn};
use odometry::{Answer, Case, Table, diagnose, diagnosis};

fn named(case: &Case) -> (Answer, Vec<&'static str>) {
    let findings = diagnose(case, &|_| {}).expect("an answer");
    (findings.answer, findings.named.iter().map(|c| c.spec.id).collect())
}

#[test]
fn what_references_have_too_is_not_named_again() {
    for (kind, seed) in [(Kind::Differential, 61), (Kind::Omni3, 62)] {
        // The same draw: the first half of the sessions as references, the rest as recordings.
        let whole = drawn(kind, Hidden::AllRadii, 6, 60.0, seed).case;
        let (_, causes) = named(&whole);
        assert_eq!(causes.first(), Some(&"radius_of_all_wheels"), "{kind:?}");
        let mut split = whole.clone();
        split.references = split.recordings.drain(..3).collect();
        let (answer, causes) = named(&split);
        assert!(matches!(answer, Answer::Nothing | Answer::Retune), "{kind:?}: {answer:?} {causes:?}");
    }
}

#[test]
fn smaller_radii_of_all_wheels_come_with_what_looks_the_same() {
    let mut seen = [false; 2];
    for seed in 61..67 {
        let case = drawn(Kind::Differential, Hidden::AllRadii, 3, 60.0, seed).case;
        let findings = diagnose(&case, &|_| {}).expect("an answer");
        assert_eq!(findings.named[0].spec.id, "radius_of_all_wheels", "{seed}");
        let is_smaller = findings.named[0].estimates[0].value < findings.named[0].estimates[0].given;
        let told = diagnosis(&findings, &Table::default(), false);
        let is_told = told.limits.iter().any(|limit| limit.contains("a brake that drags"));
        assert_eq!(is_told, is_smaller, "{seed}: {:?}", told.limits);
        seen[usize::from(is_smaller)] = true;
    }
    assert_eq!(seen, [true; 2], "radii of both kinds are drawn");
}

#[test]
fn what_references_do_not_have_is_named() {
    let before = drawn(Kind::Differential, Hidden::Nothing, 3, 60.0, 71).case;
    let mut case = drawn(Kind::Differential, Hidden::OneRadius, 3, 60.0, 71).case;
    case.references = before.recordings;
    let (answer, causes) = named(&case);
    assert_eq!((answer, causes.first()), (Answer::Named, Some(&"radius_of_one_wheel")), "{causes:?}");
}

/// Angles behind which a steering follows with so much play, rad.
fn with_play(angles: &[f64], play: f64) -> Vec<f64> {
    let mut held = angles[0];
    let follow = |angle: &f64| {
        held = held.clamp(angle - play, angle + play);
        held
    };
    angles.iter().map(follow).collect()
}

#[test]
fn what_leaves_many_times_as_much_as_the_references_is_unknown_whatever_fits_best() {
    let mut case = drawn(Kind::Tricycle, Hidden::Nothing, 6, 60.0, 81).case;
    case.references = case.recordings.drain(..3).collect();
    let right = diagnose(&case, &|_| {}).expect("an answer");
    assert!(matches!(right.answer, Answer::Nothing | Answer::Retune), "{:?}", right.answer);
    // The angle that is recorded has play before the wheel: no cause of such robots.
    for drive in &mut case.recordings {
        drive.steering = drive.steering.as_ref().map(|angles| with_play(angles, 0.08));
    }
    let found = diagnose(&case, &|_| {}).expect("an answer");
    let (left, usual) = (found.shares[2], found.left_of_references.expect("references"));
    assert!(left > 4.0 * usual && left > 0.02, "{left} of {usual}");
    assert_eq!(found.answer, Answer::Unknown);
    let table = odometry::left_out(&case, &found, &|_| {}).expect("forecasts");
    let told = odometry::diagnosis(&found.after(&table), &table, true);
    assert!(told.sentences[0].contains("of the motion of the references, so that"), "{:?}", told.sentences);
}

#[test]
fn what_one_short_reference_hardly_shows_is_no_difference_where_the_recordings_show_it_too() {
    let mut case = drawn(Kind::Differential, Hidden::Distance, 4, 60.0, 91).case;
    case.recordings.truncate(3);
    case.references = drawn(Kind::Differential, Hidden::Distance, 4, 20.0, 91).case.recordings.split_off(3);
    let found = diagnose(&case, &|_| {}).expect("an answer");
    assert!(found.answer == Answer::Retune && found.named.is_empty(), "{:?}", found.named);
    let is_told =
        |text: &String| text.contains("references and recordings alike") && text.contains("wheel_distance (track)");
    assert!(found.told.iter().any(is_told), "{:?}", found.told);
}
