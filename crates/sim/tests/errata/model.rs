//! Section 3 of the paper up to Eq. 9: kinematics and dynamics of the robot.

use robot_model::paper::{Belt, PaperRobot, Parameters, State, Variant};

use sim::{Experiment, Recipe, RobotSet, table1};

use crate::run::{SEED, robots, trajectory};

/// Erratum 3: Eq. 5 has no lateral velocity, but a skid-steered body slides sideways.
#[test]
fn eq_5_loses_the_path_because_the_body_slides_sideways() {
    let run = trajectory();
    let lost = |lateral: f64| {
        let velocity = |s: &State<f64>| {
            let ((sin, cos), vy) = (s.yaw.sin_cos(), lateral * s.vy);
            [s.vx * cos - vy * sin, s.vx * sin + vy * cos]
        };
        let (mut at, mut worst) = ([0.0; 2], 0.0_f64);
        for pair in run.states.windows(2) {
            let (a, b) = (velocity(&pair[0]), velocity(&pair[1]));
            at = std::array::from_fn(|i| at[i] + 0.5 * run.step * (a[i] + b[i]));
            worst = worst.max((at[0] - pair[1].x).hypot(at[1] - pair[1].y));
        }
        worst
    };
    let (paper, whole) = (lost(0.0), lost(1.0));
    assert!(paper > 0.01, "Eq. 5 ends {paper} m from the path");
    assert!(whole < 1e-5, "with the lateral velocity {whole} m");
}

/// A robot on a straight, pushed by its wheels with a slip of 4 %: it accelerates by 2.9 m/s².
fn pushed(p: &Parameters) -> State<f64> {
    State { vx: 0.5, speed: [0.52 / p.wheel_radius; 2], ..State::default() }
}

/// Erratum 4: with the equations of both wheels of a belt added, as the belt asks, load that moves between the axles
/// moves no torque: a4, a7 and the place of the centre of mass along the robot cancel. In Eq. 8 they do not.
#[test]
fn the_sum_over_a_belt_does_not_know_a4_a7_nor_the_place_of_the_mass() {
    let accelerated = |belt, com_to_front_axle, com_height| {
        let p = Parameters { com_to_front_axle, com_height, ..Parameters::SET_B };
        let robot = PaperRobot::<f64>::with_variant(&p, Variant { belt, ..Variant::default() }).expect("valid");
        robot.rate(&pushed(&p), [3.0; 2]).speed[0]
    };
    let spread = |belt| {
        let base = accelerated(belt, 0.175, 0.15);
        let (moved, raised) = (accelerated(belt, 0.10, 0.15), accelerated(belt, 0.175, 0.30));
        [(moved - base).abs(), (raised - base).abs()]
    };
    assert!(spread(Belt::SideSum).iter().all(|s| *s < 1e-9), "{:?}", spread(Belt::SideSum));
    assert!(spread(Belt::Literal).iter().all(|s| *s > 10.0), "{:?} rad/s²", spread(Belt::Literal));
}

/// Erratum 4: Eq. 8 doubles the load of the rear wheel instead of adding the front wheel's. The traction load is wrong
/// by the share `2 h a_x / (g L)`.
#[test]
fn eq_8_doubles_the_rear_load_where_the_belt_adds_the_front_load() {
    let p = Parameters::SET_B;
    let robot = PaperRobot::<f64>::new(&p).expect("valid");
    let (_, out) = robot.evaluate(&pushed(&p), [3.0; 2]);
    let ax = out.acceleration[0];
    let share = 2.0 * out.load[2] / (out.load[0] + out.load[2]) - 1.0;
    let stated = 2.0 * p.com_height * ax / (p.gravity * p.wheelbase);
    assert!((share - stated).abs() < 1e-12, "{share} {stated}");
    assert!(share > 0.2, "{share} at {ax} m/s²");
}

/// Erratum 4: a belt makes both wheels of a side turn alike; equal torques on top would let them turn apart.
#[test]
fn equal_torques_would_turn_the_wheels_of_a_belt_apart() {
    let p = Parameters::SET_B;
    let robot = PaperRobot::<f64>::new(&p).expect("valid");
    let (_, out) = robot.evaluate(&pushed(&p), [3.0; 2]);
    let wheel = |i: usize| {
        let slip = out.slip[i][0];
        let grip = p.adhesion * 2.0 * p.slip_at_peak * slip / (p.slip_at_peak.powi(2) + slip * slip);
        let load = p.wheel_radius * out.load[i] * (grip + p.rolling_resistance);
        (1.5 - p.coulomb_torque - load) / p.wheel_inertia
    };
    let apart = wheel(0) - wheel(2);
    assert!(apart > 10.0, "front and rear wheel part by {apart} rad/s²");
}

/// Erratum 8: g does not depend on the wheel's angle, which is nevertheless among the network's inputs x.
#[test]
fn no_force_depends_on_the_angle_of_a_wheel() {
    let (run, [before, _]) = (trajectory(), robots());
    for k in (0..12_000).step_by(1000) {
        let state = run.states[k];
        let turned = State { angle: [state.angle[0] + 1.0, state.angle[1] - 40.0], ..state };
        assert_eq!(before.rate(&turned, run.torques[k]), before.rate(&state, run.torques[k]));
    }
}

/// Erratum 4: for the RMSE of Table 1 it makes no difference: the medians change by less than 2 %.
#[test]
fn the_sum_over_a_belt_hardly_moves_the_rmse() {
    let median = |belt| {
        let recipe = Recipe { plant: Variant { belt, ..Variant::default() }, ..Recipe::default() };
        let draws = Experiment::new(&recipe, RobotSet::B).expect("runs").ensemble(SEED, 16, || {}).expect("finite");
        [2, 3].map(|i| table1::distributions(&draws)[i].quantiles[2])
    };
    let (literal, summed) = (median(Belt::Literal), median(Belt::SideSum));
    assert_ne!(literal, summed);
    for (l, s) in literal.iter().zip(summed) {
        assert!((s / l - 1.0).abs() < 0.02, "{literal:?} {summed:?}");
    }
}
