//! Slopes under the robot, by its turning rates and loads.

use crate::attitude::Attitude;
use crate::pieces::{GRADE, pieces};
use crate::run::SpeedRun;
use crate::settings::{CHANGES, changes::Slopes as Settings};
use inference::robust::NINETY;
use verdict::LoadChange;

const SLOPES: Settings = CHANGES.slopes;

/// Slopes, and stretches at which the load asks for one and the turning rates saw no ramp.
#[derive(Debug, Default)]
pub(super) struct Slopes {
    pub(super) found: Vec<LoadChange>,
    pub(super) not_seen: Vec<[f64; 2]>,
}

/// Whether the turning rates saw the nose rise where a slope begins, or fall where it ends, by a fair share of it.
fn is_ramp(run: &SpeedRun, attitude: &Attitude, [from, until]: [f64; 2], pitch: f64) -> bool {
    let mean = |a: f64, b: f64| {
        let inside = (0..run.time.len()).filter(|&i| a <= run.time[i] && run.time[i] <= b);
        inference::robust::mean(inside.map(|i| attitude.by_rates[i]))
    };
    let [near, far] = SLOPES.ramp;
    let rises = mean(from + near, from + far).zip(mean(from - far, from - near)).map(|(on, before)| on - before);
    let falls = mean(until - far, until - near).zip(mean(until + near, until + far)).map(|(on, after)| on - after);
    let seen = |step: Option<f64>| step.is_some_and(|step| step * pitch.signum() > SLOPES.ramp_share * pitch.abs());
    seen(rises) || seen(falls)
}

/// Slopes that the gyro and the load show together.
pub(super) fn slopes(run: &SpeedRun, attitude: &Attitude) -> Slopes {
    let drives = |i: usize| run.forward(i).abs() > CHANGES.pieces.driving;
    let certain = |i: usize| {
        drives(i)
            && attitude.pitch[i].abs() > SLOPES.least.to_radians()
            && attitude.pitch[i].abs() > NINETY * attitude.sigma[i]
    };

    // What is certain somewhere goes on to where it is no slope.
    let mut steep: Vec<bool> = (0..run.time.len()).map(certain).collect();
    let goes_on = |i: usize, k: usize| {
        let (here, there) = (attitude.pitch[i], attitude.pitch[k]);
        drives(i) && here * there > 0.0 && here.abs() > SLOPES.least.to_radians()
    };
    for i in 1..steep.len() {
        steep[i] = steep[i] || (steep[i - 1] && goes_on(i, i - 1));
    }
    for i in (1..steep.len()).rev() {
        steep[i - 1] = steep[i - 1] || (steep[i] && goes_on(i - 1, i));
    }

    let mut out = Slopes::default();
    let along = |i: usize| attitude.pitch[i] * run.forward(i).signum();
    let period = run.period();
    let levelled = run.body_rates.as_ref().is_some_and(|rates| rates.level.is_some());
    let by = if levelled {
        "gyro and accelerometer measure the tilt"
    } else if attitude.relative {
        "the gyro measures the tilt; ground that gives way tilts the body too, which an accelerometer would tell"
    } else {
        "the gyro measures the tilt"
    };
    for piece in pieces(&run.time, (0..run.time.len()).filter(|&i| steep[i]), SLOPES.gap) {
        for piece in piece.chunk_by(|&a, &b| along(a) * along(b) > 0.0) {
            let (first, last) = (piece[0], piece[piece.len() - 1]);
            let [from, until] = [run.time[first], run.time[last]];
            if until - from < SLOPES.least_seconds {
                continue;
            }
            let n = piece.len() as f64;
            let mean = piece.iter().map(|&i| along(i)).sum::<f64>() / n;
            let sigma = piece.iter().map(|&i| attitude.sigma[i]).sum::<f64>() / n;
            if mean.abs() < NINETY * sigma {
                continue;
            }
            let pitch = piece.iter().map(|&i| attitude.pitch[i]).sum::<f64>() / n;
            if !levelled && !is_ramp(run, attitude, [from, until], pitch) {
                out.not_seen.push([from, until]);
                continue;
            }
            out.found.push(LoadChange {
                recording: run.name.clone(),
                interval: [from, until],
                onset: [from - SLOPES.clock, from + SLOPES.clock],
                end: [until - SLOPES.clock, until + SLOPES.clock],
                seconds: n * period,
                ratio: None,
                slope: mean.to_degrees(),
                slope_half: (NINETY * sigma).to_degrees(),
                bound: false,
                relative: attitude.relative,
                causes: vec![GRADE],
                reason: by.into(),
            });
        }
    }
    out
}
