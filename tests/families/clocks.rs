//! Clocks that differ between channels: family 6. No physics may be named for them.

use examiner::EffectId;
use torque_driven::{Case, Run};
use verdict::Diagnosis;

use crate::common::{case_of, draw};
use crate::damage::{drifting, late, on_gyro, on_pose};
use crate::rules::{answer, no_physics_is_claimed_but, nothing_is_claimed_but, strong};

/// Rows of 10 ms: a pose from a tracker that is 0.3 s late, a gyro behind a filter of 0.1 s.
const POSE: usize = 30;
const GYRO: usize = 10;
/// A pose clock that gains 8 ms a second.
const DRIFT: f64 = 0.008;

fn shifted(seed: u64, effects: &[EffectId], everywhere: bool, shift: impl Fn(&mut [Run])) -> Diagnosis {
    let mut case: Case = case_of(&draw(&strong(effects), seed));
    if everywhere {
        shift(&mut case.references);
    }
    shift(&mut case.recordings);
    let d = answer(&format!("seed {seed}, {effects:?}, shifted, references too: {everywhere}"), &case);
    no_physics_is_claimed_but(&d, effects);
    d
}

#[test]
fn a_pose_that_is_always_late_is_not_taken_for_physics_nor_for_a_fault_of_the_gyro() {
    nothing_is_claimed_but(&shifted(106, &[], true, |runs| on_pose(runs, |c| late(c, POSE))), &[]);
    shifted(206, &[EffectId::ViscousFriction], true, |runs| on_pose(runs, |c| late(c, POSE)));
}

#[test]
fn a_gyro_that_is_always_late_is_not_taken_for_physics() {
    shifted(406, &[EffectId::ViscousFriction], true, |runs| on_gyro(runs, |c| late(c, GYRO)));
}

#[test]
fn a_pose_that_is_late_in_the_recordings_only_is_not_taken_for_physics_nor_for_a_fault_of_the_gyro() {
    nothing_is_claimed_but(&shifted(506, &[], false, |runs| on_pose(runs, |c| late(c, POSE))), &[]);
}

#[test]
fn a_gyro_that_is_late_in_the_recordings_only_is_not_taken_for_physics() {
    shifted(606, &[], false, |runs| on_gyro(runs, |c| late(c, GYRO)));
}

#[test]
fn a_pose_clock_that_drifts_in_the_recordings_only_is_not_taken_for_physics() {
    shifted(706, &[], false, |runs| on_pose(runs, |c| drifting(c, DRIFT)));
}
