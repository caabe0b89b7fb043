//! An identification as JSON.

use case_files::envelope::Program;
use serde_json::{Value, json};

use super::Identification;
use super::follow::{COMPARISONS, Errors, Indices};
use crate::commands::sources;

/// Version of this structure.
const FORMAT: u32 = 1;

/// Everything.
pub(super) fn render(done: &Identification, lost: &[String]) -> Value {
    let (f, s) = (&done.followed, &done.samples);
    let side = |i: usize| {
        let side = &f.sides[i];
        let bounds: Vec<Value> = COMPARISONS
            .iter()
            .zip(&side.bounds)
            .map(|(what, b)| {
                json!({
                    "comparison_weights": what, "error_energy": b.error_energy, "bound": b.limit, "holds": b.holds,
                    "worst_residual": b.residual, "steps_in_which_l_rose": b.rises,
                })
            })
            .collect();
        json!({
            "wheel_speed_error_rad_s": errors(&side.errors),
            "constant_regressor_error_rad_s": errors(&f.baseline[i]),
            "wheel_angle_error_rad": f.angles.as_ref().map(|a| errors(&a[i])),
            "certificates": bounds,
            "last_weights_rad_s2": side.weights,
        })
    };
    json!({
        "format": FORMAT,
        "program": Program::default(),
        "robot": { "name": done.robot, "causality": done.causality },
        "recording": done.recording,
        "sources": sources(&done.sources),
        "lost": lost,
        "state": s.state,
        "input": s.input,
        "samples": {
            "count": s.len(), "period_s": s.period, "resampled": s.resampled.is_some(), "gaps": s.gaps(),
            "dropped": s.dropped, "duration_s": f.duration,
        },
        "identifier": {
            "pole_1_s": f.pole, "gain": f.gain, "units": sim::UNITS, "seed": done.seed,
            "speed_scale_rad_s": f.speed_scale, "torque_scale_n_m": f.torque_scale,
        },
        "worst_residual": f.residual(),
        "bound_holds": f.holds(),
        "left": side(0),
        "right": side(1),
    })
}

fn errors(e: &Errors) -> Value {
    let one = |i: &Indices| i.rmse().map(|rmse| json!({ "max": i.max, "max_at_s": i.max_at, "rmse": rmse }));
    json!({ "all": one(&e.all), "after_first_second": one(&e.settled) })
}
