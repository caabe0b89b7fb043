//! What current sensors read when nothing flows.
//!
//! An offset of the sensor adds to one way of driving what it takes from the other: a robot that drives backward for a while seems
//! to be on other ground there. Where the robot stands with its drive at rest the offset is all that is read. On a slope a drive
//! may hold the robot there; that torque changes its sign with the heading, an offset does not.

use inference::robust::median;

use crate::heading::{apart, headings};
use crate::pieces::pieces;
use crate::run::SpeedRun;
use crate::settings::{CHANGES, MEASURING, changes::Jumps, measuring::Zero};
use crate::straight::is_straight;

const ZERO: Zero = MEASURING.zero;
const JUMPS: Jumps = CHANGES.jumps;

/// A stretch in which the robot stands: whether it has not driven yet, where it looks, rad, and what each side reads, N m.
struct Rest {
    is_first: bool,
    heading: f64,
    torque: [f64; 2],
}

/// Rows of the stretches of a recording in which the drive is at rest.
pub(crate) fn rows_at_rest(run: &SpeedRun) -> Vec<Vec<usize>> {
    // Wheels that are held at a command are no drive at rest.
    let is_asked =
        |i: usize| run.commanded.as_ref().is_some_and(|of| of.iter().any(|side| side[i].abs() >= ZERO.still));
    let is_still = |i: &usize| is_slow(run, *i) && !is_asked(*i) && run.held(*i, ZERO.still, ZERO.settled);
    let stretches = pieces(&run.time, (0..run.time.len()).filter(is_still), ZERO.gap);
    stretches.into_iter().filter(|rows| rows.len() as f64 * run.period() >= ZERO.least).collect()
}

/// Rows of the stretches in which a robot is left standing: nothing is asked of its wheels or, where that is not recorded, its drive is at
/// rest.
pub(crate) fn rows_left_standing(run: &SpeedRun) -> Vec<Vec<usize>> {
    let Some(commanded) = &run.commanded else { return rows_at_rest(run) };
    let is_left = |i: &usize| commanded.iter().all(|side| side[*i].abs() < ZERO.still);
    pieces(&run.time, (0..run.time.len()).filter(is_left), ZERO.gap)
}

fn is_slow(run: &SpeedRun, i: usize) -> bool {
    (0..2).all(|j| run.speed[j][i].abs() < ZERO.still)
}

/// Stretches of a recording in which the drive is at rest.
fn rests(run: &SpeedRun) -> Vec<Rest> {
    // Without a yaw rate it may have turned: references alone confirm what is read then.
    let heading = headings(run);
    let moves_from = (0..run.time.len()).find(|&i| !is_slow(run, i)).unwrap_or(run.time.len());
    let of = |rows: Vec<usize>| {
        let side = |j: usize| median(rows.iter().map(|&i| run.torque[j][i])).unwrap_or(0.0);
        let heading = heading.as_ref().map_or(0.0, |heading| heading[rows[0]]);
        Rest { is_first: rows[0] < moves_from, heading, torque: [side(0), side(1)] }
    };
    rows_at_rest(run).into_iter().map(of).collect()
}

/// The stretch before the robot drives.
fn first(rests: &[Rest]) -> Option<&Rest> {
    rests.first().filter(|rest| rest.is_first)
}

/// What both sides read before they drive, N m, if all recordings agree, and some stretch in which the robot looks another way or
/// the references do, too. After a turn sides may be wound up against each other: such stretches say nothing.
fn at_rest(references: &[SpeedRun], recordings: &[SpeedRun]) -> Option<[f64; 2]> {
    let [of_references, of_recordings] =
        [references, recordings].map(|runs| runs.iter().map(rests).collect::<Vec<_>>());
    let all = || of_references.iter().chain(&of_recordings);
    let firsts = |runs: &[Vec<Rest>]| runs.iter().filter_map(|rests| first(rests)).count();
    let before = || all().filter_map(|rests| first(rests));

    let zero = [0, 1].map(|j| median(before().map(|r| r.torque[j])).unwrap_or(0.0));
    let largest = zero[0].abs().max(zero[1].abs());
    let agrees = |r: &Rest| (0..2).all(|j| (r.torque[j] - zero[j]).abs() <= ZERO.agree * largest);
    let looks_elsewhere =
        |rests: &Vec<Rest>| rests.iter().any(|r| agrees(r) && apart(r.heading, rests[0].heading) > JUMPS.other_heading);
    let is_confirmed = firsts(&of_references) > 0 && firsts(&of_recordings) > 0 || all().any(looks_elsewhere);
    let driven = references.iter().chain(recordings).flat_map(|run| run.torque.iter().flatten());
    let usual = median(driven.map(|torque| torque.abs()).filter(|torque| *torque > 0.0)).unwrap_or(0.0);
    (largest > ZERO.matters * usual && before().all(agrees) && is_confirmed).then_some(zero)
}

/// What driving forward takes more of than driving backward, halved, per side, N m: medians of straight driving. `None` where a
/// recording does not hold both.
fn forward_less_backward(run: &SpeedRun) -> Option<[f64; 2]> {
    let rows: Vec<usize> = (0..run.time.len())
        .filter(|&i| run.reads(i, 0) && run.reads(i, 1) && is_straight(run, i, MEASURING.straight.hold))
        .collect();
    let mean = |j: usize, way: f64| {
        let own = rows.iter().filter(|&&i| run.forward(i) * way > 0.0);
        median(own.map(|&i| run.torque[j][i].abs()))
    };
    let [left, right] = [0, 1].map(|j| Some(0.5 * (mean(j, 1.0)? - mean(j, -1.0)?)));
    Some([left?, right?])
}

/// The sign of an offset of sensors that show none: the way of driving to which it adds.
fn sign<'a>(runs: impl Iterator<Item = &'a SpeedRun>, zero: [f64; 2]) -> Option<[f64; 2]> {
    let seen: Vec<[f64; 2]> = runs.filter_map(forward_less_backward).collect();
    let of_side = |j: usize| {
        let first = seen.first()?[j].signum();
        let [least, most] = ZERO.seen;
        let is_it = |d: &[f64; 2]| (least * zero[j]..=most * zero[j]).contains(&(d[j] * first));
        (zero[j] == 0.0 || seen.iter().all(is_it)).then_some(first)
    };
    Some([of_side(0)?, of_side(1)?])
}

/// Takes what current sensors read at rest off all they read; returns it for each side, N m. Nothing where it is not known, with
/// its sign.
pub(crate) fn remove(references: &mut [SpeedRun], recordings: &mut [SpeedRun]) -> Option<[f64; 2]> {
    let zero = at_rest(references, recordings)?;
    let all = || references.iter().chain(&*recordings);
    let is_unsigned = all().any(|run| run.magnitude_only);
    if is_unsigned && !all().all(|run| run.magnitude_only) {
        return None;
    }
    let sign = if is_unsigned { sign(all(), zero)? } else { [1.0; 2] };
    for run in references.iter_mut().chain(recordings) {
        if run.dead_band > 0.0 {
            run.hidden = run.dead_band + zero[0].abs().max(zero[1].abs());
        }
        for j in 0..2 {
            for (torque, speed) in run.torque[j].iter_mut().zip(&run.speed[j]).filter(|(t, _)| t.abs() > run.dead_band)
            {
                let way = if is_unsigned { speed.signum() } else { 1.0 };
                let less = *torque - sign[j] * zero[j] * way;
                *torque = if is_unsigned { less.max(0.0) } else { less };
            }
        }
    }
    Some([sign[0] * zero[0], sign[1] * zero[1]])
}

/// What is told of it.
pub(crate) fn told(zero: [f64; 2]) -> String {
    format!(
        "before the robot drives its current or torque sensors read as {:.2} N m on the left and {:.2} N m on the right in all \
         recordings: this offset was taken off all readings",
        zero[0], zero[1]
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::changes::changes;
    use crate::pieces::Usual;
    use crate::settings::changes::Pieces;
    use crate::testing::{Leg, STRAIGHT, WEIGHT, drive};

    const PIECES: Pieces = CHANGES.pieces;
    const USUAL: Usual = Usual { load: [Some(STRAIGHT), None, None], unequal: PIECES.alike };

    /// There, a turn, and back by driving backward; at rest before and after. Currents with a sign, off by `offset` N m.
    fn run(offset: f64, slope: f64) -> SpeedRun {
        let rest = Leg { speed: [0.0; 2], straight: 0.0, scrub: 0.0, ..Leg::straight(4.0) };
        let back = Leg { speed: [-0.24; 2], ..Leg::straight(15.0) };
        let legs = [rest, Leg::straight(30.0), Leg::turn(8.0), back.slope(slope), rest];
        let mut run = drive(&legs, false);
        run.magnitude_only = false;
        run.dead_band = 0.0;
        for j in 0..2 {
            for i in 0..run.time.len() {
                let way = if run.speed[j][i] == 0.0 { 1.0 } else { run.speed[j][i].signum() };
                let own = if run.speed[j][i] == 0.0 { 0.0 } else { run.torque[j][i] };
                run.torque[j][i] = own * way + offset;
            }
        }
        run
    }

    #[test]
    fn an_offset_that_shows_at_every_rest_is_no_other_ground_where_the_robot_drives_backward() {
        let mut off = run(-1.2, 0.0);
        assert_eq!(changes(&off, &USUAL, WEIGHT).found.len(), 1, "it would be told");
        let zero = remove(&mut [], std::slice::from_mut(&mut off)).expect("seen");
        assert!(zero.iter().all(|z| (z + 1.2).abs() < 1e-9), "{zero:?}");
        assert_eq!(changes(&off, &USUAL, WEIGHT).found, []);
        // What changes beside it is still found.
        let mut slope = run(-1.2, 4.0);
        remove(&mut [], std::slice::from_mut(&mut slope)).expect("seen");
        assert_eq!(changes(&slope, &USUAL, WEIGHT).found.len(), 1);
        // Without one nothing is taken off.
        assert_eq!(remove(&mut [], &mut [run(0.0, 0.0)]), None);
    }

    #[test]
    fn wheels_that_are_held_at_a_command_show_no_offset() {
        let mut held = run(-1.2, 0.0);
        held.commanded = Some([0, 1].map(|_| vec![0.24; held.time.len()]));
        assert_eq!(remove(&mut [], &mut [held]), None);
    }

    #[test]
    fn of_currents_without_a_sign_the_way_of_driving_shows_that_of_their_offset() {
        let unsigned = |offset: f64| {
            let mut run = run(offset, 0.0);
            run.torque.iter_mut().flatten().for_each(|t| *t = t.abs());
            run.magnitude_only = true;
            run
        };
        for offset in [-1.2, 1.2] {
            let mut off = unsigned(offset);
            let zero = remove(&mut [], std::slice::from_mut(&mut off)).expect("seen");
            assert!(zero.iter().all(|z| (z - offset).abs() < 1e-9), "{zero:?}");
            assert_eq!(changes(&off, &USUAL, WEIGHT).found, []);
        }
        // Readings at rest that no difference between the ways confirms are something else.
        let mut held = unsigned(0.0);
        for i in 0..held.time.len() {
            if held.speed[0][i] == 0.0 {
                held.torque.iter_mut().for_each(|side| side[i] = 1.2);
            }
        }
        assert_eq!(remove(&mut [], std::slice::from_mut(&mut held)), None);
    }

    #[test]
    fn an_offset_that_a_dead_band_hides_at_rest_is_no_other_ground_and_what_is_more_than_that_is() {
        let hidden = |offset: f64, slope: f64, dead_band: f64| {
            let mut run = run(offset, slope);
            run.dead_band = dead_band;
            for side in &mut run.torque {
                side.iter_mut().filter(|t| t.abs() < dead_band).for_each(|t| *t = 0.0);
            }
            assert_eq!(remove(&mut [], std::slice::from_mut(&mut run)), None);
            changes(&run, &USUAL, WEIGHT).found.len()
        };
        assert_eq!(hidden(-1.2, 0.0, 1.5), 0);
        assert_eq!(hidden(0.0, -4.0, 1.5), 1, "no offset within the dead band pulls that much");
    }

    #[test]
    fn a_drive_that_holds_the_robot_on_a_slope_reads_otherwise_when_it_looks_another_way() {
        let mut held = run(0.0, 0.0);
        let half = held.time.len() / 2;
        for i in 0..held.time.len() {
            if held.speed[0][i] == 0.0 {
                let holds = if i < half { 1.2 } else { -0.4 };
                held.torque.iter_mut().for_each(|side| side[i] = holds);
            }
        }
        assert_eq!(remove(&mut [], std::slice::from_mut(&mut held)), None);
    }

    #[test]
    fn a_robot_that_stands_one_way_only_needs_references_that_read_the_same() {
        let until_the_turn = |mut run: SpeedRun| {
            let rows = run.time.partition_point(|t| *t < 34.0);
            run = run.head(rows);
            run
        };
        let once = || until_the_turn(run(-1.2, 0.0));
        assert_eq!(remove(&mut [], &mut [once()]), None);
        assert!(remove(&mut [once()], &mut [once()]).is_some());
        assert_eq!(remove(&mut [until_the_turn(run(0.6, 0.0))], &mut [once()]), None, "they read otherwise");

        // Without a yaw rate references confirm it all the same, and what a side in its dead band may have grows by it.
        let unseen = || SpeedRun { yaw_rate: None, dead_band: 0.1, hidden: 0.1, ..once() };
        let mut recordings = [unseen()];
        assert!(remove(&mut [unseen()], &mut recordings).is_some());
        assert!((recordings[0].hidden - 1.3).abs() < 1e-9, "{}", recordings[0].hidden);
        // After driving sides may be wound up against each other.
        let driven = || {
            let mut run = once();
            let rows = run.time.partition_point(|t| *t < 2.0);
            run.speed.iter_mut().for_each(|side| side[..rows].fill(0.2));
            run
        };
        assert_eq!(remove(&mut [driven()], &mut [driven()]), None);
        assert_eq!(
            remove(&mut [until_the_turn(run(0.01, 0.0))], &mut [until_the_turn(run(0.01, 0.0))]),
            None,
            "too small"
        );
    }
}
