//! From a case to what was found.

use std::sync::Arc;

use hierarchical_fit::{Answer, Estimate, NamedCause, Posterior, Prior, Solved, Weighed, is_widest};
use inference::robust::NINETY;
use verdict::{PredictedPath, Trace};

use crate::constants::{Constant, Has, causes};
use crate::drive::{Drive, STEP};
use crate::error::WheeledError;
use crate::left_out::{Table, left_out_of, predicted, trace};
use crate::robot::AnyWheels;
use crate::rows::{Constants, Shown, data};
use crate::settings::SETTINGS;

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
    /// Kind of answer.
    pub answer: Answer,
    /// Causes that were named, the one that the data would miss most first.
    pub named: Vec<NamedCause>,
    /// Causes that were not, with their probabilities.
    pub others: Vec<(String, f64)>,
    /// All constants with the named causes.
    pub constants: Vec<Estimate>,
    /// Constants re-tuned within what is known, with no cause.
    pub retuned: Vec<Estimate>,
    /// The cause that is little less probable than the first.
    pub rival: Option<String>,
    /// Factor on the usual scatter of constants between drives.
    pub scatter: f64,
    /// Whether that is as much as was tried: what is named with all drives is then not trusted.
    pub is_scattered: bool,
    /// Root mean square error of windows over that of a robot that keeps still: as given, re-tuned, with the named causes.
    pub shares: [f64; 3],
    /// Drives, those with a pose, windows.
    pub counts: [usize; 3],
    /// What was done to the recordings, for people.
    pub told: Vec<String>,
    /// The recordings with a pose beside the simulations that were fitted to them.
    pub traces: Vec<Trace>,
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

/// The same with the forecasts of drives that are left out in turn, from one fit.
///
/// # Errors
/// As [`diagnose`].
pub fn examine(case: &Case, progress: &dyn Fn(&str)) -> Result<(Findings, Table), WheeledError> {
    let solved = solved(case, progress)?;
    Ok((findings(case, &solved), left_out_of(&solved, progress)))
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
    let causes = causes(&data.model.all);
    let short = WheeledError::Short { windows: 0, length: SETTINGS.windows.length, needed: SETTINGS.windows.least };
    let solved = hierarchical_fit::solve(data, right.as_ref(), causes).ok_or(short);
    progress("naming what would make them agree");
    solved
}

fn findings(case: &Case, solved: &Solved<Shown<'_>>) -> Findings {
    let Solved { data, causes, prior, fit, named } = solved;
    let all_constants = &data.model.all;
    let estimates = |posterior: &Posterior| -> Vec<Estimate> {
        all_constants.iter().enumerate().map(|(k, c)| estimate(c, prior, posterior, k)).collect()
    };
    let (all, retuned) = (estimates(&named.posterior), estimates(&named.retuned));
    let shares = [&prior.mean, &named.retuned.mean, &named.posterior.mean].map(|theta| data.share(theta.as_slice()));
    let of_cause = |weighed: &Weighed| {
        let cause = &causes[weighed.cause];
        NamedCause {
            spec: cause.spec,
            label: cause.label(),
            probability: weighed.probability,
            alike: weighed.class[1..].iter().map(|&c| causes[c].label()).collect(),
            estimates: cause.moves().into_iter().map(|k| all[k].clone()).collect(),
            intervals: Vec::new(),
        }
    };
    let named_causes: Vec<NamedCause> = named.chosen.iter().map(of_cause).collect();

    let rules = SETTINGS.unexplained;
    let is_left = shares[2] > rules.most || (shares[2] > rules.share && shares[2] > rules.of_retuned * shares[1]);
    let is_scattered = data.drives.len() > 1 && is_widest(fit.factor);
    let answer = if is_left || (is_scattered && !named_causes.is_empty()) {
        Answer::Unknown
    } else if !named_causes.is_empty() {
        Answer::Named
    } else if retuned.iter().any(Estimate::is_moved) {
        Answer::Retune
    } else {
        Answer::Nothing
    };
    let mut told: Vec<String> =
        case.references.iter().chain(&case.recordings).flat_map(|d| d.told.iter().cloned()).collect();
    told.dedup();
    Findings {
        answer,
        named: named_causes,
        others: named.others.iter().map(|&(c, p)| (causes[c].label(), p)).collect(),
        constants: all,
        rival: named.rival.map(|c| causes[c].label()),
        retuned,
        scatter: fit.factor,
        is_scattered,
        shares,
        counts: [
            data.drives.len(),
            data.drives.iter().filter(|s| s.drive.has_pose()).count(),
            data.drives.iter().map(|s| s.windows.len()).sum(),
        ],
        told,
        traces: data.drives.iter().filter_map(|shown| trace(solved, shown, false)).collect(),
        model: data.model.clone(),
        thetas: [&named.retuned, &named.posterior].map(|p| p.mean.as_slice().to_vec()),
    }
}

fn estimate(constant: &Constant, prior: &Prior, posterior: &Posterior, k: usize) -> Estimate {
    let sd = posterior.covariance[(k, k)].max(0.0).sqrt();
    let value = constant.value(posterior.mean[k]);
    let sd_of_value = sd * if constant.is_factor { value.abs() } else { 1.0 };
    Estimate {
        name: constant.name.clone(),
        unit: constant.unit,
        given: constant.value(prior.mean[k]),
        value,
        half_width: NINETY * sd_of_value.hypot(constant.of_another_law(value)),
        sigmas: (posterior.mean[k] - prior.mean[k]) / prior.covariance[(k, k)].sqrt(),
    }
}
