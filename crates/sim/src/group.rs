//! Several draws of identifiers side by side, by the scheme and the number of neurons of the paper.
//!
//! Each scheme and number would be compiled for three vector units. The others are rows of a table of variations, which take
//! less time one by one than to compile.

use identifier::Midpoint;
use nn_basis::{Lanes, SigmoidLayer};
use pulp::NullaryFnOnce;

use crate::identification::follow;
use crate::network_recipe::SIGNALS;
use crate::tally::Tally;
use crate::{Draw, Purpose, Recipe, SimError, Stream, Trajectory, UNITS, comparison};

/// Draws that run side by side.
pub(crate) const WIDTH: usize = 8;
type Wide = Lanes<WIDTH>;

/// Runs the identifiers of up to [`WIDTH`] draws by the midpoint rule; the last one fills what is left over.
pub(crate) fn identify(
    recipe: &Recipe,
    trajectory: &Trajectory,
    seed: u64,
    numbers: &[u64],
) -> Result<Vec<Draw>, SimError> {
    let Some(last) = numbers.last() else { return Ok(Vec::new()) };
    let mut layers = [Vec::new(), Vec::new()];
    let mut weights = [[Lanes([0.0; WIDTH]); UNITS]; 2];
    for lane in 0..WIDTH {
        let number = *numbers.get(lane).unwrap_or(last);
        let mut stream = Stream::new(seed, Purpose::IdentifierLayer, number);
        let drawn = recipe.identifier.network.layers::<UNITS>(trajectory, &mut stream)?;
        let compared = comparison::<UNITS>(seed, number);
        for i in 0..2 {
            layers[i].push(drawn[i]);
            for j in 0..UNITS {
                weights[i][j].0[lane] = compared[i][j];
            }
        }
    }
    let [left, right] = layers.map(|list| list.try_into().ok().and_then(|all| SigmoidLayer::side_by_side(&all)));
    let (Some(left), Some(right)) = (left, right) else {
        return Err(SimError::Recipe("the layers of the draws differ in their activation".into()));
    };
    let law = Midpoint::new(Lanes([recipe.identifier.gain; WIDTH]))?;
    let run = Run { trajectory, pole: recipe.identifier.pole, law, bases: &[left, right], comparison: &weights };
    let tallies = pulp::Arch::new().dispatch(run)?;
    let [left, right] = tallies.map(|t| t.apart());
    let samples = trajectory.torques.len();
    let draws = numbers.iter().zip(left.into_iter().zip(right));
    Ok(draws.map(|(n, (l, r))| Draw { number: *n, output: [l.close(samples), r.close(samples)] }).collect())
}

/// What the identifiers of a group follow, and by what; compiled for every vector unit that the machine may have.
struct Run<'a> {
    trajectory: &'a Trajectory,
    pole: f64,
    law: Midpoint<Wide>,
    bases: &'a [SigmoidLayer<Wide, SIGNALS, UNITS>; 2],
    comparison: &'a [[Wide; UNITS]; 2],
}

impl NullaryFnOnce for Run<'_> {
    type Output = Result<[Tally<Wide>; 2], SimError>;

    #[inline(always)]
    fn call(self) -> Self::Output {
        let Run { trajectory, pole, law, bases, comparison } = self;
        follow(trajectory, pole, law, bases, comparison, |_, _| {})
    }
}
