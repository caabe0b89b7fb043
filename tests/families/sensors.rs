//! Sensors that imitate physics, physics that imitates sensors, and noise of another law: families 5 and 12.

use examiner::{EffectId, Settings};
use torque_driven::Run;
use verdict::Diagnosis;

use crate::common::{case_of, draw, told};
use crate::damage::{coarse_steps, heavy_tails, lost_rows};
use crate::rules::{
    answer, diagnosed, is_named, no_physics_is_claimed_but, nothing_is_claimed_but, nothing_is_missing, strong,
};

#[test]
fn a_fault_of_a_sensor_that_imitates_physics_is_called_a_fault() {
    // A gyro that shows too much turning; an encoder that stands still now and then, as with slip or a lag.
    for (seed, effect) in [(105, EffectId::GyroScale), (205, EffectId::EncoderDropout)] {
        let (_, d) = diagnosed(seed, &strong(&[effect]));
        is_named(&d, effect);
        no_physics_is_claimed_but(&d, &[]);
    }
}

#[test]
fn physics_that_imitates_a_fault_of_a_sensor_is_called_physics() {
    // Wheels of two sizes turn a robot that should go straight, as a gyro with an offset says; a robot that resists
    // turning turns less than its wheels say, as a gyro that shows too little.
    for (seed, effect) in [(305, EffectId::WheelRadiusMismatch), (405, EffectId::TurningResistance)] {
        let (_, d) = diagnosed(seed, &strong(&[effect]));
        is_named(&d, effect);
        nothing_is_claimed_but(&d, &[effect]);
    }
}

#[test]
fn without_a_pose_a_gyro_that_shows_too_much_is_not_called_turning_resistance() {
    for (seed, effect) in [(505, EffectId::GyroScale), (605, EffectId::TurningResistance)] {
        let (_, d) = diagnosed(seed, &Settings { pose: false, ..strong(&[effect]) });
        nothing_is_claimed_but(&d, &[effect]);
        assert!(d.ranked.iter().take(2).any(|c| c.effect == effect.id()), "{}", told(&d));
    }
}

/// A case whose recordings are all spoilt alike.
fn spoilt(seed: u64, effects: &[EffectId], spoil: impl Fn(&mut [Run], u64)) -> Diagnosis {
    let mut case = case_of(&draw(&strong(effects), seed));
    spoil(&mut case.references, 1);
    spoil(&mut case.recordings, 2);
    answer(&format!("seed {seed}, {effects:?}, spoilt"), &case)
}

const EFFECT: EffectId = EffectId::ViscousFriction;

#[test]
fn heavy_tails_invent_nothing() {
    nothing_is_missing(&spoilt(112, &[], heavy_tails));
}

#[test]
fn heavy_tails_hide_nothing() {
    let d = spoilt(212, &[EFFECT], heavy_tails);
    is_named(&d, EFFECT);
    nothing_is_claimed_but(&d, &[EFFECT]);
}

#[test]
fn coarse_quantisation_invents_nothing_and_hides_nothing() {
    let coarse = |runs: &mut [Run], _| coarse_steps(runs);
    nothing_is_missing(&spoilt(312, &[], coarse));
    let d = spoilt(412, &[EFFECT], coarse);
    is_named(&d, EFFECT);
    nothing_is_claimed_but(&d, &[EFFECT]);
}

#[test]
fn lost_samples_invent_nothing_and_hide_nothing() {
    let torn = |seed, effects: &[EffectId]| {
        let mut drawn = draw(&strong(effects), seed);
        lost_rows(&mut drawn, 3);
        answer(&format!("seed {seed}, {effects:?}, rows lost"), &case_of(&drawn))
    };
    nothing_is_missing(&torn(512, &[]));
    let d = torn(612, &[EFFECT]);
    is_named(&d, EFFECT);
    nothing_is_claimed_but(&d, &[EFFECT]);
}
