//! Diagnosis of a command-driven robot: commanded and measured wheel speeds and the motion of the body, no torque.
//!
//! The simulation says that the wheels do what is commanded and that the body rolls without slip on the nominal track.
//! Two parts are fitted one after the other, command to wheel (`drive`) and wheel to body (`ground`); an
//! element stays when it improves forecasts of 2 s windows that were left out of the fit, judged over command steps.
//!
//! # Files
//!
//! * `run`, `windows`: command, wheels and body on one grid; windows of 2 s and command steps.
//! * `controller`, `drive`: from command to wheel, the law and its fit.
//! * `ground`: from wheel to body: rolling radius, effective track, slip in turns, lag.
//! * `search`, `identify`, `identified`: which elements improve forecasts of windows that were left out.
//! * `known`: how well fitted constants are known.
//! * `common`: one response for references and recordings, but for what has to differ.
//! * `onset`: another response from an instant on inside recordings.
//! * `compare`, `traces`: left-out windows forecast by four simulations, and drawn.
//! * `left`, `squares`: what the best answer leaves, where, and whether its cause is unknown.
//! * `moved`: radius and track that the robot file may have wrong.
//! * `name`, `element_words`, `words`: elements as causes with intervals; sentences.
//! * `next/*`: which commands would tell the remaining responses apart.
//! * `model`: a fitted response as a model of its own, run forward.
//! * `replica`: the same commands driven by a response that is known, for rehearsals.
//! * `settings`: every tuned number, with unit and source.

mod common;
mod compare;
mod controller;
mod drive;
mod element_words;
mod ground;
mod identified;
mod identify;
mod known;
mod left;
mod model;
mod moved;
mod name;
mod next;
mod onset;
mod replica;
mod run;
mod search;
mod settings;
mod squares;
#[cfg(test)]
mod testing;
#[cfg(test)]
mod tests;
mod traces;
mod windows;
mod words;

use inference::robust::mean_with_error;
use robot_model::Robot;

use catalogue::answer::{NONE, UNKNOWN};
use inference::{DiagnosisError, Options, gyro_beside_pose};
use verdict::{Cause, Diagnosis, Element, GyroBesidePose, Response, Verdict};

use crate::settings::SETTINGS;
use compare::{Errors, Rivals, free_runs, left_out, summary};
use identified::{Identified, beyond_common, identify};
use identify::{Base, OfDrive, OfGround, neutral};
use inference::experiment::{Comparison, Standing, leave_out};
use left::Fitted;
use moved::moved;
use windows::{FOLDS, Windows};
use words::Figures;

pub use model::{response_errors, simulate_response};
pub use replica::{Hideable, Replicas};
pub use run::{ResponseRun, STEP};

/// Every tuned number of this crate, for the page of settings.
pub fn settings() -> impl Iterator<Item = &'static ::settings::Setting> {
    settings::Settings::ALL.iter()
}

/// The README's snippet, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;

/// A command-driven case.
#[derive(Debug, Clone)]
pub struct ResponseCase {
    /// The user's robot model: wheel radius and track.
    pub robot: Robot<f64>,
    /// One sigma of wheel radius and track, as a share of each, as the robot file states them.
    pub geometry_sigma: [f64; 2],
    /// Recordings in which the simulation is right; without any, the simulation is "the wheels do what is commanded,
    /// the body rolls without slip on the nominal track".
    pub references: Vec<ResponseRun>,
    /// Recordings in which it is not.
    pub recordings: Vec<ResponseRun>,
    /// Recordings that no fit may see: forecasts are compared with them.
    pub held_out: Vec<ResponseRun>,
}

/// What an onset does to the answer.
const ONE_ONSET: &str = "what begins inside a recording is taken to begin once in it and to stay: the corrected robot \
    file, and forecasts of held-out recordings, have the response since then";

/// Steps without which nothing can be left out in folds.
const LEAST_STEPS: usize = SETTINGS.windows.steps_per_fold * FOLDS;

/// Diagnoses a command-driven case; of the options only whether to advise on the next drive counts. `progress` is called with the stage that begins.
///
/// # Errors
/// When recordings are missing or hold too few command steps.
pub fn diagnose_response(
    case: &ResponseCase,
    options: &Options,
    progress: &dyn Fn(&str),
) -> Result<Diagnosis, DiagnosisError> {
    if case.recordings.is_empty() {
        return Err(DiagnosisError::Empty { what: "recording" });
    }
    let robot = case.robot.checked()?;
    let nominal = [robot.wheel_radius, 2.0 * robot.half_track];
    let windows = enough(&case.recordings, "recordings")?;
    let (base, found, floor) = beyond_references(case, &windows, nominal, progress)?;
    progress("forecasting windows that were left out");
    let rivals = Rivals::new(&windows, &base, &found, nominal);
    let folds = leave_out(&rivals);
    let unseen = Windows::new(&case.held_out);
    let left_out = left_out(&folds);
    let has_position = case.recordings.iter().any(ResponseRun::has_position);
    let mut runs = free_runs("left out in folds", &left_out, has_position);
    let standing = Standing::new(&runs);
    let objection = standing.as_ref().and_then(|standing| standing.objection(None));
    // Each element has a proof of its own, on rows that follow each other; together they have to forecast better than none: than what
    // was given, of what re-tuning changes too, and than re-tuned constants, of all else.
    let confirms = |ratio: f64| ratio < SETTINGS.answer.confirmed;
    let is_confirmed = standing.as_ref().map_or([true; 2], |s| [s.over_nominal, s.over_retuned].map(confirms));
    let mut figures = figures(&left_out, &rivals.drive_only(None), has_position);
    let [wheel_before, _, wheel_after, ..] = figures.wheel;
    // A law of the wheels that sends the body elsewhere is none.
    let [yaw_before, _, yaw_after, ..] = figures.yaw;
    let is_contradicted = found.drive.constants() > 0 && yaw_after > SETTINGS.answer.contradicted * yaw_before;
    let closed = (wheel_before.powi(2) - wheel_after.powi(2)).max(0.0).sqrt() / windows.speed().max(f64::MIN_POSITIVE);
    let is_drive_confirmed = confirms(wheel_after / wheel_before.max(f64::MIN_POSITIVE))
        && closed > SETTINGS.answer.closed
        && !is_contradicted;
    if !unseen.list.is_empty() {
        let errors = rivals.unseen(&unseen);
        let position = case.held_out.iter().any(ResponseRun::has_position);
        runs.extend(free_runs("held out", &errors, position));
        figures = self::figures(&errors, &rivals.drive_only(Some(&unseen)), position);
    }
    let response = response(&windows, unseen.list.len(), &base, &found, rivals.constants, nominal);
    let mut remains = left::remains(
        &case.recordings,
        &Fitted { windows: &windows, folds: &folds, base: &base, found: &found, nominal },
        floor,
        objection.is_some(),
    );
    if is_contradicted {
        remains.doubt_wheels(1.0 - SETTINGS.answer.unconfirmed);
    }
    let (_, off_error) = mean_with_error(&windows.by_block(|w| left_out.nominal[0][w]));
    let mut out = Diagnosis::withheld();
    let off = [summary(&left_out.nominal[0])[0], off_error];
    let moved = moved(case, nominal, &response.parameters);
    out.ranked = name::ranked(
        &found,
        &response.parameters,
        &moved,
        (off, nominal[1]),
        (&remains, &base, [is_confirmed[0], is_confirmed[1], is_drive_confirmed]),
        &case.recordings,
    );
    let is_named = |c: &Cause| c.probability > SETTINGS.left.likely && ![NONE.id, UNKNOWN.id].contains(&&*c.effect);
    out.retuned = moved.iter().filter(|m| m.is_retuned()).map(|m| m.retuned.clone()).collect();
    out.verdict = if remains.mostly > SETTINGS.left.likely {
        Verdict::Unknown
    } else if out.ranked.iter().any(is_named) {
        Verdict::Explained
    } else {
        Verdict::NoMismatch
    };
    out.free_runs = runs;
    if out.verdict != Verdict::NoMismatch {
        out.unexplained = Some(remains.share);
        out.located.remainder = Some(remains.remainder());
        out.located.spans.clone_from(&remains.spans);
    }
    out.tuning = name::tuning(&response.parameters);
    out.limits = limits(case, has_position, &response);
    out.limits.extend(is_contradicted.then(|| words::contradicted([yaw_before, yaw_after])));
    if !response.parameters.is_empty() {
        let ratio = standing.as_ref().map(|s| s.over_retuned).filter(|_| !is_confirmed.contains(&true));
        let doubt = standing.as_ref().and_then(|standing| standing.doubt(&out.free_runs, None));
        out.limits.extend(ratio.map(words::not_taken).or(doubt));
    }
    let of_drive = words::begun(&OfDrive, &found.drive, &case.recordings);
    let of_ground = words::begun(&OfGround { nominal }, &found.ground, &case.recordings);
    let begun: Vec<String> = of_drive.into_iter().chain(of_ground).collect();
    out.located.spans.extend(name::onsets(&found, &case.recordings));
    if !begun.is_empty() {
        out.limits.push(ONE_ONSET.to_owned());
    }
    let all = !case.references.is_empty();
    out.sentences = words::sentences(&out, &response, (&figures, is_drive_confirmed), nominal[1], all, &remains, begun);
    let shares = |runs: &[ResponseRun]| runs.iter().filter_map(|run| run.gyro_share).collect::<Vec<_>>();
    let gyro = gyro_beside_pose::compared(shares(&case.references), shares(&case.recordings));
    gyro.filter(|gyro| gyro.is_off).iter().for_each(|gyro| add_gyro(&mut out, gyro));
    out.traces = traces::traces(&case.recordings, &windows, &folds);
    let corrected = Base { drive: found.drive.model.clone(), ground: found.ground.model.clone() };
    let corrected = if is_confirmed.contains(&true) { &corrected } else { &base };
    out.correction.response = Some(model::model_of(corrected));
    out.response = Some(response);
    out.next = options.next.map(|length| {
        progress("simulating the next drive");
        next::advise(&windows, &base, &found, nominal, remains.mostly, length)
    });
    Ok(out)
}

/// Adds a gyro whose scale is off beside the pose: a response is fitted to the pose, and does not see it.
fn add_gyro(out: &mut Diagnosis, gyro: &GyroBesidePose) {
    let cause = gyro_beside_pose::cause(gyro);
    for none in out.ranked.iter_mut().filter(|c| c.effect == NONE.id) {
        none.probability = none.probability.min(1.0 - cause.probability);
    }
    out.indistinguishable.push(vec![cause.effect.clone()]);
    out.ranked.push(cause);
    out.ranked.sort_by(|a, b| b.probability.total_cmp(&a.probability));
    if out.verdict == Verdict::NoMismatch {
        out.verdict = Verdict::Explained;
        let others = out.sentences.drain(..).skip(1);
        out.sentences =
            [gyro_beside_pose::told(gyro), words::NOTHING_ELSE.to_owned()].into_iter().chain(others).collect();
    } else {
        out.sentences.push(gyro_beside_pose::told(gyro));
    }
}

/// What the simulation says, what recordings show beyond it, and what the fit of the references leaves.
fn beyond_references(
    case: &ResponseCase,
    windows: &Windows,
    nominal: [f64; 2],
    progress: &dyn Fn(&str),
) -> Result<(Base, Identified, Option<left::Floor>), DiagnosisError> {
    if case.references.is_empty() {
        let base = neutral(windows);
        let found = identify(windows, &base, nominal, progress);
        return Ok((base, found, None));
    }

    let references = enough(&case.references, "references")?;
    let plain = neutral(&references);
    let known = identify(&references, &plain, nominal, &|_| progress("fitting the references"));
    let folds = leave_out(&Rivals::new(&references, &plain, &known, nominal));
    let floor = left::floor(&Fitted { windows: &references, folds: &folds, base: &plain, found: &known, nominal });
    let base = Base { drive: known.drive.model.clone(), ground: known.ground.model.clone() };
    let found = identify(windows, &base, nominal, progress);
    let own = (base, found);
    let common = beyond_common([&references, windows], &known, own.clone(), nominal);
    // What both share explains nothing where it leaves more than is usual, and a response of the recordings' own does not.
    let is_unknown = |(base, found): &(Base, Identified)| {
        left_by(case, windows, (base, found), Some(floor), nominal).mostly > SETTINGS.left.likely
    };
    let common = common.filter(|common| !is_unknown(common) || is_unknown(&own));
    let (base, found) = common.unwrap_or(own);
    Ok((base, found, Some(floor)))
}

/// What a response leaves of the recordings.
fn left_by(
    case: &ResponseCase,
    windows: &Windows,
    (base, found): (&Base, &Identified),
    floor: Option<left::Floor>,
    nominal: [f64; 2],
) -> left::Remains {
    let folds = leave_out(&Rivals::new(windows, base, found, nominal));
    let has_position = case.recordings.iter().any(ResponseRun::has_position);
    let standing = Standing::new(&free_runs("left out in folds", &left_out(&folds), has_position));
    let is_doubted = standing.and_then(|standing| standing.objection(None)).is_some();
    left::remains(&case.recordings, &Fitted { windows, folds: &folds, base, found, nominal }, floor, is_doubted)
}

fn enough(runs: &[ResponseRun], what: &'static str) -> Result<Windows, DiagnosisError> {
    let windows = Windows::new(runs);
    if windows.blocks < LEAST_STEPS {
        return Err(DiagnosisError::FewSteps { what, steps: windows.blocks, needed: LEAST_STEPS });
    }
    Ok(windows)
}

fn response(
    windows: &Windows,
    held_out_windows: usize,
    base: &Base,
    found: &Identified,
    constants: [usize; 2],
    nominal: [f64; 2],
) -> Response {
    let [of_drive, of_ground] = name::simulated(base);
    let mut parameters = name::parameters_of(&OfDrive, windows, &found.drive, of_drive);
    parameters.extend(name::parameters_of(&OfGround { nominal }, windows, &found.ground, of_ground));
    parameters.retain(|p| !found.shared.contains(&p.element));
    let law = found.drive.model.law;
    Response {
        windows: windows.list.len(),
        steps: windows.blocks,
        held_out_windows,
        scaling: found.drive.has(Element::WheelLimit).then(|| law.scaling.words().into()),
        scaling_is_told: found.scaling_is_told,
        scaled_after_ramps: law.after_ramp,
        parameters,
        elements: found.evidence.iter().map(name::earned).collect(),
        alternatives: found.alternatives.clone(),
        constants,
    }
}

/// The figures of the sentences: rms over windows.
fn figures(errors: &Comparison<Errors>, drive_only: &Errors, has_position: bool) -> Figures {
    let of = |q: usize| {
        let rms = errors.map(|e| summary(&e[q])[0]);
        let placebo = rms.placebo.unwrap_or(f64::NAN);
        [rms.nominal, rms.retuned, *rms.best(), placebo, summary(&drive_only[q])[0]]
    };
    Figures { wheel: of(0), position: has_position.then(|| of(1)), yaw: of(2) }
}

fn limits(case: &ResponseCase, has_position: bool, r: &Response) -> Vec<String> {
    let mut out = Vec::new();
    let hold = case.recordings.iter().map(|r| r.hold).fold(0.0, f64::max);
    if hold > SETTINGS.recording.telling_hold {
        out.push(format!(
            "the recorded wheel speeds change every {hold:.2} s only: dead time and lag together \
             may come out up to {:.2} s too long",
            0.5 * hold
        ));
    }
    if !has_position {
        out.push(
            "a heading but no position was recorded: rolling radius and forward slip cannot \
                  be determined"
                .to_owned(),
        );
    }
    if case.references.is_empty() {
        out.push(
            "no references were given: the simulation is taken as \"wheels do what is commanded, \
             no slip, nominal track\"; a command logged in other units than it was sent in then \
             appears as a gain of the drive"
                .to_owned(),
        );
    }
    for p in r.parameters.iter().filter(|p| p.at_bound) {
        out.push(format!("{} came out at the limit of its sensible range: {}", p.id, p.value));
    }
    out.push("no torque and no current are used: friction, mass and adhesion cannot be determined".to_owned());
    let floor = if case.references.is_empty() {
        "the scatter of neighbouring samples tells the noise of wheels and pose: a disturbance that changes from sample to \
         sample is taken for noise, and"
    } else {
        "what the fit of the references leaves is taken for usual, and"
    };
    out.push(format!(
        "{floor} one whose errors are below {:.0} % of the motion, or that shows in one command step only, is not called \
         unknown",
        100.0 * SETTINGS.left.interest
    ));
    out
}
