//! The response of a free run to an input at any place in any window, and columns of laws by superposition.
//!
//! `∂y/∂u_j` of every input `u` in every window `j` of the segments by one pulse each, in all segments at once; the column of
//! a law is `Σ_j u_j ∂y/∂u_j` with its input in each window, so that a candidate costs a product of matrices and no free run.

use std::sync::Arc;

use law::Input;
use rayon::prelude::*;

use super::acting::{Acting, Inputs};
use crate::channel::{Channel, Channels};
use crate::fit::{Fitted, Lane, Problem, difference};
use crate::settings::law::SETTINGS;
use crate::simulate::Response;

/// Responses to a unit of each input in each window of the segments.
pub(crate) struct Operator {
    /// By input, then by window of a segment.
    pulses: Vec<(Input, Vec<Response>)>,
    /// First window of each segment in its recording.
    first: Vec<Vec<usize>>,
}

/// What is usual at an input, in its unit.
pub(crate) fn usual(problem: &Problem<'_>, input: Input) -> f64 {
    let (robot, prior) = (problem.robot, SETTINGS.priors);
    let force = prior.force * robot.mass * robot.gravity;
    match input {
        Input::Torque(_) => prior.torque * force * robot.wheel_radius,
        Input::Force(_) => force,
        Input::Moment => prior.moment * force * robot.half_track,
        Input::Grip(_) | Input::LateralGrip => prior.grip,
        Input::Radius(_) => prior.radius * robot.wheel_radius,
        Input::Slope(_) => prior.force,
    }
}

impl Operator {
    /// Of all inputs, at a point without any effect.
    pub(crate) fn new(problem: &Problem<'_>, base: &Fitted) -> Self {
        Self::of(problem, base, &Input::ALL)
    }

    /// Of some inputs.
    pub(crate) fn of(problem: &Problem<'_>, base: &Fitted, inputs: &[Input]) -> Self {
        let per_window = |c: &crate::windows::Cut| c.segments.iter().map(|s| s.row / c.rows_per_window).collect();
        let first: Vec<Vec<usize>> = problem.cuts.iter().map(per_window).collect();
        let longest = problem.cuts.iter().flat_map(|c| &c.segments).map(|s| s.windows).max().unwrap_or(0);
        let none = |_: usize| Vec::new();
        let pulses = |&input: &Input| {
            let size = SETTINGS.operator.pulse * usual(problem, input);
            let lanes: Vec<Lane<'_>> = (0..longest)
                .map(|j| {
                    let inputs = Arc::new(vec![(input, pulses(problem, &first, j))]);
                    let acting = Some(Acting::Given { inputs, times: size, unit: size });
                    Lane { point: base.point.clone(), doses: &none, part: None, acting }
                })
                .collect();
            let out = problem.lanes(&lanes);
            (input, out.iter().map(|y| difference(y, &base.response, 1.0 / size)).collect())
        };
        Self { pulses: inputs.iter().map(pulses).collect(), first }
    }

    /// Responses to a unit of an input in each window of the segments.
    pub(crate) fn pulses(&self, input: Input) -> Option<&[Response]> {
        self.pulses.iter().find(|(of, _)| *of == input).map(|(_, pulses)| pulses.as_slice())
    }

    /// First window of a segment in its recording.
    pub(crate) fn first(&self, run: usize, segment: usize) -> usize {
        self.first[run][segment]
    }

    /// The column of inputs given window by window.
    pub(crate) fn column(&self, inputs: &Inputs) -> Response {
        let segments = |r: usize| (0..self.first[r].len()).map(|s| self.segment(inputs, r, s)).collect();
        (0..self.first.len()).map(segments).collect()
    }

    /// What these inputs do in a segment.
    pub(crate) fn segment(&self, inputs: &Inputs, r: usize, s: usize) -> Vec<Channels<f64>> {
        let windows = self.pulses.first().and_then(|(_, all)| all.first()).map_or(0, |y| y[r][s].len());
        let mut y = vec![Channels::all(0.0); windows];
        for (input, runs) in inputs {
            let Some(pulses) = self.pulses(*input) else { continue };
            for (j, pulse) in pulses.iter().enumerate().take(windows) {
                let u = runs[r].get(self.first[r][s] + j).copied().unwrap_or_default();
                // Nothing shows before its window.
                for (y, p) in y.iter_mut().zip(&pulse[r][s]).skip(j).filter(|_| u != 0.0) {
                    for c in Channel::ALL {
                        y[c] += u * p[c];
                    }
                }
            }
        }
        y
    }

    /// Columns of many.
    pub(crate) fn columns(&self, all: &[Inputs]) -> Vec<Response> {
        all.par_iter().map(|inputs| self.column(inputs)).collect()
    }
}

/// One in window `j` of every segment, zero elsewhere.
fn pulses(problem: &Problem<'_>, first: &[Vec<usize>], j: usize) -> Vec<Vec<f64>> {
    let of_run = |(cut, first): (&crate::windows::Cut, &Vec<usize>)| {
        let windows = cut.segments.last().map_or(0, |s| s.row / cut.rows_per_window + s.windows);
        let mut out = vec![0.0; windows];
        for (segment, &f) in cut.segments.iter().zip(first) {
            if j < segment.windows {
                out[f + j] = 1.0;
            }
        }
        out
    };
    problem.cuts.iter().zip(first).map(of_run).collect()
}
