//! How well fitted constants are known.

use faer::Mat;
use inference::algebra::inverse_spd;
use inference::robust::NINETY_FALL;

use crate::search::{Part, Trial, columns, fit, fit_constants, losses};
use crate::settings::{Fit, SETTINGS};

const FIT: Fit = SETTINGS.fit;

/// Range of a constant in which the cost stays as low as its 90 % profile interval asks, the others fitted anew: how far
/// rows leave it open where its derivative does not say so. A window counts as one number.
pub(crate) fn open_range<P: Part>(part: &P, t: &Trial<P::Law>, k: usize) -> Option<[f64; 2]> {
    let reach = part.flat_over(&t.model, k)?;
    let others: Vec<usize> = t.free.iter().copied().filter(|o| *o != k).collect();
    let everything = vec![true; part.windows().list.len()];
    let cost = |value: f64| {
        let mut model = t.model.clone();
        model.x[k] = value;
        let fitted =
            if others.is_empty() { model } else { fit(part, &model, &others, &everything, FIT.iterations_beside).0 };
        losses(part, &fitted).iter().sum::<f64>()
    };
    let least = cost(t.model.x[k]);
    let allowed = least * (1.0 + 2.0 * NINETY_FALL / part.windows().list.len().max(1) as f64);
    let [lowest, largest] = part.constants()[k].bounds;
    let end = |sign: f64| {
        let at = |i: usize| (t.model.x[k] + sign * reach * i as f64 / FIT.profile as f64).clamp(lowest, largest);
        (1..=FIT.profile).map(at).take_while(|v| cost(*v) <= allowed).last().unwrap_or(t.model.x[k])
    };
    Some([end(-1.0), end(1.0)])
}

/// What the rows in which motions have ended say of where they end, the other constants as they are: a law that goes there in another
/// way than the robot does puts some of that into gains and limits. Constant and value; none where too few rows tell.
pub(crate) fn settled<P: Part>(part: &P, t: &Trial<P::Law>) -> Vec<(usize, f64)> {
    let levels: Vec<usize> = part.levels().iter().copied().filter(|k| t.free.contains(k)).collect();
    let rows = part.settled(&t.model);
    let share = rows.iter().filter(|is| **is).count() as f64 / rows.len().max(1) as f64;
    if levels.is_empty() || share < SETTINGS.answer.least_settled {
        return Vec::new();
    }

    let with = |values: &[f64]| {
        let mut x = t.model.x.clone();
        levels.iter().zip(values).for_each(|(&k, v)| x[k] = *v);
        x
    };
    let misfit = |values: &[f64]| -> Vec<f64> {
        let all = part.residuals(t.model.law, &with(values));
        all.into_iter().zip(&rows).filter(|(_, is)| **is).map(|(r, _)| r).collect()
    };
    let start: Vec<f64> = levels.iter().map(|&k| t.model.x[k]).collect();
    let (values, cost) = fit_constants(part.constants(), (&levels, &start), misfit, FIT.iterations_beside);
    if cost.is_finite() { levels.into_iter().zip(values).collect() } else { Vec::new() }
}

/// One sigma of every free constant; `None` where the recordings do not determine them.
pub(crate) fn sigmas<P: Part>(part: &P, t: &Trial<P::Law>) -> Vec<Option<f64>> {
    let covariance = covariance(part, t);
    (0..t.free.len()).map(|i| covariance.as_ref().map(|c| c[(i, i)].sqrt())).collect()
}

/// Covariance of the free constants: sandwich estimate with command steps as clusters (Liang and Zeger 1986), widened.
pub(crate) fn covariance<P: Part>(part: &P, t: &Trial<P::Law>) -> Option<Mat<f64>> {
    let windows = part.windows();
    let r = part.residuals(t.model.law, &t.model.x);
    let rows = r.len() / windows.list.len();
    let columns = columns(part, &t.model, &t.free, &r);
    // Beyond the unit the loss is linear and has no curvature.
    let n = t.free.len();
    let curved = Mat::from_fn(r.len(), n, |i, c| if r[i].abs() < 1.0 { columns[c][i] } else { 0.0 });
    let inverse = inverse_spd(&(curved.transpose() * &curved))?;
    let mut scores = Mat::<f64>::zeros(n, windows.blocks);
    for (w, window) in windows.list.iter().enumerate() {
        for i in w * rows..(w + 1) * rows {
            for a in 0..n {
                scores[(a, window.block)] += columns[a][i] * r[i].clamp(-1.0, 1.0);
            }
        }
    }
    let spread = &inverse * &scores;
    let blocks = windows.blocks as f64;
    let few = blocks / (blocks - n as f64).max(1.0);
    let scale = SETTINGS.answer.wider * SETTINGS.answer.wider * few;
    Some(&spread * spread.transpose() * faer::Scale(scale))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::controller::GAIN;
    use crate::identify::{Identify, OfDrive, neutral};
    use crate::testing::Truth;
    use crate::windows::Windows;

    #[test]
    fn gains_are_those_of_motions_that_have_ended_whatever_the_law_says_of_the_way_there() {
        let windows = Windows::new(&[Truth::stock().run("a", 30, 1), Truth::stock().run("b", 20, 2)]);
        let mut trial = OfDrive.identify(&windows, &neutral(&windows).drive).trial;
        let part = OfDrive.part(&windows);
        assert!(trial.free.contains(&GAIN[0]), "{:?}", trial.free);
        let fitted = trial.model.x[GAIN[0]];
        trial.model.x[GAIN[0]] *= 0.97;
        let told = settled(&part, &trial);
        let (_, gain) = told.iter().find(|(k, _)| *k == GAIN[0]).expect("a gain");
        approx::assert_relative_eq!(*gain, fitted, max_relative = 0.005);

        trial.free.retain(|k| *k != GAIN[0]);
        assert!(settled(&part, &trial).iter().all(|(k, _)| *k != GAIN[0]), "what is not free is not told");
    }
}
