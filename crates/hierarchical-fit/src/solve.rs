//! From drives to fitted constants and named causes.

use nalgebra::DVector;

use crate::answered::{Answered, is_moved, scores};
use crate::believable::believable;
use crate::cause::Cause;
use crate::data::{Data, Prior};
use crate::descent::sessions;
use crate::fit::{Fit, fit, likelier, without};
use crate::look_alikes::exchanged;
use crate::name::{Named, name};
use crate::observed::Observed;
use crate::onset::Onset;
use crate::onset::search::onset;
use crate::references::{Known, known, weighed_with};
use crate::sentences::lacking_in_all;
use crate::settings::SETTINGS;
use crate::weigh::{Evidence, Posterior};

/// Drives with the constants fitted to them, and what was named.
pub struct Solved<D: Observed> {
    /// The drives.
    pub data: Data<D>,
    /// What could be named.
    pub causes: Vec<Cause>,
    /// What was known before these drives.
    pub prior: Prior,
    /// Constants as they fit best.
    pub fit: Fit,
    /// Constants as they fit best where none of the causes is there.
    pub retuned: Fit,
    /// What was named.
    pub named: Named,
    /// When one of the causes begins or ends, where it is not there all the time.
    pub onset: Option<Onset>,
    /// Error that the best answer leaves of the references, as a share of their motion; `None` without any.
    pub left_of_references: Option<f64>,
    /// Causes that references and recordings ask for alike, so that they are no difference between them.
    pub in_all: Vec<usize>,
}

/// Fits drives and names causes, after references in which the model was right; `None` where equations have no solution.
pub fn solve<D: Observed>(data: Data<D>, references: Option<&Data<D>>, mut causes: Vec<Cause>) -> Option<Solved<D>> {
    let of_file = data.prior();
    let before = known(references, of_file.clone(), &causes)?;
    let (best, retuned) = answered(&data, &before.prior, &causes, before.prior.mean.as_slice().to_vec())?;
    let best = exchanged(&data, &before.prior, &causes, &retuned, best)?;
    let (known, best, retuned) = if let Some(right) = references {
        weighed_with((&data, right), (&of_file, &causes), before, (best, retuned))?
    } else {
        let (best, retuned) = believable(&data, &before.prior, &mut causes, (best, retuned))?;
        (before, best, retuned)
    };
    let Known { prior, left_of_references, in_all, .. } = known;
    let (fit, named) = told((&data, &prior, references.is_some()), &causes, best, &retuned)?;
    let (onset, named) = with_onset(&data, &prior, &causes, (&fit, named));
    Some(Solved { data, causes, prior, fit, retuned, named, onset, left_of_references, in_all })
}

impl<D: Observed> Solved<D> {
    /// What references and recordings lack alike, for people.
    pub fn lacking_in_all(&self) -> Option<String> {
        lacking_in_all(self.in_all.iter().map(|&c| &self.causes[c]))
    }

    /// The same without one of its drives: constants and causes follow from the equations of the others, set up once more
    /// where those lead.
    pub fn without(&self, left: usize) -> Option<Self> {
        let mut data = self.data.clone();
        data.drives.remove(left);
        let Self { causes, prior, .. } = self;
        let of_named = |fit: &Fit| {
            let mut named = named_about(&data, prior, causes, fit)?;
            within(&data, &mut named);
            Some(named)
        };
        let of_none = |fit: &Fit| {
            let posterior = about(&data, prior, fit)?.posterior(&prior.covariance)?;
            Some(Posterior { mean: data.bounded(&posterior), ..posterior })
        };
        // How much drives scatter is judged where what was named may be there: else it would all be scatter.
        let set: Vec<usize> = self.named.chosen.iter().map(|w| w.cause).collect();
        let wide = prior.with(causes, &set);
        let moved = |from: &Fit, known: &Prior, to: &dyn Fn(&Fit) -> Option<DVector<f64>>| {
            let mut fit = without(&data, known, from, left);
            fit.theta = to(&fit)?.as_slice().to_vec();
            fit.sessions = sessions(&data, &fit.theta, &fit.own, fit.noise);
            Some(fit)
        };
        let fit = moved(&self.fit, &wide, &|fit| Some(of_named(fit)?.posterior.mean))?;
        let retuned = moved(&self.retuned, prior, &|fit| Some(of_none(fit)?.mean))?;
        let mut named = of_named(&fit)?;
        named.retuned = of_none(&retuned)?;
        drop_unmoved(causes, prior, &mut named);
        let left_of_references = self.left_of_references;
        let fit =
            if drop_unneeded((&data, prior, left_of_references.is_some()), &mut named) { retuned.clone() } else { fit };
        let (causes, prior) = (causes.clone(), prior.clone());
        let (onset, named) =
            if self.onset.is_some() { with_onset(&data, &prior, &causes, (&fit, named)) } else { (None, named) };
        let in_all = self.in_all.clone();
        Some(Self { data, causes, prior, fit, retuned, named, onset, left_of_references, in_all })
    }
}

/// Fits constants and names causes from what is known; where much is left, also from where every cause is free, and takes what
/// is more probable; also the fit without any cause.
pub(crate) fn answered<D: Observed>(
    data: &Data<D>,
    prior: &Prior,
    causes: &[Cause],
    start: Vec<f64>,
) -> Option<(Answered, Fit)> {
    let retuned = fit(data, prior, start.clone())?;
    let near = settled(data, prior, causes, retuned.clone())?;
    let left = data.share(&near.fit.theta);
    if left <= D::NEAR {
        return Some((near, retuned));
    }
    let every: Vec<usize> = (0..causes.len()).collect();
    let wide = prior.with(causes, &every);
    let free = fit(data, &wide, start)?;
    // Where the free robot leaves about as much, there is no better answer far from here.
    if data.share(&free.theta) > SETTINGS.fitting.freed * left {
        return Some((near, retuned));
    }
    let far = settled(data, prior, causes, free)?;
    let [of_far, of_near] = scores(data, prior, causes, [&far, &near]);
    Some((if of_far > of_near { far } else { near }, retuned))
}

/// The answer with a cause that begins or ends, where there is one.
fn with_onset<D: Observed>(
    data: &Data<D>,
    prior: &Prior,
    causes: &[Cause],
    (fit, named): (&Fit, Named),
) -> (Option<Onset>, Named) {
    match onset(data, prior, causes, (fit, &named)) {
        Some((onset, mut named)) => {
            let [first, rest @ ..] = named.chosen.as_slice() else { return (Some(onset), named) };
            let moved = rest.iter().filter(|w| is_moved(&causes[w.cause], prior, &named.posterior));
            named.chosen = std::iter::once(first).chain(moved).cloned().collect();
            (Some(onset), named)
        }
        None => (None, named),
    }
}

/// A cause that begins or ends while drives go on, where that says more of them than what was named of them, and the answer with it.
pub fn begun<D: Observed>(data: &Data<D>, prior: &Prior, causes: &[Cause], named: &Named) -> Option<(Onset, Named)> {
    let set: Vec<usize> = named.chosen.iter().map(|w| w.cause).collect();
    let wide = prior.with(causes, &set);
    let fit = fit(data, &wide, named.posterior.mean.as_slice().to_vec())?;
    let (onset, named) = with_onset(data, prior, causes, (&fit, named.clone()));
    Some((onset?, named))
}

/// What is told of an answer.
pub(crate) fn told<D: Observed>(
    (data, prior, has_references): (&Data<D>, &Prior, bool),
    causes: &[Cause],
    answer: Answered,
    retuned: &Fit,
) -> Option<(Fit, Named)> {
    let Answered { fit, mut named, set } = answer;
    // About where it stands the fit is what it was fitted to be.
    if named.chosen.len() == set.len() && named.chosen.iter().all(|w| set.contains(&w.cause)) {
        named.posterior.mean = DVector::from_column_slice(&fit.theta);
    }
    named.retuned = if set.is_empty() && named.chosen.is_empty() {
        named.posterior.clone()
    } else {
        let posterior = about(data, prior, retuned)?.posterior(&prior.covariance)?;
        Posterior { mean: DVector::from_column_slice(&retuned.theta), ..posterior }
    };
    within(data, &mut named);
    drop_unmoved(causes, prior, &mut named);
    let fit = if drop_unneeded((data, prior, has_references), &mut named) { retuned.clone() } else { fit };
    Some((fit, named))
}

/// Weighs the causes about a fit, and fits anew with what they name, until the same are named.
fn settled<D: Observed>(data: &Data<D>, prior: &Prior, causes: &[Cause], from: Fit) -> Option<Answered> {
    let named = named_about(data, prior, causes, &from)?;
    let mut out = Answered { fit: from, named, set: Vec::new() };
    let mut tried = vec![Vec::new()];
    for _ in 0..SETTINGS.naming.rounds {
        let mut set: Vec<usize> = out.named.chosen.iter().map(|w| w.cause).collect();
        set.sort_unstable();
        if tried.contains(&set) {
            break;
        }
        let narrow = prior.with(causes, &set);
        // Along a valley that only what is known closes, a fit hardly moves; the equations know where it ends.
        let ends = data.bounded(&out.named.posterior).as_slice().to_vec();
        let start = likelier(data, &narrow, &out.fit, [out.fit.theta.clone(), ends])?;
        let fit = fit(data, &narrow, start)?;
        let named = named_about(data, prior, causes, &fit)?;
        tried.push(set.clone());
        out = Answered { fit, named, set };
    }
    Some(out)
}

/// A cause whose constants are all where they were known to be, by their 90 % intervals, is none.
fn drop_unmoved(causes: &[Cause], prior: &Prior, named: &mut Named) {
    let Named { chosen, posterior, .. } = named;
    chosen.retain(|w| is_moved(&causes[w.cause], prior, posterior));
}

/// Drops all causes that ask some constant for far more sigmas than re-tuning asks any, where constants within what is known of them
/// leave hardly more of the motion and of no kind of reading much more, and whether it did: evidence counts what the laws of tyres get
/// wrong as noise of many rows, and pays for it with causes that no owner would believe.
fn drop_unneeded<D: Observed>((data, prior, has_references): (&Data<D>, &Prior, bool), named: &mut Named) -> bool {
    let rules = SETTINGS.naming;
    if named.chosen.is_empty() {
        return false;
    }
    let [asked, asked_without] = [&named.posterior, &named.retuned].map(|posterior| {
        let sigmas = |k: usize| (posterior.mean[k] - prior.mean[k]).abs() / prior.covariance[(k, k)].sqrt();
        (0..prior.mean.len()).map(sigmas).fold(0.0, f64::max)
    });
    let is_within = asked_without <= rules.within[usize::from(has_references)] && asked > rules.nearer * asked_without;
    let both = [&named.posterior, &named.retuned];
    let [with, without] = both.map(|p| data.share(p.mean.as_slice()));
    // A wheel of another radius is at odds with its encoder first.
    let is_seen = || {
        let [with, without] = both.map(|p| data.left(p.mean.as_slice()));
        with.iter().zip(without).any(|(with, without)| *with < D::HARDLY.min(rules.seen) * without)
    };
    let is_unneeded = is_within && with > D::HARDLY * without && !is_seen();
    if is_unneeded {
        named.others.extend(named.chosen.drain(..).map(|w| (w.cause, rules.doubted * w.probability)));
        named.posterior = named.retuned.clone();
        (named.placebo, named.rival) = (None, None);
    }
    is_unneeded
}

/// Keeps constants within what they can be.
fn within<D: Observed>(data: &Data<D>, named: &mut Named) {
    let Named { posterior, retuned, placebo, .. } = named;
    for posterior in [Some(posterior), Some(retuned), placebo.as_mut().map(|(_, p)| p)].into_iter().flatten() {
        posterior.mean = data.bounded(posterior);
    }
}

fn named_about<D: Observed>(data: &Data<D>, prior: &Prior, causes: &[Cause], fit: &Fit) -> Option<Named> {
    name(&about(data, prior, fit)?, &prior.covariance, causes)
}

/// What the drives say together, by the equations of a fit.
pub(crate) fn about<D: Observed>(data: &Data<D>, prior: &Prior, fit: &Fit) -> Option<Evidence> {
    Evidence::new(&fit.theta, &fit.sessions, &data.scatter(fit.factor), &prior.mean)
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;

    use super::*;
    use crate::cause::Possible;
    use crate::name::Weighed;
    use crate::observed::Spread;
    use crate::scaled::Scaled;

    /// A cause that moves the scale to `named` and another constant by so many sigmas, beside a scale re-tuned to `retuned`, known to
    /// 0.1, of drives that show 0.3.
    fn is_dropped(retuned: f64, (named, sigmas): (f64, f64), has_references: bool) -> bool {
        let spreads = vec![Spread { sigma: 0.1, usual: 1.0, scatter: 0.0, bounds: [-5.0, 5.0] }; 2];
        let data = Data { model: (), spreads, drives: vec![Scaled::by(0.3_f64.exp())] };
        let posterior = |mean: [f64; 2]| Posterior {
            mean: DVector::from_column_slice(&mean),
            covariance: DMatrix::identity(2, 2) * 1e-4,
        };
        let mut found = Named {
            chosen: vec![Weighed { cause: 0, probability: 0.9, class: vec![0] }],
            others: Vec::new(),
            posterior: posterior([named, 0.1 * sigmas]),
            retuned: posterior([retuned, 0.0]),
            placebo: Some((1, posterior([0.0; 2]))),
            rival: Some(1),
        };
        let is_unneeded = drop_unneeded((&data, &data.prior(), has_references), &mut found);
        let left_over = found.placebo.is_none() && found.rival.is_none();
        let all = (found.chosen.is_empty(), left_over, found.others.len());
        assert_eq!(all, (is_unneeded, is_unneeded, usize::from(is_unneeded)));
        if is_unneeded {
            assert!(found.others[0].1 < 0.3 && found.posterior.mean[0] == retuned);
        }
        is_unneeded
    }

    #[test]
    fn a_cause_beyond_belief_is_dropped_where_constants_within_what_is_known_leave_hardly_more() {
        assert!(is_dropped(0.29, (0.31, 15.0), false));
        assert!(!is_dropped(0.29, (0.31, 5.0), false), "it asks for little more than re-tuning does");
        assert!(!is_dropped(0.2, (0.3, 15.0), false), "it leaves nothing");
        assert!(!is_dropped(0.36, (0.37, 15.0), false), "3.6 sigmas are beyond what is known");
        assert!(!is_dropped(0.29, (0.31, 15.0), true), "since references 2.9 are");
        assert!(is_dropped(0.24, (0.36, 15.0), true));
    }

    /// Three drives whose scale is 1.5, with a cause that may move its logarithm to `most`.
    fn solved_with_largest(most: f64) -> Solved<Scaled> {
        let spreads = vec![Spread { sigma: 0.03, usual: 1.0, scatter: 0.1, bounds: [-5.0, 5.0] }];
        let drives = vec![Scaled::by(1.5).roughly(0.01), Scaled::by(1.5).roughly(0.01), Scaled::by(1.5).roughly(0.01)];
        let scale = Cause {
            spec: &catalogue::odometry::GYRO_SCALE,
            of: None,
            directions: vec![(vec![(0, 1.0)], 1.0)],
            possible: Some(Possible { constant: 0, least: f64::NEG_INFINITY, most }),
        };
        solve(Data { model: (), spreads, drives }, None, vec![scale]).expect("solved")
    }

    #[test]
    fn a_cause_is_named_only_where_its_constant_can_be_what_the_drives_ask_for() {
        assert_eq!(solved_with_largest(0.5).named.chosen.len(), 1, "the logarithm of 1.5 is 0.41");
        assert!(solved_with_largest(0.2).named.chosen.is_empty());
    }

    #[test]
    fn without_a_drive_what_was_named_is_no_scatter_of_the_others() {
        let solved = solved_with_largest(f64::INFINITY);
        assert_eq!(solved.named.chosen.len(), 1);

        let others = solved.without(0).expect("solved");
        assert!(others.fit.factor <= 1.0, "drives scatter by {}", others.fit.factor);
        approx::assert_relative_eq!(others.named.posterior.mean[0], 1.5_f64.ln(), max_relative = 0.02);
    }

    #[test]
    fn constants_may_have_moved_since_the_references_by_a_share_of_what_the_owner_knows() {
        let data = |usual: f64| {
            let spreads = vec![Spread { sigma: 0.1, usual, scatter: 1e-4, bounds: [-5.0, 5.0] }];
            Data { model: (), spreads, drives: vec![Scaled::by(1.0), Scaled::by(1.0)] }
        };
        let known = |usual: f64| {
            let solved = solve(data(usual), Some(&data(usual)), Vec::new()).expect("solved");
            solved.prior.covariance[(0, 0)].sqrt()
        };
        approx::assert_relative_eq!(known(1.0), 0.06, max_relative = 0.01);
        approx::assert_relative_eq!(known(0.2), 0.03, max_relative = 0.01);
    }
}
