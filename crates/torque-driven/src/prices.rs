//! What a hypothesis pays for its effects, and its evidence.

use faer::Mat;
use inference::algebra::solve_spd;
use inference::evidence::penalty_of_smallness;

use crate::fit::{Columns, Fitted, Hypothesis, Problem};
use crate::settings::decision::{Prices, SETTINGS};
use inference::hypothesis::{Onsets, Place, Sizes, Variant};

const PRICES: Prices = SETTINGS.prices;

/// Penalty of a hypothesis.
pub(crate) fn penalty(h: &Hypothesis, effects: &[f64], sizes: &Sizes) -> f64 {
    penalties(h, effects, sizes).iter().sum()
}

/// What each part of a hypothesis pays.
pub(crate) fn penalties(h: &Hypothesis, effects: &[f64], sizes: &Sizes) -> Vec<f64> {
    let mut rest = effects;
    let one = |(i, (v, onsets)): (usize, &(Variant, Onsets))| {
        let n = v.count();
        let (own, others) = rest.split_at(n);
        rest = others;
        let disc = if v.place == Place::Disc { 3 } else { 0 };
        let form = PRICES.per_effect + v.spec().rarity + PRICES.per_shape * (n - disc - 1) as f64;
        let place = if v.place == Place::Disc { PRICES.disc } else { 0.0 };
        let onset = if onsets.iter().any(Option::is_some) { PRICES.onset } else { 0.0 };
        let second = if i > 0 { PRICES.second } else { 0.0 };
        let small = penalty_of_smallness(v.magnitude(own), sizes.interest(v.spec()), PRICES.size_width);
        form + place + onset + second + small
    };
    h.parts.iter().enumerate().map(one).collect()
}

/// Evidence of a fitted hypothesis by the curvature of its cost (Laplace), less its penalty, nats:
/// `−F − ½ ln det(J + Λ) + ½ ln det Λ`, with unit information about each free value of its effects.
pub(crate) fn evidence(problem: &Problem<'_>, h: &Hypothesis, fitted: &Fitted) -> Option<f64> {
    let none = h.parts.is_empty();
    let columns = if none { Columns(Vec::new()) } else { problem.effect_columns(&fitted.point, h, &fitted.response) };
    let (mut normal, of_visits) =
        problem.normal_with_visits(&fitted.point, &fitted.response, &fitted.columns, &columns)?;
    problem.with_prior(&fitted.point, &mut normal);
    let n = normal.matrix.nrows();
    (problem.centre.len()..n).for_each(|i| normal.matrix[(i, i)] += 1.0);

    let log_determinant = |of: &Mat<f64>| solve_spd(of, &Mat::zeros(of.nrows(), 1)).map(|(_, ln)| ln);
    let occam = 0.5 * (log_determinant(&normal.matrix)? - log_determinant(&problem.information)? + of_visits);
    Some(-fitted.cost - occam - penalty(h, &fitted.point.effects, &problem.sizes()))
}

/// Penalty of sizes that the form of the plant's own laws may show: references take that in, a robot file does not.
pub(crate) fn penalty_of_form(h: &Hypothesis, effects: &[f64], sizes: &Sizes) -> f64 {
    let mut rest = effects;
    let of = |v: &Variant| {
        let (own, others) = rest.split_at(v.count());
        rest = others;
        let least = PRICES.form_errors * v.spec().form_error * sizes.factor(v.spec());
        penalty_of_smallness(v.magnitude(own), least, PRICES.size_width)
    };
    h.variants().map(of).sum()
}

/// Whether each effect of a hypothesis is of a size that anybody would look for. A law of the plant that is not quite the robot's
/// gives small effects large gains, those of second effects above all.
pub(crate) fn all_matter(h: &Hypothesis, effects: &[f64], sizes: &Sizes) -> bool {
    let least = if h.parts.len() > 1 { PRICES.least_beside } else { PRICES.least_alone };
    let mut rest = effects;
    h.variants().all(|v| {
        let (own, others) = rest.split_at(v.count());
        rest = others;
        v.magnitude(own).abs() >= least * sizes.interest(v.spec())
    })
}
