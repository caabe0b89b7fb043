//! Levels of segments against the references': one probability per signal or cell, false discoveries held down.

use statrs::distribution::{ContinuousCDF, StudentsT};

use crate::locate::null::Null;
use crate::settings::locate::{Levels, SETTINGS};

const LEVELS: Levels = SETTINGS.levels;

/// A segment's mean energy in a cell.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Block {
    pub(crate) run: usize,
    pub(crate) windows: usize,
    pub(crate) energy: f64,
}

impl Block {
    pub(crate) fn level(&self) -> f64 {
        level(self.energy)
    }
}

pub(crate) fn level(energy: f64) -> f64 {
    if energy.is_finite() { energy.max(1e-12).ln().max(LEVELS.floor) } else { f64::NAN }
}

/// Fault-free levels of blocks, by run.
pub(crate) fn null_of<'a>(blocks: impl Iterator<Item = &'a Block>) -> Option<Null> {
    let mut runs: Vec<Vec<f64>> = Vec::new();
    for b in blocks {
        if runs.len() <= b.run {
            runs.resize(b.run + 1, Vec::new());
        }
        runs[b.run].push(b.level());
    }
    Null::new(&runs, LEVELS.between, LEVELS.least_within)
}

/// Probability that fault-free driving shows a mean level of `blocks` as high as this; 1 without blocks.
///
/// Segments are the blocks, windows are not counted; `own` are the references' blocks in the same cell.
pub(crate) fn probability(blocks: &[Block], own: &[Block], null: &Null) -> f64 {
    let n = blocks.len() as f64;
    if blocks.is_empty() {
        return 1.0;
    }
    let mean = blocks.iter().map(Block::level).sum::<f64>() / n;
    let m = own.len() as f64 + LEVELS.pseudo_blocks;
    let fault_free = (own.iter().map(Block::level).sum::<f64>() + LEVELS.pseudo_blocks * null.mean) / m;
    let most = blocks.iter().map(|b| b.run).max().unwrap_or(0);
    let runs: f64 = (0..=most).map(|r| (blocks.iter().filter(|b| b.run == r).count() as f64 / n).powi(2)).sum();
    let within = null.within.powi(2) * (1.0 / n + 1.0 / m.min(null.values));
    let between = null.between.powi(2) * (runs + 1.0 / null.runs);
    let total = within + between;
    let freedom = total * total / (within * within / (null.values - null.runs) + between * between / null.freedom());
    StudentsT::new(0.0, 1.0, freedom.max(1.0)).map_or(1.0, |t| t.sf((mean - fault_free) / total.sqrt()))
}

#[cfg(test)]
mod tests {
    use inference::robust::discoveries;

    use super::*;
    use crate::locate::change::Draws;

    #[test]
    fn fault_free_cells_are_reported_in_at_most_one_of_twenty_cases() {
        let mut draws = Draws::new(11);
        let mut run = |raised: f64| -> Vec<Vec<Block>> {
            let mut cells = vec![Vec::new(); 12];
            for r in 0..3 {
                let own = 0.3 * draws.normal();
                for k in 0..36 {
                    let energy = (own + 0.8 * draws.normal() + if k % 12 == 0 { raised } else { 0.0 }).exp();
                    cells[k % 12].push(Block { run: r, windows: 20, energy });
                }
            }
            cells
        };
        let (mut alarms, mut hits) = (0, 0);
        for _ in 0..200 {
            let (references, fault_free, ill) = (run(0.0), run(0.0), run(4.0));
            let null = null_of(references.iter().flatten()).expect("blocks");
            let found = |cells: &[Vec<Block>]| {
                let p: Vec<f64> = cells.iter().zip(&references).map(|(c, r)| probability(c, r, &null)).collect();
                discoveries(&p, LEVELS.discoveries)
            };
            alarms += i32::from(found(&fault_free).contains(&true));
            hits += i32::from(found(&ill)[0]);
        }
        assert!(alarms <= 10, "{alarms} of 200");
        assert!(hits >= 180, "{hits} of 200");
    }
}
