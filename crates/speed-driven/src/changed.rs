//! Which rows of a recording show the load of a change, and not that of the recording.

use verdict::LoadChange;

use crate::pieces::GRADE;
use crate::run::SpeedRun;
use crate::straight::readings;

/// Times of straight driving on slopes, and of that beside them, s.
fn on_and_off_slopes(run: &SpeedRun, found: &[LoadChange]) -> [Vec<f64>; 2] {
    let straight: Vec<f64> = readings(run).iter().zip(&run.time).filter_map(|(r, t)| r.map(|_| *t)).collect();
    straight.iter().partition(|t| is_in(found, **t, true)).into()
}

/// Whether a time is on a slope, or in a change that is none.
fn is_in(found: &[LoadChange], t: f64, slopes: bool) -> bool {
    let is_slope = |c: &LoadChange| c.causes == [GRADE] && !c.relative;
    found.iter().any(|c| is_slope(c) == slopes && c.interval[0] <= t && t <= c.interval[1])
}

/// Whether most straight driving is on slopes.
pub(crate) fn slopes_lead(run: &SpeedRun, found: &[LoadChange]) -> bool {
    let [sloping, level] = on_and_off_slopes(run, found);
    sloping.len() > level.len()
}

/// Rows whose straight load is that of a change. What covers most of the straight driving is the load of the recording, but for
/// slopes: the ground beside them is its ground, unless they are under most of it themselves.
pub(crate) fn changed_rows(run: &SpeedRun, found: &[LoadChange]) -> Vec<bool> {
    let [sloping, level] = on_and_off_slopes(run, found);
    let slopes_lead = sloping.len() > level.len();
    let most = 2 * level.iter().filter(|t| is_in(found, **t, false)).count() > level.len();
    run.time.iter().map(|&t| !slopes_lead && is_in(found, t, true) || !most && is_in(found, t, false)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pieces::ROLLING;
    use crate::testing::{Leg, drive};

    #[test]
    fn slopes_leave_the_load_of_a_recording_though_changes_cover_most_of_it() {
        let change = |from: f64, until: f64, causes: &[verdict::Word]| LoadChange {
            recording: "run".to_owned(),
            interval: [from, until],
            onset: [from; 2],
            end: [until; 2],
            seconds: until - from,
            ratio: None,
            slope: 0.0,
            slope_half: 0.0,
            bound: false,
            relative: false,
            causes: causes.to_vec(),
            reason: "".into(),
        };
        let run = drive(&[Leg::straight(100.0)], false);
        let at = |rows: &[bool], t: f64| rows[run.time.partition_point(|row| *row < t)];
        let [slope, soft] = [change(10.0, 30.0, &[GRADE]), change(35.0, 95.0, &[ROLLING])];
        let rows = changed_rows(&run, &[slope.clone(), soft]);
        assert!(at(&rows, 20.0) && !at(&rows, 50.0) && !at(&rows, 98.0));
        let rows = changed_rows(&run, &[slope, change(35.0, 50.0, &[ROLLING])]);
        assert!(at(&rows, 20.0) && at(&rows, 40.0) && !at(&rows, 60.0));
        // Slopes under most of it are what it was driven on.
        assert!(!at(&changed_rows(&run, &[change(10.0, 90.0, &[GRADE])]), 20.0));
    }
}
