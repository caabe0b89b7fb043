//! Jumps of the straight load, by currents.

use crate::heading::{apart, directions};
use crate::pieces::{ByClass, GRADE, ROLLING, STANDING, UNLISTED, class, pieces};
use crate::run::SpeedRun;
use crate::settings::{CHANGES, NAMING, changes::Jumps};
use crate::straight::{Reading, reads_nothing};
use inference::robust::NINETY;
use verdict::LoadChange;

const JUMPS: Jumps = CHANGES.jumps;
/// Factor by which the straight load varies without a cause.
const UNNAMED: f64 = NAMING.priors.unnamed_straight;

/// What tells slopes beside the loads, whose pull was taken off these.
pub(super) struct Tilt<'a> {
    /// One sigma of that pull at a row, N m.
    pub(super) pull_sigma: &'a dyn Fn(usize) -> f64,
    /// Whether an accelerometer shows how the body tilts; turning rates show only where that changes.
    pub(super) is_levelled: bool,
    /// How far the body has turned about its vertical axis at the rows, rad.
    pub(super) turned: &'a [f64],
    /// Whether the ground does not count as level at a time, s.
    pub(super) is_sloping: &'a dyn Fn(f64) -> bool,
}

impl Tilt<'_> {
    /// Whether a slope under a stretch of rows would have shown, between what was driven straight before and after it: turning rates
    /// do not see one on which the robot begins, that it turns onto, or that goes on where another slope was measured.
    fn would_show(&self, run: &SpeedRun, [first, last]: [usize; 2], [before, after]: [Option<usize>; 2]) -> bool {
        let [_, far] = CHANGES.slopes.ramp;
        let is_straight_onto = |a: usize, b: usize| {
            run.time[b] - run.time[a] <= far && (self.turned[b] - self.turned[a]).abs() <= CHANGES.slopes.turned
        };
        let at_ends = [before.map(|i| [i, first]), after.map(|i| [last, i])];
        let is_from_level = |ends: &[usize; 2]| !ends.iter().any(|&i| (self.is_sloping)(run.time[i]));
        self.is_levelled || at_ends.into_iter().flatten().filter(is_from_level).any(|[a, b]| is_straight_onto(a, b))
    }
}

/// Jumps of the load, from currents.
pub(super) fn jumps(
    run: &SpeedRun,
    readings: &[Option<Reading>],
    level: &[f64],
    usual: &ByClass,
    weight: f64,
    tilt: Option<&Tilt<'_>>,
) -> Vec<LoadChange> {
    let period = run.period();
    let base = |i: usize| usual[class(run.forward(i).abs())].unwrap_or(level[i]);
    let own = |i: usize| level[i] - base(i);
    let is_changed = |i: &usize| own(*i).abs() > (1.0 - 1.0 / UNNAMED) * base(*i);
    let seen: Vec<usize> = (0..level.len()).filter(|&i| readings[i].is_some()).collect();
    let changed = pieces(&run.time, seen.iter().copied().filter(is_changed), CHANGES.pieces.apart);
    // A piece has one direction.
    let changed: Vec<&[usize]> = changed.iter().flat_map(|p| p.chunk_by(|&a, &b| own(a) * own(b) > 0.0)).collect();

    let mut out = Vec::new();
    let mut may_be_offset = true;
    let jumped = jumped(run, &seen, &changed, &own);
    for (piece, jumped) in changed.into_iter().zip(jumped) {
        let seconds = piece.len() as f64 * period;
        if seconds < JUMPS.least {
            continue;
        }

        // By how much: from what reads, unless most of it only bounds the load.
        let exact: Vec<usize> = piece.iter().copied().filter(|&i| readings[i].is_some_and(Reading::is_exact)).collect();
        let bound = 2 * exact.len() < piece.len();
        let of = if bound { piece } else { &exact };
        let mean = |f: &dyn Fn(usize) -> f64| of.iter().map(|&i| f(i)).sum::<f64>() / of.len() as f64;
        let load = mean(&|i| readings[i].map_or(0.0, Reading::value));
        let from = mean(&base);
        if from <= 0.0 {
            continue;
        }
        // What the currents only bound from above may be anything between.
        if bound && load > from / UNNAMED {
            continue;
        }

        let (first, last) = (piece[0], piece[piece.len() - 1]);
        let before = seen.iter().rev().find(|&&i| i < first).copied();
        let after = seen.iter().find(|&&i| i > last).copied();
        // Cold drive trains differ from the references, but do not jump at one speed.
        if !jumped && load > from / UNNAMED && load < from * UNNAMED * (1.0 + JUMPS.scatter) {
            continue;
        }

        // On a slope the excess may be what its pull was taken for too little or too much.
        let of_pull = tilt.map_or(0.0, |tilt| mean(&|i| (tilt.pull_sigma)(i)));
        let half = NINETY * (JUMPS.scatter * from).hypot(of_pull);
        if of_pull > 0.0 && (load - from).abs() < half {
            continue;
        }

        let slope = ((load - from) / weight).clamp(-1.0, 1.0).asin().to_degrees();
        let nothing = piece.iter().filter(|&&i| reads_nothing(run, i)).count() as f64 * period;
        let below = load < JUMPS.below_friction * from || nothing >= JUMPS.below_seconds && load < from / UNNAMED;
        let blocked = !bound && load - from > JUMPS.blocked * weight;
        let would_show = tilt.is_some_and(|tilt| tilt.would_show(run, [first, last], [before, after]));
        let (causes, reason) = if blocked {
            let climbs = load - from <= JUMPS.climbed * weight;
            let slope = if tilt.is_some() || !climbs { None } else { Some(GRADE) };
            (slope.into_iter().chain([STANDING]).collect(), "no ground resists rolling that much by itself")
        } else if below && would_show {
            (vec![UNLISTED], "the load is below any friction, and no slope shows: something pushes the robot")
        } else if would_show {
            (vec![ROLLING], "the gyro shows no slope that would explain it")
        } else if below {
            (vec![GRADE], "the load is below any friction, so the robot runs downhill")
        } else {
            (vec![GRADE, ROLLING], "a straight drive one way cannot tell them apart")
        };
        // An offset of the sensors that their dead band hides at rest makes as much of another way of driving: both sides, both
        // ways.
        let hidden = 4.0 * run.dead_band;
        may_be_offset &= is_other_way(run, piece, before, after) && (load - from).abs() < hidden;
        out.push(LoadChange {
            recording: run.name.clone(),
            interval: [run.time[first], run.time[last]],
            onset: [before.map_or(run.time[0], |i| run.time[i]), run.time[first]],
            end: [run.time[last], after.map_or(run.time[run.time.len() - 1], |i| run.time[i])],
            seconds,
            ratio: Some(load / from),
            slope,
            slope_half: (half / weight).to_degrees(),
            bound,
            relative: false,
            causes,
            reason: reason.into(),
        });
    }
    if may_be_offset {
        out.clear();
    }
    decide_by_heading(run, &mut out);
    out
}

/// Whether the load jumped where each of these pieces begins or ends, or where the change of which it is a further part does: nothing
/// straight was driven between, and the load went on alike.
fn jumped(run: &SpeedRun, seen: &[usize], pieces: &[&[usize]], own: &dyn Fn(usize) -> f64) -> Vec<bool> {
    let ends = |piece: &[usize]| [piece[0], piece[piece.len() - 1]];
    let before = |i: usize| seen.iter().rev().find(|&&k| k < i).copied();
    let after = |i: usize| seen.iter().find(|&&k| k > i).copied();
    let speed = |i: usize| class(run.forward(i).abs());
    let differs = |i: usize, first: usize| own(i).abs() < JUMPS.neighbour * own(first).abs();
    let by_itself = |piece: &&[usize]| {
        let [first, last] = ends(piece);
        [before(first), after(last)].into_iter().flatten().any(|i| speed(i) == speed(first) && differs(i, first))
    };
    let mut jumped: Vec<bool> = pieces.iter().map(by_itself).collect();

    let goes_on = |a: usize| {
        let [[_, last], [first, _]] = [ends(pieces[a]), ends(pieces[a + 1])];
        before(first) == Some(last) && own(last) * own(first) > 0.0 && !differs(last, first) && !differs(first, last)
    };
    let on: Vec<usize> = (0..pieces.len().saturating_sub(1)).filter(|&a| goes_on(a)).collect();
    for &a in &on {
        jumped[a + 1] |= jumped[a];
    }
    for &a in on.iter().rev() {
        jumped[a] |= jumped[a + 1];
    }
    jumped
}

/// Whether a piece is driven the other way than the straight driving before and after it.
fn is_other_way(run: &SpeedRun, piece: &[usize], before: Option<usize>, after: Option<usize>) -> bool {
    let way = run.forward(piece[0]).signum();
    let is_one_way = piece.iter().all(|&i| run.forward(i) * way > 0.0);
    let mut beside = [before, after].into_iter().flatten().peekable();
    is_one_way && beside.peek().is_some() && beside.all(|i| run.forward(i) * way < 0.0)
}

/// A slope depends on the heading, the ground does not: changes driven both ways tell them apart. Where no slope shows, what changes the
/// load the opposite way on the way back is neither.
fn decide_by_heading(run: &SpeedRun, found: &mut [LoadChange]) {
    let Some(directions) = directions(run) else { return };
    // Direction of travel in the middle of a change.
    let direction = |c: &LoadChange| {
        let i = run.time.partition_point(|t| *t < 0.5 * (c.interval[0] + c.interval[1]));
        directions[i.min(directions.len() - 1)]
    };
    // Of what is below a bound it is known that it is less.
    let all: Vec<(f64, f64)> = found.iter().map(|c| (direction(c), c.slope)).collect();
    for change in found.iter_mut().filter(|c| c.causes == [ROLLING]) {
        let (own, slope) = (direction(change), change.slope);
        if all.iter().any(|o| apart(o.0, own) > JUMPS.way_back && o.1 * slope < 0.0) {
            change.causes = vec![UNLISTED];
            change.reason =
                "driven the other way, the load changes the opposite way, and no slope shows: something pulls the robot".into();
        }
    }
    // A bound says neither that loads are alike nor that they are opposite.
    let seen: Vec<(f64, f64)> = found.iter().filter(|c| !c.bound).map(|c| (direction(c), c.slope)).collect();
    for change in found.iter_mut().filter(|c| c.causes.len() > 1 && !c.bound) {
        let (own, slope) = (direction(change), change.slope);
        let way_back = seen.iter().any(|o| apart(o.0, own) > JUMPS.way_back && o.1 * slope < 0.0);
        let whichever =
            seen.iter().any(|o| apart(o.0, own) > JUMPS.other_heading && (o.1 / slope - 1.0).abs() < JUMPS.scatter);
        if way_back {
            change.causes = vec![GRADE];
            change.reason = "driven the other way, the load changes the opposite way".into();
        } else if whichever {
            change.causes = vec![ROLLING];
            change.reason = "the load is the same in another heading".into();
        }
    }
}
