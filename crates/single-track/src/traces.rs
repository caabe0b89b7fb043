//! Drives beside their simulations, as pages and pictures draw them.

use odometry::traces::Beside;
use verdict::Trace;

use crate::model::{Laws, STEP};
use crate::rates::end;
use crate::rows::Shown;
use crate::settings::{SETTINGS, Traces};
use crate::solve::Solved;

const RULES: Traces = SETTINGS.traces;

impl Solved<'_> {
    /// A drive beside the motion from throttle and steering alone, as stated or as the references have it, re-tuned, and with
    /// the named causes, the last only where there are some; `None` of a drive without a pose.
    pub(crate) fn trace(&self, shown: &Shown<'_>, left_out: bool) -> Option<Trace> {
        let pose = &shown.drive.pose;
        let starts = starts(pose);
        if starts.is_empty() {
            return None;
        }
        let of = |theta: &[f64]| free_runs(&Laws::at(&self.data.constants, theta), shown, &starts);
        let named = &self.named;
        let corrected = if named.chosen.is_empty() { Vec::new() } else { of(named.posterior.mean.as_slice()) };
        let simulated = [of(self.prior.mean.as_slice()), of(named.retuned.mean.as_slice()), corrected];
        let time = (0..pose.len()).map(|k| STEP * k as f64).collect();
        Some(Beside { recording: &shown.drive.name, left_out, time, measured: pose, starts, simulated }.trace())
    }
}

/// Steps at which the car's velocity is known from its past, so far apart as the simulations run free.
fn starts(pose: &[[f64; 3]]) -> Vec<usize> {
    let apart = (RULES.free / STEP).round() as usize;
    let mut out: Vec<usize> = Vec::new();
    for step in 0..pose.len() {
        if out.last().is_none_or(|last| step - last >= apart) && end(pose, step, RULES.past).is_some() {
            out.push(step);
        }
    }
    out
}

/// The tracked pose at each step, from start to start.
fn free_runs(laws: &Laws, shown: &Shown<'_>, starts: &[usize]) -> Vec<[f64; 3]> {
    let pose = &shown.drive.pose;
    let inputs = laws.inputs(shown.drive);
    let mut out = vec![[f64::NAN; 3]; pose.len()];
    for (k, &start) in starts.iter().enumerate() {
        let next = starts.get(k + 1).copied().unwrap_or(pose.len());
        let last = next.min(start + (RULES.free / STEP).round() as usize);
        let Some((at, rates)) = end(pose, start, RULES.past) else { continue };
        out[start] = at;
        // A state stands at the end of its step.
        for (after, state) in laws.run(laws.state(at, rates), &inputs, start, last - start - 1).iter().enumerate() {
            out[start + 1 + after] = laws.tracked(state);
        }
    }
    out
}
