//! Every candidate of the grammar by its evidence over re-tuning.

use faer::Mat;
use inference::algebra::select;
use law::{Law, MOST_TERMS, Place, Term, candidates};
use rayon::prelude::*;

use super::acting::Inputs;
use super::operator::{Operator, usual};
use super::signals::Signals;
use crate::candidate::{Ground, evidence, reduced};
use crate::fit::{Columns, Fitted, Problem};
use crate::local::farthest_points;
use crate::settings::law::SETTINGS;

/// A law with its evidence.
#[derive(Clone)]
pub(crate) struct Ranked {
    /// Its constants are those of the linear problem.
    pub(crate) law: Law,
    /// A usual size of each term's constant.
    pub(crate) units: Vec<f64>,
    /// Log Bayes factor over "re-tune only", nats.
    pub(crate) evidence: f64,
}

/// Where candidates are ranked: a point of a problem, with responses and motions there.
pub(crate) struct Ranking<'a> {
    pub(crate) problem: &'a Problem<'a>,
    pub(crate) base: &'a Fitted,
    pub(crate) operator: Operator,
    pub(crate) signals: Signals,
}

impl<'a> Ranking<'a> {
    /// At a point without any effect.
    pub(crate) fn new(problem: &'a Problem<'a>, base: &'a Fitted) -> Self {
        Self { problem, base, operator: Operator::new(problem, base), signals: Signals::new(problem, base) }
    }

    /// All candidates, best first: every single factor at every place, then products at the best places.
    pub(crate) fn all(&self) -> Vec<Ranked> {
        let scales = self.signals.scales(farthest_points(self.problem, SETTINGS.operator.spots));
        let all = candidates(&scales);
        let (products, singles): (Vec<_>, Vec<_>) =
            all.into_iter().partition(|c| c.iter().any(|t| t.factors().len() > 1));
        let mut out = self.weigh(&singles);
        best_first(&mut out);
        let mut places: Vec<Place> = Vec::new();
        for place in out.iter().map(|r| r.law.terms()[0].place()) {
            if places.len() < SETTINGS.operator.places && !places.contains(&place) {
                places.push(place);
            }
        }
        let products: Vec<Vec<Term>> = products.into_iter().filter(|c| places.contains(&c[0].place())).collect();
        out.extend(self.weigh(&products));
        best_first(&mut out);
        out
    }

    /// Evidence of candidates, each alone.
    pub(crate) fn weigh(&self, all: &[Vec<Term>]) -> Vec<Ranked> {
        let together: Vec<&[Vec<Term>]> = all.chunks(SETTINGS.operator.together).collect();
        together.into_par_iter().flat_map_iter(|chunk| self.weigh_together(chunk)).collect()
    }

    fn weigh_together(&self, chunk: &[Vec<Term>]) -> Vec<Ranked> {
        let mut inputs: Vec<Inputs> = Vec::new();
        let mut of: Vec<(usize, Vec<Term>, Vec<f64>)> = Vec::new();
        for terms in chunk {
            let scaled: Option<Vec<(Inputs, f64)>> = terms.iter().map(|t| self.scaled(t)).collect();
            if let Some(scaled) = scaled {
                of.push((inputs.len(), terms.clone(), scaled.iter().map(|s| s.1).collect()));
                inputs.extend(scaled.into_iter().map(|s| s.0));
            }
        }
        let ground = Ground { problem: self.problem, base: self.base, beside: Columns(Vec::new()) };
        let Some((a, b)) = reduced(&ground, Columns(self.operator.columns(&inputs))) else { return Vec::new() };
        let rank = |(at, terms, units): (usize, Vec<Term>, Vec<f64>)| {
            let mine: Vec<usize> = (at..at + terms.len()).collect();
            let right = Mat::from_fn(mine.len(), 1, |i, _| b[(mine[i], 0)]);
            let (value, x, _) = evidence(&select(&a, &mine), &right)?;
            let constants: Vec<f64> = x.iter().zip(&units).map(|(x, unit)| x * unit).collect();
            let (law, units) = joined(&terms, &constants, &units)?;
            value.is_finite().then_some(Ranked { law, units, evidence: value })
        };
        of.into_iter().filter_map(rank).collect()
    }

    /// What a term with a constant of usual size does in every window, and that size; `None` where it does nothing.
    pub(crate) fn scaled(&self, term: &Term) -> Option<(Inputs, f64)> {
        let law = Law::new(vec![term.clone()]).ok()?;
        let mut inputs = self.signals.inputs(&law);
        let input = inputs.first()?.0;
        let all = || inputs.iter().flat_map(|(_, runs)| runs.iter().flatten().copied());
        let rms = inference::robust::rms(all()).filter(|r| r.is_finite() && *r > 1e-9)?;
        let unit = usual(self.problem, input) / rms;
        for (_, runs) in &mut inputs {
            runs.iter_mut().flatten().for_each(|u| *u *= unit);
        }
        Some((inputs, unit))
    }
}

/// A law of terms that were weighed with these constants: a harmonic's two columns become one term with a phase.
fn joined(terms: &[Term], constants: &[f64], units: &[f64]) -> Option<(Law, Vec<f64>)> {
    if let ([a, b], &[ca, cb]) = (terms, constants)
        && a.place() == b.place()
        && a.factors().len() == 1
    {
        // c_a cos x + c_b sin x = c cos(x − atan2(c_b, c_a)).
        let (size, phase) = (ca.hypot(cb), -cb.atan2(ca));
        let mut shapes: Vec<f64> = a.factors()[0].shapes().iter().map(|s| s.value).collect();
        *shapes.last_mut()? = phase;
        let term = Term::new(a.place(), size, &[a.factors()[0].with(&shapes)]).ok()?;
        return Some((Law::new(vec![term]).ok()?, vec![units[0]]));
    }
    let made = terms.iter().zip(constants).take(MOST_TERMS).map(|(t, c)| Term::new(t.place(), *c, t.factors()).ok());
    Some((Law::new(made.collect::<Option<_>>()?).ok()?, units.to_vec()))
}

pub(crate) fn best_first(all: &mut [Ranked]) {
    all.sort_by(|a, b| b.evidence.total_cmp(&a.evidence));
}
