//! Terms and laws.

use std::collections::BTreeMap;

use scalar::{Scalar, real};
use serde::{Deserialize, Serialize};

use crate::error::LawError;
use crate::factor::{Factor, Shape};
use crate::motion::{Action, Motion};
use crate::place::Place;
use crate::settings::SETTINGS;
use crate::unit::Unit;
use crate::variable::Variable;

/// Factors of a term, at most.
pub const MOST_FACTORS: usize = 3;
/// Terms of a law, at most.
pub const MOST_TERMS: usize = 2;

/// A constant times at most three factors, at a place.
#[derive(Debug, Clone, PartialEq)]
pub struct Term {
    place: Place,
    constant: f64,
    factors: Vec<Factor>,
}

impl Term {
    /// A term; its constant is in the unit that closes it, [`Term::unit`].
    ///
    /// # Errors
    /// When there are too many factors, a number is not finite, or a variable cannot enter its factor.
    pub fn new(place: Place, constant: f64, factors: &[Factor]) -> Result<Self, LawError> {
        if factors.len() > MOST_FACTORS {
            return Err(LawError::Factors(factors.len()));
        }
        if !constant.is_finite() {
            return Err(LawError::NotFinite(place.symbol().to_owned()));
        }
        let factors = factors.iter().map(|f| f.checked()).collect::<Result<_, _>>()?;
        Ok(Self { place, constant, factors })
    }

    /// Where it acts.
    pub fn place(&self) -> Place {
        self.place
    }

    /// Its constant, in [`Term::unit`].
    pub fn constant(&self) -> f64 {
        self.constant
    }

    /// Its factors.
    pub fn factors(&self) -> &[Factor] {
        &self.factors
    }

    /// The unit that closes the term: what acts at the place over the units of the factors.
    pub fn unit(&self) -> Unit {
        self.place.unit() / self.factors.iter().fold(Unit::ONE, |unit, f| unit * f.unit())
    }
}

/// One term or two, with the range in which each variable was seen.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Written", into = "Written")]
pub struct Law {
    terms: Vec<Term>,
    seen: Vec<(Variable, [f64; 2])>,
}

/// A law in a file: its formula, and ranges by the variables' symbols.
#[derive(Serialize, Deserialize)]
struct Written {
    formula: String,
    #[serde(default)]
    seen: std::collections::BTreeMap<String, [f64; 2]>,
}

impl From<Law> for Written {
    fn from(law: Law) -> Self {
        let seen = law.seen.iter().map(|(v, range)| (v.symbol().to_owned(), *range)).collect();
        Self { formula: law.to_string(), seen }
    }
}

impl TryFrom<Written> for Law {
    type Error = LawError;

    fn try_from(written: Written) -> Result<Self, LawError> {
        let law: Self = written.formula.parse()?;
        let seen = written.seen.into_iter().map(|(name, range)| {
            let variable = Variable::seen(&name, range)?;
            Ok((variable, range))
        });
        let seen = seen.collect::<Result<Vec<_>, LawError>>()?;
        Ok(law.seen_within(&seen))
    }
}

impl Law {
    /// A law of these terms.
    ///
    /// # Errors
    /// When there is none, or more than two.
    pub fn new(terms: Vec<Term>) -> Result<Self, LawError> {
        if terms.is_empty() || terms.len() > MOST_TERMS {
            return Err(LawError::Terms(terms.len()));
        }
        Ok(Self { terms, seen: Vec::new() })
    }

    /// The same, whose variables are held within the ranges in which they were seen.
    #[must_use]
    pub fn seen_within(mut self, seen: &[(Variable, [f64; 2])]) -> Self {
        self.seen = seen.to_vec();
        self.seen.sort_by_key(|(v, _)| v.symbol());
        self.seen.dedup_by_key(|(v, _)| *v);
        self
    }

    /// A law as verdicts hold it: its formula, and the ranges in which its variables were seen, by their symbols.
    ///
    /// # Errors
    /// What is wrong with the formula.
    pub fn of_formula(formula: &str, seen: &BTreeMap<String, [f64; 2]>) -> Result<Self, LawError> {
        let law: Self = formula.parse()?;
        let seen: Vec<(Variable, [f64; 2])> =
            law.variables().into_iter().filter_map(|v| Some((v, *seen.get(v.symbol())?))).collect();
        Ok(law.seen_within(&seen))
    }

    /// Its terms.
    pub fn terms(&self) -> &[Term] {
        &self.terms
    }

    /// Ranges in which its variables were seen.
    pub fn seen(&self) -> &[(Variable, [f64; 2])] {
        &self.seen
    }

    /// Its variables, each once.
    pub fn variables(&self) -> Vec<Variable> {
        let mut all: Vec<Variable> = self.factors().filter_map(Factor::variable).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    fn factors(&self) -> impl Iterator<Item = Factor> {
        self.terms.iter().flat_map(|t| t.factors.iter().copied())
    }

    /// Whether a factor remembers what was before.
    pub fn has_state(&self) -> bool {
        self.factors().any(Factor::is_state)
    }

    /// What a fit may change: every term's constant, then its shapes, term by term. A constant's
    /// bounds and unit of change are the caller's to choose: here it is as large as it is.
    pub fn numbers(&self) -> Vec<Shape> {
        let most = SETTINGS.shapes.most;
        let of = |t: &Term| -> Vec<Shape> {
            let size = t.constant.abs().max(SETTINGS.shapes.least);
            let constant = Shape { value: t.constant, unit: size, bounds: [-most, most] };
            std::iter::once(constant).chain(t.factors.iter().flat_map(|f| f.shapes())).collect()
        };
        self.terms.iter().flat_map(of).collect()
    }

    /// The same with other numbers, in the order of [`Law::numbers`]; missing ones stay.
    #[must_use]
    pub fn with(&self, numbers: &[f64]) -> Self {
        let mut out = self.clone();
        let mut rest = numbers.iter().copied().filter(|x| x.is_finite());
        for term in &mut out.terms {
            term.constant = rest.next().unwrap_or(term.constant);
            for factor in &mut term.factors {
                let shapes: Vec<f64> = factor.shapes().iter().map(|s| rest.next().unwrap_or(s.value)).collect();
                *factor = factor.with(&shapes);
            }
        }
        out
    }

    /// What it does to the robot at an instant; `memory` are its hidden states, as a
    /// [`Memory`](crate::Memory) keeps them.
    #[inline(always)]
    pub fn act<T: Scalar>(&self, m: &Motion<T>, memory: &[T]) -> Action<T> {
        self.evaluated(m, memory, |_, own| real(own))
    }

    /// The same without hidden states, at other numbers, in the order of [`Law::numbers`]; missing ones stay.
    #[inline(always)]
    pub fn act_with<T: Scalar>(&self, m: &Motion<T>, numbers: &[T]) -> Action<T> {
        self.evaluated(m, &[], |i, own| numbers.get(i).copied().unwrap_or_else(|| real(own)))
    }

    /// The same with each number by its place in [`Law::numbers`] and its own value.
    #[inline(always)]
    fn evaluated<T: Scalar>(&self, m: &Motion<T>, memory: &[T], number: impl Fn(usize, f64) -> T) -> Action<T> {
        let most = SETTINGS.guard.most;
        let limit = |v: Variable, x: T| {
            let [low, high] = self.seen.iter().find(|(w, _)| *w == v).map_or([-most, most], |(_, range)| *range);
            x.max(real(low)).min(real(high))
        };
        let mut out = Action::default();
        let mut states = memory.iter().copied();
        let mut first = 0;
        for term in &self.terms {
            let mut next = first;
            for &(input, of) in term.place.inputs() {
                let mut value = number(first, term.constant);
                next = first + 1;
                for factor in &term.factors {
                    let (own, count) = factor.shape_values();
                    let shape = |k: usize| if k < count { number(next + k, own[k]) } else { T::zero() };
                    let shapes = [shape(0), shape(1), shape(2)];
                    let state = if factor.is_state() { states.next().unwrap_or_else(T::zero) } else { T::zero() };
                    value *= factor.value(m, of, &limit, shapes, state);
                    next += count;
                }
                out.add(input, value);
            }
            first = next;
        }
        out
    }
}
