//! Free runs of several robots side by side.

use std::array::from_fn;
use std::convert::Infallible;

use rayon::prelude::*;
use robot_model::{Lanes, Plant, Robot, State};
use sim::rollout::{Grid, Rollout, Visitor, lanes};

use super::{OutputError, Recorded};

/// Robots that are run side by side: two vectors of eight overlap each other's roots and divisions.
pub(super) const WIDTH: usize = 16;

/// What a run gives for a row: position, cosine and sine of the yaw angle, yaw rate, wheel speeds.
pub(super) type Observed = [f64; 7];

/// A robot on its way through a recording.
#[derive(Clone, Copy)]
pub(super) struct Run<'a> {
    pub(super) robot: &'a Robot<f64>,
    pub(super) recording: &'a Recorded,
}

impl Run<'_> {
    /// Steps in a period.
    fn substeps(&self, step: f64) -> usize {
        Grid::at_most(self.recording.period, step).substeps
    }

    /// Length of each of them, s.
    fn step(&self, substeps: usize) -> f64 {
        Grid { period: self.recording.period, substeps }.step()
    }

    /// Steps by which the drive's delay shifts the command; it is rounded to whole ones.
    fn late(&self, substeps: usize) -> usize {
        (self.robot.drive.delay / self.step(substeps)).round().max(0.0) as usize
    }
}

impl OutputError<'_> {
    /// Runs robots, several side by side; the result has the order of the runs.
    pub(super) fn run(&self, runs: &[Run<'_>]) -> Vec<Vec<Observed>> {
        let step = self.step * (1.0 + 1e-9);
        let groups: Vec<&[Run<'_>]> =
            runs.chunk_by(|a, b| a.substeps(step) == b.substeps(step)).flat_map(|alike| alike.chunks(WIDTH)).collect();
        groups.into_par_iter().flat_map_iter(|group| side_by_side::<WIDTH>(group, group[0].substeps(step))).collect()
    }

    /// Runs one robot through all recordings, by itself.
    pub(super) fn run_alone(&self, robot: &Robot<f64>) -> Vec<Vec<Observed>> {
        let step = self.step * (1.0 + 1e-9);
        let runs: Vec<Run<'_>> = self.recordings.iter().map(|recording| Run { robot, recording }).collect();
        runs.iter().flat_map(|run| side_by_side::<1>(std::slice::from_ref(run), run.substeps(step))).collect()
    }
}

/// Runs up to `N` robots; the last one fills what is left over.
fn side_by_side<const N: usize>(group: &[Run<'_>], substeps: usize) -> Vec<Vec<Observed>> {
    let runs: [Run<'_>; N] = from_fn(|i| group[i.min(group.len() - 1)]);
    let robot = lanes::robots(runs.map(|run| run.robot));
    let plant = Plant::new(&robot, &[], Lanes(runs.map(|run| run.step(substeps))));

    // Runs that end sooner go on under their last torque; nobody looks at that.
    let torque = runs.map(|run| run.recording.torque.as_slice());
    let rows = torque.map(<[_]>::len);
    let mut state = lanes::states(runs.map(|run| &run.recording.start));
    let mut rows_shown =
        RowsShown { rows, shown: group.iter().zip(rows).map(|(_, n)| Vec::with_capacity(n)).collect() };
    let Ok(()) = Rollout::new(&plant, rows.into_iter().max().unwrap_or(0), substeps).run_vectorised(
        &mut state,
        &mut lanes::Held::new(torque, runs.map(|run| run.late(substeps)), substeps),
        &mut rows_shown,
    );
    rows_shown.shown
}

/// Keeps what each run shows at the end of its rows.
struct RowsShown<const N: usize> {
    rows: [usize; N],
    shown: Vec<Vec<Observed>>,
}

impl<const N: usize> Visitor<Lanes<N>> for RowsShown<N> {
    type Stop = Infallible;

    #[inline(always)]
    fn end(&mut self, row: usize, _: &Plant<'_, Lanes<N>>, s: &State<Lanes<N>>) {
        for (i, shown) in self.shown.iter_mut().enumerate().filter(|(i, _)| row < self.rows[*i]) {
            let [x, y, c, n] = [s.position[0], s.position[1], s.heading[0], s.heading[1]];
            shown.push([x, y, c, n, s.yaw_rate, s.wheel_speed[0], s.wheel_speed[1]].map(|v| v.0[i]));
        }
    }
}
