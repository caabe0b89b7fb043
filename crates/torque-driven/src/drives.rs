//! Torque that the drives deliver, remembered: most lanes of a search differ in other things than the drive.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex};

use robot_model::robot::Drive;
use robot_model::{Active, Plant, Robot, State};
use sim::rollout::{DriveAlone, Grid, Hold, Rollout, each_step};

use crate::settings::fit::SETTINGS;
use crate::windows::Cut;
use inference::hypothesis::Dose;

/// Torque of each side in every step of a recording, N m.
pub(crate) type Torques = Arc<Vec<[f64; 2]>>;

/// What one set of recordings asked for last.
#[derive(Default)]
pub(crate) struct Drives {
    recent: Mutex<VecDeque<(usize, Drive<f64>, Torques)>>,
}

impl Clone for Drives {
    /// Another set of recordings remembers for itself.
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl Drives {
    /// Torque delivered in recording `run`, up to the end of its last segment.
    pub(crate) fn delivered(&self, run: usize, cut: &Cut, robot: &Robot<f64>, doses: &[Dose], grid: Grid) -> Torques {
        let active: Vec<Active<f64>> = doses.iter().map(Dose::active).collect();
        let plant = Plant::new(robot, &active, grid.step());
        let drive = *plant.drive();
        // A poisoned lock holds whole entries all the same: they are only ever pushed and popped.
        let lock = || self.recent.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        if let Some(known) = lock().iter().find(|(r, d, _)| (*r, *d) == (run, drive)) {
            return Arc::clone(&known.2);
        }
        let fresh = Arc::new(simulated(cut, &plant, grid));
        let mut recent = lock();
        recent.push_front((run, drive, Arc::clone(&fresh)));
        recent.truncate(SETTINGS.simulation.remembered);
        fresh
    }
}

fn simulated(cut: &Cut, plant: &Plant<'_, f64>, grid: Grid) -> Vec<[f64; 2]> {
    let hold = Hold::new(grid, plant.drive().delay);
    let rows = cut.segments.last().map_or(0, |s| s.row + s.windows * cut.rows_per_window);
    let mut out = Vec::with_capacity(rows * grid.substeps);
    let Ok(()) = Rollout::new(plant, rows, grid.substeps).run(
        &mut State::default(),
        &mut DriveAlone(|row, step| hold.command(&cut.torque, row, step)),
        &mut each_step(|_, _, plant, s| out.push(plant.delivered(s))),
    );
    out
}
