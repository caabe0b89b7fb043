//! One response for references and recordings, but for the constants that have to differ.
//!
//! A robot that is as it was answers other commands by the same law with the same constants. Fits that know one set of drives each may
//! still come out unlike: a law that is not quite that of the robot is fitted by other constants where it is driven otherwise. So the
//! constants that recordings want otherwise are taken back one and all, one response is fitted to both sets, and of those constants only
//! as many differ as it takes until both sets are forecast about as well as by fits of their own.

use verdict::Element;

use crate::identify::Identify;
use crate::search::{Evidence, Model, Part, Trial, Weighed, attempt, evidence, fit, fit_constants, losses, prune};
use crate::settings::{Common as Rules, SETTINGS};
use crate::windows::Windows;

const RULES: Rules = SETTINGS.common;

/// What both sets share, and what recordings show beyond it.
pub(crate) struct Common<L> {
    pub(crate) base: Model<L>,
    /// The fit of the recordings, where anything has to differ: of their own, so that its sizes are theirs.
    pub(crate) trial: Trial<L>,
    /// What it has, and does not have to differ.
    pub(crate) shared: Vec<Element>,
    /// Of the elements that were named before.
    pub(crate) evidence: Weighed,
}

/// Both sets under one law, with the fit that each has of its own.
struct Both<'a, P: Part> {
    parts: [&'a P; 2],
    law: P::Law,
    /// Losses of fits of their own.
    own: [Vec<f64>; 2],
}

/// The constants of references and of recordings.
struct Joint {
    x: [Vec<f64>; 2],
    /// What differs.
    differing: Vec<Element>,
}

impl<P: Part> Both<'_, P> {
    /// Places of the constants of some elements.
    fn places(&self, elements: &[Element]) -> Vec<usize> {
        let mut out: Vec<usize> = elements.iter().flat_map(|e| self.parts[0].free(self.law, *e)).collect();
        out.sort_unstable();
        out
    }

    /// Fits the constants of both sets: those of `shared` are the same unless they differ, those of `differing` others in each.
    fn fit(&self, start: &[Vec<f64>; 2], shared: &[Element], differing: Vec<Element>) -> Joint {
        let (free, apart) = (self.places(shared), self.places(&differing));
        let at = |values: &[f64]| -> [Vec<f64>; 2] {
            let [mut of_references, mut of_recordings] = start.clone();
            for (&k, v) in free.iter().zip(values) {
                of_references[k] = *v;
                of_recordings[k] = *v;
            }
            apart.iter().zip(&values[free.len()..]).for_each(|(&k, v)| of_recordings[k] = *v);
            [of_references, of_recordings]
        };
        // Both sets count alike, however long they are.
        let windows = self.parts.map(|part| part.windows().list.len() as f64);
        let weight = windows.map(|n| ((windows[0] + windows[1]) / (2.0 * n)).sqrt());
        let misfit = |values: &[f64]| -> Vec<f64> {
            let x = at(values);
            let of =
                |set: usize| self.parts[set].residuals(self.law, &x[set]).into_iter().map(move |r| weight[set] * r);
            of(0).chain(of(1)).collect()
        };
        let numbers: Vec<usize> = free.iter().chain(&apart).copied().collect();
        let first: Vec<f64> = free.iter().map(|&k| start[0][k]).chain(apart.iter().map(|&k| start[1][k])).collect();
        let (values, _) = fit_constants(self.parts[0].constants(), (&numbers, &first), misfit, SETTINGS.fit.iterations);
        Joint { x: at(&values), differing }
    }

    /// How much worse both sets are forecast than by their own fits.
    fn rises(&self, joint: &Joint) -> [Evidence; 2] {
        [0, 1].map(|set| {
            let model = Model { law: self.law, x: joint.x[set].clone() };
            evidence(self.parts[set].windows(), &losses(self.parts[set], &model), &self.own[set])
        })
    }

    /// The one that forecasts both best.
    fn best(&self, all: impl Iterator<Item = Joint>) -> Option<Joint> {
        let rise = |joint: &Joint| self.rises(joint).iter().map(|e| e.rise).sum::<f64>();
        all.map(|joint| (rise(&joint), joint)).min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, joint)| joint)
    }

    /// Whether both are forecast about as well as by their own fits.
    fn does(&self, joint: &Joint) -> bool {
        let rises = self.rises(joint);
        let is_clear = |e: &Evidence| e.rise > RULES.clear_rise && e.score > RULES.clear;
        rises.iter().map(|e| e.rise.max(0.0)).sum::<f64>() < RULES.rise && !rises.iter().any(is_clear)
    }
}

/// One response under this law, with as few of what was found in recordings as differ.
fn settled<'a, P: Part>(
    parts: [&'a P; 2],
    law: P::Law,
    [known, found]: [&Trial<P::Law>; 2],
) -> Option<(Both<'a, P>, Joint)> {
    let all: Vec<Element> =
        known.elements.iter().chain(found.elements.iter().filter(|e| !known.elements.contains(e))).copied().collect();
    let law = parts[0].restrict(law, known.model.law, &all);
    let mut both = Both { parts, law, own: [Vec::new(), Vec::new()] };
    // Limits that one of them has not are infinite.
    let every = both.places(&all);
    let near = |first: &Trial<P::Law>, second: &Trial<P::Law>| -> Vec<f64> {
        let mut x = known.model.x.clone();
        for &k in &every {
            let by = [first, second].into_iter().find(|t| t.free.contains(&k));
            x[k] = by.map_or_else(|| parts[0].guess(k), |t| t.model.x[k]);
        }
        x
    };
    let starts = [near(known, found), near(found, known)];
    let alone = |set: usize, elements: &[Element]| -> Vec<f64> {
        let part = parts[set];
        let mut x = known.model.x.clone();
        let free = both.places(elements);
        for &k in &free {
            x[k] = starts[set][k];
        }
        let used = vec![true; part.windows().list.len()];
        let model = fit(part, &Model { law, x }, &free, &used, SETTINGS.fit.iterations).0;
        losses(part, &model)
    };
    let own = [0, 1].map(|set| alone(set, &all));

    // What references do not show differs, or is not there.
    let is_shown = |e: &&Element| {
        let others: Vec<Element> = all.iter().filter(|other| other != e).copied().collect();
        let shows = |v: Evidence| v.score > 0.0 || v.rise > RULES.clear_rise;
        known.elements.contains(e) || shows(evidence(parts[0].windows(), &alone(0, &others), &own[0]))
    };
    let shared: Vec<Element> = all.iter().filter(is_shown).copied().collect();
    both.own = own;
    let common = both.places(&shared);
    let same = starts.iter().map(|start| {
        let mut x = known.model.x.clone();
        for &k in &common {
            x[k] = start[k];
        }
        both.fit(&[x.clone(), x], &shared, Vec::new())
    });
    let mut joint = both.best(same)?;
    while joint.differing.len() < found.elements.len() && !both.does(&joint) {
        let more = found.elements.iter().filter(|e| !joint.differing.contains(e)).map(|e| {
            let differing: Vec<Element> = joint.differing.iter().copied().chain([*e]).collect();
            let mut of_recordings = joint.x[1].clone();
            both.places(&[*e]).iter().for_each(|&k| of_recordings[k] = starts[1][k]);
            both.fit(&[joint.x[0].clone(), of_recordings], &shared, differing)
        });
        joint = both.best(more)?;
    }
    Some((both, joint))
}

/// What references and recordings share, where not all that recordings want otherwise has to differ.
pub(crate) fn common<I: Identify>(
    of: &I,
    [references, recordings]: [&Windows; 2],
    own: [&Trial<I::Law>; 2],
    known: &[(Element, Evidence)],
) -> Option<Common<I::Law>> {
    let [before, found] = own;
    if found.elements.is_empty() || own.iter().any(|trial| trial.began.is_some()) {
        return None;
    }
    let parts = [of.part(references), of.part(recordings)];
    // Recordings that are forecast as well by the references' response need no other.
    let given = losses(&parts[1], &before.model);
    if evidence(recordings, &given, &found.loss).rise < RULES.clear_rise {
        return None;
    }
    let mut laws = vec![found.model.law];
    laws.extend(Some(before.model.law).filter(|law| *law != found.model.law));
    let settled = laws.into_iter().filter_map(|law| settled([&parts[0], &parts[1]], law, own));
    let (both, joint) = settled.min_by_key(|(_, joint)| joint.differing.len())?;
    if joint.differing.len() == found.elements.len() {
        return None;
    }

    let [of_references, of_recordings] = joint.x;
    let base = Model { law: both.law, x: of_references };
    let part = &parts[1];
    let near = Trial {
        free: both.places(&joint.differing),
        model: Model { law: both.law, x: of_recordings },
        ..found.clone()
    };
    let (trial, evidence) = prune(part, &base, attempt(part, &base, both.law, &joint.differing, Some(&near)));
    // What has to differ has to show in the recordings, too.
    if trial.elements.len() < joint.differing.len() {
        return None;
    }
    let others = known.iter().filter(|(e, _)| !evidence.iter().any(|(own, _)| own == e));
    // What does not have to differ keeps its prior.
    let prior = others.map(|(e, v)| (*e, Evidence { score: v.score.min(-SETTINGS.evidence.prior), ..*v }));
    let evidence = prior.chain(evidence.iter().copied()).collect();
    let shared: Vec<Element> = found.elements.iter().filter(|e| !joint.differing.contains(e)).copied().collect();
    let (trial, shared) = if joint.differing.is_empty() { (trial, Vec::new()) } else { (found.clone(), shared) };
    Some(Common { base, trial, shared, evidence })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::controller::{DEAD_TIME, GAIN, Law};
    use crate::identify::{OfDrive, neutral};
    use crate::testing::Truth;

    /// Fits of references and recordings of their own, the latter with these elements, and what both share.
    fn shared(drives: [&Windows; 2], elements: &[Element]) -> (Trial<Law>, Option<Common<Law>>) {
        let [references, recordings] = drives;
        let known = OfDrive.identify(references, &neutral(references).drive).trial;
        let part = OfDrive.part(recordings);
        let found = attempt(&part, &known.model, known.model.law, elements, None);
        let out = common(&OfDrive, drives, [&known, &found], &[]);
        (known, out)
    }

    #[test]
    fn of_what_was_found_only_what_has_to_differ_does() {
        use Element::{DeadTime, Gain, Lag};
        let (stock, mut late) = (Truth::stock(), Truth::stock());
        late.drive[DEAD_TIME] = 0.4;
        let references = Windows::new(&[stock.run("r", 40, 7)]);
        let recordings = Windows::new(&[late.run("a", 30, 1), late.run("b", 20, 2)]);
        let (known, out) = shared([&references, &recordings], &[DeadTime, Gain, Lag]);
        let out = out.expect("something is shared");
        assert_eq!((out.trial.elements, out.shared), (vec![DeadTime, Gain, Lag], vec![Gain, Lag]));
        approx::assert_abs_diff_eq!(out.trial.model.x[DEAD_TIME], 0.4, epsilon = 0.02);
        approx::assert_abs_diff_eq!(out.base.x[DEAD_TIME], known.model.x[DEAD_TIME], epsilon = 0.02);
        approx::assert_abs_diff_eq!(out.base.x[GAIN[1]], 0.8, epsilon = 0.02);

        // The same robot needs no other response.
        let again = Windows::new(&[stock.run("a", 30, 1), stock.run("b", 20, 2)]);
        assert!(shared([&references, &again], &[DeadTime, Gain, Lag]).1.is_none());
    }
}
