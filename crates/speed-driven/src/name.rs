//! Which effects could make the loads differ as they do.

use std::collections::HashSet;

use catalogue::speed_driven::SOFT_GROUND;
use faer::Mat;
use inference::algebra::{inverse_spd, whitening};
use inference::evidence::price_of_a_constant;
use inference::least_squares::{Constant, Residuals, Settings};
use rayon::prelude::*;
use robot_model::Robot;
use robot_model::effect::Role;
use robot_model::effects::grade;
use robot_model::tunable::COUNT as NUISANCES;
use verdict::{Quantity, Ratio};

use crate::compare::scatter;
use crate::ground::{self, Track};
use crate::model::{Measured, Operating, Tuned, predicted, sensitivity};
use crate::settings::NAMING;
use crate::settings::naming::{EffectFits, Priors};
use inference::algebra::solve_spd;
use inference::hypothesis::{Dose, Sizes};
use inference::hypothesis::{Free, Place, Variant, variants};
use robot_model::tunable::tuned;

const PRIORS: Priors = NAMING.priors;
const EFFECTS: EffectFits = NAMING.effects;

/// Price of naming an effect, nats.
fn price(v: &Variant) -> f64 {
    let spec = v.spec();
    PRIORS.per_effect + spec.rarity + if catalogue::needs_a_hand(spec.id) { PRIORS.by_hand } else { 0.0 }
}

/// One difference between a recording and the references, on the comparison scale.
#[derive(Debug, Clone)]
pub(crate) struct Difference {
    pub(crate) recording: String,
    pub(crate) here: Measured,
    pub(crate) reference: Measured,
}

impl Difference {
    pub(crate) fn is_track(&self) -> bool {
        self.here.at.quantity == Quantity::EffectiveTrack
    }
}

/// One or two effects fitted to the differences, or soft ground.
#[derive(Clone)]
pub(crate) struct Named {
    pub(crate) parts: Vec<Variant>,
    /// Whether its effects are those of soft ground, one cause together.
    pub(crate) is_soft_ground: bool,
    /// Free values of each effect in turn.
    pub(crate) values: Vec<f64>,
    /// What of each effect may change, in the sizes of this robot.
    pub(crate) free: Vec<Vec<Free>>,
    /// One sigma of each free value.
    pub(crate) sigma: Vec<f64>,
    /// Log evidence over "nothing is missing", nats.
    pub(crate) score: f64,
    /// What it explains of the differences before its price, nats.
    pub(crate) gain: f64,
}

impl Named {
    /// Free values and sigmas of one of its effects.
    pub(crate) fn of(&self, part: usize) -> (&[f64], &[f64]) {
        let before: usize = self.parts[..part].iter().map(Variant::count).sum();
        let n = self.parts[part].count();
        (&self.values[before..before + n], &self.sigma[before..before + n])
    }

    pub(crate) fn doses(&self) -> Vec<Dose> {
        doses(&self.parts, &self.values)
    }

    /// Ids of its causes: its effects in the order of the parts, or soft ground.
    pub(crate) fn ids(&self) -> Vec<&'static str> {
        if self.is_soft_ground { vec![SOFT_GROUND.id] } else { self.effects().collect() }
    }

    /// Ids of its effects, also of those that are one cause together.
    pub(crate) fn effects(&self) -> impl Iterator<Item = &'static str> {
        self.parts.iter().map(|v| v.spec().id)
    }

    /// How many causes it names.
    pub(crate) fn causes(&self) -> usize {
        if self.is_soft_ground { 1 } else { self.parts.len() }
    }

    /// Its causes for people.
    pub(crate) fn name(&self) -> String {
        if self.is_soft_ground { SOFT_GROUND.name.to_owned() } else { inference::words::variants(&self.parts) }
    }
}

fn doses(parts: &[Variant], values: &[f64]) -> Vec<Dose> {
    let mut at = 0;
    parts
        .iter()
        .map(|v| {
            let n = v.count();
            at += n;
            v.dose(&values[at - n..at], None)
        })
        .collect()
}

/// The comparison of all hypotheses.
pub(crate) struct Naming {
    /// Best first.
    pub(crate) effects: Vec<Named>,
    /// Evidence of free factors, one per quantity, that no effect ties together.
    pub(crate) unknown: f64,
}

impl Naming {
    /// The best of each set of effects, best first: left and right are one cause.
    pub(crate) fn causes(&self) -> Vec<&Named> {
        let mut seen = HashSet::new();
        let is_new = |e: &&Named| {
            let mut ids = e.ids();
            ids.sort_unstable();
            seen.insert(ids)
        };
        self.effects.iter().filter(is_new).collect()
    }
}

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
        let (tracks, loads): (Vec<&Difference>, Vec<&Difference>) = differences.iter().partition(|d| d.is_track());
        let differences: Vec<Difference> = loads.into_iter().cloned().collect();
        if differences.is_empty() {
            return None;
        }
        let c = covariance(&differences, robot, sigma, calibrated);
        let mut out = Self {
            track: Track::of(&tracks),
            weight: inverse_spd(&c)?,
            whitening: whitening(&c)?,
            measured: differences.iter().map(|d| d.here.value - d.reference.value).collect(),
            there: differences.iter().map(|d| predicted(&model, &[], d.reference.at)).collect(),
            plain: Vec::new(),
            differences,
            model,
        };
        out.plain = out.residual(&[]);
        Some(out)
    }

    fn residual(&self, doses: &[Dose]) -> Vec<f64> {
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
    fn soft_ground(&self) -> Option<Named> {
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
    fn unknown(&self, best: Option<&Named>) -> Option<f64> {
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

/// Which causes are open.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Open {
    /// Nobody touched the robot: only what needs no hand on it.
    pub(crate) same_robot: bool,
    /// All straight driving is at one place in one heading, so that one slope may be under all of it.
    pub(crate) one_slope: bool,
}

/// Weighs every effect that can be present everywhere, every pair with one of the best, and soft ground against the
/// differences.
pub(crate) fn name(comparison: &Comparison, open: Open) -> Option<Naming> {
    let candidates: Vec<Variant> = variants(true)
        .into_iter()
        .filter(|v| matches!(v.place, Place::Whole | Place::Side(_)))
        // Shapes speak of how an effect comes and goes; steady loads cannot tell them.
        .filter(|v| v.spec().parameters.iter().all(|p| p.role != Role::Shape))
        .filter(|v| open.one_slope || v.spec().id != grade::SPEC.id)
        .filter(|v| !open.same_robot || !catalogue::needs_a_hand(v.spec().id))
        .collect();
    let mut singles: Vec<Named> = candidates.par_iter().filter_map(|v| comparison.fit(&[*v], None)).collect();
    best_first(&mut singles);
    let able: Vec<Variant> = singles.iter().map(|s| s.parts[0]).collect();
    let mut firsts: Vec<&Named> = Vec::new();
    for s in &singles {
        if firsts.len() < EFFECTS.firsts && !firsts.iter().any(|f| f.ids() == s.ids()) {
            firsts.push(s);
        }
    }
    let tasks: Vec<(&Named, Variant)> = firsts
        .iter()
        .flat_map(|f| able.iter().filter(|v| v.spec().id != f.parts[0].spec().id).map(|v| (*f, *v)))
        .collect();
    let pairs: Vec<Named> =
        tasks.par_iter().filter_map(|(f, v)| comparison.fit(&[f.parts[0], *v], Some(&f.values))).collect();
    let mut effects = singles.clone();
    effects.extend(pairs);
    effects.extend(comparison.soft_ground());
    best_first(&mut effects);
    let unknown = comparison.unknown(effects.first())?;
    Some(Naming { effects, unknown })
}

fn best_first(list: &mut [Named]) {
    list.sort_by(|a, b| b.score.total_cmp(&a.score));
}
