//! Hidden states of a law, row by row.

use crate::motion::Motion;
use crate::term::Law;

/// Hidden states of a law: they run on, however often a simulation is started anew.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Memory {
    states: Vec<f64>,
}

impl Memory {
    /// At the beginning: nothing has happened yet.
    pub fn new(law: &Law) -> Self {
        let of = |t: &crate::Term| t.place().inputs().len() * t.factors().iter().filter(|f| f.is_state()).count();
        Self { states: vec![0.0; law.terms().iter().map(of).sum()] }
    }

    /// The states, in the order in which [`Law::act`] takes them.
    pub fn states(&self) -> &[f64] {
        &self.states
    }

    /// A step of `dt` seconds at a motion: `y ← x + (y − x) exp(−dt/τ)`, exact for an input that is held.
    pub fn step(&mut self, law: &Law, m: &Motion<f64>, dt: f64) {
        let mut states = self.states.iter_mut();
        for term in law.terms() {
            for &(_, of) in term.place().inputs() {
                for (x, tau) in term.factors().iter().filter_map(|f| f.followed(m, of)) {
                    let Some(y) = states.next() else { return };
                    let keep = if tau > 0.0 { (-dt / tau).exp() } else { 0.0 };
                    let next = x + (*y - x) * keep;
                    *y = if next.is_finite() { next } else { 0.0 };
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lag_follows_its_input_and_runs_on() {
        let law: Law = "T_both = 2 [1] * lag(T, 0.5)".parse().expect("a law");
        let mut memory = Memory::new(&law);
        let m = Motion { torque: [1.0, -1.0], ..Motion::default() };
        for _ in 0..100 {
            memory.step(&law, &m, 0.01);
        }
        let expected = 2.0 * (1.0 - (-2.0_f64).exp());
        let torque = law.act(&m, memory.states()).torque;
        assert!((torque[0] - expected).abs() < 1e-12 && (torque[1] + expected).abs() < 1e-12, "{torque:?}");
    }
}
