//! Where a robot travels to: a slope is that of a place and a heading.

use inference::interpolate;
use inference::robust::{NINETY, median};
use verdict::Quantity;

use crate::run::SpeedRun;
use crate::settings::{CHANGES, MEASURING, changes::Jumps};
use crate::straight::is_straight;

const JUMPS: Jumps = CHANGES.jumps;

/// Where the robot looks at the rows, rad from where it looked at first; `None` without a yaw rate.
pub(crate) fn headings(run: &SpeedRun) -> Option<Vec<f64>> {
    let yaw = run.yaw_rate.as_ref()?;
    let mut heading = vec![0.0; yaw.len()];
    for i in 1..yaw.len() {
        let rate = 0.5 * (yaw[i] + yaw[i - 1]);
        let turned = rate * (run.time[i] - run.time[i - 1]);
        heading[i] = heading[i - 1] + if turned.is_finite() { turned } else { 0.0 };
    }
    Some(heading)
}

/// Direction of travel at the rows, rad from where the robot looked at first; `None` without a yaw rate.
pub(crate) fn directions(run: &SpeedRun) -> Option<Vec<f64>> {
    let heading = headings(run)?;
    let backward = |i: usize| if run.forward(i) < 0.0 { std::f64::consts::PI } else { 0.0 };
    Some((0..heading.len()).map(|i| heading[i] + backward(i)).collect())
}

/// Nose up at the rows by an accelerometer, rad; `None` without one.
pub(crate) fn levels_at_rows(run: &SpeedRun) -> Option<Vec<f64>> {
    let Some(rates) = &run.body_rates else { return run.level.clone() };
    let alignment = run.alignment.as_ref()?;
    let level = rates.level.as_ref()?;
    Some(run.time.iter().zip(&alignment.lag).map(|(t, lag)| interpolate(&rates.time, level, t + lag)).collect())
}

/// By how much two directions differ, rad.
pub(crate) fn apart(a: f64, b: f64) -> f64 {
    (a - b).sin().atan2((a - b).cos()).abs()
}

/// Whether all straight driving goes about one way, so that one slope could be under all of it. Without a yaw rate nothing
/// speaks against that.
pub(crate) fn goes_one_way(run: &SpeedRun) -> bool {
    let Some(directions) = directions(run) else { return true };
    let straight = |i: &usize| is_straight(run, *i, MEASURING.straight.hold) && !run.changed[*i] && !run.standing[*i];
    let rows: Vec<usize> = (0..run.time.len()).filter(straight).collect();
    let Some(&first) = rows.first() else { return true };
    let other = rows.iter().filter(|&&i| apart(directions[i], directions[first]) > JUMPS.other_heading).count();
    (other as f64) * run.period() < JUMPS.elsewhere
}

/// Whether all straight driving may be on one slope, by what was measured in which recordings: drives at several places, or in several
/// headings, share none.
pub(crate) fn may_be_one_slope<'a>(measured: impl Iterator<Item = (Quantity, &'a String)>, runs: &[SpeedRun]) -> bool {
    let mut straight = measured.filter(|(quantity, _)| *quantity == Quantity::StraightLoad).map(|(_, name)| name);
    let first = straight.next();
    let one_place = straight.all(|name| Some(name) == first);
    one_place && runs.iter().filter(|run| Some(&run.name) == first).all(goes_one_way)
}

/// Whether an accelerometer whose lean in the body is known contradicts a slope of so many rad, uphill along the way positive, under all
/// straight driving of a recording. It does where the tilt differs from the slope by more than half of it and than its own error.
pub(crate) fn stays_off_slope(run: &SpeedRun, slope: f64) -> bool {
    contradicts(run, f64::NEG_INFINITY, slope, |i| run.forward(i).signum())
}

/// The same of a slope that rises ahead of the body, whichever way it goes, from an instant on, s.
pub(crate) fn stays_off_slope_ahead(run: &SpeedRun, from: f64, slope: f64) -> bool {
    contradicts(run, from, slope, |_| 1.0)
}

fn contradicts(run: &SpeedRun, from: f64, slope: f64, way: impl Fn(usize) -> f64) -> bool {
    let lean = run.body_rates.as_ref().map_or(f64::INFINITY, |rates| rates.level_sigma);
    let Some(levels) = levels_at_rows(run) else { return false };
    let straight =
        |i: &usize| from <= run.time[*i] && is_straight(run, *i, MEASURING.straight.hold_of_means) && !run.standing[*i];
    let tilts = (0..run.time.len()).filter(straight).map(|i| way(i) * levels[i]);
    let off = median(tilts).map_or(0.0, |tilt| (tilt - slope).abs());
    off > JUMPS.off_slope * slope.abs() && off > NINETY * lean
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{Leg, drive, levelled, rounds};

    #[test]
    fn straight_drives_before_and_after_a_turn_go_two_ways() {
        assert!(goes_one_way(&drive(&[Leg::straight(60.0)], false)));
        let there_and_back = [Leg::straight(20.0), Leg { speed: [-0.24; 2], ..Leg::straight(20.0) }];
        assert!(!goes_one_way(&drive(&there_and_back, false)));
        assert!(!goes_one_way(&drive(&rounds(2), false)));
        let mut unseen = drive(&rounds(2), false);
        unseen.yaw_rate = None;
        assert!(goes_one_way(&unseen));
    }

    #[test]
    fn a_body_that_stays_level_is_on_no_slope_where_its_accelerometer_is_known_to_stand_upright() {
        let slope = 4.0_f64.to_radians();
        let [level, tilted] = [0.0, 4.0].map(|degrees| levelled(&[Leg::straight(60.0).slope(degrees)], 0.0));
        assert!(stays_off_slope(&level, slope) && !stays_off_slope(&tilted, slope) && stays_off_slope(&tilted, -slope));
        let mut leans = level;
        leans.body_rates.as_mut().expect("rates").level_sigma = MEASURING.mounting.unknown;
        assert!(!stays_off_slope(&leans, slope), "nobody knows how it is mounted");
        assert!(!stays_off_slope(&drive(&[Leg::straight(60.0)], true), slope), "without one");
    }
}
