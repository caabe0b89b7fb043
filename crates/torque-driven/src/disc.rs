//! Moving and resizing the disc of a local effect: its edge makes the cost too rough for Gauss–Newton alone.

use crate::fit::{Fitted, Point, Problem};
use crate::settings::search::{ExactDiscs, SETTINGS};
use crate::trial::Trial;
use inference::hypothesis::Place;

/// Moves of (x, y, radius): each alone, and growing or shrinking with one edge held.
const MOVES: [[f64; 3]; 14] = [
    [1.0, 0.0, 0.0],
    [-1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, -1.0, 0.0],
    [0.0, 0.0, 1.0],
    [0.0, 0.0, -1.0],
    [1.0, 0.0, 1.0],
    [-1.0, 0.0, 1.0],
    [0.0, 1.0, 1.0],
    [0.0, -1.0, 1.0],
    [1.0, 0.0, -1.0],
    [-1.0, 0.0, -1.0],
    [0.0, 1.0, -1.0],
    [0.0, -1.0, -1.0],
];
const DISCS: ExactDiscs = SETTINGS.exact_discs;

/// The discs (x, y, radius) around one.
pub(crate) fn neighbours(disc: [f64; 3], step: f64) -> [[f64; 3]; 14] {
    MOVES.map(|m| [disc[0] + step * m[0], disc[1] + step * m[1], (disc[2] + step * m[2]).max(DISCS.least_radius)])
}

/// Moves and resizes every disc of a trial by ever smaller steps, each improvement taken at once.
pub(crate) fn scan(problem: &Problem<'_>, trial: &mut Trial) {
    let mut end = 0;
    for part in 0..trial.hypothesis.parts.len() {
        let variant = trial.hypothesis.parts[part].0;
        end += variant.count();
        if variant.place != Place::Disc {
            continue;
        }
        for step in DISCS.steps {
            for _ in 0..DISCS.rounds {
                let mut moved = false;
                for m in 0..MOVES.len() {
                    let e = &trial.fitted.point.effects[end - 3..end];
                    let there = neighbours([e[0], e[1], e[2]], step)[m];
                    moved |= try_at(problem, trial, end, there);
                }
                if !moved {
                    break;
                }
            }
        }
    }
}

/// Takes the disc if the cost falls.
fn try_at(problem: &Problem<'_>, trial: &mut Trial, end: usize, disc: [f64; 3]) -> bool {
    let mut point: Point = trial.fitted.point.clone();
    point.effects[end - 3..end].copy_from_slice(&disc);
    let response = problem.response(&point, &trial.hypothesis);
    let cost = problem.cost(&point, &response);
    let better = cost < trial.fitted.cost;
    if better {
        trial.fitted = Fitted { point, response, cost, columns: trial.fitted.columns.clone() };
    }
    better
}
