//! What events have in common: in which motions they fall, and whether they repeat.

use inference::robust;
use law::{Input, Variable};
use verdict::{Opposed, Shared};

use super::arbitrary::Instant;
use super::signals::Signals;
use crate::settings::law::{Events, SETTINGS};

const EVENTS: Events = SETTINGS.events;

/// The variables whose amount is larger, or smaller, in the first window of events than where there are none, the clearest
/// first: by the probability that one drawn from each is larger (Mann & Whitney 1947).
pub(super) fn shared(signals: &Signals, inputs: &[Input], instants: &[Instant]) -> Vec<Shared> {
    let is_event = |input: usize, run: usize, window: usize| {
        instants.iter().any(|i| (i.input, i.run, i.window) == (input, run, window))
    };
    let mut out: Vec<(f64, Shared)> = Vec::new();
    for variable in Variable::ALL.into_iter().filter(|v| v.is_amount()) {
        let (mut at_events, mut elsewhere) = (Vec::new(), Vec::new());
        let means = signals.means(variable);
        for (k, input) in inputs.iter().enumerate() {
            let amount = |both: &[f64; 2]| match side(*input) {
                Some(side) => both[side].abs(),
                None => 0.5 * (both[0].abs() + both[1].abs()),
            };
            for (run, windows) in means.iter().enumerate() {
                let amounts = windows.iter().map(amount).enumerate();
                for (window, amount) in amounts.filter(|(_, amount)| amount.is_finite()) {
                    let begins = window == 0 || !is_event(k, run, window - 1);
                    match is_event(k, run, window) {
                        true if begins => at_events.push(amount),
                        true => {}
                        false => elsewhere.push(amount),
                    }
                }
            }
        }
        if let Some(found) = compared(variable, &at_events, &mut elsewhere) {
            out.push(found);
        }
    }
    out.sort_by(|a, b| b.0.total_cmp(&a.0));
    out.into_iter().take(EVENTS.shared).map(|(_, shared)| shared).collect()
}

/// The side that an input acts on.
fn side(input: Input) -> Option<usize> {
    match input {
        Input::Torque(side) | Input::Grip(side) | Input::Radius(side) => Some(side),
        _ => None,
    }
}

/// Whether torques at events act against the drive or against the motion; `None` where events are no torques.
pub(super) fn opposed(signals: &Signals, inputs: &[Input], instants: &[Instant]) -> Option<Opposed> {
    let [torque, speed] = [Variable::Torque, Variable::WheelSpeed].map(|v| signals.means(v));
    let (mut of_torque, mut against) = (Vec::new(), [0.0; 2]);
    for i in instants {
        let Input::Torque(side) = inputs[i.input] else { return None };
        let at = |of: &[Vec<[f64; 2]>]| of[i.run].get(i.window).map(|both| both[side]);
        let (torque, speed) = (at(&torque)?, at(&speed)?);
        against[0] += f64::from(u8::from(i.size * torque < 0.0));
        against[1] += f64::from(u8::from(i.size * speed < 0.0));
        of_torque.push(-i.size / torque);
    }
    let n = instants.len().max(1) as f64;
    let of_torque = robust::median(of_torque.into_iter().filter(|x| x.is_finite()))?;
    let [torque, motion] = against.map(|windows| windows / n);
    let like = match (torque > motion, torque.max(motion) > EVENTS.against) {
        (_, false) => None,
        (true, true) => Some("a drive does that fails now and then"),
        (false, true) => Some("a brake does that touches"),
    };
    Some(Opposed { torque, motion, of_torque, like: like.map(str::to_owned) })
}

/// How clearly amounts at events differ from those elsewhere; `None` where they do not.
fn compared(variable: Variable, at_events: &[f64], elsewhere: &mut [f64]) -> Option<(f64, Shared)> {
    let (n, m) = (at_events.len() as f64, elsewhere.len() as f64);
    if at_events.len() < EVENTS.least || elsewhere.is_empty() {
        return None;
    }
    elsewhere.sort_by(f64::total_cmp);
    let below = |x: f64| elsewhere.partition_point(|y| *y < x) as f64 / m;
    let larger = at_events.iter().map(|x| below(*x)).sum::<f64>() / n;
    // Variance of that probability where both are alike.
    let sigma = ((n + m + 1.0) / (12.0 * n * m)).sqrt();
    let clearness = (larger - 0.5).abs();
    if clearness < EVENTS.clear - 0.5 || clearness < EVENTS.sigmas * sigma {
        return None;
    }
    // The amount on one side of which most events lie.
    let is_above = larger > 0.5;
    let share = if is_above { 1.0 - EVENTS.most_of_them } else { EVENTS.most_of_them };
    let bound = robust::quantile(&robust::sorted(at_events.iter().copied()), share)?;
    let elsewhere = if is_above { 1.0 - below(bound) } else { below(bound) };
    let told = Shared {
        variable: variable.name().to_owned(),
        unit: variable.unit().to_string(),
        above: is_above,
        bound,
        of_events: EVENTS.most_of_them,
        elsewhere,
    };
    Some((clearness, told))
}
