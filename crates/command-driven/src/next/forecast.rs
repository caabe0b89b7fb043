//! What a drive would show under each rival, and how well the others could imitate it.

use faer::Mat;
use inference::algebra::{inverse_spd, solve_spd};
use inference::expected_information::Forecast;
use verdict::Course;

use super::menu;
use super::rivals::Rival;
use crate::controller::free_run;
use crate::drive::DrivePart;
use crate::ground::{GroundPart, driven};
use crate::known::covariance;
use crate::run::{Piece, ResponseRun, STEP};
use crate::search::{Part, Trial, columns};
use crate::settings::SETTINGS;
use crate::windows::Windows;

/// Rivals with what the recordings say about their noise and their constants.
pub(super) struct Forecaster<'a> {
    pub(super) rivals: &'a [Rival],
    known: Vec<Known>,
    nominal: [f64; 2],
    has_position: bool,
    /// Unit of the residuals of wheel speeds, rad/s.
    unit: f64,
    /// Variance of the residuals of drive and ground, in their units.
    noise: [f64; 2],
}

/// Inverse covariance of a rival's constants: of the drive, of the ground.
struct Known {
    drive: Mat<f64>,
    ground: Mat<f64>,
}

/// A drive under all rivals.
pub(super) struct Differences {
    /// What it would say about all of them if a certain one were true.
    pub(super) forecasts: Vec<Forecast>,
    /// By truth and rival: rms difference of wheel speeds, rad/s, of the pose, m and rad together, in that order.
    pub(super) rms: Vec<Vec<[f64; 2]>>,
    /// Geometric mean of the sigmas of the first rival's constants after the drive over those before.
    pub(super) narrows: Option<f64>,
}

/// A part's differences between a truth and a rival over a drive.
struct Off {
    /// In units of the noise, every command step of weight one.
    rows: Vec<f64>,
    /// Sum of squares that the rival's constants cannot imitate.
    left: f64,
    /// In units of the residuals.
    rms: f64,
}

impl<'a> Forecaster<'a> {
    pub(super) fn new(windows: &Windows, rivals: &'a [Rival], nominal: [f64; 2]) -> Self {
        let part = DrivePart::new(windows, 0);
        let ground = GroundPart::measured(windows, nominal);
        let known = |r: &Rival| Known { drive: information(&part, &r.drive), ground: information(&ground, &r.ground) };
        // Twice the mean loss, which is half a square, of the rival that leaves least.
        let variance = |least: f64| (2.0 * least).max(SETTINGS.rivals.least_variance);
        let least = |loss: fn(&Rival) -> f64| rivals.iter().map(loss).fold(f64::INFINITY, f64::min);
        Self {
            rivals,
            known: rivals.iter().map(known).collect(),
            nominal,
            has_position: windows.pieces.iter().any(|p| p.position.is_some()),
            unit: part.unit,
            noise: [variance(least(|r| r.drive.level())), variance(least(|r| r.ground.level()))],
        }
    }

    /// What a drive along a course is expected to show.
    pub(super) fn differences(&self, course: &Course) -> Differences {
        let n = self.rivals.len();
        let mut out = Differences { forecasts: Vec::new(), rms: Vec::new(), narrows: None };
        for truth in self.rivals {
            let windows = Windows::new(&[self.followed(truth, course)]);
            let off: Vec<[Off; 2]> = (0..n).map(|l| self.off(l, &windows)).collect();
            let size: Vec<f64> = off.iter().map(|o| dot(o, o).sqrt()).collect();
            let alike = |a: usize, b: usize| {
                if size[a] * size[b] > 0.0 { dot(&off[a], &off[b]) / (size[a] * size[b]) } else { 0.0 }
            };
            let behind = off.iter().map(|[drive, ground]| score(drive.left + ground.left)).collect();
            out.forecasts.push(Forecast::new(behind, alike));
            out.rms.push(
                off.iter()
                    .map(|[drive, ground]| [drive.rms * self.unit, ground.rms * SETTINGS.residuals.pose])
                    .collect(),
            );
        }
        out.narrows = self.narrows(course);
        out
    }

    /// What would be recorded if a rival were true: from rest, on commands along the course, without noise.
    fn followed(&self, rival: &Rival, course: &Course) -> ResponseRun {
        let length = course.points.last().map_or(0.0, |p| p[0]);
        let rows = (length / STEP).round() as usize;
        let command: Vec<[f64; 2]> =
            (0..rows).map(|i| menu::wheels(course.at(i as f64 * STEP), self.nominal)).collect();
        let at_rest = vec![[0.0; 2]; rows];
        let mut piece = Piece {
            start: 0.0,
            command,
            within: None,
            wheel: at_rest,
            heading: None,
            integrated: false,
            position: None,
        };
        piece.wheel = free_run(rival.drive.model.law, &rival.drive.model.x, &piece);
        let poses = driven(&rival.ground.model.x, self.nominal, &piece.wheel);
        piece.heading = Some(poses.iter().map(|p| p[2]).collect());
        piece.position = self.has_position.then(|| poses.iter().map(|p| [p[0], p[1]]).collect());
        ResponseRun { name: String::new(), pieces: vec![piece], gyro_share: None, hold: 0.0 }
    }

    /// How far a rival's forecasts of these windows are off.
    fn off(&self, rival: usize, windows: &Windows) -> [Off; 2] {
        let (r, known) = (&self.rivals[rival], &self.known[rival]);
        let mut drive = DrivePart::new(windows, 0);
        drive.unit = self.unit;
        let ground = GroundPart::measured(windows, self.nominal);
        [off(&drive, &r.drive, &known.drive, self.noise[0]), off(&ground, &r.ground, &known.ground, self.noise[1])]
    }

    /// How much a drive narrows the constants of the first rival, if it has any.
    fn narrows(&self, course: &Course) -> Option<f64> {
        let (first, known) = (self.rivals.first()?, self.known.first()?);
        let windows = Windows::new(&[self.followed(first, course)]);
        let mut drive = DrivePart::new(&windows, 0);
        drive.unit = self.unit;
        let ground = GroundPart::measured(&windows, self.nominal);
        let ratios = [
            narrowed(&drive, &first.drive, &known.drive, self.noise[0])?,
            narrowed(&ground, &first.ground, &known.ground, self.noise[1])?,
        ]
        .concat();
        (!ratios.is_empty()).then(|| (ratios.iter().map(|r| r.ln()).sum::<f64>() / ratios.len() as f64).exp())
    }
}

/// Inverse covariance of a rival's constants; those of a part that its windows do not determine are known to their scale.
fn information<P: Part>(part: &P, t: &Trial<P::Law>) -> Mat<f64> {
    let scale = |i: usize| part.constants()[t.free[i]].scale;
    let n = t.free.len();
    let by_scale = || Mat::from_fn(n, n, |i, j| if i == j { scale(i).powi(-2) } else { 0.0 });
    covariance(part, t).and_then(|c| inverse_spd(&c)).unwrap_or_else(by_scale)
}

/// Fall of a rival's score from squared differences in units of the noise: `½ z²` with z = ½ Δ² / (σ Δ), the rise of a
/// step's loss over its deviation (that of [`crate::search::evidence`]).
fn score(squares: f64) -> f64 {
    let squared_z = 0.25 * squares;
    0.5 * squared_z
}

/// Weight of every row, so that each command step weighs one over the variance: its windows are not independent.
fn weights(windows: &Windows, rows: usize, variance: f64) -> Vec<f64> {
    let mut of_block = vec![0.0; windows.blocks];
    windows.list.iter().for_each(|w| of_block[w.block] += rows as f64);
    let all = windows.list.iter().flat_map(|w| std::iter::repeat_n(1.0 / (of_block[w.block] * variance), rows));
    all.map(f64::sqrt).collect()
}

/// Differences and derivatives by the free constants, weighted.
fn weighted<P: Part>(part: &P, t: &Trial<P::Law>, variance: f64) -> (Vec<f64>, Mat<f64>, f64) {
    let windows = part.windows();
    let r = part.residuals(t.model.law, &t.model.x);
    let weights = weights(windows, r.len() / windows.list.len(), variance);
    let columns = columns(part, &t.model, &t.free, &r);
    let slopes = Mat::from_fn(r.len(), t.free.len(), |i, c| weights[i] * columns[c][i]);
    let rms = (r.iter().map(|r| r * r).sum::<f64>() / r.len() as f64).sqrt();
    (r.iter().zip(&weights).map(|(r, w)| r * w).collect(), slopes, rms)
}

/// `Δᵀ W Δ − bᵀ (Sᵀ W S + P⁻¹)⁻¹ b` with `b = Sᵀ W Δ`: what is left when the constants move as far as they may.
fn off<P: Part>(part: &P, t: &Trial<P::Law>, known: &Mat<f64>, variance: f64) -> Off {
    let (rows, slopes, rms) = weighted(part, t, variance);
    let whole: f64 = rows.iter().map(|r| r * r).sum();
    let column = Mat::from_fn(rows.len(), 1, |i, _| rows[i]);
    let b = slopes.transpose() * &column;
    let imitated =
        solve_spd(&(slopes.transpose() * &slopes + known), &b).map_or(0.0, |(x, _)| (b.transpose() * x)[(0, 0)]);
    Off { rows, left: (whole - imitated).max(0.0), rms }
}

/// Sigma after over before of every free constant.
fn narrowed<P: Part>(part: &P, t: &Trial<P::Law>, known: &Mat<f64>, variance: f64) -> Option<Vec<f64>> {
    let (_, slopes, _) = weighted(part, t, variance);
    let before = inverse_spd(known)?;
    let after = inverse_spd(&(slopes.transpose() * &slopes + known))?;
    Some((0..t.free.len()).map(|i| (after[(i, i)] / before[(i, i)]).sqrt()).collect())
}

fn dot(a: &[Off; 2], b: &[Off; 2]) -> f64 {
    a.iter().zip(b).flat_map(|(a, b)| a.rows.iter().zip(&b.rows)).map(|(a, b)| a * b).sum()
}
