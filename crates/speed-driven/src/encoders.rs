//! Encoders that show another speed than there is: one side is off what is set, and the body turns as is set.
//!
//! A motor that does not follow turns the body with it; an encoder that loses counts does not. What such an encoder shows is told
//! by itself: as a turn it would be one in which the body stands. Where the controller follows the counts that are left, both show what
//! is set and the wheel turns faster: the body then turns while both sides are set alike, in proportion to their speed.

use inference::robust::{MAD_TO_SIGMA, NINETY, median, median_absolute_deviation};
use verdict::WrongSpeed;

use crate::pieces::pieces;
use crate::run::SpeedRun;
use crate::settings::{CHANGES, changes::Encoders};

const ENCODERS: Encoders = CHANGES.encoders;

/// Finds them in these recordings and marks their rows, which leave all else; `track` is the effective one, m.
pub(crate) fn mark(references: &[SpeedRun], recordings: &mut [SpeedRun], track: f64) -> Vec<WrongSpeed> {
    let usual = usual(if references.is_empty() { recordings } else { references });
    let straight = [0, 1].map(|side| usually_rolls(references, side, track));
    let mut all: Vec<Vec<WrongSpeed>> =
        recordings.iter().map(|run| (0..2).flat_map(|side| of_side(run, side, usual, track)).collect()).collect();
    // What straight driving shows of a side is it in turns of another recording, too.
    let mut known: [Option<f64>; 2] = [None; 2];
    for _ in 0..2 {
        for (run, own) in recordings.iter().zip(&mut all) {
            for side in 0..2 {
                for wrong in of_followed(run, side, (usual, straight[side], known[side]), track) {
                    known[side] = known[side].or(Some(wrong.share));
                    if own.iter().all(|o| o.interval[1] < wrong.interval[0] || wrong.interval[1] < o.interval[0]) {
                        own.push(wrong);
                    }
                }
            }
        }
    }
    for (run, found) in recordings.iter_mut().zip(&all) {
        for (left_out, t) in run.standing.iter_mut().zip(&run.time) {
            *left_out |= found.iter().any(|wrong| (wrong.interval[0]..=wrong.interval[1]).contains(t));
        }
    }
    all.concat()
}

/// Speed shown over speed set of both sides at a row at which what is set has settled.
pub(crate) fn followed(run: &SpeedRun, i: usize) -> Option<[f64; 2]> {
    let set = run.commanded.as_ref()?;
    let is_near = |k: usize| (0..2).all(|j| (set[j][k] - set[j][i]).abs() <= ENCODERS.steady);
    let first = run.time.partition_point(|t| *t < run.time[i] - ENCODERS.settled);
    let is_settled = run.time[i] - run.time[0] >= ENCODERS.settled && (first..i).all(is_near);
    let is_asked = (0..2).all(|j| set[j][i].abs() > CHANGES.standstill.commanded);
    (is_settled && is_asked && !run.standing[i]).then(|| [0, 1].map(|j| run.speed[j][i] / set[j][i]))
}

/// What drives show of what is set, as a rule: that of the side that follows better, where an encoder may be off throughout.
pub(crate) fn usual(runs: &[SpeedRun]) -> f64 {
    let of_side =
        |j: usize| median(runs.iter().flat_map(|run| (0..run.time.len()).filter_map(|i| Some(followed(run, i)?[j]))));
    let shares = [of_side(0), of_side(1)].into_iter().flatten().filter(|share| *share > 0.0);
    shares.min_by(|a, b| a.ln().abs().total_cmp(&b.ln().abs())).unwrap_or(1.0)
}

/// Stretches in which the encoder of a side is off.
fn of_side(run: &SpeedRun, side: usize, usual: f64, track: f64) -> Vec<WrongSpeed> {
    let (Some(set), Some(yaw)) = (&run.commanded, &run.yaw_rate) else { return Vec::new() };
    let is_off = |i: &usize| {
        let Some(shares) = followed(run, *i) else { return false };
        let [own, other] = [side, 1 - side].map(|j| (shares[j] / usual - 1.0).abs());
        // What the body turns beyond what is set, over what the encoder shows beyond it.
        let asked = usual * (set[1][*i] - set[0][*i]);
        let shown = run.difference(*i) - asked;
        own > ENCODERS.off && other < ENCODERS.other && ((yaw[*i] * track - asked) / shown).abs() < ENCODERS.turned
    };
    let told = |rows: Vec<usize>| {
        let shares: Vec<f64> = rows.iter().filter_map(|&i| Some(followed(run, i)?[side] / usual)).collect();
        let share = median(shares.iter().copied())?;
        let scatter = MAD_TO_SIGMA * median_absolute_deviation(&shares)?;
        // Rows of one second say the same.
        let seconds = rows.len() as f64 * run.period();
        let wrong = WrongSpeed {
            recording: run.name.clone(),
            interval: [run.time[*rows.first()?], run.time[*rows.last()?]],
            side: inference::words::side(side).into(),
            share,
            half: NINETY * (scatter / seconds.max(1.0).sqrt()).hypot(ENCODERS.other / 2.0),
            is_followed: false,
        };
        (seconds >= ENCODERS.least).then_some(wrong)
    };
    let rows = (0..run.time.len()).filter(is_off);
    pieces(&run.time, rows, ENCODERS.apart).into_iter().filter_map(told).collect()
}

/// How far a side rolls over what it shows, by how the body turns, if the other side rolls as it shows.
fn rolls(run: &SpeedRun, side: usize, track: f64, i: usize) -> Option<f64> {
    let turned = run.yaw_rate.as_ref()?[i] * track;
    let [left, right] = [0, 1].map(|j| run.speed[j][i]);
    Some(if side == 1 { (turned + left) / right } else { (right - turned) / left })
}

/// Whether both sides are set to one speed.
fn is_straight(run: &SpeedRun, i: usize) -> bool {
    run.commanded.as_ref().is_some_and(|set| (set[1][i] - set[0][i]).abs() <= ENCODERS.steady)
}

/// The same of straight driving in these references; as it shows without any.
fn usually_rolls(runs: &[SpeedRun], side: usize, track: f64) -> f64 {
    let of_run = |run: &SpeedRun| -> Vec<f64> {
        let rows = (0..run.time.len()).filter(|&i| is_straight(run, i) && followed(run, i).is_some());
        rows.filter_map(|i| rolls(run, side, track, i)).collect()
    };
    median(runs.iter().flat_map(of_run)).unwrap_or(1.0)
}

/// Stretches in which a side rolls farther than it shows, in straight driving and in turns alike, although it shows what is set.
fn of_followed(
    run: &SpeedRun,
    side: usize,
    (usual, straight, known): (f64, f64, Option<f64>),
    track: f64,
) -> Vec<WrongSpeed> {
    let share = |i: usize| {
        let is_shown = followed(run, i)?.iter().all(|shown| (shown / usual - 1.0).abs() < ENCODERS.other);
        rolls(run, side, track, i).filter(|_| is_shown).map(|rolls| rolls / straight)
    };
    let is_off = |i: &usize| share(*i).is_some_and(|share| share > 1.0 + ENCODERS.rolls);
    let told = |rows: Vec<usize>| {
        let shares: Vec<f64> = rows.iter().filter_map(|&i| share(i)).collect();
        let rolls = median(shares.iter().copied())?;
        let scatter = MAD_TO_SIGMA * median_absolute_deviation(&shares)?;
        // A body that stands in a turn goes straight where that is set.
        let is_known = known.is_some_and(|share| (1.0 / rolls - share).abs() < ENCODERS.off);
        let straight = rows.iter().filter(|&&i| is_straight(run, i)).count() as f64 * run.period();
        let is_one = scatter <= ENCODERS.scatter * (rolls - 1.0);
        let seconds = rows.len() as f64 * run.period();
        let wrong = WrongSpeed {
            recording: run.name.clone(),
            interval: [run.time[*rows.first()?], run.time[*rows.last()?]],
            side: inference::words::side(side).into(),
            share: 1.0 / rolls,
            half: NINETY * (scatter / seconds.max(1.0).sqrt()).hypot(ENCODERS.other) / rolls.powi(2),
            is_followed: true,
        };
        (is_one && seconds >= ENCODERS.least && (is_known || straight >= ENCODERS.least)).then_some(wrong)
    };
    let rows = (0..run.time.len()).filter(is_off);
    pieces(&run.time, rows, ENCODERS.apart).into_iter().filter_map(told).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{Leg, drive};

    const TRACK: f64 = 0.77;

    /// A drive that follows what is set, straight and in turns.
    fn following() -> SpeedRun {
        let mut run = drive(&[Leg::straight(40.0), Leg::turn(10.0), Leg::straight(20.0)], false);
        run.commanded = Some(run.speed.clone());
        run
    }

    /// The same where the right side shows 0.7 of its speed between two instants.
    fn losing() -> SpeedRun {
        let mut run = following();
        for i in (0..run.time.len()).filter(|&i| (10.0..30.0).contains(&run.time[i])) {
            run.speed[1][i] *= 0.7;
        }
        run
    }

    #[test]
    fn an_encoder_that_loses_counts_is_found_with_its_side_and_its_rows_leave_all_else() {
        let mut runs = [losing()];
        let found = mark(&[], &mut runs, TRACK);
        assert_eq!(found.len(), 1, "{found:?}");
        let WrongSpeed { interval: [from, until], side, share, half, .. } = &found[0];
        assert_eq!(side, "right");
        assert!((9.9..10.5).contains(from) && (29.5..30.1).contains(until), "{found:?}");
        assert!((share - 0.7).abs() < 0.01 && *half < 0.05, "{found:?}");
        assert!(runs[0].standing.iter().zip(&runs[0].time).all(|(out, t)| *out == (*from <= *t && t <= until)));
        assert_eq!(crate::standstill::standstills(&runs[0], TRACK), []);
    }

    #[test]
    fn counts_that_the_controller_follows_turn_the_body_and_a_body_that_stands_is_no_encoder() {
        let faster = |from: f64, until: f64| {
            let mut run = following();
            for i in (0..run.time.len()).filter(|&i| (from..until).contains(&run.time[i])) {
                run.yaw_rate.as_mut().expect("a gyro")[i] += (1.0 / 0.7 - 1.0) * run.speed[1][i] / TRACK;
            }
            run
        };
        let mut runs = [faster(10.0, 40.0)];
        let found = mark(&[], &mut runs, TRACK);
        assert_eq!(found.len(), 1, "{found:?}");
        let WrongSpeed { interval: [from, until], side, share, half, is_followed, .. } = &found[0];
        assert_eq!((side.as_ref(), is_followed), ("right", &true));
        assert!((9.9..10.5).contains(from) && (39.5..40.1).contains(until), "{found:?}");
        assert!((share - 0.7).abs() < 0.02 && *half < 0.05, "{found:?}");
        assert_eq!(crate::standstill::standstills(&runs[0], TRACK), []);

        // What straight driving shows is told of arcs as well.
        let legs = [Leg { speed: [0.15, 0.3], ..Leg::straight(60.0) }];
        let mut arcs = drive(&legs, false);
        arcs.commanded = Some(arcs.speed.clone());
        let turned = (0..arcs.time.len()).map(|i| (arcs.speed[1][i] / 0.7 - arcs.speed[0][i]) / TRACK).collect();
        arcs.yaw_rate = Some(turned);
        assert_eq!(mark(&[], &mut [arcs.clone()], TRACK), []);
        let both = mark(&[], &mut [arcs, faster(10.0, 40.0)], TRACK);
        assert_eq!(both.iter().filter(|w| w.side == "right").count(), 2, "{both:?}");

        // As references have it, it is how this robot drives.
        assert_eq!(mark(&[faster(0.0, 70.0)], &mut [faster(0.0, 70.0)], TRACK), []);
        let mut stands = following();
        for i in (0..stands.time.len()).filter(|&i| (10.0..55.0).contains(&stands.time[i])) {
            stands.yaw_rate.as_mut().expect("a gyro")[i] = 0.0;
        }
        assert_eq!(mark(&[], &mut [stands], TRACK), []);
    }

    #[test]
    fn a_motor_that_does_not_follow_and_drives_that_all_show_less_are_no_encoder() {
        assert_eq!(mark(&[], &mut [following()], TRACK), []);
        // The body turns with the side that is slower.
        let mut weak = losing();
        let turned: Vec<f64> = (0..weak.time.len()).map(|i| weak.difference(i) / TRACK).collect();
        weak.yaw_rate = Some(turned);
        assert_eq!(mark(&[], &mut [weak], TRACK), []);
        let mut slow = following();
        slow.speed.iter_mut().flatten().for_each(|v| *v *= 0.8);
        slow.yaw_rate.iter_mut().flatten().for_each(|rate| *rate *= 0.8);
        assert_eq!(mark(&[], &mut [slow], TRACK), []);
        // Without what is set nobody knows.
        assert_eq!(mark(&[], &mut [SpeedRun { commanded: None, ..losing() }], TRACK), []);
    }
}
