//! The whole way of a rehearsal, from a case to shares of replicas.

use inference::hypothesis::{Dose, Sizes};
use inference::robust::median;
use inference::{DiagnosisError, Options};
use rayon::prelude::*;
use torque_driven::{Case, Run};
use verdict::{
    FoundFrom, NotRehearsed, REHEARSAL_FORMAT, Rehearsal, RehearsedDrives, RehearsedEffect, RehearsedSize, SensorNoise,
};

use crate::error::RehearsalError;
use crate::hidden::Hidden;
use crate::plan::Plan;
use crate::replica::{Common, Replica, Template};
use crate::score::{Scored, count, found_from, look_alikes, share_found};
use crate::sensors::{CHANNELS, channel, noise, way};
use crate::settings::SETTINGS;
use crate::words;

/// Share of replicas from which on an effect counts as found.
const WANTED: f64 = SETTINGS.plan.wanted;
/// Why an effect is left out whose smallest size is none.
pub(crate) const BEYOND: &str = "already its smallest size lies beyond what the catalogue calls sensible on this robot";
/// Why an effect is left out that no recorded channel shows.
pub(crate) const UNSEEN: &str =
    "it changes nothing that these recordings hold: the channel that would show it is missing";

/// A rehearsal that is ready to be run.
pub struct Rehearsing<'a> {
    plan: Plan,
    common: Common<'a>,
    effects: Vec<Hidden>,
    left_out: Vec<NotRehearsed>,
    noise: Vec<SensorNoise>,
    shortened: Vec<String>,
}

/// A diagnosis to be made.
#[derive(Clone, Copy)]
struct Job {
    replica: usize,
    /// Place of the effect, and its size in sizes of interest.
    hidden: Option<(usize, f64)>,
}

/// What came of a job.
struct Done {
    scored: Scored,
    /// How far the wheels turned, over how far they did in the recordings.
    driven: Option<f64>,
}

impl<'a> Rehearsing<'a> {
    /// Takes the inputs and sensors of a case's recordings. What its references and recordings show
    /// is used for nothing else than rates, gaps and noise.
    ///
    /// # Errors
    /// A plan with which nothing can be simulated, a case without recordings, recordings that are too short.
    pub fn new(case: &'a Case, plan: &Plan, options: &'a Options) -> Result<Self, RehearsalError> {
        let known: Vec<&str> = options.known.all().map(|effect| effect.spec().id).collect();
        let plan = plan.checked(&known)?;
        case.robot.checked().map_err(DiagnosisError::from)?;
        if case.recordings.is_empty() {
            return Err(DiagnosisError::Empty { what: "recording" }.into());
        }
        let template = |run: &Run| Template::new(run, plan.seconds, options);
        let recordings: Vec<Template> =
            case.recordings.iter().take(plan.recordings.max(1)).map(template).collect::<Result<_, _>>()?;
        // A simulator's log shows neither noise nor drives of the robot.
        let real: Vec<&Run> = case.references.iter().filter(|run| !run.is_noise_free()).collect();
        let references: Vec<Template> = match plan.references {
            // On the inputs of recordings, but of the visit of the references.
            Some(wanted) => {
                let visit = real.first().and_then(|run| run.visit.clone());
                recordings.iter().cycle().take(wanted).map(|template| template.of_visit(visit.clone())).collect()
            }
            None => real.iter().take(SETTINGS.plan.references).map(|run| template(run)).collect::<Result<_, _>>()?,
        };
        let shortened = words::shortened(case, &real, &plan, [&recordings, &references]);

        let (sigmas, noise) = noise(&case.recordings.iter().collect::<Vec<_>>(), case.pose_sigma);
        let common = Common { case, options, seed: plan.seed, references, recordings, sigmas };
        let largest_torque = common.recordings.iter().flat_map(|t| &t.run.torque).flatten();
        let sizes = Sizes {
            largest_torque: largest_torque.fold(0.0, |most: f64, torque| most.max(torque.abs())),
            robot: Some(case.robot),
        };
        let (all, mut left_out) = plan.effects(options.known, &sizes);
        let mut effects = Vec::new();
        for hidden in all {
            match unseen(&common, &plan, &hidden) {
                None => effects.push(hidden),
                Some(why) => {
                    left_out.push(NotRehearsed { effect: hidden.spec().id.to_owned(), why: why.into() });
                }
            }
        }
        Ok(Self { plan, common, effects, left_out, noise, shortened })
    }

    /// The diagnoses to be made.
    fn jobs(&self) -> Vec<Job> {
        let fault_free = (0..self.plan.fault_free).map(|replica| Job { replica, hidden: None });
        let of_effect = |place: usize| {
            self.sizes_of(place).into_iter().flat_map(move |multiple| {
                (0..self.plan.replicas).map(move |replica| Job { replica, hidden: Some((place, multiple)) })
            })
        };
        fault_free.chain((0..self.effects.len()).flat_map(of_effect)).collect()
    }

    /// Sizes of an effect that every replica can have, in sizes of interest.
    fn sizes_of(&self, place: usize) -> Vec<f64> {
        let can_have = |multiple: &f64| (0..self.plan.replicas).all(|r| self.dose(place, *multiple, r).is_some());
        self.plan.sizes.iter().copied().filter(can_have).collect()
    }

    fn dose(&self, place: usize, multiple: f64, replica: usize) -> Option<Dose> {
        self.effects[place].dose(multiple, self.plan.seed, replica)
    }

    /// The robots of a replica, one for each recording.
    #[cfg(test)]
    pub(crate) fn robots_of(&self, replica: usize) -> Result<Vec<robot_model::Robot<f64>>, DiagnosisError> {
        Ok(Replica::new(&self.common, replica)?.robots)
    }

    /// How many diagnoses will be made.
    pub fn count(&self) -> usize {
        self.jobs().len()
    }

    /// Simulates and diagnoses all replicas, on as many threads as rayon has; the answer depends on
    /// none of them. `listener` is told what was diagnosed, from any thread.
    ///
    /// # Errors
    /// When no replica can be calibrated on its references.
    pub fn run(&self, listener: &(dyn Fn(&str) + Sync)) -> Result<Rehearsal, RehearsalError> {
        let replicas: Vec<Result<Replica, DiagnosisError>> =
            (0..self.plan.fault_free).into_par_iter().map(|number| Replica::new(&self.common, number)).collect();
        if let Some(why) = replicas.iter().map(|replica| replica.as_ref().err()).collect::<Option<Vec<_>>>() {
            // The first of them speaks for all.
            why.first().map_or(Ok(()), |why| Err((*why).clone()))?;
        }
        Ok(self.answered(&replicas, listener))
    }

    fn answered(&self, replicas: &[Result<Replica, DiagnosisError>], listener: &(dyn Fn(&str) + Sync)) -> Rehearsal {
        let jobs = self.jobs();
        let one = |job: &Job| {
            let done = match &replicas[job.replica] {
                Ok(replica) => self.done(replica, *job),
                Err(why) => Done { scored: Scored::failed(why.to_string()), driven: None },
            };
            listener(&self.told(*job, &done));
            done
        };
        let done: Vec<Done> = jobs.par_iter().map(one).collect();
        let of = |hidden: Option<(usize, f64)>| {
            jobs.iter().zip(&done).filter(move |(job, _)| job.hidden == hidden).map(|(_, done)| done)
        };

        let fault_free = count(of(None).map(|done| &done.scored));
        let size = |place: usize, multiple: f64| {
            let answers = count(of(Some((place, multiple))).map(|done| &done.scored));
            let driven = median(of(Some((place, multiple))).filter_map(|done| done.driven)).unwrap_or(0.0);
            let (size, found) = (multiple * self.effects[place].interest(), share_found(&answers));
            RehearsedSize { multiple, size, answers, found, driven }
        };
        let effect = |place: usize| {
            let hidden = &self.effects[place];
            let sizes: Vec<RehearsedSize> = self.sizes_of(place).into_iter().map(|m| size(place, m)).collect();
            RehearsedEffect {
                effect: hidden.spec().id.to_owned(),
                name: hidden.spec().name.to_owned(),
                interest: hidden.interest(),
                unit: inference::words::unit(hidden.spec()).into(),
                found: found_from(&sizes, WANTED),
                look_alikes: look_alikes(&sizes),
                sizes,
            }
        };
        let effects = in_order((0..self.effects.len()).map(effect).collect());

        let limits = words::limits(&effects, &self.plan, self.common.references.len());
        Rehearsal {
            format: REHEARSAL_FORMAT,
            drives: self.drives(),
            fault_free,
            effects,
            left_out: self.left_out.clone(),
            shortened: self.shortened.clone(),
            limits,
        }
    }

    /// Simulates and diagnoses one.
    fn done(&self, replica: &Replica, job: Job) -> Done {
        let (common, templates) = (&self.common, &self.common.recordings);
        let dose = job.hidden.and_then(|(place, multiple)| self.dose(place, multiple, job.replica));
        let recordings = match replica.recordings(common, dose.as_ref()) {
            Ok(recordings) => recordings,
            Err(why) => return Done { scored: Scored::failed(why.to_string()), driven: None },
        };
        let recorded: f64 = templates.iter().map(|template| way(&template.run)).sum();
        let driven = (recorded > 0.0).then(|| recordings.iter().map(way).sum::<f64>() / recorded);
        let id = job.hidden.map(|(place, _)| self.effects[place].spec().id);
        Done { scored: replica.answer(common, recordings, id), driven }
    }

    /// A line for whoever waits.
    fn told(&self, job: Job, done: &Done) -> String {
        let hidden = job.hidden.map(|(place, multiple)| (self.effects[place].spec().id, multiple));
        words::diagnosed(job.replica, hidden, &done.scored)
    }

    fn drives(&self) -> RehearsedDrives {
        let recordings = self.common.recordings.iter().map(|t| (t.run.name.clone(), t.run.duration()));
        RehearsedDrives {
            seed: self.plan.seed,
            replicas: self.plan.replicas,
            fault_free_replicas: self.plan.fault_free,
            references: self.common.references.len(),
            recordings: recordings.collect(),
            noise: self.noise.clone(),
            wanted_share: WANTED,
        }
    }
}

/// Effects, those that are found from the smallest multiple on first.
pub(crate) fn in_order(mut effects: Vec<RehearsedEffect>) -> Vec<RehearsedEffect> {
    effects.sort_by(|a, b| found_multiple(a).total_cmp(&found_multiple(b)));
    effects
}

/// From how many sizes of interest on an effect is found.
fn found_multiple(effect: &RehearsedEffect) -> f64 {
    match effect.found {
        // Before those that were missed at a smaller size.
        FoundFrom::Below(size) => size / effect.interest * 0.5,
        FoundFrom::Size(size) => size / effect.interest,
        FoundFrom::Never => f64::INFINITY,
    }
}

/// Why an effect cannot be seen in these recordings, whatever its size; `None` where it can.
fn unseen(common: &Common<'_>, plan: &Plan, hidden: &Hidden) -> Option<&'static str> {
    let doses = |replica: usize| plan.sizes.iter().rev().find_map(|m| hidden.dose(*m, plan.seed, replica));
    // Both sides, both axes.
    let doses: Vec<Dose> = (0..2).filter_map(doses).collect();
    if doses.is_empty() || (0..plan.replicas).any(|replica| hidden.dose(plan.sizes[0], plan.seed, replica).is_none()) {
        return Some(BEYOND);
    }
    let changes = |dose: &Dose| common.recordings.iter().any(|template| changes(common, template, dose));
    if doses.iter().any(changes) { None } else { Some(UNSEEN) }
}

/// Whether an effect changes a sample that is recorded; a simulation that fails is a change.
fn changes(common: &Common<'_>, template: &Template, dose: &Dose) -> bool {
    let robot = &common.case.robot;
    let given = common.case.effects.doses(&template.run.name);
    let ideal = |hidden| template.ideal(robot, &given, hidden, common.options);
    let (Ok(without), Ok(with)) = (ideal(None), ideal(Some(dose))) else { return true };
    CHANNELS.into_iter().enumerate().any(|(place, signal)| {
        let Some(least) = common.sigmas[place].map(|sigma| SETTINGS.seen.nothing * sigma) else { return false };
        let Some((a, b)) = without.get(signal).zip(with.get(signal)) else { return false };
        let recorded = channel(&template.run, place).iter().map(Option::is_some);
        let differ = a.values().iter().zip(b.values()).zip(recorded);
        differ.into_iter().any(|((a, b), is_recorded)| is_recorded && (a - b).abs() > least)
    })
}

/// Rehearses a case: which effects a diagnosis would find on its robot and its inputs, from which
/// size on, and how often it would alarm falsely. `listener` is told what was diagnosed, from any
/// thread.
///
/// # Errors
/// A plan with which nothing can be simulated, and a case that cannot be diagnosed.
pub fn rehearse(
    case: &Case,
    plan: &Plan,
    options: &Options,
    listener: &(dyn Fn(&str) + Sync),
) -> Result<Rehearsal, RehearsalError> {
    Rehearsing::new(case, plan, options)?.run(listener)
}
