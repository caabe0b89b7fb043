//! Drives of a car as the shared fit takes them.

use hierarchical_fit::CaseError as CarError;
use hierarchical_fit::{Data, Kind, Observed, Row, Solved, Spread};

use crate::car::Car;
use crate::cause::causes;
use crate::constant_table::constants;
use crate::constants::Constant;
use crate::drive::Drive;
use crate::model::Laws;
use crate::model::STEP;
use crate::rows::{POSE_ROWS, Shown};
use crate::settings::SETTINGS;

impl Observed for Shown<'_> {
    type Model = Vec<Constant>;

    const WINDOW: f64 = SETTINGS.windows.length;
    const FLOOR: [f64; 3] = SETTINGS.windows.floor;
    const NEAR: f64 = SETTINGS.windows.near;
    const HARDLY: f64 = SETTINGS.unexplained.hardly;

    fn name(&self) -> &str {
        &self.drive.name
    }

    fn seconds(&self) -> f64 {
        STEP * self.drive.steps() as f64
    }

    fn rows(&self) -> &[Row] {
        &self.rows
    }

    fn errors(&self, constants: &Vec<Constant>, theta: &[f64]) -> Vec<f64> {
        self.errors_of(&Laws::at(constants, theta))
    }

    fn columns(&self, constants: &Vec<Constant>, theta: &[f64]) -> Vec<Vec<f64>> {
        self.columns_of(constants, theta)
    }

    fn sizes(&self) -> Vec<f64> {
        self.ways()
    }

    fn judged_by(&self) -> Kind {
        if self.drive.has_pose() { Kind::Pose } else { Kind::Encoder }
    }

    fn apart(&self, kind: Kind) -> usize {
        if kind == Kind::Pose {
            return POSE_ROWS;
        }
        self.rows.iter().find(|r| r.kind == kind).map_or(1, |r| r.weight.recip().ceil() as usize)
    }
}

/// Drives with the constants of a car.
///
/// # Errors
/// When there is too little motion.
fn data<'a>(car: &Car, drives: &[&'a Drive]) -> Result<Data<Shown<'a>>, CarError> {
    let shown: Vec<Shown<'a>> = drives.iter().map(|d| Shown::new(d, car.encoder_window)).collect();
    let moving = |s: &Shown<'_>| s.rows.iter().filter(|r| r.is_moving && r.kind == Kind::Pose).count() / POSE_ROWS;
    let blind = |s: &Shown<'_>| if s.drive.has_pose() { 0 } else { s.windows.len() };
    let windows: usize = shown.iter().map(|s| moving(s) + blind(s)).sum();
    let (length, needed) = (SETTINGS.windows.length, SETTINGS.windows.least);
    if windows < needed {
        return Err(CarError::Short { windows, length, needed });
    }
    let constants = constants(car);
    let spread = |c: &Constant| Spread { sigma: c.sigma, usual: c.usual, scatter: c.scatter, bounds: c.bounds() };
    Ok(Data { spreads: constants.iter().map(spread).collect(), model: constants, drives: shown })
}

/// Fits drives and names causes.
pub(crate) fn solve<'a>(
    car: &Car,
    references: &'a [Drive],
    drives: &[&'a Drive],
) -> Result<Solved<Shown<'a>>, CarError> {
    let right = if references.is_empty() { None } else { Some(data(car, &references.iter().collect::<Vec<_>>())?) };
    let data = data(car, drives)?;
    let causes = causes(&data.model, right.is_some());
    let short = CarError::Short { windows: 0, length: SETTINGS.windows.length, needed: SETTINGS.windows.least };
    hierarchical_fit::solve(data, right.as_ref(), causes).ok_or(short)
}
