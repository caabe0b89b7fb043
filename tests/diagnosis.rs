//! Whole diagnoses of blind cases: drawn by the examiner's plant, read as files, diagnosed, compared with the truth.

mod common;

use std::path::Path;

use common::{answer, case_of, draw, settings, told};
use examiner::{Content, DrawnCase, EffectId};
use inference::Options;
use torque_driven::diagnose;
use verdict::{Diagnosis, Prediction, Verdict};

/// A case and its diagnosis.
fn of(content: Content, seed: u64) -> (DrawnCase, Diagnosis) {
    let drawn = draw(&settings(content, 24.0, 1), seed);
    let out = answer(&case_of(&drawn), &Options::default());
    (drawn, out)
}

/// The first cause is the only effect that was hidden, with its size.
fn names(effect: EffectId, seed: u64, tolerance: f64) -> (DrawnCase, Diagnosis) {
    let (drawn, d) = of(Content::Effects(vec![effect]), seed);
    assert_eq!(d.verdict, Verdict::Explained, "{}", told(&d));
    assert_eq!(d.ranked[0].effect, effect.id(), "{}", told(&d));
    assert!(d.ranked[0].probability > 0.5, "{}", told(&d));
    let (found, truth) = (d.ranked[0].magnitude.expect("a size"), drawn.truth.effects[0].magnitude);
    assert!((found / truth - 1.0).abs() < tolerance, "found {found}, truth {truth}");
    (drawn, d)
}

/// Rms error of predicted wheel speeds (rad/s) and yaw rate (rad/s) against the true response.
fn errors(drawn: &DrawnCase, p: &Prediction) -> [f64; 2] {
    let file = format!("heldout/{}.csv", p.name);
    let (_, bytes) = drawn.truth_files.iter().find(|(path, _)| path == Path::new(&file)).expect("a true response");
    let text = std::str::from_utf8(bytes).expect("text");
    let (mut wheel, mut yaw, mut n) = (0.0, 0.0, 0.0);
    for (k, line) in text.lines().skip(1).enumerate() {
        let v: Vec<f64> = line.split(',').map(|c| c.parse().expect("a number")).collect();
        assert!((v[0] - p.time[k]).abs() < 1e-6);
        wheel += 0.5 * ((v[1] - p.wheel_speed[k][0]).powi(2) + (v[2] - p.wheel_speed[k][1]).powi(2));
        yaw += (v[3] - p.yaw_rate[k]).powi(2);
        n += 1.0;
    }
    assert!(n > 1000.0);
    [(wheel / n).sqrt(), (yaw / n).sqrt()]
}

#[test]
fn nothing_hidden_is_no_mismatch() {
    let (_, d) = of(Content::Null, 2);
    assert_eq!(d.verdict, Verdict::NoMismatch, "{}", told(&d));
    assert_eq!(d.ranked[0].effect, "none", "{}", told(&d));
}

#[test]
fn viscous_friction_is_named_and_improves_what_was_not_fitted() {
    let (drawn, d) = names(EffectId::ViscousFriction, 3, 0.15);
    let (corrected, plain) = &d.predictions[0];
    let (corrected, plain) = (errors(&drawn, corrected), errors(&drawn, plain));
    assert!(corrected[0] < 0.5 * plain[0], "wheel speed: corrected {corrected:?}, plain {plain:?}");
    assert!(corrected[1] < plain[1], "yaw rate: corrected {corrected:?}, plain {plain:?}");
    let c = &d.ranked[0].parameters.values().next().copied().expect("viscous friction has a number");
    assert!(c.sigma.is_some_and(|s| s > 0.0 && s < 0.2 * c.value) && !c.at_bound, "{c:?}");
    // The same on recordings that were left out one at a time, from measured states and over the whole of each.
    assert_eq!(d.free_runs.len(), 4 * 3);
    for f in d.free_runs.iter().filter(|f| f.quantity.starts_with("wheel speed, ")) {
        assert!(f.corrected < f.retuned && f.retuned < f.nominal, "{f:?}");
    }
    assert!(d.unexplained.is_some_and(|u| u < 0.2), "{:?}", d.unexplained);
}

#[test]
fn without_a_gyro_wheels_alone_are_compared_and_the_answer_reads_back_from_its_file() {
    let mut case = case_of(&draw(&settings(Content::Effects(vec![EffectId::ViscousFriction]), 9.0, 0), 3));
    for run in case.references.iter_mut().chain(&mut case.recordings) {
        run.gyro.fill(None);
    }
    let d = answer(&case, &Options::default());
    assert!(!d.free_runs.is_empty());
    assert!(
        d.free_runs.iter().all(|f| f.quantity.starts_with("wheel speed") && f.corrected > 0.0),
        "{:?}",
        d.free_runs
    );
    let file = serde_json::to_string(&d).expect("JSON");
    let back: Diagnosis = serde_json::from_str(&file).expect("a diagnosis");
    assert_eq!(back.free_runs, d.free_runs);
}

#[test]
fn payload_is_named_and_improves_what_was_not_fitted() {
    let (drawn, d) = names(EffectId::Payload, 5, 0.15);
    let (corrected, plain) = &d.predictions[0];
    let (corrected, plain) = (errors(&drawn, corrected), errors(&drawn, plain));
    assert!(corrected[0] < 0.5 * plain[0], "wheel speed: corrected {corrected:?}, plain {plain:?}");
}

#[test]
fn a_gyro_bias_is_a_fault_of_the_sensor_and_not_of_the_physics() {
    let (drawn, d) = names(EffectId::GyroBias, 2, 0.25);
    let second = d.ranked.iter().find(|c| !["gyro_bias", "none", "unknown"].contains(&c.effect.as_str()));
    assert!(second.is_none_or(|c| c.probability < 0.5), "{}", told(&d));
    let (corrected, plain) = &d.predictions[0];
    let (corrected, plain) = (errors(&drawn, corrected), errors(&drawn, plain));
    assert!(corrected[1] < plain[1], "yaw rate: corrected {corrected:?}, plain {plain:?}");
}

#[test]
fn both_of_a_pair_are_named() {
    let pair = [EffectId::Payload, EffectId::CoulombSide];
    let (drawn, d) = of(Content::Effects(pair.to_vec()), 17);
    assert_eq!(d.verdict, Verdict::Explained, "{}", told(&d));
    let first: Vec<&str> = d.ranked.iter().take(2).map(|c| c.effect.as_str()).collect();
    for (effect, truth) in pair.iter().zip(&drawn.truth.effects) {
        assert!(first.contains(&effect.id().as_str()), "{}", told(&d));
        let found = d.ranked.iter().find(|c| c.effect == truth.id).expect("named");
        assert_eq!(found.side.as_deref(), truth.side.as_deref(), "{}", told(&d));
    }
}

#[test]
fn the_answer_does_not_depend_on_the_number_of_threads() {
    let case = case_of(&draw(&settings(Content::Effects(vec![EffectId::ConstantPull]), 9.0, 1), 19));
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| diagnose(&case, &Options::default(), &|_| {}).expect("a diagnosis"))
    };
    let (one, two) = (on(1), on(2));
    assert_eq!(one.verdict, two.verdict);
    assert_eq!(one.ranked, two.ranked);
    assert_eq!(one.trials, two.trials);
    assert_eq!(one.costs, two.costs);
    assert_eq!(one.predictions, two.predictions);
}
