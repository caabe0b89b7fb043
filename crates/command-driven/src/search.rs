//! Fits and left-out forecasts of one part of the response, and which elements earn their place.

use inference::least_squares::{Constant as FreeConstant, Loss, Residuals, Settings};
use inference::robust::mean_with_error;
use rayon::prelude::*;
use verdict::{Element, ResponseConstant};

use crate::settings::{Fit, SETTINGS, Weighing};
use crate::windows::{FOLDS, Windows};

const FIT: Fit = SETTINGS.fit;
const WEIGHING: Weighing = SETTINGS.evidence;

/// A part of the response that is fitted on its own: command to wheel, or wheel to body.
pub(crate) trait Part: Sync {
    /// What has no size.
    type Law: Copy + PartialEq + Send + Sync + std::fmt::Debug;
    fn constants(&self) -> &[ResponseConstant];
    fn windows(&self) -> &Windows;
    /// Errors in units beyond which they count linearly; the same number of rows for every window.
    fn residuals(&self, law: Self::Law, x: &[f64]) -> Vec<f64>;
    /// Constants of an element.
    fn free(&self, law: Self::Law, element: Element) -> Vec<usize>;
    fn restrict(&self, law: Self::Law, base: Self::Law, elements: &[Element]) -> Self::Law;
    /// Where a fit starts.
    fn guess(&self, constant: usize) -> f64;
    /// Distance over which rows may not tell a constant at all: its cost is then flat, and derivatives say nothing.
    fn flat_over(&self, _model: &Model<Self::Law>, _constant: usize) -> Option<f64> {
        None
    }

    /// Over how much of a constant rows say nothing because what they show may have come at any time since the row before.
    fn between_rows(&self, _constant: usize) -> f64 {
        0.0
    }
    /// One sigma by which a constant is another one because no robot follows the law quite, as a share.
    fn law_error(&self, _model: &Model<Self::Law>) -> f64 {
        0.0
    }

    /// Constants that say where a motion ends.
    fn levels(&self) -> &'static [usize] {
        &[]
    }

    /// Rows of the residuals in which a motion has ended.
    fn settled(&self, _model: &Model<Self::Law>) -> Vec<bool> {
        Vec::new()
    }

    /// A constant in which the cost has several valleys, and where to start in it.
    fn starts(&self) -> (usize, &'static [f64]);
}

/// A model of a part: what the simulation says, or what was fitted.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Model<L> {
    pub(crate) law: L,
    pub(crate) x: Vec<f64>,
}

/// A set of elements, fitted.
#[derive(Debug, Clone)]
pub(crate) struct Trial<L> {
    pub(crate) elements: Vec<Element>,
    pub(crate) free: Vec<usize>,
    /// Fitted on all windows.
    pub(crate) model: Model<L>,
    /// Fitted without the windows of each fold.
    pub(crate) folds: Vec<Model<L>>,
    /// Left-out loss of each window (Huber).
    pub(crate) loss: Vec<f64>,
    /// The answer with a lag of the other order, where that forecasts nearly as well.
    pub(crate) other_order: Option<OtherOrder>,
    /// What held before it, where it began inside recordings; it was then fitted to the windows since.
    pub(crate) began: Option<Box<Began<L>>>,
}

/// What a lag of the other order says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct OtherOrder {
    /// Dead time, and by how much the lag is late, s.
    pub(crate) dead_time: f64,
    pub(crate) lag: f64,
    /// Whether it forecasts as well.
    pub(crate) is_as_good: bool,
}

/// What held before a response began.
#[derive(Debug, Clone)]
pub(crate) struct Began<L> {
    /// What was found before, beyond the simulation.
    pub(crate) before: Trial<L>,
    /// Windows before and since.
    pub(crate) windows: [Windows; 2],
    /// Whether each window lies before, told without each fold.
    pub(crate) early_without: Vec<Vec<bool>>,
    /// Elements whose constants differ since.
    pub(crate) changed: Vec<Element>,
    /// When it began in each recording.
    pub(crate) instants: Vec<Instant>,
}

/// When a response began in a recording.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Instant {
    /// Recording.
    pub(crate) run: usize,
    /// From, until, s after its first row.
    pub(crate) interval: [f64; 2],
    /// 90 % interval of the beginning, s; `None` where it was there from the first row on.
    pub(crate) range: Option<[f64; 2]>,
    /// Fall of the cost below that of what held before, nats.
    pub(crate) gain: f64,
}

/// A model, and the one that held in early windows where it began inside recordings.
#[derive(Debug, Clone)]
pub(crate) struct Timed<L> {
    pub(crate) model: Model<L>,
    /// That of early windows, and whether each window is one.
    pub(crate) early: Option<(Model<L>, Vec<bool>)>,
}

/// How much better left-out windows are forecast with an element than without.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Evidence {
    /// Rise of the loss without it over the loss with it, relative; standard error over command steps.
    pub(crate) rise: f64,
    pub(crate) standard_error: f64,
    /// Log odds that it is there.
    pub(crate) score: f64,
}

/// Elements that were tried, with the evidence for each.
pub(crate) type Weighed = Vec<(Element, Evidence)>;

fn huber(r: f64) -> f64 {
    if r.abs() < 1.0 { 0.5 * r * r } else { r.abs() - 0.5 }
}

/// Loss of every window.
pub(crate) fn losses<P: Part>(part: &P, m: &Model<P::Law>) -> Vec<f64> {
    let r = part.residuals(m.law, &m.x);
    let rows = r.len() / part.windows().list.len();
    r.chunks(rows).map(|w| w.iter().map(|r| huber(*r)).sum::<f64>() / rows as f64).collect()
}

/// Evidence for what `with` has and `without` has not.
pub(crate) fn evidence(windows: &Windows, without: &[f64], with: &[f64]) -> Evidence {
    let (rise, error) = mean_with_error(&windows.by_block(|i| without[i] - with[i]));
    let (level, _) = mean_with_error(&windows.by_block(|i| with[i]));
    let z = if error > 0.0 { rise / error } else { 0.0 };
    let level = level.max(1e-12);
    let relevant = rise > WEIGHING.relevant * level;
    let prior = WEIGHING.prior;
    let score = if relevant { 0.5 * z * z.abs() - prior } else { (0.5 * z * z.abs()).min(0.0) - prior };
    Evidence { rise: rise / level, standard_error: error / level, score }
}

fn step_of(c: &ResponseConstant, v: f64) -> f64 {
    FIT.difference * v.abs().max(c.scale)
}

/// Derivatives of the residuals by the free constants, one column each.
pub(crate) fn columns<P: Part>(part: &P, m: &Model<P::Law>, free: &[usize], r: &[f64]) -> Vec<Vec<f64>> {
    free.par_iter()
        .map(|&k| {
            let mut x = m.x.clone();
            let mut h = step_of(&part.constants()[k], x[k]);
            if x[k] + h > part.constants()[k].bounds[1] {
                h = -h;
            }
            x[k] += h;
            part.residuals(m.law, &x).iter().zip(r).map(|(a, b)| (a - b) / h).collect()
        })
        .collect()
}

/// Robust fit of constants, by their places in the list, from these values within their bounds, with its cost.
pub(crate) fn fit_constants(
    constants: &[ResponseConstant],
    (free, start): (&[usize], &[f64]),
    misfit: impl Fn(&[f64]) -> Vec<f64> + Sync,
    iterations: usize,
) -> (Vec<f64>, f64) {
    let constant = |(&k, &value): (&usize, &f64)| {
        let c = &constants[k];
        let [least, largest] = c.bounds;
        let constant = FreeConstant::new(value.clamp(least, largest), c.scale).within(least, largest);
        FreeConstant { relative: true, longest: FIT.longest, difference: FIT.difference, ..constant }
    };
    let settings = Settings {
        iterations,
        first_damping: FIT.first_damping,
        least_relative_fall: FIT.converged,
        ..Settings::default()
    };

    let all = free.iter().zip(start).map(constant).collect();
    let fitted = Residuals::new(all, misfit).with_loss(Loss::Huber(1.0)).fit(&settings);
    fitted.map_or_else(|_| (start.to_vec(), f64::INFINITY), |fitted| (fitted.values, fitted.cost))
}

/// The same of the free constants of a part, on the rows of `used` windows.
pub(crate) fn fit<P: Part>(
    part: &P,
    start: &Model<P::Law>,
    free: &[usize],
    used: &[bool],
    iterations: usize,
) -> (Model<P::Law>, f64) {
    let with = |values: &[f64]| {
        let mut x = start.x.clone();
        free.iter().zip(values).for_each(|(&k, v)| x[k] = *v);
        x
    };
    let misfit = |values: &[f64]| -> Vec<f64> {
        let r = part.residuals(start.law, &with(values));
        let rows = r.len() / used.len();
        r.chunks(rows).zip(used).filter(|(_, u)| **u).flat_map(|(w, _)| w.iter().copied()).collect()
    };
    let first: Vec<f64> = free.iter().map(|&k| start.x[k]).collect();
    let (values, cost) = fit_constants(part.constants(), (free, &first), misfit, iterations);
    let x = if cost.is_finite() { with(&values) } else { start.x.clone() };
    (Model { law: start.law, x }, cost)
}

/// Fits a set of elements on all windows and without each fold. `near` is a fit that begins close by.
pub(crate) fn attempt<P: Part>(
    part: &P,
    base: &Model<P::Law>,
    law: P::Law,
    elements: &[Element],
    near: Option<&Trial<P::Law>>,
) -> Trial<P::Law> {
    let windows = part.windows();
    let law = part.restrict(law, base.law, elements);
    let mut free: Vec<usize> = elements.iter().flat_map(|e| part.free(law, *e)).collect();
    free.sort_unstable();

    let mut start = Model { law, x: base.x.clone() };
    for &k in &free {
        // Limits that the simulation has not are infinite: begin at what the data reach.
        if start.x[k] == part.constants()[k].neutral {
            start.x[k] = part.guess(k);
        }
        if let Some(t) = near.filter(|t| t.free.contains(&k)) {
            start.x[k] = t.model.x[k];
        }
    }

    // On all windows, from each place that may lie in another valley of the cost.
    let everything = vec![true; windows.list.len()];
    let (valley, places) = part.starts();
    let starts: Vec<Model<P::Law>> = if near.is_none() && free.contains(&valley) {
        let at = |v: &f64| {
            let mut s = start.clone();
            s.x[valley] = *v;
            s
        };
        places.iter().map(at).collect()
    } else {
        vec![start]
    };
    let fits: Vec<(Model<P::Law>, f64)> = if free.is_empty() {
        starts.into_iter().map(|s| (s, 0.0)).collect()
    } else {
        starts.par_iter().map(|s| fit(part, s, &free, &everything, FIT.iterations)).collect()
    };
    let best = fits.into_iter().min_by(|a, b| a.1.total_cmp(&b.1));
    let model = best.map_or_else(|| base.clone(), |b| b.0);

    // Without each fold, from there; a window's loss is that of the fit which has not seen it.
    let folds: Vec<Model<P::Law>> = (0..FOLDS)
        .into_par_iter()
        .map(|f| {
            let used: Vec<bool> = (0..windows.list.len()).map(|w| windows.fold(w) != f).collect();
            if free.is_empty() || !used.contains(&true) {
                return model.clone();
            }
            fit(part, &model, &free, &used, FIT.iterations_beside).0
        })
        .collect();
    let by_fold: Vec<Vec<f64>> = folds.par_iter().map(|m| losses(part, m)).collect();
    let loss = (0..windows.list.len()).map(|w| by_fold[windows.fold(w)][w]).collect();
    Trial { elements: elements.to_vec(), free, model, folds, loss, other_order: None, began: None }
}

impl<L: Copy + PartialEq> Trial<L> {
    /// Mean left-out loss.
    pub(crate) fn level(&self) -> f64 {
        mean_with_error(&self.loss).0
    }

    /// Whether an element was found, before it began included.
    pub(crate) fn has(&self, e: Element) -> bool {
        self.elements.contains(&e) || self.began.as_ref().is_some_and(|b| b.before.elements.contains(&e))
    }

    /// Free constants, those from before it began included.
    pub(crate) fn constants(&self) -> usize {
        self.free.len() + self.began.as_ref().map_or(0, |b| b.before.free.len())
    }

    /// As the robot is now.
    pub(crate) fn now(&self) -> Timed<L> {
        Timed { model: self.model.clone(), early: None }
    }

    /// Fitted without a fold, whose windows are early or not by what the others of their recording say.
    pub(crate) fn without(&self, fold: usize) -> Timed<L> {
        let early = self.began.as_ref().map(|b| (b.before.folds[fold].clone(), b.early_without[fold].clone()));
        Timed { model: self.folds[fold].clone(), early }
    }
}

/// Drops elements that do not earn their place, the least first. Returns the rest with the evidence for each.
pub(crate) fn prune<P: Part>(part: &P, base: &Model<P::Law>, full: Trial<P::Law>) -> (Trial<P::Law>, Weighed) {
    let mut kept = full;
    let mut dropped = Weighed::new();
    loop {
        let tried: Vec<(Trial<P::Law>, Element, Evidence)> = kept
            .elements
            .iter()
            .map(|&e| {
                let rest: Vec<Element> = kept.elements.iter().copied().filter(|o| *o != e).collect();
                let t = attempt(part, base, kept.model.law, &rest, Some(&kept));
                let v = evidence(part.windows(), &t.loss, &kept.loss);
                (t, e, v)
            })
            .collect();
        let least = tried.iter().min_by(|a, b| a.2.score.total_cmp(&b.2.score)).map(|t| (t.1, t.2));
        match least {
            Some((e, v)) if v.score <= 0.0 => {
                if let Some((t, _, _)) = tried.into_iter().find(|t| t.1 == e) {
                    dropped.push((e, v));
                    kept = t;
                }
            }
            _ => {
                let mut all: Weighed = tried.iter().map(|(_, e, v)| (*e, *v)).collect();
                all.extend(dropped);
                return (kept, all);
            }
        }
    }
}
