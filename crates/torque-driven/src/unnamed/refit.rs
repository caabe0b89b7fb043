//! Finalists in free run: refits, moves, prices.

use law::{Factor, Law, Term, Variable};
use rayon::prelude::*;

use super::acting::Acting;
use super::rank::{Ranked, Ranking};
use crate::fit::{Fitted, Hypothesis, Point, Problem};
use crate::settings::law::{Prices, Refit, SETTINGS};

const REFIT: Refit = SETTINGS.refit;
const PRICES: Prices = SETTINGS.prices;

/// A law that was fitted in free run.
#[derive(Clone)]
pub(crate) struct Refitted {
    /// At its fitted numbers.
    pub(crate) law: Law,
    pub(crate) units: Vec<f64>,
    pub(crate) fitted: Fitted,
    /// Fall of the cost below "re-tune only", less what the law is made of, nats.
    pub(crate) score: f64,
    pub(crate) gain: f64,
}

/// A law alone, as a hypothesis.
pub(crate) fn hypothesis(law: &Law, units: &[f64]) -> Hypothesis {
    let acting = Some(Acting::Law { law: law.clone(), units: units.to_vec() });
    Hypothesis { parts: Vec::new(), acting }
}

/// The free numbers of a law.
pub(crate) fn numbers(law: &Law) -> Vec<f64> {
    law.numbers().iter().map(|n| n.value).collect()
}

/// What a law pays: for its factors and for its numbers beyond the first.
pub(crate) fn price(law: &Law) -> f64 {
    let factors = law.terms().iter().map(|t| t.factors().len()).max().unwrap_or(0);
    PRICES.law + PRICES.factor * factors as f64 + PRICES.shape * (law.numbers().len() - 1) as f64
}

/// Where refits start from and what they are compared with.
pub(crate) struct Starts<'a> {
    pub(crate) origin: &'a Fitted,
    pub(crate) retuned: &'a Fitted,
}

impl Starts<'_> {
    fn from(&self, problem: &Problem<'_>, law: &Law, units: &[f64], start: &Fitted, steps: usize) -> Refitted {
        let h = hypothesis(law, units);
        let point = Point { effects: numbers(law), ..start.point.clone() };
        let begun = problem.begin(&h, point, Some(start.columns.clone()));
        let fitted = problem.refine(&h, begun, steps, None);
        self.of(law.with(&fitted.point.effects), units, fitted)
    }

    fn of(&self, law: Law, units: &[f64], fitted: Fitted) -> Refitted {
        let gain = self.retuned.cost - fitted.cost;
        Refitted { score: gain - price(&law), gain, units: units.to_vec(), fitted, law }
    }

    /// A first refit: from the calibrated point, and from the re-tuned one where that gains little.
    pub(crate) fn refit(&self, problem: &Problem<'_>, law: &Law, units: &[f64]) -> Refitted {
        let first = self.from(problem, law, units, self.origin, REFIT.steps);
        if first.gain >= REFIT.small_gain {
            return first;
        }
        let again = self.from(problem, law, units, self.retuned, REFIT.steps);
        if again.gain > first.gain { again } else { first }
    }

    /// More steps with renewed columns, for what may win.
    fn polish(&self, problem: &Problem<'_>, r: &Refitted) -> Refitted {
        let h = hypothesis(&r.law, &r.units);
        let fitted = problem.refine(&h, r.fitted.clone(), REFIT.more_steps, Some(0));
        self.of(r.law.with(&fitted.point.effects), &r.units, fitted)
    }

    /// Finalists of a ranking, refitted, changed one thing at a time, the best first.
    pub(crate) fn search(&self, ranking: &Ranking<'_>, ranked: &[Ranked]) -> Vec<Refitted> {
        let problem = ranking.problem;
        let finalists = finalists(ranked);
        let mut out: Vec<Refitted> = finalists.par_iter().map(|r| self.refit(problem, &r.law, &r.units)).collect();
        best_first(&mut out);

        let mut known: Vec<String> = out.iter().map(|r| kind(&r.law)).collect();
        let mut moves: Vec<(Law, Vec<f64>)> = Vec::new();
        for r in out.iter().take(REFIT.movers) {
            for terms in changed(&r.law) {
                let moved = matched(ranking, r, &terms);
                if let Some((law, units)) = moved.filter(|(law, _)| !known.contains(&kind(law))) {
                    known.push(kind(&law));
                    moves.push((law, units));
                }
            }
        }
        let in_turn = moves.par_iter().take(REFIT.moves).map(|(law, units)| self.refit(problem, law, units));
        out.extend(in_turn.collect::<Vec<_>>());
        best_first(&mut out);

        let best = out.first().map_or(0.0, |r| r.score);
        let close = out.iter().take_while(|r| r.score > best - REFIT.close).count().min(REFIT.movers);
        let polished: Vec<Refitted> = out[..close].par_iter().map(|r| self.polish(problem, r)).collect();
        for (r, better) in out.iter_mut().zip(polished) {
            if better.gain > r.gain {
                *r = better;
            }
        }
        best_first(&mut out);
        out
    }
}

fn best_first(all: &mut [Refitted]) {
    all.sort_by(|a, b| b.score.total_cmp(&a.score));
}

/// A law without its numbers' values, to tell whether it was tried.
fn kind(law: &Law) -> String {
    let factor = |f: &Factor| match f {
        Factor::Power(..) | Factor::EvenPower(..) | Factor::Turn(..) => f.with(&[0.0]).to_string(),
        Factor::Disc(..) => "disc".to_owned(),
        _ => f.with(&vec![1.0; f.shapes().len()]).to_string(),
    };
    let term = |t: &Term| format!("{} {:?}", t.place().symbol(), t.factors().iter().map(factor).collect::<Vec<_>>());
    law.terms().iter().map(term).collect::<Vec<_>>().join("; ")
}

/// The best of each place and first factor, few of one place.
fn finalists(ranked: &[Ranked]) -> Vec<Ranked> {
    let mut out: Vec<Ranked> = Vec::new();
    for r in ranked {
        let term = &r.law.terms()[0];
        let same_place = |o: &&Ranked| o.law.terms()[0].place() == term.place();
        let first = |t: &Term| t.factors().first().copied();
        let alike = |o: &Ranked| match (first(&o.law.terms()[0]), first(term)) {
            (Some(a), Some(b)) => a.is_alike(b),
            (a, b) => a.is_none() && b.is_none(),
        };
        let of_place = out.iter().filter(same_place).count();
        if of_place < REFIT.per_place && !out.iter().filter(same_place).any(alike) {
            out.push(r.clone());
        }
        if out.len() == REFIT.finalists {
            break;
        }
    }
    out
}

/// Laws one change away: a factor less, another power, other sides.
fn changed(law: &Law) -> Vec<Vec<Term>> {
    let [term] = law.terms() else { return Vec::new() };
    let of = |place, factors: &[Factor]| Term::new(place, term.constant(), factors).ok().map(|t| vec![t]);
    let factors = term.factors();
    let mut out: Vec<Option<Vec<Term>>> =
        term.place().on_other_sides().into_iter().map(|place| of(place, factors)).collect();
    for (i, f) in factors.iter().enumerate() {
        let mut rest = factors.to_vec();
        rest.remove(i);
        out.push(of(term.place(), &rest));
        for other in exchanged(*f) {
            let mut all = factors.to_vec();
            all[i] = other;
            out.push(of(term.place(), &all));
        }
    }
    out.into_iter().flatten().collect()
}

/// Other powers of the same variable, with the same symmetry.
fn exchanged(f: Factor) -> Vec<Factor> {
    let odd = |v: Variable| -> Vec<Factor> {
        let dry = law::dry_sign(v);
        [dry, Factor::Power(v, 1), Factor::Power(v, 2)].into_iter().filter(|o| !o.is_alike(f) || *o != f).collect()
    };
    match f {
        Factor::Power(v, _) | Factor::Sign(v, _) | Factor::Clip(v, _) | Factor::Excess(v, _) => odd(v),
        Factor::EvenPower(v, p) => (1..=2).filter(|o| *o != p).map(|o| Factor::EvenPower(v, o)).collect(),
        _ => Vec::new(),
    }
}

/// A changed law whose constant is as many usual sizes as it was.
fn matched(ranking: &Ranking<'_>, from: &Refitted, terms: &[Term]) -> Option<(Law, Vec<f64>)> {
    let (before, after) = (ranking.scaled(from.law.terms().first()?)?.1, ranking.scaled(terms.first()?)?.1);
    // `scaled` takes a term's own constant into its size.
    let constant = terms[0].constant() * after / before;
    let term = Term::new(terms[0].place(), constant, terms[0].factors()).ok()?;
    let unit = after * terms[0].constant().abs();
    Some((Law::new(vec![term]).ok()?, vec![unit.max(f64::MIN_POSITIVE)]))
}
