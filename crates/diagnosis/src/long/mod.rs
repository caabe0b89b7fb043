//! Long recordings: all of them screened once by weak form, and the most telling minutes chosen for a diagnosis.
//!
//! Every minute is compared with the law among signals that the references follow (`law`), in memory that does not grow
//! with the length. A diagnosis then rests on a fixed budget of minutes (`pool`): some spread evenly, some whose driving
//! tells most, and those least like the references. What was left out is part of the answer ([`Coverage`]).

mod law;
mod pool;
mod rows;
mod thin;

use std::sync::Arc;

use inference::robust;
use rayon::prelude::*;
use recordings::{Recording, RecordingError};
use serde::{Deserialize, Serialize};
use verdict::{Chosen, ComparedWith, Coverage};

use crate::settings::{Pieces, SETTINGS};
use law::{Law, Windows};
use pool::{Member, Pool};
use rows::Grid;

const PIECES: Pieces = SETTINGS.pieces;

/// Length of a piece, s.
pub const PIECE: f64 = PIECES.length;
/// Recorded time on which a diagnosis rests at most unless set otherwise, s.
pub const BUDGET: f64 = PIECES.budget;

/// A piece for the diagnosis.
#[derive(Debug, Clone)]
pub struct Stretch {
    /// Its samples, at most one in 10 ms; its name says where it is from.
    pub recording: Recording,
    /// The recording that it is of.
    pub of: String,
    /// When it begins, s since that recording's start.
    pub from: f64,
}

/// One pass over recordings of any length.
pub struct Screening {
    compared_with: ComparedWith,
    grid: Option<Grid>,
    law: Option<Law>,
    /// Pieces that wait for a law.
    waiting: Vec<Piece>,
    pool: Pool<Arc<Stretch>>,
    seen: Vec<Screen>,
    /// The recording at hand and its first stamp, ns.
    at: Option<(String, i64)>,
}

/// What screening tells of a piece.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Screen {
    /// Recording that it is of.
    pub recording: String,
    /// When it begins and ends, s since the recording's start.
    pub interval: [f64; 2],
    /// Mean squared residual of the law over what is usual; the worst of its targets. `None` without a law.
    pub unlike: Option<f64>,
}

/// A piece that was looked at.
struct Piece {
    stretch: Stretch,
    length: f64,
    windows: Option<Windows>,
}

impl Screening {
    /// A screening that compares with references and keeps pieces of `budget` seconds together, three at least.
    pub fn new(references: &[&Recording], budget: f64) -> Self {
        let grid = references.iter().find_map(|r| Grid::new(r));
        let windows = grid.iter().flat_map(|grid| {
            let pieces = references.iter().flat_map(|r| r.pieces(PIECES.reference_ns));
            pieces.filter_map(|piece| Windows::new(grid, &thin::thinned(&piece).ok()?)).collect::<Vec<_>>()
        });
        let law = grid.and_then(|grid| Law::new(&grid, &windows.collect::<Vec<_>>()));
        Self {
            compared_with: if law.is_some() { ComparedWith::References } else { ComparedWith::Beginning },
            grid: grid.filter(|_| law.is_some()),
            law,
            waiting: Vec::new(),
            pool: Pool::new(((budget / PIECE).round() as usize).max(PIECES.least)),
            seen: Vec::new(),
            at: None,
        }
    }

    /// Takes pieces of a recording, in order; the first one of another recording begins that.
    ///
    /// # Errors
    /// A piece that cannot be thinned, which no reader gives.
    pub fn take(&mut self, pieces: &[Recording]) -> Result<(), RecordingError> {
        let mut placed = Vec::with_capacity(pieces.len());
        for piece in pieces {
            let Some((first_ns, last_ns)) = span_ns(piece) else { continue };
            if self.at.as_ref().is_none_or(|(name, _)| name != piece.name()) {
                self.at = Some((piece.name().to_owned(), first_ns));
            }
            let start_ns = self.at.as_ref().map_or(first_ns, |at| at.1);
            placed.push((piece, (first_ns - start_ns) as f64 * 1e-9, (last_ns - first_ns) as f64 * 1e-9));
        }
        if self.grid.is_none() {
            self.grid = pieces.iter().find_map(Grid::new);
        }
        let grid = self.grid;
        let looked: Vec<Piece> = placed
            .into_par_iter()
            .map(|(piece, from, length)| {
                let thin = thin::thinned(piece)?;
                let windows = grid.and_then(|grid| Windows::new(&grid, &thin));
                let name = format!("{} {:.0}-{:.0} s", piece.name(), from, from + length);
                let recording = thin.renamed(name);
                Ok(Piece { stretch: Stretch { recording, of: piece.name().to_owned(), from }, length, windows })
            })
            .collect::<Result<_, RecordingError>>()?;
        for piece in looked {
            self.waiting.push(piece);
            if self.law.is_some() || self.waiting.len() >= PIECES.beginning {
                self.judge();
            }
        }
        Ok(())
    }

    /// Offers all pieces that wait.
    fn judge(&mut self) {
        if self.law.is_none()
            && let Some(grid) = &self.grid
        {
            let windows: Vec<Windows> = self.waiting.iter().filter_map(|p| p.windows.clone()).collect();
            self.law = Law::new(grid, &windows);
        }
        for piece in self.waiting.drain(..) {
            let unlike = match (&self.law, &piece.windows) {
                (Some(law), Some(windows)) => law.unlike(windows),
                _ => f64::NAN,
            };
            let scale = self.law.as_ref().map(|law| law.scale);
            let windows = piece.windows.as_ref();
            let information = windows.map(|w| w.information(&scale.unwrap_or_else(|| w.scale()))).unwrap_or_default();
            let number = self.seen.len();
            let interval = [piece.stretch.from, piece.stretch.from + piece.length];
            let told = Some(unlike).filter(|u| u.is_finite());
            self.seen.push(Screen { recording: piece.stretch.of.clone(), interval, unlike: told });
            // The rest at the end of a recording may be too short for anything.
            if piece.length >= PIECES.shortest || number == 0 {
                self.pool.offer(&Member {
                    number,
                    unlike: if unlike.is_nan() { 0.0 } else { unlike },
                    information,
                    piece: Arc::new(piece.stretch),
                });
            }
        }
    }

    /// The chosen pieces in order, what was left out, and what was told of every piece.
    pub fn finish(mut self) -> (Vec<Stretch>, Coverage, Vec<Screen>) {
        self.judge();
        let seen = self.seen;
        let (mut stretches, mut chosen) = (Vec::new(), Vec::new());
        let mut rest = vec![true; seen.len()];
        for (member, why) in self.pool.chosen() {
            rest[member.number] = false;
            let Screen { recording, interval, unlike } = seen[member.number].clone();
            let name = member.piece.recording.name().to_owned();
            chosen.push(Chosen { name, recording, interval, why, unlike });
            stretches.push(Arc::unwrap_or_clone(member.piece));
        }
        let length = |interval: [f64; 2]| interval[1] - interval[0];
        let every = sorted(seen.iter());
        let left_out = sorted(seen.iter().zip(&rest).filter(|(_, rest)| **rest).map(|(s, _)| s));
        let coverage = Coverage {
            screened: seen.iter().map(|s| length(s.interval)).sum(),
            diagnosed: chosen.iter().map(|c| length(c.interval)).sum(),
            compared_with: if self.law.is_none() { ComparedWith::Nothing } else { self.compared_with },
            left_out: seen.len() - chosen.len(),
            chosen,
            unlike: [0.0, 0.25, 0.5, 0.75, 1.0].map(|share| robust::quantile(&every, share)),
            unlike_left_out: [0.5, 1.0].map(|share| robust::quantile(&left_out, share)),
        };
        (stretches, coverage, seen)
    }
}

/// How far pieces are from the law, from the least to the largest.
fn sorted<'a>(pieces: impl Iterator<Item = &'a Screen>) -> Vec<f64> {
    robust::sorted(pieces.filter_map(|s| s.unlike))
}

/// First and last stamp over all channels, ns.
fn span_ns(piece: &Recording) -> Option<(i64, i64)> {
    let spans = piece.channels().iter().filter_map(recordings::Channel::span_ns);
    spans.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
}

#[cfg(test)]
mod tests;
