//! When inside a recording the straight load changes, and whether a slope or the ground does it.
//!
//! From currents alone: the straight load as a piecewise constant course ([`level`](super::level)). With all three
//! turning rates: the slope under the robot ([`attitude`](super::attitude)), and what of the load is left after it.

use crate::attitude::{Attitude, attitude};
use crate::jumps::{Tilt, jumps};
use crate::level::levels;
use crate::pieces::{ByClass, Usual, class};
use crate::run::SpeedRun;
use crate::settings::{CHANGES, NAMING, changes::Pieces};
use crate::slopes::{Slopes, slopes};
use crate::straight::{Reading, readings};
use inference::robust::median;
use verdict::{Changes, Hidden};

const PIECES: Pieces = CHANGES.pieces;

/// The load of the run's usual ground at each speed class: what is like the references where there is enough of it, else most
/// of what a cold drive train can make of theirs, else a little of what is like the references, else most of the run, which is then
/// compared with itself.
///
/// One ground changes the loads of all speeds by about one factor: a class that was driven on other ground alone is no usual
/// load.
fn usual_of(run: &SpeedRun, (readings, level): (&[Option<Reading>], &[f64]), usual: &Usual, weight: f64) -> ByClass {
    let Some(any) = usual.any() else { return usual.load };
    let known = usual.load.map(|own| own.unwrap_or(any));
    let class_of = |i: usize| class(run.forward(i).abs());
    // What no ground resists is pushing against something, however long it lasts.
    let may_roll = |i: usize, reading: Reading| {
        reading.is_exact() && reading.value() - known[class_of(i)] <= CHANGES.jumps.blocked * weight
    };
    let exact: Vec<usize> =
        (0..level.len()).filter(|&i| level[i] > 0.0 && readings[i].is_some_and(|r| may_roll(i, r))).collect();
    let over = |i: &usize| level[*i] / known[class_of(*i)];
    let lasting = |ratios: Vec<f64>, least: f64| {
        if ratios.len() as f64 * run.period() >= least { median(ratios) } else { None }
    };
    let enough = |ratios: Vec<f64>| lasting(ratios, PIECES.known);
    let within = |of: f64, factor: f64| move |ratio: &f64| *ratio < of * factor && *ratio > of / factor;

    let all = || exact.iter().map(over);
    let known_ground = || all().filter(within(1.0, usual.unequal)).collect();
    let like = enough(known_ground());
    let plausible = || enough(all().filter(within(1.0, NAMING.priors.unnamed_straight)).collect());
    // A little of the known ground says more than much of what no drive train makes of it.
    let little = || lasting(known_ground(), PIECES.little);
    let factor = like.or_else(plausible).or_else(little).or_else(|| enough(all().collect())).unwrap_or(1.0);
    std::array::from_fn(|c| {
        let of_class = exact.iter().filter(|i| class_of(**i) == c).map(over);
        let own = enough(of_class.filter(within(factor, usual.unequal)).collect());
        Some(known[c] * own.unwrap_or(factor))
    })
}

/// Changes of the straight load in a recording.
#[cfg(test)]
pub(crate) fn changes(run: &SpeedRun, usual: &Usual, weight: f64) -> Changes {
    inside(run, usual, weight).0
}

/// Changes of the straight load in a recording, and its attitude where the turning rates are known. `usual` are the references'
/// loads, `weight` is `m g r`, N m.
pub(crate) fn inside(run: &SpeedRun, usual: &Usual, weight: f64) -> (Changes, Option<Attitude>) {
    let readings = readings(run);
    let Some(any) = usual.any() else { return Default::default() };
    let period = run.period();
    let found = attitude(run, &readings, any, weight, &[]);
    let slopes = found.as_ref().map_or_else(Slopes::default, |s| slopes(run, s));
    // What is sloping there is not drawn to the level.
    let slope = found.and_then(|a| {
        if slopes.found.is_empty() { Some(a) } else { attitude(run, &readings, any, weight, &slopes.stretches()) }
    });
    let slopes = match &slope {
        Some(attitude) => slopes.measured_again(run, attitude),
        None => slopes,
    };
    // What a slope explains is no change of the ground; elsewhere the tilt is too uncertain to correct a load by it.
    let sloping = slopes.stretches();
    let is_sloping = |t: f64| sloping.iter().any(|[from, until]| *from <= t && t <= *until);
    let level_ground = |slope: &Attitude| -> Vec<Option<Reading>> {
        let pitch = |i: usize| if is_sloping(run.time[i]) { slope.pitch[i] } else { 0.0 };
        let pull = |i: usize| weight * pitch(i) * run.forward(i).signum();
        let less = |i: usize, r: Reading| match r {
            Reading::Exact(x) => Reading::Exact(x - pull(i)),
            Reading::AtMost(x) => Reading::AtMost(x - pull(i)),
        };
        (0..readings.len()).map(|i| readings[i].map(|r| less(i, r))).collect()
    };
    let rest = slope.as_ref().map_or_else(|| readings.clone(), level_ground);
    let level = levels(&rest, any, period);
    let usual = usual_of(run, (&rest, &level), usual, weight);
    let mut found = slopes.found;
    // The pull that was taken away errs by the angle, and by the losses of a drive train that grow with what it carries.
    let pull_sigma = |i: usize| {
        let by_angle = |slope: &Attitude| slope.sigma[i].hypot(CHANGES.slopes.losses * slope.pitch[i]);
        if is_sloping(run.time[i]) { weight * slope.as_ref().map_or(0.0, by_angle) } else { 0.0 }
    };
    let is_levelled = run.body_rates.as_ref().is_some_and(|rates| rates.level.is_some());
    let tilt = slope.as_ref().map(|a| Tilt {
        pull_sigma: &pull_sigma,
        is_levelled,
        turned: &a.turned,
        is_sloping: &is_sloping,
    });
    found.extend(jumps(run, &rest, &level, &usual, weight, tilt.as_ref()));
    (Changes { found, tentative: slopes.tentative, hidden: hidden(run, &readings) }, slope)
}

/// Driving that shows no straight load for a while.
fn hidden(run: &SpeedRun, readings: &[Option<Reading>]) -> Vec<Hidden> {
    let seen = |i: &usize| readings[*i].is_some();
    let ends = [0, run.time.len() - 1];
    let mut marks: Vec<usize> = (0..readings.len()).filter(seen).chain(ends).collect();
    marks.sort_unstable();
    let moves =
        |from: usize, until: usize| (from..until).any(|i| (0..2).any(|j| run.speed[j][i].abs() > PIECES.driving));
    let gaps = marks.windows(2).filter(|w| run.time[w[1]] - run.time[w[0]] > PIECES.apart && moves(w[0], w[1]));
    gaps.map(|w| Hidden { recording: run.name.clone(), interval: [run.time[w[0]], run.time[w[1]]] }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pieces::{GRADE, ROLLING, UNLISTED};
    use crate::testing::{Leg, STRAIGHT, WEIGHT, drive, levelled};
    use verdict::LoadChange;

    const USUAL: Usual = Usual { load: [Some(STRAIGHT), None, None], unequal: PIECES.alike };

    fn found(legs: &[Leg], gyro: bool) -> Vec<LoadChange> {
        changes(&drive(legs, gyro), &USUAL, WEIGHT).found
    }

    fn near([a, b]: [f64; 2], moment: f64) -> bool {
        b - a < 1.0 && a - 1.0 < moment && moment < b + 1.0
    }

    #[test]
    fn a_climb_is_found_with_its_slope_and_both_causes() {
        let all = found(&[Leg::straight(30.0), Leg::straight(15.0).slope(3.0), Leg::straight(30.0)], false);
        assert_eq!(all.len(), 1, "{all:?}");
        let c = &all[0];
        assert!(near(c.onset, 30.0) && near(c.end, 45.0), "{c:?}");
        assert!(!c.bound && (c.slope - 3.0).abs() < 0.5 && c.slope_half > 0.5, "{c:?}");
        assert_eq!(c.causes, [GRADE, ROLLING]);
    }

    #[test]
    fn a_descent_into_the_dead_band_is_a_bound_and_no_friction() {
        let all = found(&[Leg::straight(30.0), Leg::straight(15.0).slope(-6.0), Leg::straight(30.0)], false);
        assert_eq!(all.len(), 1, "{all:?}");
        let c = &all[0];
        assert!(near(c.onset, 30.0) && near(c.end, 45.0), "{c:?}");
        assert!(c.bound && c.slope < -2.0 && c.slope > -6.0, "{c:?}");
        assert_eq!(c.causes, [GRADE]);
    }

    #[test]
    fn a_cold_drive_train_and_a_dearer_turn_are_no_change() {
        let cold = |leg: Leg| Leg { straight: 1.35 * STRAIGHT, ..leg };
        assert_eq!(found(&[cold(Leg::straight(40.0))], false), []);
        let turns = [Leg::straight(20.0), Leg { scrub: 40.0, ..Leg::turn(10.0) }, Leg::straight(20.0)];
        let out = changes(&drive(&turns, false), &USUAL, WEIGHT);
        assert_eq!(out.found, []);
        let hidden: Vec<[f64; 2]> = out.hidden.iter().map(|h| h.interval).collect();
        assert_eq!(hidden.len(), 1);
        assert!((hidden[0][0] - 20.0).abs() < 0.5 && (hidden[0][1] - 31.0).abs() < 0.6, "{hidden:?}");
    }

    /// Both sides hold what the turn before took, and let go with a time constant of 4 s: the right one pulls, the left one brakes.
    fn let_go(run: &mut SpeedRun, from: f64) {
        for i in (0..run.time.len()).filter(|&i| run.time[i] >= from) {
            let held = 35.0 * (-(run.time[i] - from) / 4.0).exp();
            for (j, sign) in [(0, -1.0), (1, 1.0)] {
                let shown = (0.5 * STRAIGHT + sign * held).abs();
                run.torque[j][i] = if shown > run.dead_band { shown } else { 0.0 };
            }
        }
    }

    #[test]
    fn sides_that_let_go_after_a_turn_are_no_other_ground() {
        let legs = [Leg::straight(30.0), Leg::turn(10.0), Leg::straight(5.0), Leg::turn(10.0), Leg::straight(20.0)];
        let mut run = drive(&legs, false);
        let before = run.torque.clone();
        let_go(&mut run, 40.0);
        // A measured speed that is off for once interrupts the stretch.
        let off = run.time.partition_point(|t| *t < 41.6);
        run.speed[0][off] += 0.04;
        for (own, before) in run.torque.iter_mut().zip(&before) {
            // The second turn and what follows are as they were.
            let second = run.time.partition_point(|t| *t < 45.0);
            own[second..].copy_from_slice(&before[second..]);
        }
        assert_eq!(changes(&run, &USUAL, WEIGHT).found, []);
        // Ground that takes the same sum from both sides alike, and less and less, is other ground.
        for i in (0..run.time.len()).filter(|&i| (40.0..45.0).contains(&run.time[i])) {
            let both = 0.5 * (run.torque[0][i] + run.torque[1][i]);
            run.torque.iter_mut().for_each(|side| side[i] = both);
        }
        assert_eq!(changes(&run, &USUAL, WEIGHT).found.len(), 1);
    }

    #[test]
    fn a_little_of_the_known_ground_says_more_than_much_that_no_drive_train_explains() {
        let soft = Leg { straight: 2.2 * STRAIGHT, ..Leg::straight(40.0) };
        let all = found(&[Leg::straight(8.0), soft], false);
        assert_eq!(all.len(), 1, "{all:?}");
        assert!(all[0].slope > 0.0 && all[0].interval[0] > 7.0, "{all:?}");
    }

    #[test]
    fn what_begins_in_a_turn_is_bracketed() {
        let all =
            found(&[Leg::straight(30.0), Leg::turn(10.0), Leg::straight(15.0).slope(4.0), Leg::straight(20.0)], false);
        assert_eq!(all.len(), 1, "{all:?}");
        let [a, b] = all[0].onset;
        assert!(a < 30.1 && b > 40.0, "{all:?}");
    }

    #[test]
    fn other_ground_goes_on_beyond_turns_until_it_is_usual_again() {
        // By no more than cold drive trains differ: each part by itself could be one, but the first jumped.
        let soft = Leg { straight: 1.42 * STRAIGHT, ..Leg::straight(15.0) };
        let legs = [Leg::straight(30.0), soft, Leg::turn(12.0), soft, Leg::turn(12.0), soft];
        let all = found(&legs, false);
        let ends: Vec<f64> = all.iter().map(|c| c.interval[1]).collect();
        assert!(all.len() == 3 && ends[2] > 98.0, "{ends:?}");
        // Without a jump it is a cold drive train.
        assert_eq!(found(&legs[1..], false), []);
    }

    #[test]
    fn the_way_back_decides() {
        let back = Leg { speed: [-0.24, -0.24], ..Leg::straight(15.0) };
        let legs = [
            Leg::straight(30.0),
            Leg::straight(15.0).slope(2.6),
            Leg::straight(20.0),
            back.slope(2.6),
            Leg::straight(20.0),
        ];
        let all = found(&legs, false);
        assert_eq!(all.len(), 2, "{all:?}");
        assert!(all[0].slope > 2.0 && all[1].slope < -1.0, "{all:?}");
        assert_eq!(all[0].causes, [GRADE], "{all:?}");
    }

    #[test]
    fn with_a_gyro_slope_and_ground_are_told_apart() {
        let slope = found(&[Leg::straight(30.0), Leg::straight(15.0).slope(4.0), Leg::straight(30.0)], true);
        assert_eq!(slope.len(), 1, "{slope:?}");
        assert_eq!(slope[0].causes, [GRADE]);
        assert!(
            (slope[0].slope - 4.0).abs() < 0.6 && near(slope[0].onset, 30.0) && near(slope[0].end, 45.0),
            "{slope:?}"
        );
        let soft = Leg { straight: 2.0 * STRAIGHT, ..Leg::straight(15.0) };
        let ground = found(&[Leg::straight(30.0), soft, Leg::straight(30.0)], true);
        assert_eq!(ground.len(), 1, "{ground:?}");
        assert_eq!(ground[0].causes, [ROLLING]);
        assert!(near(ground[0].onset, 30.0), "{ground:?}");
        assert_eq!(found(&[Leg::straight(60.0)], true), []);
    }

    #[test]
    fn a_zero_of_the_gyro_that_nobody_knows_is_no_slope() {
        let mut run = drive(&[Leg::straight(60.0)], true);
        let rates = run.body_rates.as_mut().expect("three rates");
        rates.rate[1].iter_mut().for_each(|rate| *rate += 0.35_f64.to_radians());
        assert!(!changes(&run, &USUAL, WEIGHT).found.is_empty(), "a zero that is known to be right is a slope");
        run.body_rates.as_mut().expect("three rates").is_zero_known = false;
        assert_eq!(changes(&run, &USUAL, WEIGHT).found, []);
    }

    #[test]
    fn where_no_slope_shows_a_load_below_any_friction_is_a_push_and_a_pull_one_way_is_no_ground() {
        let pushed = [Leg::straight(30.0), Leg { straight: 0.0, ..Leg::straight(15.0) }, Leg::straight(30.0)];
        let causes = |run: &SpeedRun| -> Vec<_> {
            let found = changes(run, &USUAL, WEIGHT).found;
            found.iter().map(|c| c.causes.clone()).collect()
        };
        assert_eq!(causes(&levelled(&pushed, 0.0)), [vec![UNLISTED]]);
        assert_eq!(causes(&drive(&pushed, true)), [vec![UNLISTED]], "the nose would have sunk");
        // Turned onto, rates show no ramp.
        let onto = [Leg::straight(30.0), Leg::turn(8.0), Leg { straight: 0.0, ..Leg::straight(15.0) }];
        assert_eq!(causes(&drive(&onto, true)), [vec![GRADE]]);
        // Where another slope goes on, rates that show no ramp do not say that the ground is level.
        let down = Leg { straight: 0.0, ..Leg::straight(8.0) };
        let up = Leg { seconds: 12.0, ..Leg::straight(15.0).slope(5.0) };
        let climb = [Leg::straight(30.0), up, Leg::turn(8.0), down, up, Leg::straight(30.0)];
        let all = causes(&drive(&climb, true));
        assert!(all.len() > 1 && all.iter().all(|c| *c == [GRADE]), "{all:?}");

        // Held back one way, pushed the other, on ground that is level all the time.
        let pull = |leg: Leg, straight: f64| Leg { straight: straight * STRAIGHT, ..leg };
        let back = Leg { speed: [-0.24; 2], ..Leg::straight(15.0) };
        let wind = [Leg::straight(30.0), pull(Leg::straight(15.0), 1.9), Leg::straight(12.0), pull(back, 0.45)];
        assert_eq!(causes(&levelled(&wind, 0.0)), [vec![UNLISTED], vec![UNLISTED]]);
    }

    #[test]
    fn a_roll_that_drifts_is_no_slope_once_the_robot_has_turned() {
        // The roll rate is off for a second before a turn of 90°, which makes the roll a pitch.
        let legs = [Leg::straight(30.0), Leg::turn(7.5), Leg::straight(2.0), Leg::turn(7.5), Leg::straight(30.0)];
        let mut run = drive(&legs, true);
        let rates = run.body_rates.as_mut().expect("three rates");
        for (t, roll) in rates.time.iter().zip(&mut rates.rate[0]) {
            if (28.0..29.0).contains(t) {
                *roll += 9_f64.to_radians();
            }
        }
        let all = changes(&run, &USUAL, WEIGHT);
        assert_eq!(all.found, []);
        assert!(!all.tentative.is_empty() && all.tentative.iter().all(|c| c.slope.abs() > 1.6), "{all:?}");
        // A slope of that size that is driven onto straight is one.
        let straight = [Leg::straight(30.0), Leg::straight(15.0).slope(3.0), Leg::straight(30.0)];
        let all = changes(&drive(&straight, true), &USUAL, WEIGHT);
        assert_eq!((all.found.len(), all.tentative.len()), (1, 0), "{all:?}");
    }

    #[test]
    fn on_soft_ground_the_accelerometer_is_the_level() {
        // Half of the run goes uphill, on ground that takes another load all the time.
        let soft = |leg: Leg| Leg { straight: 2.5 * STRAIGHT, ..leg };
        let legs = [soft(Leg::straight(40.0)), soft(Leg::straight(40.0).slope(8.0))];
        let slopes = |run: &SpeedRun| -> Vec<LoadChange> {
            let all = changes(run, &USUAL, WEIGHT).found;
            all.into_iter().filter(|c| c.causes == [GRADE]).collect()
        };
        let mut recordings = [levelled(&legs, 1.5)];
        crate::attitude::set_level(&[levelled(&[Leg::straight(40.0)], 1.5)], &mut recordings);
        let found = slopes(&recordings[0]);
        assert_eq!(found.len(), 1, "{found:?}");
        assert!((found[0].slope - 8.0).abs() < 1.0 && near(found[0].onset, 40.0), "{found:?}");
        // Without it the step is shared out: it is no angle against the horizon.
        let without = slopes(&drive(&legs, true));
        assert!(without.iter().all(|c| c.relative && c.reason.contains("accelerometer")), "{without:?}");
        assert!(!found[0].relative);
    }

    #[test]
    fn losses_that_grow_with_the_pull_of_a_slope_are_no_other_ground() {
        // The slope pulls 12.7 N m; a part of its stretch takes 2 N m more than that, which its losses may do.
        let losses = Leg { straight: STRAIGHT + 2.5, ..Leg::straight(15.0) };
        let legs = [Leg::straight(30.0), losses.slope(6.0), Leg::straight(30.0)];
        let all = changes(&levelled(&legs, 0.0), &USUAL, WEIGHT).found;
        assert!(all.len() == 1 && all[0].causes == [GRADE], "{all:?}");
        // Ground that takes as much again as the usual one is found on the slope, too.
        let soft = Leg { straight: 2.2 * STRAIGHT, ..Leg::straight(15.0) };
        let legs = [Leg::straight(30.0), soft.slope(6.0), Leg::straight(30.0)];
        let all = changes(&levelled(&legs, 0.0), &USUAL, WEIGHT).found;
        assert!(all.iter().any(|c| c.causes == [GRADE]) && all.iter().any(|c| c.causes == [ROLLING]), "{all:?}");
    }

    #[test]
    fn a_speed_that_was_driven_on_other_ground_alone_is_no_usual_load() {
        let fast = |leg: Leg| Leg { speed: [0.6, 0.6], ..leg };
        let usual = Usual::of_references([Some(STRAIGHT), Some(STRAIGHT), Some(STRAIGHT)]);
        let soft = Leg { straight: 1.7 * STRAIGHT, ..Leg::straight(30.0) };
        let found = changes(&drive(&[Leg::straight(40.0), fast(soft)], true), &usual, WEIGHT).found;
        assert_eq!(found.len(), 1, "{found:?}");
        let [before, after] = found[0].onset;
        assert!(before < 40.0 && after > 40.0 && after - before < 1.5, "{found:?}");
        // A cold drive train makes the loads of all speeds more by one factor.
        let cold = |leg: Leg| Leg { straight: 1.4 * STRAIGHT, ..leg };
        let legs = [cold(Leg::straight(40.0)), fast(cold(Leg::straight(30.0)))];
        assert_eq!(changes(&drive(&legs, true), &usual, WEIGHT).found, []);
    }
}
