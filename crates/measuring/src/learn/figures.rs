//! What is asked of the law that retains, and what was found.

use sim::learning::{Contender, Score, Tried};
use sim::statistics;

use super::Outcome;
use crate::output::{Asked, Figure};

/// The unseen laps that go the same way round as the training lap.
pub(super) const SAME_WAY: std::ops::Range<usize> = 0..2;
/// The unseen lap that goes the other way round.
pub(super) const OTHER_WAY: usize = 2;
/// Largest residual of a certificate that rounding explains.
const ROUNDING: f64 = 1e-10;

/// Median of a score over the draws.
pub(super) fn median(tried: &Tried, of: impl Fn(&Score) -> f64) -> f64 {
    statistics::median(tried.scores.iter().map(of))
}

/// Root mean square over the unseen laps that go the same way round.
pub(super) fn same_way(values: impl Fn(usize) -> f64) -> f64 {
    let count = SAME_WAY.len() as f64;
    (SAME_WAY.map(|lap| values(lap).powi(2)).sum::<f64>() / count).sqrt()
}

/// RMSE of all training laps together.
pub(super) fn all_laps(score: &Score) -> f64 {
    (score.lap.iter().map(|l| l * l).sum::<f64>() / score.lap.len().max(1) as f64).sqrt()
}

/// Runs in which the certificate of a step, or a mean-square bound, was violated.
pub(super) fn violated(tried: &Tried) -> usize {
    tried.scores.iter().filter(|s| !s.bounds_hold || s.residual.is_nan() || s.residual > ROUNDING).count()
}

/// Median over the draws of one contender's score over another's in the same draw.
fn ratio(a: Option<&Tried>, b: Option<&Tried>, of: impl Fn(&Score) -> f64) -> f64 {
    let (Some(a), Some(b)) = (a, b) else { return f64::NAN };
    statistics::median(a.scores.iter().zip(&b.scores).map(|(a, b)| of(a) / of(b)))
}

/// All figures, those with a target first.
pub(super) fn all(o: &Outcome) -> Vec<Figure> {
    let (memory, paper, constant) = (o.of(Contender::Memory), o.of(Contender::Paper), o.of(Contender::Constant));
    let frozen = |s: &Score| same_way(|lap| s.frozen[lap]);
    let kept = |h: usize| move |s: &Score| same_way(|lap| s.ahead_kept[lap][h]);
    let acting = |h: usize| move |s: &Score| same_way(|lap| s.ahead_acting[lap][h]);
    let free = |name: &str, value: f64| Figure::free(name, value, "");
    let violations = o.tried.iter().chain(&o.steady).map(violated).sum::<usize>() as f64;
    let last = |s: &Score| s.lap.last().copied().unwrap_or(f64::NAN);
    let laps = memory.map_or(f64::NAN, |m| median(m, |s| last(s) / s.lap[0]));
    vec![
        free("frozen weights on unseen laps: the paper's law over memory", ratio(paper, memory, frozen))
            .asked(Asked::AtLeast(25.0)),
        free("running ahead 0.5 s with what is kept: constant over memory", ratio(constant, memory, kept(1)))
            .asked(Asked::AtLeast(5.0)),
        free("lap 5 over lap 1, memory", laps).asked(Asked::AtMost(0.7)),
        free("online RMSE of all laps: memory over the paper's law", ratio(memory, paper, all_laps))
            .asked(Asked::AtMost(0.75)),
        free("runs with a violated certificate, all laws", violations).asked(Asked::AtMost(0.0)),
        free(
            "frozen weights chosen with hindsight on the unseen laps: the paper's law over them",
            paper.map_or(f64::NAN, |p| median(p, |s| frozen(s) / same_way(|lap| s.hindsight[lap]))),
        ),
        free("online RMSE of the last lap: memory over the paper's law", ratio(memory, paper, last)),
        free(
            "frozen weights, the other way round: the paper's law over memory",
            ratio(paper, memory, |s| s.frozen[OTHER_WAY]),
        ),
        free("running ahead 0.1 s with what is kept: constant over memory", ratio(constant, memory, kept(0))),
        free("running ahead 2 s with what is kept: constant over memory", ratio(constant, memory, kept(2))),
        free("running ahead 0.5 s with what acts: constant over memory", ratio(constant, memory, acting(1))),
        free("running ahead 2 s with what acts: constant over memory", ratio(constant, memory, acting(2))),
        free(
            "running ahead 0.5 s on steady ground: constant (acting) over Eq. 8 with memory (kept)",
            steady_gain(o, 1),
        ),
        free("running ahead 2 s on steady ground: constant (acting) over Eq. 8 with memory (kept)", steady_gain(o, 2)),
    ]
}

/// How much better Eq. 8 with what it keeps runs ahead than a constant regressor that follows until then.
fn steady_gain(o: &Outcome, horizon: usize) -> f64 {
    let of = |c| o.steady.iter().find(|t| t.contender == c);
    let (Some(constant), Some(structured)) = (of(Contender::Constant), of(Contender::StructuredMemory)) else {
        return f64::NAN;
    };
    median(constant, |s| same_way(|lap| s.ahead_acting[lap][horizon]))
        / median(structured, |s| same_way(|lap| s.ahead_kept[lap][horizon]))
}
