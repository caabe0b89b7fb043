//! Several grounds in one recording: each with its loads over those of the references, and what could make them.
//!
//! What changes the straight load without being a slope, and what changes the cost of turning, is one ground where the one may
//! have begun before the other ended. Its loads are then measured as if nothing else had been recorded, and named like those of
//! a recording, by causes that need no hand on the robot: nobody touches it on the way.

use robot_model::Robot;
use robot_model::tunable::{COUNT as NUISANCES, tuned};
use verdict::{Load, LoadChange, Loads, OtherGround, Quantity, Ratio};

use crate::compare::{Judgement, Reference, judgement, ratios};
use crate::comparison::Comparison;
use crate::differences;
use crate::extract::{extract, is_steady_turn};
use crate::found::fitting;
use crate::model::Tuned;
use crate::name::{Named, Open, name};
use crate::pieces::{GRADE, STANDING};
use crate::run::SpeedRun;
use crate::settings::{CHANGES, MEASURING};
use crate::straight::is_straight;

/// What grounds are compared with.
pub(crate) struct Usual<'a> {
    pub(crate) references: &'a [Reference],
    pub(crate) robot: &'a Robot<f64>,
    pub(crate) sigma: &'a [f64; NUISANCES],
    pub(crate) calibrated: &'a Tuned,
}

/// A stretch that may be other ground: what shows it, and how far it may reach.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Stretch {
    interval: [f64; 2],
    reach: [f64; 2],
    /// Until where it may reach by what shows its last row.
    until: f64,
    /// Whether no slope can do all of it.
    is_ground: bool,
    /// Whether straight driving shows it where it ends.
    by_straight: bool,
}

/// Grounds inside these recordings, the longest first.
pub(crate) fn grounds(runs: &[SpeedRun], loads: &Loads, usual: &Usual<'_>) -> Vec<OtherGround> {
    let of_run = |run: &SpeedRun| -> Vec<OtherGround> {
        let slopes = slopes(&run.name, loads);
        stretches(run, loads).into_iter().filter_map(|stretch| usual.ground(run, stretch, &slopes)).collect()
    };
    let mut out: Vec<OtherGround> = runs.iter().flat_map(of_run).collect();
    let seconds = |g: &OtherGround| g.interval[1] - g.interval[0];
    out.sort_by(|a, b| seconds(b).total_cmp(&seconds(a)));
    out
}

/// Slopes of a recording, from and until: their pull is no load of the ground. A tilt against the rest of a drive may be soft
/// ground itself.
fn slopes(recording: &str, loads: &Loads) -> Vec<[f64; 2]> {
    let is_slope = |c: &&LoadChange| c.recording == recording && c.causes == [GRADE] && !c.relative;
    loads.changes.found.iter().filter(is_slope).map(|c| c.interval).collect()
}

/// Changes of a recording that may be one ground, joined.
fn stretches(run: &SpeedRun, loads: &Loads) -> Vec<Stretch> {
    let recording = run.name.as_str();
    let may_be =
        |c: &&LoadChange| c.recording == recording && !c.bound && c.causes != [GRADE] && !c.causes.contains(&STANDING);
    let straight = loads.changes.found.iter().filter(may_be).map(|c| Stretch {
        interval: c.interval,
        reach: [c.onset[0], c.end[1]],
        until: c.end[1],
        is_ground: !c.causes.contains(&GRADE),
        by_straight: true,
    });
    let turning = loads.turning_changes.iter().filter(|c| c.recording == recording && c.one_way.is_none());
    let turning = turning.map(|c| Stretch {
        interval: c.interval,
        reach: [c.onset[0], c.end[1]],
        until: c.end[1],
        is_ground: true,
        by_straight: false,
    });
    let mut all: Vec<Stretch> = straight.chain(turning).collect();
    all.sort_by(|a, b| a.interval[0].total_cmp(&b.interval[0]));

    // Straight driving between two stretches that takes what it takes elsewhere is other ground than either, if straight
    // driving shows one of them.
    let is_apart = |last: &Stretch, next: &Stretch| {
        let between = (0..run.time.len()).filter(|&i| {
            last.interval[1] < run.time[i]
                && run.time[i] < next.interval[0]
                && is_steadily_straight(run, i)
                && !run.standing[i]
        });
        (last.by_straight || next.by_straight) && between.count() as f64 * run.period() > CHANGES.scrub.least
    };
    let mut out: Vec<Stretch> = Vec::new();
    for next in all {
        match out.last_mut() {
            Some(last) if next.reach[0] <= last.reach[1] && !is_apart(last, &next) => {
                if next.interval[1] > last.interval[1] {
                    last.by_straight = next.by_straight;
                    last.until = next.until;
                }
                last.interval[1] = last.interval[1].max(next.interval[1]);
                last.reach[1] = last.reach[1].max(next.reach[1]);
                last.is_ground |= next.is_ground;
            }
            _ => out.push(next),
        }
    }
    out.retain(|s| s.is_ground);
    out
}

impl Usual<'_> {
    /// Loads over the references'.
    pub(crate) fn ratios(&self, loads: &[Load]) -> (Vec<Ratio>, Vec<Ratio>) {
        ratios(loads, self.references, &tuned(self.robot, self.sigma, &self.calibrated.theta))
    }

    /// The ground of a stretch, by its rows beside slopes; `None` where no load of these differs from the references'.
    fn ground(&self, run: &SpeedRun, stretch: Stretch, slopes: &[[f64; 2]]) -> Option<OtherGround> {
        let Stretch { interval, reach: [from, _], until, .. } = stretch;
        let (loads, _) = extract(&only(run, &[interval], slopes));
        let (ratios, _) = self.ratios(&loads);
        if !ratios.iter().any(|r: &Ratio| judgement(r) == Judgement::Differs) {
            return None;
        }
        let differences = differences(&loads, self.references);
        let comparison = Comparison::new(&differences, self.robot, self.sigma, self.calibrated);
        let ends = run.time.last().is_some_and(|last| until < *last);
        let open = Open { same_robot: true, one_slope: false, of_ground: ends };
        let naming = comparison.and_then(|c| name(&c, open));
        let causes = fitting(naming.as_ref()).into_iter().flat_map(Named::ids).map(str::to_owned).collect();
        Some(OtherGround { recording: run.name.clone(), interval, reach: [from, until], ratios, causes })
    }
}

/// Of what rows the loads of recordings are, where grounds were found inside them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Measured {
    /// All: no ground was found, or the rest is like nothing that is known.
    Everything,
    /// Those beside the grounds.
    Beside,
    /// Those of the grounds.
    Grounds,
}

/// Leaves the rows of these grounds out of all that is measured of the recordings, as those in which a body stands. Ground that
/// covers most of the steady driving is what they were driven on: then the rows beside it are left out, if their loads are the
/// references'. Rows of which nobody knows the ground are left out of both.
pub(crate) fn leave_out(runs: &mut Vec<SpeedRun>, loads: &Loads, usual: &Usual<'_>) -> Measured {
    let of =
        |run: &SpeedRun| -> Vec<&OtherGround> { loads.grounds.iter().filter(|g| g.recording == run.name).collect() };
    let changes = |run: &SpeedRun| !of(run).is_empty();
    let on_grounds: Vec<SpeedRun> = runs
        .iter()
        .map(|run| match of(run).iter().map(|g| g.interval).collect::<Vec<_>>() {
            own if own.is_empty() => run.clone(),
            own => only(run, &own, &slopes(&run.name, loads)),
        })
        .collect();
    let beside: Vec<SpeedRun> = runs.iter().map(|run| beside(run, &of(run))).collect();
    let seconds = |run: &SpeedRun| {
        let is_steady = |i: &usize| !run.standing[*i] && (is_steady_turn(run, *i) || is_steadily_straight(run, *i));
        (0..run.time.len()).filter(is_steady).count() as f64 * run.period()
    };
    let there: f64 = on_grounds.iter().filter(|run| changes(run)).map(seconds).sum();
    if there == 0.0 {
        return Measured::Everything;
    }

    // Several grounds that are not of one kind have no loads in common.
    if there <= beside.iter().map(seconds).sum() || !are_alike(&loads.grounds) {
        *runs = beside;
        return Measured::Beside;
    }
    let differs = |run: &SpeedRun| {
        let (loads, _) = extract(run);
        usual.ratios(&loads).0.iter().any(|r| judgement(r) == Judgement::Differs)
    };
    if beside.iter().filter(|run| changes(run)).any(differs) {
        return Measured::Everything;
    }
    *runs = on_grounds;
    Measured::Grounds
}

/// Whether turning, or the track, differs on any of these grounds.
pub(crate) fn turn_otherwise(grounds: &[OtherGround]) -> bool {
    let differs = |r: &Ratio| r.quantity != Quantity::StraightLoad && judgement(r) == Judgement::Differs;
    grounds.iter().flat_map(|g| &g.ratios).any(differs)
}

/// Whether what fits the longest ground best is among what fits all others; those that nothing fits say nothing.
fn are_alike(grounds: &[OtherGround]) -> bool {
    let mut classes = grounds.iter().map(|g| &g.causes).filter(|class| !class.is_empty());
    let Some(leading) = classes.next().and_then(|class| class.first()) else { return true };
    classes.all(|class| class.contains(leading))
}

fn is_steadily_straight(run: &SpeedRun, i: usize) -> bool {
    is_straight(run, i, MEASURING.straight.hold_of_means)
}

/// A recording as if only these rows said anything: all others are left out like those in which a body stands.
fn keeping(run: &SpeedRun, keeps: impl Fn(f64) -> bool) -> SpeedRun {
    let mut out = run.clone();
    for (left_out, t) in out.standing.iter_mut().zip(&run.time) {
        *left_out |= !keeps(*t);
    }
    out
}

/// Only the rows on these grounds, less the slopes among them.
fn only(run: &SpeedRun, grounds: &[[f64; 2]], slopes: &[[f64; 2]]) -> SpeedRun {
    let mut out = keeping(run, |t| is_within(t, grounds) && !is_within(t, slopes));
    // What changes the load there is the ground.
    out.changed.fill(false);
    out
}

/// Only the rows beside these grounds; those of which nobody knows the ground are not.
fn beside(run: &SpeedRun, grounds: &[&OtherGround]) -> SpeedRun {
    // The last rows that show the usual ground belong to it.
    let may_be: Vec<[f64; 2]> =
        grounds.iter().flat_map(|g| [g.interval, [g.reach[0] + run.period(), g.reach[1] - run.period()]]).collect();
    keeping(run, |t| !is_within(t, &may_be))
}

fn is_within(t: f64, stretches: &[[f64; 2]]) -> bool {
    stretches.iter().any(|[from, until]| *from <= t && t <= *until)
}

#[cfg(test)]
mod tests {
    use verdict::{Diagnosis, OtherGround, Quantity, Ratio, Verdict};

    use super::are_alike;
    use crate::testing::{Leg, diagnosis, rounds};

    /// Rounds on a ground: the straight load and the couple of turning, in those of the references.
    fn on(straight: f64, scrub: f64, n: usize) -> Vec<Leg> {
        let harder = |leg: Leg| Leg { straight: straight * leg.straight, scrub: scrub * leg.scrub, ..leg };
        rounds(n).into_iter().map(harder).collect()
    }

    fn grounds(d: &Diagnosis) -> Vec<([f64; 2], Vec<String>)> {
        let loads = d.steady.as_ref().expect("loads");
        loads.grounds.iter().map(|g| (g.interval, g.causes.clone())).collect()
    }

    #[test]
    fn two_grounds_of_one_recording_are_two_findings() {
        // A round takes 40 s: hard ground, soft ground, hard ground, ground on which turning costs half.
        let legs = [on(1.0, 1.0, 2), on(2.2, 1.0, 1), on(1.0, 1.0, 3), on(1.0, 0.4, 2), on(1.0, 1.0, 2)].concat();
        let d = diagnosis(&[&legs]);
        let found = grounds(&d);
        assert_eq!((d.verdict, found.len()), (Verdict::Explained, 2), "{:?}", d.sentences);
        let [(slippery, _), (soft, _)] = &found[..] else { panic!("{found:?}") };
        assert!(soft[0] > 78.0 && soft[1] < 122.0, "{found:?}");
        assert!(slippery[0] > 238.0 && slippery[1] < 322.0, "{found:?}");
        assert!(found[1].1.iter().any(|id| id == "rolling_resistance"), "{found:?}");
        assert!(found[0].1.iter().any(|id| id == "turning_resistance"), "{found:?}");
        assert!(d.sentences[0].contains("2 stretches"), "{:?}", d.sentences);
        let told = d.sentences.iter().filter(|s| s.contains("other ground")).count();
        assert_eq!(told, 2, "{:?}", d.sentences);
    }

    #[test]
    fn grounds_are_alike_where_what_fits_the_longest_fits_all_that_something_fits() {
        let ground = |causes: &[&str]| OtherGround {
            recording: "0".to_owned(),
            interval: [0.0; 2],
            reach: [0.0; 2],
            ratios: Vec::new(),
            causes: causes.iter().map(|id| (*id).to_owned()).collect(),
        };
        let alike = |all: &[&[&str]]| are_alike(&all.iter().map(|causes| ground(causes)).collect::<Vec<_>>());
        assert!(alike(&[&["soft", "scrub"], &["rolling", "soft"], &[]]));
        assert!(!alike(&[&["grip", "scrub"], &["soft", "scrub"]]));
        assert!(alike(&[&[], &["soft"]]) && alike(&[]));
    }

    #[test]
    fn soft_and_slippery_ground_with_hard_ground_between_are_two_findings() {
        let legs = [on(1.0, 1.0, 2), on(2.2, 1.0, 1), on(1.0, 1.0, 1), on(1.0, 0.4, 1), on(1.0, 1.0, 2)].concat();
        let found = grounds(&diagnosis(&[&legs]));
        assert_eq!(found.len(), 2, "{found:?}");
        assert!(found.iter().all(|([from, until], _)| until - from < 45.0), "{found:?}");
    }

    #[test]
    fn loads_of_a_recording_are_those_of_its_usual_ground() {
        let alike = on(1.0, 1.0, 6);
        let d = diagnosis(&[&[on(1.0, 1.0, 4), on(1.0, 0.4, 2)].concat()]);
        assert_eq!(grounds(&d).len(), 1, "{:?}", d.sentences);
        assert!(d.sentences[0].starts_with("The ground changes"), "{:?}", d.sentences);
        let turning = |d: &Diagnosis| {
            let ratios = d.steady.iter().flat_map(|loads| &loads.ratios);
            ratios.filter(|r| r.quantity == Quantity::TurningLoad).map(|r| r.ratio).collect::<Vec<_>>()
        };
        for (mixed, whole) in turning(&d).into_iter().zip(turning(&diagnosis(&[&alike]))) {
            approx::assert_relative_eq!(mixed, whole, max_relative = 0.02);
        }
        // Ground that covers most of a recording is what it was driven on.
        let d = diagnosis(&[&[on(1.0, 1.0, 1), on(1.0, 0.4, 5)].concat()]);
        assert!(!turning(&d).is_empty() && turning(&d).iter().all(|ratio| *ratio < 0.8), "{:?}", d.sentences);
    }

    #[test]
    fn one_ground_and_what_may_be_a_slope_are_no_other_ground() {
        assert_eq!(grounds(&diagnosis(&[&on(1.0, 1.0, 3)])), []);
        let climb = [Leg::straight(30.0), Leg::straight(20.0).slope(3.0), Leg::straight(30.0)];
        let d = diagnosis(&[&climb]);
        assert_eq!(grounds(&d), [], "{:?}", d.sentences);
        assert!(d.sentences[0].starts_with("Change inside"), "{:?}", d.sentences);
    }

    #[test]
    fn ground_that_covers_most_of_a_drive_is_named_by_its_own_rows_at_any_speed() {
        // One recording meets soft ground slowly, the other fast: together they would look like friction that grows with speed.
        let faster = |leg: Leg| Leg { speed: leg.speed.map(|v| 2.5 * v), ..leg };
        // It covers most of all driving, and little of one recording.
        let slow = [on(1.0, 1.0, 1), on(1.9, 1.0, 4)].concat();
        let fast = [on(1.0, 1.0, 2), on(1.9, 1.0, 1).into_iter().map(faster).collect()].concat();
        let d = diagnosis(&[&slow, &fast]);
        let loads = d.steady.as_ref().expect("loads");
        assert!(loads.on_grounds, "{:?}", d.sentences);
        for recording in ["0", "1"] {
            let straight = |r: &&Ratio| r.recording == recording && r.quantity == Quantity::StraightLoad;
            let ratio = loads.ratios.iter().find(straight).expect("a straight load").ratio;
            assert!(ratio > 1.7, "{recording}: {ratio}");
        }
        assert_eq!(d.verdict, Verdict::Explained);
        assert!(d.sentences[1].contains("another ground, in recording"), "{:?}", d.sentences);
        let named = &d.indistinguishable[0];
        assert!(named.iter().any(|id| id == "rolling_resistance"), "{named:?}");
        for id in named {
            let cause = d.ranked.iter().find(|c| c.effect == *id).expect("ranked");
            assert!(cause.intervals.as_ref().is_some_and(|at| at.len() == loads.grounds.len()), "{cause:?}");
        }
    }

    #[test]
    fn beside_another_ground_of_a_stretch_nothing_is_missing_is_improbable() {
        let nothing = |on_grounds: bool| {
            let mut d = diagnosis(&[&on(1.9, 1.0, 4)]);
            assert_eq!(d.verdict, Verdict::Explained);
            // As where a load differs by as much as cold drive trains do.
            let none = |c: &verdict::Cause| c.effect == catalogue::answer::NONE.id;
            d.ranked.iter_mut().for_each(|c| c.probability = if none(c) { 0.5 } else { 0.25 });
            crate::found::add(&mut d, None, &verdict::Loads { on_grounds, ..verdict::Loads::default() });
            d.ranked.iter().find(|c| none(c)).map(|c| c.probability)
        };
        assert_eq!(nothing(false), Some(0.5));
        approx::assert_relative_eq!(nothing(true).expect("ranked"), 0.1, epsilon = 1e-12);
    }

    #[test]
    fn what_shows_a_ground_is_told_with_it_alone() {
        let d = diagnosis(&[&[on(1.0, 1.0, 3), on(2.2, 1.0, 1), on(1.0, 1.0, 2)].concat()]);
        assert_eq!(grounds(&d).len(), 1, "{:?}", d.sentences);
        assert!(!d.sentences.iter().any(|s| s.contains("a slope that does this")), "{:?}", d.sentences);
        // A drive train does not begin and end with a ground.
        let causes = &grounds(&d)[0].1;
        assert!(!causes.is_empty() && !causes.iter().any(|id| id == "viscous_friction"), "{causes:?}");
    }
}
