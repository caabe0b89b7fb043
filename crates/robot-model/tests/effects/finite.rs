//! Nothing within the bounds makes a drive blow up.

use proptest::prelude::*;
use robot_model::{Active, Effect, Presence, effects};

use crate::battery::{at_rest, presences, robots_of, sane};
use crate::common::{BOTH, numbers, run};

/// Drives with `values` and tells what went wrong.
fn stays_finite(effect: &'static dyn Effect<f64>, values: &[f64], presence: Presence<f64>) -> Result<(), String> {
    let robots = robots_of(effect.spec());
    for (robot, causality) in robots.iter().flat_map(|robot| BOTH.map(|causality| (robot, causality))) {
        let mut worst = 0.0_f64;
        let active = [Active::new(effect, values, presence)];
        let last = run(robot, &active, causality, at_rest(2.0), |plant, s| {
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
        // The strongest pull gets a light robot further.
        let most = 900.0 / robot.mass;
        if !finite || worst > most || (unit - 1.0).abs() > 1e-3 {
            return Err(format!(
                "{}, {causality:?}: {} {values:?}: {worst}, heading {unit}",
                robot.chassis,
                effect.spec().id
            ));
        }
    }
    Ok(())
}

/// What goes wrong at the corners of an effect's bounds.
pub(crate) fn failures_at_corners(effect: &'static dyn Effect<f64>) -> Vec<String> {
    let parameters = effect.spec().parameters;
    let mut bad = Vec::new();
    for corner in 0..1_usize << parameters.len() {
        let values: Vec<f64> =
            parameters.iter().enumerate().map(|(i, p)| sane(p)[usize::from(corner >> i & 1 == 1)]).collect();
        for presence in presences(effect.spec().scopes) {
            bad.extend(stays_finite(effect, &values, presence).err());
        }
    }
    bad
}

#[test]
fn runs_stay_finite_at_every_corner_of_the_bounds() {
    let bad: Vec<String> = effects::catalogue::<f64>().into_iter().flat_map(failures_at_corners).collect();
    assert!(bad.is_empty(), "{}", bad.join("\n"));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]


    #[test]
    fn runs_stay_finite_inside_the_bounds(
        index in 0..effects::COUNT,
        place in prop::array::uniform4(0.0..1.0_f64),
        wear in 0_usize..5,
    ) {
        let effect = effects::catalogue::<f64>()[index];
        let values: Vec<f64> = effect.spec().parameters.iter().zip(place).map(|(p, x)| {
            let [low, high] = sane(p);
            low + x * (high - low)
        }).collect();
        let presences = presences(effect.spec().scopes);
        let outcome = stays_finite(effect, &values, presences[wear % presences.len()]);
        prop_assert!(outcome.is_ok(), "{outcome:?}");
    }
}
