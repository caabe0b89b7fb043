//! Which drive would tell the remaining answers apart best.
//!
//! About a fit answers differ by their constants alone, and a drive is a measurement of these: of information `Λ`, its curvature once its
//! own deviation is eliminated. An answer `l` has them at `m_l`, with the covariance `P_l`. Where another, `k`, is true, it falls behind by
//! `½ Δᵀ (Λ⁻¹ + P_l)⁻¹ Δ` nats, `Δ = m_k − m_l`, and the drive is worth the bits by which the entropy of the answers is expected to fall
//! (Box & Hill 1967, Technometrics 9: discrimination among mechanistic models).

use std::collections::BTreeSet;

use catalogue::for_people;
use inference::advice::{LEAST_RIVAL, MOST_RIVALS, among, nothing_to_split, sorted};
use inference::evidence::probabilities;
use inference::expected_information::{Forecast, expected_bits, widest_pair};
use inference::words::two_digits;
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;
use verdict::{Advice, Contender, Manoeuvre};

use crate::cause::Cause;
use crate::descent::equations;
use crate::name::{Weighed, covariance, less, score, with};
use crate::observed::{Kind, Observed};
use crate::settings::SETTINGS;
use crate::solve::Solved;
use crate::weigh::{Evidence, Posterior};

/// Answers that the drives which were made leave open.
#[derive(Debug, Clone, Copy)]
pub struct Answers<'a> {
    /// Equations of all drives.
    pub evidence: &'a Evidence,
    /// Covariance of the constants before them.
    pub known: &'a DMatrix<f64>,
    /// What may be wrong.
    pub causes: &'a [Cause],
    /// What was named.
    pub chosen: &'a [Weighed],
}

/// A drive that could be made, and what it would say of the constants.
#[derive(Debug, Clone)]
pub struct Candidate {
    /// The drive.
    pub manoeuvre: Manoeuvre,
    /// Its information about the constants, its own deviation eliminated.
    pub information: DMatrix<f64>,
    /// Its readings by kind.
    pub readings: Vec<Readings>,
}

/// Readings of one kind in a drive.
#[derive(Debug, Clone)]
pub struct Readings {
    /// What is read.
    pub what: String,
    /// Its unit.
    pub unit: &'static str,
    /// Change of each reading, by row, with each constant.
    pub columns: DMatrix<f64>,
    /// Sigma of a reading.
    pub sigma: f64,
}

/// An answer that may be true.
struct Rival {
    contender: Contender,
    posterior: Posterior,
    /// The constant that is its size.
    size: Option<usize>,
}

/// Advises on the next drive among these.
pub fn advise(answers: Answers<'_>, candidates: Vec<Candidate>) -> Advice {
    let rivals = rivals(answers);
    let mut out = among(rivals.iter().map(|r| r.contender.clone()));
    let p: Vec<f64> = out.rivals.iter().map(|r| r.probability).collect();
    for Candidate { mut manoeuvre, information, readings } in candidates {
        let Some(views) = views(&information, &rivals) else { continue };
        manoeuvre.expected_bits = expected_bits(&p, &views, 1.0);
        if let Some((k, l)) = widest_pair(&p, &views, 1.0) {
            manoeuvre.why = why(&readings, [&rivals[k], &rivals[l]]);
            manoeuvre.splits = Some([k, l].map(|i| rivals[i].contender.name.clone()));
        }
        manoeuvre.narrows = rivals.iter().find_map(|r| narrows(&information, &r.posterior, r.size?));
        out.manoeuvres.push(manoeuvre);
    }
    out.withheld = if out.manoeuvres.is_empty() {
        Some("no drive of the menu could be simulated for this robot".to_owned())
    } else {
        nothing_to_split(&out)
    };
    if !out.manoeuvres.is_empty() {
        out.limits.push(
            "a drive is taken to be recorded with the same sensors and noise, on the same floor; what it would say is that of a \
             linear model about the fit"
                .to_owned(),
        );
    }
    sorted(out)
}

impl<D: Observed> Solved<D> {
    /// Advises on the next drive among these, each as the answer would have it recorded. `said_of`: what readings of a kind are, with
    /// their unit.
    pub fn advise<C: Observed<Model = D::Model>>(
        &self,
        drives: Vec<(Manoeuvre, C)>,
        said_of: impl Fn(Kind) -> (String, &'static str) + Sync,
    ) -> Advice {
        let Self { data, fit, .. } = self;
        let scatter = data.scatter(fit.factor);
        let Some(evidence) = Evidence::new(&fit.theta, &fit.sessions, &scatter, &self.prior.mean) else {
            return Advice::withheld("the equations of these drives have no solution");
        };
        let candidate = |(manoeuvre, drive): (Manoeuvre, C)| {
            let columns = drive.columns(&data.model, &fit.theta);
            let errors = vec![0.0; drive.rows().len()];
            let information = equations(&drive, (&errors, &columns), fit.noise).marginal(&scatter)?.curvature;
            let of_kind = |kind: Kind| {
                let rows: Vec<usize> = (0..errors.len()).filter(|&i| drive.rows()[i].kind == kind).collect();
                let (what, unit) = said_of(kind);
                let columns = DMatrix::from_fn(rows.len(), columns.len(), |i, k| columns[k][rows[i]]);
                Readings { what, unit, columns, sigma: fit.noise.sigma[kind as usize] }
            };
            let readings = Kind::ALL.map(of_kind).into_iter().filter(|r| r.columns.nrows() > 0).collect();
            Some(Candidate { manoeuvre, information, readings })
        };
        let candidates: Vec<Candidate> = drives.into_par_iter().filter_map(candidate).collect();
        let answers = Answers {
            evidence: &evidence,
            known: &self.prior.covariance,
            causes: &self.causes,
            chosen: &self.named.chosen,
        };
        advise(answers, candidates)
    }
}

/// What may still be true: what was named, and all that differs from it by one cause, the most probable first.
fn rivals(answers: Answers<'_>) -> Vec<Rival> {
    let Answers { evidence, known, causes, chosen } = answers;
    let told: Vec<usize> = chosen.iter().map(|w| w.cause).collect();
    let all = 0..causes.len();
    let mut sets: Vec<Vec<usize>> = vec![told.clone(), Vec::new()];
    sets.extend(told.iter().map(|&c| less(&told, c)));
    for c in all.filter(|c| !told.contains(c)) {
        sets.push(with(&told, c));
        sets.extend(told.iter().map(|&out| with(&less(&told, out), c)));
    }

    let score_of = |set: &[usize]| Some(score(evidence, known, causes, set)? + SETTINGS.naming.odds * set.len() as f64);
    let of_told = score_of(&told).unwrap_or(f64::NEG_INFINITY);
    let is_alike = |set: &[usize]| {
        let stands_in = |w: &Weighed| !set.contains(&w.cause) && w.class.iter().any(|c| set.contains(c));
        set.len() == told.len() && chosen.iter().any(stands_in)
    };
    let mut seen: BTreeSet<Vec<usize>> = BTreeSet::new();
    let mut scored: Vec<(f64, Vec<usize>)> = Vec::new();
    for mut set in sets {
        set.sort_unstable();
        let Some(own) = score_of(&set).filter(|_| seen.insert(set.clone())) else { continue };
        // What the verdict cannot tell from what it names is as open here, whatever equations about the fit say.
        let least = if is_alike(&set) { of_told - SETTINGS.naming.alike } else { f64::NEG_INFINITY };
        scored.push((own.max(least), set));
    }
    scored.sort_by(|a, b| b.0.total_cmp(&a.0));

    let likely = |scored: &[(f64, Vec<usize>)]| probabilities(&scored.iter().map(|s| s.0).collect::<Vec<_>>(), 1.0);
    let kept = likely(&scored).iter().take(MOST_RIVALS).filter(|p| **p >= LEAST_RIVAL).count();
    scored.truncate(kept);
    let p = likely(&scored);
    let rival = |((_, set), probability): (&(f64, Vec<usize>), f64)| {
        let names: Vec<String> = set.iter().map(|&c| for_people(&causes[c].label())).collect();
        let contender = Contender {
            effects: set.iter().map(|&c| causes[c].label()).collect(),
            name: if names.is_empty() { "nothing is missing".to_owned() } else { names.join(" + ") },
            probability,
        };
        let posterior = evidence.posterior(&covariance(known, causes, set))?;
        Some(Rival { contender, posterior, size: set.first().and_then(|&c| causes[c].moves().first().copied()) })
    };
    scored.iter().zip(p).filter_map(rival).collect()
}

/// `(Λ⁻¹ + P)⁻¹ = Λ − Λ L (I + Lᵀ Λ L)⁻¹ Lᵀ Λ` with `P = L Lᵀ`, and the covariance `L (I + Lᵀ Λ L)⁻¹ Lᵀ` after the drive.
fn with_drive(information: &DMatrix<f64>, before: &Posterior) -> Option<[DMatrix<f64>; 2]> {
    let l = before.covariance.clone().cholesky()?.l();
    let n = l.nrows();
    let inner = (DMatrix::identity(n, n) + l.transpose() * information * &l).cholesky()?;
    let after = &l * inner.solve(&l.transpose());
    Some([information - information * &after * information, after])
}

fn views(information: &DMatrix<f64>, rivals: &[Rival]) -> Option<Vec<Forecast>> {
    let weights: Vec<DMatrix<f64>> = rivals
        .iter()
        .map(|r| with_drive(information, &r.posterior).map(|[weight, _]| weight))
        .collect::<Option<_>>()?;
    let view = |truth: &Rival| {
        let off: Vec<DVector<f64>> = rivals.iter().map(|r| &truth.posterior.mean - &r.posterior.mean).collect();
        let behind = off.iter().zip(&weights).map(|(d, weight)| 0.5 * d.dot(&(weight * d))).collect();
        let product = |a: usize, b: usize| off[a].dot(&(information * &off[b]));
        let alike = |a: usize, b: usize| {
            let sizes = (product(a, a) * product(b, b)).max(0.0).sqrt();
            if sizes > 0.0 { product(a, b) / sizes } else { 0.0 }
        };
        Forecast::new(behind, alike)
    };
    Some(rivals.iter().map(view).collect())
}

/// One sigma of a constant after the drive over that before.
fn narrows(information: &DMatrix<f64>, before: &Posterior, constant: usize) -> Option<f64> {
    let [_, after] = with_drive(information, before)?;
    let [after, before] = [&after, &before.covariance].map(|of| of[(constant, constant)].max(0.0).sqrt());
    (before > 0.0).then(|| after / before)
}

/// The readings in which two answers differ most.
fn why(readings: &[Readings], [a, b]: [&Rival; 2]) -> String {
    let off = &a.posterior.mean - &b.posterior.mean;
    let rms = |r: &Readings| {
        let each = &r.columns * &off;
        (each.norm_squared() / each.len().max(1) as f64).sqrt()
    };
    let clearest = readings.iter().map(|r| (rms(r), r)).max_by(|a, b| (a.0 / a.1.sigma).total_cmp(&(b.0 / b.1.sigma)));
    clearest.map_or_else(String::new, |(by, r)| {
        format!(
            "Between '{}' and '{}' {} differs by {} {} (root mean square).",
            a.contender.name,
            b.contender.name,
            r.what,
            two_digits(by),
            r.unit
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::name::name;
    use crate::session::Session;
    use verdict::Course;

    /// Equations of readings of so much information about `weights · constants`, which are `off` from what is known.
    fn session(weights: [f64; 2], information: f64, off: f64) -> Session {
        let along = DVector::from_row_slice(&weights);
        let mut out = Session::of_nothing(2);
        out.curvature.ger(information, &along, &along, 1.0);
        out.slope = -information * off * &along;
        out.cost = 0.5 * information * off * off;
        out
    }

    fn cause(spec: &'static catalogue::CauseSpec, constant: usize) -> Cause {
        Cause { spec, of: None, directions: vec![(vec![(constant, 1.0)], 1.0)], possible: None }
    }

    fn candidate(name: &str, weights: [f64; 2]) -> Candidate {
        let columns = DMatrix::from_row_slice(1, 2, &weights);
        let readings = vec![Readings { what: format!("what {name} shows"), unit: "m", columns, sigma: 0.1 }];
        let manoeuvre = Manoeuvre::new(name, Course::default(), [0.0; 3]);
        Candidate { manoeuvre, information: session(weights, 100.0, 0.0).curvature, readings }
    }

    fn advised(off: f64) -> Advice {
        let nothing = DVector::zeros(2);
        let evidence =
            Evidence::new(&[0.0; 2], &[session([1.0; 2], 400.0, off)], &nothing, &nothing).expect("equations");
        let known = DMatrix::from_diagonal_element(2, 2, 1e-4);
        let causes = [cause(&catalogue::odometry::STEERING_ZERO, 0), cause(&catalogue::odometry::POSE_MOUNTING, 1)];
        let named = name(&evidence, &known, &causes).expect("an answer");
        let answers = Answers { evidence: &evidence, known: &known, causes: &causes, chosen: &named.chosen };
        advise(answers, vec![candidate("the same again", [1.0; 2]), candidate("one of them alone", [1.0, 0.0])])
    }

    #[test]
    fn a_drive_that_shows_one_of_two_look_alikes_alone_tells_them_apart_and_the_same_again_does_not() {
        let advice = advised(1.0);
        let p: Vec<f64> = advice.rivals.iter().map(|r| r.probability).collect();
        assert!(p.iter().take(2).all(|p| *p > 0.4), "{p:?}");
        let [first, second] = &advice.manoeuvres[..] else { panic!("{advice:?}") };
        assert_eq!(first.name, "one of them alone");
        assert!(first.expected_bits > 0.7 * advice.entropy_bits && second.expected_bits < 0.1, "{advice:?}");
        assert!(first.narrows.is_some_and(|n| n < 1.0), "{:?}", first.narrows);
        assert!(first.why.contains("what one of them alone shows differs by 1.00 m"), "{}", first.why);
        assert_eq!(advice.withheld, None);
    }

    #[test]
    fn where_nothing_is_missing_no_drive_is_worth_making() {
        let advice = advised(0.0);
        assert_eq!(advice.rivals[0].name, "nothing is missing");
        assert!(advice.rivals[0].probability > 0.8 && advice.withheld.is_some(), "{advice:?}");
    }
}
