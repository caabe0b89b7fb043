//! Draws side by side are draws alone, bit for bit.

use sim::{Experiment, Integrator, Recipe, RobotSet, Scheme, SimError};

fn recipe(scheme: Scheme, units: usize) -> Recipe {
    let mut recipe = Recipe { samples: 3000, substeps: 5, ..Recipe::default() };
    recipe.identifier.scheme = scheme;
    recipe.identifier.network.units = units;
    recipe
}

#[test]
fn an_ensemble_is_its_draws_whatever_the_group_is_filled_with() {
    for (scheme, units) in [(Scheme::Midpoint, 6), (Scheme::Exponential, 6), (Scheme::Euler, 12)] {
        let experiment = Experiment::new(&recipe(scheme, units), RobotSet::B).expect("runs");
        let draws = experiment.ensemble(3, 11, || {}).expect("finite");
        assert_eq!(draws.len(), 11);
        for draw in draws {
            // Shares of windows that were not reached are NaN, which equals nothing.
            let alone = experiment.identify(3, draw.number).expect("finite");
            assert_eq!(format!("{draw:?}"), format!("{alone:?}"), "{scheme:?}");
        }
        assert!(experiment.ensemble(3, 0, || {}).expect("nothing").is_empty());
    }
}

#[test]
fn a_draw_that_diverges_is_named_as_when_alone() {
    let mut recipe = recipe(Scheme::Euler, 6);
    recipe.identifier.gain = 1e9;
    let experiment = Experiment::new(&recipe, RobotSet::B).expect("runs");
    let alone = experiment.identify(1, 0).expect_err("forward Euler diverges at this gain");
    let together = experiment.ensemble(1, 1, || {}).expect_err("as alone");
    assert!(matches!(alone, SimError::NotFinite { .. }), "{alone}");
    assert_eq!(alone.to_string(), together.to_string());
}

#[test]
fn the_implicit_plant_follows_the_explicit_one() {
    let explicit = Recipe { samples: 8000, ..Recipe::default() };
    let implicit = Recipe { substeps: 1, integrator: Integrator::Implicit, ..explicit.clone() };
    let run = |recipe: &Recipe| Experiment::new(recipe, RobotSet::B).expect("runs").trajectory().clone();
    let (a, b) = (run(&explicit), run(&implicit));
    let (a, b) = (a.states.last().expect("states"), b.states.last().expect("states"));
    let apart = ((a.x - b.x).powi(2) + (a.y - b.y).powi(2)).sqrt();
    assert!(apart < 1e-3 && a.x > 1.5, "{apart:e} m after {} m", a.x);
}
