//! Force balances, symmetry and checks of the paper's plant.

use super::{Belt, PaperRobot, Parameters, State, Tyre, Variant};
use crate::{ModelError, Must, Scalar, real};

fn robot<T: Scalar>(p: &Parameters) -> PaperRobot<T> {
    PaperRobot::new(p).expect("the built-in sets are valid")
}

fn near(a: f64, b: f64, tolerance: f64) -> bool {
    (a - b).abs() <= tolerance
}

/// Explicit midpoint with small steps is accurate enough for these tests.
fn drive<T: Scalar>(robot: &PaperRobot<T>, mut state: State<T>, torque: [T; 2], seconds: f64) -> State<T> {
    let h = 5e-5;
    let step = |s: &State<T>, r: &State<T>, h: f64| {
        let (s, r) = (s.to_array(), r.to_array());
        State::from_array(core::array::from_fn(|i| s[i] + r[i] * real(h)))
    };
    for _ in 0..(seconds / h) as usize {
        let half = step(&state, &robot.rate(&state, torque), 0.5 * h);
        state = step(&state, &robot.rate(&half, torque), h);
    }
    state
}

#[test]
fn constants_of_set_b() {
    let robot = robot::<f64>(&Parameters::SET_B);
    let c = robot.constants();
    let expected = [0.03, 0.3, 7.848, 0.686, 0.600, 0.294, 0.0257, 0.0225];
    let found = [c.a1, c.a2, c.a3, c.a4, c.a5, c.a6, c.a7, c.a8];
    assert!(found.iter().zip(expected).all(|(f, e)| near(*f, e, 6e-4)), "{found:?}");
}

#[test]
fn resistance_is_to_traction_as_rolling_resistance_to_adhesion() {
    for p in [Parameters::SET_A, Parameters::SET_B, Parameters::SET_C] {
        let robot = robot::<f64>(&p).with_rolling_resistance(0.33).expect("valid");
        let c = robot.constants();
        for (resistance, traction) in [(c.a6, c.a3), (c.a7, c.a4), (c.a8, c.a5)] {
            assert!(near(resistance / traction, 0.33 / p.adhesion, 1e-14));
        }
    }
}

#[test]
fn steady_straight_line_takes_only_bearing_and_rolling_resistance() {
    let robot = robot::<f64>(&Parameters::SET_B);
    let c = robot.constants();
    let torque = 2.0 * c.a2 + 2.0 * c.a6;
    assert!(near(torque, 1.1884, 3e-4), "{torque}");
    let start = State { vx: 0.5, speed: [5.0; 2], ..State::default() };
    let end = drive(&robot, start, [torque; 2], 2.0);
    assert!(near(end.vx, 0.5, 1e-9) && near(end.x, 1.0, 1e-6), "{end:?}");
}

#[test]
fn constant_acceleration_balances_wheels_and_body() {
    let robot = robot::<f64>(&Parameters::SET_B);
    let (c, p) = (robot.constants(), robot.parameters());
    let torque = 2.5464;
    let moving = drive(&robot, State { vx: 0.3, speed: [3.0; 2], ..State::default() }, [torque; 2], 1.0);
    let (rate, out) = robot.evaluate(&moving, [torque; 2]);
    let ax = out.acceleration[0];
    let needed = 2.0 * c.a1 * rate.speed[0]
        + 2.0 * c.a2
        + 2.0 * (c.a6 + c.a7 * ax)
        + 0.5 * p.wheel_radius * p.mass * ax * (c.a3 + c.a4 * ax) / c.a3;
    assert!(near(ax, 0.4957, 5e-3), "{ax}");
    assert!(near(needed, torque, 1e-9), "{needed}");
}

#[test]
fn loads_are_positive_carry_the_weight_and_follow_eq_8() {
    for p in [Parameters::SET_A, Parameters::SET_B, Parameters::SET_C] {
        let robot = robot::<f64>(&Parameters { com_to_front_axle: 0.4 * p.wheelbase, ..p });
        let turning = State { vx: 0.5, vy: 0.02, yaw_rate: 0.4, speed: [4.0, 7.0], ..State::default() };
        let (_, out) = robot.evaluate(&turning, [2.0; 2]);
        let (c, q) = (robot.constants(), robot.parameters());
        assert!(out.load.iter().all(|n| *n > 0.0), "{out:?}");
        assert!(near(out.load.iter().sum::<f64>(), p.mass * p.gravity, 1e-9));
        let [ax, ay] = out.acceleration;
        let rear = |lateral: f64| (c.a3 + c.a4 * ax + c.a5 * lateral) / (q.wheel_radius * q.adhesion);
        assert!(near(out.load[2], rear(-ay), 1e-9) && near(out.load[3], rear(ay), 1e-9));
    }
}

/// A few states of a robot that slides about, wheels turning or locked.
fn sliding() -> impl Iterator<Item = State<f64>> {
    (0..200_u32).map(|k| {
        let at = |n: u32| f64::from((k * 37 + n * 61) % 101) / 50.0 - 1.0;
        let wheels = if k % 2 == 0 { 0.0 } else { 6.0 };
        State {
            vx: at(1),
            vy: 0.5 * at(2),
            yaw_rate: 2.0 * at(3),
            speed: [wheels * at(4), wheels * at(5)],
            ..State::default()
        }
    })
}

#[test]
fn wheels_accelerate_by_the_forces_that_move_the_body() {
    let robot = robot::<f64>(&Parameters::SET_C);
    let p = robot.parameters();
    for state in sliding() {
        let (rate, out) = robot.evaluate(&state, [3.0, -2.0]);
        if out.load.iter().any(|n| *n <= 0.0) {
            continue;
        }
        for (side, torque) in [3.0, -2.0].into_iter().enumerate() {
            let rear = 2 + side;
            let slip = out.slip[rear][0];
            let share = 2.0 * p.slip_at_peak * slip / (p.slip_at_peak * p.slip_at_peak + slip * slip);
            let force = out.load[rear] * p.adhesion * share;
            let sign = nalgebra::ComplexField::tanh(state.speed[side] / p.sign_width);
            let resistance = p.coulomb_torque + p.wheel_radius * p.rolling_resistance * out.load[rear];
            let expected = (torque - 2.0 * resistance * sign - 2.0 * p.wheel_radius * force) / (2.0 * p.wheel_inertia);
            assert!(near(rate.speed[side], expected, 1e-9), "{state:?}");
        }
    }
}

#[test]
fn contacts_never_add_energy_to_a_body_on_locked_wheels() {
    let robot = robot::<f64>(&Parameters::SET_B);
    let p = robot.parameters();
    for state in sliding().filter(|s| s.speed == [0.0; 2]) {
        let rate = robot.rate(&state, [0.0; 2]);
        let power = p.mass * (state.vx * rate.vx + state.vy * rate.vy) + p.yaw_inertia * state.yaw_rate * rate.yaw_rate;
        assert!(power < 0.0, "{power} W at {state:?}");
    }
}

#[test]
fn a_body_without_grip_goes_straight_on_while_it_spins() {
    let robot = robot::<f64>(&Parameters { adhesion: 1e-12, rolling_resistance: 0.0, ..Parameters::SET_B });
    let start = State { vx: 1.0, vy: -0.4, yaw_rate: 1.5, ..State::default() };
    let end = drive(&robot, start, [0.0; 2], 1.0);
    assert!(near(end.yaw, 1.5, 1e-6), "{end:?}");
    assert!(near(end.x, 1.0, 1e-6) && near(end.y, -0.4, 1e-6), "{end:?}");
}

#[test]
fn a_mirrored_state_has_the_mirrored_rate() {
    let robot = robot::<f64>(&Parameters::SET_B);
    let mirror = |s: &State<f64>| State {
        y: -s.y,
        yaw: -s.yaw,
        vy: -s.vy,
        yaw_rate: -s.yaw_rate,
        angle: [s.angle[1], s.angle[0]],
        speed: [s.speed[1], s.speed[0]],
        ..*s
    };
    let state =
        State { x: 0.0, y: 0.3, yaw: 0.2, vx: 0.5, vy: -0.03, yaw_rate: 0.5, angle: [1.0, 2.0], speed: [4.0, 6.5] };
    let direct = mirror(&robot.rate(&state, [1.0, 3.0]));
    let mirrored = robot.rate(&mirror(&state), [3.0, 1.0]);
    for (a, b) in direct.to_array().into_iter().zip(mirrored.to_array()) {
        assert!(near(a, b, 1e-12), "{direct:?} {mirrored:?}");
    }
}

#[test]
fn single_precision_agrees_with_double() {
    let start = State { vx: 0.1, speed: [1.0; 2], ..State::default() };
    let wide = drive(&robot::<f64>(&Parameters::SET_B), start, [2.0, 2.2], 0.5);
    let start = State { vx: 0.1, speed: [1.0; 2], ..State::default() };
    let narrow = drive(&robot::<f32>(&Parameters::SET_B), start, [2.0, 2.2], 0.5);
    for (a, b) in wide.to_array().into_iter().zip(narrow.to_array()) {
        assert!(near(a, f64::from(b), 2e-3), "{wide:?} {narrow:?}");
    }
}

#[test]
fn rest_stays_at_rest() {
    let rate = robot::<f64>(&Parameters::SET_B).rate(&State::default(), [0.0; 2]);
    assert_eq!(rate, State::default());
}

#[test]
fn impossible_robots_are_refused_by_name() {
    let b = Parameters::SET_B;
    let negative = PaperRobot::<f64>::new(&Parameters { mass: -1.0, ..b });
    assert_eq!(negative, Err(ModelError::Value { name: "mass", value: -1.0, must: Must::BePositive }));
    let outside = PaperRobot::<f64>::new(&Parameters { com_to_front_axle: 0.36, ..b });
    assert!(matches!(outside, Err(ModelError::Value { must: Must::LieBetween(..), .. })));
    assert!(robot::<f64>(&b).with_rolling_resistance(f64::NAN).is_err());
}

fn variant(p: &Parameters, belt: Belt, tyre: Tyre) -> PaperRobot<f64> {
    PaperRobot::with_variant(p, Variant { belt, tyre }).expect("valid")
}

#[test]
fn a_side_turns_by_the_sum_of_its_wheels() {
    let p = Parameters { com_to_front_axle: 0.11, ..Parameters::SET_B };
    let robot = variant(&p, Belt::SideSum, Tyre::Uncoupled);
    for state in sliding() {
        let (rate, out) = robot.evaluate(&state, [3.0, -2.0]);
        for (side, torque) in [3.0, -2.0].into_iter().enumerate() {
            let sign = nalgebra::ComplexField::tanh(state.speed[side] / p.sign_width);
            let wheel = |i: usize| {
                let slip = out.slip[i][0];
                let share = 2.0 * p.slip_at_peak * slip / (p.slip_at_peak * p.slip_at_peak + slip * slip);
                let (traction, rolling) = (p.adhesion * share, p.rolling_resistance * sign);
                p.coulomb_torque * sign + p.wheel_radius * out.load[i] * (traction + rolling)
            };
            let expected = (torque - wheel(side) - wheel(side + 2)) / (2.0 * p.wheel_inertia);
            assert!(near(rate.speed[side], expected, 1e-9), "{state:?}");
        }
    }
}

#[test]
fn both_belts_agree_while_the_axles_are_loaded_alike() {
    // Steady on a straight, the centre of mass half-way between the axles.
    let state = State { vx: 0.5, speed: [5.0; 2], ..State::default() };
    let rate = |belt| variant(&Parameters::SET_B, belt, Tyre::Uncoupled).rate(&state, [1.0, 2.0]);
    for (a, b) in rate(Belt::Literal).to_array().into_iter().zip(rate(Belt::SideSum).to_array()) {
        assert!(near(a, b, 1e-12));
    }
}

#[test]
fn under_combined_slip_the_whole_force_follows_kiencke() {
    let p = Parameters::SET_B;
    let combined = variant(&p, Belt::Literal, Tyre::Combined);
    for state in sliding() {
        let (rate, out) = combined.evaluate(&state, [0.0; 2]);
        let mut force = [0.0; 2];
        for (load, slip) in out.load.iter().zip(out.slip) {
            let total = nalgebra::ComplexField::sqrt(slip[0] * slip[0] + slip[1] * slip[1]);
            // A wheel that does not slip has no direction, and no force.
            let direction = slip.map(|s| if total > 0.0 { s / total } else { 0.0 });
            let size = load * p.adhesion * 2.0 * p.slip_at_peak * total / (p.slip_at_peak.powi(2) + total * total);
            force = core::array::from_fn(|j| force[j] + size * direction[j]);
        }
        for j in 0..2 {
            assert!(near(out.acceleration[j], force[j] / p.mass, 1e-9), "{state:?}");
        }
        assert!(near(rate.vx, out.acceleration[0] + state.yaw_rate * state.vy, 1e-12));
    }
}

#[test]
fn without_lateral_slip_the_tyres_agree() {
    let state = State { vx: 0.5, speed: [5.3, 5.1], ..State::default() };
    let rate = |tyre| variant(&Parameters::SET_C, Belt::Literal, tyre).rate(&state, [4.0; 2]);
    for (a, b) in rate(Tyre::Uncoupled).to_array().into_iter().zip(rate(Tyre::Combined).to_array()) {
        assert!(near(a, b, 1e-9));
    }
}

#[test]
fn other_ground_keeps_the_variant() {
    let robot = variant(&Parameters::SET_B, Belt::SideSum, Tyre::Combined);
    let other = robot.with_rolling_resistance(0.33).expect("valid");
    assert_eq!(other.variant(), robot.variant());
    assert_ne!(other.variant(), PaperRobot::<f64>::new(&Parameters::SET_B).expect("valid").variant());
}

#[cfg(feature = "serde")]
mod data {
    use serde::Deserialize;
    use serde::de::IntoDeserializer;
    use serde::de::value::{Error, MapDeserializer};

    use crate::paper::{Belt, Parameters, Tyre, Variant};

    #[test]
    fn variants_are_read_by_name() {
        let read = |fields: [(&'static str, &'static str); 1]| {
            Variant::deserialize(MapDeserializer::<_, Error>::new(fields.into_iter()))
        };
        assert_eq!(read([("belt", "side_sum")]), Ok(Variant { belt: Belt::SideSum, tyre: Tyre::Uncoupled }));
        assert_eq!(read([("tyre", "combined")]), Ok(Variant { belt: Belt::Literal, tyre: Tyre::Combined }));
        assert!(read([("wheels", "literal")]).is_err());
        let belt: Result<Belt, Error> = Belt::deserialize("literal".into_deserializer());
        assert_eq!(belt, Ok(Belt::Literal));
    }

    #[test]
    fn parameters_must_be_complete_and_known() {
        let b = Parameters::SET_B;
        let fields = [
            ("mass", b.mass),
            ("yaw_inertia", b.yaw_inertia),
            ("wheel_radius", b.wheel_radius),
            ("wheelbase", b.wheelbase),
            ("track", b.track),
            ("com_height", b.com_height),
            ("com_to_front_axle", b.com_to_front_axle),
            ("wheel_inertia", b.wheel_inertia),
            ("coulomb_torque", b.coulomb_torque),
            ("adhesion", b.adhesion),
            ("slip_at_peak", b.slip_at_peak),
            ("rolling_resistance", b.rolling_resistance),
            ("gravity", b.gravity),
            ("slip_floor", b.slip_floor),
            ("sign_width", b.sign_width),
        ];
        let read = |fields: &[(&'static str, f64)]| {
            Parameters::deserialize(MapDeserializer::<_, Error>::new(fields.iter().copied()))
        };
        assert_eq!(read(&fields), Ok(b));
        assert!(read(&fields[1..]).is_err());
        let mut unknown = fields;
        unknown[0].0 = "weight";
        assert!(read(&unknown).is_err());
    }
}
