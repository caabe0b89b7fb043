//! What a told law is worth beside a hidden one of another grammar.

use std::collections::BTreeMap;

use examiner::{EffectTruth, LawKind, LawRow};
use law::{Input, Law, Memory, Motion};
use robot_model::Robot;
use serde::Serialize;
use verdict::FoundLaw;

/// A told law beside a hidden one.
#[derive(Debug, Clone, Serialize)]
pub(super) struct ForeignScore {
    /// Rms of told less hidden over rms of hidden, over all rows of all recordings; `None` where no law is told.
    pub(super) curve: Option<f64>,
    /// Whether on recordings left out of the fit the best name errs less than the law, in wheel speed or yaw rate.
    pub(super) is_worse_than_name: bool,
}

/// Whether a truth is one of a law of another grammar.
pub(super) fn is_foreign(e: &EffectTruth) -> bool {
    e.kind.as_deref().is_some_and(|kind| serde_json::from_value::<LawKind>(kind.into()).is_ok())
}

/// Beginnings of names of places where a law acts. Friction of both drives is a force as well.
pub(super) fn places(e: &EffectTruth) -> Vec<String> {
    let owned = |all: &[&str]| all.iter().map(|s| (*s).to_owned()).collect();
    match (e.kind.as_deref(), e.side.as_deref()) {
        (_, Some(side)) => vec![format!("torque on the {side} side")],
        (Some("turn_drag" | "logarithmic_drag" | "heading_drag"), _) => {
            owned(&["fore-aft force", "force on the body", "torque on both sides"])
        }
        (Some("fading_turn_resistance"), _) => owned(&["yaw moment", "lateral grip", "torque on both sides"]),
        (Some("fading_grip"), _) => owned(&["grip of all wheels", "lateral grip"]),
        _ => owned(&["torque on both sides", "fore-aft force", "force on the body"]),
    }
}

/// Scores what was told.
pub(super) fn score(
    told: Option<&FoundLaw>,
    rows: &BTreeMap<String, Vec<LawRow>>,
    robot: &Robot<f64>,
    row: f64,
) -> ForeignScore {
    let curve = told.and_then(|t| t.formula.parse().ok()).map(|law| distance(&law, rows, robot, row));
    let worse = |quantity: &str| {
        let own = || told.into_iter().flat_map(|t| &t.free_runs).filter(|r| r.quantity.starts_with(quantity));
        let sum = |of: fn(&verdict::LawFreeRun) -> f64| own().map(|r| of(r).powi(2)).sum::<f64>();
        sum(|r| r.law) > sum(|r| r.named.unwrap_or(r.retuned))
    };
    ForeignScore { curve, is_worse_than_name: worse("wheel speed") || worse("yaw rate") }
}

/// Rms of the law less what is true, over the rms of that; each input in units of its own rms where something is hidden.
fn distance(law: &Law, rows: &BTreeMap<String, Vec<LawRow>>, robot: &Robot<f64>, row: f64) -> f64 {
    // Sums of squares by input: of the difference, and of what is true.
    let mut sums = [[0.0; 2]; Input::ALL.len()];
    for drive in rows.values() {
        let mut memory = Memory::new(law);
        for (k, at) in drive.iter().enumerate() {
            let motion = motion(at, k as f64 * row, robot);
            let told = law.act(&motion, memory.states());
            memory.step(law, &motion, row);
            for (sum, input) in sums.iter_mut().zip(Input::ALL) {
                let (true_, told) = (acting(at, input), told.get(input));
                sum[0] += (told - true_).powi(2);
                sum[1] += true_.powi(2);
            }
        }
    }
    let hidden: Vec<[f64; 2]> = sums.into_iter().filter(|[_, of_truth]| *of_truth > 0.0).collect();
    let share = |[difference, of_truth]: &[f64; 2]| difference / of_truth;
    (hidden.iter().map(share).sum::<f64>() / hidden.len().max(1) as f64).sqrt()
}

/// What the hidden law does through an input.
pub(super) fn acting(at: &LawRow, input: Input) -> f64 {
    match input {
        Input::Torque(side) => at.acting.torque[side.min(1)],
        Input::Force(axis) => at.acting.force[axis.min(1)],
        Input::Moment => at.acting.moment,
        Input::Grip(_) => at.acting.grip,
        Input::LateralGrip | Input::Radius(_) | Input::Slope(_) => 0.0,
    }
}

/// What a law of ours may depend on at a row.
fn motion(at: &LawRow, time: f64, robot: &Robot<f64>) -> Motion<f64> {
    let [x, y, heading, forward, lateral, yaw_rate] = at.body;
    let slip = |side: usize| {
        let lever = if side == 0 { -robot.half_track } else { robot.half_track };
        at.wheel_speed[side] * robot.wheel_radius - (forward + lever * yaw_rate)
    };
    Motion {
        time,
        position: [x, y],
        heading: [heading.cos(), heading.sin()],
        velocity: [forward, lateral],
        yaw_rate,
        wheel_speed: at.wheel_speed,
        wheel_angle: at.wheel_angle,
        torque: at.torque,
        slip: [slip(0), slip(1)],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use examiner::Acting;

    #[test]
    fn the_distance_of_a_law_is_the_share_of_the_hidden_one_that_it_misses() {
        let robot = Robot::from(&robot_model::paper::Parameters::SET_B);
        let row = |k: i32| {
            let forward = 0.1 * f64::from(k) - 1.0;
            let acting = Acting { force: [-2.0 * forward, 0.0], ..Acting::default() };
            LawRow { body: [0.0, 0.0, 0.0, forward, 0.0, 0.0], acting, ..LawRow::default() }
        };
        let rows = [("run_1".to_owned(), (0..20).map(row).collect())].into();
        let of = |formula: &str| distance(&formula.parse().expect("a law"), &rows, &robot, 0.01);
        for (coefficient, missed) in [(-2.0, 0.0), (-1.0, 0.5), (2.0, 2.0)] {
            let formula = format!("F_x = {coefficient} [N s/m] * pow(v, 1)");
            assert!((of(&formula) - missed).abs() < 1e-12, "{formula}: {}", of(&formula));
        }
    }
}
