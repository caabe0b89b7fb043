//! From a case to what was found.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use crate::case::Case;
use crate::cause::causes;
use crate::clock;
use crate::constants::{ClockZero, Constant, Measured, Quantity, constants};
use crate::doubt::without_what_little_shows;
use crate::drive::Drive;
use crate::dropout::{self, Lost};
use crate::error::OdometryError;
use crate::findings::{Findings, is_nothing_that_slips};
use crate::fit::{Fit, Prior, equations, fit, scatter};
use crate::motion::Laws;
use crate::next_drive::{self, Found};
use crate::settings::SETTINGS;
use crate::standing;
use crate::traces::trace;
use crate::wheel::WheeledRobot;
use crate::windows::{Data, laws};
use hierarchical_fit::of_recordings;
use hierarchical_fit::{
    Answer, CaseError, Cause, Estimate, Evidence, Named, NamedCause, Posterior, Rehearsable, Weighed, covariance,
    is_beyond_references, name_from, of_class,
};
use inference::robust::{NINETY, rms};
use verdict::Trace;

/// Drives with the constants fitted to them, and what was named.
#[derive(Debug, Clone)]
pub(crate) struct Solved {
    /// Constants as the robot has them before any drive.
    stated: Vec<Constant>,
    /// The same, with what stands far off taken as usual.
    pub(crate) constants: Vec<Constant>,
    pub(crate) causes: Vec<Cause>,
    pub(crate) prior: Prior,
    pub(crate) fit: Fit,
    pub(crate) named: Named,
    /// The answer without causes that little shows, where there are some.
    pub(crate) plainer: Option<Named>,
    pub(crate) lost: Vec<Lost>,
    /// Error that the best answer leaves of the references, as a share of their motion; `None` without any.
    pub(crate) left_of_references: Option<f64>,
}

impl Solved {
    /// The same with the plainer answer, if there is one.
    pub(crate) fn plainer(&self) -> Option<Self> {
        let named = self.plainer.clone()?;
        Some(Self { named, plainer: None, ..self.clone() })
    }

    /// The laws as stated or as the references have them, re-tuned, and with the named causes.
    pub(crate) fn laws(&self, robot: &WheeledRobot) -> [Laws; 3] {
        let of = |theta: &DVector<f64>| laws(robot, &self.constants, theta.as_slice());
        [of(&self.prior.mean), of(&self.named.retuned.mean), of(&self.named.posterior.mean)]
    }

    /// A drive beside these simulations; the last only where a cause is named.
    pub(crate) fn trace(&self, robot: &WheeledRobot, drive: &Drive, left_out: bool) -> Trace {
        let [stated, retuned, corrected] = &self.laws(robot);
        let corrected = (!self.named.chosen.is_empty()).then_some(corrected);
        trace(robot, drive, [Some(stated), Some(retuned), corrected], left_out)
    }
}

/// Compares wheel motion and pose of a case, and names what would make them agree.
///
/// # Errors
/// When the robot cannot be, or there are too few drives.
pub fn diagnose(case: &Case, progress: &dyn Fn(&str)) -> Result<Findings, OdometryError> {
    examine(case, None, progress)
}

/// The same with advice on a next drive of so many seconds.
///
/// # Errors
/// As [`diagnose`].
pub fn examine(case: &Case, next: Option<f64>, progress: &dyn Fn(&str)) -> Result<Findings, OdometryError> {
    case.robot.checked()?;
    if case.recordings.is_empty() {
        return Err(OdometryError::Case(CaseError::Empty));
    }
    progress("fitting the pose to the wheels' motion");
    let (case, clock) = clock::joined(case);
    let drives: Vec<&Drive> = case.recordings.iter().collect();
    let solved = solve(&case.robot, &case.references, &drives, &Start { clock, of: None })?;
    let data = data(&case.robot, &solved.constants, case.recordings.iter().collect(), &solved.lost)?;
    progress("naming what would make them agree");
    let of = |solved: &Solved| {
        let next = next.map(|length| {
            progress("looking for the drive that tells the rivals apart");
            let Solved { causes, prior, fit, named, .. } = solved;
            next_drive::advise(&case, &Found { data: &data, causes, prior, fit, chosen: &named.chosen }, length)
        });
        Findings { next, ..findings(&case, &data, solved) }
    };
    let plainer = solved.plainer().map(|plainer| Box::new(of(&plainer)));
    let found = of(&solved);
    drop(data);
    Ok(Findings { plainer, solved: Some(Arc::new(solved)), ..found })
}

/// What the drives of a case could say, whatever they say.
///
/// # Errors
/// As [`diagnose`].
pub fn rehearsable(case: &Case, progress: &dyn Fn(&str)) -> Result<Rehearsable, OdometryError> {
    case.robot.checked()?;
    if case.recordings.is_empty() {
        return Err(OdometryError::Case(CaseError::Empty));
    }
    progress("fitting the pose to the wheels' motion");
    let (case, clock) = clock::joined(case);
    let drives: Vec<&Drive> = case.recordings.iter().collect();
    let solved = solve(&case.robot, &case.references, &drives, &Start { clock, of: None })?;
    let data = data(&case.robot, &solved.constants, drives, &solved.lost)?;
    Ok(crate::rehearsable::rehearsable(&case, &data, &solved))
}

/// What is known before the recordings: of the robot file, or of the references, with the error that is left of these.
fn prior(
    robot: &WheeledRobot,
    constants: &[Constant],
    references: &[Drive],
) -> Result<(Prior, Option<f64>), OdometryError> {
    let n = constants.len();
    let known = DMatrix::from_diagonal(&DVector::from_iterator(n, constants.iter().map(|c| c.sigma.powi(2))));
    let of_file = Prior { mean: DVector::zeros(n), covariance: known };
    if references.is_empty() {
        return Ok((of_file, None));
    }
    let data = Data::new(robot, constants, references.iter().collect())?;
    let causes = causes(robot, constants);
    let (fit, named) = weigh(&data, &of_file, &causes, vec![0.0; n]).ok_or(short(&data))?;
    let deviation = scatter(&data, fit.factors);
    let between = DMatrix::from_diagonal(&deviation.component_mul(&deviation));
    let left = share(&data, &named.posterior.mean).1;
    Ok((Prior { mean: named.posterior.mean, covariance: named.posterior.covariance + between }, Some(left)))
}

fn short(data: &Data<'_>) -> OdometryError {
    let windows = data.windows.iter().map(Vec::len).sum();
    OdometryError::Case(CaseError::Short { windows, length: SETTINGS.windows.length, needed: SETTINGS.windows.least })
}

fn data<'a>(
    robot: &'a WheeledRobot,
    constants: &'a [Constant],
    drives: Vec<&'a Drive>,
    lost: &[Lost],
) -> Result<Data<'a>, OdometryError> {
    let mut data = Data::new(robot, constants, drives)?;
    dropout::leave_out(&mut data, lost);
    Ok(data)
}

/// Where a fit starts: at what is known before, where neither is given.
pub(crate) struct Start<'a> {
    /// Usual offset and rate of the clocks, from the first row on, where speeds showed them.
    pub(crate) clock: Option<[f64; 2]>,
    /// What was found of nearly the same drives, with the same references.
    pub(crate) of: Option<&'a Solved>,
}

/// Fits drives and names causes.
pub(crate) fn solve(
    robot: &WheeledRobot,
    references: &[Drive],
    drives: &[&Drive],
    start: &Start<'_>,
) -> Result<Solved, OdometryError> {
    let mut constants = constants(robot, Measured::by(references.iter().chain(drives.iter().copied())));
    if start.clock.is_some() {
        // Logs that were started apart run apart from there.
        for constant in &mut constants {
            if let Quantity::ClockRate(zero) = &mut constant.quantity {
                *zero = ClockZero::Start;
            }
        }
    }
    let stated = constants.clone();
    // What references say does not depend on the drives beside them.
    let (prior, left_of_references) = match start.of.filter(|other| other.stated == stated) {
        Some(other) => (other.prior.clone(), other.left_of_references),
        None => prior(robot, &constants, references)?,
    };
    let seen = |quantity: Quantity| match (quantity, start.clock) {
        (Quantity::ClockOffset, Some([offset, _])) => Some(offset),
        (Quantity::ClockRate(_), Some([_, rate])) => Some(rate),
        _ => None,
    };
    let start: Vec<f64> = match start.of {
        Some(other) => other.fit.theta.clone(),
        None => constants.iter().zip(&prior.mean).map(|(c, known)| seen(c.quantity).unwrap_or(*known)).collect(),
    };
    take_as_usual(&mut constants, &prior, &start);
    let mut causes = causes(robot, &constants);
    let mut data = Data::new(robot, &constants, drives.to_vec())?;

    let (mut fit, mut named) = weigh(&data, &prior, &causes, start).ok_or_else(|| short(&data))?;
    let seen = named.posterior.mean.as_slice().to_vec();
    let mut wider = constants.clone();
    if take_as_usual(&mut wider, &prior, &seen) {
        causes = crate::cause::causes(robot, &wider);
        (fit, named) = weigh(&data, &prior, &causes, fit.theta).ok_or_else(|| short(&data))?;
    }
    // Lost counts are found beside the best answer, and then left out of it.
    let mut lost = standing::lost(&data, named.posterior.mean.as_slice());
    if lost.is_empty() {
        let wide = wide(&prior, &causes);
        let often = dropout::often(&data, &fit, prior.mean.as_slice(), |rest, start| self::fit(rest, &wide, start));
        lost = match often.filter(|(_, lost)| !lost.is_empty()) {
            Some((theta, lost)) => {
                fit.theta = theta;
                lost
            }
            None => dropout::lost(&data, named.posterior.mean.as_slice(), fit.scale, SETTINGS.dropout.linear_most),
        };
    }
    if !lost.is_empty() {
        data = self::data(robot, &constants, drives.to_vec(), &lost)?;
        (fit, named) = weigh(&data, &prior, &causes, fit.theta).ok_or_else(|| short(&data))?;
    }
    let mut plainer = without_what_little_shows(&data, (&prior, &fit), &causes, &named);
    // By turning alone nothing confirms such laws: a gyro that is off is forecast as well.
    if drives.iter().all(|drive| drive.heading_only) {
        named = plainer.take().unwrap_or(named);
    }
    drop(data);
    Ok(Solved { stated, constants, causes, prior, fit, named, plainer, lost, left_of_references })
}

/// Takes what stands far beyond the usual size of its cause as usual: a frame that is turned by a right angle, or logs that start
/// seconds apart, would else be drawn to nothing, or count as scatter between sessions. Whether anything does.
fn take_as_usual(constants: &mut [Constant], prior: &Prior, values: &[f64]) -> bool {
    let mut any = false;
    for ((constant, value), known) in constants.iter_mut().zip(values).zip(&prior.mean) {
        let away = (value - known).abs();
        if away > SETTINGS.usual.far * constant.usual {
            constant.usual = away;
            any = true;
        }
    }
    any
}

/// What is known before the recordings if every cause may be there.
fn wide(prior: &Prior, causes: &[Cause]) -> Prior {
    let every: Vec<usize> = (0..causes.len()).collect();
    Prior { mean: prior.mean.clone(), covariance: covariance(&prior.covariance, causes, &every) }
}

/// Fits all constants as if every cause may be there, and weighs the causes about that fit and once more about the answer.
fn weigh(data: &Data<'_>, prior: &Prior, causes: &[Cause], start: Vec<f64>) -> Option<(Fit, Named)> {
    let mut fit = fit(data, &wide(prior, causes), start)?;
    let weighed = |fit: &Fit, from: &[usize]| {
        let evidence = Evidence::new(&fit.theta, &fit.sessions, &scatter(data, fit.factors), &prior.mean)?;
        name_from(&evidence, &prior.covariance, causes, from)
    };
    let first = weighed(&fit, &[])?;
    let set: Vec<usize> = first.chosen.iter().map(|c| c.cause).collect();
    let [of_all, of_first] =
        [&DVector::from_column_slice(&fit.theta), &first.posterior.mean].map(|at| share(data, at).1);
    let mut theta: Vec<f64> = first.posterior.mean.iter().copied().collect();
    // Equations about the fit of all causes lead astray where a constant is far off, and then from one equal answer to the other.
    let is_astray = !set.is_empty() && of_first > SETTINGS.fitting.astray * of_all;
    if is_astray {
        let covariance = covariance(&prior.covariance, causes, &set);
        theta = self::fit(data, &Prior { mean: prior.mean.clone(), covariance }, theta)?.theta;
    }
    let about = Fit { sessions: equations(data, &theta, fit.scale), theta, ..fit.clone() };
    // Equations about the answer may determine nothing, as those of slip that sets in all at once; then those about the fit stand.
    let named = match weighed(&about, if is_astray { &set } else { &[] }) {
        Some(named) => {
            fit = about;
            named
        }
        None => first,
    };
    // By turning alone radii, track and scale of the gyro share their odds.
    let by_turning = named.chosen.is_empty() && data.drives.iter().all(|drive| drive.heading_only);
    let class = if by_turning {
        let evidence = Evidence::new(&fit.theta, &fit.sessions, &scatter(data, fit.factors), &prior.mean)?;
        of_class(&evidence, &prior.covariance, causes)
    } else {
        None
    };
    Some((fit, class.unwrap_or(named)))
}

/// Root mean square error of the windows over the root mean square of their way and turning.
pub(crate) fn share(data: &Data<'_>, theta: &DVector<f64>) -> (f64, f64) {
    let errors = data.errors(theta.as_slice());
    let used = |drive: usize| {
        let all = data.windows[drive].iter().zip(&errors[drive]).zip(&data.dropped[drive]);
        all.filter(|((w, _), dropped)| w.is_moving() && !**dropped).map(|(both, _)| both)
    };
    let all = || (0..errors.len()).flat_map(used);
    let error = rms(all().flat_map(|(w, e)| w.measured(*e))).unwrap_or(0.0);
    let way = rms(all().flat_map(|(w, _)| w.way())).unwrap_or(0.0);
    (error, error / way.max(f64::MIN_POSITIVE))
}

fn findings(case: &Case, data: &Data<'_>, solved: &Solved) -> Findings {
    let Solved { constants, causes, prior, fit, named, lost, .. } = solved;
    let estimates = |posterior: &Posterior| -> Vec<Estimate> {
        (0..constants.len()).map(|k| estimate(&case.robot, &constants[k], prior, posterior, k)).collect()
    };
    let all = estimates(&named.posterior);
    let retuned = estimates(&named.retuned);
    let given = share(data, &prior.mean);
    let tuned = share(data, &named.retuned.mean);
    let best = share(data, &named.posterior.mean);

    let of_cause = |weighed: &Weighed| {
        let cause = &causes[weighed.cause];
        NamedCause {
            spec: cause.spec,
            label: cause.label(),
            probability: weighed.probability,
            alike: weighed.class[1..].iter().map(|&c| causes[c].label()).collect(),
            estimates: cause.moves().into_iter().map(|k| all[k].clone()).collect(),
            intervals: Vec::new(),
            onset: None,
        }
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
    let told = of_recordings(told);
    Findings {
        answer,
        named: named_causes,
        others: named.others.iter().map(|&(c, p)| (causes[c].label(), p)).collect(),
        constants: all,
        rival: named.rival.map(|c| causes[c].label()),
        retuned,
        noise: fit.scale,
        unconfirmed: None,
        scatter: fit.factors.others,
        shares: [given.1, tuned.1, best.1],
        left_of_references: solved.left_of_references,
        measured: Measured::by(case.recordings.iter()),
        counts: [data.sessions.len(), data.drives.len(), data.windows.iter().map(Vec::len).sum()],
        told,
        traces: case.recordings.iter().map(|drive| solved.trace(&case.robot, drive, false)).collect(),
        laws: solved.laws(&case.robot),
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
