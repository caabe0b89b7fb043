//! Drives in which the calibration was right stand in the place of the robot file.

#[expect(dead_code, reason = "shared with tests that hide more")]
mod drawn;

use drawn::{Hidden, Kind, drawn};
use odometry::{Answer, Case, diagnose};

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
fn what_references_do_not_have_is_named() {
    let before = drawn(Kind::Differential, Hidden::Nothing, 3, 60.0, 71).case;
    let mut case = drawn(Kind::Differential, Hidden::OneRadius, 3, 60.0, 71).case;
    case.references = before.recordings;
    let (answer, causes) = named(&case);
    assert_eq!((answer, causes.first()), (Answer::Named, Some(&"radius_of_one_wheel")), "{causes:?}");
}
