//! Models in MuJoCo itself; ignored where there is no Python that has it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

use inference::KnownEffects;
use model_export::{AnyWheelsModel, Engine, Input, Model};
use robot_model::effects::catalogue;
use robot_model::{Chassis, Plant, Robot, State, paper, wheels};
use skipping::{Outcome, Skipped};
use verdict::{EffectAt, Side};

/// A Python with MuJoCo: the one that is named, or that of `cargo xtask mujoco`.
fn python() -> Result<PathBuf, Skipped> {
    let made = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../target/mujoco/venv/bin/python");
    let python = std::env::var_os("LACUNA_MUJOCO_PYTHON").map_or(made, PathBuf::from);
    let there = Command::new(&python).args(["-c", "import mujoco"]).output().is_ok_and(|o| o.status.success());
    let missing = "no Python with MuJoCo; name one with LACUNA_MUJOCO_PYTHON, or run `cargo xtask mujoco`";
    if there { Ok(python) } else { Err(Skipped::because(missing)) }
}

fn robot() -> Robot<f64> {
    let mut r = Robot::from(&paper::Parameters::SET_B);
    (r.adhesion, r.slip_at_peak, r.sliding_share) = (0.64, 0.12, 1.0);
    (r.mass, r.yaw_inertia, r.coulomb, r.rolling_resistance) = (23.0, 0.9, [0.28; 2], 0.02);
    (r.viscous, r.motor_inertia) = ([0.1; 2], 0.02);
    (r.drive.lag, r.drive.limit) = (0.01, 15.0);
    r
}

/// Loads a model, turns the wheels for two seconds under constant torques and prints mass, wheel speeds and yaw rate.
const SCRIPT: &str = r#"
import importlib.util, os, sys, mujoco
model = mujoco.MjModel.from_xml_path(sys.argv[1])
data = mujoco.MjData(model)
residual = None
if os.path.exists(sys.argv[2]):
    spec = importlib.util.spec_from_file_location("residual", sys.argv[2])
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    residual = module.Residual(model)
while data.time < 2.0:
    data.ctrl[:2] = [float(sys.argv[3]), float(sys.argv[4])]
    if residual:
        residual.apply(data)
    mujoco.mj_step(model, data)
speeds = [float(data.joint(n).qvel[0]) for n in ("rear_left", "rear_right")]
print(float(model.body_mass.sum()), *speeds, float(data.qvel[5]))
"#;

/// Mass, wheel speeds and yaw rate after two seconds under `torque`.
fn driven(python: &Path, robot: &Robot<f64>, effects: &[EffectAt], torque: [f64; 2]) -> [f64; 4] {
    let folder = tempfile::tempdir().expect("a folder");
    let (xml, residual) = (folder.path().join("robot.xml"), folder.path().join("robot.residual.py"));
    let model = Model { name: "tested", robot, effects, known: KnownEffects::default(), before: None, causes: &[] };
    let exported = model.export(Engine::Mjcf).expect("a model");
    std::fs::write(&xml, exported.text).expect("writes");
    if let Some(text) = exported.residual {
        std::fs::write(&residual, text).expect("writes");
    }
    let out = Command::new(python)
        .args(["-c", SCRIPT])
        .args([&xml, &residual])
        .args(torque.map(|t| t.to_string()))
        .output()
        .expect("starts");
    assert!(out.status.success(), "{}", String::from_utf8_lossy(&out.stderr));
    let text = String::from_utf8_lossy(&out.stdout);
    let numbers: Vec<f64> = text.split_whitespace().map(|x| x.parse().expect("a number")).collect();
    numbers.try_into().expect("four numbers")
}

fn every_effect_loads_and_drives_in_mujoco() -> Outcome {
    let python = python()?;
    let robot = robot();
    for effect in catalogue::<f64>() {
        let spec = effect.spec();
        let value = |p: &robot_model::Parameter| if p.probes[0] > 0.0 && p.neutral > 1e6 { 1.5 } else { p.probes[0] };
        let values: BTreeMap<String, f64> = spec.parameters.iter().map(|p| (p.name.to_owned(), value(p))).collect();
        let side = spec.scopes.side.then_some(Side::Left);
        let at = EffectAt { effect: spec.id.to_owned(), values, side, ..EffectAt::default() };
        let [mass, left, right, yaw] = driven(&python, &robot, &[at], [4.0, 4.0]);
        let grown = if spec.id == "payload" { 2.0 } else { 0.0 };
        assert!((mass - robot.mass - grown).abs() < 1e-3, "{}: {mass} kg", spec.id);
        assert!(left > 0.5 && right > 0.5 && yaw.abs() < 2.0, "{}: {left} {right} rad/s, {yaw} rad/s", spec.id);
    }
    Ok(())
}

fn mujoco_drives_like_the_planar_plant() -> Outcome {
    let python = python()?;
    let four_motors = Robot { chassis: Chassis::FourMotors, ..robot() };
    let torques = [[3.0, 3.0], [8.0, 2.0], [8.0, -8.0]];
    for (robot, torque) in [robot(), four_motors].iter().flat_map(|robot| torques.map(|torque| (robot, torque))) {
        let [_, left, right, yaw] = driven(&python, robot, &[], torque);
        let plant = Plant::new(robot, &[], 1e-3);
        let mut s = State::default();
        for _ in 0..2000 {
            plant.step(&mut s, torque);
        }
        // A tenth: MuJoCo's contacts creep like the tyre does at one speed only.
        let scale = s.wheel_speed[0].abs().max(s.wheel_speed[1].abs());
        for (got, wanted) in [(left, s.wheel_speed[0]), (right, s.wheel_speed[1])] {
            assert!((got - wanted).abs() < 0.1 * scale, "{torque:?}: {got} rad/s in MuJoCo, {wanted} in the plant");
        }
        // Quick arcs come out too wide for the same reason: only their sense is sure.
        let apart = if torque[0] + torque[1] == 0.0 { 0.1 } else { 0.8 };
        let near = (yaw - s.yaw_rate).abs() < apart * s.yaw_rate.abs() + 0.02;
        assert!(near, "{torque:?}: {yaw} rad/s in MuJoCo, {} in the plant", s.yaw_rate);
    }
    Ok(())
}

/// Drives a model for three seconds under constant commands and prints mass, place, heading, and wheel speeds by name.
const ANY_WHEELS: &str = r#"
import math, sys, mujoco
model = mujoco.MjModel.from_xml_path(sys.argv[1])
data = mujoco.MjData(model)
for k, command in enumerate(sys.argv[3:]):
    data.ctrl[k] = float(command)
heading, last = 0.0, 0.0
while data.time < 3.0:
    mujoco.mj_step(model, data)
    w, x, y, z = data.sensor("orientation").data
    now = math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
    heading += math.remainder(now - last, 2 * math.pi)
    last = now
speeds = [float(data.sensor("speed_" + n).data[0]) for n in sys.argv[2].split(",")]
print(float(model.body_mass.sum()), *data.sensor("position").data[:2], heading, *speeds)
"#;

/// Mass, place, heading and wheel speeds after three seconds of MuJoCo under these commands.
fn driven_in_mujoco(python: &Path, robot: &wheeled::AnyWheels, commands: &[f64]) -> Vec<f64> {
    let model = AnyWheelsModel {
        name: &robot.name,
        robot: &robot.plant,
        wheels: &robot.wheels,
        motors: &Input::in_si(&robot.motors),
        joints: &Input::in_si(&robot.joints),
        point: [0.0; 3],
        told: &[],
    };
    let folder = tempfile::tempdir().expect("a folder");
    let xml = folder.path().join("robot.xml");
    std::fs::write(&xml, model.export(Engine::Mjcf).expect("a model").text).expect("writes");
    let wheels: Vec<String> = robot.wheels.iter().map(|name| name.replace(' ', "_")).collect();
    let out = Command::new(python)
        .args(["-c", ANY_WHEELS])
        .arg(&xml)
        .arg(wheels.join(","))
        .args(commands.iter().map(f64::to_string))
        .output()
        .expect("starts");
    assert!(out.status.success(), "{}", String::from_utf8_lossy(&out.stderr));
    let text = String::from_utf8_lossy(&out.stdout);
    text.split_whitespace().map(|x| x.parse().expect("a number")).collect()
}

/// Where the plant is after three seconds under these commands: place, heading and wheel speeds.
fn driven_in_plane(robot: &wheels::Robot<f64>, commands: &[f64]) -> Vec<f64> {
    let motors = robot.motors.iter().flatten().count();
    let input = |of: &[f64]| std::array::from_fn(|k| of.get(k).copied().unwrap_or(0.0));
    let (torque, steering) = (input(&commands[..motors]), input(&commands[motors..]));
    let plant = wheels::Plant::new(robot, 1e-3);
    let mut s = wheels::State::default();
    for _ in 0..3000 {
        plant.step(&mut s, &torque, &steering);
    }
    let [x, y] = plant.place_of(&s, [0.0; 2]);
    let turning = &s.wheel_speed[..robot.wheels.iter().flatten().count()];
    [x, y, s.turned].into_iter().chain(turning.iter().copied()).collect()
}

fn robots_of_any_wheels_drive_like_their_plant() -> Outcome {
    let python = python()?;
    // Torques of the motors, then angles of the steering joints.
    let drives: [(&str, &[f64]); 7] = [
        ("torque-tricycle", &[4.0, 0.2]),
        ("torque-car", &[3.0, -0.25]),
        ("torque-car", &[2.0, 0.0]),
        ("torque-omni-3", &[0.6, -0.9, 0.3]),
        ("torque-omni-3", &[0.8, 0.8, 0.8]),
        ("torque-six-wheel", &[6.0, 6.0]),
        ("torque-six-wheel", &[35.0, -35.0]),
    ];
    for (name, commands) in drives {
        let (_, text) = wheeled::file::BUILT_IN.iter().find(|(n, _)| *n == name).expect("built in");
        let robot = wheeled::file::RobotFile::parse(name, text).expect("a robot").robot;
        let got = driven_in_mujoco(&python, &robot, commands);
        let wanted = driven_in_plane(&robot.plant, commands);
        let (mass, got) = got.split_first().expect("a mass");
        assert!((mass - robot.plant.mass).abs() < 1e-3, "{name}: {mass} kg");
        // A twentieth: MuJoCo's contacts creep like the tyre does at one speed only. Where fixed wheels skid they turn too little for
        // the same reason: only their sense is sure.
        let fastest = wanted[3..].iter().fold(0.0_f64, |most, w| most.max(w.abs()));
        let path = 1.5 * fastest * robot.plant.wheels[0].expect("a wheel").radius;
        let turned = if name == "torque-six-wheel" { 0.8 } else { 0.05 };
        for (k, (got, wanted)) in got.iter().zip(&wanted).enumerate() {
            let near = match k {
                0 | 1 => 0.05 * path,
                2 => turned * wanted.abs() + 0.01,
                _ => 0.1 * fastest,
            };
            assert!((got - wanted).abs() < near, "{name} {commands:?}, {k}: {got} in MuJoCo, {wanted} in the plant");
        }
    }
    Ok(())
}

skipping::tests![
    every_effect_loads_and_drives_in_mujoco,
    mujoco_drives_like_the_planar_plant,
    robots_of_any_wheels_drive_like_their_plant,
];
