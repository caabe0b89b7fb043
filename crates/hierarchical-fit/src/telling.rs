//! Findings as plain data of the verdict: what every comparison whose sessions give normal equations tells alike.

use std::collections::BTreeMap;

use crate::found::{Answer, Estimate, NamedCause};
use crate::said::Unconfirmed;
use crate::settings::SETTINGS;
use catalogue::answer::{NONE, UNKNOWN};
use catalogue::odometry::{SLIP_WITH_SPEED, SLIP_WITH_TURNING};
use inference::evidence::none_of;
use inference::experiment::Standing;
use inference::robust::NINETY;
use verdict::{Cause, Diagnosis, FreeRun, Retuned, Verdict};

/// What was found, however it was compared.
pub struct Found<'a> {
    /// The answer.
    pub answer: Answer,
    /// Causes that are named.
    pub named: &'a [NamedCause],
    /// Labels and probabilities of the others.
    pub others: &'a [(String, f64)],
    /// Constants as they were fitted.
    pub constants: &'a [Estimate],
    /// Those that re-tuning moved.
    pub retuned: &'a [Estimate],
    /// Label of the cause that is little less probable than the first, and with which the placebo forecasts.
    pub rival: Option<&'a str>,
    /// Error as a share of the motion: as stated, re-tuned, with the answer.
    pub shares: [f64; 3],
    /// What the answer leaves of the recordings and of the references but for noise, as shares of the motion; `None` without references.
    pub beside_references: Option<[f64; 2]>,
    /// What the answer leaves but for noise, and from which share of the motion on that is more than usual; `None` with references.
    pub beside_usual: Option<[f64; 2]>,
    /// What left-out drives did not confirm.
    pub unconfirmed: Option<&'a Unconfirmed>,
    /// Why it is unknown, where it is.
    pub unknown: Unaccounted,
}

/// Why no cause accounts for what the drives show.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Unaccounted {
    /// The best answer leaves much; what it leaves of the references, where there are some.
    Left {
        /// As a share of their motion.
        of_references: Option<f64>,
    },
    /// The drives differ from each other by so many times what is usual.
    Scattered(f64),
    /// Left-out drives are forecast worse with the causes than as stated.
    Refuted,
    /// A sensor shows another share of small sizes than of large ones.
    Uneven(UnevenSensor),
    /// Several slips below zero fit best.
    SlipsBelowZero,
}

/// A sensor that shows another share of small sizes than of large ones, which no scale does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnevenSensor {
    /// Its name.
    pub sensor: &'static str,
    /// What it measures.
    pub quantity: &'static str,
    /// Unit of that.
    pub unit: &'static str,
    /// Between small and large sizes.
    pub limit: f64,
    /// Share that it shows of small ones.
    pub small: f64,
    /// Share that it shows of large ones.
    pub large: f64,
}

impl Found<'_> {
    /// The verdict without its sentences; a warning where free runs speak against what is named.
    pub fn verdict(&self, free_runs: Vec<FreeRun>) -> Diagnosis {
        let mut out = Diagnosis::withheld();
        out.verdict = match self.answer {
            Answer::Nothing | Answer::Retune => Verdict::NoMismatch,
            Answer::Named => Verdict::Explained,
            Answer::Unknown => Verdict::Unknown,
        };
        out.ranked = self.ranked();
        let [given, _, best] = self.shares;
        if out.verdict != Verdict::NoMismatch {
            out.unexplained = Some((best / given.max(f64::MIN_POSITIVE)).powi(2).min(1.0));
        }
        if self.answer == Answer::Retune {
            out.retuned = self.retuned.iter().filter(|e| e.is_moved()).map(retuned).collect();
        }
        if self.answer == Answer::Named {
            let is_named = |e: &Estimate| self.named.iter().any(|c| c.estimates.iter().any(|own| own.name == e.name));
            out.retuned = self.constants.iter().filter(|e| e.is_moved() && !is_named(e)).map(retuned).collect();
        }
        out.retuned.sort_by(|a, b| b.sigmas.abs().total_cmp(&a.sigmas.abs()));
        out.tuning = self.constants.iter().map(|e| (e.name.clone(), e.value)).collect();
        out.free_runs = free_runs;
        let classes = (0..self.named.len()).map(|k| (&self.named[k], self.alike(k, &out.free_runs)));
        let classes = classes.filter(|(_, alike)| !alike.is_empty());
        out.indistinguishable =
            classes.map(|(c, alike)| std::iter::once(c.label.clone()).chain(alike).collect()).collect();
        let standing = Standing::new(&out.free_runs);
        if out.verdict == Verdict::Explained {
            out.limits.extend(standing.and_then(|s| s.doubt(&out.free_runs, self.rival)));
        }
        if self.answer == Answer::Retune {
            out.limits.extend(standing.and_then(|s| s.objection_to_re_tuning()));
        }
        out
    }

    /// Labels of the causes that cannot be told from a named one: by their evidence, and the rival of the first where it
    /// forecasts what was left out nearly as well.
    pub(crate) fn alike(&self, named: usize, free_runs: &[FreeRun]) -> Vec<String> {
        let mut out = self.named[named].alike.clone();
        let over_rival = Standing::new(free_runs).and_then(|s| s.over_placebo);
        let forecasts_as_well = over_rival.is_some_and(|ratio| ratio > SETTINGS.naming.near_forecast);
        let rival = self.rival.filter(|rival| named == 0 && forecasts_as_well && out.iter().all(|a| a != rival));
        out.extend(rival.map(str::to_owned));
        out
    }

    /// All answers with their probabilities, the given one first.
    fn ranked(&self) -> Vec<Cause> {
        let is_unknown = self.answer == Answer::Unknown;
        // Candidates that do not account for the drives share what "unknown" leaves.
        let trust = if is_unknown { SETTINGS.naming.listed } else { 1.0 };
        let trusted = |named: &NamedCause| Cause { probability: trust * named.probability, ..cause(named) };
        let mut out: Vec<Cause> = self.named.iter().map(trusted).collect();
        for (label, probability) in self.others.iter().map(|(label, p)| (label, p * trust)) {
            if probability >= SETTINGS.naming.listed {
                let id = label.split(' ').next().unwrap_or(label);
                out.push(Cause::plain(id, label, probability));
            }
        }
        let doubt = self.doubt();
        let none = match self.answer {
            Answer::Nothing | Answer::Retune => self.nothing_else(),
            Answer::Named | Answer::Unknown => trust * none_of(self.named.iter().map(|c| c.probability)),
        };
        let unknown = if is_unknown { 1.0 - SETTINGS.naming.listed } else { doubt };
        out.push(Cause::plain(NONE.id, NONE.name, none));
        out.push(Cause::plain(UNKNOWN.id, UNKNOWN.name, unknown));
        if self.answer != Answer::Named {
            // What is told comes first where it is as likely as another.
            let is_other = |c: &Cause| c.effect != NONE.id;
            out.sort_by(|a, b| b.probability.total_cmp(&a.probability).then(is_other(a).cmp(&is_other(b))));
        }
        out
    }

    /// Probability that none of the causes that are not named is there, nor anything unknown.
    pub(crate) fn nothing_else(&self) -> f64 {
        (1.0 - self.doubt()) * none_of(self.others.iter().map(|(_, p)| *p))
    }

    /// Probability of something unknown where nothing is called missing and yet recordings leave more than references do, or, without
    /// any, more than usual.
    pub(crate) fn doubt(&self) -> f64 {
        let rules = SETTINGS.beside_references;
        let nothing = matches!(self.answer, Answer::Nothing | Answer::Retune);
        let beside = self.beside_references.filter(|[left, _]| nothing && *left > rules.doubted_least);
        let times = beside.map_or(1.0, |[left, usual]| left / usual.max(f64::MIN_POSITIVE));
        let by_references = (times - rules.doubted) / (rules.times - rules.doubted);
        let usual = self.beside_usual.filter(|_| nothing);
        let by_usual = usual.map_or(0.0, |[left, usual]| left / usual.max(f64::MIN_POSITIVE) - 1.0);
        rules.doubt * by_references.max(by_usual).clamp(0.0, 1.0)
    }
}

/// Why no next drive is advised where a cause begins or ends while the robot drives.
pub const NO_ADVICE: &str = "no next drive is advised, for that would be one for causes that are always there: record the same drive again, \
                             and see whether the cause is still there";

/// Whether a cause is a slip that would be a gain.
pub fn gains(named: &NamedCause) -> bool {
    [SLIP_WITH_TURNING.id, SLIP_WITH_SPEED.id].contains(&named.spec.id)
        && named.estimates.first().is_some_and(|e| e.value < 0.0)
}

/// The unit of a constant as effects tell theirs.
fn unit_of(e: &Estimate) -> &str {
    if e.unit == "1" { "-" } else { e.unit }
}

/// The number that tells how large a cause is: the first, or the one that moved most where that is as it was given, such as the slope
/// along the other axis.
fn size(estimates: &[Estimate]) -> Option<&Estimate> {
    let first = estimates.first()?;
    let moved = |e: &Estimate| (e.value - e.given).abs() / e.half_width.max(f64::MIN_POSITIVE);
    let farthest = estimates.iter().max_by(|a, b| moved(a).total_cmp(&moved(b)))?;
    Some(if moved(first) > 1.0 { first } else { farthest })
}

fn cause(named: &NamedCause) -> Cause {
    let mut out = Cause::plain(named.spec.id, &named.label, named.probability);
    if let Some(size) = size(&named.estimates) {
        // Sizes of lengths and gains are factors; these numbers themselves stand among the parameters.
        let is_factor = size.given != 0.0 && named.spec.unit == "-" && unit_of(size) != "-";
        let factor = if is_factor { size.given } else { 1.0 };
        out.magnitude = Some(size.value / factor);
        out.sigma = Some(size.half_width / NINETY / factor.abs());
        out.unit = if is_factor { "-" } else { unit_of(size) }.to_owned().into();
    }
    let number =
        |e: &Estimate| verdict::Estimate { value: e.value, sigma: Some(e.half_width / NINETY), at_bound: false };
    out.parameters = named.estimates.iter().map(|e| (e.name.clone(), number(e))).collect();
    if !named.intervals.is_empty() {
        let mut intervals: BTreeMap<String, Vec<[f64; 2]>> = BTreeMap::new();
        for (recording, interval) in &named.intervals {
            intervals.entry(recording.clone()).or_default().push(*interval);
        }
        out.intervals = Some(intervals);
    }
    out
}

fn retuned(e: &Estimate) -> Retuned {
    Retuned {
        constant: e.name.clone(),
        unit: unit_of(e).to_owned(),
        from: e.given,
        to: e.value,
        half_width: e.half_width,
        sigmas: e.sigmas,
    }
}

/// Free runs of one recording on which nothing was fitted, from medians of position, m, and heading, rad: by simulation (as
/// stated, re-tuned, corrected, placebo), then by length, s. `from`: what they are computed from.
pub fn free_runs(
    recording: &str,
    from: &str,
    lengths: [f64; 3],
    medians: impl Fn(usize, usize) -> Option<[Option<f64>; 2]>,
) -> Vec<FreeRun> {
    let mut out = Vec::new();
    for (k, length) in lengths.iter().enumerate() {
        for (axis, quantity, unit) in [(0, "position", "m"), (1, "heading", "rad")] {
            let of = |row: usize| medians(row, k).and_then(|m| m[axis]);
            let [Some(nominal), Some(retuned), Some(corrected)] = [of(0), of(1), of(2)] else { continue };
            out.push(FreeRun {
                recording: recording.to_owned(),
                quantity: format!("{quantity} after {length} s from {from}, median, {unit}"),
                nominal,
                retuned,
                corrected,
                placebo: of(3),
            });
        }
    }
    out
}

/// Length, s, of a free run that [`free_runs`] has written, if it is one of this quantity: "position" or "heading".
pub fn length_of(run: &FreeRun, quantity: &str) -> Option<f64> {
    let rest = run.quantity.strip_prefix(quantity)?.strip_prefix(" after ")?;
    rest.split_once(" s from ")?.0.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_of_free_runs_are_read_as_they_are_written() {
        let runs = free_runs("run", "counts alone", [2.0, 10.0, 0.5], |_, _| Some([Some(1.0), Some(2.0)]));
        let of = |quantity: &str| runs.iter().filter_map(|run| length_of(run, quantity)).collect::<Vec<_>>();
        assert_eq!((of("position"), of("heading"), of("speed")), (vec![2.0, 10.0, 0.5], vec![2.0, 10.0, 0.5], vec![]));
    }

    #[test]
    fn the_size_of_a_cause_is_its_first_number_that_moved_in_its_own_unit() {
        let number = |name: &str, unit, given: f64, value: f64| Estimate {
            name: name.to_owned(),
            unit,
            given,
            value,
            half_width: 0.01,
            sigmas: 1.0,
        };
        let of = |estimates: Vec<Estimate>| {
            let spec = &catalogue::car::DRIVE_FRICTION;
            let label = spec.id.to_owned();
            let (alike, intervals) = (Vec::new(), Vec::new());
            let told = cause(&NamedCause { spec, label, probability: 0.9, alike, estimates, intervals, onset: None });
            (told.magnitude.expect("a size"), told.unit.to_string())
        };
        let dry = |value| number("dry friction", "m/s²", 0.1, value);
        let viscous = number("viscous friction", "1/s", 0.03, 0.15);
        assert_eq!(of(vec![dry(0.2), viscous.clone()]), (0.2, "m/s²".to_owned()));
        assert_eq!(of(vec![dry(0.105), viscous]), (0.15, "1/s".to_owned()));
    }

    #[test]
    fn probabilities_of_all_answers_add_up_whatever_the_answer_is() {
        let named = [NamedCause {
            spec: &catalogue::odometry::STEERING_ZERO,
            label: "steering_zero (front)".to_owned(),
            probability: 0.8,
            alike: Vec::new(),
            estimates: Vec::new(),
            intervals: Vec::new(),
            onset: None,
        }];
        for answer in [Answer::Named, Answer::Unknown] {
            let shares = [0.3, 0.2, 0.1];
            let found = Found {
                answer,
                named: &named,
                others: &[],
                constants: &[],
                retuned: &[],
                rival: None,
                shares,
                beside_references: None,
                beside_usual: None,
                unconfirmed: None,
                unknown: Unaccounted::Refuted,
            };
            let told = found.verdict(Vec::new());
            let total: f64 = told.ranked.iter().map(|c| c.probability).sum();
            approx::assert_relative_eq!(total, 1.0, epsilon = 1e-12);
            let first = if answer == Answer::Named { "steering_zero" } else { UNKNOWN.id };
            assert_eq!(told.ranked[0].effect, first);
        }
    }
}
