//! States from which a robot runs freely.

use std::convert::Infallible;
use std::iter::Peekable;

use robot_model::{Plant, State};

use super::Visitor;

/// The motion of a robot at an instant, as sensors show it.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Start {
    /// Wheel speed of each side, rad/s.
    pub wheel_speed: [f64; 2],
    /// Wheel angle of each side, rad.
    pub wheel_angle: [f64; 2],
    /// Yaw rate, rad/s.
    pub yaw_rate: f64,
    /// Velocity of the geometric centre in body axes, m/s.
    pub velocity: [f64; 2],
    /// Geometric centre on the ground, m.
    pub position: [f64; 2],
    /// Yaw angle, rad.
    pub yaw: f64,
}

impl Start {
    /// Sets a state; its time, and what the drives have in store, go on.
    pub fn set(&self, plant: &Plant<'_, f64>, s: &mut State<f64>) {
        *s = State { time: s.time, torque: s.torque, lagged: s.lagged, ..self.state() };
        plant.set_velocity(s, self.velocity);
    }

    /// As a state at time zero with drives at rest; the velocity is still that of the geometric centre.
    pub(super) fn state(&self) -> State<f64> {
        let (sin, cos) = self.yaw.sin_cos();
        State {
            position: self.position,
            heading: [cos, sin],
            velocity: self.velocity,
            yaw_rate: self.yaw_rate,
            wheel_speed: self.wheel_speed,
            passive: self.wheel_speed,
            wheel_angle: self.wheel_angle,
            ..State::default()
        }
    }
}

/// A visitor that sets the robot to known states at some rows, and its time to that of the row.
pub struct Restarts<I: Iterator<Item = (usize, Start)>> {
    next: Peekable<I>,
    period: f64,
}

impl<I: Iterator<Item = (usize, Start)>> Restarts<I> {
    /// States by row in ascending order (of several at one row the first counts); `period` between rows, s.
    pub fn new(starts: impl IntoIterator<IntoIter = I>, period: f64) -> Self {
        Self { next: starts.into_iter().peekable(), period }
    }
}

impl<I: Iterator<Item = (usize, Start)>> Visitor<f64> for Restarts<I> {
    type Stop = Infallible;

    fn begin(&mut self, row: usize, plant: &Plant<'_, f64>, s: &mut State<f64>) -> Result<(), Infallible> {
        while self.next.next_if(|(at, _)| *at < row).is_some() {}
        if let Some((_, start)) = self.next.next_if(|(at, _)| *at == row) {
            s.time = row as f64 * self.period;
            start.set(plant, s);
        }
        Ok(())
    }
}
