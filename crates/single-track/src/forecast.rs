//! Motion from throttle and steering alone on drives that no fit has seen.
//!
//! At the start of a forecast nothing but its past is known: velocities come from a parabola through the poses before it, the
//! servo from the commands before it, and constants from the fit on other drives, moved by what the past of this drive says of
//! its own deviation (battery, floor, trims). What it said fades.

use nalgebra::{DMatrix, DVector};
use odometry::weighing::Session;

use crate::constants::Constant;
use crate::fit::{Scales, equations};
use crate::model::{Inputs, Laws, STEP, State};
use crate::rows::{Shown, end};
use crate::settings::{Forecast, SETTINGS};
use inference::robust::median;

const RULES: Forecast = SETTINGS.forecast;

/// Lengths of forecasts, s.
pub const LENGTHS: [f64; 3] = RULES.lengths;

/// Errors of forecasts of one length: position, m, and heading, rad, one of each beginning.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Errors {
    /// Distance between forecast and measured position, m.
    pub position: Vec<f64>,
    /// Difference of headings, rad, without its sign.
    pub heading: Vec<f64>,
}

impl Errors {
    /// Medians of position, m, and heading, rad; `None` where no drive is long enough.
    pub fn medians(&self) -> Option<[f64; 2]> {
        Some([median(self.position.iter().copied())?, median(self.heading.iter().copied())?])
    }

    /// Adds those of other drives.
    pub fn extend(&mut self, other: Self) {
        self.position.extend(other.position);
        self.heading.extend(other.heading);
    }
}

/// Errors over each of [`LENGTHS`].
pub type ByLength = [Errors; 3];

/// How much the past of a drive is listened to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Habit {
    /// Past over which velocities are taken, s.
    pub(crate) past: f64,
    /// Time after which what the drive said of itself has faded, s; none: it is not listened to.
    pub(crate) fading: Option<f64>,
    /// Factor on the scatter of drives.
    pub(crate) freedom: f64,
}

/// Steps at which forecasts begin.
pub(crate) fn beginnings(shown: &Shown<'_>) -> Vec<usize> {
    let pose = &shown.drive.pose;
    let longest = (LENGTHS[LENGTHS.len() - 1] / STEP).round() as usize;
    let every = (RULES.every / STEP).round() as usize;
    let past = (RULES.past[RULES.past.len() - 1] / STEP).ceil() as usize;
    let seen = |k: usize| pose[k][0].is_finite();
    let moves = |k: usize| {
        let (a, b) = (pose[k], pose[k + longest]);
        (b[0] - a[0]).hypot(b[1] - a[1]) > RULES.way
    };
    let usable = |&k: &usize| {
        (k - past..=k).all(seen) && LENGTHS.iter().all(|l| seen(k + (l / STEP).round() as usize)) && moves(k)
    };
    (past..pose.len().saturating_sub(longest + 1)).step_by(every).filter(usable).collect()
}

/// Errors of one forecast over each length, of a run of states.
pub(crate) fn judge(pose: &[[f64; 3]], from: usize, tracked: impl Fn(usize) -> [f64; 3]) -> [[f64; 2]; 3] {
    LENGTHS.map(|length| {
        let steps = (length / STEP).round() as usize;
        let ([x, y, yaw], truth) = (tracked(steps), pose[from + steps]);
        [(x - truth[0]).hypot(y - truth[1]), (yaw - truth[2]).abs()]
    })
}

/// Errors by length from those of each beginning.
pub(crate) fn collected(each: impl IntoIterator<Item = [[f64; 2]; 3]>) -> ByLength {
    let mut out = ByLength::default();
    for errors in each {
        for (sum, [position, heading]) in out.iter_mut().zip(errors) {
            sum.position.push(position);
            sum.heading.push(heading);
        }
    }
    out
}

/// Forecasts of a law from each beginning, from velocities of so much past.
pub(crate) fn of_laws(shown: &Shown<'_>, laws: &Laws, past: f64) -> Vec<[[f64; 2]; 3]> {
    let inputs = laws.inputs(shown.drive);
    beginnings(shown).into_iter().filter_map(|from| one(shown, laws, &inputs, from, past)).collect()
}

fn one(shown: &Shown<'_>, laws: &Laws, inputs: &Inputs, from: usize, past: f64) -> Option<[[f64; 2]; 3]> {
    let pose = &shown.drive.pose;
    let (at, rates) = end(pose, from, past)?;
    let steps = (LENGTHS[LENGTHS.len() - 1] / STEP).round() as usize;
    let states: Vec<State> = laws.run(laws.state(at, rates), inputs, from, steps);
    Some(judge(pose, from, |k| laws.tracked(&states[k - 1])))
}

/// A twist that does not change.
pub(crate) fn of_twist(shown: &Shown<'_>, past: f64) -> Vec<[[f64; 2]; 3]> {
    let pose = &shown.drive.pose;
    let of = |from: usize| {
        let (at, [vx, vy, rate]) = end(pose, from, past)?;
        Some(judge(pose, from, |k| {
            let turned = rate * STEP * k as f64;
            // Chord and its direction.
            let (along, across) = if turned.abs() < SETTINGS.model.tiny {
                (STEP * k as f64, 0.0)
            } else {
                (turned.sin() / rate, (1.0 - turned.cos()) / rate)
            };
            [at[0] + along * vx - across * vy, at[1] + along * vy + across * vx, at[2] + turned]
        }))
    };
    beginnings(shown).into_iter().filter_map(of).collect()
}

/// What a drive says of itself, row by row, at the constants of a fit.
pub(crate) struct Said<'s, 'a> {
    shown: &'s Shown<'a>,
    errors: Vec<f64>,
    columns: Vec<Vec<f64>>,
}

impl<'s, 'a> Said<'s, 'a> {
    pub(crate) fn new(constants: &[Constant], shown: &'s Shown<'a>, theta: &[f64]) -> Self {
        let errors = shown.errors(&Laws::at(constants, theta));
        Self { shown, errors, columns: shown.columns(constants, theta) }
    }

    /// What the rows known between two instants say.
    fn between(&self, from: f64, until: f64, scales: Scales) -> Session {
        let weight = |row: usize| {
            let time = self.shown.rows[row].time;
            f64::from(u8::from(time > from && time <= until))
        };
        equations(self.shown, (&self.errors, &self.columns), scales, weight)
    }
}

/// Forecasts of fitted constants that follow the drive's own past.
pub(crate) fn following(
    constants: &[Constant],
    scatter: &DVector<f64>,
    said: &Said<'_, '_>,
    (theta, scales): (&[f64], Scales),
    habit: Habit,
) -> Vec<[[f64; 2]; 3]> {
    let Some(fading) = habit.fading else { return of_laws(said.shown, &Laws::at(constants, theta), habit.past) };
    let scatter = scatter * habit.freedom;
    let n = theta.len();
    let mut so_far = Session { curvature: DMatrix::zeros(n, n), slope: DVector::zeros(n), cost: 0.0 };
    let mut last = f64::NEG_INFINITY;
    let warm = (RULES.warm / STEP) as usize;
    let ahead = (LENGTHS[LENGTHS.len() - 1] / STEP).round() as usize;
    let of = |from: usize| {
        let now = STEP * from as f64;
        let kept = ((last - now) / fading).exp();
        let new = said.between(last, now, scales);
        so_far.curvature = &so_far.curvature * kept + new.curvature;
        so_far.slope = &so_far.slope * kept + new.slope;
        last = now;
        let deviation = so_far.deviation(&scatter)?;
        let own = |((t, d), c): ((&f64, &f64), &Constant)| {
            let [least, most] = c.bounds();
            (t + d).clamp(least, most)
        };
        let moved: Vec<f64> = theta.iter().zip(deviation.iter()).zip(constants).map(own).collect();
        let laws = Laws::at(constants, &moved);
        let inputs = laws.inputs_between(said.shown.drive, from.saturating_sub(warm), from + ahead + 1);
        one(said.shown, &laws, &inputs, from, habit.past)
    };
    beginnings(said.shown).into_iter().filter_map(of).collect()
}
