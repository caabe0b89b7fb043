//! Laws that the plant must obey: balances, presence, limits, convergence, single precision.

#[path = "../common/mod.rs"]
mod common;
mod on_casters;

use common::{BOTH, Causality, distance, robot, run};
use robot_model::{Active, Chassis, Disc, Effect, Plant, Presence, Robot, State, effects};

const H: f64 = 1e-3;

/// Symmetric, so that it drives straight when both sides turn alike.
fn symmetric() -> Robot<f64> {
    let mut r = robot();
    r.com = [0.01, 0.0, 0.12];
    (r.coulomb, r.viscous) = ([0.5; 2], [0.03; 2]);
    r
}

fn active(effect: &'static dyn Effect<f64>, values: &[f64]) -> Active<f64> {
    Active::new(effect, values, Presence::default())
}

/// Steady straight driving at wheel speed `w`: the state after four seconds.
fn steady(robot: &Robot<f64>, active: &[Active<f64>], w: f64) -> State<f64> {
    let plant = Plant::new(robot, active, H);
    let mut s = State::default();
    plant.set_velocity(&mut s, [w * robot.wheel_radius, 0.0]);
    for _ in 0..4000 {
        plant.step_at_speed(&mut s, [w; 2], [0.0; 2]);
    }
    s
}

fn near(a: f64, b: f64, bound: f64) -> bool {
    (a - b).abs() <= bound * a.abs().max(b.abs()).max(1.0)
}

#[test]
fn steady_driving_takes_friction_and_rolling_resistance() {
    for w in [3.0, 8.0, -6.0_f64] {
        let r = symmetric();
        let s = steady(&r, &[], w);
        // Σ T = Σ (Tc sign ω + c ω) + f_r m g r sign ω; the Stribeck rise has died out by 3 rad/s.
        let wanted = 2.0 * (r.coulomb[0] * w.signum() + r.viscous[0] * w)
            + r.rolling_resistance * r.mass * r.gravity * r.wheel_radius * w.signum();
        assert!(near(s.needed[0] + s.needed[1], wanted, 1e-9), "{} {wanted}", s.needed[0] + s.needed[1]);
        assert!(near(s.needed[0], s.needed[1], 1e-12) && s.yaw_rate.abs() < 1e-12);
    }
}

#[test]
fn effects_add_to_the_torque_of_steady_driving_what_their_laws_say() {
    let (r, w) = (symmetric(), 8.0);
    let weight = r.mass * r.gravity;
    let nominal = steady(&r, &[], w).needed;
    let v = steady(&r, &[], w).velocity[0];
    let total = |effect: &'static dyn Effect<f64>, values: &[f64]| {
        let s = steady(&r, &[active(effect, values)], w);
        s.needed[0] + s.needed[1] - nominal[0] - nominal[1]
    };
    // Uphill by the angle α, against the downhill direction: m g sin α r.
    let alpha = 0.02_f64;
    assert!(near(total(&effects::grade::Law, &[-alpha, 0.0]), weight * alpha.sin() * r.wheel_radius, 1e-3));
    assert!(near(total(&effects::rolling_resistance::Law, &[0.03]), 0.03 * weight * r.wheel_radius, 1e-9));
    assert!(near(total(&effects::viscous_friction::Law, &[0.04]), 2.0 * 0.04 * w, 1e-9));
    assert!(near(total(&effects::coulomb_side::Law, &[0.2]), 2.0 * 0.2, 1e-9));
    assert!(near(total(&effects::constant_pull::Law, &[4.0]), 4.0 * r.wheel_radius, 1e-9));
    assert!(near(total(&effects::quadratic_drag::Law, &[4.0]), 4.0 * v * v * r.wheel_radius, 5e-3));
    assert!(near(total(&effects::payload::Law, &[2.0]), r.rolling_resistance * 2.0 * r.gravity * r.wheel_radius, 1e-9));
    assert!(near(total(&effects::turning_resistance::Law, &[0.5]), 0.0, 1e-9));
    // A torque constant that is larger by κ takes 1/(1 + κ) of the torque.
    let less = total(&effects::torque_constant::Law, &[0.25]);
    assert!(near(less, (0.8 - 1.0) * (nominal[0] + nominal[1]), 1e-9));
}

#[test]
fn a_torque_driven_robot_at_the_needed_torque_keeps_its_speed() {
    let cases: [&[Active<f64>]; 4] = [
        &[],
        &[active(&effects::grade::Law, &[-0.02, 0.0])],
        &[active(&effects::quadratic_drag::Law, &[4.0])],
        &[active(&effects::torque_constant::Law, &[-0.1]), active(&effects::rolling_resistance::Law, &[0.02])],
    ];
    let r = symmetric();
    for effects in cases {
        for w in [3.0, 8.0, -6.0] {
            let start = steady(&r, effects, w);
            let plant = Plant::new(&r, effects, H);
            let mut s = start;
            plant.settle_drive(&mut s, start.needed);
            for _ in 0..3000 {
                plant.step(&mut s, start.needed);
            }
            for j in 0..2 {
                assert!(near(s.wheel_speed[j], w, 1e-6), "{} instead of {w}", s.wheel_speed[j]);
            }
            assert!(near(s.velocity[0], start.velocity[0], 1e-6) && s.yaw_rate.abs() < 1e-9);
        }
    }
}

#[test]
fn an_effect_acts_only_where_and_when_it_is_present() {
    let whole = Presence::default();
    let cases: [(&'static dyn Effect<f64>, &[f64]); 7] = [
        (&effects::wheel_eccentricity::Law, &[0.004, 0.003, 0.002, -0.001, 30.0]),
        (&effects::adhesion_patch::Law, &[0.6]),
        (&effects::rolling_resistance::Law, &[0.1]),
        (&effects::turning_resistance::Law, &[0.5]),
        (&effects::coulomb_side::Law, &[0.5]),
        (&effects::constant_pull::Law, &[20.0]),
        (&effects::belt_loss::Law, &[0.2]),
    ];
    let end = |effect, values: &[f64], presence, causality| {
        run(&robot(), &[Active::new(effect, values, presence)], causality, (State::default(), 2.0, H), |_, _| ())
    };
    for causality in BOTH {
        let nominal = run(&robot(), &[], causality, (State::default(), 2.0, H), |_, _| ());
        for (effect, values) in cases {
            let id = effect.spec().id;
            // A belt passes no torque that anyone would miss when the wheels' speeds are imposed.
            let matters = id != "belt_loss" || causality == Causality::Torque;
            let everywhere = end(effect, values, whole, causality);
            assert_eq!(distance(&everywhere, &nominal) > 1e-4, matters, "{id}");
            // Never there.
            let disc = |centre, radius| Some(Disc { centre, radius });
            for presence in [
                Presence { disc: disc([50.0, 0.0], 2.0), ..whole },
                Presence { from: 2.0, ..whole },
                Presence { until: 0.0, ..whole },
            ] {
                assert_eq!(end(effect, values, presence, causality), nominal, "{id} {presence:?}");
            }
            // Each side by itself is something else than both, and than the other.
            if matters {
                let sides = [0, 1].map(|j| end(effect, values, Presence { side: Some(j), ..whole }, causality));
                assert!(distance(&sides[0], &sides[1]) > 1e-6 || id == "constant_pull", "{id}");
                assert!(sides.iter().all(|s| distance(s, &everywhere) > 1e-6 && distance(s, &nominal) > 1e-6), "{id}");
            }
        }
    }
}

#[test]
fn an_effect_that_is_always_there_is_one_without_limits() {
    let whole = Presence::default();
    let disc = Some(Disc { centre: [0.0, 0.0], radius: 50.0 });
    for causality in BOTH {
        for effect in effects::catalogue::<f64>() {
            let probes: Vec<f64> = effect.spec().parameters.iter().map(|p| p.probes[0]).collect();
            let end = |presence| {
                let active = [Active::new(effect, &probes, presence)];
                run(&robot(), &active, causality, (State::default(), 2.0, H), |_, _| ())
            };
            for presence in [Presence { disc, ..whole }, Presence { from: 0.0, until: 2.0, ..whole }] {
                let d = distance(&end(presence), &end(whole));
                assert!(d < 1e-9, "{} {presence:?}: {d:e}", effect.spec().id);
            }
        }
    }
}

#[test]
fn an_effect_of_one_side_leaves_the_other_sides_torque_alone() {
    let r = symmetric();
    let nominal = steady(&r, &[], 8.0).needed;
    for side in [0, 1] {
        let brake =
            [Active::new(&effects::coulomb_side::Law, &[0.5], Presence { side: Some(side), ..Presence::default() })];
        let needed = steady(&r, &brake, 8.0).needed;
        assert!(near(needed[side] - nominal[side], 0.5, 1e-9));
        assert!(near(needed[1 - side], nominal[1 - side], 1e-12));
    }
}

#[test]
fn a_patch_is_felt_by_the_wheels_inside_only() {
    let r = symmetric();
    let patch = Presence { disc: Some(Disc { centre: [0.0, 1.0], radius: 1.0 }), ..Presence::default() };
    let mud = [Active::new(&effects::rolling_resistance::Law, &[0.2], patch)];
    let plant = Plant::new(&r, &mud, H);
    let mut s = State::default();
    plant.step_at_speed(&mut s, [2.0; 2], [0.0; 2]);
    let extra = s.needed[0] - s.needed[1];
    let wanted = 0.2 * 0.5 * r.mass * r.gravity * r.wheel_radius;
    assert!(near(extra, wanted, 0.05), "{extra} {wanted}");
}

#[test]
fn a_belt_that_never_slips_is_a_rigid_one() {
    let start = || (State::default(), 2.0, H);
    let rigid = run(&robot(), &[], Causality::Torque, start(), |_, _| ());
    let strong = [active(&effects::belt_loss::Law, &[1e6])];
    let belt = run(&robot(), &strong, Causality::Torque, start(), |_, s| {
        assert!((0..2).all(|j| near(s.passive[j], s.wheel_speed[j], 1e-9)));
    });
    assert!(distance(&rigid, &belt) < 1e-8, "{:e}", distance(&rigid, &belt));
    // Without a belt the front wheel rolls freely and the state stays finite.
    let none = [active(&effects::belt_loss::Law, &[0.0])];
    let free = run(&robot(), &none, Causality::Torque, start(), |_, _| ());
    assert!(distance(&rigid, &free) > 1e-2);
}

#[test]
fn motors_at_each_wheel_are_coupled_by_nothing() {
    let coupled = Robot { com: [0.0, 0.0, 1e-9], ..symmetric() };
    let four_motors = Robot { chassis: Chassis::FourMotors, ..coupled };
    let end = |r: &Robot<f64>, torque: [f64; 2]| {
        let plant = Plant::new(r, &[], H);
        let mut s = State::default();
        for _ in 0..1000 {
            plant.step(&mut s, torque);
        }
        s
    };
    // Straight on, wheels of a side are loaded alike and turn alike, whatever couples them.
    let straight = [&coupled, &four_motors].map(|r| end(r, [4.0; 2]));
    assert!(distance(&straight[0], &straight[1]) < 1e-9, "{straight:?}");
    assert!(near(straight[1].passive[0], straight[1].wheel_speed[0], 1e-9));
    // With more load on the rear wheels these slip less: only a coupling makes the front ones turn with them.
    let rearward = |r: Robot<f64>| Robot { com: [-0.05, 0.0, 0.1], ..r };
    let [coupled, four_motors] = [coupled, four_motors].map(|r| end(&rearward(r), [6.0, 6.0]));
    assert!(near(coupled.passive[0], coupled.wheel_speed[0], 1e-9));
    assert!(four_motors.passive[0] - four_motors.wheel_speed[0] > 1e-3, "{four_motors:?}");
    // In a curve the side that scrubs outward differs from the inner one.
    let curve = end(&Robot { chassis: Chassis::FourMotors, ..symmetric() }, [2.0, 6.0]);
    assert!(curve.yaw_rate > 0.1 && curve.passive.iter().all(|w| w.is_finite()), "{curve:?}");
}

#[test]
fn a_slipping_belt_slips_alike_both_ways() {
    // Without transfer of load and with the centre of mass in the middle, forward and backward are alike.
    let r = Robot { com: [0.0, 0.0, 1e-9], ..symmetric() };
    let slipping = [active(&effects::belt_loss::Law, &[0.2])];
    let end = |torque: f64| {
        let plant = Plant::new(&r, &slipping, H);
        let mut s = State::default();
        for _ in 0..1000 {
            plant.step(&mut s, [torque; 2]);
        }
        s
    };
    let (forth, back) = (end(6.0), end(-6.0));
    assert!(forth.wheel_speed[0] - forth.passive[0] > 1e-2, "{forth:?}");
    assert!(near(forth.velocity[0], -back.velocity[0], 1e-9));
    assert!(near(forth.passive[0], -back.passive[0], 1e-9));
}

#[test]
fn a_body_without_grip_goes_straight_on_while_it_spins() {
    let r = Robot { adhesion: 1e-12, ..robot() };
    for causality in BOTH {
        let mut start = State { yaw_rate: 2.0, ..State::default() };
        Plant::new(&r, &[], H).set_velocity(&mut start, [1.0, 0.5]);
        let world = |s: &State<f64>| {
            let ([x, y], [c, n]) = (s.velocity, s.heading);
            [x * c - y * n, x * n + y * c]
        };
        let end = run(&r, &[], causality, (start, 1.0, H), |_, _| ());
        // The velocity turns by Euler's rule: it grows by h ω²/2 each second.
        let (was, is) = (world(&start), world(&end));
        assert!((was[0] - is[0]).hypot(was[1] - is[1]) < 4e-3, "{was:?} {is:?}");
        // The centre of mass moves straight: compare it, not the centre.
        let com = |s: &State<f64>| {
            let ([c, n], com) = (s.heading, r.com);
            [s.position[0] + c * com[0] - n * com[1], s.position[1] + n * com[0] + c * com[1]]
        };
        let (from, to) = (com(&start), com(&end));
        assert!((to[0] - from[0] - was[0]).hypot(to[1] - from[1] - was[1]) < 4e-3);
        assert!(near(end.yaw_rate, 2.0, 1e-9));
    }
}

#[test]
fn the_step_converges_with_order_one() {
    let end = |h| run(&robot(), &[], Causality::Torque, (State::default(), 2.0, h), |_, _| ());
    let pose = |s: &State<f64>| [s.position[0], s.position[1], s.heading[1].atan2(s.heading[0])];
    let exact = pose(&end(3.125e-5));
    let error = |h| {
        let p = pose(&end(h));
        (p[0] - exact[0]).hypot(p[1] - exact[1]).max((p[2] - exact[2]).abs())
    };
    let errors = [1e-3, 5e-4, 2.5e-4].map(error);
    assert!(errors[0] < 1e-3, "1 ms is off by {errors:?}");
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((0.8..1.4).contains(&order), "order {order}, errors {errors:?}");
    }
}

#[test]
fn single_precision_follows_double_precision() {
    for causality in BOTH {
        let double = run(&robot(), &[], causality, (State::default(), 2.0, H), |_, _| ());
        let single = run(&robot().cast::<f32>(), &[], causality, (State::default(), 2.0, H), |_, _| ());
        for j in 0..2 {
            let d = (f64::from(single.position[j]) - double.position[j]).abs();
            assert!(d < 2e-3, "{causality:?}: {d} m");
            assert!((f64::from(single.wheel_speed[j]) - double.wheel_speed[j]).abs() < 2e-2);
        }
        assert!((f64::from(single.time) - double.time).abs() < 1e-3);
    }
}

#[test]
fn robots_that_cannot_exist_are_refused() {
    type Change = fn(&mut Robot<f64>);
    let wrong: [(&str, Change); 7] = [
        ("mass", |r| r.mass = -1.0),
        ("yaw_inertia", |r| r.yaw_inertia = 0.0),
        ("wheel_radius", |r| r.wheel_radius = f64::NAN),
        ("coulomb_right", |r| r.coulomb[1] = -0.1),
        ("com_x", |r| r.com[0] = 1.0),
        ("wheelbase", |r| r.half_wheelbase = -0.17),
        ("sliding_share", |r| r.sliding_share = 1.5),
    ];
    assert!(robot().checked().is_ok());
    for (name, change) in wrong {
        let mut r = robot();
        change(&mut r);
        let message = r.checked().expect_err(name).to_string();
        assert!(message.contains(name), "{message}");
    }
}
