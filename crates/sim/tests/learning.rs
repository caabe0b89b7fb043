//! The study of learning: a few draws of what `cargo xtask learn` measures on many.

use std::sync::LazyLock;

use sim::learning::{Contender, Score, Study, StudyRecipe};

static STUDY: LazyLock<Study> = LazyLock::new(|| Study::new(&StudyRecipe::default()).expect("runs"));

fn scores(contender: Contender) -> Vec<Score> {
    STUDY.ensemble(contender, 11, 3, || {}).expect("finite").scores
}

/// Mean of a score over the draws.
fn mean(scores: &[Score], of: impl Fn(&Score) -> f64) -> f64 {
    scores.iter().map(of).sum::<f64>() / scores.len() as f64
}

#[test]
fn with_a_memory_laps_get_better_and_frozen_weights_are_worth_something() {
    let (paper, memory) = (scores(Contender::Paper), scores(Contender::Memory));
    let constant = scores(Contender::Constant);
    let frozen = |s: &Score| s.frozen[0] + s.frozen[1];
    assert!(mean(&paper, frozen) > 12.0 * mean(&memory, frozen), "{paper:#?} {memory:#?}");
    assert!(mean(&memory, |s| s.lap[4] / s.lap[0]) < 0.75, "{memory:#?}");
    assert!(mean(&memory, |s| s.lap[4]) < 0.6 * mean(&paper, |s| s.lap[4]));
    assert!(mean(&constant, |s| s.ahead_kept[0][1]) > 5.0 * mean(&memory, |s| s.ahead_kept[0][1]));
    for score in paper.iter().chain(&memory).chain(&constant) {
        assert!(score.bounds_hold && score.residual < 1e-10, "{score:?}");
    }
}

#[test]
fn the_paper_s_law_keeps_nothing_and_does_not_improve() {
    let paper = scores(Contender::Paper);
    assert!(mean(&paper, |s| s.lap[4] / s.lap[0]) > 0.98, "{paper:#?}");
    // Frozen, it is as wrong as the signal is large.
    let run = &STUDY.unseen()[0].run;
    let signal = run.states.iter().map(|s| s.speed[0].powi(2) + s.speed[1].powi(2)).sum::<f64>();
    let signal = (0.5 * signal / run.states.len() as f64).sqrt();
    assert!(mean(&paper, |s| s.frozen[0]) > 0.9 * signal, "{signal} {paper:#?}");
}

#[test]
fn knowing_only_that_speeds_change_slowly_is_worth_as_much_as_frozen_weights_of_a_network() {
    let (nothing, memory) = (scores(Contender::Nothing), scores(Contender::Memory));
    let frozen = |s: &Score| s.frozen[0] + s.frozen[1];
    assert!(mean(&nothing, frozen) < mean(&memory, frozen));
}

#[test]
fn equation_8_returns_its_constants_and_predicts_on_steady_ground() {
    let mut recipe = StudyRecipe::default();
    recipe.recipe.disturbance = 0.0;
    let study = Study::new(&recipe).expect("runs");
    let score = study.run(Contender::StructuredMemory, 11, 0).expect("finite");
    let constant = study.run(Contender::Constant, 11, 0).expect("finite");
    let truth = study.training().robot.constants();
    for found in score.constants.expect("known") {
        assert!((found.a3 / truth.a3 - 1.0).abs() < 0.05, "{found:?}");
        assert!((found.a2_and_a6 / (truth.a2 + truth.a6) - 1.0).abs() < 0.02, "{found:?}");
        assert!((found.a1 / truth.a1 - 1.0).abs() < 0.25, "{found:?}");
    }
    // Even against a constant that has followed the lap until the start.
    assert!(5.0 * score.ahead_kept[0][1] < constant.ahead_acting[0][1], "{score:?} {constant:?}");
}
