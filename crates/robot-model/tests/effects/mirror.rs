//! A mirrored robot drives the mirrored way.

use proptest::prelude::*;
use robot_model::{Active, Chassis, Disc, Parameter, Plant, Presence, Robot, State, effects};

use crate::battery::{ANY, H, presences, robots_of};
use crate::common::{BOTH, Causality, distance};

/// Effects whose sign tells one diagonal from the other.
const DIAGONAL: [&str; 1] = ["contact_loss"];

fn mirrored_state(s: &State<f64>, chassis: Chassis) -> State<f64> {
    let swap = |[a, b]: [f64; 2]| [b, a];
    let flip = |[a, b]: [f64; 2]| [a, -b];
    State {
        time: s.time,
        position: flip(s.position),
        heading: flip(s.heading),
        velocity: flip(s.velocity),
        yaw_rate: -s.yaw_rate,
        wheel_speed: swap(s.wheel_speed),
        passive: match chassis {
            Chassis::SkidSteer | Chassis::FourMotors => swap(s.passive),
            Chassis::Differential => s.passive.map(|angle| -angle),
        },
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
        casters: bool,
        commands in prop::collection::vec(prop::array::uniform2(-6.0..6.0_f64), 10),
    ) {
        let causality = BOTH[usize::from(speed_driven)];
        let effect = effects::catalogue::<f64>()[index];
        let spec = effect.spec();
        let values: Vec<f64> = spec.parameters.iter().map(|p| p.neutral.min(1e3) * (1.0 - size) + size * p.probes[0]).collect();
        // Components across the robot are named after their axis.
        let across = spec.parameters.iter().zip(&values);
        let turned = |p: &Parameter| p.name.ends_with('y') || DIAGONAL.contains(&spec.id);
        let mirrored_values: Vec<f64> = across.map(|(p, v)| if turned(p) { -v } else { *v }).collect();
        let presences = presences::<f64>(ANY);
        let presence = presences[wear.min(presences.len() - 1)];
        let mirrored_presence = Presence {
            side: presence.side.map(|s| 1 - s),
            disc: presence.disc.map(|d| Disc { centre: [d.centre[0], -d.centre[1]], ..d }),
            ..presence
        };
        let robots = robots_of(spec);
        let r = robots[usize::from(casters) % robots.len()];
        let mut m = r;
        m.casters = r.casters.map(|[x, y]| [x, -y]);
        m.com[1] = -r.com[1];
        m.coulomb = [r.coulomb[1], r.coulomb[0]];
        m.viscous = [r.viscous[1], r.viscous[0]];
        let mirrored_commands: Vec<[f64; 2]> = commands.iter().map(|[a, b]| [*b, *a]).collect();
        let one = drive(&r, &[Active::new(effect, &values, presence)], causality, &commands);
        let other = drive(&m, &[Active::new(effect, &mirrored_values, mirrored_presence)], causality, &mirrored_commands);
        let d = distance(&mirrored_state(&one, r.chassis), &other);
        prop_assert!(d < 1e-8, "{}: {d:e}", spec.id);
    }
}
