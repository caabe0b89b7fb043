//! What a fit says, as findings.

use crate::case::Case;
use crate::constants::{Constant, Measured, Quantity};
use crate::diagnose::Solved;
use crate::dropout;
use crate::findings::{Findings, is_nothing_that_slips};
use crate::onset;
use crate::settings::SETTINGS;
use crate::wheel::WheeledRobot;
use crate::windows::Data;
use hierarchical_fit::{
    Answer, Estimate, NamedCause, Posterior, Prior, Weighed, is_beyond_references, lacking_in_all, of_recordings,
};
use inference::robust::{NINETY, rms};
use nalgebra::DVector;

/// Root mean square error of the windows, and the same over the root mean square of their way and turning.
pub(crate) fn share(data: &Data<'_>, theta: &DVector<f64>) -> (f64, f64) {
    share_of(data, &data.errors(theta.as_slice()))
}

fn share_of(data: &Data<'_>, errors: &[Vec<[f64; 3]>]) -> (f64, f64) {
    let used = |drive: usize| {
        let all = data.windows[drive].iter().zip(&errors[drive]).zip(&data.dropped[drive]);
        all.filter(|((w, _), dropped)| w.is_moving() && !**dropped).map(|(both, _)| both)
    };
    let all = || (0..errors.len()).flat_map(used);
    let error = rms(all().flat_map(|(w, e)| w.measured(*e))).unwrap_or(0.0);
    let way = rms(all().flat_map(|(w, _)| w.way())).unwrap_or(0.0);
    (error, error / way.max(f64::MIN_POSITIVE))
}

/// Findings of drives, with what was fitted to them.
pub(crate) fn findings(case: &Case, data: &Data<'_>, solved: &Solved) -> Findings {
    let Solved { constants, causes, prior, fit, named, lost, onset, .. } = solved;
    let estimates = |posterior: &Posterior| -> Vec<Estimate> {
        (0..constants.len()).map(|k| estimate(&case.robot, &constants[k], prior, posterior, k)).collect()
    };
    let all = estimates(&named.posterior);
    let retuned = estimates(&named.retuned);
    let given = share(data, &prior.mean);
    let tuned = share(data, &named.retuned.mean);
    let best = match onset {
        Some(onset) => share_of(data, &onset::errors(data, &named.posterior.mean, onset)),
        None => share(data, &named.posterior.mean),
    };
    let names: Vec<&str> = data.drives.iter().map(|drive| drive.name.as_str()).collect();

    let of_cause = |weighed: &Weighed| {
        let begun = onset.as_ref().filter(|onset| onset.cause == weighed.cause);
        let lengths = data.drives.iter().map(|drive| (drive.name.as_str(), drive.duration()));
        let spans = begun.map_or_else(Vec::new, |onset| onset.spans(lengths));
        NamedCause::new(weighed, causes, &all, (spans, begun.and_then(|onset| onset.began(&names))))
    };
    let mut named_causes: Vec<NamedCause> = named.chosen.iter().map(of_cause).collect();
    named_causes.extend(dropout::named(case, data, lost));

    let rules = SETTINGS.unexplained;
    let floor = data.pose_noise().max(SETTINGS.windows.floor);
    let is_much = best.1 > rules.most || best.0 > rules.of_retuned * tuned.0;
    let is_left = (best.1 > rules.share && is_much || is_beyond_references(best.1, solved.left_of_references))
        && best.0 > rules.noise * floor;
    let moved = retuned.iter().any(Estimate::is_moved);
    let answer = if is_left || is_nothing_that_slips(&named_causes) {
        Answer::Unknown
    } else if !named_causes.is_empty() {
        Answer::Named
    } else if moved {
        Answer::Retune
    } else {
        Answer::Nothing
    };
    let mut told: Vec<String> =
        case.references.iter().chain(&case.recordings).flat_map(|d| d.told.iter().cloned()).collect();
    told.sort();
    let mut told = of_recordings(told);
    told.extend(lacking_in_all(solved.in_all.iter().map(|&c| &causes[c])));
    Findings {
        answer,
        named: named_causes,
        others: named.others.iter().map(|&(c, p)| (causes[c].label(), p)).collect(),
        constants: all,
        rival: named.rival.map(|c| causes[c].label()),
        retuned,
        noise: fit.scale,
        unconfirmed: None,
        scatter: onset.as_ref().map_or(fit.factors.others, |onset| onset.factor),
        shares: [given.1, tuned.1, best.1],
        left_of_references: solved.left_of_references,
        measured: Measured::by(case.recordings.iter()),
        counts: [data.sessions.len(), data.drives.len(), data.windows.iter().map(Vec::len).sum()],
        told,
        traces: case.recordings.iter().enumerate().map(|(k, drive)| solved.trace(&case.robot, drive, k)).collect(),
        laws: solved.laws_of_left_out(&case.robot, case.recordings.len()),
        plainer: None,
        solved: None,
        next: None,
    }
}

/// A constant in the words of the robot file: factors become lengths.
fn estimate(robot: &WheeledRobot, constant: &Constant, prior: &Prior, posterior: &Posterior, k: usize) -> Estimate {
    let sd = posterior.covariance[(k, k)].max(0.0).sqrt();
    let sigmas = (posterior.mean[k] - prior.mean[k]) / prior.covariance[(k, k)].sqrt();
    let (given, value, half_width) = match constant.quantity.multiplied(robot) {
        Some(of) => {
            let value = of * posterior.mean[k].exp();
            let is_shape = matches!(constant.quantity, Quantity::TurnSlipRate | Quantity::TurnSlipPower);
            let form = if is_shape { SETTINGS.slip.form } else { 0.0 };
            (of * prior.mean[k].exp(), value, NINETY * sd.hypot(form) * value.abs())
        }
        None => (prior.mean[k], posterior.mean[k], NINETY * sd),
    };
    Estimate { name: constant.name.clone(), unit: constant.unit, given, value, half_width, sigmas }
}
