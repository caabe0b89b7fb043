//! Counters that wrap around or begin anew.

use inference::robust::{quantile, sorted};
use std::f64::consts::TAU;

use crate::drive::WheelData;
use crate::settings::{DriveRules, SETTINGS};
use crate::wheel::Wheel;

const RULES: DriveRules = SETTINGS.drive;
const DEGREES_OF_A_TURN: f64 = TAU.to_degrees();

/// A column of a wheel without its jumps where it wraps around.
pub(crate) fn unwrapped(column: &[f64], data: WheelData, wheel: &Wheel, told: &mut Vec<String>) -> Vec<f64> {
    let mut ranges: Vec<f64> = match data {
        WheelData::Counter => RULES.ranges.into_iter().chain(wheel.counts_per_turn).collect(),
        WheelData::Angle => vec![TAU, DEGREES_OF_A_TURN],
        WheelData::Counts | WheelData::Speed => Vec::new(),
    };
    ranges.sort_by(|a, b| b.total_cmp(a));
    if data == WheelData::Counter
        && let Some(joined) = without_resets(column, &ranges, wheel, told)
    {
        return joined;
    }

    let largest = column.windows(2).map(|w| (w[1] - w[0]).abs()).fold(0.0, f64::max);
    let fits = |range: &f64| largest > RULES.wrap * *range && column.iter().all(|c| c.abs() <= *range);
    let Some(range) = ranges.into_iter().find(fits) else { return column.to_vec() };
    let mut added = 0.0;
    let mut wraps = 0;
    let mut out = Vec::with_capacity(column.len());
    for (k, &count) in column.iter().enumerate() {
        if k > 0 {
            let jump = count - column[k - 1];
            if jump.abs() > RULES.wrap * range {
                added -= range * jump.signum();
                wraps += 1;
            }
        }
        out.push(count + added);
    }
    let what = if data == WheelData::Angle { "angle" } else { "counter" };
    let range = if range == TAU { "2 pi".to_owned() } else { format!("{range:.0}") };
    told.push(format!("the {what} of wheel '{}' wraps around at {range} {wraps} times: it was unwrapped", wheel.name));
    out
}

/// A counter that is set to zero in between, as where a driver begins anew: what it counts from there on goes on from the row before, with
/// its step. `None` of a counter that never is.
fn without_resets(column: &[f64], ranges: &[f64], wheel: &Wheel, told: &mut Vec<String>) -> Option<Vec<f64>> {
    let steps = sorted(column.windows(2).map(|w| (w[1] - w[0]).abs()).filter(|step| step.is_finite()));
    let usual = quantile(&steps, RULES.usual_step)?.max(1.0);
    let near = RULES.reset * usual;
    let is_reset = |k: &usize| {
        let jump = (column[*k] - column[k - 1]).abs();
        let is_near_zero = column[*k].abs() < near && column[k - 1].abs() > 2.0 * near;
        jump > near && is_near_zero && ranges.iter().all(|range| (jump - range).abs() > near)
    };
    let resets: Vec<usize> = (1..column.len()).filter(is_reset).collect();
    if resets.is_empty() {
        return None;
    }

    let mut out = column.to_vec();
    for &k in &resets {
        let step = if k > 1 { out[k - 1] - out[k - 2] } else { 0.0 };
        let added = out[k - 1] + step - out[k];
        out[k..].iter_mut().for_each(|count| *count += added);
    }
    told.push(format!(
        "the counter of wheel '{}' begins anew at 0 {} times: it was joined, with the step of the row before",
        wheel.name,
        resets.len()
    ));
    Some(out)
}
