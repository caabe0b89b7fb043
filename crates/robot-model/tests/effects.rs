//! One battery over all effects of the catalogue.

mod common;

use std::collections::BTreeSet;
use std::path::Path;

use common::{BOTH, Causality, distance, numbers, robot, run};
use num_dual::Dual64;
use proptest::prelude::*;
use robot_model::effect::{MAX_PARAMETERS, Scale, Wears};
use robot_model::{Active, Card, Disc, Effect, Kind, Plant, Presence, Robot, Role, Scalar, Situation, State, World};
use robot_model::{effects, real};

const H: f64 = 1e-3;

fn at_rest<T: Scalar>(duration: f64) -> (State<T>, f64, f64) {
    (State::default(), duration, H)
}

/// A presence for each way in which an effect may be worn; discs and onsets are met during the drive.
fn worn<T: Scalar>(wears: Wears) -> Vec<Presence<T>> {
    let always = Presence::default();
    let mut all = vec![always];
    if wears.onset {
        all.push(Presence { from: real(0.7), until: real(1.4), ..always });
    }
    if wears.disc {
        all.push(Presence { disc: Some(Disc { centre: [real(0.3), real(0.1)], radius: real(0.3) }), ..always });
    }
    if wears.side {
        all.extend([0, 1].map(|side| Presence { side: Some(side), ..always }));
    }
    all
}

/// All ways at once, whatever the card says: a wrapper must not change what is neutral.
const ANY: Wears = Wears { everywhere: true, onset: true, disc: true, side: true };

fn history<T: Scalar>(robot: &Robot<T>, active: &[Active<T>], causality: Causality) -> (Vec<String>, String) {
    let mut states = Vec::new();
    let last = run(robot, active, causality, at_rest(2.0), |plant, s| {
        let mut readings = plant.readings(s);
        plant.sense(&mut readings);
        if states.len() % 100 == 0 {
            states.push(format!("{s:?} {readings:?}"));
        } else {
            states.push(String::new());
        }
    });
    let plant = Plant::new(robot, active, real(H));
    (states, format!("{last:?} {:?}", plant.drive()))
}

fn neutral_is_identical<T: Scalar>() {
    let robot = robot().cast::<T>();
    for causality in BOTH {
        let nominal = history(&robot, &[], causality);
        for effect in effects::catalogue::<T>() {
            let card = effect.card();
            let mut neutral: Vec<T> = card.parameters.iter().map(|p| real(p.neutral)).collect();
            for presence in worn::<T>(ANY) {
                let same = history(&robot, &[Active::new(effect, &neutral, presence)], causality) == nominal;
                assert!(same, "{} at its neutral value changes a {causality:?}-driven run ({presence:?})", card.id);
            }
            // The neutral value of the strengths is enough: shapes may be anything.
            for (v, p) in neutral.iter_mut().zip(card.parameters).filter(|(_, p)| p.role == Role::Shape) {
                *v = real(p.bounds[0]);
            }
            assert!(history(&robot, &[Active::new(effect, &neutral, Presence::default())], causality) == nominal);
        }
    }
}

#[test]
fn neutral_effects_leave_a_drive_bit_identical() {
    neutral_is_identical::<f64>();
}

#[test]
fn neutral_effects_leave_a_drive_bit_identical_in_f32() {
    neutral_is_identical::<f32>();
}

#[test]
fn all_neutral_effects_together_leave_a_drive_bit_identical() {
    let all = effects::catalogue::<f64>().map(|e| Active::new(e, &[], Presence::default()));
    for causality in BOTH {
        assert!(history(&robot(), &all, causality) == history(&robot(), &[], causality));
    }
}

#[test]
fn ids_are_unique_and_equal_to_the_file_names() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/effects");
    let files: BTreeSet<String> = std::fs::read_dir(folder)
        .expect("the folder of the effects")
        .map(|f| f.expect("readable").path().file_stem().expect("a file").to_string_lossy().into_owned())
        .collect();
    let ids: Vec<&str> = effects::catalogue::<f64>().map(|e| e.card().id).to_vec();
    assert_eq!(ids, files.iter().map(String::as_str).collect::<Vec<_>>());
    let names: BTreeSet<&str> = effects::catalogue::<f64>().map(|e| e.card().name).into();
    assert_eq!(names.len(), ids.len(), "names for people must differ too");
}

#[test]
fn cards_are_sane() {
    let units = ["-", "m", "s", "rad", "rad/s", "kg", "N", "N m", "N m s/rad", "N s²/m²"];
    for effect in effects::catalogue::<f64>() {
        let card = effect.card();
        let id = card.id;
        for (what, text) in [
            ("name", card.name),
            ("law", card.law),
            ("seen", card.seen),
            ("revealed_by", card.revealed_by),
            ("resembles", card.resembles),
            ("source", card.source),
        ] {
            assert!(!text.trim().is_empty(), "{id}: {what} is empty");
        }
        assert!(card.interest.is_finite() && card.interest >= 0.0, "{id}: interest");
        let strengths = card.strengths().count();
        assert!(strengths > 0 && card.parameters.len() <= MAX_PARAMETERS, "{id}: number of parameters");
        assert!(card.axes.is_empty() || card.axes.len() == strengths, "{id}: one axis for each strength");
        assert!(card.wears.everywhere || card.wears.onset || card.wears.disc || card.wears.side, "{id}: worn nowhere");
        for p in card.parameters {
            let (name, [low, high]) = (p.name, p.bounds);
            assert!(!name.is_empty() && units.contains(&p.unit), "{id}: unit {:?} of {name}", p.unit);
            assert!(low.is_finite() && high.is_finite() && low < high, "{id}: bounds of {name}");
            assert!((low..=high).contains(&p.neutral), "{id}: neutral value of {name} is outside its bounds");
            assert!(p.probes.iter().all(|x| x.is_finite() && *x != 0.0), "{id}: probes of {name}");
            if p.scale == Scale::Own {
                assert!(p.probes.iter().all(|x| (low..=high).contains(x)), "{id}: probes of {name} out of bounds");
            }
            match p.role {
                Role::Strength => {
                    assert_eq!(p.probes.len(), 1, "{id}: a strength has one probe");
                    assert_eq!(p.neutral, 0.0, "{id}: a strength is neutral at zero");
                    assert!(!card.signed || low < 0.0 && high > 0.0, "{id}: bounds of a signed strength");
                    assert!(card.interest <= 4.0 * p.probes[0].abs(), "{id}: a probe far too small to be of interest");
                }
                Role::Shaped => assert!(!p.probes.is_empty(), "{id}: {name} has no probe"),
                Role::Shape => assert!(!p.probes.is_empty(), "{id}: {name} has no usual value to probe"),
            }
        }
    }
}

/// A sane part of a parameter's bounds, for limits that stand for "none".
fn sane(p: &robot_model::Parameter) -> [f64; 2] {
    p.bounds.map(|b| b.clamp(-1e3, 1e3))
}

/// Drives with `values` and tells what went wrong.
fn stays_finite(effect: &'static dyn Effect<f64>, values: &[f64], presence: Presence<f64>) -> Result<(), String> {
    for causality in BOTH {
        let mut worst = 0.0_f64;
        let active = [Active::new(effect, values, presence)];
        let last = run(&robot(), &active, causality, at_rest(2.0), |plant, s| {
            let mut y = plant.readings(s);
            plant.sense(&mut y);
            let [a, b] = y.velocity;
            // NaN must not be swallowed by max.
            for x in [a, b, y.gyro / 10.0, y.wheel_speed[0] / 20.0, y.wheel_speed[1] / 20.0] {
                worst = if x.is_finite() { worst.max(x.abs()) } else { f64::INFINITY };
            }
        });
        let finite = numbers(&last).iter().all(|x| x.is_finite());
        let unit = last.heading[0].hypot(last.heading[1]);
        if !finite || worst > 30.0 || (unit - 1.0).abs() > 1e-3 {
            return Err(format!("{causality:?}: {} {values:?}: {worst}, heading {unit}", effect.card().id));
        }
    }
    Ok(())
}

#[test]
fn runs_stay_finite_at_every_corner_of_the_bounds() {
    let mut bad = Vec::new();
    for effect in effects::catalogue::<f64>() {
        let parameters = effect.card().parameters;
        for corner in 0..1_usize << parameters.len() {
            let values: Vec<f64> =
                parameters.iter().enumerate().map(|(i, p)| sane(p)[usize::from(corner >> i & 1 == 1)]).collect();
            for presence in worn(effect.card().wears) {
                bad.extend(stays_finite(effect, &values, presence).err());
            }
        }
    }
    assert!(bad.is_empty(), "{}", bad.join("\n"));
}

fn kinetic(r: &Robot<f64>, s: &State<f64>) -> f64 {
    let [x, y] = s.velocity;
    let mut twice = r.mass * (x * x + y * y) + r.yaw_inertia * s.yaw_rate * s.yaw_rate;
    for j in 0..2 {
        twice += r.wheel_inertia * s.front_speed[j] * s.front_speed[j];
        twice += (r.wheel_inertia + r.motor_inertia) * s.wheel_speed[j] * s.wheel_speed[j];
    }
    0.5 * twice
}

/// Effects that take energy at positive strength.
const PASSIVE: [&str; 6] =
    ["coulomb_side", "quadratic_drag", "rolling_resistance", "stiction", "thermal_drift", "viscous_friction"];

#[test]
fn friction_never_adds_energy_to_a_coasting_robot() {
    let r = robot();
    let mut bad = Vec::new();
    let mut seen = 0;
    for effect in effects::catalogue::<f64>().into_iter().filter(|e| PASSIVE.contains(&e.card().id)) {
        seen += 1;
        let p = &effect.card().parameters[0];
        for strength in [p.probes[0], 5.0 * p.probes[0], p.bounds[1]] {
            for (velocity, yaw_rate) in [([1.5, 0.0], 0.0), ([0.0, 0.0], 4.0), ([-0.8, 0.0], 2.0), ([0.0, 0.5], 0.0)] {
                for presence in worn(effect.card().wears) {
                    let active = [Active::new(effect, &[strength], presence)];
                    let plant = Plant::new(&r, &active, H);
                    let mut s = State { yaw_rate, ..State::default() };
                    plant.set_velocity(&mut s, velocity);
                    let rim = |side: f64| (velocity[0] + side * yaw_rate * r.half_track) / r.wheel_radius;
                    s.wheel_speed = [rim(-1.0), rim(1.0)];
                    s.front_speed = s.wheel_speed;
                    let start = kinetic(&r, &s);
                    let mut before = start;
                    for k in 0..3000 {
                        plant.step(&mut s, [0.0; 2]);
                        let now = kinetic(&r, &s);
                        // At the upper bound friction reverses a slow wheel within a step of 1 ms.
                        let allowed = if strength == p.bounds[1] { 2e-5 } else { 1e-14 };
                        if now - before > allowed * start {
                            let (id, rise) = (effect.card().id, (now - before) / start);
                            bad.push(format!(
                                "{id} = {strength}, {presence:?}: {rise:.1e} in step {k}, from {velocity:?} {yaw_rate}"
                            ));
                            break;
                        }
                        before = now;
                    }
                    assert!(before <= start);
                }
            }
        }
    }
    assert_eq!(seen, PASSIVE.len());
    assert!(bad.is_empty(), "{} rises\n{}", bad.len(), bad.join("\n"));
}

/// States at which every smooth law is active: driving and turning, slow, and sliding sideways.
fn moving() -> [State<f64>; 3] {
    let state = |velocity, yaw_rate, speed: [f64; 2], time| State {
        time,
        velocity,
        yaw_rate,
        position: [0.4, -0.2],
        heading: [0.8, 0.6],
        wheel_speed: speed,
        front_speed: speed.map(|w| 0.97 * w),
        wheel_angle: [1.0, 2.5],
        torque: [1.0, 1.5],
        lagged: [1.0, 1.5],
        ..State::default()
    };
    [
        state([0.8, 0.03], 0.4, [8.0, 10.0], 3.0),
        state([0.02, 0.0], 0.05, [0.2, 0.35], 1.0),
        state([-0.5, 0.3], -1.0, [-4.0, -9.0], 9.0),
    ]
}

fn dual(s: &State<f64>) -> State<Dual64> {
    let two = |x: [f64; 2]| x.map(Dual64::from_re);
    State {
        time: Dual64::from_re(s.time),
        position: two(s.position),
        heading: two(s.heading),
        velocity: two(s.velocity),
        yaw_rate: Dual64::from_re(s.yaw_rate),
        wheel_speed: two(s.wheel_speed),
        front_speed: two(s.front_speed),
        wheel_angle: two(s.wheel_angle),
        torque: two(s.torque),
        lagged: two(s.lagged),
        specific: two(s.specific),
        rate: s.rate.map(Dual64::from_re),
        needed: two(s.needed),
    }
}

/// The state after `steps` steps and the readings of the gyro.
fn advance<T: Scalar>(
    effect: &'static dyn Effect<T>,
    values: &[T],
    presence: Presence<T>,
    start: State<T>,
    (causality, steps): (Causality, usize),
) -> Vec<T> {
    let active = [Active::new(effect, values, presence)];
    let mut gyro = T::zero();
    let robot = robot().cast();
    let end = run(&robot, &active, causality, (start, steps as f64 * H, H), |plant, s| {
        let mut y = plant.readings(s);
        plant.sense(&mut y);
        gyro = y.gyro;
    });
    let mut all = numbers(&end);
    all.push(gyro);
    all
}

/// Largest difference of the dual derivative from a central difference, relative to the largest derivative.
fn derivative_error(index: usize, parameter: usize, share: f64, start: &State<f64>, how: (Causality, usize)) -> f64 {
    let (plain, duals) = (effects::catalogue::<f64>()[index], effects::catalogue::<Dual64>()[index]);
    let card = plain.card();
    let mut values: Vec<f64> =
        card.parameters.iter().map(|p| if p.role == Role::Shape { p.neutral } else { share * p.probes[0] }).collect();
    let mut exact: Vec<Dual64> = values.iter().map(|v| Dual64::from_re(*v)).collect();
    exact[parameter].eps = 1.0;
    let exact = advance(duals, &exact, Presence::default(), dual(start), how);
    let (at, d) = (values[parameter], 1e-3 * card.parameters[parameter].probes[0].abs());
    let mut side = |x: f64| {
        values[parameter] = x;
        advance(plain, &values, Presence::default(), *start, how)
    };
    let (up, down) = (side(at + d), side(at - d));
    let largest = exact.iter().map(|x| x.eps.abs()).fold(1e-9, f64::max);
    let difference = up.iter().zip(&down).zip(&exact).map(|((u, l), x)| ((u - l) / (2.0 * d) - x.eps).abs());
    difference.fold(0.0, |worst: f64, x| if x.is_nan() { f64::NAN } else { worst.max(x) }) / largest
}

fn linear_strengths() -> impl Iterator<Item = (usize, usize, &'static Card)> {
    effects::catalogue::<f64>()
        .into_iter()
        .enumerate()
        .filter(|(_, e)| e.card().is_linear())
        .flat_map(|(i, e)| e.card().strengths().map(move |k| (i, k, e.card())))
}

#[test]
fn dual_derivatives_equal_central_differences() {
    for (effect, parameter, card) in linear_strengths() {
        for causality in BOTH {
            for (n, start) in moving().iter().enumerate() {
                // Over many steps a central difference may straddle a kink, where one branch of a law meets the next.
                for (steps, bound) in [(1, 1e-6), (100, 1e-4)] {
                    let error = derivative_error(effect, parameter, 1.0, start, (causality, steps));
                    assert!(
                        error < bound,
                        "{} {parameter}, state {n}, {causality:?}, {steps} steps: {error:e}",
                        card.id
                    );
                }
            }
        }
    }
}

#[test]
fn dual_derivatives_exist_from_rest() {
    for (effect, parameter, card) in linear_strengths() {
        for causality in BOTH {
            let mut values = vec![Dual64::from_re(0.0); card.parameters.len()];
            for (v, p) in values.iter_mut().zip(card.parameters) {
                *v = Dual64::from_re(p.neutral);
            }
            values[parameter].eps = 1.0;
            let law = effects::catalogue::<Dual64>()[effect];
            let end = advance(law, &values, Presence::default(), State::default(), (causality, 500));
            assert!(end.iter().all(|x| x.re.is_finite() && x.eps.is_finite()), "{} {causality:?}: {end:?}", card.id);
        }
    }
}

#[test]
fn physics_and_commands_show_in_the_motion_and_sensor_faults_do_not() {
    for effect in effects::catalogue::<f64>() {
        let card = effect.card();
        let values: Vec<f64> = card.parameters.iter().map(|p| p.probes[0]).collect();
        let run = |active: &[Active<f64>]| run(&robot(), active, Causality::Torque, at_rest(2.0), |_, _| ());
        let active = [Active::new(effect, &values, Presence::default())];
        let moved = distance(&run(&active), &run(&[]));
        match card.kind {
            Kind::Sensor => assert_eq!(moved, 0.0, "{}", card.id),
            // The delay is applied by whoever looks the command up.
            Kind::Command if card.id == "transport_delay" => {
                assert!(Plant::new(&robot(), &active, H).drive().delay > robot().drive.delay);
            }
            _ => assert!(moved > 1e-4, "{} at its probe is not seen: {moved:e}", card.id),
        }
    }
}

/// A robot that drives askew, and an instant of its surroundings.
fn instant(heading: f64) -> (Situation<f64>, World<f64>) {
    let at = Situation {
        time: 3.0,
        position: [1.0, -2.0],
        heading: [heading.cos(), heading.sin()],
        velocity: [0.7, -0.2],
        yaw_rate: 0.5,
        wheel_speed: [6.0, 9.0],
        wheel_angle: [0.3, 2.0],
        mass: 30.0,
        gravity: 9.81,
        hitch: [-0.25, 0.1],
        half_base: [0.17, 0.2],
    };
    let world = World {
        adhesion: [0.7; 4],
        slip_at_peak: [0.12; 4],
        lateral: [0.9; 4],
        rolling: [0.025; 4],
        radius: [0.09; 4],
        coulomb: [0.5, 0.4],
        viscous: [0.03, 0.04],
        stribeck: [0.1; 2],
        belt_limit: [1e9; 2],
        force: [0.0; 2],
        moment: 0.0,
        tilt: [0.0; 2],
    };
    (at, world)
}

fn world_numbers(w: &World<f64>) -> Vec<f64> {
    let World { adhesion, slip_at_peak, lateral, rolling, radius, coulomb, viscous, stribeck, .. } = *w;
    let World { belt_limit, force, moment, tilt, .. } = *w;
    let wheels = [adhesion, slip_at_peak, lateral, rolling, radius].into_iter().flatten();
    let sides = [coulomb, viscous, stribeck, belt_limit, force, tilt].into_iter().flatten();
    wheels.chain(sides).chain([moment]).collect()
}

#[test]
fn strengths_act_in_proportion() {
    let (at, before) = instant(0.8);
    for (effect, parameter, card) in linear_strengths() {
        let change = |share: f64| {
            let mut values = [0.0; MAX_PARAMETERS];
            for (v, p) in values.iter_mut().zip(card.parameters) {
                *v = p.neutral;
            }
            values[parameter] = share * card.parameters[parameter].probes[0];
            let mut world = before;
            effects::catalogue::<f64>()[effect].act(&values, &at, &mut world);
            let pairs = world_numbers(&world).into_iter().zip(world_numbers(&before));
            pairs.map(|(a, b)| a - b).collect::<Vec<_>>()
        };
        for (one, three) in change(1.0).into_iter().zip(change(3.0)) {
            // A slope acts by its sine: 0.05 % less than three times as much at three times the angle.
            assert!((3.0 * one - three).abs() <= 1e-3 * three.abs().max(1e-9), "{}: {one} {three}", card.id);
        }
    }
}

#[test]
fn a_grade_is_fixed_in_the_world_and_a_pull_in_the_robot() {
    for heading in [0.0, 0.8, 2.5, -1.9_f64] {
        let (at, mut w) = instant(heading);
        effects::grade::Law.act(&[0.02, -0.05, 0.0, 0.0], &at, &mut w);
        let (c, s, [x, y]) = (heading.cos(), heading.sin(), w.tilt);
        let slope = 0.02_f64.hypot(0.05);
        let share = slope.sin() / slope;
        for (got, wanted) in [(c * x - s * y, 0.02), (s * x + c * y, -0.05)] {
            assert!((got - at.gravity * share * wanted).abs() < 1e-10, "heading {heading}: {got}");
        }
        let (at, mut w) = instant(heading);
        effects::constant_pull::Law.act(&[4.0, 0.0, 0.0, 0.0], &at, &mut w);
        assert_eq!(w.force, [-4.0, 0.0]);
        // x Fy − y Fx at the hitch.
        assert!((w.moment - (at.hitch[0] * w.force[1] - at.hitch[1] * w.force[0])).abs() < 1e-12);
    }
}

fn mirrored_state(s: &State<f64>) -> State<f64> {
    let swap = |[a, b]: [f64; 2]| [b, a];
    let flip = |[a, b]: [f64; 2]| [a, -b];
    State {
        time: s.time,
        position: flip(s.position),
        heading: flip(s.heading),
        velocity: flip(s.velocity),
        yaw_rate: -s.yaw_rate,
        wheel_speed: swap(s.wheel_speed),
        front_speed: swap(s.front_speed),
        wheel_angle: swap(s.wheel_angle),
        torque: swap(s.torque),
        lagged: swap(s.lagged),
        specific: flip(s.specific),
        rate: [s.rate[0], -s.rate[1], -s.rate[2]],
        needed: swap(s.needed),
    }
}

/// Drives `commands`, each held over 50 ms, as torques or as speeds.
fn drive(robot: &Robot<f64>, active: &[Active<f64>], causality: Causality, commands: &[[f64; 2]]) -> State<f64> {
    let plant = Plant::new(robot, active, H);
    let mut s = State::default();
    for c in commands {
        for _ in 0..50 {
            match causality {
                Causality::Torque => plant.step(&mut s, *c),
                Causality::Speed => plant.step_at_speed(&mut s, *c, [0.0; 2]),
            }
        }
    }
    s
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_mirrored_robot_drives_the_mirrored_way(
        index in 0..effects::COUNT,
        size in 0.0..1.0_f64,
        wear in 0_usize..5,
        speed_driven: bool,
        commands in prop::collection::vec(prop::array::uniform2(-6.0..6.0_f64), 10),
    ) {
        let causality = BOTH[usize::from(speed_driven)];
        let effect = effects::catalogue::<f64>()[index];
        let card = effect.card();
        let values: Vec<f64> = card.parameters.iter().map(|p| p.neutral.min(1e3) * (1.0 - size) + size * p.probes[0]).collect();
        // Components across the robot are named after their axis.
        let across = card.parameters.iter().zip(&values);
        let mirrored_values: Vec<f64> = across.map(|(p, v)| if p.name.ends_with('y') { -v } else { *v }).collect();
        let presences = worn::<f64>(ANY);
        let presence = presences[wear.min(presences.len() - 1)];
        let mirrored_presence = Presence {
            side: presence.side.map(|s| 1 - s),
            disc: presence.disc.map(|d| Disc { centre: [d.centre[0], -d.centre[1]], ..d }),
            ..presence
        };
        let r = robot();
        let mut m = r;
        m.com[1] = -r.com[1];
        m.coulomb = [r.coulomb[1], r.coulomb[0]];
        m.viscous = [r.viscous[1], r.viscous[0]];
        let mirrored_commands: Vec<[f64; 2]> = commands.iter().map(|[a, b]| [*b, *a]).collect();
        let one = drive(&r, &[Active::new(effect, &values, presence)], causality, &commands);
        let other = drive(&m, &[Active::new(effect, &mirrored_values, mirrored_presence)], causality, &mirrored_commands);
        let d = distance(&mirrored_state(&one), &other);
        prop_assert!(d < 1e-8, "{}: {d:e}", card.id);
    }

    #[test]
    fn runs_stay_finite_inside_the_bounds(
        index in 0..effects::COUNT,
        place in prop::array::uniform4(0.0..1.0_f64),
        wear in 0_usize..5,
    ) {
        let effect = effects::catalogue::<f64>()[index];
        let values: Vec<f64> = effect.card().parameters.iter().zip(place).map(|(p, x)| {
            let [low, high] = sane(p);
            low + x * (high - low)
        }).collect();
        let presences = worn(effect.card().wears);
        let outcome = stays_finite(effect, &values, presences[wear % presences.len()]);
        prop_assert!(outcome.is_ok(), "{outcome:?}");
    }

    #[test]
    fn dual_derivatives_equal_central_differences_at_any_strength(
        pick in 0_usize..1000,
        share in 0.1..3.0_f64,
        state in 0_usize..3,
        speed_driven: bool,
    ) {
        let all: Vec<_> = linear_strengths().collect();
        let (effect, parameter, card) = all[pick % all.len()];
        let how = (BOTH[usize::from(speed_driven)], 1);
        let error = derivative_error(effect, parameter, share, &moving()[state], how);
        prop_assert!(error < 1e-5, "{} {parameter}: {error:e}", card.id);
    }
}
