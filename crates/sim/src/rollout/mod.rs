//! The one loop over a plant: a robot that is driven by held torques or by wheel speeds, from a start state on.
//!
//! A [`Rollout`] runs a [`Plant`] over rows of equal steps. What happens in it is said by two parts:
//! * an [`Input`] moves the robot in each step: [`Commanded`], [`Delivered`], [`DriveAlone`], [`AtSpeed`], two of them one
//!   after the other as a pair, or a type of its own that looks at the state and sets the next row's command (feedback);
//! * a [`Visitor`] watches: [`each_row`], [`each_step`], [`Restarts`], a pair of visitors, `()`, or a type of its own.
//!   It may change the state before a row, and it may stop the rollout with an error.
//!
//! The loop is generic over the scalar: one robot in f64, or several side by side in [`Lanes`](robot_model::Lanes), each
//! with the bits that it has alone. Lanes are put together by [`lanes`] and run by [`Rollout::run_vectorised`].
//! Effects act as the plant holds them: always, from an instant on, at one place or on one side.
//!
//! ```
//! use robot_model::paper::Parameters;
//! use robot_model::{Plant, Robot, State};
//! use sim::rollout::{Commanded, Grid, Hold, Rollout, each_row};
//!
//! let robot = Robot::<f64>::from(&Parameters::SET_B);
//! let torque = vec![[2.0, 2.2]; 100]; // N m of each side, a row every 10 ms
//! let grid = Grid::nearest(0.01, 1e-3);
//!
//! let plant = Plant::new(&robot, &[], grid.step());
//! let hold = Hold::new(grid, plant.drive().delay);
//! let mut yaw_rate = Vec::new();
//! let Ok(()) = Rollout::new(&plant, torque.len(), grid.substeps).run(
//!     &mut State::default(),
//!     &mut Commanded(|row, step| hold.command(&torque, row, step)),
//!     &mut each_row(|_, _, s| yaw_rate.push(s.yaw_rate)),
//! );
//! assert!(yaw_rate[0] == 0.0 && yaw_rate[99] > 0.0);
//! ```

mod grid;
mod hold;
mod input;
pub mod lanes;
mod start;
#[cfg(test)]
mod tests;
mod visitor;

use pulp::NullaryFnOnce;
use robot_model::{Plant, Scalar, State};

pub use grid::Grid;
pub use hold::Hold;
pub use input::{AtSpeed, Commanded, Delivered, DriveAlone, Input, Ramp};
pub use start::{Restarts, Start};
pub use visitor::{EachRow, EachStep, Visitor, each_row, each_step};

/// A plant over rows of equal steps.
///
/// A row is what an input or a visitor counts in: the time between two samples, or a window of several.
#[derive(Clone, Copy)]
pub struct Rollout<'p, 'e, T: Scalar> {
    plant: &'p Plant<'e, T>,
    rows: usize,
    substeps: usize,
}

impl<'p, 'e, T: Scalar> Rollout<'p, 'e, T> {
    /// `rows` rows of `substeps` steps each; how long a step is, the plant knows.
    pub fn new(plant: &'p Plant<'e, T>, rows: usize, substeps: usize) -> Self {
        Self { plant, rows, substeps }
    }

    /// Runs from `state`, which is left as it is at the end.
    ///
    /// # Errors
    /// What the visitor stops with; the state is then that of the row it stopped at.
    #[inline(always)]
    pub fn run<I: Input<T>, V: Visitor<T>>(
        &self,
        state: &mut State<T>,
        input: &mut I,
        visitor: &mut V,
    ) -> Result<(), V::Stop> {
        for row in 0..self.rows {
            visitor.begin(row, self.plant, state)?;
            input.begin(row, self.plant, state);

            for step in 0..self.substeps {
                input.advance(row, step, self.plant, state);
                visitor.step(row, step, self.plant, state);
            }

            visitor.end(row, self.plant, state);
        }
        Ok(())
    }

    /// The same, compiled for every vector unit that the machine may have: for robots side by side.
    ///
    /// Inputs and visitors gain from it only where their methods are `#[inline(always)]`.
    ///
    /// # Errors
    /// What the visitor stops with.
    pub fn run_vectorised<I: Input<T>, V: Visitor<T>>(
        &self,
        state: &mut State<T>,
        input: &mut I,
        visitor: &mut V,
    ) -> Result<(), V::Stop> {
        pulp::Arch::new().dispatch(Vectorised { rollout: *self, state, input, visitor })
    }
}

/// A rollout that [`pulp`] compiles once for each vector unit.
struct Vectorised<'a, 'p, 'e, T: Scalar, I, V> {
    rollout: Rollout<'p, 'e, T>,
    state: &'a mut State<T>,
    input: &'a mut I,
    visitor: &'a mut V,
}

impl<T: Scalar, I: Input<T>, V: Visitor<T>> NullaryFnOnce for Vectorised<'_, '_, '_, T, I, V> {
    type Output = Result<(), V::Stop>;

    #[inline(always)]
    fn call(self) -> Self::Output {
        // A copy of its own, which no reference from outside keeps out of the registers.
        let mut state = *self.state;
        let done = self.rollout.run(&mut state, self.input, self.visitor);
        *self.state = state;
        done
    }
}
