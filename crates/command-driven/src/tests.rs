//! Whole diagnoses of made-up robots.

use verdict::{Diagnosis, FreeRun, Parameter, Scaling, Verdict};

use super::controller::{DAMPING, DEAD_TIME, FREQUENCY, TURN_LIMIT};
use super::ground::TRACK;
use super::testing::{Truth, diagnosed, robot};
use super::*;
use crate::run::STEP;

fn parameter<'a>(d: &'a Diagnosis, id: &str) -> &'a Parameter {
    let all = &d.response.as_ref().expect("a response").parameters;
    all.iter().find(|p| p.id == id).unwrap_or_else(|| panic!("no {id} in {all:?}"))
}

/// Twice the 90 % interval holds the truth in all but one of a thousand.
fn holds(d: &Diagnosis, id: &str, truth: f64) {
    let p = parameter(d, id);
    let half = p.half_width.expect("an interval");
    assert!((p.value - truth).abs() < 2.0 * half, "{id}: {} ± {half}, not {truth}", p.value);
    // Of a dead time rows tell no better than half a row.
    let least = if id == "dead_time" { 0.5 * STEP } else { 0.01 };
    assert!(half < (0.1 * truth.abs()).max(least), "{id}: ± {half} is no answer");
}

fn run<'a>(d: &'a Diagnosis, quantity: &str) -> &'a FreeRun {
    d.free_runs.iter().find(|r| r.recording == "held out" && r.quantity.starts_with(quantity)).expect("a row")
}

#[test]
fn a_stock_controller_is_found_with_its_constants() {
    let truth = Truth::stock();
    let d = diagnosed(&truth, None);
    assert_eq!(d.verdict, Verdict::Explained);
    assert_eq!(d.ranked[0].effect, "drive_command");
    for id in ["transport_delay", "motor_lag"] {
        let p = d.ranked.iter().find(|c| c.effect == id).map_or(0.0, |c| c.probability);
        assert!(p > 0.9, "{id}: {p}");
    }
    let response = d.response.as_ref().expect("a response");
    assert_eq!(response.scaling, Some(Scaling::Proportional.words().into()));
    let truth = [
        ("dead_time", 0.22),
        ("forward_gain", 1.3),
        ("turn_gain", 0.8),
        ("turn_limit", 3.0),
        ("wheel_limit", 6.0),
        ("forward_ramp", 10.0),
        ("turn_ramp", 4.0),
        ("lag", 0.12),
    ];
    for (id, value) in truth {
        holds(&d, id, value);
    }
    // Nothing is wrong on the ground, and nothing is said to be.
    assert!(response.parameters.iter().all(|p| p.element.is_drive()), "{:?}", response.parameters);
    assert!(d.sentences[0].contains("do not do what is commanded"), "{:?}", d.sentences);
    let r = run(&d, "wheel speed");
    assert!(r.corrected < 0.2 && 5.0 * r.corrected < r.nominal, "{r:?}");
    assert!(r.placebo.is_some_and(|p| p > 1.5 * r.corrected), "{r:?}");
}

#[test]
fn how_sides_are_held_at_the_limit_is_told_apart() {
    for scaling in [Scaling::EachSide, Scaling::TurnFirst] {
        let mut truth = Truth::stock();
        truth.law.scaling = scaling;
        truth.drive[TURN_LIMIT] = f64::INFINITY;
        let d = diagnosed(&truth, None);
        assert_eq!(d.response.as_ref().expect("a response").scaling, Some(scaling.words().into()));
        holds(&d, "wheel_limit", 6.0);
    }
}

#[test]
fn a_second_order_lag_is_preferred_where_it_is() {
    let mut truth = Truth::stock();
    truth.law.second_order = true;
    (truth.drive[FREQUENCY], truth.drive[DAMPING]) = (8.0, 0.5);
    let d = diagnosed(&truth, None);
    holds(&d, "natural_frequency", 8.0);
    holds(&d, "damping", 0.5);
}

#[test]
fn a_perfect_robot_has_no_mismatch() {
    let d = diagnosed(&Truth::perfect(), None);
    assert_eq!(d.verdict, Verdict::NoMismatch, "{:?}", d.ranked);
    assert_eq!(d.ranked[0].effect, "none");
    assert!(d.sentences[0].starts_with("No mismatch"));
}

#[test]
fn a_wrong_track_is_the_track_and_not_the_command() {
    let mut truth = Truth::perfect();
    truth.ground[TRACK] = 1.6;
    let d = diagnosed(&truth, None);
    assert_eq!(d.ranked[0].effect, "effective_track", "{:?}", d.ranked);
    holds(&d, "track_factor", 1.6);
    // The radius is fitted beside it, since no file knows it for sure, and nothing is said of one that is right.
    holds(&d, "radius_factor", 1.0);
    assert_eq!(d.response.as_ref().expect("a response").parameters.len(), 2);
    assert!(d.retuned.is_empty() && d.ranked[1].probability < 0.5, "{:?} {:?}", d.retuned, d.ranked);
    assert!(d.sentences[0].contains("The wheels do what is commanded"), "{:?}", d.sentences);
    let r = run(&d, "yaw");
    assert!(2.0 * r.corrected < r.nominal && r.placebo.is_some_and(|p| p > 1.5 * r.corrected), "{r:?}");
}

#[test]
fn what_the_references_do_as_well_is_not_missing() {
    let reference = Truth::stock();
    let same = diagnosed(&Truth::stock(), Some(&reference));
    assert_eq!(same.verdict, Verdict::NoMismatch, "{:?}", same.ranked);
    let mut later = Truth::stock();
    later.drive[DEAD_TIME] = 0.4;
    let d = diagnosed(&later, Some(&reference));
    assert_eq!(d.ranked[0].effect, "transport_delay", "{:?}", d.ranked);
    holds(&d, "dead_time", 0.4);
    approx::assert_abs_diff_eq!(parameter(&d, "dead_time").simulated.expect("known"), 0.22, epsilon = 0.02);
}

#[test]
fn too_few_steps_are_refused() {
    let runs = vec![Truth::stock().run("a", LEAST_STEPS - 1, 1)];
    let case = |recordings| ResponseCase {
        robot: robot(),
        geometry_sigma: [0.01; 2],
        references: vec![],
        recordings,
        held_out: vec![],
    };
    let error = diagnose_response(&case(runs), &Options::default(), &|_| {}).expect_err("refused").to_string();
    assert!(error.contains("9 command steps") && error.contains("10 are needed"), "{error}");
    assert!(matches!(
        diagnose_response(&case(vec![]), &Options::default(), &|_| {}),
        Err(DiagnosisError::Empty { what: "recording" })
    ));
}
