//! Whole advice on made-up cases.

use robot_model::Robot;

use super::follow::{Follower, observe};
use super::*;
use crate::fit::{Hypothesis, Problem};
use crate::regimes::Regimes;
use crate::testing::{cutting, driven, problem};
use crate::windows::{Cut, cut};
use inference::hypothesis::{Place, Variant, variants};
use testing::robot;
use verdict::Course;

/// A slow straight drive of the plain robot, as a recording without noise.
fn straight(robot: &Robot<f64>) -> Cut {
    let seen = [cut(&driven(robot, &[], 6.0), &cutting())];
    let follower = Follower::new(&problem(robot, &seen)).expect("a recording");
    let course = Course::of_levels(&[[0.3, 0.0], [-0.3, 0.0]], 12.0);
    let mut cut = follower.drive(robot, &[], &course, [0.0; 3], true);
    let own = [cut.clone()];
    let problem = problem(robot, &own);
    observe(&mut cut, &problem.response(&problem.origin(), &Hypothesis::default())[0]);
    cut
}

fn form(id: &str) -> Variant {
    variants(true).into_iter().find(|v| v.spec().id == id && v.place == Place::Whole).expect("in the catalogue")
}

/// Rivals of equal probability: nothing, and these effects at these sizes.
fn open(problem: &Problem<'_>, effects: &[(&str, Vec<f64>)]) -> Vec<Rival> {
    let mut hypotheses = vec![(Hypothesis::default(), Vec::new())];
    hypotheses.extend(effects.iter().map(|(id, e)| (Hypothesis::single(form(id), Vec::new()), e.clone())));
    let share = 1.0 / hypotheses.len() as f64;
    let rival = |(h, effects): &(Hypothesis, Vec<f64>)| {
        let point = crate::fit::Point { effects: effects.clone(), ..problem.origin() };
        Rival::new(problem, h, &problem.begin(h, point, None), share).expect("determined")
    };
    hypotheses.iter().map(rival).collect()
}

fn advised(problem: &Problem<'_>, rivals: &[Rival]) -> Advice {
    let scope = Scope::new(&[], problem.cuts, problem.robot, 12.0);
    among(problem, &Regimes::default(), &scope, rivals, 0.0)
}

fn turns(m: &Manoeuvre) -> f64 {
    m.profile.iter().fold(0.0, |most, p| p[2].abs().max(most))
}

#[test]
fn rivals_that_only_turning_can_split_get_a_turning_drive_first() {
    let robot = robot();
    let cuts = [straight(&robot)];
    let problem = problem(&robot, &cuts);
    let advice = advised(&problem, &open(&problem, &[("turning_resistance", vec![0.4])]));
    approx::assert_relative_eq!(advice.entropy_bits, 1.0, epsilon = 1e-12);
    assert_eq!(advice.withheld, None);
    let best = advice.best().expect("a drive");
    assert!(turns(best) > 0.1 && best.expected_bits > 0.5, "{} {}", best.name, best.expected_bits);
    assert!(best.splits.is_some() && best.why.contains("turning"), "{}", best.why);
    let plain: Vec<&Manoeuvre> = advice.manoeuvres.iter().filter(|m| m.joins && turns(m) == 0.0).collect();
    assert!(plain.len() >= 5);
    for m in plain {
        assert!(m.expected_bits < 0.3 * best.expected_bits, "{} {}", m.name, m.expected_bits);
    }
    // What skids cannot show on wheels in the air.
    let lifted = advice.manoeuvres.iter().find(|m| m.name.starts_with("wheels off")).expect("on the menu");
    assert!(lifted.expected_bits < 1e-6 && !lifted.joins, "{}", lifted.expected_bits);
}

#[test]
fn what_sits_in_the_drivetrain_shows_with_wheels_in_the_air() {
    let robot = robot();
    let cuts = [straight(&robot)];
    let problem = problem(&robot, &cuts);
    let advice = advised(&problem, &open(&problem, &[("viscous_friction", vec![0.2])]));
    let lifted = advice.manoeuvres.iter().find(|m| m.name.starts_with("wheels off")).expect("on the menu");
    assert!(lifted.expected_bits > 0.1, "{}", lifted.expected_bits);
}

#[test]
fn one_rival_leaves_nothing_to_split_and_its_size_to_narrow() {
    let robot = robot();
    let cuts = [straight(&robot)];
    let problem = problem(&robot, &cuts);
    let mut rivals = open(&problem, &[("turning_resistance", vec![0.3])]);
    rivals.remove(0);
    rivals[0].probability = 1.0;
    let advice = advised(&problem, &rivals);
    assert!(advice.withheld.as_ref().is_some_and(|w| w.starts_with("nothing is left to tell apart")));
    let best = advice.best().expect("a drive");
    assert_eq!((best.expected_bits, advice.entropy_bits), (0.0, 0.0));
    assert!(best.narrows.is_some_and(|n| n < 0.5) && turns(best) > 0.1, "{} {:?}", best.name, best.narrows);
    rivals.clear();
    assert!(advised(&problem, &rivals).withheld.is_some());
}

#[test]
fn advice_is_the_same_whatever_the_number_of_threads() {
    let robot = robot();
    let cuts = [straight(&robot)];
    let problem = problem(&robot, &cuts);
    let rivals = open(&problem, &[("turning_resistance", vec![0.3]), ("viscous_friction", vec![0.05])]);
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| advised(&problem, &rivals))
    };
    assert!(with(1) == with(3));
}

#[test]
fn what_the_simulation_is_given_until_the_end_of_a_drive_is_part_of_the_next_one_from_its_beginning() {
    let robot = robot();
    let mut seen = [cut(&driven(&robot, &[], 6.0), &cutting())];
    let course = Course::of_levels(&[[0.3, 0.0], [-0.3, 0.0]], 12.0);
    let effort = |seen: &[Cut]| -> f64 {
        let follower = Follower::new(&problem(&robot, seen)).expect("a recording");
        follower.drive(&robot, &[], &course, [0.0; 3], true).torque.iter().flatten().map(|t| t.abs()).sum()
    };
    let plain = effort(&seen);
    let brake = |from: f64| {
        let mut dose = form("viscous_friction").dose(&[0.4], None);
        dose.presence.from = from;
        dose
    };
    let mut given = |from: f64| {
        seen[0].given = vec![brake(from)];
        effort(&seen)
    };
    let always = given(f64::MIN);
    assert!(always > 1.1 * plain, "{always} {plain}");
    assert_eq!((given(5.0), given(f64::MAX)), (always, plain), "from an instant on, and in no row");
}
