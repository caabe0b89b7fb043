//! Which effects could make the loads differ as they do.

use faer::Mat;
use robot_model::Robot;
use robot_model::effect::Role;
use robot_model::tunable::COUNT as NUISANCES;

use crate::fit::tuned;
use crate::hypothesis::{Place, Variant, variants};
use crate::linalg::solve_spd;
use crate::simulate::Dose;
use crate::steady::extract::Quantity;
use crate::steady::model::{Measured, Operating, Tuned, predicted, sensitivity};

/// One difference between a recording and the references, on the comparison scale.
#[derive(Debug, Clone)]
pub(crate) struct Difference {
    pub(crate) recording: String,
    pub(crate) here: Measured,
    pub(crate) reference: Measured,
}

/// An effect fitted to the differences.
#[derive(Clone)]
pub(crate) struct Named {
    pub(crate) variant: Variant,
    /// Free values of the effect.
    pub(crate) values: Vec<f64>,
    pub(crate) sigma: f64,
    /// Log evidence over "nothing is missing", nats.
    pub(crate) score: f64,
}

/// The comparison of all hypotheses.
pub(crate) struct Naming {
    /// Best first.
    pub(crate) effects: Vec<Named>,
    /// Evidence of free factors, one per quantity, that no effect ties together.
    pub(crate) unknown: f64,
    /// Half the squared differences that no effect explains.
    pub(crate) misfit: f64,
}

/// The straight load of a drive train varies by up to this factor (90 %) between days without a cause that these
/// signals could name: cold grease, tyre pressure.
const UNNAMED_STRAIGHT: f64 = 1.45;
/// Price of naming an effect, and of "unknown", nats.
const PER_EFFECT: f64 = 3.0;
const PER_UNKNOWN: f64 = 4.0;
const STEPS: usize = 8;

/// Covariance of the differences: own errors, errors of shared references, the unnamed variation of the straight
/// load, and what re-tuning the model could change.
fn covariance(d: &[Difference], robot: &Robot<f64>, sigma: &[f64; NUISANCES], calibrated: &Tuned) -> Mat<f64> {
    let here: Vec<Operating> = d.iter().map(|d| d.here.at).collect();
    let there: Vec<Operating> = d.iter().map(|d| d.reference.at).collect();
    let j = sensitivity(robot, sigma, &calibrated.theta, &here) - sensitivity(robot, sigma, &calibrated.theta, &there);
    let tuning = &j * &calibrated.covariance * j.transpose();
    let unnamed = (UNNAMED_STRAIGHT.ln() / crate::steady::compare::NINETY).powi(2);
    Mat::from_fn(d.len(), d.len(), |a, b| {
        let (x, y) = (&d[a], &d[b]);
        let same = x.here.at.quantity == y.here.at.quantity;
        let mut c = tuning[(a, b)];
        if a == b {
            c += x.here.error.powi(2) + x.here.at.quantity.scatter().powi(2);
        }
        if same && x.reference.value == y.reference.value {
            c += x.reference.error.powi(2);
        }
        // A cold drive train loads every straight drive of its day.
        if same && x.here.at.quantity == Quantity::StraightLoad && x.recording == y.recording {
            c += unnamed;
        }
        c
    })
}

fn dose(v: &Variant, e: &[f64]) -> Vec<Dose> {
    vec![v.dose(e, None)]
}

/// Weighs every effect that can be present everywhere against the differences.
pub(crate) fn name(
    d: &[Difference],
    robot: &Robot<f64>,
    sigma: &[f64; NUISANCES],
    calibrated: &Tuned,
) -> Option<Naming> {
    let n = d.len();
    let model = tuned(robot, sigma, &calibrated.theta);
    let c = covariance(d, robot, sigma, calibrated);
    let weight = solve_spd(&c, &Mat::identity(n, n))?.0;
    let measured: Vec<f64> = d.iter().map(|d| d.here.value - d.reference.value).collect();
    let there: Vec<f64> = d.iter().map(|d| predicted(&model, &[], d.reference.at)).collect();
    let difference = |doses: &[Dose]| -> Vec<f64> {
        d.iter().zip(&there).map(|(d, t)| predicted(&model, doses, d.here.at) - t).collect()
    };
    let quadratic = |a: &[f64], b: &[f64]| -> f64 {
        (0..n).map(|i| (0..n).map(|k| a[i] * weight[(i, k)] * b[k]).sum::<f64>()).sum()
    };
    let plain: Vec<f64> = measured.iter().zip(difference(&[])).map(|(m, p)| m - p).collect();
    let misfit = 0.5 * quadratic(&plain, &plain);
    let price = 0.5 * (n as f64).max(2.0).ln();
    let mut effects: Vec<Named> = variants()
        .into_iter()
        .filter(|v| matches!(v.place, Place::Whole | Place::Side(_)))
        // Shapes speak of how an effect comes and goes; steady loads cannot tell them.
        .filter(|v| v.card().parameters.iter().all(|p| p.role != Role::Shape))
        .filter_map(|v| fit(&v, &measured, &plain, &difference, &quadratic).map(|(e, sigma, left)| (v, e, sigma, left)))
        .map(|(v, e, sigma, left)| {
            let numbers = v.free(1.0).len() as f64;
            Named { variant: v, values: e, sigma, score: misfit - left - price * numbers - PER_EFFECT }
        })
        .collect();
    effects.sort_by(|a, b| b.score.total_cmp(&a.score));
    // Unknown: each quantity has a factor of its own that nothing ties together.
    let mut quantities: Vec<Quantity> = d.iter().map(|d| d.here.at.quantity).collect();
    quantities.sort_unstable();
    quantities.dedup();
    let m = quantities.len();
    let a = Mat::from_fn(n, m, |i, q| f64::from(d[i].here.at.quantity == quantities[q]));
    let normal = a.transpose() * &weight * &a;
    let r = Mat::from_fn(n, 1, |i, _| plain[i]);
    let g = a.transpose() * &weight * &r;
    let (x, _) = solve_spd(&normal, &g)?;
    let explained: f64 = (0..m).map(|q| 0.5 * x[(q, 0)] * g[(q, 0)]).sum();
    Some(Naming { effects, unknown: explained - price * m as f64 - PER_UNKNOWN, misfit })
}

/// Gauss–Newton on the free values of one effect: values, sigma of the first, half the squares that are left.
fn fit(
    v: &Variant,
    measured: &[f64],
    plain: &[f64],
    difference: &dyn Fn(&[Dose]) -> Vec<f64>,
    quadratic: &dyn Fn(&[f64], &[f64]) -> f64,
) -> Option<(Vec<f64>, f64, f64)> {
    let free = v.free(1.0);
    let mut e: Vec<f64> =
        free.iter().map(|f| f.parameter.map_or(f.usual, |i| v.card().parameters[i].neutral)).collect();
    let residual =
        |e: &[f64]| -> Vec<f64> { measured.iter().zip(difference(&dose(v, e))).map(|(m, p)| m - p).collect() };
    let mut r = plain.to_vec();
    let mut left = 0.5 * quadratic(&r, &r);
    let mut sigma = f64::INFINITY;
    for _ in 0..STEPS {
        let columns: Vec<Vec<f64>> = free
            .iter()
            .enumerate()
            .map(|(i, f)| {
                let mut shifted = e.clone();
                let h = 0.1 * f.unit;
                shifted[i] += h;
                residual(&shifted).iter().zip(&r).map(|(a, b)| (b - a) / h * f.unit).collect()
            })
            .collect();
        let k = columns.len();
        let m = Mat::from_fn(k, k, |a, b| quadratic(&columns[a], &columns[b]) + if a == b { 1e-6 } else { 0.0 });
        if m[(0, 0)] < 1e-3 {
            return None;
        }
        let g = Mat::from_fn(k, 1, |a, _| quadratic(&columns[a], &r));
        let (step, _) = solve_spd(&m, &g)?;
        sigma = m[(0, 0)].powf(-0.5) * free[0].unit;
        let mut share = 1.0;
        let mut moved = false;
        for _ in 0..6 {
            let next: Vec<f64> = e
                .iter()
                .zip(&free)
                .enumerate()
                .map(|(i, (e, f))| (e + share * step[(i, 0)].clamp(-3.0, 3.0) * f.unit).clamp(f.bounds[0], f.bounds[1]))
                .collect();
            let r2 = residual(&next);
            let left2 = 0.5 * quadratic(&r2, &r2);
            if left2 < left {
                moved = left - left2 > 1e-3;
                (e, r, left) = (next, r2, left2);
                break;
            }
            share *= 0.5;
        }
        if !moved {
            break;
        }
    }
    Some((e, sigma, left))
}
