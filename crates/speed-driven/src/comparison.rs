//! Loads of the recordings against those of the references: what they weigh, and what effects make of them.

use faer::Mat;
use inference::algebra::{inverse_spd, solve_spd, whitening};
use inference::evidence::price_of_a_constant;
use inference::hypothesis::{Dose, Free, Sizes, Variant};
use inference::least_squares::{Constant, Residuals, Settings};
use inference::robust::mean;
use robot_model::Robot;
use robot_model::tunable::{COUNT as NUISANCES, tuned};
use verdict::{Load, Quantity, Ratio, SideDrift};

use crate::compare::{Reference, matching, scaled, scatter};
use crate::drift::Drift;
use crate::ground::{self, Track};
use crate::model::{Measured, Operating, Tuned, predicted, sensitivity};
use crate::name::{Difference, Named, doses, price};
use crate::settings::NAMING;
use crate::settings::naming::{EffectFits, Priors};

const PRIORS: Priors = NAMING.priors;
const EFFECTS: EffectFits = NAMING.effects;

/// Covariance of the differences: own errors, errors of shared references, the unnamed variation of the straight
/// load, and what re-tuning the model could change.
fn covariance(d: &[Difference], robot: &Robot<f64>, sigma: &[f64; NUISANCES], calibrated: &Tuned) -> Mat<f64> {
    let here: Vec<Operating> = d.iter().map(|d| d.here.at).collect();
    let there: Vec<Operating> = d.iter().map(|d| d.reference.at).collect();
    let j = sensitivity(robot, sigma, &calibrated.theta, &here) - sensitivity(robot, sigma, &calibrated.theta, &there);
    let tuning = &j * &calibrated.covariance * j.transpose();
    let unnamed = (PRIORS.unnamed_straight.ln() / inference::robust::NINETY).powi(2);
    Mat::from_fn(d.len(), d.len(), |a, b| {
        let (x, y) = (&d[a], &d[b]);
        let same = x.here.at.quantity == y.here.at.quantity;
        let mut c = tuning[(a, b)];
        if a == b {
            c += x.here.error.powi(2) + scatter(x.here.at.quantity).powi(2);
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

/// Differences, what they weigh and what the model says of them.
pub(crate) struct Comparison {
    differences: Vec<Difference>,
    track: Option<Track>,
    pub(crate) drift: Option<Drift>,
    /// What the loads leave with the drift's wheels on the left and on the right, nats; the better of them is in all hypotheses.
    pub(crate) by_side: [f64; 2],
    base: Vec<Dose>,
    model: Robot<f64>,
    weight: Mat<f64>,
    whitening: Mat<f64>,
    measured: Vec<f64>,
    /// Predictions at the references' operating points.
    there: Vec<f64>,
    /// Residuals without any effect.
    plain: Vec<f64>,
}

impl Comparison {
    pub(crate) fn new(
        differences: &[Difference],
        robot: &Robot<f64>,
        sigma: &[f64; NUISANCES],
        calibrated: &Tuned,
    ) -> Option<Self> {
        let model = tuned(robot, sigma, &calibrated.theta);
        let drift = Drift::of(differences);
        let of = |is_of_it: &dyn Fn(&Difference) -> bool| {
            let is_load = |d: &&Difference| !d.is_track() && d.here.at.quantity != Quantity::Drift && is_of_it(d);
            let loads: Vec<Difference> = differences.iter().filter(is_load).cloned().collect();
            let c = if loads.is_empty() { return None } else { covariance(&loads, robot, sigma, calibrated) };
            Some(Self {
                track: Track::of(&differences.iter().filter(|d| d.is_track()).collect::<Vec<_>>()),
                weight: inverse_spd(&c)?,
                whitening: whitening(&c)?,
                measured: loads.iter().map(|d| d.here.value - d.reference.value).collect(),
                there: loads.iter().map(|d| predicted(&model, &[], d.reference.at)).collect(),
                plain: Vec::new(),
                drift,
                by_side: [0.0; 2],
                base: Vec::new(),
                differences: loads,
                model,
            })
        };
        let mut out = of(&|_| true)?;
        if let Some(drift) = drift {
            let doses = [0, 1].map(|side| drift.dose(side).into_iter().collect::<Vec<Dose>>());
            let by_side = doses.each_ref().map(|doses| out.left(doses));
            let [left, right] = doses;
            let base = if by_side[0] < by_side[1] { left } else { right };
            // What they do to the sides' loads told the side; no law says it well enough to look for more there.
            out = Self { by_side, base, ..of(&|d| !d.is_of_sides())? };
        }
        out.plain = out.residual(&[]);
        Some(out)
    }

    /// What effects leave unexplained of the loads, nats.
    fn left(&self, doses: &[Dose]) -> f64 {
        let r = self.residual(doses);
        0.5 * self.quadratic(&r, &r)
    }

    /// A side whose wheels roll as if they had another radius.
    pub(crate) fn side_drift(&self) -> Option<SideDrift> {
        Some(self.drift?.told(self.by_side))
    }

    fn residual(&self, doses: &[Dose]) -> Vec<f64> {
        let doses = &[&self.base, doses].concat();
        let expected =
            self.differences.iter().zip(&self.there).map(|(d, t)| predicted(&self.model, doses, d.here.at) - t);
        self.measured.iter().zip(expected).map(|(m, e)| m - e).collect()
    }

    /// What an answer expects of the difference that a recording's ratio shows; `None` where it is not compared.
    pub(crate) fn expected(&self, named: &Named, shown: &Ratio) -> Option<f64> {
        let is_it = |d: &Difference| {
            let at = d.here.at;
            d.recording == shown.recording && at.quantity == shown.quantity && at.speed == shown.speed
        };
        let found = self.differences.iter().position(is_it)?;
        Some(self.measured[found] - self.residual(&named.doses())[found])
    }

    fn quadratic(&self, a: &[f64], b: &[f64]) -> f64 {
        (0..a.len()).map(|i| (0..b.len()).map(|k| a[i] * self.weight[(i, k)] * b[k]).sum::<f64>()).sum()
    }

    /// Whether a medium size of any of these effects shows in the loads at `values`.
    fn shows(&self, parts: &[Variant], free: &[(&Variant, Free)], values: &[f64]) -> bool {
        let r = self.residual(&doses(parts, values));
        (0..free.len()).any(|i| {
            let mut shifted = values.to_vec();
            shifted[i] += EFFECTS.shift * free[i].1.unit;
            let moved = self.residual(&doses(parts, &shifted));
            let column: Vec<f64> = moved.iter().zip(&r).map(|(a, b)| (a - b) / EFFECTS.shift).collect();
            self.quadratic(&column, &column) >= EFFECTS.least_response
        })
    }

    /// Fits the same causes again.
    pub(crate) fn refit(&self, named: &Named) -> Option<Named> {
        if named.is_soft_ground { self.soft_ground() } else { self.fit(&named.parts, None) }
    }

    /// What the effective track leaves unexplained without any effect, nats.
    fn plain_track(&self) -> f64 {
        self.track.as_ref().map_or(0.0, Track::plain)
    }

    /// Soft ground: harder rolling, and turning that costs no more beyond that.
    pub(crate) fn soft_ground(&self) -> Option<Named> {
        let both = ground::parts()?;
        // Rolling that its own error may be is no ground that gives way.
        let rolls = |named: &Named| named.values[0] > named.sigma[0];
        let gives_way = |named: &Named| match named.values[..] {
            [_, turning] => rolls(named) && turning <= 0.0,
            [_] => rolls(named),
            _ => false,
        };
        let fitted =
            self.fit(&both, None).filter(gives_way).or_else(|| self.fit(&both[..1], None).filter(gives_way))?;
        // One cause, whatever the number of its effects; the track is its own.
        let singly: f64 = fitted.parts.iter().map(price).sum();
        let of_track = |named: &Named| self.track.as_ref().map_or(0.0, |t| t.misfit(&self.model, &named.doses()));
        let by_track = of_track(&fitted) - self.track.as_ref().map_or(0.0, Track::on_soft_ground);
        let gain = fitted.gain + by_track;
        Some(Named { is_soft_ground: true, score: fitted.score + by_track + singly - price(&both[0]), gain, ..fitted })
    }

    /// Fits the free values of one or two effects from their neutral values (or from `start`).
    pub(crate) fn fit(&self, parts: &[Variant], start: Option<&[f64]>) -> Option<Named> {
        let sizes = Sizes { robot: Some(self.model), ..Sizes::default() };
        let of_parts: Vec<Vec<Free>> = parts.iter().map(|v| v.free(&sizes)).collect();
        let free: Vec<(&Variant, Free)> =
            parts.iter().zip(&of_parts).flat_map(|(v, free)| free.iter().map(move |f| (v, *f))).collect();
        let constant = |(i, (v, f)): (usize, &(&Variant, Free))| {
            let neutral = f.parameter.map_or(f.usual, |i| v.spec().parameters[i].neutral);
            let begin = start.and_then(|s| s.get(i)).copied().unwrap_or(neutral);
            let width = PRIORS.plausible * f.unit;
            let constant = Constant::new(begin.clamp(f.bounds[0], f.bounds[1]), f.unit);
            let (longest, difference, ridge) = (width / f.unit, EFFECTS.shift, EFFECTS.ridge);
            Constant { longest, difference, ridge, ..constant.within(f.bounds[0], f.bounds[1]).known(neutral, width) }
        };
        let constants: Vec<Constant> = free.iter().enumerate().map(constant).collect();
        let begin: Vec<f64> = constants.iter().map(|c| c.start).collect();
        if !self.shows(parts, &free, &begin) {
            return None;
        }

        let settings = Settings {
            iterations: EFFECTS.steps,
            least_fall: EFFECTS.least_gain,
            least_relative_fall: 0.0,
            ..Settings::gauss_newton()
        };
        let misfit = |values: &[f64]| self.whitened(&self.residual(&doses(parts, values)));
        let fitted = Residuals::new(constants, misfit).fit(&settings).ok()?;
        if fitted.covariance.is_none() || !self.shows(parts, &free, &fitted.values) {
            return None;
        }

        // Price of the free numbers: how far the data narrow them down from what was plausible before.
        let paid = fitted.occam() + parts.iter().map(price).sum::<f64>();
        let of_track = self.track.as_ref().map_or(0.0, |t| t.misfit(&self.model, &doses(parts, &fitted.values)));
        let gain = 0.5 * self.quadratic(&self.plain, &self.plain) - fitted.cost + self.plain_track() - of_track;
        let sigma = (0..fitted.values.len()).map(|i| fitted.sigma(i)).collect();
        let (parts, values, score) = (parts.to_vec(), fitted.values, gain - paid);
        Some(Named { parts, is_soft_ground: false, values, free: of_parts, sigma, score, gain })
    }

    /// Residuals of unit variance that do not go together.
    fn whitened(&self, r: &[f64]) -> Vec<f64> {
        (0..r.len()).map(|i| (0..=i).map(|k| self.whitening[(i, k)] * r[k]).sum()).collect()
    }

    /// Evidence for a factor of its own for each quantity, which nothing ties together. What the best effect may leave is
    /// nothing unknown: a factor costs no less than a number of that effect, and there must be more factors than these.
    pub(crate) fn unknown(&self, best: Option<&Named>) -> Option<f64> {
        let mut quantities: Vec<Quantity> = self.differences.iter().map(|d| d.here.at.quantity).collect();
        quantities.sort_unstable();
        quantities.dedup();
        let (n, m) = (self.differences.len(), quantities.len());
        if best.is_some_and(|b| m <= b.values.len()) {
            return Some(f64::NEG_INFINITY);
        }
        let a = Mat::from_fn(n, m, |i, q| f64::from(self.differences[i].here.at.quantity == quantities[q]));
        let r = Mat::from_fn(n, 1, |i, _| self.plain[i]);
        let g = a.transpose() * &self.weight * &r;
        let (x, _) = solve_spd(&(a.transpose() * &self.weight * &a), &g)?;
        let explained = (0..m).map(|q| 0.5 * x[(q, 0)] * g[(q, 0)]).sum::<f64>() + self.plain_track();
        let named = best.map_or(0.0, |b| (b.gain - b.score) / b.values.len().max(1) as f64);
        Some(explained - (price_of_a_constant(n) + PRIORS.per_unknown).max(named) * m as f64)
    }
}

/// The slope that would change the straight load as it differs, rad, uphill positive; `weight` is `m g r`, N m.
pub(crate) fn slope_of_all(differences: &[Difference], weight: f64) -> Option<f64> {
    let straight = differences.iter().filter(|d| d.here.at.quantity == Quantity::StraightLoad);
    mean(straight.map(|d| d.here.value.exp() - d.reference.value.exp()))
        .map(|more| (more / weight).clamp(-1.0, 1.0).asin())
}

/// A reference as it was measured.
pub(crate) fn of_reference(r: &Reference) -> Measured {
    Measured { at: r.at(), value: r.centre, error: r.error }
}

/// Every load less its reference. A sum of arcs is used only where the turning load itself is not known.
pub(crate) fn differences(loads: &[Load], refs: &[Reference]) -> Vec<Difference> {
    loads
        .iter()
        .filter(|l| {
            l.quantity != Quantity::ArcSum
                || !loads.iter().any(|o| o.recording == l.recording && o.quantity == Quantity::TurningLoad)
        })
        .filter_map(|l| {
            let (r, _) = matching(l, refs)?;
            let (value, error) = scaled(l);
            let at = Operating::of(l);
            Some(Difference {
                recording: l.recording.clone(),
                here: Measured { at, value, error },
                reference: of_reference(r),
            })
        })
        .collect()
}
