//! Friction takes energy and never gives any.

use robot_model::{Active, Chassis, Effect, Plant, Robot, State, effects};

use crate::battery::{H, presences, robots_of};

fn kinetic(r: &Robot<f64>, s: &State<f64>) -> f64 {
    let [x, y] = s.velocity;
    let mut twice = r.mass * (x * x + y * y) + r.yaw_inertia * s.yaw_rate * s.yaw_rate;
    let [wheel, motor] = [r.wheel_inertia, r.motor_inertia];
    for j in 0..2 {
        let [front, told] = [s.passive[j], s.wheel_speed[j]];
        twice += match r.chassis {
            Chassis::SkidSteer => wheel * front * front + (wheel + motor) * told * told,
            // What is told of them is their mean.
            Chassis::FourMotors => (wheel + 0.5 * motor) * (front * front + (2.0 * told - front).powi(2)),
            Chassis::Differential => (wheel + motor) * told * told,
        };
    }
    0.5 * twice
}

/// Effects that take energy at positive strength.
const PASSIVE: [&str; 8] = [
    "coulomb_friction",
    "coulomb_side",
    "load_dependent_friction",
    "quadratic_drag",
    "rolling_resistance",
    "stiction",
    "thermal_drift",
    "viscous_friction",
];

#[test]
fn friction_never_adds_energy_to_a_coasting_robot() {
    let mut bad = Vec::new();
    let mut seen = 0;
    for effect in effects::catalogue::<f64>().into_iter().filter(|e| PASSIVE.contains(&e.spec().id)) {
        seen += 1;
        for r in robots_of(effect.spec()) {
            bad.extend(rises(effect, &r));
        }
    }
    assert_eq!(seen, PASSIVE.len());
    assert!(bad.is_empty(), "{} rises\n{}", bad.len(), bad.join("\n"));
}

/// When a coasting robot with this effect gains energy.
fn rises(effect: &'static dyn Effect<f64>, r: &Robot<f64>) -> Vec<String> {
    let mut bad = Vec::new();
    let p = &effect.spec().parameters[0];
    for strength in [p.probes[0], 5.0 * p.probes[0], p.bounds[1]] {
        for (velocity, yaw_rate) in [([1.5, 0.0], 0.0), ([0.0, 0.0], 4.0), ([-0.8, 0.0], 2.0), ([0.0, 0.5], 0.0)] {
            for presence in presences(effect.spec().scopes) {
                let active = [Active::new(effect, &[strength], presence)];
                // At the upper bound friction reverses a slow wheel within a step of 1 ms: one that bears all of it alone
                // needs shorter ones.
                let is_alone = strength == p.bounds[1] && r.chassis == Chassis::Differential;
                let step = if is_alone { H / 20.0 } else { H };
                let plant = Plant::new(r, &active, step);
                let mut s = State { yaw_rate, ..State::default() };
                plant.set_velocity(&mut s, velocity);
                let rim = |side: f64| (velocity[0] + side * yaw_rate * r.half_track) / r.wheel_radius;
                s.wheel_speed = [rim(-1.0), rim(1.0)];
                if r.chassis.is_on_four_wheels() {
                    s.passive = s.wheel_speed;
                }
                let start = kinetic(r, &s);
                let mut before = start;
                for k in 0..(3.0 / step) as usize {
                    plant.step(&mut s, [0.0; 2]);
                    let now = kinetic(r, &s);
                    let allowed = if strength == p.bounds[1] { 2e-5 } else { 1e-14 };
                    if now - before > allowed * start {
                        let (id, rise) = (effect.spec().id, (now - before) / start);
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
    bad
}
