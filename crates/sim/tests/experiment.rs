//! The experiment as a whole: distribution, symmetry, identities on the real run, determinism, failure.

use std::sync::LazyLock;

use controller::{Loop, Turn};
use robot_model::paper::{PaperRobot, Parameters, State};
use sim::table1::{self, PAPER};
use sim::{Experiment, Recipe, RobotSet, SimError, Trajectory, rk4};

static EXPERIMENT: LazyLock<Experiment> =
    LazyLock::new(|| Experiment::new(&Recipe::default(), RobotSet::B).expect("the default recipe runs"));

/// The first six seconds: acceleration, straight and loop entry.
fn short() -> Recipe {
    Recipe { samples: 6000, ..Recipe::default() }
}

#[test]
fn medians_of_a_few_draws_are_within_a_factor_two_of_table_1() {
    let draws = EXPERIMENT.ensemble(5, 15, || {}).expect("finite");
    let table = table1::distributions(&draws);
    assert_eq!(table.len(), 4);
    for (d, paper) in table.iter().zip(PAPER) {
        let ratio = d.quantiles[2] / paper;
        assert!((0.5..=2.0).contains(&ratio), "{d:?}");
    }
    let checks = table1::judge(&draws, &EXPERIMENT.trajectory().windows);
    assert!(checks.iter().filter(|c| "ac".contains(c.rule)).all(|c| c.pass), "{checks:#?}");
}

#[test]
fn indices_are_those_of_the_errors_at_the_samples() {
    let (draw, trace) = (EXPERIMENT.identify(9, 4).expect("finite"), EXPERIMENT.trace(9, 4).expect("finite"));
    let states = &EXPERIMENT.trajectory().states;
    for (i, output) in draw.output.iter().enumerate() {
        let errors: Vec<f64> = trace.speed_estimate[i].iter().zip(&states[1..]).map(|(e, s)| s.speed[i] - e).collect();
        assert_eq!(errors, trace.speed_error[i]);
        let largest = errors.iter().fold(0.0_f64, |m, e| m.max(e.abs()));
        let rmse = (errors.iter().map(|e| e * e).sum::<f64>() / 32_000.0).sqrt();
        assert_eq!((output.max, output.rmse), (largest, rmse));
    }
}

#[test]
fn without_a_network_the_indices_are_as_good() {
    let constant = EXPERIMENT.constant_regressor().expect("finite").table1();
    assert!((constant[2] - 0.0210).abs() < 0.001 && (constant[3] - 0.0214).abs() < 0.001, "{constant:?}");
}

#[test]
fn the_robot_keeps_the_path_and_its_wheels_on_the_ground() {
    let run = EXPERIMENT.trajectory();
    assert!(run.largest_path_error < 0.06, "{}", run.largest_path_error);
    assert!(run.smallest_load > 50.0, "{}", run.smallest_load);
    assert_eq!((run.states.len(), run.torques.len()), (32_001, 32_000));
    let end = run.states.last().expect("not empty");
    assert!((end.yaw - std::f64::consts::TAU).abs() < 0.02 && end.vx.abs() < 5e-3, "{end:?}");
}

#[test]
fn g3_is_the_wheel_acceleration_plus_eight_times_the_speed() {
    let run = EXPERIMENT.trajectory();
    let nominal = PaperRobot::<f64>::new(&run.parameters).expect("valid");
    let disturbed = nominal.with_rolling_resistance(run.parameters.rolling_resistance + 0.3).expect("valid");
    for k in (500..32_000).step_by(500) {
        let robot = if k < 12_000 { &nominal } else { &disturbed };
        let (state, u) = (run.states[k], run.torques[k]);
        let (_, out) = robot.evaluate(&state, u);
        let (c, slip) = (robot.constants(), [out.slip[2][0], out.slip[3][0]]);
        let f = c.resisting_torque(state.speed, slip, out.acceleration);
        let h = 1e-6;
        let moved = |h| rk4(&state.to_array(), h, |s| robot.rate(&State::from_array(*s), u).to_array());
        let (ahead, behind) = (State::from_array(moved(h)), State::from_array(moved(-h)));
        for i in 0..2 {
            let g = (u[i] - f[i]) / (2.0 * c.a1) + 8.0 * state.speed[i];
            let derivative = (ahead.speed[i] - behind.speed[i]) / (2.0 * h);
            let expected = derivative + 8.0 * state.speed[i];
            assert!((g - expected).abs() < 1e-5 * (1.0 + g.abs()), "{g} {expected} at sample {k}");
        }
    }
}

#[test]
fn a_mirrored_path_swaps_wheels_3_and_4() {
    // Both sides share the controller's first layer, so nothing but the path tells left from right.
    let run = |turn| {
        let path = Loop { turn, ..Loop::default() };
        Trajectory::of(&short(), &Parameters::SET_B, &path).expect("runs")
    };
    let (left, right) = (run(Turn::Left), run(Turn::Right));
    for (l, r) in left.states.iter().zip(&right.states) {
        assert!((l.speed[0] - r.speed[1]).abs() < 1e-9 && (l.angle[1] - r.angle[0]).abs() < 1e-9);
        assert!((l.y + r.y).abs() < 1e-9 && (l.x - r.x).abs() < 1e-9);
    }
}

#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let experiment = Experiment::new(&Recipe { samples: 2000, ..Recipe::default() }, RobotSet::A).expect("runs");
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| experiment.ensemble(3, 8, || {})).expect("finite")
    };
    assert_eq!(with(1), with(4));
}

#[test]
fn other_step_sizes_agree() {
    // Second order in the step: 1 ms and 2 ms differ little.
    let coarse = Recipe { step: 2e-3, samples: 16_000, substeps: 40, ..Recipe::default() };
    let coarse = Experiment::new(&coarse, RobotSet::B).expect("runs").constant_regressor().expect("finite").table1();
    let fine = EXPERIMENT.constant_regressor().expect("finite").table1();
    for (c, f) in coarse.iter().zip(fine) {
        assert!((c / f - 1.0).abs() < 0.05, "{coarse:?} {fine:?}");
    }
}

#[test]
fn a_step_that_is_too_long_is_stopped_with_time_and_quantity() {
    let recipe = Recipe { step: 1.0, samples: 200, substeps: 1, ..Recipe::default() };
    match Experiment::new(&recipe, RobotSet::B).map(|_| ()) {
        Err(SimError::NotFinite { time, quantity }) => assert!(time > 0.0 && !quantity.is_empty()),
        Err(SimError::Lifted { .. }) => {}
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_recipe_that_contradicts_itself_is_refused() {
    let refused = |recipe: Recipe| Experiment::new(&recipe, RobotSet::B).map(|_| ()).expect_err("must be refused");
    assert!(refused(Recipe { samples: 0, ..Recipe::default() }).to_string().contains("samples"));
    assert!(refused(Recipe { disturbance_at: 3.9, ..Recipe::default() }).to_string().contains("events"));
    assert!(refused(Recipe { disturbance: -1.0, ..Recipe::default() }).to_string().contains("rolling resistance"));
    let mut recipe = Recipe::default();
    recipe.identifier.network.units = 7;
    assert!(refused(recipe).to_string().contains("identifier.network.units is 7"));
}
