//! Recordings beside their forecasts from the commands, row by row; every window by a fit that left it out.

use inference::experiment::Comparison;

use crate::compare::{Motion, Simulated};
use crate::ground::{Poses, misses};
use crate::run::{ResponseRun, STEP, WINDOW};
use crate::settings::{SETTINGS, Usual};
use crate::windows::{Window, Windows};
use verdict::{Compared, Trace, instant, rounded};

const USUAL: Usual = SETTINGS.traces;

/// Every recording with what was simulated for it.
pub(crate) fn traces(runs: &[ResponseRun], windows: &Windows, folds: &[Simulated]) -> Vec<Trace> {
    let of = |which: &dyn Fn(&Comparison<Motion>) -> &Motion| {
        put_together(windows, &folds.iter().map(|fold| which(&fold.responses)).collect::<Vec<_>>())
    };
    let three = [of(&|c| &c.nominal), of(&|c| &c.retuned), of(&|c| c.best())];
    let errors: Vec<Vec<f64>> = three.iter().map(|s| errors(windows, s)).collect();
    let left = errors[2].iter().sum::<f64>() / errors[2].len().max(1) as f64;
    let mut first = 0;
    runs.iter()
        .map(|run| {
            let pieces = first..first + run.pieces.len();
            first = pieces.end;
            let own: Vec<(usize, &Window)> =
                windows.list.iter().enumerate().filter(|(_, w)| pieces.contains(&w.piece)).collect();
            let over_left = |k: usize| -> Vec<Option<f64>> {
                let of_window = |(w, _): &(usize, &Window)| [Some(rounded(errors[k][*w] / left.max(1e-12))); WINDOW];
                own.iter().flat_map(of_window).collect()
            };
            let rows = || own.iter().flat_map(|(_, w)| (w.start..w.start + WINDOW).map(|i| (w.piece, i)));
            let position = |(piece, i): (usize, usize)| Some(windows.pieces[piece].position.as_ref()?[i].map(rounded));
            Trace {
                recording: run.name.clone(),
                left_out: true,
                time: rows().map(|(p, i)| instant(windows.pieces[p].start + i as f64 * STEP)).collect(),
                restarts: (0..own.len()).map(|w| w * WINDOW).collect(),
                channels: channels(windows, &three, &own),
                path: rows().map(position).collect::<Option<_>>().unwrap_or_default(),
                before: over_left(0),
                after: over_left(2),
            }
        })
        .collect()
}

/// Every window by the fit that left it out.
pub(crate) fn put_together(windows: &Windows, folds: &[&Motion]) -> Motion {
    let mut wheels = folds[0].wheels.clone();
    let mut poses = Vec::with_capacity(windows.list.len());
    for (w, window) in windows.list.iter().enumerate() {
        let of_fold = folds[windows.fold(w)];
        let rows = window.start..window.start + WINDOW;
        wheels[window.piece][rows.clone()].copy_from_slice(&of_fold.wheels[window.piece][rows]);
        poses.push(of_fold.poses[w].clone());
    }
    Motion { wheels, poses }
}

fn channels(windows: &Windows, three: &[Motion; 3], own: &[(usize, &Window)]) -> Vec<Compared> {
    let wheel = |j: usize| {
        let series = |of: &[Vec<[f64; 2]>]| -> Vec<Option<f64>> {
            let rows = |(_, w): &(usize, &Window)| {
                of[w.piece][w.start..w.start + WINDOW].iter().map(|v| known(v[j])).collect::<Vec<_>>()
            };
            own.iter().flat_map(rows).collect()
        };
        let measured: Vec<Vec<[f64; 2]>> = windows.pieces.iter().map(|p| p.wheel.clone()).collect();
        Compared {
            signal: format!("{} wheel speed", inference::words::side(j)).into(),
            unit: "rad/s".into(),
            side: Some(inference::words::side(j).into()),
            recorded: series(&measured),
            nominal: series(&three[0].wheels),
            retuned: series(&three[1].wheels),
            corrected: series(&three[2].wheels),
            usual: None,
        }
    };
    let mut out = vec![wheel(0), wheel(1)];

    // Headings of forecasts begin at zero in every window.
    let heading =
        |(_, w): &(usize, &Window)| windows.pieces[w.piece].heading.as_ref().map(|h| &h[w.start..w.start + WINDOW]);
    if own.iter().all(|w| heading(w).is_some()) {
        let recorded =
            |w: &(usize, &Window)| heading(w).unwrap_or_default().iter().map(|h| known(*h)).collect::<Vec<_>>();
        let forecast = |s: &Motion| {
            let of_window = |w: &(usize, &Window)| {
                let start = heading(w).and_then(|h| h.first()).copied().unwrap_or_default();
                s.poses[w.0].iter().map(|pose| known(start + pose[2])).collect::<Vec<_>>()
            };
            own.iter().flat_map(of_window).collect()
        };
        out.push(Compared {
            signal: "heading".into(),
            unit: "rad".into(),
            recorded: own.iter().flat_map(recorded).collect(),
            nominal: forecast(&three[0]),
            retuned: forecast(&three[1]),
            corrected: forecast(&three[2]),
            ..Compared::default()
        });
    }
    out
}

fn known(v: f64) -> Option<f64> {
    v.is_finite().then(|| rounded(v))
}

/// Mean squared error of each window, all quantities in units of a usual size.
fn errors(windows: &Windows, Motion { wheels, poses }: &Motion) -> Vec<f64> {
    let of_window = |(w, p): (&Window, &Poses)| {
        let measured = &windows.pieces[w.piece].wheel;
        let wheel: f64 = (w.start..w.start + WINDOW)
            .flat_map(|i| [0, 1].map(|j| (wheels[w.piece][i][j] - measured[i][j]).powi(2)))
            .sum();
        let pose: f64 = misses(windows, w, p).iter().flatten().map(|m| (m / USUAL.pose).powi(2)).sum();
        (wheel / (2.0 * USUAL.wheel * USUAL.wheel) + pose / 3.0) / WINDOW as f64
    };
    windows.list.iter().zip(poses).map(of_window).collect()
}
