//! Who watches a rollout.

use std::convert::Infallible;

use robot_model::{Plant, Scalar, State};

/// Who watches a rollout; each method does nothing unless it is written.
pub trait Visitor<T: Scalar> {
    /// With what it may stop a rollout: [`Infallible`] when it never does.
    type Stop;

    /// Before the steps of a row; the state may be set anew.
    ///
    /// # Errors
    /// To stop the rollout here.
    #[inline(always)]
    fn begin(&mut self, _row: usize, _plant: &Plant<'_, T>, _s: &mut State<T>) -> Result<(), Self::Stop> {
        Ok(())
    }

    /// After step `step` of row `row`.
    #[inline(always)]
    fn step(&mut self, _row: usize, _step: usize, _plant: &Plant<'_, T>, _s: &State<T>) {}

    /// After the last step of a row.
    #[inline(always)]
    fn end(&mut self, _row: usize, _plant: &Plant<'_, T>, _s: &State<T>) {}
}

/// Nobody.
impl<T: Scalar> Visitor<T> for () {
    type Stop = Infallible;
}

/// One after the other.
impl<T: Scalar, A: Visitor<T>, B: Visitor<T, Stop = A::Stop>> Visitor<T> for (A, B) {
    type Stop = A::Stop;

    #[inline(always)]
    fn begin(&mut self, row: usize, plant: &Plant<'_, T>, s: &mut State<T>) -> Result<(), Self::Stop> {
        self.0.begin(row, plant, s)?;
        self.1.begin(row, plant, s)
    }

    #[inline(always)]
    fn step(&mut self, row: usize, step: usize, plant: &Plant<'_, T>, s: &State<T>) {
        self.0.step(row, step, plant, s);
        self.1.step(row, step, plant, s);
    }

    #[inline(always)]
    fn end(&mut self, row: usize, plant: &Plant<'_, T>, s: &State<T>) {
        self.0.end(row, plant, s);
        self.1.end(row, plant, s);
    }
}

/// A function that is called before the steps of each row; see [`each_row`].
pub struct EachRow<F>(F);

/// Calls `f(row, plant, state)` before the steps of each row.
pub fn each_row<T: Scalar, F: FnMut(usize, &Plant<'_, T>, &State<T>)>(f: F) -> EachRow<F> {
    EachRow(f)
}

impl<T: Scalar, F: FnMut(usize, &Plant<'_, T>, &State<T>)> Visitor<T> for EachRow<F> {
    type Stop = Infallible;

    #[inline(always)]
    fn begin(&mut self, row: usize, plant: &Plant<'_, T>, s: &mut State<T>) -> Result<(), Infallible> {
        (self.0)(row, plant, s);
        Ok(())
    }
}

/// A function that is called after each step; see [`each_step`].
pub struct EachStep<F>(F);

/// Calls `f(row, step, plant, state)` after each step.
pub fn each_step<T: Scalar, F: FnMut(usize, usize, &Plant<'_, T>, &State<T>)>(f: F) -> EachStep<F> {
    EachStep(f)
}

impl<T: Scalar, F: FnMut(usize, usize, &Plant<'_, T>, &State<T>)> Visitor<T> for EachStep<F> {
    type Stop = Infallible;

    #[inline(always)]
    fn step(&mut self, row: usize, step: usize, plant: &Plant<'_, T>, s: &State<T>) {
        (self.0)(row, step, plant, s);
    }
}
