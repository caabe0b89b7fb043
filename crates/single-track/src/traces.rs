//! Drives beside their simulations, as pages and pictures draw them.

use hierarchical_fit::{Beside, Solved};
use verdict::Trace;

use crate::drive::Drive;
use crate::model::{Laws, STEP};
use crate::rows::Shown;
use crate::settings::{SETTINGS, Traces};
use odometry::rates::end;

const RULES: Traces = SETTINGS.traces;

/// A drive beside the motion from throttle and steering alone, as [`Solved::simulated`]; `None` of a drive without a pose.
pub(crate) fn trace<'a>(
    solved: &'a Solved<Shown<'_>>,
    shown: &Shown<'_>,
    corrected: impl Fn(f64) -> &'a [f64],
    left_out: bool,
) -> Option<Trace> {
    let pose = &shown.drive.pose;
    let starts = starts(pose);
    if starts.is_empty() {
        return None;
    }
    let longest = (RULES.free / STEP).round() as usize;
    let simulated = solved.simulated(&corrected, |theta| {
        let laws = |start: usize| Laws::at(&solved.data.model, theta(STEP * start as f64));
        free_runs(laws, shown.drive, &starts, longest)
    });
    let time = (0..pose.len()).map(|k| STEP * k as f64).collect();
    Some(Beside { recording: &shown.drive.name, left_out, time, measured: pose, starts, simulated }.trace())
}

/// Steps at which the car's velocity is known from its past, so far apart as the simulations run free.
fn starts(pose: &[[f64; 3]]) -> Vec<usize> {
    let apart = (RULES.free / STEP).round() as usize;
    let mut out: Vec<usize> = Vec::new();
    for step in 0..pose.len() {
        if out.last().is_none_or(|last| step - last >= apart) && end(pose, step, RULES.past, STEP).is_some() {
            out.push(step);
        }
    }
    out
}

/// The tracked pose of a drive from throttle and steering alone, at each step. It begins at the first step of each stretch in
/// which a velocity is known from poses, and anew at the last one where steps without a pose follow; at rest at the origin without
/// any pose. The pose before is as it was seen.
pub(crate) fn predicted(laws: &Laws, drive: &Drive) -> Vec<[f64; 3]> {
    let pose = &drive.pose;
    let known = |step: usize| end(pose, step, RULES.past, STEP).is_some();
    let is_end = |k: usize| k == 0 || !known(k - 1) || (k + 1 < pose.len() && !known(k + 1));
    let mut starts: Vec<usize> = (0..pose.len()).filter(|&k| known(k) && is_end(k)).collect();
    if starts.is_empty() {
        starts.push(0);
    }
    let mut out = free_runs(|_| *laws, drive, &starts, drive.steps());
    for (to, seen) in out.iter_mut().zip(pose).take(starts[0]) {
        *to = *seen;
    }
    out
}

/// The tracked pose at each step, from start to start and so many steps at most; at rest where no velocity is known.
fn free_runs(laws: impl Fn(usize) -> Laws, drive: &Drive, starts: &[usize], longest: usize) -> Vec<[f64; 3]> {
    let steps = drive.pose.len().max(drive.steps());
    let mut out = vec![[f64::NAN; 3]; steps];
    for (k, &start) in starts.iter().enumerate() {
        let next = starts.get(k + 1).copied().unwrap_or(steps);
        let last = next.min(start + longest);
        let (at, rates) = end(&drive.pose, start, RULES.past, STEP).unwrap_or_default();
        let laws = laws(start);
        let inputs = laws.inputs(drive);
        out[start] = at;
        // A state stands at the end of its step.
        for (after, state) in laws.run(laws.state(at, rates), &inputs, start, last - start - 1).iter().enumerate() {
            out[start + 1 + after] = laws.tracked(state);
        }
    }
    out
}
