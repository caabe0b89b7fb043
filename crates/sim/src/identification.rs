//! Identifiers over a recorded trajectory.

use identifier::{Identifier, Law, Step};
use nn_basis::{Basis, Scalar, real};

use crate::network_recipe::{SIGNALS, Signals};
use crate::tally::Tally;
use crate::{SimError, Trajectory};

/// Follows both wheel speeds with the given bases; `watch` sees every step of both outputs.
///
/// The regressor of an interval is taken at its mean speeds and the torques held over it, as the midpoint rule asks.
/// Each step is certified against `comparison` and against zero weights. In lanes, every lane is a draw of its own.
#[inline(always)]
pub(crate) fn follow<T: Scalar, B: Basis<T, SIGNALS, N>, L: Law<T, N> + Copy, const N: usize>(
    trajectory: &Trajectory,
    pole: f64,
    law: L,
    bases: &[B; 2],
    comparison: &[[T; N]; 2],
    mut watch: impl FnMut(usize, &[Step<T, N>; 2]),
) -> Result<[Tally<T>; 2], SimError> {
    let new = || Ok::<_, SimError>((Identifier::new(real(pole), law, T::zero())?, Tally::new(real(pole))));
    let mut outputs = [new()?, new()?];
    for k in 0..trajectory.torques.len() {
        let (now, next) = (&trajectory.states[k].speed, &trajectory.states[k + 1].speed);
        let signals = trajectory.signals(k);
        let [left, right] = &mut outputs;
        let h = trajectory.step;
        let steps = [
            advance(left, [now[0], next[0]], &signals[0], h, &bases[0], &comparison[0]),
            advance(right, [now[1], next[1]], &signals[1], h, &bases[1], &comparison[1]),
        ];
        let time = (k + 1) as f64 * h;
        for (i, step) in steps.iter().enumerate() {
            if !step.error_after.is_finite() {
                return Err(SimError::NotFinite { quantity: ["estimate of x3", "estimate of x4"][i], time });
            }
            outputs[i].1.add(trajectory, time, step);
        }
        watch(k, &steps);
    }
    Ok(outputs.map(|(_, tally)| tally))
}

/// One certified step of one output, whose speed goes from one value to the next, rad/s.
#[inline(always)]
fn advance<T: Scalar, B: Basis<T, SIGNALS, N>, L: Law<T, N>, const N: usize>(
    (identifier, tally): &mut (Identifier<T, N, L>, Tally<T>),
    [from, to]: [f64; 2],
    signals: &Signals,
    h: f64,
    basis: &B,
    comparison: &[T; N],
) -> Step<T, N> {
    let mut seen = [T::zero(); SIGNALS];
    for (seen, signal) in seen.iter_mut().zip(signals) {
        *seen = real(*signal);
    }
    let step = identifier.step(real(from), real(to), &basis.regressor(&seen), real(h));
    tally.chosen.add(&identifier.certificate(&step, comparison));
    tally.zero.add(&identifier.certificate(&step, &[T::zero(); N]));
    step
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;

    use identifier::Midpoint;
    use nn_basis::Basis;

    use super::follow;
    use crate::network_recipe::{SIGNALS, Signals};
    use crate::{Recipe, RobotSet, Trajectory, UNITS};

    /// A basis that notes what it is shown.
    #[derive(Default)]
    struct Probe(RefCell<Vec<Signals>>);

    impl Basis<f64, SIGNALS, UNITS> for Probe {
        fn regressor(&self, input: &Signals) -> [f64; UNITS] {
            self.0.borrow_mut().push(*input);
            [0.5; UNITS]
        }
    }

    #[test]
    fn each_output_sees_its_own_wheel_first() {
        let recipe = Recipe { samples: 5000, ..Recipe::default() };
        let run = Trajectory::simulate(&recipe, RobotSet::B).expect("runs");
        let probes = [Probe::default(), Probe::default()];
        let law = Midpoint::new(500.0).expect("valid");
        follow(&run, 8.0, law, &probes, &[[0.0; UNITS]; 2], |_, _| {}).expect("finite");
        let k = 4800;
        let mean = |i: usize| 0.5 * (run.states[k].speed[i] + run.states[k + 1].speed[i]);
        let turned = |i: usize| 0.5 * (run.states[k].angle[i] + run.states[k + 1].angle[i]);
        let u = run.torques[k];
        assert!((u[0] - u[1]).abs() > 1.0, "the robot turns here, so the sides differ");
        assert_eq!(probes[0].0.borrow()[k], [turned(0), turned(1), mean(0), mean(1), u[0], u[1]]);
        assert_eq!(probes[1].0.borrow()[k], [turned(1), turned(0), mean(1), mean(0), u[1], u[0]]);
    }
}
