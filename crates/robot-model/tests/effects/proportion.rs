//! Strengths act in proportion, and where the specification says they do.

use robot_model::effect::MAX_PARAMETERS;
use robot_model::effect::export::Way;
use robot_model::{Active, Effect, Kind, Plant, Presence, State, effects};

use crate::battery::{H, at_rest, instant, linear_strengths, moving, numbers_of, robots_of};
use crate::common::{Causality, distance, robot, run};

/// An effect at its probe moves the robot by at least this, m and rad.
pub(crate) const LEAST: f64 = 1e-4;

/// How far an effect at its probe moves the end of a drive.
pub(crate) fn moved_by(effect: &'static dyn Effect<f64>) -> f64 {
    let moved = robots_of(effect.spec()).into_iter().map(|robot| {
        let run = |active: &[Active<f64>]| run(&robot, active, Causality::Torque, at_rest(2.0), |_, _| ());
        distance(&run(&[at_probe(effect)]), &run(&[]))
    });
    moved.fold(f64::INFINITY, f64::min)
}

fn at_probe(effect: &'static dyn Effect<f64>) -> Active<f64> {
    let values: Vec<f64> = effect.spec().parameters.iter().map(|p| p.probes[0]).collect();
    Active::new(effect, &values, Presence::default())
}

#[test]
fn physics_and_commands_show_in_the_motion_and_sensor_faults_do_not() {
    for effect in effects::catalogue::<f64>() {
        let (spec, moved) = (effect.spec(), moved_by(effect));
        match spec.kind {
            Kind::Sensor => assert_eq!(moved, 0.0, "{}", spec.id),
            // The delay is applied by whoever looks the command up.
            Kind::Command if spec.id == "transport_delay" => {
                let active = [at_probe(effect)];
                assert!(Plant::new(&robot(), &active, H).drive().delay > robot().drive.delay);
            }
            _ => assert!(moved > LEAST, "{} at its probe is not seen: {moved:e}", spec.id),
        }
    }
}

#[test]
fn sensor_faults_show_in_the_readings_unless_they_act_on_samples() {
    let readings = |active: &[Active<f64>]| {
        let robot = robot();
        let plant = Plant::new(&robot, active, H);
        // Everything moves, so that a scale or a turned axis shows too.
        let mut shown = plant.readings(&State { specific: [0.5, -0.2], ..moving()[0] });
        plant.sense(&mut shown);
        shown
    };
    for effect in effects::catalogue::<f64>().into_iter().filter(|e| e.spec().kind == Kind::Sensor) {
        let shows = readings(&[at_probe(effect)]) != readings(&[]);
        let acts_on_samples = effect.spec().export.robot_file == Way::ON_SAMPLES;
        assert_eq!(shows, !acts_on_samples, "{}", effect.spec().id);
    }
}

/// Panics where a strength does not act in proportion.
pub(crate) fn is_proportional(effect: &'static dyn Effect<f64>, parameter: usize) {
    let (at, before) = instant(0.8);
    let spec = effect.spec();
    let change = |share: f64| {
        let mut values = [0.0; MAX_PARAMETERS];
        for (v, p) in values.iter_mut().zip(spec.parameters) {
            *v = p.neutral;
        }
        values[parameter] = share * spec.parameters[parameter].probes[0];
        let mut with = before;
        effect.apply(&values, &at, &mut with);
        let pairs = numbers_of(&with).into_iter().zip(numbers_of(&before));
        pairs.map(|(a, b)| a - b).collect::<Vec<_>>()
    };
    for (one, three) in change(1.0).into_iter().zip(change(3.0)) {
        // A slope acts by its sine: 0.05 % less than three times as much at three times the angle.
        assert!((3.0 * one - three).abs() <= 1e-3 * three.abs().max(1e-9), "{}: {one} {three}", spec.id);
    }
}

#[test]
fn strengths_act_in_proportion() {
    for (effect, parameter, _) in linear_strengths() {
        is_proportional(effects::catalogue::<f64>()[effect], parameter);
    }
}
