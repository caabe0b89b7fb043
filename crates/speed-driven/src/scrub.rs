//! When inside a recording turning begins or ceases to cost another torque: another ground.

use crate::extract::is_steady_turn;
use crate::level::levels;
use crate::run::SpeedRun;
use crate::settings::{CHANGES, changes::Scrub};
use crate::straight::Reading;
use inference::robust::{NINETY, median};
use verdict::TurningChange;

const SCRUB: Scrub = CHANGES.scrub;

/// Torque of the outer side in steady arcs, mean of both sides in spins.
fn readings(run: &SpeedRun) -> Vec<Option<Reading>> {
    let of_row = |i: usize| {
        let [l, r] = [0, 1].map(|j| run.torque[j][i].abs());
        let spins = run.speed[0][i] * run.speed[1][i] < 0.0;
        let outer = if run.speed[1][i].abs() > run.speed[0][i].abs() { r } else { l };
        Reading::Exact(if spins { 0.5 * (l + r) } else { outer })
    };
    (0..run.time.len()).map(|i| is_steady_turn(run, i).then(|| of_row(i))).collect()
}

/// Changes of what turning costs. `usual` is the references' torque in spins or arcs, N m, where they turned.
pub(crate) fn turning_changes(run: &SpeedRun, usual: Option<f64>) -> Vec<TurningChange> {
    let readings = readings(run);
    let seen: Vec<usize> = (0..readings.len()).filter(|&i| readings[i].is_some()).collect();
    let period = run.period();
    let Some(middle) = median(readings.iter().flatten().map(|r| r.value())) else { return Vec::new() };
    let level = levels(&readings, usual.unwrap_or(middle), period);

    // The rest of the run is what is like the references, if anything is; else the middle of the run.
    let mut like: Vec<f64> = seen.iter().map(|&i| level[i]).collect();
    if let Some(u) = usual {
        let alike: Vec<f64> = like.iter().copied().filter(|l| l / u < SCRUB.same && u / l < SCRUB.same).collect();
        if alike.len() as f64 * period >= SCRUB.known {
            like = alike;
        }
    }
    let Some(base) = median(like).filter(|base| *base > 0.0) else { return Vec::new() };
    let other = |i: usize| {
        let ratio = level[i] / base;
        if ratio > SCRUB.same {
            1
        } else if ratio < 1.0 / SCRUB.same {
            -1
        } else {
            0
        }
    };

    let mut out = Vec::new();
    for piece in seen.chunk_by(|&a, &b| other(a) == other(b)).filter(|p| other(p[0]) != 0) {
        let seconds = piece.len() as f64 * period;
        if seconds < SCRUB.least {
            continue;
        }

        let (first, last) = (piece[0], piece[piece.len() - 1]);
        let values = || piece.iter().filter_map(|&i| readings[i]).map(Reading::value);
        let n = piece.len() as f64;
        let mean = values().sum::<f64>() / n;
        let spread = values().map(|x| (x - mean).powi(2)).sum::<f64>() / n;
        let ratio = mean / base;
        let of_readings = (spread / (CHANGES.levels.per_second * seconds)).sqrt() / base;
        let half = NINETY * (SCRUB.scatter * std::f64::consts::SQRT_2 * ratio).hypot(of_readings);
        if (ratio - 1.0).abs() < half {
            continue;
        }

        // It began and ended somewhere since the last turn and before the next.
        let before = seen.iter().rev().find(|&&i| i < first).map_or(run.time[0], |&i| run.time[i]);
        let after = seen.iter().find(|&&i| i > last).map_or(run.time[run.time.len() - 1], |&i| run.time[i]);
        out.push(TurningChange {
            recording: run.name.clone(),
            interval: [run.time[first], run.time[last]],
            onset: [before, run.time[first]],
            end: [run.time[last], after],
            seconds,
            ratio,
            half,
        });
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{Leg, drive};

    /// Straight driving and turns, some rounds of it, at a scrub couple.
    fn rounds(n: usize, scrub: f64) -> Vec<Leg> {
        (0..n).flat_map(|_| [Leg::straight(4.0), Leg { scrub, ..Leg::turn(6.0) }]).collect()
    }

    #[test]
    fn dearer_turning_from_some_moment_on_is_found() {
        let legs = [rounds(4, 20.0), rounds(4, 32.0)].concat();
        let found = turning_changes(&drive(&legs, false), Some(25.5));
        assert_eq!(found.len(), 1, "{found:?}");
        let c = &found[0];
        // The fourth turn ends at 40 s; the next begins at 44 s and is steady a second later.
        assert!(c.onset[0] > 38.0 && c.onset[0] < 41.0 && c.onset[1] > 44.0 && c.onset[1] < 46.5, "{c:?}");
        assert!((c.ratio - 37.5 / 25.5).abs() < c.half, "{c:?}");
    }

    #[test]
    fn one_ground_is_no_change_though_it_be_another_one() {
        assert_eq!(turning_changes(&drive(&rounds(6, 20.0), false), Some(25.5)), []);
        assert_eq!(turning_changes(&drive(&rounds(6, 32.0), false), Some(25.5)), []);
        assert_eq!(turning_changes(&drive(&[Leg::straight(30.0)], false), Some(25.5)), []);
    }
}
