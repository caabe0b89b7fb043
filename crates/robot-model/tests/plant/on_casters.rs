//! The plant of a robot on two driven wheels and casters.

use crate::common::{self, Causality, on_casters, run};
use approx::assert_relative_eq;
use robot_model::{Chassis, ModelError, Plant, Robot, State};

const H: f64 = 1e-3;

/// The state after `seconds` under constant torques.
fn under(robot: &Robot<f64>, start: State<f64>, torque: [f64; 2], seconds: f64) -> State<f64> {
    let plant = Plant::new(robot, &[], H);
    let mut s = start;
    for _ in 0..(seconds / H).round() as usize {
        plant.step_under(&mut s, torque);
    }
    s
}

/// The same robot whose sides are alike.
fn symmetric() -> Robot<f64> {
    let r = on_casters();
    let casters = [[-0.18, 0.0], [0.15, 0.0]];
    Robot { com: [r.com[0], 0.0, r.com[2]], coulomb: [0.2; 2], stribeck: 0.0, casters, ..r }
}

#[test]
fn the_loads_bear_the_weight_where_it_is() {
    let r = on_casters();
    let stance = r.stance();
    let sum =
        |f: fn(&[f64; 2]) -> f64| stance.static_load.iter().zip(&stance.wheel).map(|(n, at)| n * f(at)).sum::<f64>();
    assert_relative_eq!(sum(|_| 1.0), r.mass * r.gravity, max_relative = 1e-12);
    assert!(sum(|at| at[0]).abs() < 1e-9 && sum(|at| at[1]).abs() < 1e-9, "{stance:?}");
    assert!(stance.static_load.iter().all(|n| *n > 0.0), "{stance:?}");

    // Under a specific force the loads balance its moment about the centre of mass, whose height is the lever.
    let balance = stance.settle(&[[0.0; 2], [0.0; 2], [0.3, 0.0], [0.3, 0.0]]);
    let pitch: f64 = balance.load.iter().zip(&stance.wheel).map(|(n, at)| n * at[0]).sum();
    assert_relative_eq!(pitch, -balance.total[0] * r.com[2], max_relative = 1e-9);
    assert!(balance.load[0] > stance.static_load[0], "pulling away loads the caster behind: {balance:?}");
}

#[test]
fn steady_driving_takes_what_friction_and_rolling_cost() {
    let r = symmetric();
    let speed = 10.0;
    let loads = r.stance().static_load;
    let wheels: f64 = r.rolling_resistance * (loads[2] + loads[3]) * r.wheel_radius;
    let casters: f64 = r.caster_rolling * (loads[0] + loads[1]) * r.wheel_radius;
    let torque = 0.5 * (wheels + casters) + r.coulomb[0] + r.viscous[0] * speed;
    let s = under(&r, State::default(), [torque; 2], 60.0);
    // The drag pitches a little load from one axle of resistance to the other.
    assert!((s.wheel_speed[0] - speed).abs() < 0.05 && s.yaw_rate.abs() < 1e-9, "{s:?}");
}

#[test]
fn a_slow_robot_turns_as_its_wheels_roll() {
    let s = under(&symmetric(), State::default(), [0.1, 0.55], 4.0);
    let r = symmetric();
    let rolled = r.wheel_radius * (s.wheel_speed[1] - s.wheel_speed[0]) / (2.0 * r.half_track);
    assert!(s.yaw_rate > 0.3, "{s:?}");
    assert_relative_eq!(s.yaw_rate, rolled, max_relative = 0.03);
    // Each caster's wheel points where its pivot goes, but for what it must swing to go round: |v| sin = ω d.
    for (angle, [x, y]) in s.passive.into_iter().zip(r.casters) {
        let v = [s.velocity[0] + s.yaw_rate * r.com[1] - s.yaw_rate * y, s.velocity[1] - s.yaw_rate * (r.com[0] - x)];
        let across = v[1] * angle.cos() - v[0] * angle.sin();
        assert_relative_eq!(across, s.yaw_rate * r.caster_trail, max_relative = 0.05);
    }
}

#[test]
fn casters_swing_round_when_the_robot_reverses_and_stay_where_it_stands() {
    let r = on_casters();
    let plant = Plant::new(&r, &[], H);
    let mut s = State { wheel_speed: [5.0, 5.2], ..State::default() };
    plant.set_velocity(&mut s, [0.35, 0.0]);
    assert!(s.passive.iter().all(|angle| angle.abs() < 0.01), "{s:?}");
    let s = under(&r, s, [-1.2, -1.0], 3.0);
    assert!(s.velocity[0] < -0.5 && s.passive.iter().all(|angle| angle.cos() < -0.9), "{s:?}");

    let still = under(&r, State::default(), [0.0; 2], 1.0);
    assert_eq!((still.passive, still.position), ([0.0; 2], [0.0; 2]));
}

#[test]
fn a_motion_begins_with_casters_that_trail_whichever_way_it_goes() {
    let r = on_casters();
    let plant = Plant::new(&r, &[], H);
    for (velocity, yaw_rate) in
        [([0.4, 0.0], 0.0), ([-0.4, 0.0], 0.0), ([-0.4, 0.001], 0.0), ([0.1, 0.0], -2.0), ([0.0, 0.0], 3.0)]
    {
        let mut s = State { yaw_rate, ..State::default() };
        plant.set_velocity(&mut s, velocity);
        for (angle, [x, y]) in s.passive.into_iter().zip(r.casters) {
            let pivot: [f64; 2] = [velocity[0] - yaw_rate * y, velocity[1] + yaw_rate * x];
            let along = (pivot[0] * angle.cos() + pivot[1] * angle.sin()) / pivot[0].hypot(pivot[1]);
            assert!(along > 1.0 - 1e-9, "{along} at {velocity:?} {yaw_rate}: {angle}");
        }
    }
}

#[test]
fn a_robot_turns_on_its_half_track_unless_it_skids() {
    let (skids, rolls) = (common::robot(), on_casters());
    assert_eq!((skids.turning_lever(), rolls.turning_lever()), (1.5 * skids.half_track, rolls.half_track));
    let wheels = |r: &Robot<f64>| (r.side_inertia() - r.motor_inertia) / r.wheel_inertia;
    assert!((wheels(&skids) - 2.0).abs() < 1e-12 && (wheels(&rolls) - 1.0).abs() < 1e-12);
}

#[test]
fn a_step_may_be_halved() {
    let end = |h: f64| run(&on_casters(), &[], Causality::Torque, (State::default(), 2.0, h), |_, _| ());
    let (coarse, fine) = (end(2e-3), end(5e-4));
    assert!((coarse.yaw_rate - fine.yaw_rate).abs() < 0.05, "{coarse:?} {fine:?}");
    assert!((coarse.position[0] - fine.position[0]).abs() < 0.01, "{coarse:?} {fine:?}");
}

#[test]
fn speeds_imposed_take_the_torque_that_drives_so_fast() {
    let r = symmetric();
    let free = under(&r, State::default(), [0.9, 1.0], 30.0);
    let plant = Plant::new(&r, &[], H);
    let mut s = free;
    for _ in 0..1000 {
        plant.step_at_speed(&mut s, free.wheel_speed, [0.0; 2]);
    }
    let drive = r.drive.gain;
    assert!((s.needed[0] * drive - 0.9).abs() < 0.03 && (s.needed[1] * drive - 1.0).abs() < 0.03, "{s:?}");
}

#[test]
fn constants_of_the_other_chassis_and_casters_that_hold_nothing_are_refused() {
    let refused = |name: &'static str, value: f64, chassis: Chassis| {
        let mut given: Vec<(&'static str, f64)> = Robot::<f64>::CONSTANTS
            .iter()
            .filter(|c| c.is_of(chassis))
            .map(|c| (c.id, (c.get)(&if chassis == Chassis::SkidSteer { common::robot() } else { on_casters() })))
            .collect();
        given.push((name, value));
        Robot::on_chassis(chassis, &given).expect_err("refused")
    };
    let foreign = refused("caster_trail", 0.02, Chassis::SkidSteer);
    assert!(matches!(foreign, ModelError::Foreign { name: "caster_trail", .. }));
    assert!(foreign.to_string().contains("write chassis = \"differential\""), "{foreign}");
    let wheelbase = refused("wheelbase", 0.3, Chassis::Differential).to_string();
    assert_eq!(
        wheelbase,
        "a differential robot has no `wheelbase`; leave it out: the places of its casters say where it stands"
    );
    let off = refused("com_x", 0.2, Chassis::Differential).to_string();
    assert_eq!(off, "com_x is 0.2, but it must lie between -0.18 and 0.15");

    let near = Robot { casters: [[0.01, 0.0]; 2], ..on_casters() }.checked().expect_err("refused").to_string();
    assert!(near.starts_with("caster_x is 0.01: a caster so near to the driven axle"), "{near}");
}
