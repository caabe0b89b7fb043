//! What the sensors say about the motion before any force law: frozen angles, heading, smoothed velocity.

use crate::run::Run;
use crate::settings::preparation::{Freezing, SETTINGS};
use crate::smooth::{errors_of_late, interpolate, slope, smooth};

/// What a sensor correction found by redundancy leaves to do.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct GyroError {
    /// Constant offset, rad/s.
    pub(crate) bias: f64,
    /// Relative scale error.
    pub(crate) scale: f64,
}

const FREEZING: Freezing = SETTINGS.freezing;
/// Nodes of the pose smoother, s.
const NODE: f64 = SETTINGS.smoothing.node;

/// Rows whose angle is frozen: several equal counts while moving, ended by a jump far above the usual increment.
pub(crate) fn frozen_rows(angle: &[Option<f64>]) -> Vec<bool> {
    let mut frozen = vec![false; angle.len()];
    let present: Vec<(usize, f64)> = Run::present(angle).collect();
    let steps: Vec<f64> = present.windows(2).map(|w| (w[1].1 - w[0].1).abs()).collect();
    let mut k = 0;
    while k < steps.len() {
        if steps[k] > 0.0 {
            k += 1;
            continue;
        }
        let first = k;
        while k < steps.len() && steps[k] == 0.0 {
            k += 1;
        }

        // present[first..=k] are equal; the jump that ends them is steps[k].
        let usual = {
            let before = (0..first).rev().take(FREEZING.around);
            let after = k + 1..(k + 1 + FREEZING.around).min(steps.len());
            let mut near: Vec<f64> = before.chain(after).map(|i| steps[i]).collect();
            near.sort_by(f64::total_cmp);
            near.get(near.len() / 2).copied().unwrap_or(0.0)
        };
        let count = k - first + 1;
        if count >= FREEZING.least_rows && k < steps.len() && usual > 0.0 && steps[k] > FREEZING.jump * usual {
            for p in &present[first + 1..=k] {
                frozen[p.0] = true;
            }
        }
    }
    frozen
}

/// Yaw by integrating the corrected gyro, at each row; `None` without a gyro.
pub(crate) fn integrated_yaw(run: &Run, error: GyroError) -> Option<Vec<f64>> {
    let first = run.gyro.iter().flatten().next()?;
    let mut last = (first - error.bias) / (1.0 + error.scale);
    let mut yaw = 0.0;
    Some(
        run.gyro
            .iter()
            .map(|g| {
                if let Some(g) = g {
                    last = (g - error.bias) / (1.0 + error.scale);
                }
                // A sample stands for the row before it.
                yaw += last * run.period;
                yaw
            })
            .collect(),
    )
}

/// Unwrapped pose heading at its rows.
pub(crate) fn pose_yaw(run: &Run) -> Vec<(usize, f64)> {
    let mut last: Option<f64> = None;
    Run::present(&run.pose[2])
        .map(|(k, y)| {
            let z = last.map_or(y, |l: f64| {
                l + (y - l + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI
            });
            last = Some(z);
            (k, z)
        })
        .collect()
}

/// Smoothed pose: positions at nodes, yaw at rows.
pub(crate) struct Smoothed {
    x: Option<[Vec<f64>; 2]>,
    pub(crate) yaw: Vec<f64>,
}

impl Smoothed {
    pub(crate) fn new(run: &Run, error: GyroError, sigma: f64) -> Self {
        let rows = run.rows();
        // Samples belong, on average, half a row before the row they are written in.
        let node = |k: usize| (k as f64 - 0.5) * run.period / NODE;
        let nodes = (run.duration() / NODE).ceil() as usize + 1;
        let poses = pose_yaw(run);
        let turned = integrated_yaw(run, error);

        let yaw = match (turned, poses.is_empty()) {
            (Some(t), true) => t,
            (Some(t), false) => {
                // The pose corrects the slow part only: a line through pose less integrated gyro.
                let points: Vec<(f64, f64)> =
                    poses.iter().map(|&(k, y)| (node(k), y - 0.5 * (t[k] + t[k.saturating_sub(1)]))).collect();
                let middle = nodes as f64 / 2.0;
                let (n, mut st, mut stt, mut sz, mut stz) = (points.len() as f64, 0.0, 0.0, 0.0, 0.0);
                for &(t, z) in &points {
                    let t = t - middle;
                    st += t;
                    stt += t * t;
                    sz += z;
                    stz += t * z;
                }
                let det = n * stt - st * st;
                let slope =
                    if n > SETTINGS.smoothing.least_for_drift && det > 0.0 { (n * stz - st * sz) / det } else { 0.0 };
                let offset = (sz - slope * st) / n;
                t.iter()
                    .enumerate()
                    .map(|(k, y)| y + offset + slope * ((k as f64) * run.period / NODE - middle))
                    .collect()
            }
            (None, true) => vec![0.0; rows],
            (None, false) => {
                let at: Vec<f64> = poses.iter().map(|&(k, _)| node(k)).collect();
                let z: Vec<f64> = poses.iter().map(|p| p.1).collect();
                smooth(&at, &z, nodes, &errors_of_late(&at, &z, sigma, run.period / NODE)).map_or_else(
                    || vec![0.0; rows],
                    |x| (0..rows).map(|k| interpolate(&x, k as f64 * run.period / NODE)).collect(),
                )
            }
        };

        let axis = |i: usize| {
            let (at, z): (Vec<f64>, Vec<f64>) = Run::present(&run.pose[i]).map(|(k, v)| (node(k), v)).unzip();
            smooth(&at, &z, nodes, &errors_of_late(&at, &z, sigma, run.period / NODE))
        };
        let x = axis(0).zip(axis(1)).map(|(x, y)| [x, y]);
        Self { x, yaw }
    }

    /// Velocity in body axes at time `t`, s.
    pub(crate) fn velocity(&self, t: f64, period: f64) -> Option<[f64; 2]> {
        let x = self.x.as_ref()?;
        let v = [slope(&x[0], t / NODE) / NODE, slope(&x[1], t / NODE) / NODE];
        let (s, c) = interpolate(&self.yaw, t / period).sin_cos();
        Some([v[0] * c + v[1] * s, v[1] * c - v[0] * s])
    }

    pub(crate) fn position(&self, t: f64) -> [f64; 2] {
        self.x.as_ref().map_or([0.0; 2], |x| [interpolate(&x[0], t / NODE), interpolate(&x[1], t / NODE)])
    }
}
