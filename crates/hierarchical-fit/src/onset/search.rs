//! A cause that begins or ends while the drives go on.
//!
//! Drives count one after the other. With the constants `θ` of the rows in which a cause is not there and `θ + B u` of the others, `B`
//! its directions and `u ~ N(0, usual²)`, the equations of stretches about both give the evidence of every instant at which it may begin
//! or end; the instant is summed over.

use std::cell::RefCell;
use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::cause::Cause;
use crate::data::{Data, Noise, Prior};
use crate::descent::sessions;
use crate::fit::Fit;
use crate::name::{Named, covariance, score};
use crate::observed::Observed;
use crate::onset::courses::{Course, Grid};
use crate::onset::gated::fitted;
use crate::onset::hypotheses::{Hypothesis, directions, hypotheses, likely};
use crate::onset::scan::Scan;
use crate::onset::told::when;
use crate::onset::{Instants, Onset};
use crate::session::{Session, overdispersion};
use crate::settings::SETTINGS;
use crate::stretches::{Stretch, difference, joined, stretches, sums};
use crate::weigh::{Evidence, Posterior};
use inference::evidence::{is_within_odds, log_sum_exp};

/// A hypothesis with what speaks for it.
pub(super) struct Weighted {
    pub(super) hypothesis: Hypothesis,
    /// Evidence with the odds of what is claimed, nats.
    score: f64,
    pub(super) instants: Instants,
    /// Factor on the usual scatter of drives.
    pub(super) factor: f64,
    /// Constants, then how far the cause moves them along its directions, at the most probable instant.
    pub(super) posterior: Posterior,
    /// Deviations of drives about which its equations stand; `None` where they are those of the fit without it.
    own: Option<Vec<DVector<f64>>>,
}

/// Equations of all stretches with and without a cause, and the constants about which they stand.
pub(super) struct Equations {
    pub(super) off: Vec<Vec<Stretch>>,
    on: Vec<Vec<Stretch>>,
    theta: DVector<f64>,
    /// How far the cause moves them along its directions.
    moved: Option<DVector<f64>>,
}

impl Equations {
    /// The same where each row says so much less.
    fn scaled(self, by: f64) -> Self {
        let of = |s: Stretch| Stretch { equations: s.equations.scaled(by), ..s };
        let [off, on] =
            [self.off, self.on].map(|drives| drives.into_iter().map(|d| d.into_iter().map(of).collect()).collect());
        Self { off, on, ..self }
    }
}

/// Drives, what is known, and a fit.
pub(super) struct Sought<'a, D: Observed> {
    pub(super) data: &'a Data<D>,
    pub(super) prior: &'a Prior,
    pub(super) causes: &'a [Cause],
    fit: &'a Fit,
    pub(super) grid: Grid,
    /// Where a cause may begin or end once.
    pub(super) series: Vec<Course>,
}

/// Looks for a cause that begins or ends, where that says more of the drives than what was named; the answer with it.
pub(crate) fn onset<D: Observed>(
    data: &Data<D>,
    prior: &Prior,
    causes: &[Cause],
    (fit, named): (&Fit, &Named),
) -> Option<(Onset, Named)> {
    let rules = SETTINGS.onset;
    let own = stretches(data, &fit.theta, &fit.own, (fit.noise, rules.coarse));
    let grid = Grid::new(&own);
    let sought = Sought { data, prior, causes, fit, series: grid.in_series(), grid };
    let set: Vec<usize> = named.chosen.iter().map(|w| w.cause).collect();
    let always = sought.always(&set, &fit.sessions)?;

    // By the equations about the fit first, then each of the best by its own.
    let about = Equations { off: own.clone(), on: own, theta: DVector::from_column_slice(&fit.theta), moved: None };
    let found = sought.scanned(&hypotheses(causes.len(), &set, D::ANEW && data.drives.len() > 1), &about, always)?;
    let refined: Vec<(Weighted, Noise)> =
        found.into_par_iter().filter_map(|weighted| sought.refined(weighted, &about.off)).collect();

    // What a cause that is there for a part of the time leaves where it is taken to be always there is no noise.
    let noise = refined.iter().fold(fit.noise, |noise, (_, own)| noise.sharper(*own));
    let own = sessions(data, &fit.theta, &fit.own, noise);
    let again = |(weighted, _): (Weighted, Noise)| sought.again(&weighted, noise);
    let mut found: Vec<(Weighted, Equations)> = refined.into_par_iter().filter_map(again).collect();
    found.sort_by(|a, b| b.0.score.total_cmp(&a.0.score));
    // And rows say no more than what the best one leaves permits.
    let less = 1.0 / sought.overdispersion(found.first()?)?;
    let always = sought.always(&set, &own.into_iter().map(|s| s.scaled(less)).collect::<Vec<_>>())?;
    let scaled = |(weighted, about): (Weighted, Equations)| {
        let about = about.scaled(less);
        Some((sought.weighed(&weighted.hypothesis, &about, &likely(&weighted.instants))?, about))
    };
    let mut found: Vec<(Weighted, Equations)> = found.into_iter().filter_map(scaled).collect();
    found.sort_by(|a, b| b.0.score.total_cmp(&a.0.score));
    let told = |answer: &(Weighted, Equations)| {
        let log_odds = answer.0.score - always;
        let is_alike =
            |other: &&(Weighted, Equations)| is_within_odds(other.0.score, answer.0.score, SETTINGS.naming.alike);
        let alike: Vec<usize> = found.iter().filter(is_alike).map(|(other, _)| other.hypothesis.cause).collect();
        if log_odds < rules.named { None } else { sought.told(answer, named, (log_odds, &alike)) }
    };
    found.iter().find_map(told)
}

/// Log prior of a factor on the scatter of drives, nats.
fn of_factor(factor: f64) -> f64 {
    -0.5 * (factor.ln() / SETTINGS.fitting.width).powi(2)
}

impl<D: Observed> Sought<'_, D> {
    /// Evidence of a hypothesis by these equations, under the more probable of the fitted scatter of drives and the usual one.
    fn weighed(&self, hypothesis: &Hypothesis, about: &Equations, courses: &[Course]) -> Option<Weighted> {
        let of = |factor: f64| self.weighed_under(hypothesis.clone(), about, courses, factor);
        let fitted = of(self.fit.factor);
        let usual = if self.fit.factor > 1.0 { of(1.0) } else { None };
        [fitted, usual].into_iter().flatten().max_by(|a, b| a.score.total_cmp(&b.score))
    }

    fn weighed_under(
        &self,
        hypothesis: Hypothesis,
        about: &Equations,
        courses: &[Course],
        factor: f64,
    ) -> Option<Weighted> {
        let n = self.prior.mean.len();
        let (directions, variances) = directions(&self.causes[hypothesis.cause], n);
        let m = directions.ncols();
        let wide = |of: &DVector<f64>, rest: Option<&DVector<f64>>| {
            let mut out = DVector::zeros(n + m);
            out.rows_mut(0, n).copy_from(of);
            if let Some(rest) = rest {
                out.rows_mut(n, m).copy_from(rest);
            }
            out
        };
        let (theta, mean) = (wide(&about.theta, about.moved.as_ref()), wide(&self.prior.mean, None));
        let scatter = wide(&self.data.scatter(factor), None);
        let mut known = DMatrix::zeros(n + m, n + m);
        known.view_mut((0, 0), (n, n)).copy_from(&covariance(&self.prior.covariance, self.causes, &hypothesis.always));
        known.view_mut((n, n), (m, m)).set_diagonal(&variances);
        let evidence =
            |off: &Session, on: &Session| Evidence::of_session(&theta, &joined(off, on, &directions), &scatter, &mean);

        let nothing = Session::of_nothing(n);
        let [off, on] =
            [&about.off, &about.on].map(|of| of.iter().map(|s| sums(nothing.clone(), s)).collect::<Vec<_>>());
        let late = |sums: &[Session], from: usize| difference(&sums[sums.len() - 1], &sums[from]);
        // What a drive says in which all is otherwise from a stretch on.
        let known_of_drives = RefCell::new(BTreeMap::new());
        let of_drive = |drive: usize, from: usize| -> Option<Evidence> {
            if let Some(known) = known_of_drives.borrow().get(&(drive, from)) {
                return Some(Evidence::clone(known));
            }
            let own = if hypothesis.ends {
                evidence(&late(&off[drive], from), &on[drive][from])
            } else {
                evidence(&off[drive][from], &late(&on[drive], from))
            }?;
            known_of_drives.borrow_mut().insert((drive, from), own.clone());
            Some(own)
        };
        let all = |course: &Course| -> Option<Evidence> {
            let mut out = Evidence::of_nothing(&mean);
            for (drive, from) in course.iter().enumerate() {
                out += &of_drive(drive, *from)?;
            }
            Some(out)
        };
        let score = |course: &Course| {
            let all = all(course)?;
            Some(all.of(&known)? - all.base)
        };
        let instants: Instants = if hypothesis.anew {
            self.grid.anew(courses.first()?, score)?
        } else {
            courses.iter().filter_map(|course| Some((score(course)?, course.clone()))).collect()
        };
        let (_, best) = instants.iter().max_by(|a, b| a.0.total_cmp(&b.0))?;
        let posterior = all(best)?.posterior(&known)?;
        let score = self.claimed(&hypothesis, &instants, factor);
        let out = Weighted { hypothesis, score, instants, factor, posterior, own: None };
        self.is_possible(&out).then_some(out)
    }

    /// Whether all constants lie in what they can be within a sigma, as of causes that are always there.
    fn is_possible(&self, weighted: &Weighted) -> bool {
        let acting = self.acting(weighted);
        let mut causes = weighted.hypothesis.always.iter().chain([&weighted.hypothesis.cause]);
        causes.all(|&c| self.causes[c].possible.is_none_or(|range| range.may_hold(&acting)))
    }

    /// Evidence of a hypothesis whose instants have these, with the odds of what is claimed, nats.
    fn claimed(&self, hypothesis: &Hypothesis, instants: &Instants, factor: f64) -> f64 {
        // An onset is one of so many, and begins or ends.
        let of_instants = if hypothesis.anew {
            self.grid.sum_anew(instants) - 2.0_f64.ln()
        } else {
            let scores: Vec<f64> = instants.iter().map(|(score, _)| *score).collect();
            log_sum_exp(&scores) - (2.0 * self.series.len() as f64).ln()
        };
        let causes = (hypothesis.always.len() + 1) as f64 * SETTINGS.naming.odds;
        of_instants + causes + SETTINGS.onset.odds + of_factor(factor)
    }

    /// Every hypothesis by the equations about the fit: those that lack little of what is always there, the best first.
    fn scanned(&self, hypotheses: &[Hypothesis], about: &Equations, always: f64) -> Option<Vec<Weighted>> {
        let rules = SETTINGS.onset;
        let n = self.prior.mean.len();
        let mut factors = vec![self.fit.factor];
        factors.extend((self.fit.factor > 1.0).then_some(1.0));
        let mut found: Vec<(f64, Hypothesis, Instants)> = Vec::new();
        for factor in factors {
            let scan = Scan::new(&about.off, &about.theta, &self.data.scatter(factor), &self.prior.mean)?;
            let of = |hypothesis: &Hypothesis| {
                let always = scan.always(&covariance(&self.prior.covariance, self.causes, &hypothesis.always))?;
                let moves = directions(&self.causes[hypothesis.cause], n);
                let instants =
                    scan.instants((&self.series, &self.grid), &moves, &always, (hypothesis.ends, hypothesis.anew))?;
                Some((self.claimed(hypothesis, &instants, factor), hypothesis.clone(), instants))
            };
            found.par_extend(hypotheses.par_iter().filter_map(of));
        }
        found.retain(|(score, ..)| *score > always - rules.near);
        found.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut out: Vec<Weighted> = Vec::new();
        for (_, hypothesis, instants) in found {
            if out.len() == rules.tried {
                break;
            }
            // One of each cause: others may stand for it.
            if out.iter().all(|w| w.hypothesis.cause != hypothesis.cause) {
                out.extend(self.weighed(&hypothesis, about, &likely(&instants)));
            }
        }
        Some(out)
    }

    /// Evidence of causes that are always there, with the odds of what is claimed, nats.
    fn always(&self, set: &[usize], sessions: &[Session]) -> Option<f64> {
        let Self { data, prior, causes, fit, .. } = self;
        let lines = Evidence::new(&fit.theta, sessions, &data.scatter(fit.factor), &prior.mean)?;
        let evidence = score(&lines, &prior.covariance, causes, set)? - lines.base;
        Some(evidence + SETTINGS.naming.odds * set.len() as f64 + of_factor(fit.factor))
    }

    /// Constants where the cause is not there, and where it is.
    fn constants(&self, weighted: &Weighted) -> [DVector<f64>; 2] {
        let [off, _] = self.split(weighted);
        [off, self.acting(weighted).mean]
    }

    /// Constants where the cause is not there, and how far it moves them.
    fn split(&self, weighted: &Weighted) -> [DVector<f64>; 2] {
        let (mean, n) = (&weighted.posterior.mean, self.prior.mean.len());
        [mean.rows(0, n).into_owned(), mean.rows(n, mean.len() - n).into_owned()]
    }

    /// A hypothesis by equations about where it led.
    fn again(&self, weighted: &Weighted, noise: Noise) -> Option<(Weighted, Equations)> {
        let ([theta, moved], [_, acting]) = (self.split(weighted), self.constants(weighted));
        let own = weighted.own.as_ref().unwrap_or(&self.fit.own);
        let of = |theta: &DVector<f64>| stretches(self.data, theta.as_slice(), own, (noise, SETTINGS.onset.coarse));
        let about = Equations { off: of(&theta), on: of(&acting), theta, moved: Some(moved) };
        let next = self.weighed(&weighted.hypothesis, &about, &likely(&weighted.instants))?;
        Some((Weighted { own: weighted.own.clone(), ..next }, about))
    }

    /// A hypothesis about a fit of its own, with what its errors scatter by; `drives`: their stretches.
    fn refined(&self, weighted: Weighted, drives: &[Vec<Stretch>]) -> Option<(Weighted, Noise)> {
        let gate = when(&weighted, drives)?.0;
        let known = self.prior.with(self.causes, &weighted.hypothesis.always);
        let moves = directions(&self.causes[weighted.hypothesis.cause], self.prior.mean.len());
        let found = fitted(self.data, &known, &gate, &moves, &weighted.posterior.mean)?;
        let posterior = Posterior { mean: found.theta, ..weighted.posterior };
        Some((Weighted { posterior, own: Some(found.own), ..weighted }, found.noise))
    }

    /// By how many times rows seem to say more than they do where a hypothesis holds.
    fn overdispersion(&self, (weighted, about): &(Weighted, Equations)) -> Option<f64> {
        let gate = when(weighted, &about.off)?.0;
        let n = self.prior.mean.len();
        let sessions = about.off.iter().zip(&about.on).enumerate().map(|(k, (off, on))| {
            let acting = |(off, on): (&Stretch, &Stretch)| {
                if gate.acts(k, on.from) { on.equations.clone() } else { off.equations.clone() }
            };
            let all: Vec<Session> = off.iter().zip(on).map(acting).collect();
            let together = (SETTINGS.errors.stretch / SETTINGS.onset.coarse).round().max(1.0) as usize;
            let mut out = Session::of_nothing(n);
            for stretch in all.chunks(together) {
                let mut slope = DVector::zeros(n);
                for part in stretch {
                    slope += &part.slope;
                    out.curvature += &part.curvature;
                }
                out.scores.ger(1.0, &slope, &slope, 1.0);
            }
            out
        });
        let scales = DVector::from_iterator(n, self.data.spreads.iter().map(|c| c.usual));
        Some(overdispersion(&sessions.collect::<Vec<_>>(), &scales))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::fit;
    use crate::observed::Spread;
    use crate::scaled::Scaled;
    use approx::assert_relative_eq;

    #[test]
    fn a_scan_has_the_evidence_that_the_equations_of_every_hypothesis_have() {
        let spreads = vec![Spread { sigma: 0.1, usual: 0.3, scatter: 0.02, bounds: [-5.0, 5.0] }];
        let drives = [[1.0, 1.1], [1.1, 1.1], [1.1, 1.0]].map(|s| Scaled::changing(s, 8.0)).into();
        let data = Data { model: (), spreads, drives };
        let prior = data.prior();
        let directions = vec![(vec![(0, 1.0)], 0.3), (vec![(0, 0.5)], 0.2)];
        let spec = &catalogue::odometry::RADIUS_OF_ALL_WHEELS;
        let causes = [Cause { spec, of: None, directions, possible: None }];
        let fit = fit(&data, &prior, vec![0.0]).expect("a fit");
        let own = stretches(&data, &fit.theta, &fit.own, (fit.noise, SETTINGS.onset.coarse));
        let grid = Grid::new(&own);
        let series = grid.in_series();
        let sought = Sought { data: &data, prior: &prior, causes: &causes, fit: &fit, series, grid };
        let theta = DVector::from_column_slice(&fit.theta);
        let about = Equations { off: own.clone(), on: own.clone(), theta: theta.clone(), moved: None };
        let scan = Scan::new(&own, &theta, &data.scatter(fit.factor), &prior.mean).expect("a scan");
        let always = scan.always(&prior.covariance).expect("an answer");
        for (ends, anew) in [(false, false), (true, false), (false, true)] {
            let hypothesis = Hypothesis { always: Vec::new(), cause: 0, ends, anew };
            let scanned =
                scan.instants((&sought.series, &sought.grid), &super::directions(&causes[0], 1), &always, (ends, anew));
            let Some(slow) = sought.weighed_under(hypothesis, &about, &sought.series, fit.factor) else {
                assert!(anew && scanned.is_none(), "nothing changes anew in these drives");
                continue;
            };
            let scanned = scanned.expect("instants");
            assert_eq!(scanned.len(), slow.instants.len());
            for (a, b) in scanned.iter().zip(&slow.instants) {
                assert_eq!(a.1, b.1);
                assert_relative_eq!(a.0, b.0, epsilon = 1e-6);
            }
        }
    }
}
