//! Windows of 2 s, and the command steps that are the independent blocks.

use crate::run::{Piece, ResponseRun, STEP, WINDOW};
use crate::settings::SETTINGS;

/// Folds in which windows are left out of a fit.
pub(crate) const FOLDS: usize = SETTINGS.windows.folds;

/// A window of one piece.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Window {
    pub(crate) piece: usize,
    /// Recording that the piece is of.
    pub(crate) run: usize,
    /// First row in the piece.
    pub(crate) start: usize,
    /// Command step that it belongs to: windows of one step are not independent.
    pub(crate) block: usize,
    /// Fold in which it is left out: neighbouring blocks share one.
    pub(crate) fold: usize,
}

/// All pieces with their windows.
#[derive(Debug, Clone)]
pub(crate) struct Windows {
    pub(crate) pieces: Vec<Piece>,
    pub(crate) list: Vec<Window>,
    pub(crate) blocks: usize,
}

impl Windows {
    pub(crate) fn new(runs: &[ResponseRun]) -> Self {
        let pieces: Vec<Piece> = runs.iter().flat_map(|r| r.pieces.iter().cloned()).collect();
        let run_of: Vec<usize> =
            runs.iter().enumerate().flat_map(|(run, r)| std::iter::repeat_n(run, r.pieces.len())).collect();
        let mut list = Vec::new();
        let mut blocks = 0;
        for (piece, p) in pieces.iter().enumerate() {
            for k in 0..p.windows() {
                let start = k * WINDOW;
                let rows = start.saturating_sub(1)..start + WINDOW;
                let changes = p.command[rows].windows(2).any(|c| c[0] != c[1]);
                if k == 0 || changes {
                    blocks += 1;
                }
                list.push(Window { piece, run: run_of[piece], start, block: blocks - 1, fold: 0 });
            }
        }
        for w in &mut list {
            w.fold = w.block * FOLDS / blocks;
        }
        Self { pieces, list, blocks }
    }

    /// Some of the windows, each in the fold that it is in here.
    pub(crate) fn only(&self, kept: impl Fn(usize) -> bool) -> Self {
        let mut list: Vec<Window> = Vec::new();
        let (mut blocks, mut last) = (0, None);
        for (_, window) in self.list.iter().enumerate().filter(|(w, _)| kept(*w)) {
            blocks += usize::from(last != Some(window.block));
            last = Some(window.block);
            list.push(Window { block: blocks - 1, ..*window });
        }
        Self { pieces: self.pieces.clone(), list, blocks }
    }

    /// Fold of a window.
    pub(crate) fn fold(&self, window: usize) -> usize {
        self.list[window].fold
    }

    /// When a window begins, s after the first row of its recording.
    pub(crate) fn time(&self, window: usize) -> f64 {
        let w = &self.list[window];
        self.pieces[w.piece].start + w.start as f64 * STEP
    }

    /// When the recording of a window ends, s after its first row.
    pub(crate) fn end(&self, window: usize) -> f64 {
        let run = self.list[window].run;
        let last = self.list.iter().filter(|w| w.run == run).map(|w| &self.pieces[w.piece]).next_back();
        last.map_or(0.0, |p| p.start + p.wheel.len() as f64 * STEP)
    }

    /// Root mean square of the measured wheel speeds, rad/s.
    pub(crate) fn speed(&self) -> f64 {
        let all = || self.pieces.iter().flat_map(|p| p.wheel.iter().flatten());
        (all().map(|w| w * w).sum::<f64>() / all().count().max(1) as f64).sqrt()
    }

    /// Means over the windows of each block.
    pub(crate) fn by_block(&self, of_window: impl Fn(usize) -> f64) -> Vec<f64> {
        let mut sums = vec![(0.0, 0.0); self.blocks];
        for (i, w) in self.list.iter().enumerate() {
            sums[w.block].0 += of_window(i);
            sums[w.block].1 += 1.0;
        }
        sums.into_iter().map(|(s, n)| s / n).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn windows_of_one_command_share_a_block_and_a_fold() {
        let command: Vec<[f64; 2]> = (0..400).map(|i| [f64::from(i / 120); 2]).collect();
        let piece = Piece {
            start: 0.0,
            wheel: command.clone(),
            command,
            within: None,
            heading: None,
            integrated: false,
            position: None,
        };
        let run = ResponseRun { name: "r".to_owned(), pieces: vec![piece.clone(), piece], gyro_share: None, hold: 0.0 };
        let w = Windows::new(&[run]);
        let blocks: Vec<usize> = w.list.iter().map(|w| w.block).collect();
        assert_eq!(blocks[..10], [0, 0, 0, 1, 1, 1, 2, 2, 2, 3]);
        assert_eq!((w.blocks, blocks[10]), (8, 4));
        assert_eq!((w.fold(0), w.fold(19)), (0, FOLDS - 1));
        assert!(
            w.list.iter().enumerate().all(|(i, x)| w
                .list
                .iter()
                .enumerate()
                .all(|(j, y)| { x.block != y.block || w.fold(i) == w.fold(j) }))
        );
    }
}
