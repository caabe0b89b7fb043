//! Elements of a response as causes, with probabilities, sizes and intervals.

use std::collections::BTreeMap;
use verdict::{Cause, Earned, Element, Estimate, Parameter, ResponseConstant, Span};

use crate::controller::answers_apart;
use crate::identified::Identified;
use crate::identify::{Base, Identify};
use crate::known::{open_range, settled, sigmas};
use crate::left::Remains;
use crate::moved::{Moved, is_another_centre};
use crate::run::{ResponseRun, STEP};
use crate::search::{Evidence, OtherOrder, Part, Trial};
use crate::settings::{Answer, SETTINGS};
use crate::windows::Windows;
use catalogue::answer::{NONE, UNKNOWN};
use catalogue::{CauseSpec, command_driven as cause};
use inference::evidence::{logistic, none_of};
use inference::robust::{EIGHTY, NINETY, normal_cdf};

pub(crate) fn earned((element, e): &(Element, Evidence)) -> Earned {
    Earned { element: *element, rise: e.rise, standard_error: e.standard_error, probability: probability(e) }
}

fn probability(e: &Evidence) -> f64 {
    logistic(e.score)
}

/// Names of the dead time and of the time constant of a lag.
const DEAD_TIME_ID: &str = "dead_time";
const LAG_ID: &str = "lag";

/// Fitted constants of a part with their intervals.
fn parameters<P: Part>(part: &P, t: &Trial<P::Law>, simulated: &[f64]) -> Vec<Parameter> {
    let sigmas = sigmas(part, t);
    let settled = settled(part, t);
    let belongs = |k: usize| t.elements.iter().copied().find(|e| part.free(t.model.law, *e).contains(&k));
    let with_sigma = t.free.iter().zip(sigmas);
    with_sigma
        .filter_map(|(&k, sigma)| {
            let c: &ResponseConstant = &part.constants()[k];
            let (value, half) = told(part, t, k, sigma.map(|s| NINETY * s));
            // Between what both laws, or all rows and those of motions that have ended, say, with both inside the interval.
            let other = t.other_order.and_then(|other| match c.id {
                DEAD_TIME_ID => Some(other.dead_time),
                LAG_ID => Some(other.lag),
                _ => None,
            });
            let other = other.or_else(|| settled.iter().find(|(level, _)| *level == k).map(|(_, value)| *value));
            let apart = other.map_or(0.0, |other| 0.5 * (other - value));
            let (value, half) = (value + apart, half.map(|half| of_both(half, apart.abs())));
            Some(Parameter {
                element: belongs(k)?,
                id: c.id.into(),
                unit: c.unit.into(),
                value,
                half_width: half,
                simulated: Some(simulated[k]).filter(|s| s.is_finite()),
                at_bound: value <= c.bounds[0] || value >= c.bounds[1],
            })
        })
        .collect()
}

/// Half of the 90 % interval of two normal distributions, one as likely as the other, of this half width each and twice `apart` apart:
/// far from each other it ends where a tenth of each lies beyond.
fn of_both(half: f64, apart: f64) -> f64 {
    half.hypot(apart).max(apart + EIGHTY / NINETY * half)
}

/// Value and half of the 90 % interval of a constant. What rows leave open is told by its middle, with the range over which
/// the cost is as low: derivatives say nothing there, or say that nothing is known at all.
fn told<P: Part>(part: &P, t: &Trial<P::Law>, k: usize, half: Option<f64>) -> (f64, Option<f64>) {
    let of_law = NINETY * part.law_error(&t.model) * t.model.x[k];
    let between = (NINETY * sigma_of_uniform(part.between_rows(k))).hypot(of_law);
    let Some(([from, until], reach)) = open_range(part, t, k).zip(part.flat_over(&t.model, k)) else {
        return (t.model.x[k], half.map(|half| half.hypot(between)));
    };
    // The range is looked up at points.
    let open = (0.5 * (until - from)).max(reach / SETTINGS.fit.profile as f64);
    let half = half.filter(|h| *h < reach).map_or(open, |h| if until > from { h.max(open) } else { h });
    (0.5 * (from + until), Some(half.hypot(between)))
}

/// Fitted constants of a part, those from before it began included where they did not change.
pub(crate) fn parameters_of<I: Identify>(
    of: &I,
    windows: &Windows,
    t: &Trial<I::Law>,
    simulated: &[f64],
) -> Vec<Parameter> {
    let Some(began) = &t.began else { return parameters(&of.part(windows), t, simulated) };
    let mut out = parameters(&of.part(&began.windows[1]), t, simulated);
    let before = parameters(&of.part(&began.windows[0]), &began.before, simulated);
    let kept: Vec<Parameter> = before.into_iter().filter(|p| !out.iter().any(|o| o.id == p.id)).collect();
    out.extend(kept);
    out
}

/// When elements were there in each recording, if they began inside one and were not there before in any form.
fn presence<L>(t: &Trial<L>, elements: &[Element], runs: &[ResponseRun]) -> Option<BTreeMap<String, Vec<[f64; 2]>>> {
    let began = t.began.as_ref()?;
    let is = |of: &[Element]| of.iter().any(|e| elements.contains(e));
    if !is(&began.changed) || is(&began.before.elements) {
        return None;
    }
    Some(began.instants.iter().map(|i| (runs[i.run].name.clone(), vec![i.interval])).collect())
}

/// Stretches of the recordings since a response began.
pub(crate) fn onsets(found: &Identified, runs: &[ResponseRun]) -> Vec<Span> {
    let drive = found.drive.began.as_ref().map(|b| ("wheel speed", &b.instants));
    let ground = found.ground.began.as_ref().map(|b| ("heading", &b.instants));
    let spans = drive.into_iter().chain(ground).flat_map(|(signal, instants)| {
        instants.iter().filter(|i| i.range.is_some()).map(move |i| Span {
            recording: runs[i.run].name.clone(),
            signal: signal.to_owned(),
            side: None,
            interval: i.interval,
            onset: i.range,
            end: None,
            gain: i.gain,
        })
    });
    spans.collect()
}

/// How the size of a cause comes from its fitted constants.
#[derive(Clone, Copy)]
enum Size {
    /// Its first constant.
    First,
    /// Its first constant times the nominal track.
    TimesTrack,
    /// The first constant; of a second-order lag the delay 2 ζ / ω.
    Lag,
    /// What the wheels do otherwise than commanded.
    WheelError,
    /// Of a loss c the share that is lost at a yaw rate of 1 rad/s, 1 − exp(−c).
    LostInTurns,
}

/// A cause, its elements and its size, in causal order.
const CAUSES: [(&CauseSpec, &[Element], Size); 9] = [
    (
        &cause::DRIVE_COMMAND,
        &[
            Element::Gain,
            Element::TurnLimit,
            Element::ForwardLimit,
            Element::WheelLimit,
            Element::Ramp,
            Element::SideGain,
        ],
        Size::WheelError,
    ),
    (&cause::DEAD_TIME, &[Element::DeadTime], Size::First),
    (&cause::LAG, &[Element::Lag], Size::Lag),
    (&cause::EFFECTIVE_TRACK, &[Element::Track], Size::TimesTrack),
    (&cause::ROLLING_RADIUS, &[Element::Radius], Size::First),
    (&cause::TURN_SLIP, &[Element::TurnSlip], Size::LostInTurns),
    (&cause::TURN_CENTRE_OFFSET, &[Element::Offset], Size::First),
    (&cause::BODY_LAG, &[Element::BodyLag], Size::First),
    (&cause::SIDE_RADIUS, &[Element::SideRadius], Size::First),
];
const ANSWER: Answer = SETTINGS.answer;

/// Causes to which some of these elements belong, in causal order.
pub(crate) fn causes_of(present: &[Element]) -> impl Iterator<Item = &'static str> {
    let is = |(_, elements, _): &(&CauseSpec, &[Element], Size)| elements.iter().any(|e| present.contains(e));
    CAUSES.into_iter().filter(is).map(|(spec, ..)| spec.id)
}

/// Causes by probability; of those that are sure, the one nearer to the command first.
///
/// `moved`: constants that the robot file may have wrong. `off`: what the wheels do otherwise than commanded, with its
/// standard error. `is_confirmed`: whether forecasts of what was left out need any of it more than what was given,
/// and than re-tuned constants, and of the wheels what lies between command and wheel.
pub(crate) fn ranked(
    found: &Identified,
    parameters: &[Parameter],
    moved: &[Moved],
    (off, track): ([f64; 2], f64),
    (remains, base, is_confirmed): (&Remains, &Base, [bool; 3]),
    runs: &[ResponseRun],
) -> Vec<Cause> {
    let mut out = Vec::new();
    let mut present = Vec::new();
    for (spec, elements, size) in CAUSES {
        let own = found.evidence.iter().filter(|(e, _)| elements.contains(e));
        let of_file = moved.iter().find(|m| elements.contains(&m.element)).map_or(0.0, |m| m.probability);
        let is_tuned = elements.iter().all(|e| [Element::Radius, Element::Track].contains(e));
        let is_of_drive = elements.iter().all(|e| e.is_drive());
        let is_confirmed = if is_of_drive { is_confirmed[2] } else { is_confirmed[usize::from(!is_tuned)] };
        let trust = if is_confirmed { 1.0 } else { ANSWER.unconfirmed };
        let p = trust * (1.0 - of_file) * own.map(|(_, e)| probability(e)).fold(0.0, f64::max);
        if p < ANSWER.listed {
            present.push(p);
            continue;
        }

        let mut cause = Cause::plain(spec.id, spec.name, p);
        let of: Vec<&Parameter> = parameters.iter().filter(|q| elements.contains(&q.element)).collect();
        cause.intervals = presence(&found.drive, elements, runs).or_else(|| presence(&found.ground, elements, runs));
        cause.parameters = of.iter().map(|q| (q.id.to_string(), estimate(q))).collect();
        match (size, of.as_slice()) {
            (_, []) => {}
            (Size::WheelError, _) => (cause.magnitude, cause.sigma) = (Some(off[0]), Some(off[1])),
            (Size::LostInTurns, [c, ..]) => {
                cause.magnitude = Some(1.0 - (-c.value).exp());
                cause.sigma = c.half_width.map(|h| (-c.value).exp() * h / NINETY);
            }
            (Size::Lag, [w, z]) => {
                // A second-order lag is late by 2 ζ / ω.
                let lag = 2.0 * z.value / w.value;
                let relative = |q: &Parameter| q.half_width.map(|h| h / NINETY / q.value);
                cause.magnitude = Some(lag);
                cause.sigma = relative(w).zip(relative(z)).map(|(a, b)| lag * a.hypot(b));
            }
            (_, [q, ..]) => {
                let factor = if matches!(size, Size::TimesTrack) { track } else { 1.0 };
                cause.magnitude = Some(factor * q.value);
                cause.sigma = q.half_width.map(|h| factor * h / NINETY);
            }
        }
        if spec.unit == "s" {
            let later = by_how_much_later(spec, found, base, of.first().copied());
            cause.probability *= later.map_or(1.0, |size| matters(size, cause.sigma.unwrap_or(0.0)));
        }
        if spec.id == cause::DEAD_TIME.id {
            cause.probability = cause.probability.min(surest_dead_time(found.drive.other_order));
        }
        if let (true, [q, ..], Some(sigma)) = (spec.id == cause::TURN_CENTRE_OFFSET.id, of.as_slice(), cause.sigma) {
            cause.probability *= is_another_centre(q.value - q.simulated.unwrap_or(0.0), sigma, track);
        }
        present.push(cause.probability);
        if cause.probability < ANSWER.listed {
            continue;
        }
        if cause.magnitude.is_some() {
            cause.unit = spec.unit.into();
        }
        out.push(cause);
    }
    out.push(Cause::plain(NONE.id, NONE.name, none_of(present.into_iter().chain([remains.mostly]))));
    let unknown = if remains.mostly > SETTINGS.left.likely { remains.mostly } else { remains.something() };
    out.push(Cause::plain(UNKNOWN.id, UNKNOWN.name, unknown));
    // What explains little of the mismatch does not lead it.
    let mostly_unknown = remains.mostly > SETTINGS.left.likely;
    let leads = |c: &Cause| mostly_unknown && c.effect == UNKNOWN.id;
    let sureness = |c: &Cause| c.probability.min(ANSWER.sure);
    out.sort_by(|a, b| leads(b).cmp(&leads(a)).then(sureness(b).total_cmp(&sureness(a))));
    out
}

/// Largest probability of a dead time: a lag of the other order may forecast as well without.
fn surest_dead_time(other: Option<OtherOrder>) -> f64 {
    let is_needless = other.is_some_and(|other| other.is_as_good && other.dead_time < ANSWER.least_delay);
    if is_needless { ANSWER.needless } else { 1.0 }
}

/// By how much later wheels or body answer than is simulated, s; `None` where nothing was fitted. A longer dead time before a shorter lag
/// is no later answer.
fn by_how_much_later(spec: &CauseSpec, found: &Identified, base: &Base, own: Option<&Parameter>) -> Option<f64> {
    let own = own?;
    let (now, given) = (&found.drive.model, &base.drive);
    let apart = |whole: bool| answers_apart([(now.law, &now.x), (given.law, &given.x)], whole);
    let longer = (own.value - own.simulated.unwrap_or(0.0)).abs();
    Some(match spec.id {
        id if id == cause::LAG.id => apart(false).min(apart(true)),
        id if id == cause::DEAD_TIME.id => longer.min(apart(true)),
        _ => longer,
    })
}

/// Standard deviation of a uniform distribution of this width.
fn sigma_of_uniform(width: f64) -> f64 {
    width / 12.0_f64.sqrt()
}

/// Probability that a difference of so many seconds, known to one sigma and to the rows between which both end, is one that matters.
fn matters(size: f64, sigma: f64) -> f64 {
    normal_cdf((size.abs() - ANSWER.least_delay) / sigma.max(sigma_of_uniform(STEP).hypot(sigma_of_uniform(STEP))))
}

fn estimate(p: &Parameter) -> Estimate {
    Estimate { value: p.value, sigma: p.half_width.map(|h| h / NINETY), at_bound: p.at_bound }
}

/// Every fitted constant by name, for the re-tuned constants of the answer.
pub(crate) fn tuning(parameters: &[Parameter]) -> BTreeMap<String, f64> {
    parameters.iter().map(|p| (p.id.to_string(), p.value)).collect()
}

/// What the simulation has for each constant.
pub(crate) fn simulated(base: &Base) -> [&[f64]; 2] {
    debug_assert_eq!(
        (base.drive.x.len(), base.ground.x.len()),
        (verdict::DRIVE_CONSTANTS.len(), verdict::GROUND_CONSTANTS.len())
    );
    [&base.drive.x, &base.ground.x]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::{Identify, OfDrive, neutral};
    use crate::testing::Truth;

    #[test]
    fn causes_are_those_of_the_catalogue_and_every_element_belongs_to_one() {
        let ids = CAUSES.map(|(spec, ..)| spec.id);
        assert_eq!(ids, cause::ALL.map(|spec| spec.id));
        let mut elements: Vec<Element> = CAUSES.iter().flat_map(|(_, elements, _)| elements.iter().copied()).collect();
        elements.sort_unstable();
        let last = Element::SideRadius as usize;
        assert_eq!(elements.iter().map(|e| *e as usize).collect::<Vec<_>>(), (0..=last).collect::<Vec<_>>());
    }

    #[test]
    fn a_lag_of_the_other_order_leaves_the_dead_time_open_where_neither_is_exact() {
        let identified = |truth: &Truth| {
            let windows = Windows::new(&[truth.run("a", 30, 1), truth.run("b", 20, 2)]);
            let trial = OfDrive.identify(&windows, &neutral(&windows).drive).trial;
            (windows, trial)
        };
        let dead_time = |windows: &Windows, trial: &Trial<_>| {
            let part = OfDrive.part(windows);
            let all = parameters(&part, trial, &part.neutral());
            all.into_iter().find(|p| p.id == DEAD_TIME_ID).expect("a dead time")
        };
        let (windows, mut trial) = identified(&Truth::stock());
        let own = dead_time(&windows, &trial);
        let apart = trial.other_order.map_or(0.0, |other| other.dead_time - own.value);
        assert!(apart.abs() < 0.03, "the law is exact: {:?}", trial.other_order);
        trial.other_order = None;
        let own = dead_time(&windows, &trial);
        let other = OtherOrder { dead_time: own.value + 0.1, lag: 0.1, is_as_good: false };
        trial.other_order = Some(other);
        let both = dead_time(&windows, &trial);
        approx::assert_relative_eq!(both.value, own.value + 0.05, max_relative = 1e-9);
        assert!(both.half_width > Some(0.05) && both.half_width < Some(0.08), "{both:?}");
        let half = own.half_width.expect("determined");
        assert!(both.half_width >= Some(0.05 + EIGHTY / NINETY * half), "{both:?}");
        // Wheels that follow no law of the two.
        let swaying = Truth { wheel_push: |t, _| 0.3 * (1.3 * t).sin(), ..Truth::stock() };
        let (of_swaying, trial_of_swaying) = identified(&swaying);
        assert!(trial_of_swaying.other_order.is_some());
        let law_errors = [(&windows, &trial), (&of_swaying, &trial_of_swaying)]
            .map(|(windows, trial)| OfDrive.part(windows).law_error(&trial.model));
        assert_eq!(law_errors, [0.0, ANSWER.law_error]);
    }

    #[test]
    fn a_dead_time_that_a_lag_as_good_does_not_need_is_one_of_two_answers() {
        let of = |dead_time, is_as_good| surest_dead_time(Some(OtherOrder { dead_time, lag: 0.3, is_as_good }));
        assert_eq!([of(0.0, true), of(0.0, false), of(0.1, true), surest_dead_time(None)], [0.5, 1.0, 1.0, 1.0]);
    }

    #[test]
    fn a_size_that_is_a_constant_has_the_unit_of_that_constant() {
        let all = || verdict::DRIVE_CONSTANTS.iter().chain(&verdict::GROUND_CONSTANTS);
        for (spec, _, size) in CAUSES {
            let id = match spec.id {
                "rolling_radius" => "radius_factor",
                "transport_delay" => "dead_time",
                "turn_centre_offset" => "centre_offset",
                "wheel_radius_mismatch" => "side_radius",
                own => own,
            };
            if matches!(size, Size::First) {
                let constant = all().find(|c| c.id == id).unwrap_or_else(|| panic!("no constant {id}"));
                assert_eq!(constant.unit, spec.unit, "{id}");
            }
        }
    }
}
