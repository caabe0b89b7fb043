//! The constants of a robot model that may be re-tuned: the nuisance parameters of a diagnosis.

use crate::robot::Robot;
use crate::scalar::Scalar;

/// How a tuning acts on its constant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tuning {
    /// Multiplies by `exp(δ)`.
    Factor,
    /// Adds `δ`.
    Offset,
}

/// One constant of a robot model that the user does not know exactly.
#[derive(Debug, Clone, Copy)]
pub struct Tunable<T: Scalar> {
    /// Identifier, as in robot files.
    pub id: &'static str,
    /// Place in vectors of tunings, from 0 without gaps: what was fitted before keeps its place.
    pub order: usize,
    /// Factor or offset.
    pub tuning: Tuning,
    /// Unit of an offset; "-" of a factor.
    pub unit: &'static str,
    /// One sigma when the robot file says nothing: relative for a factor, in `unit` for an offset.
    pub sigma: f64,
    /// Where this sigma comes from.
    pub source: &'static str,
    /// How far it moves from one visit (drives of one day, place and load) to another: one sigma, as a share of `sigma`.
    pub between_visits: f64,
    /// Applies the tuning `δ`.
    pub apply: Apply<T>,
}

/// Time constant below which a lag goes on as a lead, s.
pub(crate) const LEAST_LAG: f64 = 1e-3;

/// Number of tunable constants.
pub const COUNT: usize = count();

/// Applies a tuning to a robot.
pub type Apply<T> = fn(&mut Robot<T>, T);

/// All tunable constants, each at its place.
pub fn tunables<T: Scalar>() -> [Tunable<T>; COUNT] {
    const { in_order::<T>() }
}

/// Place of a constant in vectors of tunings, by its id; `None` if no tunable constant is called so.
pub const fn place_of(id: &str) -> Option<usize> {
    let (table, mut row) = (Robot::<f64>::CONSTANTS, 0);
    while row < table.len() {
        if let Some(tunable) = table[row].tuning
            && is_same(tunable.id, id)
        {
            return Some(tunable.order);
        }
        row += 1;
    }
    None
}

/// Whether two texts are the same; `==` is not for constants.
const fn is_same(a: &str, b: &str) -> bool {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    let mut i = 0;
    while i < a.len() && i < b.len() && a[i] == b[i] {
        i += 1;
    }
    i == a.len() && i == b.len()
}

const fn count() -> usize {
    let (table, mut count, mut row) = (Robot::<f64>::CONSTANTS, 0, 0);
    while row < table.len() {
        if table[row].tuning.is_some() {
            count += 1;
        }
        row += 1;
    }
    count
}

/// Of a table in which two have one place, or a place is left out, does not compile.
const fn in_order<T: Scalar>() -> [Tunable<T>; COUNT] {
    let (table, mut out, mut row) = (Robot::<T>::CONSTANTS, [None; COUNT], 0);
    while row < table.len() {
        if let Some(tunable) = table[row].tuning {
            assert!(out[tunable.order].is_none(), "two constants have the same place in vectors of tunings");
            out[tunable.order] = Some(tunable);
        }
        row += 1;
    }
    let [Some(first), ..] = out else { panic!("no constant has the first place in vectors of tunings") };
    let (mut all, mut place) = ([first; COUNT], 0);
    while place < COUNT {
        if let Some(tunable) = out[place] {
            all[place] = tunable;
        }
        place += 1;
    }
    all
}

/// Noise of a pose sensor when nothing better is known, m: motion capture and total stations (guess).
pub const USUAL_POSE_SIGMA: f64 = 0.004;

/// One sigma of every tunable constant when nothing better is known.
pub fn usual_sigma() -> [f64; COUNT] {
    tunables::<f64>().map(|t| t.sigma)
}

/// The robot with its constants tuned by `theta`, in sigmas.
pub fn tuned(robot: &Robot<f64>, sigma: &[f64; COUNT], theta: &[f64; COUNT]) -> Robot<f64> {
    let mut out = *robot;
    for ((t, s), x) in tunables::<f64>().iter().zip(sigma).zip(theta) {
        (t.apply)(&mut out, s * x);
    }
    out
}
