//! From a case to what was found.

use hierarchical_fit::CaseError as WheeledError;
use std::sync::Arc;

use catalogue::odometry::{GYRO_BIAS, GYRO_SCALE};
use hierarchical_fit::{NamedCause, Rehearsable, Said, Solved, Unexplained};
use verdict::{Advice, PredictedPath, Trace};

use hierarchical_fit::of_recordings;
use hierarchical_fit::telling::NO_ADVICE;

use crate::constants::{Has, causes};
use crate::drive::{Drive, STEP};
use crate::left_out::{Table, left_out_of, predicted, trace};
use crate::next_drive;
use crate::robot::AnyWheels;
use crate::rows::{Constants, Shown, data};
use crate::settings::SETTINGS;

/// When something is left that no cause accounts for.
const UNEXPLAINED: Unexplained = Unexplained {
    share: SETTINGS.unexplained.share,
    of_retuned: SETTINGS.unexplained.of_retuned,
    most: SETTINGS.unexplained.most,
    doubted: SETTINGS.unexplained.doubted,
};

/// A robot with its drives.
#[derive(Debug, Clone)]
pub struct Case {
    /// The robot as its owner states it.
    pub robot: AnyWheels,
    /// Drives in which the simulation was right; without any, the robot stands in their place, as sure as it states.
    pub references: Vec<Drive>,
    /// Drives in which it was not.
    pub recordings: Vec<Drive>,
}

/// What the drives of a case say.
#[derive(Debug, Clone)]
pub struct Findings {
    /// What they say whatever the model is.
    pub said: Said,
    /// Drives, those with a pose, windows.
    pub counts: [usize; 3],
    /// What was done to the recordings, for people.
    pub told: Vec<String>,
    /// The recordings with a pose beside the simulations that were fitted to them.
    pub traces: Vec<Trace>,
    /// Advice on the next drive, where it was asked for.
    pub next: Option<Advice>,
    /// The robot with its constants re-tuned, and with the named causes.
    model: Constants,
    thetas: [Vec<f64>; 2],
}

impl Findings {
    /// The pose of a drive from torques and steering alone, on the grid of the model; from the first pose that was seen with its
    /// velocity, else from rest at the origin.
    pub fn predict(&self, drive: &Drive) -> PredictedPath {
        let [retuned, corrected] = [0, 1].map(|k| predicted(&self.model, &self.thetas[k], drive));
        let time = (0..corrected.len()).map(|k| drive.start + STEP * k as f64).collect();
        PredictedPath { name: drive.name.clone(), time, corrected, retuned }
    }
}

/// Compares a robot's drives with what the torques of its motors imply, and names what would make them agree.
///
/// # Errors
/// When there are too few drives.
pub fn diagnose(case: &Case, progress: &dyn Fn(&str)) -> Result<Findings, WheeledError> {
    Ok(findings(case, &solved(case, progress)?))
}

/// The same with the forecasts of drives that are left out in turn, from one fit, and with advice on a next drive of so many
/// seconds.
///
/// # Errors
/// As [`diagnose`].
pub fn examine(case: &Case, next: Option<f64>, progress: &dyn Fn(&str)) -> Result<(Findings, Table), WheeledError> {
    let solved = solved(case, progress)?;
    let (mut findings, table) = (findings(case, &solved), left_out_of(&solved, progress));
    let is_of_body = |cause: &NamedCause| ![GYRO_SCALE.id, GYRO_BIAS.id].contains(&cause.spec.id);
    if findings.said.judge(&table.free_runs(), UNEXPLAINED, |_| true, is_of_body) {
        let [retuned, corrected] = &mut findings.thetas;
        corrected.clone_from(retuned);
    }
    // A drive is chosen for causes that are always there.
    if next.is_some() && solved.onset.is_some() {
        findings.told.push(NO_ADVICE.to_owned());
    }
    findings.next = next.filter(|_| solved.onset.is_none()).map(|length| {
        progress("looking for the drive that tells the rivals apart");
        next_drive::advise(&solved, length)
    });
    Ok((findings, table))
}

/// What the drives of a case could say, whatever they say.
///
/// # Errors
/// As [`diagnose`].
pub fn rehearsable(case: &Case, progress: &dyn Fn(&str)) -> Result<Rehearsable, WheeledError> {
    let solved = solved(case, progress)?;
    Ok(solved.rehearsable(&solved.data.model.all, case.references.len(), next_drive::read))
}

/// Drives of a case with the constants fitted to them, and what was named.
fn solved<'a>(case: &'a Case, progress: &dyn Fn(&str)) -> Result<Solved<Shown<'a>>, WheeledError> {
    if case.recordings.is_empty() {
        return Err(WheeledError::Empty);
    }
    progress("fitting the robot to its drives");
    let robot = Arc::new(case.robot.clone());
    let any = |of: fn(&Drive) -> bool| case.references.iter().chain(&case.recordings).any(of);
    let has = Has { pose: any(Drive::has_pose), gyro: any(|d| d.gyro.is_some()) };
    let of = |drives: &'a [Drive]| data(&robot, has, &drives.iter().collect::<Vec<_>>());
    let right = if case.references.is_empty() { None } else { Some(of(&case.references)?) };
    let data = of(&case.recordings)?;
    let causes = causes(&data.model.all, right.is_some());
    let short = WheeledError::Short { windows: 0, length: SETTINGS.windows.length, needed: SETTINGS.windows.least };
    let solved = hierarchical_fit::solve(data, right.as_ref(), causes).ok_or(short);
    progress("naming what would make them agree");
    solved
}

fn findings(case: &Case, solved: &Solved<Shown<'_>>) -> Findings {
    let Solved { data, named, .. } = solved;
    let mut said = solved.said(&data.model.all);
    said.decide(UNEXPLAINED, |_| true);
    let mut told = of_recordings(case.references.iter().chain(&case.recordings).flat_map(|d| d.told.iter().cloned()));
    told.extend(solved.lacking_in_all());
    let traces = data.drives.iter().enumerate();
    Findings {
        said,
        counts: [
            data.drives.len(),
            data.drives.iter().filter(|s| s.drive.has_pose()).count(),
            data.drives.iter().map(|s| s.windows.len()).sum(),
        ],
        told,
        traces: traces.filter_map(|(k, shown)| trace(solved, shown, |time| solved.corrected(k, time), false)).collect(),
        next: None,
        model: data.model.clone(),
        thetas: [named.retuned.mean.as_slice(), solved.corrected_from_now_on()].map(<[f64]>::to_vec),
    }
}
