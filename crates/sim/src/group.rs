//! Several draws of identifiers side by side.

use identifier::{Euler, Exponential, Law, Midpoint};
use nn_basis::{Lanes, SigmoidLayer};
use pulp::NullaryFnOnce;

use crate::identification::follow;
use crate::network_recipe::SIGNALS;
use crate::tally::Tally;
use crate::{Draw, Purpose, Recipe, Scheme, SimError, Stream, Trajectory, comparison};

/// Draws that run side by side.
pub(crate) const WIDTH: usize = 8;
type Wide = Lanes<WIDTH>;

/// Runs the identifiers of up to [`WIDTH`] draws; the last one fills what is left over.
pub(crate) fn identify<const N: usize>(
    recipe: &Recipe,
    trajectory: &Trajectory,
    seed: u64,
    numbers: &[u64],
) -> Result<Vec<Draw>, SimError> {
    let Some(last) = numbers.last() else { return Ok(Vec::new()) };
    let mut layers = [Vec::new(), Vec::new()];
    let mut weights = [[Lanes([0.0; WIDTH]); N]; 2];
    for lane in 0..WIDTH {
        let number = *numbers.get(lane).unwrap_or(last);
        let mut stream = Stream::new(seed, Purpose::IdentifierLayer, number);
        let drawn = recipe.identifier.network.layers::<N>(trajectory, &mut stream)?;
        let compared = comparison::<N>(seed, number);
        for i in 0..2 {
            layers[i].push(drawn[i]);
            for j in 0..N {
                weights[i][j].0[lane] = compared[i][j];
            }
        }
    }
    let [left, right] = layers.map(|list| list.try_into().ok().and_then(|all| SigmoidLayer::side_by_side(&all)));
    let (Some(left), Some(right)) = (left, right) else {
        return Err(SimError::Recipe("the layers of the draws differ in their activation".into()));
    };
    let group = Group { trajectory, pole: recipe.identifier.pole, bases: &[left, right], comparison: &weights };
    let gain = Lanes([recipe.identifier.gain; WIDTH]);
    let tallies = match recipe.identifier.scheme {
        Scheme::Midpoint => group.by(Midpoint::new(gain)?),
        Scheme::Exponential => group.by(Exponential::new(gain)?),
        Scheme::Euler => group.by(Euler::new(gain)?),
    }?;
    let [left, right] = tallies.map(|t| t.apart());
    let samples = trajectory.torques.len();
    let draws = numbers.iter().zip(left.into_iter().zip(right));
    Ok(draws.map(|(n, (l, r))| Draw { number: *n, output: [l.close(samples), r.close(samples)] }).collect())
}

/// What the identifiers of a group follow, and by what.
#[derive(Clone, Copy)]
struct Group<'a, const N: usize> {
    trajectory: &'a Trajectory,
    pole: f64,
    bases: &'a [SigmoidLayer<Wide, SIGNALS, N>; 2],
    comparison: &'a [[Wide; N]; 2],
}

impl<const N: usize> Group<'_, N> {
    fn by<L: Law<Wide, N> + Copy>(self, law: L) -> Result<[Tally<Wide>; 2], SimError> {
        pulp::Arch::new().dispatch(Run { group: self, law })
    }
}

/// The run itself, compiled for every vector unit that the machine may have.
struct Run<'a, L, const N: usize> {
    group: Group<'a, N>,
    law: L,
}

impl<L: Law<Wide, N> + Copy, const N: usize> NullaryFnOnce for Run<'_, L, N> {
    type Output = Result<[Tally<Wide>; 2], SimError>;

    #[inline(always)]
    fn call(self) -> Self::Output {
        let Group { trajectory, pole, bases, comparison } = self.group;
        follow(trajectory, pole, self.law, bases, comparison, |_, _| {})
    }
}
