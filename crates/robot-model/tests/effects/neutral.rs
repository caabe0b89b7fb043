//! At its neutral value an effect changes nothing, bit for bit.

use robot_model::{Active, Effect, Plant, Presence, Robot, Role, Scalar, effects, real};

use crate::battery::{ANY, H, at_rest, presences};
use crate::common::{BOTH, Causality, on_casters, robot, run};

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

/// Panics where an effect at its neutral value changes a drive.
pub(crate) fn changes_nothing<T: Scalar>(effect: &'static dyn Effect<T>) {
    let robots = [robot(), on_casters()].map(|robot| robot.cast::<T>());
    for (robot, causality) in robots.iter().flat_map(|robot| BOTH.map(|causality| (robot, causality))) {
        let nominal = history(robot, &[], causality);
        let spec = effect.spec();
        let mut neutral: Vec<T> = spec.parameters.iter().map(|p| real(p.neutral)).collect();
        for presence in presences::<T>(ANY) {
            let same = history(robot, &[Active::new(effect, &neutral, presence)], causality) == nominal;
            assert!(same, "{} at its neutral value changes a {causality:?}-driven run ({presence:?})", spec.id);
        }
        // The neutral value of the strengths is enough: shapes may be anything.
        for (v, p) in neutral.iter_mut().zip(spec.parameters).filter(|(_, p)| p.role == Role::Shape) {
            *v = real(p.bounds[0]);
        }
        assert!(history(robot, &[Active::new(effect, &neutral, Presence::default())], causality) == nominal);
    }
}

#[test]
fn neutral_effects_leave_a_drive_bit_identical() {
    effects::catalogue::<f64>().into_iter().for_each(changes_nothing);
}

#[test]
fn neutral_effects_leave_a_drive_bit_identical_in_f32() {
    effects::catalogue::<f32>().into_iter().for_each(changes_nothing);
}

#[test]
fn all_neutral_effects_together_leave_a_drive_bit_identical() {
    let all = effects::catalogue::<f64>().map(|e| Active::new(e, &[], Presence::default()));
    for (robot, causality) in [robot(), on_casters()].iter().flat_map(|robot| BOTH.map(|how| (robot, how))) {
        assert!(history(robot, &all, causality) == history(robot, &[], causality));
    }
}
