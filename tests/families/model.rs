//! What the model has wrong besides: families 11 and 16.

use examiner::{EffectId, Settings, TyreLaw};
use robot_model::Robot;

use crate::common::{case_of, draw};
use crate::rules::{answer, diagnosed, is_named, nothing_is_claimed_but, nothing_is_missing, strong};

/// A case whose robot file is wrong in a constant, in references and recordings alike.
fn off(seed: u64, effects: &[EffectId], change: impl Fn(&mut Robot<f64>)) -> verdict::Diagnosis {
    let mut case = case_of(&draw(&strong(effects), seed));
    change(&mut case.robot);
    answer(&format!("seed {seed}, {effects:?}, constant off"), &case)
}

#[test]
fn a_constant_that_is_a_fifth_off_is_no_mismatch() {
    nothing_is_missing(&off(111, &[], |r| r.yaw_inertia *= 1.2));
    nothing_is_missing(&off(211, &[], |r| r.mass *= 0.8));
}

#[test]
fn a_constant_that_is_a_fifth_off_hides_no_effect() {
    is_named(&off(311, &[EffectId::MotorLag], |r| r.adhesion *= 1.2), EffectId::MotorLag);
    is_named(
        &off(411, &[EffectId::QuadraticDrag], |r| r.viscous = r.viscous.map(|v| 0.8 * v)),
        EffectId::QuadraticDrag,
    );
}

#[test]
fn another_tyre_law_changes_the_shape_and_not_the_name() {
    for (law, effect) in [(TyreLaw::Brush, EffectId::TurningResistance), (TyreLaw::Pacejka, EffectId::AdhesionPatch)] {
        let (_, d) = diagnosed(116, &Settings { law: Some(law), ..strong(&[effect]) });
        is_named(&d, effect);
        nothing_is_claimed_but(&d, &[effect]);
    }
}
