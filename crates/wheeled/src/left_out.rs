//! Drives left out in turn, and forecast from torques and steering alone.

use hierarchical_fit::telling::free_runs;
use hierarchical_fit::{Ahead, Beside, Solved};
use inference::robust::median;
use odometry::rates::end;
use rayon::prelude::*;
use verdict::{FreeRun, Trace};

use crate::drive::{Drive, STEP};
use crate::model::Model;
use crate::robot::AnyWheels;
use crate::rows::{Constants, Shown};
use crate::settings::{Forecast, SETTINGS};

const RULES: Forecast = SETTINGS.forecast;

/// Lengths of forecasts, s.
pub const LENGTHS: [f64; 3] = RULES.lengths;
/// Names of the models: the first four are this crate's.
const MODELS: [&str; 5] = ["as stated", "re-tuned", "corrected", "placebo", "constant twist"];

/// Errors of forecasts of left-out drives, by model.
#[derive(Debug, Clone, Default)]
pub struct Table {
    /// Name of a model, and medians of position, m, and heading, rad, over each of [`LENGTHS`], of all drives.
    pub rows: Vec<(String, Medians)>,
    /// By drive: its name, and the same of each model.
    pub by_drive: Vec<(String, Vec<Medians>)>,
    /// Labels of the causes that each fold named.
    pub named: Vec<Vec<String>>,
    /// The drives beside the simulations that were fitted without them.
    pub traces: Vec<Trace>,
}

impl Table {
    /// The same as rows of a verdict.
    pub(crate) fn free_runs(&self) -> Vec<FreeRun> {
        let of_drive = |(drive, medians): &(String, Vec<Medians>)| {
            let of = |row: usize, k: usize| medians.get(row).and_then(|m| m[k]).map(|m| m.map(Some));
            free_runs(drive, "torques alone", LENGTHS, of)
        };
        self.by_drive.iter().flat_map(of_drive).collect()
    }
}

/// Medians of position, m, and heading, rad, over each of [`LENGTHS`]; `None` where no drive is long enough.
pub type Medians = [Option<[f64; 2]>; 3];

/// Errors of forecasts over each length, one of each beginning.
pub(crate) type Errors = Vec<[[f64; 2]; 3]>;

pub(crate) fn medians(errors: &[[[f64; 2]; 3]]) -> Medians {
    [0, 1, 2].map(|k| {
        let of = |axis: usize| median(errors.iter().map(|e| e[k][axis]));
        Some([of(0)?, of(1)?])
    })
}

/// Leaves out each drive with a pose in turn, fits and names anew without it, and forecasts it.
pub(crate) fn left_out_of(all: &Solved<Shown<'_>>, progress: &dyn Fn(&str)) -> Table {
    let left: Vec<usize> = (0..all.data.drives.len()).filter(|&k| all.data.drives[k].drive.has_pose()).collect();
    let mut out = Table::default();
    if left.len() < 2 {
        return out;
    }
    progress("forecasting drives that were left out");
    let fold = |&k: &usize| {
        let own = &all.data.drives[k];
        let solved = all.without(k)?;
        let named = &solved.named;
        let corrected = solved.corrected_of_left_out_beside(k, all);
        let theta = [
            Some(solved.prior.mean.as_slice()),
            Some(named.retuned.mean.as_slice()),
            Some(corrected.as_slice()),
            named.placebo.as_ref().map(|(_, p)| p.mean.as_slice()),
        ];
        let of = |theta: Option<&[f64]>| theta.map_or_else(Vec::new, |t| forecasts(&solved.data.model, t, own.drive));
        let mut errors: Vec<Errors> = theta.into_iter().map(of).collect();
        errors.push(twist(own.drive));
        let labels = named.chosen.iter().map(|w| solved.causes[w.cause].label()).collect::<Vec<_>>();
        Some((own.drive.name.clone(), errors, labels, trace(&solved, own, |_| &corrected, true)))
    };
    let folds: Vec<_> = left.par_iter().filter_map(fold).collect();
    let mut sums: Vec<Errors> = vec![Vec::new(); MODELS.len()];
    for (name, errors, labels, trace) in folds {
        out.by_drive.push((name, errors.iter().map(|e| medians(e)).collect()));
        sums.iter_mut().zip(errors).for_each(|(sum, e)| sum.extend(e));
        out.named.push(labels);
        out.traces.extend(trace);
    }
    out.rows = MODELS.iter().zip(&sums).map(|(name, e)| ((*name).to_owned(), medians(e))).collect();
    out
}

/// Which forecasts are made.
const AHEAD: Ahead =
    Ahead { step: STEP, lengths: LENGTHS, every: RULES.every, past: RULES.past, way: RULES.way, turn: RULES.turn };

pub(crate) fn forecasts(model: &Constants, theta: &[f64], drive: &Drive) -> Errors {
    let at = Model::at(&model.robot, &model.all, theta);
    let steps = AHEAD.longest();
    let of = |from: usize| {
        let begun = end(&drive.pose, from, RULES.past, STEP)?;
        let run = run((&at, &model.robot), drive, (from, steps), begun);
        Some(AHEAD.judge(&drive.pose, from, |k| run[k - 1]))
    };
    AHEAD.beginnings(&drive.pose).into_iter().filter_map(of).collect()
}

/// Tracked poses after each step from a measured one with its rates.
fn run(
    (at, robot): (&Model<f64>, &AnyWheels),
    drive: &Drive,
    (from, steps): (usize, usize),
    (pose, rates): ([f64; 3], [f64; 3]),
) -> Vec<[f64; 3]> {
    let mut out = Vec::with_capacity(steps);
    at.run(at.of_pose(drive, robot, from, (pose, rates)), drive, from, steps, |_, s| {
        let [x, y, turned] = at.tracked(s);
        out.push([x, y, pose[2] + turned]);
    });
    out
}

/// A twist that does not change.
fn twist(drive: &Drive) -> Errors {
    let of = |from: usize| Some(AHEAD.judge_twist(&drive.pose, from, end(&drive.pose, from, RULES.past, STEP)?));
    AHEAD.beginnings(&drive.pose).into_iter().filter_map(of).collect()
}

/// A drive beside the motion from torques and steering alone, as [`Solved::simulated`]; `None` of a drive without a pose.
pub(crate) fn trace<'a>(
    solved: &'a Solved<Shown<'_>>,
    shown: &Shown<'_>,
    corrected: impl Fn(f64) -> &'a [f64],
    left_out: bool,
) -> Option<Trace> {
    let drive = shown.drive;
    let longest = AHEAD.longest();
    let mut starts: Vec<usize> = Vec::new();
    for step in 0..drive.pose.len() {
        let is_next = starts.last().is_none_or(|last| step - last >= longest);
        if is_next && end(&drive.pose, step, RULES.past, STEP).is_some() {
            starts.push(step);
        }
    }
    if starts.is_empty() {
        return None;
    }
    let simulated =
        solved.simulated(&corrected, |theta| runs_anew(&solved.data.model, theta, drive, (&starts, longest)));
    let time = (0..drive.pose.len()).map(|k| STEP * k as f64).collect();
    Some(Beside { recording: &drive.name, left_out, time, measured: &drive.pose, starts, simulated }.trace())
}

/// The tracked pose at each step, from start to start and so many steps at most, by the constants at each start.
fn runs_anew<'a>(
    model: &Constants,
    theta: impl Fn(f64) -> &'a [f64],
    drive: &Drive,
    (starts, longest): (&[usize], usize),
) -> Vec<[f64; 3]> {
    let mut out = vec![[f64::NAN; 3]; drive.steps];
    for (k, &start) in starts.iter().enumerate() {
        let next = starts.get(k + 1).copied().unwrap_or(drive.steps);
        let steps = next.min(start + longest) - start - 1;
        let (pose, rates) = end(&drive.pose, start, RULES.past, STEP).unwrap_or_default();
        let at = Model::at(&model.robot, &model.all, theta(STEP * start as f64));
        out[start] = pose;
        out[start + 1..=start + steps].copy_from_slice(&run((&at, &model.robot), drive, (start, steps), (pose, rates)));
    }
    out
}

/// The tracked pose of a drive at each step from torques and steering alone; as it was seen before a velocity was known.
pub(crate) fn predicted(model: &Constants, theta: &[f64], drive: &Drive) -> Vec<[f64; 3]> {
    let known = |step: usize| end(&drive.pose, step, RULES.past, STEP).is_some();
    let seen = |step: usize| drive.pose.get(step).is_some_and(|p| p[0].is_finite());
    // Anew at the last pose before each stretch in which none was seen.
    let is_start = |k: &usize| known(*k) && !(seen(k + 1) || *k + 1 >= drive.pose.len());
    let first = (0..drive.pose.len()).find(|k| known(*k));
    let mut starts: Vec<usize> = first.into_iter().chain((0..drive.pose.len()).filter(is_start)).collect();
    starts.dedup();
    if starts.is_empty() {
        starts.push(0);
    }
    let mut out = runs_anew(model, |_| theta, drive, (&starts, drive.steps));
    out[..starts[0]].copy_from_slice(&drive.pose[..starts[0]]);
    out
}
