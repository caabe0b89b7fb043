//! What changes inside recordings leaves what is measured of the whole: rows are marked, slopes are taken off, bodies that push against
//! something stand.

use inference::robust::median;
use verdict::{Changes, LoadChange, Loads, Standstill};

use crate::attitude::Attitude;
use crate::changed::{changed_rows, slopes_lead};
use crate::changes::inside;
use crate::pieces::{GRADE, STANDING, Usual, class};
use crate::run::SpeedRun;
use crate::settings::NAMING;
use crate::slope_pull::take_off_row;
use crate::straight::readings;
use crate::{SteadyCase, body_pull, one_side, plane, pulses, tipping};

/// Finds what is told by itself and takes it out of the recordings, so that all that follows is of level ground, of a unit that stands
/// upright and of drives that nothing pulls: units that tip, loads that pulse, a slope or a pull under all driving, changes inside
/// recordings. `weight` is `m g r`, N m, with the share by which torques may be off against it, `radius` that of the wheels, m.
pub(crate) fn take_out(case: &mut SteadyCase, usual: &Usual, (weight, radius): ((f64, f64), f64)) -> Loads {
    let SteadyCase { references, recordings, torque_sigma, .. } = case;
    let tipped = tipping::take_out(recordings, usual, weight.0);
    let pulsing = pulses::pulsing(references, recordings, usual, (radius, *torque_sigma));
    let slope = plane::take_off(recordings, usual, weight);
    // What pulses pulls, too, and is told so.
    let is_open = slope.is_none() && pulsing.is_empty();
    let pull = is_open.then(|| body_pull::take_off(references, recordings, usual, (weight, radius))).flatten();
    let (changes, standstills) = mark(recordings, usual, weight.0);
    let side_changes = one_side::mark(recordings, *torque_sigma);
    Loads { tipped, pulsing, slope, pull, changes, standstills, side_changes, ..Loads::default() }
}

/// Finds the changes of the straight load inside these recordings, and marks their rows so that the load of the whole
/// recording is measured without them. A change that covers most of the straight driving is not marked: it is that load, less what
/// slopes pull whose tilt is measured.
/// Also where bodies stand that nothing but pushing against something explains: those rows are left out of all else.
fn mark(runs: &mut [SpeedRun], usual: &Usual, weight: f64) -> (Changes, Vec<Standstill>) {
    let mut out = Changes::default();
    let mut standing = Vec::new();
    for run in runs {
        let (mut own, attitude) = inside(run, usual, weight);
        let (blocked, found): (Vec<_>, Vec<_>) = own.found.into_iter().partition(|c| c.causes == [STANDING]);
        own.found = found;
        for c in blocked {
            standing.push(against_something(run, &c));
        }
        run.changed = changed_rows(run, &own.found);
        if let Some(attitude) = attitude.filter(|_| slopes_lead(run, &own.found)) {
            take_off_slopes(run, &own.found, &attitude, (usual, weight));
        }
        out.found.extend(own.found);
        out.tentative.extend(own.tentative);
        out.hidden.extend(own.hidden);
    }
    (out, standing)
}

/// Takes what measured slopes pull off the torques, where they explain the loads on them: ground that gives way tilts a body as well.
fn take_off_slopes(run: &mut SpeedRun, found: &[LoadChange], attitude: &Attitude, (usual, weight): (&Usual, f64)) {
    let is_measured = |c: &&LoadChange| c.causes == [GRADE] && c.ratio.is_none() && !c.relative;
    let slopes: Vec<[f64; 2]> = found.iter().filter(is_measured).map(|c| c.interval).collect();
    let is_on_slope = |t: f64| slopes.iter().any(|[from, until]| *from <= t && t <= *until);
    let rows: Vec<usize> = (0..run.time.len()).filter(|&i| is_on_slope(run.time[i])).collect();
    let mut level = run.clone();
    for &i in &rows {
        take_off_row(&mut level, i, weight * attitude.pitch[i].sin(), usual);
    }

    let readings = readings(&level);
    let over_usual = |&i: &usize| {
        let usual = usual.load[class(run.forward(i).abs())].or(usual.any())?;
        Some(readings[i]?.value() / usual)
    };
    let explains = |ratio: f64| ratio.ln().abs() < NAMING.priors.unnamed_straight.ln();
    if median(rows.iter().filter_map(over_usual)).is_some_and(explains) {
        *run = level;
    }
}

/// A change of the straight load as a body that stands; marks its rows.
fn against_something(run: &mut SpeedRun, change: &LoadChange) -> Standstill {
    let [from, until] = [change.onset[1], change.end[0]];
    let mut sum = [0.0; 2];
    let mut rows = 0_usize;
    for i in (0..run.time.len()).filter(|&i| from <= run.time[i] && run.time[i] <= until) {
        run.standing[i] = true;
        rows += 1;
        for (sum, torque) in sum.iter_mut().zip(&run.torque) {
            *sum += torque[i].abs();
        }
    }
    let load = sum[0].max(sum[1]) / rows.max(1) as f64;
    Standstill {
        recording: run.name.clone(),
        interval: [from, until],
        share: None,
        wheels: None,
        is_off: false,
        side: None,
        load,
        straight: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::CHANGES;
    use crate::testing::{Leg, STRAIGHT, WEIGHT, drive, levelled};

    const USUAL: Usual = Usual { load: [Some(STRAIGHT), None, None], unequal: CHANGES.pieces.alike };

    fn near([a, b]: [f64; 2], moment: f64) -> bool {
        b - a < 1.0 && a - 1.0 < moment && moment < b + 1.0
    }

    #[test]
    fn what_measured_slopes_pull_is_taken_off_where_they_are_under_all_driving_and_explain_its_load() {
        let uphill =
            |straight: f64| levelled(&[Leg { straight: straight * STRAIGHT, ..Leg::straight(60.0) }.slope(4.0)], 0.0);
        let left = |run: SpeedRun| {
            let mut runs = [run];
            let (found, _) = mark(&mut runs, &USUAL, WEIGHT);
            assert!(found.found.iter().any(|c| c.causes == [GRADE]), "{found:?}");
            median(crate::straight::readings(&runs[0]).iter().flatten().map(|r| r.value())).expect("loads") / STRAIGHT
        };
        approx::assert_abs_diff_eq!(left(uphill(1.0)), 1.0, epsilon = 0.1);
        // Ground that gives way tilts a body, too: a load that the tilt does not explain stays.
        assert!(left(uphill(2.0)) > 2.5);
    }

    #[test]
    fn what_covers_most_of_a_recording_is_its_load() {
        let climb = |seconds: f64| levelled(&[Leg::straight(30.0), Leg::straight(seconds).slope(5.0)], 0.0);
        let changed = |run: SpeedRun| {
            let mut runs = [run];
            assert_eq!(mark(&mut runs, &USUAL, WEIGHT).0.found.len(), 1);
            runs[0].changed.iter().any(|c| *c)
        };
        assert!(changed(climb(12.0)) && !changed(climb(60.0)));
    }

    #[test]
    fn a_robot_that_pushes_against_something_stands() {
        // Tyres hold half of its weight.
        let pushing = Leg { straight: STRAIGHT + 0.5 * WEIGHT, ..Leg::straight(20.0) };
        let legs = [Leg::straight(30.0), pushing, Leg::straight(30.0)];
        let mut runs = [drive(&legs, true)];
        let (changes, standing) = mark(&mut runs, &USUAL, WEIGHT);
        assert_eq!(changes.found, []);
        let [one] = &standing[..] else { panic!("{standing:?}") };
        assert!(near([one.interval[0], one.interval[0]], 30.0) && one.share.is_none(), "{one:?}");
        assert!(runs[0].standing.iter().any(|stands| *stands));
        // Without turning rates it may be a steep slope as well.
        let without = inside(&drive(&legs, false), &USUAL, WEIGHT).0.found;
        assert_eq!(without.iter().map(|c| c.causes.clone()).collect::<Vec<_>>(), [vec![GRADE, STANDING]]);
        // Not where it would climb 53 degrees.
        let harder = Leg { straight: STRAIGHT + 0.8 * WEIGHT, ..Leg::straight(20.0) };
        let legs = [Leg::straight(30.0), harder, Leg::straight(30.0)];
        let mut runs = [drive(&legs, false)];
        let (changes, standing) = mark(&mut runs, &USUAL, WEIGHT);
        assert_eq!((changes.found, standing.len()), (Vec::new(), 1));
    }

    #[test]
    fn a_robot_that_pushes_longer_than_it_drives_stands_too() {
        // All that is driven straight beside it takes less than the currents show.
        let pushing = Leg { straight: STRAIGHT + 0.5 * WEIGHT, ..Leg::straight(20.0) };
        let legs = [Leg::turn(10.0), pushing, Leg::turn(10.0), Leg { straight: 0.2 * STRAIGHT, ..Leg::straight(8.0) }];
        let mut runs = [drive(&legs, true)];
        let (changes, standing) = mark(&mut runs, &USUAL, WEIGHT);
        assert_eq!(standing.len(), 1, "{:?}", changes.found);
        let [from, until] = standing[0].interval;
        assert!((9.0..12.0).contains(&from) && near([until, until], 30.0), "{standing:?}");
    }
}
