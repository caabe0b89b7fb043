//! From a case to what was found.

use std::borrow::Cow;

use hierarchical_fit::{Answer, Estimate, NamedCause, Posterior, Prior, Solved, Weighed, is_widest};

use crate::case::Case;
use crate::clock::{self, Apart};
use crate::constants::Constant;
use crate::drive::Drive;
use crate::error::CarError;
use crate::left_out::{Table, left_out_of};
use crate::model::{Laws, STEP};
use crate::rows::Shown;
use crate::settings::SETTINGS;
use crate::solve::solve;
use crate::traces::{predicted, trace};
use catalogue::car::CAR_CLOCK_DELAY;
use inference::robust::NINETY;
use verdict::{PredictedPath, Trace};

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
    /// Names of constants of which the owner states nothing, so that nothing can be wrong with them.
    pub unstated: Vec<&'static str>,
    /// Sigmas of the errors: windows of the pose, m; gyro, rad/s; encoder, m/s.
    pub noise: [f64; 3],
    /// Factor on the usual scatter of constants between drives.
    pub scatter: f64,
    /// Whether that is as much as was tried: what is named with all drives is then not trusted.
    pub is_scattered: bool,
    /// Root mean square error of windows over that of a car that keeps still: as given, re-tuned, with the named causes.
    pub shares: [f64; 3],
    /// Drives, those with a pose, windows.
    pub counts: [usize; 3],
    /// What was done to the recordings, for people.
    pub told: Vec<String>,
    /// The recordings with a pose beside the simulations that were fitted to them.
    pub traces: Vec<Trace>,
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

/// The same with the forecasts of drives that are left out in turn, from one fit.
///
/// # Errors
/// As [`diagnose`].
pub fn examine(case: &Case, progress: &dyn Fn(&str)) -> Result<(Findings, Table), CarError> {
    if case.recordings.is_empty() {
        return Err(CarError::Empty);
    }
    progress("fitting the car to its drives");
    let (case, apart) = clock::joined(case);
    let all: Vec<&Drive> = case.recordings.iter().collect();
    let solved = solve(&case.car, &case.references, &all)?;
    Ok((findings(&case, &solved, apart.as_ref()), left_out_of(&solved, progress)))
}

fn findings(case: &Case, solved: &Solved<Shown<'_>>, apart: Option<&Apart>) -> Findings {
    let Solved { data, causes, prior, fit, named } = solved;
    let estimates = |posterior: &Posterior| -> Vec<Estimate> {
        data.model.iter().enumerate().map(|(k, c)| estimate(c, prior, posterior, k)).collect()
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
    let mut named_causes: Vec<NamedCause> = named.chosen.iter().map(of_cause).collect();
    if let Some(apart) = apart {
        let rest = data.model.iter().position(|c| c.cause == &CAR_CLOCK_DELAY);
        apart.lead(&mut named_causes, rest.map(|k| &all[k]));
    }

    let rules = SETTINGS.unexplained;
    let is_left = shares[2] > rules.most || (shares[2] > rules.share && shares[2] > rules.of_retuned * shares[1]);
    let is_stated = |e: &&Estimate| data.model.iter().any(|c| c.name == e.name && c.sigma < c.usual);
    // Deviations of single drives explain everything where they are as free as was tried.
    let is_scattered = data.drives.len() > 1 && is_widest(fit.factor);
    let answer = if is_left || (is_scattered && !named_causes.is_empty()) {
        Answer::Unknown
    } else if !named_causes.is_empty() {
        Answer::Named
    } else if retuned.iter().filter(is_stated).any(Estimate::is_moved) {
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
        unstated: data.model.iter().filter(|c| c.sigma >= c.usual).map(|c| c.name).collect(),
        constants: all,
        // Of the clocks that were measured before the fit there is none.
        rival: named.rival.filter(|_| apart.is_none()).map(|c| causes[c].label()),
        retuned,
        noise: fit.noise.sigma,
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
        clock: apart.map(|apart| apart.usual),
        laws: [&named.retuned, &named.posterior].map(|p| Laws::at(&data.model, p.mean.as_slice())),
    }
}

fn estimate(constant: &Constant, prior: &Prior, posterior: &Posterior, k: usize) -> Estimate {
    let sd = posterior.covariance[(k, k)].max(0.0).sqrt();
    let value = constant.value(posterior.mean[k]);
    let sd_of_value = sd * if constant.is_factor { value.abs() } else { 1.0 };
    Estimate {
        name: constant.name.to_owned(),
        unit: constant.unit,
        given: constant.value(prior.mean[k]),
        value,
        half_width: NINETY * sd_of_value.hypot(constant.of_another_law(value)),
        sigmas: (posterior.mean[k] - prior.mean[k]) / prior.covariance[(k, k)].sqrt(),
    }
}
