//! When inside a recording turning begins or ceases to cost another torque: another ground.

use crate::extract::{inner_outer, is_steady_turn, right_outer};
use crate::level::levels;
use crate::model::{Operating, predicted};
use crate::run::SpeedRun;
use crate::settings::{CHANGES, changes::Scrub};
use crate::straight::Reading;
use crate::zero::rows_left_standing;
use inference::robust::{NINETY, mean, median, rms};
use robot_model::Robot;
use verdict::{Quantity, TurningChange, Way};

const SCRUB: Scrub = CHANGES.scrub;

/// What each side reads as the outer one of a turn, over what both read in the mean: as the robot was on its references.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sides {
    factor: [f64; 2],
    known: bool,
    /// Least and most that a turn may take on the references' ground, N m, where they turned often enough to tell: arcs of another
    /// radius, and spins beside arcs, cost another torque.
    range: Option<[f64; 2]>,
}

impl Sides {
    /// From the references' turns both ways; sides count as equal where these are missing.
    pub(crate) fn of(references: &[SpeedRun]) -> Self {
        let (mut sum, mut seconds, mut rows) = ([0.0; 2], [0.0; 2], [0.0; 2]);
        for run in references {
            for i in (0..run.time.len()).filter(|&i| is_steady_turn(run, i) && !run.spins(i)) {
                let side = run.outer(i);
                sum[side] += run.torque[side][i].abs();
                seconds[side] += run.period();
                rows[side] += 1.0;
            }
        }
        let mean = [0, 1].map(|j| sum[j] / f64::max(rows[j], 1.0));
        let middle = 0.5 * (mean[0] + mean[1]);
        let known = seconds.iter().all(|s| *s >= SCRUB.one_way) && mean.iter().all(|m| *m > 0.0);
        let out = Self { factor: if known { mean.map(|m| m / middle) } else { [1.0; 2] }, known, range: None };
        Self { range: out.range_of(references), ..out }
    }

    /// What turns of the references took, from the least to the most, each with their scatter beyond.
    fn range_of(self, references: &[SpeedRun]) -> Option<[f64; 2]> {
        let of_run = |run: &SpeedRun| -> Vec<f64> {
            let readings = readings(run, self);
            let rows: Vec<usize> = (0..readings.len()).collect();
            let turns = rows.chunk_by(|&a, &b| readings[a].is_some() == readings[b].is_some());
            let lasting = turns.filter(|turn| turn.len() as f64 * run.period() >= SCRUB.turn);
            let mean_of = |turn: &[usize]| mean(turn.iter().filter_map(|&i| readings[i]).map(Reading::value));
            lasting.filter_map(mean_of).filter(|torque| *torque > 0.0).collect()
        };
        let turns: Vec<f64> = references.iter().flat_map(of_run).collect();
        let middle = median(turns.iter().copied()).filter(|_| turns.len() >= SCRUB.turns)?;
        let scatter = rms(turns.iter().map(|torque| (torque / middle).ln()))?.max(SCRUB.scatter);
        let wider = 1.0 + NINETY * scatter;
        let [least, most] = turns.iter().fold([middle; 2], |[a, b], torque| [a.min(*torque), b.max(*torque)]);
        Some([least / wider, most * wider])
    }

    /// Whether a turn of the references may have taken as much.
    fn is_usual(self, torque: f64) -> bool {
        self.range.is_some_and(|[least, most]| least <= torque && torque <= most)
    }
}

/// Torque of the outer side in steady arcs as if both sides read alike, mean of both sides in spins.
fn readings(run: &SpeedRun, sides: Sides) -> Vec<Option<Reading>> {
    let of_row = |i: usize| {
        let [l, r] = [0, 1].map(|j| run.torque[j][i].abs());
        let side = run.outer(i);
        Reading::Exact(if run.spins(i) { 0.5 * (l + r) } else { [l, r][side] / sides.factor[side] })
    };
    (0..run.time.len()).map(|i| is_steady_turn(run, i).then(|| of_row(i))).collect()
}

/// The one way in which a robot turned at these rows; `None` of both, and of spins, in which both sides drive.
fn one_way(run: &SpeedRun, rows: &[usize]) -> Option<Way> {
    let seconds = |way: &dyn Fn(usize) -> bool| rows.iter().filter(|&&i| way(i)).count() as f64 * run.period();
    let left = seconds(&|i| run.spins(i) || run.outer(i) == 1);
    let right = seconds(&|i| run.spins(i) || run.outer(i) == 0);
    if left < SCRUB.one_way {
        Some(Way::Right)
    } else if right < SCRUB.one_way {
        Some(Way::Left)
    } else {
        None
    }
}

/// Torque that turns take by the robot's laws on one ground, N m: at the mean speeds of the arcs and of the spins among these rows.
fn expected(run: &SpeedRun, robot: &Robot<f64>, rows: &[usize]) -> Option<f64> {
    let (spins, arcs): (Vec<usize>, Vec<usize>) = rows.iter().partition(|&&i| run.spins(i));
    let of = |quantity: Quantity, rows: &[usize]| {
        let speed = [0, 1].map(|j| mean(rows.iter().map(|&i| inner_outer(run, i)[j])));
        let speed = [speed[0]?, speed[1]?];
        let at = Operating { quantity, speed, right_outer: right_outer(run, rows) };
        Some(rows.len() as f64 * predicted(robot, &[], at).exp())
    };
    let sum: f64 = [of(Quantity::ArcSum, &arcs), of(Quantity::SpinSum, &spins)].into_iter().flatten().sum();
    (!rows.is_empty()).then(|| sum / rows.len() as f64)
}

/// Changes of what turning costs a robot. `usual` is the references' torque in spins or arcs, N m, where they turned, and `sides`
/// what their sides read.
pub(crate) fn turning_changes(
    run: &SpeedRun,
    robot: &Robot<f64>,
    usual: Option<f64>,
    sides: Sides,
) -> Vec<TurningChange> {
    let readings = readings(run, sides);
    let seen: Vec<usize> = (0..readings.len()).filter(|&i| readings[i].is_some()).collect();
    let period = run.period();
    let Some(middle) = median(readings.iter().flatten().map(|r| r.value())) else { return Vec::new() };
    let level = levels(&readings, usual.unwrap_or(middle), period);

    // The rest of the run is what is like the references, if anything is; else the middle of the run.
    let mut like: Vec<f64> = seen.iter().map(|&i| level[i]).collect();
    let mut like_references = None;
    if let Some(u) = usual {
        let alike: Vec<f64> = like.iter().copied().filter(|l| l / u < SCRUB.same && u / l < SCRUB.same).collect();
        if alike.len() as f64 * period >= SCRUB.known {
            like = alike;
            like_references = usual;
        }
    }
    let Some(base) = median(like).filter(|base| *base > 0.0) else { return Vec::new() };
    let other = |i: usize| {
        let ratio = level[i] / base;
        if ratio > SCRUB.same {
            1
        } else if ratio < 1.0 / SCRUB.same {
            -1
        } else {
            0
        }
    };

    let mut out = Vec::new();
    for piece in seen.chunk_by(|&a, &b| other(a) == other(b)).filter(|p| other(p[0]) != 0) {
        let seconds = piece.len() as f64 * period;
        if seconds < SCRUB.least {
            continue;
        }

        let (first, last) = (piece[0], piece[piece.len() - 1]);
        let values = || piece.iter().filter_map(|&i| readings[i]).map(Reading::value);
        let n = piece.len() as f64;
        let mean = values().sum::<f64>() / n;
        let spread = values().map(|x| (x - mean).powi(2)).sum::<f64>() / n;
        let ratio = mean / base;
        let of_readings = (spread / (CHANGES.levels.per_second * seconds)).sqrt() / base;
        let half = NINETY * (SCRUB.scatter * std::f64::consts::SQRT_2 * ratio).hypot(of_readings);
        if (ratio - 1.0).abs() < half || sides.is_usual(mean) {
            continue;
        }
        // Turns of another yaw rate cost another torque where bearings do most of it.
        let rest: Vec<usize> = seen.iter().copied().filter(|&i| other(i) == 0).collect();
        let by_speeds =
            expected(run, robot, piece).zip(expected(run, robot, &rest)).map_or(1.0, |(here, rest)| here / rest);
        if (ratio / by_speeds - 1.0).abs() < half {
            continue;
        }
        // A middle between two grounds makes the usual one of them look like another.
        let of_references = like_references.map_or(ratio, |usual| mean / usual);
        if (of_references - 1.0).abs() < half || (of_references > 1.0) != (ratio > 1.0) {
            continue;
        }

        let one_way = one_way(run, piece);
        // Turns one way beside turns the other way tell nothing but the sides, unless these are known.
        if !sides.known
            && one_way.is_some()
            && one_way != self::one_way(run, &rest)
            && self::one_way(run, &rest).is_some()
        {
            continue;
        }

        // It began and ended somewhere since the last turn and before the next.
        let before = seen.iter().rev().find(|&&i| i < first).map_or(run.time[0], |&i| run.time[i]);
        let after = seen.iter().find(|&&i| i > last).map_or(run.time[run.time.len() - 1], |&i| run.time[i]);
        out.push(TurningChange {
            recording: run.name.clone(),
            interval: [run.time[first], run.time[last]],
            onset: [before, run.time[first]],
            end: [run.time[last], after],
            seconds,
            ratio,
            half,
            one_way,
            from_rest: false,
        });
    }
    let is_unlike = |interval: [f64; 2]| {
        let between = seen.iter().filter(|&&i| interval[0] < run.time[i] && run.time[i] < interval[1]);
        between.filter(|&&i| other(i) == 0).count() as f64 * period
    };
    let mut out = joined(out, is_unlike);
    let until = run.time[run.time.len() - 1];
    let rests: Vec<[f64; 2]> =
        rows_left_standing(run).iter().map(|rows| [run.time[rows[0]], run.time[rows[rows.len() - 1]]]).collect();
    for change in &mut out {
        let [from, to] = change.onset;
        let stood = rests.iter().map(|[a, b]| b.min(to) - a.max(from)).fold(0.0, f64::max);
        change.from_rest = change.end[1] >= until && stood >= SCRUB.loading;
    }
    out
}

/// Changes one after the other that are as large and have little of the usual between them are one: slow arcs cost less on any ground.
/// `usual`: seconds of usual turning between two instants.
fn joined(all: Vec<TurningChange>, usual: impl Fn([f64; 2]) -> f64) -> Vec<TurningChange> {
    let mut out: Vec<TurningChange> = Vec::new();
    for next in all {
        let is_same = |last: &&mut TurningChange| {
            let seconds = last.seconds + next.seconds;
            (last.ratio > 1.0) == (next.ratio > 1.0)
                && (last.ratio - next.ratio).abs() < last.half.hypot(next.half)
                && usual([last.interval[1], next.interval[0]]) <= SCRUB.between * seconds
        };
        let Some(last) = out.last_mut().filter(is_same) else {
            out.push(next);
            continue;
        };
        let mean = |a: f64, b: f64| (last.seconds * a + next.seconds * b) / (last.seconds + next.seconds);
        (last.ratio, last.half) = (mean(last.ratio, next.ratio), mean(last.half, next.half));
        last.one_way = last.one_way.filter(|way| next.one_way == Some(*way));
        last.seconds += next.seconds;
        (last.interval[1], last.end) = (next.interval[1], next.end);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{Leg, drive, robot};

    const EQUAL: Sides = Sides { factor: [1.0; 2], known: true, range: None };

    /// Straight driving and turns both ways, some rounds of it, at a scrub couple.
    fn rounds(n: usize, scrub: f64) -> Vec<Leg> {
        let turn = |k: usize| if k.is_multiple_of(2) { Leg::turn(6.0) } else { Leg::right(6.0) };
        (0..n).flat_map(|k| [Leg::straight(4.0), Leg { scrub, ..turn(k) }]).collect()
    }

    #[test]
    fn dearer_turning_from_some_moment_on_is_found() {
        let legs = [rounds(4, 20.0), rounds(4, 32.0)].concat();
        let found = turning_changes(&drive(&legs, false), &robot(), Some(25.5), EQUAL);
        assert_eq!(found.len(), 1, "{found:?}");
        let c = &found[0];
        // The fourth turn ends at 40 s; the next begins at 44 s and is steady a second later.
        assert!(c.onset[0] > 38.0 && c.onset[0] < 41.0 && c.onset[1] > 44.0 && c.onset[1] < 46.5, "{c:?}");
        assert!((c.ratio - 37.5 / 25.5).abs() < c.half, "{c:?}");
        assert_eq!(c.one_way, None);
    }

    #[test]
    fn changes_that_are_alike_are_one_and_a_load_may_have_been_put_on_while_the_robot_stood() {
        let change = |from: f64, ratio: f64, one_way| TurningChange {
            recording: "run".to_owned(),
            interval: [from, from + 20.0],
            onset: [from - 5.0, from],
            end: [from + 20.0, from + 22.0],
            seconds: 20.0,
            ratio,
            half: 0.2,
            one_way,
            from_rest: false,
        };
        let all = || vec![change(10.0, 1.4, None), change(40.0, 1.5, Some(Way::Left)), change(70.0, 0.6, None)];
        let found = joined(all(), |_| 2.0);
        assert_eq!(found.len(), 2);
        assert_eq!((found[0].interval, found[0].onset[0], found[0].end[1]), ([10.0, 60.0], 5.0, 62.0));
        assert!((found[0].ratio - 1.45).abs() < 1e-12 && found[0].one_way.is_none() && found[0].seconds == 40.0);
        assert_eq!(joined(all(), |_| 20.0).len(), 3, "much of the usual lies between them");

        let standing = |seconds: f64| Leg { speed: [0.0; 2], scrub: 0.0, ..Leg::straight(seconds) };
        let driven =
            |rest: Leg, after: Vec<Leg>| drive(&[rounds(4, 20.0), vec![rest], rounds(4, 32.0), after].concat(), false);
        let is_from_rest = |run: &SpeedRun| {
            let found = turning_changes(run, &robot(), Some(25.5), EQUAL);
            assert_eq!(found.len(), 1, "{found:?}");
            found[0].from_rest
        };
        assert!(is_from_rest(&driven(standing(20.0), Vec::new())));
        assert!(!is_from_rest(&driven(Leg::straight(20.0), Vec::new())), "it drove on");
        assert!(!is_from_rest(&driven(standing(20.0), rounds(4, 20.0))), "it ended without a rest");
    }

    #[test]
    fn one_ground_is_no_change_though_it_be_another_one() {
        assert_eq!(turning_changes(&drive(&rounds(6, 20.0), false), &robot(), Some(25.5), EQUAL), []);
        assert_eq!(turning_changes(&drive(&rounds(6, 32.0), false), &robot(), Some(25.5), EQUAL), []);
        assert_eq!(turning_changes(&drive(&[Leg::straight(30.0)], false), &robot(), Some(25.5), EQUAL), []);
    }

    #[test]
    fn sides_that_differ_as_on_the_references_are_no_other_ground() {
        // The right side reads a third less than the left one, everywhere.
        let own = |legs: Vec<Leg>| legs.into_iter().map(|leg| Leg { sides: [1.2, 0.8], ..leg }).collect::<Vec<_>>();
        let left = || (0..4).flat_map(|_| [Leg::straight(4.0), Leg::turn(6.0)]).collect::<Vec<_>>();
        let right = || (0..4).flat_map(|_| [Leg::straight(4.0), Leg::right(6.0)]).collect::<Vec<_>>();
        let run = drive(&own([left(), right()].concat()), false);
        assert_ne!(turning_changes(&run, &robot(), Some(25.5), EQUAL), [], "the sides look like two grounds");
        let sides = Sides::of(&[drive(&own(rounds(6, 20.0)), false)]);
        assert_eq!(turning_changes(&run, &robot(), Some(25.5), sides), []);
        // Nobody knows the sides: two ways of turning are no two grounds.
        assert_eq!(turning_changes(&run, &robot(), Some(25.5), Sides::of(&[])), []);
        // Another ground is still told, and that it was driven one way only.
        let both = own([left(), right(), vec![Leg { scrub: 45.0, ..Leg::right(12.0) }]].concat());
        let found = turning_changes(&drive(&both, false), &robot(), Some(25.5), sides);
        assert_eq!(found.iter().map(|c| c.one_way).collect::<Vec<_>>(), [Some(Way::Right)], "{found:?}");
    }

    #[test]
    fn what_turns_of_the_references_took_is_no_other_ground() {
        // Arcs of other radii cost from a little less to a half more.
        let mixed = |n: usize| [rounds(n, 18.0), rounds(n, 36.0)].concat();
        let sides = Sides::of(&[drive(&mixed(3), false)]);
        let run = |scrub: f64| drive(&[rounds(5, 20.0), rounds(3, scrub)].concat(), false);
        assert_ne!(turning_changes(&run(36.0), &robot(), Some(25.5), EQUAL), [], "nobody knows what turns take");
        assert_eq!(turning_changes(&run(36.0), &robot(), Some(25.5), sides), []);
        assert_eq!(turning_changes(&run(90.0), &robot(), Some(25.5), sides).len(), 1);
        // A few turns say little.
        assert_eq!(Sides::of(&[drive(&rounds(2, 36.0), false)]).range, None);
    }

    #[test]
    fn usual_ground_is_no_other_one_beside_ground_that_is_little_dearer() {
        // Most turns cost a fifth more than the references', and what is like these is so, too.
        let legs = [rounds(3, 18.5), rounds(8, 25.5)].concat();
        let found = turning_changes(&drive(&legs, false), &robot(), Some(25.5), EQUAL);
        assert_eq!(found, []);
    }
}
