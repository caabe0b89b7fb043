//! Strengths act in proportion, and where the card says they do.

use robot_model::effect::MAX_PARAMETERS;
use robot_model::{Active, Kind, Plant, Presence, effects};

use crate::battery::{H, at_rest, instant, linear_strengths, world_numbers};
use crate::common::{Causality, distance, robot, run};

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
