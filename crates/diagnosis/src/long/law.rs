//! The law among signals that the references follow, by weak form, and how far a piece is from it.

use weak_form::{Gram, Law as Ridge, Shape, WeakForm};

use super::rows::{ACCEL, DIRECTION, DRIVE, GYRO, Grid, ONE, RATE, SIGNALS, SPEED};
use crate::settings::{Regression, SETTINGS};

const REGRESSION: Regression = SETTINGS.law;

/// Windows of the rows of a piece.
#[derive(Debug, Clone)]
pub(super) struct Windows {
    gram: Gram,
}

impl Windows {
    /// The windows of a piece: nothing of the size rows × columns is stored.
    pub(super) fn new(grid: &Grid, piece: &recordings::Recording) -> Option<Self> {
        let shape = Shape::new(SIGNALS, REGRESSION.rows, REGRESSION.stride, REGRESSION.exponent).ok()?;
        let mut weak = WeakForm::new(shape);
        weak.push(&grid.rows(piece)).ok()?;
        let gram = weak.gram();
        (gram.windows() > 0).then_some(Self { gram })
    }

    pub(super) fn count(&self) -> u64 {
        self.gram.windows()
    }

    pub(super) fn add(&mut self, other: &Self) {
        // Both have the one shape that there is.
        let _ = self.gram.add(&other.gram);
    }

    /// Mean product of two columns over the windows.
    fn mean(&self, i: usize, j: usize) -> f64 {
        self.gram.at(i, j).unwrap_or(f64::NAN) / self.gram.windows().max(1) as f64
    }

    /// Mean products of the signals, each in units of `scale`: what the piece tells about any linear law.
    pub(super) fn information(&self, scale: &[f64; SIGNALS]) -> [[f64; SIGNALS]; SIGNALS] {
        let per = |s: f64| if s > 0.0 { 1.0 / s } else { 0.0 };
        std::array::from_fn(|i| std::array::from_fn(|j| self.mean(i, j) * per(scale[i]) * per(scale[j])))
    }

    /// Root mean square of each signal.
    pub(super) fn scale(&self) -> [f64; SIGNALS] {
        std::array::from_fn(|i| self.mean(i, i).max(0.0).sqrt())
    }
}

/// What a target follows from.
struct Target {
    column: usize,
    regressors: Vec<usize>,
}

/// One law for each target, and how well it holds on what it was not learned from.
pub(super) struct Law {
    targets: Vec<(Target, Ridge)>,
    /// Mean squared residual of each target where the law holds.
    usual: Vec<f64>,
    pub(super) scale: [f64; SIGNALS],
}

impl Law {
    /// Learns the law from pieces in which it holds; what is usual comes from each piece left out in turn.
    ///
    /// `None` where there are too few windows.
    pub(super) fn new(grid: &Grid, pieces: &[Windows]) -> Option<Self> {
        let all = sum(pieces.iter())?;
        if pieces.len() < 2 || all.count() < REGRESSION.least_windows {
            return None;
        }
        let learn = |windows: &Windows| -> Option<Vec<(Target, Ridge)>> {
            targets(grid, &windows.gram.shape())
                .into_iter()
                .map(|t| Some((windows.gram.ridge(&[t.column], &t.regressors, REGRESSION.penalty).ok()?, t)))
                .map(|fit| fit.map(|(ridge, target)| (target, ridge)))
                .collect()
        };
        let laws = learn(&all)?;
        let (mut usual, mut count) = (vec![0.0; laws.len()], 0.0);
        for left_out in 0..pieces.len() {
            let others = sum(pieces.iter().enumerate().filter(|(i, _)| *i != left_out).map(|(_, p)| p))?;
            let windows = pieces[left_out].count() as f64;
            for ((target, ridge), usual) in learn(&others)?.iter().zip(&mut usual) {
                *usual += windows * residual(&pieces[left_out], target, ridge);
            }
            count += windows;
        }
        let usual = usual.into_iter().map(|u: f64| u / count).collect();
        Some(Self { targets: laws, usual, scale: all.scale() })
    }

    /// How far a piece is from the law: the largest ratio, over the targets, of its mean squared residual to the usual one.
    pub(super) fn unlike(&self, piece: &Windows) -> f64 {
        let ratio = |((target, ridge), usual): (&(Target, Ridge), &f64)| residual(piece, target, ridge) / usual;
        self.targets.iter().zip(&self.usual).map(ratio).filter(|r| r.is_finite()).fold(0.0, f64::max)
    }
}

/// All windows together.
fn sum<'a>(mut pieces: impl Iterator<Item = &'a Windows>) -> Option<Windows> {
    let mut all = pieces.next()?.clone();
    pieces.for_each(|p| all.add(p));
    Some(all)
}

/// Mean squared residual of a law on windows: `H_tt − 2 xᵀ b + xᵀ A x` over their number.
fn residual(windows: &Windows, target: &Target, ridge: &Ridge) -> f64 {
    let x = |i: usize| ridge.coefficient(i, 0);
    let mut out = windows.mean(target.column, target.column);
    for (i, &a) in target.regressors.iter().enumerate() {
        out -= 2.0 * x(i) * windows.mean(a, target.column);
        for (j, &b) in target.regressors.iter().enumerate() {
            out += x(i) * x(j) * windows.mean(a, b);
        }
    }
    out.max(0.0)
}

/// What drives each side follows from the motion, the yaw rate and the forward force from the wheels and their drives.
fn targets(grid: &Grid, shape: &Shape) -> Vec<Target> {
    let wheels = || SPEED.into_iter().chain(RATE).chain(DIRECTION).chain([ONE]);
    let product = |i: usize, j: usize| shape.product(i, j);
    let sensors = || grid.gyro.then_some(GYRO).into_iter().chain(ACCEL.into_iter().filter(|_| grid.accel));
    let turning = (0..2).flat_map(|j| [product(GYRO, DIRECTION[j]), product(GYRO, SPEED[j])]);
    let turning: Vec<usize> = turning.flatten().filter(|_| grid.gyro).collect();
    let speeds = (0..2).filter_map(|j| product(SPEED[j], DIRECTION[j]));
    let motion: Vec<usize> = wheels().chain(sensors()).chain(speeds).chain(turning).collect();
    let driven: Vec<usize> = wheels().chain(DRIVE).collect();
    let drives = DRIVE.into_iter().map(|column| Target { column, regressors: motion.clone() });
    let gyro = grid.gyro.then(|| Target { column: GYRO, regressors: driven.clone() });
    let accel = grid.accel.then(|| Target { column: ACCEL[0], regressors: driven.clone() });
    drives.chain(gyro).chain(accel).collect()
}
