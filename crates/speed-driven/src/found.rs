//! Causes that were measured, beside those that the loads of whole recordings name: a body that stands, intervals that
//! exclude no difference, changes inside recordings.

use std::collections::BTreeMap;

use catalogue::answer::{NONE, UNKNOWN};
use catalogue::command_driven::EFFECTIVE_TRACK;
use catalogue::speed_driven::{SOFT_GROUND, STANDING};
use inference::gyro_beside_pose;
use inference::robust::NINETY;
use robot_model::effect::LoadTerm;
use robot_model::effects::{coulomb_side, encoder_scale, gyro_scale, payload, wheel_radius_mismatch};
use statrs::distribution::{ContinuousCDF, Normal};
use verdict::{
    Cause, Changes, Diagnosis, GroundSlope, LoadChange, Loads, OtherGround, Quantity, Ratio, SideChange, SideDrift,
    Standstill, TurningChange, Verdict, WrongSpeed,
};

use crate::body_pull;
use crate::cause::cause;
use crate::compare::{Judgement, judgement, reported, sigmas};
use crate::following;
use crate::name::{Named, Naming};
use crate::pieces::GRADE;
use crate::pulses;
use crate::settings::{CHANGES, NAMING, naming::Answer};
use crate::tipping;

const ANSWER: Answer = NAMING.answer;

/// Adds what was found; the verdict follows. Where the loads name no cause, ratios whose intervals exclude no difference are
/// causes to look for, then changes inside recordings; a body that stands is one always, and comes first.
pub(crate) fn add(out: &mut Diagnosis, naming: Option<&Naming>, loads: &Loads) {
    for difference in strongest(loads).into_iter().filter(|r| r.quantity != Quantity::EffectiveTrack) {
        nothing_at_most(out, 1.0 - differs(difference));
    }
    // No drive train makes another ground of a stretch.
    if loads.on_grounds && out.verdict == Verdict::Explained {
        nothing_at_most(out, 1.0 - ANSWER.changed);
    }
    if matches!(out.verdict, Verdict::NoMismatch | Verdict::Withheld) {
        for difference in strongest(loads) {
            match difference.quantity {
                Quantity::EffectiveTrack => insert(out, tracks(difference, loads.gyro.is_some())),
                _ => insert_fitting(out, naming),
            }
        }
        if out.verdict != Verdict::Explained {
            for class in changes(loads) {
                insert(out, class);
            }
        }
    }
    // What no law of the catalogue explains stays unexplained beside what was measured by itself.
    let is_unknown = out.verdict == Verdict::Unknown;
    // A slope whose tilt sensors measured is one whatever the loads are like.
    if out.verdict != Verdict::NoMismatch && !out.indistinguishable.iter().flatten().any(|id| *id == GRADE) {
        let found = measured_slopes(loads).cloned().collect();
        for class in changes(&Loads { changes: Changes { found, ..Changes::default() }, ..Loads::default() }) {
            insert(out, class);
        }
    }
    // The last one leads.
    if let Some(slope) = loads.slope.as_ref().filter(|slope| !slope.is_level) {
        lead(out, vec![slopes(slope)]);
    }
    if let Some(drift) = &loads.drift {
        lead(out, drifts(drift));
    }
    if let Some(gyro) = loads.gyro.as_ref().filter(|gyro| gyro.is_off) {
        lead(out, vec![gyro_beside_pose::cause(gyro)]);
    }
    if let Some(pull) = &loads.pull {
        lead(out, body_pull::causes(pull, ANSWER.changed));
    }
    for tipped in &loads.tipped {
        lead(out, vec![tipping::cause(tipped, ANSWER.changed)]);
    }
    for pulsing in &loads.pulsing {
        lead(out, pulses::causes(pulsing, ANSWER.changed));
    }
    for unfollowed in &loads.unfollowed {
        lead(out, vec![following::cause(unfollowed, ANSWER.changed)]);
    }
    for cause in wrong_encoders(&loads.wrong_speeds) {
        lead(out, vec![cause]);
    }
    if let Some(cause) = standing(&loads.standstills) {
        lead(out, vec![cause]);
    }
    let is_pulled = loads.slope.is_some_and(|slope| slope.is_level);
    if is_pulled {
        insert(out, vec![Cause::plain(UNKNOWN.id, UNKNOWN.name, ANSWER.changed)]);
    }
    let leads = || out.ranked.first().is_some_and(|first| first.effect == UNKNOWN.id);
    if is_unknown || leads() {
        out.verdict = Verdict::Unknown;
    }
}

/// A slope under all driving.
fn slopes(slope: &GroundSlope) -> Cause {
    let name = catalogue::find(&GRADE).map_or("", |entry| entry.label());
    Cause {
        magnitude: Some(slope.slope.to_radians()),
        sigma: Some(slope.half.to_radians() / NINETY),
        unit: "rad".into(),
        ..Cause::plain(&GRADE, name, ANSWER.changed)
    }
}

/// Whether a ratio is no finding of its own: what it is about changes inside each of its recordings, so that it is no one value; or it is
/// of the sides, and their wheels have radii of their own; or a track of turns on a slope.
fn is_told_elsewhere(r: &Ratio, loads: &Loads) -> bool {
    if is_by_slope(r, loads) {
        return true;
    }
    let is_of_sides = matches!(r.quantity, Quantity::Asymmetry | Quantity::SpinAsymmetry);
    if r.quantity == Quantity::Drift || (is_of_sides && loads.drift.is_some()) {
        return true;
    }
    let changes_in = |recording: &str| {
        let straight =
            loads.changes.found.iter().map(|c| &c.recording).chain(loads.side_changes.iter().map(|c| &c.recording));
        let turning = loads.turning_changes.iter().map(|c| &c.recording);
        let is_here = |other: &String| other == recording;
        loads.grounds.iter().any(|g| g.recording == recording)
            || match r.quantity {
                Quantity::StraightLoad | Quantity::Asymmetry => straight.into_iter().any(is_here),
                Quantity::TurningLoad | Quantity::ArcSum | Quantity::SpinSum => turning.into_iter().any(is_here),
                Quantity::EffectiveTrack | Quantity::SpinAsymmetry | Quantity::Drift => false,
            }
    };
    r.recording.split(", ").all(changes_in)
}

/// Whether a slope under all driving may make this track: the lower wheels carry more, and the body slides down while it turns.
pub(crate) fn is_by_slope(r: &Ratio, loads: &Loads) -> bool {
    r.quantity == Quantity::EffectiveTrack && loads.slope.is_some_and(|slope| !slope.is_level)
}

/// The clearest difference of the effective track and that of the loads, the clearer first.
pub(crate) fn strongest(loads: &Loads) -> Vec<&Ratio> {
    let of = |track: bool| {
        let of_whole = reported(loads).filter(|r| !is_told_elsewhere(r, loads));
        let own = of_whole.filter(|r| (r.quantity == Quantity::EffectiveTrack) == track);
        let is_clear = |r: &&Ratio| r.firm || sigmas(r) > ANSWER.tentative * NINETY;
        own.filter(|r| judgement(r) == Judgement::Differs)
            .filter(is_clear)
            .max_by(|a, b| sigmas(a).total_cmp(&sigmas(b)))
    };
    let mut out: Vec<&Ratio> = [of(true), of(false)].into_iter().flatten().collect();
    out.sort_by(|a, b| sigmas(b).total_cmp(&sigmas(a)));
    out
}

/// Wheels of one side that roll as if they had another radius, or an encoder of that side with another scale.
fn drifts(drift: &SideDrift) -> Vec<Cause> {
    let SideDrift { difference, half, side } = drift;
    // As much more on the right is as much less on the left.
    let size = if side.as_deref() == Some(inference::words::side(0)) { -difference } else { *difference };
    let cause = |id: &str, probability: f64, size: f64, unit: &str| {
        let label = catalogue::find(id).map_or(id, |entry| entry.label());
        let place = side.as_deref().unwrap_or("right, or left the other way round");
        Cause {
            magnitude: Some(size),
            sigma: Some(half / NINETY),
            unit: unit.to_owned().into(),
            side: side.clone(),
            ..Cause::plain(id, &format!("{label}: {place}"), probability)
        }
    };
    let [radius, encoder] = [&wheel_radius_mismatch::SPEC, &encoder_scale::SPEC];
    vec![
        cause(radius.id, ANSWER.drift[0], size, radius.parameters[0].unit),
        // An encoder that shows more makes its side turn less.
        cause(encoder.id, ANSWER.drift[1], 1.0 / (1.0 + size) - 1.0, encoder.parameters[0].unit),
    ]
}

/// Probability that a ratio differs, by its interval.
fn differs(r: &Ratio) -> f64 {
    1.0 - 2.0 * Normal::standard().cdf(-sigmas(r))
}

/// Another effective track; a longer one may be soft ground, and either a gyro that reads another share of the turning, where no pose
/// tells.
pub(crate) fn tracks(r: &Ratio, gyro_is_known: bool) -> Vec<Cause> {
    let spec = EFFECTIVE_TRACK;
    let soft = (r.ratio > 1.0).then(|| Cause::plain(SOFT_GROUND.id, SOFT_GROUND.name, ANSWER.soft * differs(r)));
    let measured = Cause {
        magnitude: Some(r.value),
        sigma: Some(r.half / NINETY),
        unit: spec.unit.into(),
        ..Cause::plain(spec.id, spec.name, differs(r))
    };
    let gyro = Cause {
        magnitude: Some(1.0 / r.ratio - 1.0),
        sigma: Some(r.half / r.value / r.ratio / NINETY),
        unit: gyro_scale::SPEC.parameters[0].unit.into(),
        ..Cause::plain(gyro_scale::SPEC.id, gyro_scale::SPEC.name, ANSWER.gyro * differs(r))
    };
    std::iter::once(measured).chain(soft).chain(Some(gyro).filter(|_| !gyro_is_known)).collect()
}

/// "Nothing is missing" becomes at most as probable as this, as where an interval excludes no difference that there is none after all; the
/// others share what it loses.
fn nothing_at_most(out: &mut Diagnosis, most: f64) {
    let none = |c: &&Cause| c.effect == NONE.id;
    let before = out.ranked.iter().find(none).map_or(0.0, |c| c.probability);
    let after = before.min(most);
    for c in &mut out.ranked {
        let [own, of] = if c.effect == NONE.id { [after, before] } else { [1.0 - after, 1.0 - before] };
        c.probability *= own / of.max(1e-9);
    }
    out.ranked.sort_by(|a, b| b.probability.total_cmp(&a.probability));
}

/// Effects that fit a difference of the loads, though none is likely enough to be named: the best three, the likeliest first.
pub(crate) fn fitting(naming: Option<&Naming>) -> Vec<&Named> {
    let singles = || naming.into_iter().flat_map(|n| &n.effects).filter(|e| e.causes() == 1);
    let most = singles().map(|e| e.gain).fold(0.0, f64::max);
    let mut class: Vec<&Named> = Vec::new();
    for e in singles().filter(|e| e.gain > 0.0 && e.gain >= ANSWER.fits * most) {
        if class.len() < ANSWER.members && class.iter().all(|other| other.ids() != e.ids()) {
            class.push(e);
        }
    }
    class
}

/// Ranks the class of what fits a difference of the loads.
fn insert_fitting(out: &mut Diagnosis, naming: Option<&Naming>) {
    let class = fitting(naming);
    if class.is_empty() {
        // Whatever it is, no law of the catalogue makes it.
        out.verdict = Verdict::Unknown;
        return;
    }
    let ranked = |id: &str| out.ranked.iter().find(|c| c.effect == id).cloned();
    let class = class.into_iter().map(|e| ranked(e.ids()[0]).unwrap_or_else(|| cause(e, 0, 0.0))).collect();
    insert(out, class);
}

/// The side whose torque changes most.
pub(crate) fn largest_side_change(loads: &Loads) -> Option<&SideChange> {
    let by = |c: &SideChange| (c.torque[1] - c.torque[0]).abs();
    loads.side_changes.iter().max_by(|a, b| by(a).total_cmp(&by(b)))
}

/// Slopes inside recordings whose tilt was measured, not inferred from loads, and that are steep beside what wheels resist rolling.
pub(crate) fn measured_slopes(loads: &Loads) -> impl Iterator<Item = &LoadChange> {
    let is_measured = |c: &&LoadChange| c.causes == [GRADE] && c.ratio.is_none() && !c.relative;
    loads.changes.found.iter().filter(is_measured).filter(|c| c.slope.abs() >= CHANGES.slopes.steep)
}

/// Classes of causes of what changes inside recordings.
fn changes(loads: &Loads) -> Vec<Vec<Cause>> {
    let known = |id: &str, of: usize| {
        let name = catalogue::find(id).map_or(id, |entry| entry.label());
        Cause::plain(id, name, ANSWER.changed / of as f64)
    };
    let mut classes: Vec<Vec<Cause>> = Vec::new();
    if let Some(largest) = largest_side_change(loads) {
        // One class: the same causes of another side would take its place.
        let all = loads.side_changes.iter().filter(|c| c.side == largest.side);
        let intervals = by_recording(all.map(|c| (c.recording.as_str(), [c.onset[1], c.until])));
        let [before, after] = largest.torque;
        let sigma = largest.half / NINETY;
        let cause = |id: &verdict::Word| {
            // A brake takes what the side takes more; the torque for a current falls as the current grows.
            let (size, sigma, unit) = if *id == coulomb_side::SPEC.id {
                (after - before, sigma, "N m")
            } else {
                (before / after - 1.0, sigma * (before / after.powi(2)).abs(), "-")
            };
            Cause {
                magnitude: Some(size),
                sigma: Some(sigma),
                unit: unit.into(),
                side: Some(largest.side.clone()),
                intervals: Some(intervals.clone()),
                ..known(id, largest.causes.len())
            }
        };
        classes.push(largest.causes.iter().map(cause).collect());
    }
    for (k, ground) in loads.grounds.iter().enumerate() {
        let alike = |other: &&OtherGround| other.causes == ground.causes;
        if ground.causes.is_empty() || loads.grounds[..k].iter().any(|other| alike(&other)) {
            continue;
        }
        let intervals = by_recording(loads.grounds.iter().filter(alike).map(|g| (g.recording.as_str(), g.interval)));
        let cause = |id: &String| Cause { intervals: Some(intervals.clone()), ..known(id, ground.causes.len()) };
        classes.push(ground.causes.iter().map(cause).collect());
    }
    // What no effect makes as one ground stays what its changes are by themselves.
    let named = || loads.grounds.iter().filter(|g| !g.causes.is_empty());
    let is_alone = |recording: &str, interval| !named().any(|g| g.holds(recording, interval));
    let found: Vec<&LoadChange> =
        loads.changes.found.iter().filter(|c| is_alone(&c.recording, c.interval) || c.causes == [GRADE]).collect();
    for change in &found {
        if classes
            .iter()
            .any(|class| class.iter().map(|c| c.effect.as_str()).eq(change.causes.iter().map(AsRef::as_ref)))
        {
            continue;
        }
        let alike = || found.iter().filter(|c| c.causes == change.causes);
        let intervals = by_recording(alike().map(|c| (c.recording.as_str(), c.interval)));
        let steepest = alike().filter(|c| !c.relative).max_by(|a, b| a.slope.abs().total_cmp(&b.slope.abs()));
        let cause = |id: &verdict::Word| {
            let slope = steepest.filter(|_| *id == GRADE);
            Cause {
                magnitude: slope.map(|c| c.slope.to_radians()),
                sigma: slope.map(|c| c.slope_half.to_radians() / NINETY),
                unit: if *id == GRADE { "rad".into() } else { "-".into() },
                intervals: Some(intervals.clone()),
                ..known(id, change.causes.len())
            }
        };
        classes.push(change.causes.iter().map(cause).collect());
    }
    let turning: Vec<&TurningChange> =
        loads.turning_changes.iter().filter(|c| is_alone(&c.recording, c.interval)).collect();
    if !turning.is_empty() {
        let intervals = by_recording(turning.iter().map(|c| (c.recording.as_str(), c.interval)));
        // Turns one way only do not tell the ground from a side that drags.
        let one_way = turning.iter().all(|c| c.one_way.is_some()) && loads.side_changes.is_empty();
        let mut ids = vec![catalogue::of_load_term(LoadTerm::Turning)];
        ids.extend(one_way.then_some(coulomb_side::SPEC.id));
        // A load is put on once.
        let is_load = matches!(turning[..], [only] if only.from_rest);
        ids.extend(is_load.then_some(payload::SPEC.id));
        let cause = |id: &&str| Cause { intervals: Some(intervals.clone()), ..known(id, ids.len()) };
        classes.push(ids.iter().map(cause).collect());
    }
    classes
}

/// The stretch in which a body stood longest.
pub(crate) fn longest(all: &[Standstill]) -> Option<&Standstill> {
    let seconds = |s: &Standstill| s.interval[1] - s.interval[0];
    all.iter().max_by(|a, b| seconds(a).total_cmp(&seconds(b)))
}

fn standing(all: &[Standstill]) -> Option<Cause> {
    let longest = longest(all)?;
    let intervals = by_recording(all.iter().map(|s| (s.recording.as_str(), s.interval)));
    Some(Cause {
        // A body that is dragged along may turn a little the other way.
        magnitude: longest.wheels.or(longest.share).map(f64::abs),
        side: longest.side.clone().filter(|_| all.iter().all(|s| s.side == longest.side)),
        intervals: Some(intervals),
        ..Cause::plain(STANDING.id, STANDING.name, ANSWER.standing)
    })
}

/// Encoders that show another speed of a side than there is, each side with all its stretches and the size of the longest.
fn wrong_encoders(all: &[WrongSpeed]) -> Vec<Cause> {
    let seconds = |w: &&WrongSpeed| w.interval[1] - w.interval[0];
    let of_side = |side: usize| {
        let side = inference::words::side(side);
        let own = || all.iter().filter(|w| w.side == side);
        let longest = own().max_by(|a, b| seconds(a).total_cmp(&seconds(b)))?;
        Some(Cause {
            magnitude: Some(longest.share - 1.0),
            sigma: Some(longest.half / NINETY),
            unit: encoder_scale::SPEC.parameters[0].unit.into(),
            side: Some(side.into()),
            intervals: Some(by_recording(own().map(|w| (w.recording.as_str(), w.interval)))),
            ..Cause::plain(encoder_scale::SPEC.id, &format!("{}: {side}", encoder_scale::SPEC.name), ANSWER.changed)
        })
    };
    (0..2).filter_map(of_side).collect()
}

/// Where the causes of the loads are, if these are the loads of grounds inside recordings.
pub(crate) fn locate(out: &mut Diagnosis, loads: &Loads) {
    let intervals = by_recording(loads.grounds.iter().map(|g| (g.recording.as_str(), g.interval)));
    let named = out.indistinguishable.iter().flatten();
    for id in named {
        for cause in out.ranked.iter_mut().filter(|c| c.effect == *id) {
            cause.intervals = Some(intervals.clone());
        }
    }
}

fn by_recording<'a>(all: impl Iterator<Item = (&'a str, [f64; 2])>) -> BTreeMap<String, Vec<[f64; 2]>> {
    let mut out: BTreeMap<String, Vec<[f64; 2]>> = BTreeMap::new();
    for (recording, interval) in all {
        out.entry(recording.to_owned()).or_default().push(interval);
    }
    out
}

/// Ranks a class of causes of something that was measured, before all others.
fn lead(out: &mut Diagnosis, class: Vec<Cause>) {
    let is_listed = class.iter().any(|cause| cause.effect != UNKNOWN.id);
    let ids: Vec<String> = class.iter().map(|cause| cause.effect.clone()).collect();
    insert(out, class);
    // Also before what is as probable.
    let is_other = |c: &Cause| !ids.contains(&c.effect);
    out.ranked.sort_by(|a, b| b.probability.total_cmp(&a.probability).then(is_other(a).cmp(&is_other(b))));
    if is_listed {
        out.indistinguishable.rotate_right(1);
    }
}

/// Ranks a class of causes of something that was measured. "Nothing is missing" is then at most as probable as the absence of
/// all of them.
fn insert(out: &mut Diagnosis, class: Vec<Cause>) {
    let ids: Vec<String> = class.iter().map(|c| c.effect.clone()).collect();
    out.indistinguishable.retain(|known| *known != ids);
    // What is not listed is no name that could be confused with another.
    if ids != [UNKNOWN.id] {
        out.indistinguishable.push(ids);
    }
    let left = 1.0 - class.iter().map(|c| c.probability).sum::<f64>().min(1.0);
    for none in out.ranked.iter_mut().filter(|c| c.effect == NONE.id) {
        none.probability = none.probability.min(left);
    }
    for cause in class {
        out.ranked.retain(|c| c.effect != cause.effect);
        out.ranked.push(cause);
    }
    out.ranked.sort_by(|a, b| b.probability.total_cmp(&a.probability));
    out.verdict = Verdict::Explained;
}
