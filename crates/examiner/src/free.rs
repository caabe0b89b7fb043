//! Free runs: from measured states at the restart rows, on logged torques, without looking.

use crate::hidden::Hidden;
use crate::integrate::{STEP, Stepper};
use crate::motor::Motors;
use crate::plant::{ANGLE, MEMORY, Plant, SPEED, YAW_RATE};
use crate::random::Stream;
use crate::robot::Constants;
use crate::run::{Motion, Run, shown_rate};
use crate::sensors::Sheet;

/// Rows from one restart to the next.
pub(crate) const SEGMENT: usize = 200;

/// Measured states at the restart rows of a run.
pub(crate) fn restarts(run: &Run, sheet: &Sheet, mut noise: Stream) -> Vec<Motion> {
    let k = sheet.gyro / 0.006;
    run.seen
        .iter()
        .step_by(SEGMENT)
        .enumerate()
        .map(|(i, seen)| {
            let mut s = *seen;
            // A run starts at rest, and is known to.
            if i > 0 {
                let sigma = [0.001, 0.001, 0.001, 0.003, 0.003, 0.002];
                for (x, sigma) in s.body.iter_mut().zip(sigma) {
                    *x += noise.normal(k * sigma);
                }
                s.speed = s.speed.map(|w| w + noise.normal(0.015));
            }
            s
        })
        .collect()
}

/// Wheel speeds and shown yaw rate of a model at each row, restarted at each segment.
pub(crate) fn predict(c: &Constants, hidden: &Hidden, run: &Run, starts: &[Motion], row: f64) -> Vec<[f64; 3]> {
    // Twice the step of the drives: free runs need no sensors and the method is of fourth order.
    let step = if hidden.foreign.explicit_step > 0.0 { STEP } else { 2.0 * STEP };
    let plant = Plant::new(c, hidden);
    let mut motors = Motors::new(c, hidden, row, step);
    let commands: Vec<[f64; 2]> = run.rows.iter().map(|r| r.torque).collect();
    let steps = (row / step).round() as usize;
    let mut stepper = Stepper::new(hidden, step);
    let mut state = plant.settled([0.0; 6], [0.0; 2], [0.0; 2]);
    let mut out = Vec::with_capacity(commands.len());
    for k in 0..commands.len() {
        if k % SEGMENT == 0 {
            let s = &starts[k / SEGMENT];
            // What has warmed up, or is wound up, does not forget where a free run begins anew.
            let memory = [state[MEMORY], state[MEMORY + 1]];
            state = plant.settled(s.body, s.speed, s.angle);
            state[MEMORY..].copy_from_slice(&memory);
        }
        let rate = shown_rate(hidden, state[YAW_RATE]);
        out.push([state[SPEED + 1], state[SPEED + 3], rate]);
        for j in 0..steps {
            let now = k as f64 * row + j as f64 * step;
            let torque = motors.step(now, &commands, &run.events);
            let moment = plant.moment(now, torque, &state, &run.events);
            stepper.step(&plant, &mut state, &moment);
        }
    }
    debug_assert!(state[ANGLE].is_finite());
    out
}

/// True wheel speeds and shown yaw rate of a run.
pub(crate) fn shown(run: &Run, hidden: &Hidden) -> Vec<[f64; 3]> {
    run.seen.iter().map(|s| [s.speed[0], s.speed[1], shown_rate(hidden, s.body[5])]).collect()
}

/// Root mean squares of wheel speeds and yaw rate, restart rows left out.
pub(crate) fn rms(values: impl Iterator<Item = [f64; 3]>) -> [f64; 2] {
    let (mut wheel, mut yaw, mut n) = (0.0, 0.0, 0.0_f64);
    for (k, v) in values.enumerate() {
        if k % SEGMENT != 0 {
            wheel += v[0] * v[0] + v[1] * v[1];
            yaw += v[2] * v[2];
            n += 1.0;
        }
    }
    let n = n.max(1.0);
    [(wheel / (2.0 * n)).sqrt(), (yaw / n).sqrt()]
}

/// Root mean square errors of predicted wheel speeds and of the yaw rate that the gyro shows, restart rows left out.
/// A row holds the wheel speeds of both sides and the yaw rate; both tables have the same rows.
pub fn error(truth: &[[f64; 3]], predicted: &[[f64; 3]]) -> [f64; 2] {
    let pairs = truth.iter().zip(predicted);
    rms(pairs.map(|(a, b)| [a[0] - b[0], a[1] - b[1], a[2] - b[2]]))
}
