//! How far the best answer and none are off in every window, and what noise alone leaves.

use inference::experiment::Comparison;
use inference::robust::{MAD_TO_SIGMA, mean, median};

use crate::compare::Motion;
use crate::ground::{GroundPart, Poses, RADIUS, TRACK, misses};
use crate::identified::Identified;
use crate::left::{BySignal, Fitted, HEADING, POSITION};
use crate::run::{STEP, WINDOW};
use crate::settings::SETTINGS;
use crate::traces::put_together;
use crate::windows::{FOLDS, Window, Windows};

/// Mean squares of a window in squares of the signals' units; zeros where nothing was recorded.
pub(crate) struct Squares {
    pub(crate) nominal: Vec<BySignal>,
    pub(crate) corrected: Vec<BySignal>,
    /// Of the motion itself, over all windows.
    pub(crate) motion: BySignal,
    /// What noise alone leaves.
    pub(crate) noise: BySignal,
}

impl Squares {
    /// Of what was fitted, each window by the fit that left it out.
    pub(crate) fn new(fitted: &Fitted<'_>) -> Self {
        let Fitted { windows, folds, base, found, nominal } = *fitted;
        let of = |which: &dyn Fn(&Comparison<Motion>) -> &Motion| {
            put_together(windows, &folds.iter().map(|fold| which(&fold.responses)).collect::<Vec<_>>()).wheels
        };
        let wheels = [of(&|c| &c.nominal), of(&|c| c.best())];
        // The body at the wheel speeds that were measured, each window by the fit that left it out.
        let body = GroundPart::measured(windows, nominal);
        let plain = body.poses(&base.ground.x);
        let by_fold: Vec<Vec<Poses>> = (0..FOLDS).map(|f| found.ground.without(f).poses(&body)).collect();
        let corrected: Vec<Poses> = (0..windows.list.len()).map(|w| by_fold[windows.fold(w)][w].clone()).collect();

        let residuals = |wheels: &[Vec<[f64; 2]>], poses: &[Poses]| -> Vec<Vec<[f64; 5]>> {
            let of_window = |(w, p): (&Window, &Poses)| {
                let measured = &windows.pieces[w.piece].wheel;
                let wheel = |i: usize, s: usize| wheels[w.piece][w.start + i][s] - measured[w.start + i][s];
                let row = |(i, [x, y, h]): (usize, [f64; 3])| [wheel(i, 0), wheel(i, 1), h, x, y];
                misses(windows, w, p).into_iter().enumerate().map(row).collect()
            };
            windows.list.iter().zip(poses).map(of_window).collect()
        };
        let left = residuals(&wheels[1], &corrected);
        let still = vec![vec![[0.0; 3]; WINDOW]; windows.list.len()];
        let at_rest: Vec<Vec<[f64; 2]>> = windows.pieces.iter().map(|p| vec![[0.0; 2]; p.wheel.len()]).collect();
        let moved = squares(&residuals(&at_rest, &still));
        let motion = std::array::from_fn(|s| {
            let one = |k: usize| mean(moved.iter().map(|m| m[k])).unwrap_or(0.0);
            // Both wheels are measured by the motion of both: a wheel at rest has no share of its own.
            if s < HEADING { 0.5 * (one(0) + one(1)) } else { one(s) }
        });
        let noise = noise(windows, &left, motion, found, nominal);
        Self { nominal: squares(&residuals(&wheels[0], &plain)), corrected: squares(&left), motion, noise }
    }
}

/// Mean squares of every window.
fn squares(residuals: &[Vec<[f64; 5]>]) -> Vec<BySignal> {
    let of_window = |rows: &Vec<[f64; 5]>| {
        let mean = |k: usize| rows.iter().map(|r| r[k] * r[k]).sum::<f64>() / rows.len().max(1) as f64;
        [mean(0), mean(1), mean(2), mean(3) + mean(4)]
    };
    residuals.iter().map(of_window).collect()
}

/// Mean squares that noise leaves of a perfect forecast over a window that begins at a measured state.
///
/// White noise of σ has second differences of 6 σ². A pose is compared with the noisy pose of the window's first row, so
/// that it is off by 2 σ² and, where it goes, by its distance times the first heading's error; wheel noise adds up along
/// the window as a random walk, and so does a gyro's, whose second differences are 2 q for steps of q.
fn noise(
    windows: &Windows,
    residuals: &[Vec<[f64; 5]>],
    motion: BySignal,
    found: &Identified,
    [radius, track]: [f64; 2],
) -> BySignal {
    let apart = SETTINGS.left.apart;
    let second = |k: usize| -> f64 {
        let of_window = |r: &Vec<[f64; 5]>| -> Vec<f64> {
            (apart..r.len() - apart).map(|i| (r[i + apart][k] - 2.0 * r[i][k] + r[i - apart][k]).abs()).collect()
        };
        (MAD_TO_SIGMA * median(residuals.iter().flat_map(of_window)).unwrap_or(0.0)).powi(2)
    };
    // 1² + 2² + 1²
    let white = 2.0 + 4.0;
    let wheel = [second(0) / white, second(1) / white];
    let x = &found.ground.model.x;
    let (rolls, lever) = (x[RADIUS] * radius, x[TRACK] * track);
    let along = 0.5 * WINDOW as f64 * STEP * STEP * rolls * rolls * (wheel[0] + wheel[1]);
    let integrated = windows.pieces.iter().any(|p| p.integrated);
    let heading = second(HEADING) / white;
    let turned = if integrated {
        0.5 * WINDOW as f64 * second(HEADING) / (2.0 * apart as f64)
    } else {
        2.0 * heading + along / (lever * lever)
    };
    let position = 2.0 * (second(3) + second(4)) / white + motion[POSITION] * heading + 0.25 * along;
    [wheel[0], wheel[1], turned, position]
}
