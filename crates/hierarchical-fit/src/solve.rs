//! From drives to fitted constants and named causes.

use nalgebra::{DMatrix, DVector};

use crate::answered::{Answered, is_moved, scores};
use crate::cause::Cause;
use crate::data::{Data, Prior};
use crate::descent::sessions;
use crate::fit::{Fit, fit, likelier, without};
use crate::look_alikes::exchanged;
use crate::name::{Named, covariance, name};
use crate::observed::Observed;
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
}

/// Fits drives and names causes, after references in which the model was right; `None` where equations have no solution.
pub fn solve<D: Observed>(data: Data<D>, references: Option<&Data<D>>, causes: Vec<Cause>) -> Option<Solved<D>> {
    let mut prior = data.prior();
    if let Some(right) = references {
        // What they may be told to lack is of no interest: constants and scatter are.
        let (of_right, retuned) = answered(right, &prior, &causes, prior.mean.as_slice().to_vec())?;
        let (fit, named) = told(right, &prior, &causes, of_right, &retuned)?;
        let scatter = right.scatter(fit.factor);
        let between = DMatrix::from_diagonal(&scatter.component_mul(&scatter));
        prior = Prior { mean: named.posterior.mean, covariance: named.posterior.covariance + between };
    }
    let start = prior.mean.as_slice().to_vec();
    let (best, retuned) = answered(&data, &prior, &causes, start)?;
    let best = exchanged(&data, &prior, &causes, &retuned, best)?;
    let (fit, named) = told(&data, &prior, &causes, best, &retuned)?;
    Some(Solved { data, causes, prior, fit, retuned, named })
}

impl<D: Observed> Solved<D> {
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
            Some(Posterior { mean: DVector::from_vec(data.within_bounds(&posterior.mean)), ..posterior })
        };
        let moved = |from: &Fit, to: &dyn Fn(&Fit) -> Option<DVector<f64>>| {
            let mut fit = without(&data, prior, from, left);
            fit.theta = to(&fit)?.as_slice().to_vec();
            fit.sessions = sessions(&data, &fit.theta, &fit.own, fit.noise);
            Some(fit)
        };
        let fit = moved(&self.fit, &|fit| Some(of_named(fit)?.posterior.mean))?;
        let retuned = moved(&self.retuned, &|fit| Some(of_none(fit)?.mean))?;
        let mut named = of_named(&fit)?;
        named.retuned = of_none(&retuned)?;
        drop_unmoved(causes, prior, &mut named);
        let (causes, prior) = (causes.clone(), prior.clone());
        Some(Self { data, causes, prior, fit, retuned, named })
    }
}

/// Fits constants and names causes from what is known; where much is left, also from where every cause is free, and takes what
/// is more probable; also the fit without any cause.
fn answered<D: Observed>(data: &Data<D>, prior: &Prior, causes: &[Cause], start: Vec<f64>) -> Option<(Answered, Fit)> {
    let retuned = fit(data, prior, start.clone())?;
    let near = settled(data, prior, causes, retuned.clone())?;
    let left = data.share(&near.fit.theta);
    if left <= D::NEAR {
        return Some((near, retuned));
    }
    let every: Vec<usize> = (0..causes.len()).collect();
    let wide = Prior { mean: prior.mean.clone(), covariance: covariance(&prior.covariance, causes, &every) };
    let free = fit(data, &wide, start)?;
    // Where the free robot leaves about as much, there is no better answer far from here.
    if data.share(&free.theta) > SETTINGS.fitting.freed * left {
        return Some((near, retuned));
    }
    let far = settled(data, prior, causes, free)?;
    let [of_far, of_near] = scores(data, prior, causes, [&far, &near]);
    Some((if of_far > of_near { far } else { near }, retuned))
}

/// What is told of an answer.
fn told<D: Observed>(
    data: &Data<D>,
    prior: &Prior,
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
        let narrow = Prior { mean: prior.mean.clone(), covariance: covariance(&prior.covariance, causes, &set) };
        // Along a valley that only what is known closes, a fit hardly moves; the equations know where it ends.
        let ends = data.within_bounds(&out.named.posterior.mean);
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

/// Keeps constants within what they can be.
fn within<D: Observed>(data: &Data<D>, named: &mut Named) {
    let Named { posterior, retuned, placebo, .. } = named;
    for posterior in [Some(posterior), Some(retuned), placebo.as_mut().map(|(_, p)| p)].into_iter().flatten() {
        posterior.mean = DVector::from_vec(data.within_bounds(&posterior.mean));
    }
}

fn named_about<D: Observed>(data: &Data<D>, prior: &Prior, causes: &[Cause], fit: &Fit) -> Option<Named> {
    name(&about(data, prior, fit)?, &prior.covariance, causes)
}

/// What the drives say together, by the equations of a fit.
fn about<D: Observed>(data: &Data<D>, prior: &Prior, fit: &Fit) -> Option<Evidence> {
    Evidence::new(&fit.theta, &fit.sessions, &data.scatter(fit.factor), &prior.mean)
}
