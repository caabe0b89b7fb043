//! Laws on drives of the plant itself, whose truth is known.

use inference::hypothesis::{Dose, Place as Present};
use law::{Law, Place};
use testing::robot;

use super::acting::Acting;
use super::rank::Ranking;
use super::refit::{Starts, hypothesis, numbers};
use crate::channel::Channel;
use crate::fit::{Fitted, Hypothesis, Point, Problem, difference};
use crate::nothing::retune;
use crate::settings::law::SETTINGS;
use crate::simulate::Response;
use crate::testing::{cutting, driven, problem};
use crate::windows::{Cut, cut};

fn cuts(doses: &[Dose]) -> [Cut; 2] {
    [12.0, 16.0].map(|seconds| cut(&driven(&robot(), doses, seconds), &cutting()))
}

/// Numbers of a response in units of each channel's noise, without the segment that starts at rest.
fn moving(p: &Problem<'_>, y: &Response) -> Vec<f64> {
    let windows = y.iter().flat_map(|run| run.iter().skip(1)).flatten();
    windows.flat_map(|w| Channel::ALL.map(|c| w[c] / p.variance[c].sqrt())).collect()
}

fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    dot(a, b) / (dot(a, a) * dot(b, b)).sqrt()
}

#[test]
fn a_superposed_column_is_that_of_a_free_run() {
    let (robot, cuts) = (robot(), cuts(&[]));
    let p = problem(&robot, &cuts);
    let base = p.begin(&Hypothesis::default(), p.origin(), None);
    let ranking = Ranking::new(&p, &base);
    for formula in [
        "T_both = -0.05 [N m] * sgn(omega, 0.3)",
        "T_both = -0.01 [N m s/rad] * pow(omega, 1)",
        "F_x = -1 [N s^2/m^2] * pow(v, 2)",
        "slope_x = 0.005 [rad]",
        "grip_all = -0.05 [1]",
    ] {
        let law: Law = formula.parse().expect("a law");
        let h = hypothesis(&law, &[1.0]);
        let point = Point { effects: numbers(&law), ..base.point.clone() };
        let finite = difference(&p.response(&point, &h), &base.response, 1.0);
        let column = ranking.operator.column(&ranking.signals.inputs(&law));
        let agree = correlation(&moving(&p, &finite), &moving(&p, &column));
        assert!(agree > 0.98, "{formula}: {agree}");
    }
}

#[test]
fn given_inputs_act_as_the_law_that_they_are_of() {
    let (robot, cuts) = (robot(), cuts(&[]));
    let p = problem(&robot, &cuts);
    let base = p.begin(&Hypothesis::default(), p.origin(), None);
    let law: Law = "M_z = 0.5 [N m]".parse().expect("a law");
    let inputs = std::sync::Arc::new(super::signals::Signals::new(&p, &base).inputs(&law));
    let given = Acting::Given { inputs, times: 1.0, unit: 1.0 };
    let of = |h: &Hypothesis, effects: Vec<f64>| p.response(&Point { effects, ..base.point.clone() }, h);
    let by_law = of(&hypothesis(&law, &[1.0]), vec![0.5]);
    let by_inputs = of(&Hypothesis { acting: Some(given), ..Hypothesis::default() }, vec![1.0]);
    let far = moving(&p, &difference(&by_law, &by_inputs, 1.0)).into_iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    assert!(far < 1e-6, "{far}");
}

/// The best law of drives with these doses, with the place that it acts on and the share of the gap that it closes.
fn best_law(doses: &[Dose]) -> (Place, String, f64, f64) {
    let (robot, cuts) = (robot(), cuts(doses));
    let p = problem(&robot, &cuts);
    let none = Hypothesis::default();
    let origin = p.begin(&none, p.origin(), None);
    let retuned: Fitted = retune(&p, &none, origin.clone());
    let ranking = Ranking::new(&p, &origin);
    let found = Starts { origin: &origin, retuned: &retuned }.search(&ranking, &ranking.all());
    let best = &found[0];
    // The plant itself would leave nothing.
    (best.law.terms()[0].place(), best.law.to_string(), best.gain / retuned.cost, best.score)
}

fn dose(id: &str, place: Present, value: f64) -> Dose {
    let all = inference::hypothesis::variants(true);
    let form = all.into_iter().find(|v| v.spec().id == id && v.place == place).expect("in the catalogue");
    form.dose(&[value], None)
}

#[test]
fn a_hidden_brake_of_one_side_is_a_law_of_that_side() {
    let (place, formula, closed, _) = best_law(&[dose("coulomb_side", Present::Side(1), 0.6)]);
    assert_eq!(place, Place::TorqueRight, "{formula}");
    assert!(closed > 0.7, "{formula} closes {closed}");
}

#[test]
fn a_hidden_drag_is_a_force_on_the_body() {
    let (place, formula, closed, _) = best_law(&[dose("quadratic_drag", Present::Whole, 12.0)]);
    assert!([Place::ForceForward, Place::ForceBoth].contains(&place), "{formula}");
    assert!(closed > 0.7, "{formula} closes {closed}");
}

#[test]
fn a_robot_that_lacks_nothing_has_no_law() {
    let (_, formula, _, score) = best_law(&[]);
    assert!(score < SETTINGS.gates.score, "{formula}: {score}");
}
