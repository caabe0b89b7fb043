//! A law as plain data of the verdict.

use std::sync::Arc;

use faer::Mat;
use inference::SearchForLaw;
use inference::algebra::solve_spd;
use inference::hypothesis::Variant;
use law::Law;
use rayon::prelude::*;
use robot_model::tunable::COUNT as NUISANCES;
use verdict::{Claim, CommonLaw, Diagnosis, FoundLaw, FreeRun, LawFreeRun, LawNumber, UnnamedCause, Verdict};

use super::acting::{Acting, Inputs};
use super::arbitrary::{Acts, wide};
use super::gate::{References, Standing, holds_elsewhere};
use super::rank::Ranking;
use super::refit::{Refitted, Starts, hypothesis, numbers};
use super::{events, place, series};
use crate::calibrate::problem;
use crate::decide::fault_free_cost;
use crate::fit::{Fitted, Hypothesis, Point, Problem};
use crate::judged::Judged;
use crate::rms::rms;
use crate::settings::decision;
use crate::settings::fit;
use crate::settings::law::{Proof, SETTINGS};
use crate::windows::Cut;

const PROOF: Proof = SETTINGS.proof;

/// Significant digits of numbers in formulas: more than any drive determines.
const DIGITS: usize = SETTINGS.proof.digits;

fn told_formula(law: &Law) -> String {
    format!("{law:.DIGITS$}")
}

/// Whether a law is to be looked for.
pub(crate) struct Asked;

impl Asked {
    /// Where the cause is unknown, or the best name leaves much of the mismatch.
    pub(crate) fn of(judged: &Judged<'_>, retuned: &Fitted, verdict: Verdict) -> bool {
        match (judged.options.law, verdict) {
            (SearchForLaw::Always | SearchForLaw::Unknown, Verdict::Unknown) => true,
            // Without references nothing tells what differs from what the simulation lacks in every drive: only a cause that
            // is clearly none of the catalogue is asked for.
            _ if judged.references.is_empty() => false,
            (SearchForLaw::Always, _) => true,
            // What a sensor shows wrongly is no law of the motion.
            (SearchForLaw::Unknown, Verdict::Explained) if judged.is_of_sensors_alone() => false,
            (SearchForLaw::Unknown, Verdict::Explained) => {
                let fault_free = fault_free_cost(judged.problem, &judged.calibration.regimes.scatter);
                let best = judged.decision.scored.iter().map(|s| s.trial.fitted.cost).fold(retuned.cost, f64::min);
                let excess = (retuned.cost - fault_free).max(decision::SETTINGS.unknown.least_mismatch);
                (best - fault_free) / excess > SETTINGS.asked.left
            }
            _ => false,
        }
    }
}

/// Looks for a law and says what may be said of it. `out` is the diagnosis so far.
pub(crate) fn tell(judged: &Judged<'_>, retuned: &Fitted, out: &Diagnosis) -> UnnamedCause {
    let p = judged.problem;
    let none = Hypothesis::default();
    let origin = p.begin(&none, p.origin(), None);
    let ranking = Ranking::new(p, &origin);
    let starts = Starts { origin: &origin, retuned };
    let found = starts.search(&ranking, &ranking.all());

    let references = References::new(judged);
    let stand = |law: &Refitted| Standing::new(judged, retuned, law, references.as_ref());
    let standings: Vec<Standing> = found.par_iter().map(stand).collect();
    let all = || found.iter().zip(&standings);
    let common = all().find(|(law, s)| law.gain > SETTINGS.gates.score && s.is_in_every_drive());
    let in_every_drive = common.and_then(|(law, s)| {
        let place = law.law.terms().first()?.place().name().to_owned();
        let seen =
            ranking.signals.seen(&law.law).into_iter().map(|(v, range)| (v.symbol().to_owned(), range)).collect();
        Some(CommonLaw { place, formula: told_formula(&law.law), in_references: s.in_references?[0], seen })
    });

    // Of those that the references do not have, the best.
    let best = all().find(|(_, s)| !s.is_in_references());
    let claim = best.map_or(Claim::Nothing, |(law, s)| {
        if s.tells_a_law(law) {
            Claim::Law
        } else if s.names_a_place(law) {
            Claim::Place
        } else {
            Claim::Nothing
        }
    });
    let law = best.filter(|_| claim != Claim::Nothing);
    let law = law.map(|(law, standing)| {
        let last = last_fit(p, law);
        let rivals: Vec<&Refitted> = all().filter(|(_, s)| !s.is_in_references()).map(|(law, _)| law).collect();
        Telling { judged, ranking: &ranking, law: &last, standing, rivals: &rivals }.told(&out.free_runs)
    });
    // What does not hold on recordings that its fit did not use is no law of this robot, and its place is none.
    let law = law.filter(|law| holds_elsewhere(&law.free_runs));
    let claim = if law.is_some() { claim } else { Claim::Nothing };
    let found = UnnamedCause { claim, law, events: None, place: None, in_every_drive };
    if claim == Claim::Law {
        return found;
    }

    // Instants say more than a place alone, and a law that predicts too little more than none.
    let wide = wide(p);
    let ground = series::Ground { problem: &wide, base: &origin, operator: &ranking.operator };
    let all = Acts::everywhere(&ground);
    if let Some(events) = events::find(judged, &ground, &all, &ranking.signals, retuned, references.as_ref()) {
        return UnnamedCause { claim: Claim::Events, law: None, events: Some(events), ..found };
    }
    if claim == Claim::Place {
        return found;
    }
    match place::find(judged, &ground, &all, retuned, references.as_ref()) {
        Some(place) => UnnamedCause { claim: Claim::Place, place: Some(place), ..found },
        None => found,
    }
}

/// The winner with its numbers from a fit that saturates less.
fn last_fit(p: &Problem<'_>, law: &Refitted) -> Refitted {
    let wide = Problem { outlier_scale: SETTINGS.refit.outlier_scale, ..p.clone() };
    let h = hypothesis(&law.law, &law.units);
    let start = wide.begin(&h, law.fitted.point.clone(), Some(law.fitted.columns.clone()));
    let fitted = wide.refine(&h, start, SETTINGS.refit.steps, None);
    let last = law.law.with(&fitted.point.effects);
    // Cost and gain stay those that the law was chosen by.
    Refitted { law: last, fitted, ..law.clone() }
}

/// All that is said of one law.
struct Telling<'a> {
    judged: &'a Judged<'a>,
    ranking: &'a Ranking<'a>,
    law: &'a Refitted,
    standing: &'a Standing,
    rivals: &'a [&'a Refitted],
}

impl Telling<'_> {
    fn told(&self, rows: &[FreeRun]) -> FoundLaw {
        let (p, law) = (self.judged.problem, &self.law.law);
        let seen = self.ranking.signals.seen(law);
        let place = |l: &Law| l.terms().first().map_or("", |t| t.place().name());
        let own = place(law);
        let class = SETTINGS.gates.class * self.standing.misfit;
        let close = |r: &&&Refitted| self.law.score - r.score < class;
        let others = || self.rivals.iter().filter(|r| r.law.to_string() != law.to_string());
        let mut places_alike: Vec<String> =
            others().filter(close).map(|r| place(&r.law)).filter(|n| *n != own).map(str::to_owned).collect();
        places_alike.sort_unstable();
        places_alike.dedup();
        // The first of the rivals is the law itself before its last fit.
        let alike = self.rivals.iter().skip(1).filter(close).map(|r| told_formula(&r.law)).collect();
        let next = others().find(|r| place(&r.law) != own);
        let nearest =
            self.judged.decision.scored.iter().max_by(|a, b| b.trial.fitted.cost.total_cmp(&a.trial.fitted.cost));
        let retuned = self.law.gain + self.rivals.first().map_or(0.0, |r| r.fitted.cost);
        FoundLaw {
            place: own.to_owned(),
            places_alike,
            formula: told_formula(law),
            factors: law.terms().iter().flat_map(law::Term::factors).map(|f| format!("{f:.DIGITS$}")).collect(),
            numbers: self.numbers(),
            seen: seen.iter().map(|(v, range)| (v.symbol().to_owned(), *range)).collect(),
            alike,
            next_place: next.map(|r| (place(&r.law).to_owned(), self.law.score - r.score)),
            nearest_name: nearest.map(|s| {
                let names: Vec<String> = s.trial.hypothesis.variants().map(Variant::label).collect();
                (names.join(" with "), ((retuned - s.trial.fitted.cost) / self.law.gain.max(1.0)).max(0.0))
            }),
            gain: self.law.gain,
            score: self.law.score,
            gains: p.cuts.iter().map(|c| c.name.clone()).zip(self.standing.gains.iter().copied()).collect(),
            left: self.standing.left,
            in_references: self.standing.in_references.map(|[share, _]| share),
            free_runs: self.free_runs(rows),
        }
    }

    /// Constants and shapes with their 90 % intervals.
    fn numbers(&self) -> Vec<LawNumber> {
        let sigmas = self.sigmas();
        let mut at = 0;
        let mut out = Vec::new();
        for term in self.law.law.terms() {
            let mut push = |of: String, value: f64, unit: String| {
                let half = sigmas
                    .as_ref()
                    .and_then(|s| s.get(at))
                    .map(|sigma| PROOF.interval * (PROOF.curvature * sigma).hypot(PROOF.model_error * value));
                out.push(LawNumber { of, value, half: half.filter(|h| h.is_finite()), unit });
                at += 1;
            };
            push("constant".to_owned(), term.constant(), term.unit().to_string());
            for factor in term.factors() {
                for (shape, unit) in factor.shapes().iter().zip(factor.shape_units()) {
                    push(format!("{factor:.DIGITS$}"), shape.value, unit.to_string());
                }
            }
        }
        out
    }

    fn sigmas(&self) -> Option<Vec<f64>> {
        let (p, fitted) = (self.judged.problem, &self.law.fitted);
        let h = hypothesis(&self.law.law, &self.law.units);
        let columns = p.effect_columns(&fitted.point, &h, &fitted.response);
        let mut normal = p.normal(&fitted.point, &fitted.response, &fitted.columns, &columns)?;
        p.with_prior(&fitted.point, &mut normal);
        let n = normal.matrix.nrows();
        for i in NUISANCES..n {
            normal.matrix[(i, i)] += fit::SETTINGS.fit.whiff_of_sigmas;
        }
        let (inverse, _) = solve_spd(&normal.matrix, &Mat::identity(n, n))?;
        let sigma = |i: usize| inverse[(NUISANCES + i, NUISANCES + i)].max(0.0).sqrt();
        Some(h.free(&p.sizes()).iter().enumerate().map(|(i, f)| sigma(i) * f.unit).collect())
    }

    /// Each recording by fits to the others: with the law, and with that of its copies shifted in time that does best.
    fn free_runs(&self, rows: &[FreeRun]) -> Vec<LawFreeRun> {
        let p = self.judged.problem;
        if p.cuts.len() < 2 {
            return Vec::new();
        }
        let inputs = self.ranking.signals.inputs(&self.law.law);
        let copies: Vec<Inputs> = PROOF.shifts.iter().map(|by| shifted(inputs.clone(), *by)).collect();
        let forecast = |run: usize| -> Vec<[f64; 2]> {
            let kept: Vec<usize> = (0..p.cuts.len()).filter(|&r| r != run).collect();
            let cuts: Vec<Cut> = kept.iter().map(|&r| p.cuts[r].clone()).collect();
            let j = self.judged;
            let others = problem(p.robot, j.case, &cuts, j.calibration, p.largest_torque, j.options);
            let theirs = |copy: &Inputs| -> Inputs {
                copy.iter().map(|(input, runs)| (*input, kept.iter().map(|&r| runs[r].clone()).collect())).collect()
            };
            let given = |inputs: Inputs| Hypothesis {
                acting: Some(Acting::Given { inputs: Arc::new(inputs), times: 1.0, unit: 1.0 }),
                ..Hypothesis::default()
            };
            let law = hypothesis(&self.law.law, &self.law.units);
            let of_copy = |copy: &Inputs| (given(theirs(copy)), given(copy.clone()), vec![1.0]);
            let all = std::iter::once((law.clone(), law, numbers(&self.law.law))).chain(copies.iter().map(of_copy));
            let error = |(fit, forecast, start): (Hypothesis, Hypothesis, Vec<f64>)| {
                let point = Point { effects: start, ..others.origin() };
                let fitted = others.refine(&fit, others.begin(&fit, point, None), PROOF.steps, None);
                // What a recording has to itself is not known beforehand.
                let elsewhere = Point { run: p.origin().run, ..fitted.point };
                rms(p, &[(run, p.run_response(run, &elsewhere, &forecast))])
            };
            all.map(error).collect()
        };
        let errors: Vec<Vec<[f64; 2]>> = (0..p.cuts.len()).into_par_iter().map(forecast).collect();
        let total = |copy: &usize| errors.iter().flat_map(|e| e[*copy]).map(f64::ln).sum::<f64>();
        let best = (1..=copies.len()).min_by(|a, b| total(a).total_cmp(&total(b))).unwrap_or(0);
        let named = self.judged.winner().is_some();
        let row = |r: &FreeRun| {
            let run = p.cuts.iter().position(|c| c.name == r.recording)?;
            let quantity = crate::leave_out::QUANTITIES.iter().position(|q| *q == r.quantity)?;
            Some(LawFreeRun {
                recording: r.recording.clone(),
                quantity: r.quantity.clone(),
                nominal: r.nominal,
                retuned: r.retuned,
                named: named.then_some(r.corrected),
                law: errors[run][0][quantity],
                shifted: errors[run][best][quantity],
            })
        };
        rows.iter().filter_map(row).collect()
    }
}

/// Inputs of every recording, shifted in time by a share of it; what leaves at its end comes in at its beginning.
fn shifted(mut inputs: Inputs, share: f64) -> Inputs {
    for run in inputs.iter_mut().flat_map(|(_, runs)| runs) {
        let by = (share * run.len() as f64) as usize;
        run.rotate_right(by);
    }
    inputs
}
