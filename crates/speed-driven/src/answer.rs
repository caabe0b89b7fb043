//! The answer of a speed-driven case: probabilities, classes, what the data's defects do to it.

use std::collections::BTreeSet;

use crate::cause::cause;
use crate::compare::steady_seconds;
use crate::comparison::Comparison;
use crate::found;
use crate::groups::explains;
use crate::guesses::guesses;
use crate::name::{Named, Naming};
use crate::sentences::sentences;
use crate::settings::{NAMING, naming::Answer};
use crate::traces::Forecasts;
use crate::words::clocks;
use crate::{SpeedRun, SteadyCase};
use catalogue::answer::{NONE, UNKNOWN};
use inference::evidence::{is_within_odds, probabilities};
use recordings::Signal;
use verdict::{Cause, Diagnosis, Loads, Verdict};

const ANSWER: Answer = NAMING.answer;

/// The answer, and the verdict of the loads alone.
pub(super) fn verdict(
    case: &SteadyCase,
    compared: Option<(&Comparison, &Naming)>,
    mut loads: Loads,
    forecasts: &Forecasts<'_>,
) -> (Diagnosis, Verdict) {
    let mut out = Diagnosis::withheld();
    let naming = compared.map(|(_, naming)| naming);
    if let Some((comparison, naming)) = compared {
        weigh(naming, &loads, &mut out);
        // Recordings that agree once the named cause is taken off are no groups.
        let is_first = |best: &&Named| out.ranked.first().is_some_and(|c| best.ids().contains(&c.effect.as_str()));
        let best = naming.effects.first().filter(|_| out.verdict == Verdict::Explained).filter(is_first);
        if !loads.groups.is_empty() && best.is_some_and(|best| explains(best, comparison, &loads)) {
            loads.groups.clear();
            loads.agree_by_cause = true;
        }
        // A wrong cause that forecasts left-out recordings as well is in the class.
        let as_good = forecasts.placebo.filter(|_| forecasts.standing.is_some_and(|s| s.is_matched_by_placebo()));
        if let Some(class) = out.indistinguishable.first_mut() {
            let ids = as_good.map_or_else(Vec::new, Named::ids);
            let more: Vec<String> =
                ids.iter().filter(|id| !class.iter().any(|c| c == *id)).map(|id| (*id).to_owned()).collect();
            class.extend(more);
        }
    }
    let of_loads = out.verdict;
    if loads.on_grounds {
        found::locate(&mut out, &loads);
    }
    found::add(&mut out, naming, &loads);
    out.sentences = sentences(&out, of_loads, &loads, case.recordings.iter().any(|r| r.set_points));
    out.steady = Some(loads);
    (out, of_loads)
}

/// What loads that are the same throughout say, without what was measured beside them.
pub(crate) fn of_whole_drives(naming: Option<&Naming>, loads: &Loads) -> Diagnosis {
    let mut out = Diagnosis::withheld();
    if let Some(naming) = naming {
        weigh(naming, loads, &mut out);
    }
    found::add(&mut out, naming, loads);
    out
}

/// Probabilities, kind of answer and classes from the evidence.
fn weigh(naming: &Naming, loads: &Loads, out: &mut Diagnosis) {
    let effects = naming.causes();
    let scores: Vec<f64> = [0.0, naming.unknown].into_iter().chain(effects.iter().map(|e| e.score)).collect();
    let shares = probabilities(&scores, ANSWER.temperature);
    let (none, unknown, of_effects) = (shares[0], shares[1], &shares[2..]);

    out.screened = effects.iter().filter(|e| e.causes() == 1).map(|e| (e.ids()[0].to_owned(), e.score)).collect();

    // An effect is as probable as all hypotheses that contain it. Singles first: its size is that alone, not the one beside
    // another effect.
    let mut causes: Vec<Cause> = Vec::new();
    let (singles, pairs): (Vec<_>, Vec<_>) = effects.iter().zip(of_effects).partition(|(e, _)| e.causes() == 1);
    for (e, &p) in singles.into_iter().chain(pairs) {
        for (part, id) in e.ids().into_iter().enumerate() {
            match causes.iter_mut().find(|c| c.effect == id) {
                Some(c) => c.probability += p,
                None if e.causes() == 1 => causes.push(on_either_side(cause(e, part, p), e, naming)),
                None => causes.push(cause(e, part, p)),
            }
        }
    }

    causes.retain(|c| c.probability > ANSWER.listed);
    causes.push(Cause::plain(NONE.id, NONE.name, none));
    causes.push(Cause::plain(UNKNOWN.id, UNKNOWN.name, unknown));
    causes.sort_by(|a, b| b.probability.total_cmp(&a.probability));
    out.ranked = causes;

    let named = 1.0 - none - unknown;
    out.verdict = if none >= named.max(unknown) {
        // Too little was driven to say that nothing differs.
        let is_enough = steady_seconds(loads).iter().sum::<f64>() >= ANSWER.needed;
        if is_enough { Verdict::NoMismatch } else { Verdict::Withheld }
    } else if unknown > named {
        Verdict::Unknown
    } else {
        Verdict::Explained
    };
    if out.verdict == Verdict::Explained
        && let Some(best) = effects.first()
    {
        out.indistinguishable = (0..best.causes()).map(|k| class(&effects, best, k)).collect();
    }
}

/// A cause of one side, which is on neither where the other side has as much less of it, and the loads do not tell which.
fn on_either_side(cause: Cause, e: &Named, naming: &Naming) -> Cause {
    let size = |named: &Named| named.values.first().copied().unwrap_or(0.0);
    let is_mirrored = |other: &&Named| {
        other.causes() == 1
            && other.ids() == e.ids()
            && other.parts[0].side() != e.parts[0].side()
            && size(other) * size(e) < 0.0
            && is_within_odds(other.score, e.score, ANSWER.indistinguishable)
    };
    let Some(other) = naming.effects.iter().find(is_mirrored) else { return cause };
    let ([more, less], spec) = (if size(e) > 0.0 { [e, other] } else { [other, e] }, e.parts[0].spec());
    let side = |named: &Named| named.parts[0].side().map_or("", inference::words::side);
    Cause { name: format!("{} ({} more, or {} less)", spec.name, side(more), side(less)), side: None, ..cause }
}

/// The likeliest effects that could stand in for one member of the best hypothesis, itself first.
fn class(effects: &[&Named], best: &Named, member: usize) -> Vec<String> {
    let rest: Vec<&str> = best.ids().into_iter().enumerate().filter(|(i, _)| *i != member).map(|(_, id)| id).collect();
    effects
        .iter()
        .filter(|e| {
            e.causes() == best.causes()
                && is_within_odds(e.score, best.score, ANSWER.indistinguishable)
                && e.score > -ANSWER.least_plausible
        })
        .filter_map(|e| {
            let ids = e.ids();
            let own: Vec<&str> = ids.iter().copied().filter(|id| !rest.contains(id)).collect();
            (own.len() == 1).then(|| own[0].to_owned())
        })
        .take(ANSWER.members)
        .collect()
}

/// What the data's defects do to the answer.
pub(super) fn limits(case: &SteadyCase, d: &Diagnosis) -> Vec<String> {
    let mut out = Vec::new();
    let all = || case.references.iter().chain(&case.recordings);
    if all().any(|r| r.set_points) {
        out.push(
            "speeds are set-points, not measured: slip and speed errors of the drive cannot be told apart".to_owned(),
        );
    }
    if all().any(|r| r.magnitude_only && r.dead_band > 0.0) {
        out.push(
            "currents carry no sign and have a dead band: of a side that is dragged or brakes \
             only a bound is known, so straight loads are taken where both currents exceed the \
             dead band"
                .to_owned(),
        );
    } else if all().any(|r| r.magnitude_only) {
        out.push("currents carry no sign: a side that brakes looks like one that drives".to_owned());
    }
    out.extend(d.steady.as_ref().and_then(|l| clocks(&l.clocks)));
    let named = |runs: &[SpeedRun], what: &str| -> Vec<String> {
        runs.iter().filter(|r| r.yaw_rate.is_none()).map(|r| format!("{what} {}", r.name)).collect()
    };
    let blind = [named(&case.references, "reference"), named(&case.recordings, "recording")].concat();
    if !blind.is_empty() {
        out.push(format!("no gyro was recorded in {}: no effective track can be measured there", blind.join(", ")));
    }
    out.extend(all().flat_map(guesses));
    let averaged = |run: &SpeedRun| Some(format!("{} over {:.1} s", run.name, run.averaged?));
    let averaged: Vec<String> = all().filter_map(averaged).collect();
    if !averaged.is_empty() {
        let told = averaged.join(", ");
        out.push(format!(
            "measured speeds scatter from row to row and are averaged ({told}): no change is timed better than that"
        ));
    }
    if case.recordings.iter().any(|r| r.commanded.is_some()) {
        out.push(
            "how late and how far measured speeds follow set speeds is not looked into: `causality = \"command-driven\"` in the robot file \
             asks for dead time, gains and limits"
                .to_owned(),
        );
    }
    out.extend(unused(all().flat_map(|r| &r.unused)));
    if d.steady.as_ref().is_some_and(|s| s.ratios.iter().any(|r| r.other_speed)) {
        out.push("some straight loads are compared with references driven at another speed".to_owned());
    }
    out.push(
        "mass and torque per current cannot be told apart on level ground: loads are compared as ratios".to_owned(),
    );
    out
}

/// What was recorded and mapped, and is not used.
fn unused<'a>(all: impl Iterator<Item = &'a Signal>) -> Option<String> {
    let names: BTreeSet<&str> = all.map(|s| s.name()).collect();
    let accelerometer = names.contains(Signal::AccelX.name());
    let slopes = if accelerometer { ": slopes rest on turning rates and loads, not on the accelerometer" } else { "" };
    let names: Vec<&str> = names.into_iter().collect();
    (!names.is_empty()).then(|| format!("recorded but not used: {}{slopes}", names.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signals_that_are_not_used_are_reported() {
        assert_eq!(unused([].iter()), None);
        let told = unused([Signal::AccelX, Signal::PoseX, Signal::AccelX].iter()).expect("told");
        assert!(told.starts_with("recorded but not used: accel_x, pose_x: slopes"), "{told}");
    }
}
