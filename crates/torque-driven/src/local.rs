//! Screening local forms of an effect: columns of a disc or an onset superposed from columns of the segments' parts.

use crate::candidate::{Candidate, Ground, reduced, single};
use crate::channel::{Channel, Channels};
use crate::disc::neighbours;
use crate::fit::{Columns, Problem};
use crate::settings::search::{Discs, Onsets, SETTINGS};
use crate::simulate::Response;
use crate::windows::{PARTS, Segment};
use inference::hypothesis::Variant;

const DISCS: Discs = SETTINGS.discs;
const ONSETS: Onsets = SETTINGS.onsets;

/// The column of a local presence: each part's column times the share of it that is inside.
fn superpose(parts: &[Response], share: impl Fn(usize, usize, usize) -> f64) -> Response {
    let runs = parts[0].len();
    (0..runs)
        .map(|r| {
            (0..parts[0][r].len())
                .map(|s| {
                    let mut y = vec![Channels::all(0.0); parts[0][r][s].len()];
                    for (q, part) in parts.iter().enumerate() {
                        let w = share(r, s, q);
                        if w > 0.0 {
                            for (y, p) in y.iter_mut().zip(&part[r][s]) {
                                for c in Channel::ALL {
                                    y[c] += w * p[c];
                                }
                            }
                        }
                    }
                    y
                })
                .collect()
        })
        .collect()
}

/// Share of a part of a segment that is spent inside a disc, mean over the wheels; its edge is softened.
pub(crate) fn share_inside(segment: &Segment, q: usize, disc: [f64; 3]) -> f64 {
    let n = segment.windows;
    let (from, until) = (q * n / PARTS, (q + 1) * n / PARTS);
    let wheels = segment.wheels[from..until].iter().flatten();
    let within = |w: &[f64; 2]| disc[2] - (w[0] - disc[0]).hypot(w[1] - disc[1]);
    let inside = |w: &[f64; 2]| (0.5 + within(w) / DISCS.soft).clamp(0.0, 1.0);
    wheels.map(inside).sum::<f64>() / (4 * (until - from).max(1)) as f64
}

/// The disc whose superposed column explains most: from a coarse grid of places and radii, then moved and resized.
pub(crate) fn disc(ground: &Ground<'_>, variant: &Variant, parts: &[Response]) -> Option<Candidate> {
    let problem = ground.problem;
    let centres = farthest_points(problem, DISCS.centres);
    if centres.len() < 2 {
        return None;
    }
    let best_of = |discs: &[[f64; 3]]| {
        let column = |&d: &[f64; 3]| superpose(parts, |r, s, q| share_inside(&problem.cuts[r].segments[s], q, d));
        let (a, b) = reduced(ground, Columns(discs.iter().map(column).collect()))?;
        (0..discs.len())
            .filter_map(|i| single(a[(i, i)], b[(i, 0)], false).map(|(value, x)| (value, x, discs[i])))
            .max_by(|x, y| x.0.total_cmp(&y.0))
    };
    let grid: Vec<[f64; 3]> = centres.iter().flat_map(|c| DISCS.radii.map(|r| [c[0], c[1], r])).collect();
    let mut best = best_of(&grid)?;
    for step in DISCS.steps {
        for _ in 0..DISCS.passes {
            match best_of(&neighbours(best.2, step)) {
                Some(better) if better.0 > best.0 => best = better,
                _ => break,
            }
        }
    }

    let (value, x, found) = best;
    let free = variant.free(&problem.sizes());
    let strengths = free.len() - 3;
    let mut start: Vec<f64> = free.iter().map(|f| f.usual).collect();
    start[0] = (x * free[0].usual).clamp(free[0].bounds[0], free[0].bounds[1]);
    start[strengths..].copy_from_slice(&found);
    Some(Candidate { variant: *variant, start, onsets: Vec::new(), evidence: value - DISCS.cost })
}

/// Points of the driven paths as far from each other as can be, greedily.
pub(crate) fn farthest_points(problem: &Problem<'_>, most: usize) -> Vec<[f64; 2]> {
    let path: Vec<[f64; 2]> = problem.cuts.iter().flat_map(|c| c.path.iter().map(|p| [p[0], p[1]])).collect();
    let Some(&first) = path.first() else { return Vec::new() };
    let mut out = vec![first];
    let mut far: Vec<f64> = path.iter().map(|p| (p[0] - first[0]).hypot(p[1] - first[1])).collect();
    while out.len() < most {
        let Some((i, d)) = far.iter().copied().enumerate().max_by(|a, b| a.1.total_cmp(&b.1)) else { break };
        if d < DISCS.apart {
            break;
        }
        let p = path[i];
        out.push(p);
        for (f, q) in far.iter_mut().zip(&path) {
            *f = f.min((q[0] - p[0]).hypot(q[1] - p[1]));
        }
    }
    out
}

pub(crate) fn onset(ground: &Ground<'_>, variant: &Variant, parts: &[Response]) -> Option<Candidate> {
    let problem = ground.problem;
    // Grid of onsets: the borders of the parts, thinned for long recordings.
    let mut grid: Vec<(usize, usize, usize)> = Vec::new();
    for (r, cut) in problem.cuts.iter().enumerate() {
        let all: Vec<(usize, usize)> = (0..cut.segments.len()).flat_map(|s| (0..PARTS).map(move |q| (s, q))).collect();
        let keep = all.len().div_ceil(ONSETS.most).max(1);
        grid.extend(all.into_iter().step_by(keep).map(|(s, q)| (r, s, q)));
    }
    if grid.is_empty() {
        return None;
    }

    let columns =
        grid.iter().map(|&(r, s, q)| superpose(parts, |r2, s2, q2| f64::from(r2 == r && (s2, q2) >= (s, q)))).collect();
    let (a, b) = reduced(ground, Columns(columns))?;

    let runs = problem.cuts.len();
    // One strength for all runs; each run's onset in turn is the best given the others. `None`: it does not set in.
    let mut chosen: Vec<Option<usize>> = vec![None; runs];
    let value = |chosen: &[Option<usize>]| {
        let set: Vec<usize> = chosen.iter().flatten().copied().collect();
        let aa: f64 = set.iter().flat_map(|&i| set.iter().map(move |&j| (i, j))).map(|(i, j)| a[(i, j)]).sum();
        let bb: f64 = set.iter().map(|&i| b[(i, 0)]).sum();
        single(aa, bb, variant.spec().signed).map_or((f64::MIN, 0.0), |(v, x)| (v - ONSETS.cost * set.len() as f64, x))
    };
    for _ in 0..ONSETS.rounds {
        for r in 0..runs {
            let mut best = (f64::MIN, None);
            let options = std::iter::once(None).chain((0..grid.len()).filter(|&i| grid[i].0 == r).map(Some));
            for option in options {
                chosen[r] = option;
                let v = value(&chosen).0;
                if v > best.0 {
                    best = (v, option);
                }
            }
            chosen[r] = best.1;
        }
    }

    let (best, x) = value(&chosen);
    if chosen.iter().all(Option::is_none) {
        return None;
    }

    let free = variant.free(&problem.sizes());
    let mut start: Vec<f64> = free.iter().map(|f| f.usual).collect();
    start[0] = (x * free[0].usual).clamp(free[0].bounds[0], free[0].bounds[1]);
    let onsets = chosen
        .iter()
        .map(|c| {
            c.map(|i| {
                let (r, s, q) = grid[i];
                let cut = &problem.cuts[r];
                let segment = &cut.segments[s];
                let rows = (segment.windows * cut.rows_per_window) as f64;
                cut.time(segment.row as f64 + rows * q as f64 / PARTS as f64)
            })
        })
        .collect();
    Some(Candidate { variant: *variant, start, onsets, evidence: best })
}
