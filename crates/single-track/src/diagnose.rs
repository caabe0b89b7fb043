//! From a case to what was found.

use hierarchical_fit::CaseError as CarError;
use std::borrow::Cow;

use hierarchical_fit::{Estimate, Rehearsable, Said, Solved, Unexplained};

use hierarchical_fit::of_recordings;
use hierarchical_fit::telling::NO_ADVICE;

use crate::case::Case;
use crate::clock::{self, Apart};
use crate::constants::Constant;
use crate::drive::Drive;
use crate::left_out::{Table, left_out_of};
use crate::model::{Laws, STEP};
use crate::next_drive;
use crate::rows::Shown;
use crate::sensors::uneven;
use crate::settings::SETTINGS;
use crate::solve::solve;
use crate::traces::{predicted, trace};
use catalogue::car::CAR_CLOCK_DELAY;
use verdict::{Advice, PredictedPath, Trace};

/// When something is left that no cause accounts for.
const UNEXPLAINED: Unexplained = Unexplained {
    share: SETTINGS.unexplained.share,
    of_retuned: SETTINGS.unexplained.of_retuned,
    most: SETTINGS.unexplained.most,
    doubted: SETTINGS.unexplained.doubted,
};

/// What the drives of a case say.
#[derive(Debug, Clone)]
pub struct Findings {
    /// What they say whatever the model is.
    pub said: Said,
    /// Names of constants that are no causes: of which the owner states nothing, so that nothing can be wrong with them, and which drives
    /// hardly tell beyond what is stated.
    pub unweighed: [Vec<&'static str>; 2],
    /// Sigmas of the errors: windows of the pose, m; gyro, rad/s; encoder, m/s.
    pub noise: [f64; 3],
    /// Drives, those with a pose, windows.
    pub counts: [usize; 3],
    /// What was done to the recordings, for people.
    pub told: Vec<String>,
    /// The recordings with a pose beside the simulations that were fitted to them.
    pub traces: Vec<Trace>,
    /// Advice on the next drive, where it was asked for.
    pub next: Option<Advice>,
    /// Usual offset, s, and rate of the car's clock, where they were measured before the fit.
    pub(crate) clock: Option<[f64; 2]>,
    /// Re-tuned, with the named causes.
    pub(crate) laws: [Laws; 2],
}

impl Findings {
    /// The pose of a drive from throttle and steering alone, on the grid of the model.
    pub fn predict(&self, drive: &Drive) -> PredictedPath {
        let [retuned, corrected] = &self.laws;
        let retuned = predicted(retuned, drive);
        let mut in_time = Cow::Borrowed(drive);
        if let Some(clock) = self.clock {
            in_time.to_mut().set_clock(clock);
        }
        let corrected = predicted(corrected, &in_time);
        let time = (0..corrected.len()).map(|k| drive.start + STEP * k as f64).collect();
        PredictedPath { name: drive.name.clone(), time, corrected, retuned }
    }
}

/// Compares a car's drives with what throttle and steering imply, and names what would make them agree.
///
/// # Errors
/// When there are too few drives.
pub fn diagnose(case: &Case, progress: &dyn Fn(&str)) -> Result<Findings, CarError> {
    if case.recordings.is_empty() {
        return Err(CarError::Empty);
    }
    progress("fitting the car to its drives");
    let (case, apart) = clock::joined(case);
    let all: Vec<&Drive> = case.recordings.iter().collect();
    let solved = solve(&case.car, &case.references, &all)?;
    progress("naming what would make them agree");
    Ok(findings(&case, &solved, apart.as_ref()))
}

/// The same with the forecasts of drives that are left out in turn, from one fit, and with advice on a next drive of so many
/// seconds.
///
/// # Errors
/// As [`diagnose`].
pub fn examine(case: &Case, next: Option<f64>, progress: &dyn Fn(&str)) -> Result<(Findings, Table), CarError> {
    if case.recordings.is_empty() {
        return Err(CarError::Empty);
    }
    progress("fitting the car to its drives");
    let (case, apart) = clock::joined(case);
    let all: Vec<&Drive> = case.recordings.iter().collect();
    let solved = solve(&case.car, &case.references, &all)?;
    let (mut findings, table) = (findings(&case, &solved, apart.as_ref()), left_out_of(&solved, progress));
    // Many causes of cars are of sensors, or of clocks that were measured before the fit: forecasts of poses say nothing about them.
    findings.said.judge(
        &table.free_runs(),
        UNEXPLAINED,
        |e| is_known(&solved.data.model, !case.references.is_empty(), e),
        |_| false,
    );
    // A drive is chosen for causes that are always there.
    if next.is_some() && solved.onset.is_some() {
        findings.told.push(NO_ADVICE.to_owned());
    }
    findings.next = next.filter(|_| solved.onset.is_none()).map(|length| {
        progress("looking for the drive that tells the rivals apart");
        next_drive::advise(&solved, case.car.encoder_window, length)
    });
    Ok((findings, table))
}

/// What the drives of a case could say, whatever they say.
///
/// # Errors
/// As [`diagnose`].
pub fn rehearsable(case: &Case, progress: &dyn Fn(&str)) -> Result<Rehearsable, CarError> {
    if case.recordings.is_empty() {
        return Err(CarError::Empty);
    }
    progress("fitting the car to its drives");
    let (case, _) = clock::joined(case);
    let all: Vec<&Drive> = case.recordings.iter().collect();
    let solved = solve(&case.car, &case.references, &all)?;
    Ok(solved.rehearsable(&solved.data.model, case.references.len(), next_drive::read))
}

/// Whether something was known of a constant that moved.
fn is_known(constants: &[Constant], has_references: bool, e: &Estimate) -> bool {
    constants.iter().any(|c| c.name == e.name && c.can_be_wrong(has_references))
}

fn findings(case: &Case, solved: &Solved<Shown<'_>>, apart: Option<&Apart>) -> Findings {
    let Solved { data, fit, named, .. } = solved;
    let mut said = solved.said(&data.model);
    if let Some(apart) = apart {
        let rest = data.model.iter().position(|c| c.cause == &CAR_CLOCK_DELAY);
        apart.lead(&mut said.named, rest.map(|k| &said.constants[k]));
        // Of the clocks that were measured before the fit there is none.
        said.rival = None;
    }
    let has_references = !case.references.is_empty();
    said.uneven = uneven(solved);
    said.decide(UNEXPLAINED, |e| is_known(&data.model, has_references, e));
    let mut told = of_recordings(case.references.iter().chain(&case.recordings).flat_map(|d| d.told.iter().cloned()));
    told.extend(solved.lacking_in_all());
    let traces = data.drives.iter().enumerate();
    Findings {
        said,
        unweighed: [false, true].map(|is_stated| {
            let unweighed = data.model.iter().filter(|c| !c.can_be_wrong(has_references) && c.is_stated == is_stated);
            unweighed.map(|c| c.name).collect()
        }),
        noise: fit.noise.sigma,
        counts: [
            data.drives.len(),
            data.drives.iter().filter(|s| s.drive.has_pose()).count(),
            data.drives.iter().map(|s| s.windows.len()).sum(),
        ],
        told,
        traces: traces.filter_map(|(k, shown)| trace(solved, shown, |time| solved.corrected(k, time), false)).collect(),
        next: None,
        clock: apart.map(|apart| apart.usual),
        laws: [named.retuned.mean.as_slice(), solved.corrected_from_now_on()].map(|at| Laws::at(&data.model, at)),
    }
}
