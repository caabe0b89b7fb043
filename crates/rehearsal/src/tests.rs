//! Whole rehearsals on short drives.

use inference::Options;
use recordings::Recording;
use testing::{recording, robot, samples};
use torque_driven::{Case, KnownBy, Run, Visit, simulate};
use verdict::{FoundFrom, Rehearsal};

use recordings::Signal;

use crate::{Plan, RehearsalError, rehearse};

/// Torques of a drive in curves.
fn inputs(name: &str, seconds: usize, phase: f64) -> Recording {
    let side = |turn: f64| {
        samples(100 * seconds, move |t| 1.6 + 1.2 * (0.9 * t + phase).sin() + turn * 3.0 * (0.7 * t - phase).sin())
    };
    let made = recording(&[(Signal::TorqueLeft, side(-1.0)), (Signal::TorqueRight, side(1.0))]);
    Recording::new(name, made.clocks().to_vec(), made.channels().to_vec()).expect("a recording")
}

fn case() -> Case {
    let run = |name: &str, phase: f64| {
        let driven = simulate(&robot(), &[], &inputs(name, 8, phase), &Options::default()).expect("finite");
        Run::new(&driven).expect("a run")
    };
    Case { recordings: vec![run("a", 0.0), run("b", 1.0)], ..Case::new(robot()) }
}

fn plan() -> Plan {
    Plan {
        sizes: vec![8.0],
        effects: vec!["coulomb_side".to_owned()],
        references: Some(2),
        replicas: 2,
        fault_free: 2,
        ..Plan::default()
    }
}

fn rehearsed(case: &Case, plan: &Plan) -> Rehearsal {
    rehearse(case, plan, &Options::default(), &|_| {}).expect("a rehearsal")
}

/// The case with drives of these visits.
fn of_visits(names: [&str; 2]) -> Case {
    let mut case = case();
    for (run, name) in case.recordings.iter_mut().zip(names) {
        run.visit = Some(Visit { name: name.to_owned(), known_by: KnownBy::User });
    }
    case
}

#[test]
fn constants_of_replicas_move_between_visits_and_not_within_one() {
    let (plan, options) = (Plan { references: Some(0), ..plan() }, Options::default());
    // By how much the adhesion of one drive differs from that of the other, over some replicas.
    let apart = |case: &Case| -> f64 {
        let rehearsing = crate::rehearse::Rehearsing::new(case, &plan, &options).expect("a plan");
        let of = |replica: usize| {
            let robots = rehearsing.robots_of(replica).expect("a replica");
            (robots[0].adhesion / robots[1].adhesion).ln().abs()
        };
        (0..6).map(of).sum()
    };
    let within = apart(&of_visits(["today", "today"]));
    assert!((within - apart(&case())).abs() < 1e-12, "a name for all drives moves nothing");
    assert!(apart(&of_visits(["monday", "tuesday"])) > 2.0 * within, "{within}");
}

#[test]
fn a_strong_effect_is_found_and_nothing_is_alarmed_on_a_short_drive() {
    let told = rehearsed(&case(), &plan());
    assert_eq!((told.fault_free.replicas, told.fault_free.alarmed()), (2, 0), "{:?}", told.fault_free);
    let brake = &told.effects[0];
    assert_eq!((brake.effect.as_str(), brake.sizes[0].answers.found()), ("coulomb_side", 2), "{:?}", brake.sizes[0]);
    assert!(matches!(brake.found, FoundFrom::Below(size) if size > 0.0));
    assert_eq!((told.drives.references, told.drives.recordings.len()), (2, 2));
    assert!(told.shortened.is_empty(), "{:?}", told.shortened);
}

#[test]
fn the_answer_does_not_depend_on_the_number_of_threads() {
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| rehearsed(&case(), &plan()))
    };
    let one = on(1);
    assert_eq!(one, on(3));
    let other = Plan { seed: 2, ..plan() };
    assert_ne!(one.effects[0].sizes[0].driven, rehearsed(&case(), &other).effects[0].sizes[0].driven, "another seed");
}

#[test]
fn channels_that_the_recordings_lack_stay_missing_and_what_they_would_show_is_left_out() {
    let mut case = case();
    for run in &mut case.recordings {
        run.accel = run.accel.clone().map(|axis| vec![None; axis.len()]);
    }
    let effects = ["accelerometer_bias", "clock_offset"].map(str::to_owned).to_vec();
    let told = rehearsed(&case, &Plan { effects, fault_free: 1, replicas: 1, references: Some(0), ..plan() });
    assert!(told.effects.is_empty());
    let why: Vec<(&str, bool)> =
        told.left_out.iter().map(|l| (l.effect.as_str(), l.why.contains("channel that would show it"))).collect();
    assert_eq!(why, [("clock_offset", false), ("accelerometer_bias", true)]);
    assert!(told.drives.noise.iter().all(|noise| !noise.channel.starts_with("accel")));
    assert!(told.limits.iter().any(|limit| limit.contains("there is no reference")));
}

#[test]
fn what_was_shortened_is_said() {
    let plan = Plan { recordings: 1, seconds: 5.0, effects: vec!["clock_offset".to_owned()], fault_free: 1, ..plan() };
    let told = rehearsed(&case(), &Plan { replicas: 1, ..plan });
    assert_eq!(told.shortened.len(), 2, "{:?}", told.shortened);
    assert!((told.drives.recordings["a"] - 5.0).abs() < 1e-9);
}

#[test]
fn what_cannot_be_rehearsed_is_refused_in_a_sentence() {
    let refused = |case: &Case, plan: &Plan| rehearse(case, plan, &Options::default(), &|_| {}).expect_err("refused");
    let empty = refused(&Case::new(robot()), &plan());
    assert!(!empty.is_of_plan() && empty.to_string().contains("no recording"), "{empty}");
    let short = refused(&case(), &Plan { seconds: 1.0, ..plan() });
    assert!(short.to_string().contains("'a' has 100 rows"), "{short}");
    let unknown = refused(&case(), &Plan { effects: vec!["wind".to_owned()], ..plan() });
    assert!(matches!(unknown, RehearsalError::UnknownEffect { .. }));
}
