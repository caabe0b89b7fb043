//! Effects of one's own in a diagnosis: those that no free run can hold, and drives beyond the range that a law was seen in.

use inference::hypothesis::{Dose, Place, Sizes, Variant};
use inference::{DiagnosisError, KnownEffects, Options};
use law::{OwnEffect, Variable};
use robot_model::{Plant, Robot, State};
use sim::rollout::{Delivered, Grid, Rollout, each_step};
use verdict::Cause;

use crate::channel::Channel;
use crate::drives::Drives;
use crate::fit::{Fitted, Problem};
use crate::settings::law::SETTINGS;
use crate::simulate::{Body, free_run};
use crate::unnamed::Signals;
use crate::windows::{Cut, Segment};

/// An effect of one's own with which the plant runs away.
#[derive(Debug, Clone)]
pub(crate) struct Runaway {
    name: &'static str,
    /// What is said of it.
    pub(crate) sentence: String,
}

/// The same settings without effects that run away.
pub(crate) fn without(options: &Options, runaways: &[Runaway]) -> Options {
    let names: Vec<&str> = runaways.iter().map(|r| r.name).collect();
    Options { known: options.known.without(&names), ..*options }
}

/// Effects of one's own with which a free run of these drives, at the numbers of their files, is not finite or turns the
/// wheels many times faster than they ever turned: their columns would say nothing.
pub(crate) fn runaways(known: KnownEffects, robot: &Robot<f64>, cuts: &[Cut], step: f64) -> Vec<Runaway> {
    let of = |own: &&'static OwnEffect| {
        let variant = Variant { effect: *own, axis: None, place: Place::Whole };
        let usual: Vec<f64> = variant.free(&Sizes::default()).iter().map(|f| f.usual).collect();
        let dose = variant.dose(&usual, None);
        let (recording, time) = first_instant(robot, cuts, Some(&dose), step)?;
        let name = own.name();
        let sentence = format!(
            "with '{name}' the simulation of {recording} runs away {time:.3} s after its first row, at the numbers of the \
             file: it was left out; check the law's sign, its numbers and its range"
        );
        Some(Runaway { name, sentence })
    };
    known.own().iter().filter_map(of).collect()
}

/// Refuses what the simulation is given where the plant runs away with it: then nothing can be compared.
///
/// # Errors
/// The first drive in which it does, with the instant.
pub(crate) fn ensure_given_is_stable(robot: &Robot<f64>, cuts: &[Cut], step: f64) -> Result<(), DiagnosisError> {
    let Some(given) = cuts.iter().map(|cut| &cut.given).find(|given| !given.is_empty()) else { return Ok(()) };
    let Some((recording, time)) = first_instant(robot, cuts, None, step) else { return Ok(()) };
    let names: Vec<&str> = given.iter().map(|dose| dose.effect.spec().id).collect();
    let what = format!(
        "the simulation runs away {time:.3} s after the first row with the effects that it is given ({}); check their signs and numbers, \
         or take them out of the robot file and of --adopt",
        names.join(", ")
    );
    Err(DiagnosisError::Impossible { recording: recording.to_owned(), what })
}

/// The recording in which a dose, or none, makes the plant run away, and the time of the first step at which it has, s.
fn first_instant<'a>(robot: &Robot<f64>, cuts: &'a [Cut], dose: Option<&Dose>, step: f64) -> Option<(&'a str, f64)> {
    let fastest = cuts.iter().flat_map(|c| &c.segments).flat_map(|s| s.observed.iter().zip(&s.valid));
    let fastest = fastest.flat_map(|(y, valid)| Channel::WHEELS.map(|c| if valid[c] { y[c].abs() } else { 0.0 }));
    let most = SETTINGS.own.runaway * fastest.fold(1.0, f64::max);
    let is_away = |speed: f64| !speed.is_finite() || speed.abs() > most;

    let drives = Drives::default();
    let body = |(run, cut): (usize, &Cut)| {
        let doses = cut.with_given(dose.into_iter().cloned().collect());
        let torque = drives.delivered(run, cut, robot, &doses, Grid::nearest(cut.period, step));
        Body { robot: *robot, doses, acting: None, torque }
    };
    let bodies: Vec<Body> = cuts.iter().enumerate().map(body).collect();
    let response = free_run(cuts, &bodies, 0, None, step);

    let all = cuts.iter().zip(&bodies).zip(&response).flat_map(|((cut, body), of_run)| {
        cut.segments.iter().zip(of_run).map(move |(segment, windows)| (cut, body, segment, windows))
    });
    let mut away = all.filter(|(.., windows)| windows.iter().any(|y| Channel::WHEELS.iter().any(|c| is_away(y[*c]))));
    let (cut, body, segment, _) = away.next()?;
    Some((cut.name.as_str(), first_step(cut, segment, body, step, &is_away)))
}

/// Time after the first row at which a wheel of a segment's free run is away, s: the segment's end where rounding hides it.
fn first_step(cut: &Cut, segment: &Segment, body: &Body, step: f64, is_away: &dyn Fn(f64) -> bool) -> f64 {
    let grid = Grid::nearest(cut.period, step);
    let active = body.doses.iter().map(Dose::active).collect::<Vec<_>>();
    let plant = Plant::new(&body.robot, &active, grid.step());
    let mut state = State { time: cut.time(segment.row as f64), ..State::default() };
    segment.start.set(&plant, &mut state);
    let rows = segment.windows * cut.rows_per_window;
    let torque = |row: usize, step: usize| body.torque[(segment.row + row) * grid.substeps + step];
    let mut first = None;
    let Ok(()) = Rollout::new(&plant, rows, grid.substeps).run(
        &mut state,
        &mut Delivered(torque),
        &mut each_step(|_, _, _, s: &State<f64>| {
            if first.is_none() && s.wheel_speed.iter().any(|w| is_away(*w)) {
                first = Some(s.time);
            }
        }),
    );
    first.unwrap_or_else(|| cut.time((segment.row + rows) as f64))
}

/// Of effects of one's own among the causes: where these recordings leave the range in which their law was seen.
pub(crate) fn beyond_range(problem: &Problem<'_>, retuned: &Fitted, causes: &[Cause]) -> Vec<String> {
    let mut named = problem.known.own().iter().filter(|own| causes.iter().any(|c| c.effect == own.name())).peekable();
    if named.peek().is_none() {
        return Vec::new();
    }
    let signals = Signals::new(problem, retuned);
    named.flat_map(|own| own.beyond_seen(|v: Variable| signals.range(v))).collect()
}

#[cfg(test)]
mod tests {
    use testing::robot;

    use super::*;
    use crate::decide::decide;
    use crate::search::search;
    use crate::testing::{cutting, driven, problem};
    use crate::windows::cut;

    fn own(name: &str, formula: &str) -> &'static OwnEffect {
        OwnEffect::new(name, formula.parse().expect("a law")).expect("an effect")
    }

    fn whole(own: &'static OwnEffect) -> Variant {
        Variant { effect: own, axis: None, place: Place::Whole }
    }

    #[test]
    fn a_law_of_ones_own_is_named_and_its_constants_and_shapes_are_found() {
        let waving = own("waving", "T_right = 0.6 [N m] * wave(t, 2.3, 0)");
        let truth = [0.9, 2.4, 0.4];
        let (robot, doses) = (robot(), [whole(waving).dose(&truth, None)]);
        let cuts = [12.0, 16.0].map(|seconds| cut(&driven(&robot, &doses, seconds), &cutting()));
        let known = KnownEffects::with(vec![waving]);
        let p = Problem { known, ..problem(&robot, &cuts) };
        let found = search(&p, &[], &|_| {});
        let decision = decide(&p, &found, &[1.0], &crate::null_scores::NullScores::default());
        let best = &decision.scored[0];
        assert_eq!(best.trial.hypothesis.ids(), ["waving"]);
        assert!(best.probability > 0.9, "{}", best.probability);
        for (value, expected) in best.trial.fitted.point.effects.iter().zip(truth) {
            assert!((value - expected).abs() < 0.05, "{value} instead of {expected}");
        }
        // Without the file another name is the best, and much is left.
        let without = search(&problem(&robot, &cuts), &[], &|_| {});
        let left = without.singles.iter().chain(&without.several).map(|t| t.fitted.cost).fold(f64::MAX, f64::min);
        assert!(left > 3.0 * best.trial.fitted.cost, "{left} against {}", best.trial.fitted.cost);
    }

    #[test]
    fn a_law_with_which_the_plant_runs_away_is_named_with_its_instant_and_left_out() {
        let robot = robot();
        let cuts = [cut(&driven(&robot, &[], 8.0), &cutting())];
        let (pushing, dragging) = (
            own("pushing", "T_right = 50 [N m s/rad] * pow(omega, 1)"),
            own("dragging", "T_right = -0.5 [N m] * sgn(omega, 0.3)"),
        );
        let known = KnownEffects::with(vec![pushing, dragging]);
        let found = runaways(known, &robot, &cuts, 1e-3);
        assert_eq!(found.iter().map(|r| r.name).collect::<Vec<_>>(), ["pushing"]);
        assert!(found[0].sentence.contains("with 'pushing' the simulation of synthetic runs away 0."), "{found:?}");
        let options = without(&Options { known, ..Options::default() }, &found);
        assert_eq!(options.known.own().iter().map(|own| own.name()).collect::<Vec<_>>(), ["dragging"]);
    }

    #[test]
    fn drives_beyond_the_range_seen_are_told_of_what_is_named_alone() {
        let law: law::Law = "T_right = -0.5 [N m] * sgn(omega, 0.3)".parse().expect("a law");
        let law = law.seen_within(&[(Variable::WheelSpeed, [-1.0, 1.0])]);
        let known = KnownEffects::with(vec![OwnEffect::new("slow", law).expect("an effect")]);
        let robot = robot();
        let cuts = [cut(&driven(&robot, &[], 8.0), &cutting())];
        let p = Problem { known, ..problem(&robot, &cuts) };
        let retuned = p.begin(&crate::fit::Hypothesis::default(), p.origin(), None);
        let told = beyond_range(&p, &retuned, &[Cause::plain("slow", "slow", 0.9)]);
        assert!(told.len() == 1 && told[0].contains("held at its end"), "{told:?}");
        assert!(beyond_range(&p, &retuned, &[Cause::plain("none", "nothing", 0.9)]).is_empty());
    }
}
