//! Diagnosis of a speed-driven robot from the loads of its steady driving.
//!
//! A drive imposes the wheel speeds; what it takes to do so is the output. Real recordings of this kind are slow,
//! unsigned and on wandering clocks, so only steady stretches are compared: their loads are measured and compared with
//! the references', the effects that could make the difference are named, and recordings that were not used are forecast.
//!
//! # Files
//!
//! * `run`, `stamps`, `body_rates`, `clock`: speeds and currents of a recording; a gyro on another clock, aligned by the
//!   turns; an accelerometer.
//! * `standstill`: a robot that stands although it is commanded to drive, `encoders`: one that shows another speed of a side than there is;
//!   such rows leave all else.
//! * `extract`: loads of steady stretches, each with its standard error or why it is withheld.
//! * `compare`: loads over those of the references.
//! * `model`, `comparison`, `name`: loads that the plant predicts, and which effects could make them differ.
//! * `answer`, `cause`, `found`: probabilities, classes, limits; causes that were measured where and when they are.
//! * `speeds`: speeds that are measured with noise, and those that are commanded.
//! * `guesses`: what a mapping may have wrong.
//! * `sentences`, `headline`, `words`: the answer in sentences, what leads them, their parts.
//! * `straight`, `level`, `jumps`: when the straight load changes inside a recording.
//! * `mounting`: how the inertial unit leans in the body; `zero`, `gyro_zero`: what current
//!   sensors read when nothing flows, and a gyro while the robot stands.
//! * `power`: signs of torques that no robot can have.
//! * `plane`, `directed_pull`: one slope under all driving, by loads and directions of travel; `body_pull`: a pull along the body.
//! * `following`, `pulses`, `tipping`: sides that do not turn as commanded, loads that rise and fall, units that tip.
//! * `changes`, `attitude`, `slopes`: whether a slope or the ground does it; `changed`, `marking`: rows that show that; `slope_pull`: what a slope pulls,
//!   taken off.
//! * `drift`: a side whose wheels roll as if they had another radius.
//! * `scrub`, `turning`: turning on other ground, turning without a gyro.
//! * `grounds`, `groups`, `ground`: several grounds in one recording or in several, soft ground as one cause.
//! * `law`, `forecast`, `traces`: rows that were left out of a fit, forecast and drawn.
//! * `replica`: loads drawn about those of a case, of which it is known what is missing.
//! * `settings`: every tuned number.
//! * `next`: which steady loads would tell the remaining effects apart.

mod answer;
mod attitude;
mod body_pull;
mod body_rates;
mod cause;
mod changed;
mod changes;
mod clock;
mod compare;
mod comparison;
mod directed_pull;
mod drift;
mod encoders;
mod extract;
mod following;
mod forecast;
mod found;
mod ground;
mod grounds;
mod groups;
mod guesses;
mod gyro_zero;
mod heading;
mod headline;
mod jumps;
mod law;
mod level;
mod marking;
mod model;
mod mounting;
mod name;
mod next;
mod one_side;
mod pieces;
mod plane;
mod power;
mod pulses;
mod replica;
mod rows;
mod run;
mod scrub;
mod sentences;
mod settings;
mod slope_pull;
mod slope_sentences;
mod slopes;
mod speeds;
mod stamps;
mod standstill;
mod straight;
#[cfg(test)]
mod testing;
#[cfg(test)]
mod tests;
mod tipping;
mod traces;
mod turning;
mod words;
mod zero;

use robot_model::Robot;
use robot_model::effects::wheel_radius_mismatch;
use robot_model::tunable::{COUNT as NUISANCES, place_of, tunables, tuned};
use verdict::{ClockError, Diagnosis, Forecast, FreeRun, Load, Loads, Quantity, Verdict, Withheld};

use crate::next::advise_steady;
use inference::{DiagnosisError, Options, gyro_beside_pose};

use answer::{limits, verdict};
use compare::{Reference, references};
use comparison::{Comparison, differences, of_reference};
use grounds::Measured;
use model::tune;
use name::{Open, name};
use pieces::{ByClass, Usual};

pub use body_rates::BodyRates;
pub use clock::{Alignment, align, box_mean};
pub(crate) use model::{Operating, Tuned, predicted, sensitivity};
pub(crate) use name::{Named, Naming};
pub use replica::Replicas;
pub use run::SpeedRun;
use traces::{Fits, Forecasts};

/// Every tuned number of this crate, for the page of settings.
pub fn settings() -> impl Iterator<Item = &'static ::settings::Setting> {
    settings::all()
}

/// The README's snippet, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;

/// A speed-driven case.
#[derive(Debug, Clone)]
pub struct SteadyCase {
    /// The user's robot model.
    pub robot: Robot<f64>,
    /// One sigma of each tunable constant.
    pub sigma: [f64; NUISANCES],
    /// One sigma of the torque per current, relative.
    pub torque_sigma: f64,
    /// One sigma of the wheels' radius and of the track, relative.
    pub geometry_sigma: [f64; 2],
    /// Recordings in which the simulation is right; without any, the robot file says what is right.
    pub references: Vec<SpeedRun>,
    /// Recordings in which it is not.
    pub recordings: Vec<SpeedRun>,
}

impl SteadyCase {
    /// Torque of the robot's weight at a wheel's radius, N m, and by which share torques may be off against it.
    fn weight(&self, robot: &Robot<f64>) -> (f64, f64) {
        let of_mass = place_of("mass").map_or(0.0, |place| self.sigma[place]);
        (robot.mass * robot.gravity * robot.wheel_radius, self.torque_sigma.hypot(of_mass))
    }

    /// One sigma of a quantity, on the scale on which it is compared, that the plant's constants do not hold.
    fn sigma_beside_constants(&self, quantity: Quantity) -> f64 {
        let [radius, track] = self.geometry_sigma;
        match quantity {
            Quantity::EffectiveTrack => radius.hypot(track),
            // Of two radii that are known as well as that.
            Quantity::Drift => radius * std::f64::consts::SQRT_2,
            Quantity::Asymmetry | Quantity::SpinAsymmetry => 0.0,
            _ => self.torque_sigma,
        }
    }
}

/// Diagnoses a speed-driven case; of the options those count that say whether to advise on the next drive and whether the
/// robot is as it was.
/// `progress` is called with the stage that begins.
///
/// # Errors
/// When there is no recording, or nothing permits any answer.
pub fn diagnose_steady(
    case: &SteadyCase,
    options: &Options,
    progress: &dyn Fn(&str),
) -> Result<Diagnosis, DiagnosisError> {
    if case.recordings.is_empty() {
        return Err(DiagnosisError::Empty { what: "recording" });
    }
    let robot = case.robot.checked()?;
    progress("measuring steady loads");
    // A body that stands has neither loads nor a track: its rows are marked before anything is measured.
    let mut marked = case.clone();
    let zeros = take_off_zeros(&mut marked);
    power::check(marked.references.iter().chain(&marked.recordings))?;
    let of_file = standstill::track_of_file(&robot);
    let standing_references = standstill::mark(&mut marked.references, of_file);
    let (reference_loads, mut withheld) = all_loads(&marked.references);
    for w in &mut withheld {
        w.recording = format!("reference {}", w.recording);
    }
    let track = track_of(&references(&reference_loads)).unwrap_or(of_file);
    let wrong_speeds = encoders::mark(&marked.references, &mut marked.recordings, track);
    let mut standstills = standstill::mark(&mut marked.recordings, track);
    let unfollowed = following::unfollowed(&marked.references, &marked.recordings, case.torque_sigma);

    let by_file = case.references.is_empty();
    let references_of = |loads: &[Load]| {
        if by_file { from_file(case, &robot, loads) } else { references(&reference_loads) }
    };

    // What changes inside a recording is reported by itself: the load of the whole recording is measured without it.
    let leans = mounting::set_upright(&mut marked.references, &mut marked.recordings);
    attitude::set_level(&marked.references, &mut marked.recordings);
    let usual = usual(&references_of(&all_loads(&marked.recordings).0));
    let usual = if by_file { Usual::of_file(usual) } else { Usual::of_references(usual) };
    let weight = case.weight(&robot);
    let taken_out = marking::take_out(&mut marked, &usual, (weight, robot.wheel_radius));
    standstills.extend(taken_out.standstills.iter().cloned());
    let (of_recordings, not_given) = all_loads(&marked.recordings);
    let refs = references_of(&of_recordings);
    if refs.is_empty() && standstills.is_empty() && wrong_speeds.is_empty() && taken_out.slope.is_none() {
        return Err(too_calm(withheld.iter().chain(&not_given)));
    }

    progress("calibrating on the references");
    let known: Vec<model::Measured> = if by_file { Vec::new() } else { refs.iter().map(of_reference).collect() };
    let calibrated = tune(&robot, &case.sigma, &known).ok_or(DiagnosisError::Singular { stage: "calibration" })?;

    progress("looking into the recordings");
    let as_on_references = tuned(&robot, &case.sigma, &calibrated.theta);
    let by_itself = Loads { standstills, wrong_speeds, unfollowed, references: reference_loads.clone(), ..taken_out };
    let mut loads = within(&marked, &as_on_references, &refs, by_itself);
    let usual = grounds::Usual { references: &refs, robot: &robot, sigma: &case.sigma, calibrated: &calibrated };
    loads.grounds = grounds::grounds(&marked.recordings, &loads, &usual);
    one_side::drop_what_shows_it(&mut loads);
    // Other ground in a part of a recording is reported by itself, too: what is left is the recording's.
    let measured = grounds::leave_out(&mut marked.recordings, &loads, &usual);
    loads.on_grounds = measured == Measured::Grounds;
    let left_out = measured != Measured::Everything;
    let (of_recordings, not_given) = if left_out { all_loads(&marked.recordings) } else { (of_recordings, not_given) };
    let refs = references_of(&of_recordings);
    let usual = grounds::Usual { references: &refs, robot: &robot, sigma: &case.sigma, calibrated: &calibrated };
    (loads.ratios, loads.pooled) = usual.ratios(&of_recordings);
    loads.withheld = withheld;
    let case = &marked;

    progress("weighing the effects");
    let differences = differences(&of_recordings, &refs);
    let open = Open::of(&case.recordings, &loads, &differences, weight.0).same_robot(options.same_robot);
    let comparison = Comparison::new(&differences, &robot, &case.sigma, &calibrated);
    let naming = comparison.as_ref().and_then(|c| name(c, open));
    loads.drift = comparison.as_ref().and_then(Comparison::side_drift);
    loads.groups = groups::groups(&loads, &differences, &usual, open);

    progress("forecasting recordings that were not used");
    let fits = Fits {
        case,
        robot: &robot,
        known: &known,
        differences: &differences,
        calibrated: &calibrated,
        naming: naming.as_ref(),
    };
    let (forecasts, correction) = (fits.forecasts(), fits.correction());
    withhold(&mut loads, not_given);
    let inner: Vec<FreeRun> = loads.forecasts.iter().map(Forecast::free_run).collect();

    // The loads alone give a verdict; what was measured beside them may lead over it.
    let (mut out, of_loads) = verdict(case, comparison.as_ref().zip(naming.as_ref()), loads, &forecasts);
    let Forecasts { free_runs, traces, standing, placebo } = forecasts;
    let compared = free_runs.clone();
    out.free_runs = free_runs;
    out.traces = traces;
    out.correction = correction;
    drop_what_loads_do_not_ask_for(&mut out, of_loads);
    out.free_runs.extend(inner);
    out.tuning = tunables::<f64>().iter().zip(calibrated.theta).map(|(t, x)| (t.id.to_owned(), x)).collect();
    out.limits = limits(case, &out);
    out.limits.extend(standing_references.iter().map(words::standing_reference).chain(zeros));
    out.limits.extend(leans.told());
    if of_loads == Verdict::Explained {
        let wrong = placebo.map(Named::name);
        out.limits.extend(standing.and_then(|s| s.doubt(&compared, wrong.as_deref())));
    }

    if options.next.is_some() {
        progress("looking for the drive that tells the rivals apart");
        out.next = Some(advise_steady(fastest(&case.recordings), &robot, &case.sigma, &calibrated, naming.as_ref()));
    }
    Ok(out)
}

/// Nothing permits any answer: the first reason why.
fn too_calm<'a>(mut withheld: impl Iterator<Item = &'a Withheld>) -> DiagnosisError {
    let reason = withheld.next().map_or_else(String::new, |w| format!("{}: {}", w.recording, w.reason));
    DiagnosisError::TooCalm { reason }
}

/// Where the loads lack nothing there is nothing to correct but wheels of another radius.
fn drop_what_loads_do_not_ask_for(out: &mut Diagnosis, of_loads: Verdict) {
    if of_loads == Verdict::NoMismatch {
        let drifts = out.steady.as_ref().is_some_and(|loads| loads.drift.is_some());
        out.correction.effects.retain(|e| drifts && e.effect == wheel_radius_mismatch::SPEC.id);
    }
}

/// Adds what too little steady driving did not give. Where only spins are compared the rest was driven, and is left out.
fn withhold(loads: &mut Loads, not_given: Vec<Withheld>) {
    if loads.slope.is_some_and(|slope| slope.is_level) {
        loads.changes.hidden.clear();
    } else {
        loads.withheld.extend(not_given);
    }
}

/// The largest speed of a side, m/s.
fn fastest(runs: &[SpeedRun]) -> f64 {
    runs.iter().flat_map(|run| run.speed.iter().flatten()).fold(0.0, |most, v| most.max(v.abs()))
}

fn all_loads(runs: &[SpeedRun]) -> (Vec<Load>, Vec<Withheld>) {
    let mut loads = Vec::new();
    let mut withheld = Vec::new();
    for r in runs {
        let (l, w) = extract::extract(r);
        loads.extend(l);
        withheld.extend(w);
    }
    (loads, withheld)
}

/// The robot file in the place of references: what it predicts where a load was measured, as uncertain as its constants.
fn from_file(case: &SteadyCase, robot: &Robot<f64>, loads: &[Load]) -> Vec<Reference> {
    references(loads)
        .into_iter()
        .map(|r| {
            let at = r.at();
            let centre = predicted(robot, &[], at);
            let by_constants = sensitivity(robot, &case.sigma, &[0.0; NUISANCES], &[at]);
            let beside = case.sigma_beside_constants(r.quantity);
            let error = (0..NUISANCES).map(|k| by_constants[(0, k)].powi(2)).sum::<f64>().sqrt().hypot(beside);
            Reference { centre, error, ..r }
        })
        .collect()
}

/// Effective track of references, m.
fn track_of(refs: &[Reference]) -> Option<f64> {
    refs.iter().find(|r| r.quantity == Quantity::EffectiveTrack).map(|r| r.centre.exp())
}

/// Turns what a gyro shows in drives whose pose says nothing of it into what it would by its share in the others.
fn as_in_the_others(runs: &mut [SpeedRun]) {
    let Some(usual) = gyro_beside_pose::together(runs.iter().filter_map(|run| run.gyro_share)) else { return };
    for run in runs.iter_mut().filter(|run| run.gyro_share.is_none()) {
        run.yaw_rate.iter_mut().flatten().for_each(|rate| *rate /= usual.share);
    }
}

/// Subtracts from currents and yaw rates what their sensors read at rest; returns sentences about it.
fn take_off_zeros(case: &mut SteadyCase) -> Vec<String> {
    as_in_the_others(&mut case.references);
    as_in_the_others(&mut case.recordings);
    let of_currents = zero::remove(&mut case.references, &mut case.recordings).map(zero::told);
    let of_gyros = gyro_zero::remove(&mut case.references, &mut case.recordings);
    of_currents.into_iter().chain(of_gyros).collect()
}

/// Straight load of references by speed class, N m.
fn usual(refs: &[Reference]) -> ByClass {
    let mut out = ByClass::default();
    for r in refs.iter().filter(|r| r.quantity == Quantity::StraightLoad) {
        out[r.class] = Some(r.centre.exp());
    }
    out
}

/// Adds what is inside the recordings beside changes of the straight load: turning, forecasts, clocks.
fn within(case: &SteadyCase, robot: &Robot<f64>, refs: &[Reference], known: Loads) -> Loads {
    let of = |quantity: Quantity| refs.iter().filter(move |r| r.quantity == quantity);
    let straight = usual(refs).iter().flatten().next().copied();
    let sides = scrub::Sides::of(&case.references);
    let turning_load = of(Quantity::SpinSum).chain(of(Quantity::ArcSum)).next().map(|r| r.centre.exp());
    let track = track_of(refs);
    let nominal =
        straight.map(|s| forecast::Nominal::new(&case.references, s, track.unwrap_or(2.0 * robot.half_track)));
    let shares = |runs: &[SpeedRun]| runs.iter().filter_map(|run| run.gyro_share).collect::<Vec<_>>();
    let gyro = gyro_beside_pose::compared(shares(&case.references), shares(&case.recordings));
    let mut out = Loads { gyro, ..known };
    for run in &case.recordings {
        out.turning_changes.extend(scrub::turning_changes(run, robot, turning_load, sides));
        let alike = (0..run.time.len()).all(|i| run.difference(i).abs() < 1e-9);
        if let Some(straight) = straight.filter(|_| alike && run.yaw_rate.is_none()) {
            out.turning.extend(turning::turning(run, straight));
        }
        if let Some(nominal) = &nominal {
            out.forecasts.extend(forecast::forecasts(run, nominal));
        }
    }
    let of_references = case.references.iter().filter_map(clock_error).map(|mut clock| {
        clock.recording.insert_str(0, "reference ");
        clock
    });
    out.clocks = of_references.chain(case.recordings.iter().filter_map(clock_error)).collect();
    out
}

/// How well a recording's clocks were aligned; `None` where there is one clock only.
fn clock_error(run: &SpeedRun) -> Option<ClockError> {
    let alignment = run.alignment.as_ref()?;
    let lag = alignment.lag.iter().fold([f64::MAX, f64::MIN], |[a, b], l| [a.min(*l), b.max(*l)]);
    (lag != [0.0; 2]).then(|| ClockError {
        recording: run.name.clone(),
        lag,
        error: alignment.error(),
        left_out: alignment.left_out.clone(),
    })
}
