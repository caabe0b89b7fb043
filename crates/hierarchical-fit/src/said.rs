//! What the drives of a fit say, whatever its model is.

use inference::evidence::logistic;
use inference::experiment::Standing;
use inference::robust::NINETY;
use nalgebra::DVector;
use verdict::FreeRun;

use crate::found::{Answer, Began, Estimate, NamedCause};
use crate::is_widest;
use crate::name::Weighed;
use crate::observed::Observed;
use crate::settings::SETTINGS;
use crate::solve::Solved;
use crate::telling::{Found, Unaccounted, UnevenSensor};
use crate::weigh::Posterior;

/// A constant as it is told.
pub trait Valued {
    /// Its name.
    fn name(&self) -> &str;
    /// Unit of its value.
    fn unit(&self) -> &'static str;
    /// Whether the deviation is the logarithm of a factor.
    fn is_factor(&self) -> bool;
    /// The value at a deviation.
    fn value(&self, deviation: f64) -> f64;
    /// One sigma by which a number that is told may be off because the robot has another law than the model, in the unit of its
    /// value.
    fn of_another_law(&self, value: f64) -> f64;
}

/// When something is left that no cause accounts for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unexplained {
    /// Remaining error over the motion, beyond which what is left asks for a cause.
    pub share: f64,
    /// Share of the re-tuned error that has to be left then.
    pub of_retuned: f64,
    /// Remaining error over the motion, beyond which nothing is explained, however much more was left before.
    pub most: f64,
    /// Remaining error over the motion from which on something unknown is likelier where nothing is called missing and no reference says
    /// what is usual.
    pub doubted: f64,
}

/// Causes with which drives that were left out are forecast no better than without.
#[derive(Debug, Clone, PartialEq)]
pub struct Unconfirmed {
    /// Their labels.
    pub labels: Vec<String>,
    /// How their forecasts stand.
    pub standing: Standing,
}

/// What the drives of a fit say.
#[derive(Debug, Clone)]
pub struct Said {
    /// Kind of answer.
    pub answer: Answer,
    /// Causes that were named, the one that the data would miss most first.
    pub named: Vec<NamedCause>,
    /// Causes that were not, with their probabilities.
    pub others: Vec<(String, f64)>,
    /// All constants with the named causes, after the last drive.
    pub constants: Vec<Estimate>,
    /// Constants re-tuned within what is known, with no cause.
    pub retuned: Vec<Estimate>,
    /// The cause that is little less probable than the first.
    pub rival: Option<String>,
    /// Factor on the usual scatter of constants between drives.
    pub scatter: f64,
    /// Whether that is as much as was tried: what is named with all drives is then not trusted.
    pub is_scattered: bool,
    /// Whether drives that were left out are forecast worse with the causes than as they were stated.
    pub is_refuted: bool,
    /// Root mean square error of windows over that of a robot that keeps still: as given, re-tuned, with the named causes.
    pub shares: [f64; 3],
    /// What was named and is not told, for drives that were left out do not need it.
    pub unconfirmed: Option<Unconfirmed>,
    /// The same that the best answer leaves of the references; `None` without any.
    pub left_of_references: Option<f64>,
    /// A sensor that shows another share of small sizes than of large ones.
    pub uneven: Option<UnevenSensor>,
    /// The same that the noise of what is measured alone would leave.
    pub share_of_noise: f64,
    /// The same from which on something unknown is likelier; without references.
    pub doubted: Option<f64>,
}

impl<D: Observed> Solved<D> {
    /// What the drives say; its answer is yet to be [decided](Said::decide).
    pub fn said(&self, constants: &[impl Valued]) -> Said {
        let Self { data, causes, prior, fit, named, .. } = self;
        let estimates = |posterior: &Posterior| -> Vec<Estimate> {
            constants.iter().enumerate().map(|(k, c)| self.estimate(c, posterior, k)).collect()
        };
        let all = estimates(&named.posterior);
        let of_cause = |weighed: &Weighed| {
            NamedCause::new(weighed, causes, &all, (self.spans(weighed.cause), self.began(weighed.cause)))
        };
        let factor = self.onset.as_ref().map_or(fit.factor, |onset| onset.factor);
        Said {
            answer: Answer::Nothing,
            named: named.chosen.iter().map(of_cause).collect(),
            // What was not taken, though straight lines about the answer speak for it, is no surer than what just misses.
            others: named
                .others
                .iter()
                .map(|&(c, p)| (causes[c].label(), p.min(logistic(SETTINGS.naming.named))))
                .collect(),
            retuned: estimates(&named.retuned),
            rival: named.rival.map(|c| causes[c].label()),
            scatter: factor,
            // Deviations of single drives explain everything where they are as free as was tried.
            is_scattered: data.drives.len() > 1 && is_widest(factor),
            is_refuted: false,
            unconfirmed: None,
            shares: [data.share(prior.mean.as_slice()), data.share(named.retuned.mean.as_slice()), self.share()],
            left_of_references: self.left_of_references,
            uneven: None,
            share_of_noise: data.share_of_noise(),
            doubted: None,
            constants: estimates(&Posterior {
                mean: DVector::from_column_slice(self.corrected_from_now_on()),
                ..named.posterior.clone()
            }),
        }
    }

    /// When a cause is there, by drive; nothing where it is there all the time.
    fn spans(&self, cause: usize) -> Vec<(String, [f64; 2])> {
        let Some(onset) = self.onset.as_ref().filter(|onset| onset.cause == cause) else { return Vec::new() };
        onset.spans(self.data.drives.iter().map(|d| (d.name(), d.seconds())))
    }

    fn began(&self, cause: usize) -> Option<Began> {
        let onset = self.onset.as_ref().filter(|onset| onset.cause == cause)?;
        let names: Vec<&str> = self.data.drives.iter().map(Observed::name).collect();
        onset.began(&names)
    }

    /// What the answer leaves of the motion.
    fn share(&self) -> f64 {
        let theta = self.named.posterior.mean.as_slice();
        self.onset.as_ref().map_or_else(|| self.data.share(theta), |onset| self.data.share_with(theta, onset))
    }

    fn estimate(&self, constant: &impl Valued, posterior: &Posterior, k: usize) -> Estimate {
        let prior = &self.prior;
        let sd = posterior.covariance[(k, k)].max(0.0).sqrt();
        let value = constant.value(posterior.mean[k]);
        let sd_of_value = sd * if constant.is_factor() { value.abs() } else { 1.0 };
        Estimate {
            name: constant.name().to_owned(),
            unit: constant.unit(),
            given: constant.value(prior.mean[k]),
            value,
            half_width: NINETY * sd_of_value.hypot(constant.of_another_law(value)),
            sigmas: (posterior.mean[k] - prior.mean[k]) / prior.covariance[(k, k)].sqrt(),
        }
    }
}

impl Said {
    /// Decides the answer. `is_stated`: whether a constant that moved is told as re-tuned.
    pub fn decide(&mut self, rules: Unexplained, is_stated: impl Fn(&Estimate) -> bool) {
        self.doubted = Some(rules.doubted).filter(|_| self.left_of_references.is_none());
        // What noise would leave is none of theirs.
        let [_, retuned, left] = self.without_noise();
        let is_left = left > rules.most
            || (left > rules.share && left > rules.of_retuned * retuned)
            || is_beyond_references(left, self.left_of_references)
            || self.uneven.is_some();
        self.answer = if is_left || (self.is_scattered && !self.named.is_empty()) {
            Answer::Unknown
        } else if !self.named.is_empty() {
            Answer::Named
        } else if self.retuned.iter().filter(|e| is_stated(e)).any(Estimate::is_moved) {
            Answer::Retune
        } else {
            Answer::Nothing
        };
    }

    /// Judges what was named by drives that were left out, and [decides](Said::decide) anew; whether it was taken back. Causes with which
    /// they are forecast worse than as stated, and which leave more of the motion than `rules.share`, are refuted: something else is
    /// missing. Re-tuned constants that no owner would believe may forecast better and refute nothing. Causes with which they are
    /// forecast hardly better than as stated, or worse than re-tuned, or which show in no drive beside re-tuned constants, are confirmed by
    /// nothing, and no longer named; but where forecasts could
    /// not show one of them: where `shows` says so, as of a sensor that they do not predict, and where it is there in a single drive.
    pub fn judge(
        &mut self,
        free_runs: &[FreeRun],
        rules: Unexplained,
        is_stated: impl Fn(&Estimate) -> bool,
        shows: impl Fn(&NamedCause) -> bool,
    ) -> bool {
        let naming = SETTINGS.naming;
        let Some(standing) = Standing::new(free_runs).filter(|_| self.answer == Answer::Named) else { return false };
        if standing.over_nominal > naming.refuted && self.shares[2] > rules.share {
            self.is_refuted = true;
            self.answer = Answer::Unknown;
        }
        let [_, retuned, left] = self.shares;
        let is_no_better = standing.over_retuned >= naming.no_better && left >= naming.no_better * retuned;
        let is_worse =
            (standing.over_retuned >= naming.worse || is_no_better) && self.retuned.iter().all(Estimate::is_believable);
        let is_confirmed = standing.over_nominal < naming.confirmed && !is_worse;
        let is_shown = |cause: &NamedCause| shows(cause) && !cause.is_in_one_drive();
        if self.answer != Answer::Named || is_confirmed || !self.named.iter().all(is_shown) {
            return false;
        }
        let labels = self.named.iter().map(|cause| cause.label.clone()).collect();
        self.unconfirmed = Some(Unconfirmed { labels, standing });
        self.others.extend(self.named.drain(..).map(|cause| (cause.label, naming.doubted * cause.probability)));
        self.others.sort_by(|a, b| b.1.total_cmp(&a.1));
        self.constants.clone_from(&self.retuned);
        self.shares[2] = self.shares[1];
        self.rival = None;
        self.decide(rules, is_stated);
        true
    }

    /// The same for a verdict.
    pub fn found(&self) -> Found<'_> {
        Found {
            answer: self.answer,
            named: &self.named,
            others: &self.others,
            constants: &self.constants,
            retuned: &self.retuned,
            rival: self.rival.as_deref(),
            shares: self.shares,
            beside_references: self.left_of_references.map(|usual| [self.without_noise()[2], usual]),
            beside_usual: self.doubted.map(|usual| [self.without_noise()[2], usual]),
            unconfirmed: self.unconfirmed.as_ref(),
            unknown: if let Some(uneven) = self.uneven {
                Unaccounted::Uneven(uneven)
            } else if self.is_scattered {
                Unaccounted::Scattered(self.scatter)
            } else if self.is_refuted {
                Unaccounted::Refuted
            } else {
                Unaccounted::Left { of_references: self.left_of_references }
            },
        }
    }

    /// Errors as shares of the motion, but for what noise alone would leave.
    fn without_noise(&self) -> [f64; 3] {
        self.shares.map(|share| (share.powi(2) - self.share_of_noise.powi(2)).max(0.0).sqrt())
    }
}

/// Whether so many times as much is left of the recordings, as a share of their motion, as of the references that something is missing
/// which the answer does not hold.
pub fn is_beyond_references(left: f64, of_references: Option<f64>) -> bool {
    let rules = SETTINGS.beside_references;
    of_references.is_some_and(|usual| left > rules.least && left > rules.times * usual)
}

/// The sentence about it, where it is so.
pub(crate) fn beyond_references(left: f64, of_references: Option<f64>) -> Option<String> {
    let usual = of_references.filter(|_| is_beyond_references(left, of_references))?;
    Some(format!(
        " The same model leaves {:.1} % of the motion of the references, so that {:.0} times as much is no noise.",
        100.0 * usual,
        left / usual.max(f64::MIN_POSITIVE)
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A zero of the steering is named, and such shares of the motion are left.
    fn named(shares: [f64; 3]) -> Said {
        let cause = NamedCause {
            spec: &catalogue::odometry::STEERING_ZERO,
            label: "steering_zero".to_owned(),
            probability: 0.9,
            alike: Vec::new(),
            estimates: Vec::new(),
            intervals: Vec::new(),
            onset: None,
        };
        Said {
            answer: Answer::Named,
            named: vec![cause],
            others: Vec::new(),
            constants: Vec::new(),
            retuned: Vec::new(),
            rival: None,
            scatter: 1.0,
            is_scattered: false,
            is_refuted: false,
            unconfirmed: None,
            shares,
            left_of_references: None,
            uneven: None,
            share_of_noise: 0.0,
            doubted: None,
        }
    }

    #[test]
    fn an_answer_is_unknown_where_much_is_left_or_drives_differ_too_much_to_trust_a_cause() {
        let rules = Unexplained { share: 0.1, of_retuned: 0.8, most: 0.4, doubted: 0.04 };
        let estimate = |value: f64| Estimate {
            name: "length".to_owned(),
            unit: "m",
            given: 1.0,
            value,
            half_width: 0.1,
            sigmas: (value - 1.0) / 0.1,
        };
        let decided = |shares, is_scattered, retuned: f64, is_named: bool| {
            let mut said = Said { retuned: vec![estimate(retuned)], is_scattered, ..named(shares) };
            said.named.truncate(usize::from(is_named));
            said.decide(rules, |e| e.name == "length");
            said.answer
        };
        assert_eq!(decided([0.2, 0.05, 0.05], false, 1.0, false), Answer::Nothing);
        assert_eq!(decided([0.2, 0.05, 0.05], false, 1.5, false), Answer::Retune);
        assert_eq!(decided([0.2, 0.15, 0.05], false, 1.5, true), Answer::Named);
        assert_eq!(decided([0.2, 0.15, 0.05], true, 1.5, true), Answer::Unknown);
        assert_eq!(decided([0.2, 0.12, 0.11], false, 1.5, true), Answer::Unknown);
        assert_eq!(decided([0.9, 0.3, 0.12], false, 1.5, true), Answer::Named);
        assert_eq!(decided([2.0, 1.9, 0.5], false, 1.5, true), Answer::Unknown);
    }

    #[test]
    fn a_sensor_of_uneven_shares_is_unknown_however_little_is_left() {
        let uneven =
            UnevenSensor { sensor: "encoder", quantity: "speed", unit: "m/s", limit: 2.6, small: 1.0, large: 0.7 };
        let mut said = Said { uneven: Some(uneven), ..named([0.9, 0.02, 0.01]) };
        said.decide(Unexplained { share: 0.1, of_retuned: 0.8, most: 0.4, doubted: 0.04 }, |_| true);
        assert_eq!((said.answer, said.found().unknown), (Answer::Unknown, Unaccounted::Uneven(uneven)));
    }

    #[test]
    fn what_leaves_many_times_as_much_as_the_references_is_not_explained() {
        assert!(is_beyond_references(0.05, Some(0.01)) && !is_beyond_references(0.05, Some(0.02)));
        assert!(!is_beyond_references(0.015, Some(0.001)), "hardly anything is left");
        assert!(!is_beyond_references(0.5, None), "nothing says what is usual");
        let told = beyond_references(0.05, Some(0.01)).expect("a sentence");
        assert!(told.contains("leaves 1.0 % of the motion of the references, so that 5 times"), "{told}");
    }

    #[test]
    fn what_is_named_is_refuted_or_taken_back_where_left_out_drives_do_not_need_it() {
        let free_run = |[nominal, retuned, corrected]: [f64; 3]| FreeRun {
            recording: "a".to_owned(),
            quantity: "position, m".to_owned(),
            nominal,
            retuned,
            corrected,
            placebo: None,
        };
        let judged_with = |onset: Option<Began>, is_shown: bool, errors: [f64; 3], left: f64| {
            let mut said = Said { others: vec![("gyro_bias".to_owned(), 0.1)], ..named([1.0, 0.09, left]) };
            said.named[0].onset = onset;
            let rules = Unexplained { share: 0.05, of_retuned: 1.5, most: 0.4, doubted: 0.04 };
            let is_taken_back = said.judge(&[free_run(errors)], rules, |_| true, |_| is_shown);
            assert_eq!((is_taken_back, is_taken_back), (said.unconfirmed.is_some(), said.named.is_empty()));
            if is_taken_back {
                approx::assert_relative_eq!(said.others[0].1, SETTINGS.naming.doubted * 0.9);
                approx::assert_relative_eq!(said.shares[2], 0.09);
            }
            said.answer
        };
        let judged_where = |is_shown, errors, left| judged_with(None, is_shown, errors, left);
        let judged = |errors: [f64; 3], left: f64| judged_where(true, errors, left);
        assert_eq!(judged([2.0, 1.0, 0.9], 0.08), Answer::Named);
        assert_eq!(judged([2.0, 1.0, 1.05], 0.08), Answer::Named, "hardly worse than re-tuned");
        assert_eq!(judged([2.0, 1.0, 1.3], 0.08), Answer::Nothing, "worse than re-tuned");
        assert_eq!(judged([2.0, 1.0, 1.0], 0.089), Answer::Nothing, "no drive shows it");
        assert_eq!(judged([2.0, 1.0, 0.97], 0.089), Answer::Named, "drives that were left out do");
        assert_eq!(judged([1.0, 2.0, 0.98], 0.08), Answer::Nothing, "hardly better than as stated");
        assert_eq!(judged_where(false, [1.0, 2.0, 0.98], 0.08), Answer::Named, "a sensor that they do not predict");
        let began = |others: bool| {
            Some(Began { drive: "b".to_owned(), at: Some((9.0, [8.0, 10.0])), anew: Vec::new(), ends: false, others })
        };
        let of_one = judged_with(began(false), true, [1.0, 2.0, 0.98], 0.08);
        assert_eq!(of_one, Answer::Named, "no other drive shows it");
        assert_eq!(judged_with(began(true), true, [1.0, 2.0, 0.98], 0.08), Answer::Nothing, "drives after it do");
        assert_eq!(judged([1.0, 2.0, 1.3], 0.08), Answer::Unknown, "far worse than as stated");
        assert_eq!(judged([1.0, 2.0, 1.3], 0.04), Answer::Nothing, "the same where it leaves hardly anything");
    }

    #[test]
    fn re_tuned_constants_that_no_owner_would_believe_take_nothing_back() {
        let is_taken_back = |sigmas: f64| {
            let mut said = named([1.0, 0.09, 0.08]);
            let (name, unit) = ("steering zero".to_owned(), "rad");
            said.retuned.push(Estimate { name, unit, given: 0.0, value: 0.05, half_width: 0.002, sigmas });
            let free_run = FreeRun {
                recording: "a".to_owned(),
                quantity: "position, m".to_owned(),
                nominal: 2.0,
                retuned: 1.0,
                corrected: 1.3,
                placebo: None,
            };
            let rules = Unexplained { share: 0.05, of_retuned: 1.5, most: 0.4, doubted: 0.04 };
            said.judge(&[free_run], rules, |_| true, |_| true)
        };
        assert_eq!([2.0, -5.2].map(is_taken_back), [true, false]);
    }
}
