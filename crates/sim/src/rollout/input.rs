//! What moves a robot in each step of a rollout.

use robot_model::{Plant, Scalar, State};

use super::Grid;

/// What moves a robot in each step.
pub trait Input<T: Scalar> {
    /// Before the steps of a row, after the visitor has seen it: where feedback looks at the state and sets its command.
    #[inline(always)]
    fn begin(&mut self, _row: usize, _plant: &Plant<'_, T>, _s: &State<T>) {}

    /// Moves the state by step `step` of row `row`.
    fn advance(&mut self, row: usize, step: usize, plant: &Plant<'_, T>, s: &mut State<T>);
}

/// Torque commands of each side, N m, by row and step: through the drive to the wheels.
pub struct Commanded<F>(pub F);

/// Torques that the drives have delivered already, N m, by row and step: straight to the wheels.
pub struct Delivered<F>(pub F);

/// Torque commands of each side, N m, by row and step: the drive follows them and nothing else moves.
pub struct DriveAlone<F>(pub F);

/// Wheel speeds of each side, rad/s, and their rates, rad/s², by row and step: a speed-driven robot.
pub struct AtSpeed<F>(pub F);

impl<T: Scalar, F: FnMut(usize, usize) -> [T; 2]> Input<T> for Commanded<F> {
    #[inline(always)]
    fn advance(&mut self, row: usize, step: usize, plant: &Plant<'_, T>, s: &mut State<T>) {
        plant.step_drive(s, (self.0)(row, step));
        plant.step_under(s, plant.delivered(s));
    }
}

impl<T: Scalar, F: FnMut(usize, usize) -> [T; 2]> Input<T> for Delivered<F> {
    #[inline(always)]
    fn advance(&mut self, row: usize, step: usize, plant: &Plant<'_, T>, s: &mut State<T>) {
        plant.step_under(s, (self.0)(row, step));
    }
}

impl<T: Scalar, F: FnMut(usize, usize) -> [T; 2]> Input<T> for DriveAlone<F> {
    #[inline(always)]
    fn advance(&mut self, row: usize, step: usize, plant: &Plant<'_, T>, s: &mut State<T>) {
        plant.step_drive(s, (self.0)(row, step));
    }
}

impl<T: Scalar, F: FnMut(usize, usize) -> ([T; 2], [T; 2])> Input<T> for AtSpeed<F> {
    #[inline(always)]
    fn advance(&mut self, row: usize, step: usize, plant: &Plant<'_, T>, s: &mut State<T>) {
        let (speed, rate) = (self.0)(row, step);
        plant.step_at_speed(s, speed, rate);
    }
}

/// One after the other in each step: a drive alone beside a body that goes at measured speeds.
impl<T: Scalar, A: Input<T>, B: Input<T>> Input<T> for (A, B) {
    #[inline(always)]
    fn begin(&mut self, row: usize, plant: &Plant<'_, T>, s: &State<T>) {
        self.0.begin(row, plant, s);
        self.1.begin(row, plant, s);
    }

    #[inline(always)]
    fn advance(&mut self, row: usize, step: usize, plant: &Plant<'_, T>, s: &mut State<T>) {
        self.0.advance(row, step, plant, s);
        self.1.advance(row, step, plant, s);
    }
}

/// Wheel speeds that change linearly from one row to the next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ramp {
    from: [f64; 2],
    rate: [f64; 2],
    span: f64,
    substeps: usize,
}

impl Ramp {
    /// Between two speeds of each side, rad/s, over a row that is divided as `grid` says.
    pub fn new([from, to]: [[f64; 2]; 2], grid: Grid) -> Self {
        let rate = [0, 1].map(|j| (to[j] - from[j]) / grid.period);
        Self { from, rate, span: grid.period, substeps: grid.substeps }
    }

    /// Speed of each side at the end of a step, rad/s, and its rate, rad/s².
    pub fn at(&self, step: usize) -> ([f64; 2], [f64; 2]) {
        let share = (step + 1) as f64 / self.substeps as f64;
        ([0, 1].map(|j| self.from[j] + share * self.span * self.rate[j]), self.rate)
    }
}
