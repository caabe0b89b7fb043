//! The hypotheses that are still in the running, each with its tuned robot and how well that is known.

use faer::Mat;
use inference::evidence::normalised;
use robot_model::tunable::COUNT as NUISANCES;

use crate::decision::Decision;
use crate::fit::{Fitted, Hypothesis, Point, Problem};
use crate::hypothesis::THROUGHOUT;
use crate::run_numbers::UNKNOWN;
use crate::settings::fit;
use inference::advice::{LEAST_RIVAL, MOST_RIVALS};
use inference::algebra::solve_spd;
use inference::hypothesis::{Free, Place};

/// A hypothesis that may be true.
pub(crate) struct Rival {
    /// Its effects; none of "nothing is missing".
    pub(crate) effects: Vec<String>,
    pub(crate) name: String,
    /// Among the rivals.
    pub(crate) probability: f64,
    pub(crate) hypothesis: Hypothesis,
    /// Tuning and sizes; a new drive has no numbers of its own yet.
    pub(crate) point: Point,
    pub(crate) free: Vec<Free>,
    /// Sizes if it is true: one sigma further than fitted, for what the recordings hide is what a drive is to show.
    pub(crate) further: Vec<f64>,
    /// Information about tuning and sizes that recordings and references give, sizes in the units of `free`.
    pub(crate) information: Mat<f64>,
}

impl Rival {
    pub(crate) fn new(
        problem: &Problem<'_>,
        hypothesis: &Hypothesis,
        fitted: &Fitted,
        probability: f64,
    ) -> Option<Self> {
        let effects = problem.effect_columns(&fitted.point, hypothesis, &fitted.response);
        let mut normal = problem.normal(&fitted.point, &fitted.response, &fitted.columns, &effects)?;
        problem.with_prior(&fitted.point, &mut normal);
        let mut information = normal.matrix;
        for i in NUISANCES..information.nrows() {
            information[(i, i)] += fit::SETTINGS.fit.whiff;
        }
        let free = hypothesis.free(&problem.sizes());
        let further = further(&information, hypothesis, &free, &fitted.point.effects);
        let parts = hypothesis.parts.iter().map(|(v, _)| (*v, vec![Some(THROUGHOUT)]));
        let names: Vec<String> = hypothesis.parts.iter().map(|(v, _)| inference::words::variant(v)).collect();
        Some(Self {
            effects: ids(hypothesis),
            name: if names.is_empty() { "nothing is missing".to_owned() } else { names.join(" with ") },
            probability,
            hypothesis: Hypothesis { parts: parts.collect(), acting: None },
            point: Point { run: vec![UNKNOWN], ..fitted.point.clone() },
            free,
            further,
            information,
        })
    }

    /// Ways in which a new drive may have what begins at an instant: throughout, from its middle, not at all.
    pub(crate) fn onsets(&self, length: f64) -> Vec<Hypothesis> {
        let begins = self.hypothesis.parts.iter().any(|(v, _)| v.begins());
        let of = |onset: Option<f64>| Hypothesis {
            parts: self.hypothesis.parts.iter().map(|(v, _)| (*v, vec![onset])).collect(),
            acting: None,
        };
        if begins {
            vec![of(Some(THROUGHOUT)), of(Some(0.5 * length)), of(None)]
        } else {
            vec![self.hypothesis.clone()]
        }
    }

    /// Centre and radius of the first place that it names.
    pub(crate) fn place(&self) -> Option<[f64; 3]> {
        let mut end = 0;
        for (v, _) in &self.hypothesis.parts {
            end += v.count();
            if v.place == Place::Disc {
                let e = &self.point.effects;
                return Some([e[end - 3], e[end - 2], e[end - 1]]);
            }
        }
        None
    }
}

/// The first strength of each effect one sigma further from nothing than `fitted`, by no more than a medium size.
fn further(information: &Mat<f64>, h: &Hypothesis, free: &[Free], fitted: &[f64]) -> Vec<f64> {
    let n = information.nrows();
    let mut out = fitted.to_vec();
    let Some((covariance, _)) = solve_spd(information, &Mat::identity(n, n)) else { return out };
    let mut at = 0;
    for (v, _) in &h.parts {
        let (f, i) = (&free[at], NUISANCES + at);
        let neutral = f.parameter.map_or(0.0, |p| v.spec().parameters[p].neutral);
        let sigma = covariance[(i, i)].max(0.0).sqrt().min(1.0) * f.unit;
        out[at] = (fitted[at] + sigma.copysign(fitted[at] - neutral)).clamp(f.bounds[0], f.bounds[1]);
        at += v.count();
    }
    out
}

fn ids(h: &Hypothesis) -> Vec<String> {
    let mut ids: Vec<String> = h.ids().iter().map(|id| (*id).to_owned()).collect();
    ids.sort_unstable();
    ids
}

/// The rivals, the most probable first: forms of the same effects are one, "nothing" is one, "unknown" has no robot.
pub(crate) fn rivals(problem: &Problem<'_>, decision: &Decision, retuned: &Fitted) -> Vec<Rival> {
    let none = Hypothesis::default();
    let mut found: Vec<(Vec<String>, &Hypothesis, &Fitted, f64)> = vec![(Vec::new(), &none, retuned, decision.none)];
    for s in &decision.scored {
        let own = ids(&s.trial.hypothesis);
        match found.iter_mut().find(|f| f.0 == own) {
            Some(f) => f.3 += s.probability,
            None => found.push((own, &s.trial.hypothesis, &s.trial.fitted, s.probability)),
        }
    }
    let sum: f64 = found.iter().map(|f| f.3).sum();
    found.retain(|f| f.3 >= LEAST_RIVAL * sum.max(f64::MIN_POSITIVE));
    found.sort_by(|a, b| b.3.total_cmp(&a.3));
    found.truncate(MOST_RIVALS);
    let shares = normalised(&found.iter().map(|f| f.3).collect::<Vec<_>>());
    let rivals = found.into_iter().zip(shares);
    rivals.filter_map(|((_, h, fitted, _), p)| Rival::new(problem, h, fitted, p)).collect()
}
