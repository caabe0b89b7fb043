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
use crate::findings::Findings;
use crate::fit::{Fit, equations, fit, scatter};
use crate::motion::{Laws, implied};
use crate::next_drive::{self, Found};
use crate::onset;
use crate::said::{findings, share};
use crate::settings::SETTINGS;
use crate::standing;
use crate::traces::trace;
use crate::wheel::WheeledRobot;
use crate::windows::{Data, laws};
use hierarchical_fit::{CaseError, Cause, Evidence, Named, Onset, Prior, Rehearsable, covariance, name_from, of_class};
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
    /// When one of the causes begins or ends, where it is not there all the time.
    pub(crate) onset: Option<Onset>,
    /// Error that the best answer leaves of the references, as a share of their motion; `None` without any.
    pub(crate) left_of_references: Option<f64>,
    /// Causes that references and recordings lack alike, so that they are no difference between them.
    pub(crate) in_all: Vec<usize>,
}

impl Solved {
    /// The same with the plainer answer, if there is one.
    pub(crate) fn plainer(&self) -> Option<Self> {
        let named = self.plainer.clone()?;
        Some(Self { named, plainer: None, ..self.clone() })
    }

    /// The laws as stated or as the references have them, re-tuned, and with the named causes, as of a drive that was left out, from its place
    /// among all.
    pub(crate) fn laws_of_left_out(&self, robot: &WheeledRobot, place: usize) -> [Laws; 3] {
        let of = |theta: &DVector<f64>| laws(robot, &self.constants, theta.as_slice());
        let is_off = |onset: &&Onset| !onset.acts_in_left_out(place);
        let corrected = self.onset.as_ref().filter(is_off).map_or(&self.named.posterior.mean, |onset| &onset.off);
        [of(&self.prior.mean), of(&self.named.retuned.mean), of(corrected)]
    }

    /// What counts alone say of a drive that was left out, by its place among all, as stated, re-tuned, and with the named causes. Of one that
    /// begins or ends `when` says in which rows it is there, where a fit to all drives found it: how much is known of the others.
    pub(crate) fn paths_of_left_out(
        &self,
        robot: &WheeledRobot,
        (drive, place): (&Drive, usize),
        when: Option<(&Onset, usize)>,
    ) -> [Vec<[f64; 3]>; 3] {
        let [stated, retuned, corrected] = self.laws_of_left_out(robot, place);
        let own = self.onset.as_ref().zip(when).filter(|(own, (of_all, _))| own.cause == of_all.cause);
        let with_causes = match own {
            Some((own, (of_all, index))) => {
                let of = |theta: &DVector<f64>| laws(robot, &self.constants, theta.as_slice());
                let both = [&of(&self.named.posterior.mean), &of(&own.off)];
                onset::path(robot, drive, both, |time| of_all.acts(index, time))
            }
            None => match when.filter(|(of_all, index)| self.onset.is_none() && of_all.is_absent(*index)) {
                // The others all have it.
                Some((of_all, _)) => {
                    let mut theta = self.named.posterior.mean.clone();
                    self.causes[of_all.cause].take_from(theta.as_mut_slice(), self.prior.mean.as_slice());
                    implied(robot, drive, &laws(robot, &self.constants, theta.as_slice()))
                }
                None => implied(robot, drive, &corrected),
            },
        };
        [implied(robot, drive, &stated), implied(robot, drive, &retuned), with_causes]
    }

    /// A drive that it was fitted to beside these simulations; the last only where a cause is named.
    pub(crate) fn trace(&self, robot: &WheeledRobot, drive: &Drive, index: usize) -> Trace {
        let of = |theta: &DVector<f64>| laws(robot, &self.constants, theta.as_slice());
        let path = |theta: &DVector<f64>| implied(robot, drive, &of(theta));
        let named = &self.named.posterior.mean;
        let corrected = (!self.named.chosen.is_empty()).then(|| match &self.onset {
            Some(onset) => onset::path(robot, drive, [&of(named), &of(&onset.off)], |time| onset.acts(index, time)),
            None => path(named),
        });
        trace(drive, [Some(path(&self.prior.mean)), Some(path(&self.named.retuned.mean)), corrected], false)
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

/// What the robot file knows.
fn of_file(constants: &[Constant]) -> Prior {
    let n = constants.len();
    let variances = DVector::from_iterator(n, constants.iter().map(|c| c.sigma.powi(2)));
    Prior { mean: DVector::zeros(n), covariance: DMatrix::from_diagonal(&variances) }
}

/// What is known before the recordings: of the robot file, or of the references.
fn known(
    robot: &WheeledRobot,
    constants: &[Constant],
    references: &[Drive],
) -> Result<(Prior, Option<f64>), OdometryError> {
    let of_file = of_file(constants);
    if references.is_empty() {
        return Ok((of_file, None));
    }
    let right = Data::new(robot, constants, references.iter().collect())?;
    let known = crate::references::known(&right, &of_file, &causes(robot, constants)).ok_or_else(|| short(&right))?;
    Ok((known.prior, Some(known.left)))
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
    let (mut prior, mut left_of_references) = match start.of.filter(|other| other.stated == stated) {
        Some(other) => (other.prior.clone(), other.left_of_references),
        None => known(robot, &constants, references)?,
    };
    let seen = |quantity: Quantity| match (quantity, start.clock) {
        (Quantity::ClockOffset, Some([offset, _])) => Some(offset),
        (Quantity::ClockRate(_), Some([_, rate])) => Some(rate),
        _ => None,
    };
    let start_of = start.of;
    let start: Vec<f64> = match start_of {
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
    // Of drives left out in turn that was weighed before.
    let mut in_all = start_of.map_or_else(Vec::new, |other| other.in_all.clone());
    if start_of.is_none() && !references.is_empty() {
        let right = Data::new(robot, &constants, references.iter().collect())?;
        let known = (&of_file(&stated), &prior, causes.as_slice());
        if let Some(simpler) = crate::references::weighed_with((&data, &right), known, (&fit, &mut named)) {
            let (known, of_drives, with_references) = simpler;
            (fit, named) = (of_drives, with_references);
            (prior, left_of_references, in_all) = (known.prior, Some(known.left), known.in_all);
        }
    }
    let mut plainer = without_what_little_shows(&data, (&prior, &fit), &causes, &named);
    // By turning alone nothing confirms such laws: a gyro that is off is forecast as well.
    if drives.iter().all(|drive| drive.heading_only) {
        named = plainer.take().unwrap_or(named);
    }
    let mut begun = None;
    if let Some((onset, with_it)) = onset::onset(&data, &prior, &causes, (fit.factors, &named)) {
        (begun, named, plainer) = (Some(onset), with_it, None);
    }
    drop(data);
    Ok(Solved { stated, constants, causes, prior, fit, named, plainer, lost, onset: begun, left_of_references, in_all })
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
    prior.with(causes, &every)
}

/// Fits all constants as if every cause may be there, and weighs the causes about that fit and once more about the answer.
pub(crate) fn weigh(data: &Data<'_>, prior: &Prior, causes: &[Cause], start: Vec<f64>) -> Option<(Fit, Named)> {
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
