//! Free runs of several robots side by side.

use std::array::from_fn;

use pulp::NullaryFnOnce;
use rayon::prelude::*;
use robot_model::{Lanes, Plant, Robot, Scalar, State};

use super::{OutputError, Recorded};

/// Robots that are run side by side: two vectors of eight overlap each other's roots and divisions.
pub(super) const WIDTH: usize = 16;

/// What a run gives for a row: position, cosine and sine of the yaw angle, yaw rate, wheel speeds.
pub(super) type Shown = [f64; 7];

/// A robot on its way through a recording.
#[derive(Clone, Copy)]
pub(super) struct Run<'a> {
    pub(super) robot: &'a Robot<f64>,
    pub(super) recording: &'a Recorded,
}

impl Run<'_> {
    /// Steps in a period.
    fn substeps(&self, step: f64) -> usize {
        (self.recording.period / step).ceil().max(1.0) as usize
    }

    /// Steps by which the drive's delay shifts the command; it is rounded to whole ones.
    fn late(&self, substeps: usize) -> usize {
        let h = self.recording.period / substeps as f64;
        (self.robot.drive.delay / h).round().max(0.0) as usize
    }

    /// The command that reaches the drive in step `k`.
    #[inline(always)]
    fn command(&self, k: usize, late: usize, substeps: usize) -> [f64; 2] {
        let torque = &self.recording.torque;
        // Runs that end sooner go on under their last torque; nobody looks at that.
        torque[(k.saturating_sub(late) / substeps).min(torque.len() - 1)]
    }
}

impl OutputError<'_> {
    /// Runs robots, several side by side; the result has the order of the runs.
    pub(super) fn run(&self, runs: &[Run<'_>]) -> Vec<Vec<Shown>> {
        let step = self.step * (1.0 + 1e-9);
        let groups: Vec<&[Run<'_>]> =
            runs.chunk_by(|a, b| a.substeps(step) == b.substeps(step)).flat_map(|alike| alike.chunks(WIDTH)).collect();
        groups.into_par_iter().flat_map_iter(|group| side_by_side::<WIDTH>(group, group[0].substeps(step))).collect()
    }

    /// Runs one robot through all recordings, by itself.
    pub(super) fn run_alone(&self, robot: &Robot<f64>) -> Vec<Vec<Shown>> {
        let step = self.step * (1.0 + 1e-9);
        let runs: Vec<Run<'_>> = self.recordings.iter().map(|recording| Run { robot, recording }).collect();
        runs.iter().flat_map(|run| side_by_side::<1>(std::slice::from_ref(run), run.substeps(step))).collect()
    }
}

/// Runs up to `N` robots; the last one fills what is left over.
fn side_by_side<const N: usize>(group: &[Run<'_>], substeps: usize) -> Vec<Vec<Shown>> {
    let runs: [Run<'_>; N] = from_fn(|i| group[i.min(group.len() - 1)]);
    let robot = Robot::assemble(|constant| Lanes(runs.map(|run| constant(run.robot))));
    let plant = Plant::new(&robot, &[], Lanes(runs.map(|run| run.recording.period / substeps as f64)));
    let mut shown: Vec<Vec<Shown>> = group.iter().map(|run| Vec::with_capacity(run.recording.torque.len())).collect();
    pulp::Arch::new().dispatch(Drive { plant: &plant, runs: &runs, substeps, shown: &mut shown });
    shown
}

/// The run itself, compiled for every vector unit that the machine may have.
struct Drive<'a, 'b, const N: usize> {
    plant: &'a Plant<'b, Lanes<N>>,
    runs: &'a [Run<'a>; N],
    substeps: usize,
    shown: &'a mut [Vec<Shown>],
}

impl<const N: usize> Drive<'_, '_, N> {
    fn start(&self) -> State<Lanes<N>> {
        let of = |read: &dyn Fn(&State<f64>) -> f64| Lanes(self.runs.map(|run| read(&run.recording.start)));
        let two = |read: fn(&State<f64>) -> [f64; 2]| [of(&|s| read(s)[0]), of(&|s| read(s)[1])];
        let three = |read: fn(&State<f64>) -> [f64; 3]| [0, 1, 2].map(|i| of(&|s| read(s)[i]));
        State {
            time: of(&|s| s.time),
            position: two(|s| s.position),
            heading: two(|s| s.heading),
            velocity: two(|s| s.velocity),
            yaw_rate: of(&|s| s.yaw_rate),
            wheel_speed: two(|s| s.wheel_speed),
            front_speed: two(|s| s.front_speed),
            wheel_angle: two(|s| s.wheel_angle),
            torque: two(|s| s.torque),
            lagged: two(|s| s.lagged),
            specific: two(|s| s.specific),
            rate: three(|s| s.rate),
            needed: two(|s| s.needed),
        }
    }
}

impl<const N: usize> NullaryFnOnce for Drive<'_, '_, N> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let mut s = self.start();
        let late = self.runs.map(|run| run.late(self.substeps));
        let rows = self.runs.map(|run| run.recording.torque.len());
        let mut torque = [Lanes::<N>::zero(); 2];
        for row in 0..rows.into_iter().max().unwrap_or(0) {
            for k in 0..self.substeps {
                // Without a delay a command holds for the whole period.
                if k == 0 || late != [0; N] {
                    for i in 0..N {
                        let [left, right] = self.runs[i].command(row * self.substeps + k, late[i], self.substeps);
                        torque[0].0[i] = left;
                        torque[1].0[i] = right;
                    }
                }
                self.plant.step_drive(&mut s, torque);
                let delivered = self.plant.delivered(&s);
                self.plant.step_under(&mut s, delivered);
            }
            for (i, shown) in self.shown.iter_mut().enumerate().filter(|(i, _)| row < rows[*i]) {
                let [x, y, c, n] = [s.position[0], s.position[1], s.heading[0], s.heading[1]];
                shown.push([x, y, c, n, s.yaw_rate, s.wheel_speed[0], s.wheel_speed[1]].map(|v| v.0[i]));
            }
        }
    }
}
