//! Drives left out in turn, and forecast from throttle and steering by every model.

use rayon::prelude::*;

use crate::case::Case;
use crate::drive::Drive;
use crate::error::CarError;
use crate::fit::Data;
use crate::forecast::{ByLength, Habit, LENGTHS, Said, collected, following, of_laws, of_twist};
use crate::model::Laws;
use crate::rivals::RIVALS;
use crate::settings::{Forecast, SETTINGS};
use crate::solve::{Solved, solve};
use inference::robust::median;

const RULES: Forecast = SETTINGS.forecast;

/// Errors of forecasts of left-out drives, by model.
#[derive(Debug, Clone, Default)]
pub struct Table {
    /// Name of a model, and its errors over each of [`LENGTHS`].
    pub rows: Vec<(String, ByLength)>,
    /// Drives that were left out in turn.
    pub drives: usize,
    /// By drive: its name, and errors of each row, in the same order.
    pub by_drive: Vec<(String, Vec<ByLength>)>,
    /// Labels of the causes that each fold named.
    pub named: Vec<Vec<String>>,
}

/// Names of the simulations beside the rivals.
const OURS: [&str; 5] = ["as stated", "re-tuned", "corrected", "placebo", "corrected, following its past"];
/// Rows that are of this crate; the others are rivals.
pub const OWN_ROWS: usize = OURS.len();
/// Row of the corrected forecasts.
pub const CORRECTED: usize = 2;
/// Row of the corrected forecasts that follow the drive's own past.
pub const FOLLOWING: usize = 4;
const TWIST: &str = "constant twist";

/// Leaves out each drive with a pose in turn, fits and names anew without it, and forecasts it.
///
/// # Errors
/// When a fold leaves too few windows.
pub fn left_out(case: &Case, progress: &dyn Fn(&str)) -> Result<Table, CarError> {
    let with_pose: Vec<&Drive> = case.recordings.iter().filter(|d| d.has_pose()).collect();
    let mut out = Table::default();
    if with_pose.len() < 2 {
        return Ok(out);
    }
    let all: Vec<&Drive> = case.recordings.iter().collect();
    let start = solve(&case.car, &case.references, &all, None)?.fit.theta;
    let rivals = RIVALS.iter().map(|r| r.name).chain([TWIST]);
    let names: Vec<String> = OURS.into_iter().chain(rivals).map(str::to_owned).collect();
    let mut sums = vec![ByLength::default(); names.len()];
    for left in &with_pose {
        progress(&format!("forecasting {}", left.name));
        let rest: Vec<&Drive> = all.iter().copied().filter(|d| d.name != left.name).collect();
        let (errors, labels) = fold(case, left, &rest, &start)?;
        for (sum, e) in sums.iter_mut().zip(&errors) {
            sum.iter_mut().zip(e.clone()).for_each(|(s, e)| s.extend(e));
        }
        out.by_drive.push((left.name.clone(), errors));
        out.named.push(labels);
        out.drives += 1;
    }
    out.rows = names.into_iter().zip(sums).collect();
    Ok(out)
}

fn fold(case: &Case, left: &Drive, rest: &[&Drive], start: &[f64]) -> Result<(Vec<ByLength>, Vec<String>), CarError> {
    let solved = solve(&case.car, &case.references, rest, Some(start))?;
    let own = Data::shown(&case.car, left);
    let constants = &solved.data.constants;
    let best = solved.named.posterior.mean.as_slice();
    let habit = habit(&solved, best);
    let past = habit.past;
    let forecast = |theta: &[f64]| collected(of_laws(&own, &Laws::at(constants, theta), past));
    let mut errors = vec![
        forecast(solved.prior.mean.as_slice()),
        forecast(solved.named.retuned.mean.as_slice()),
        forecast(best),
        solved.named.placebo.as_ref().map(|(_, p)| forecast(p.mean.as_slice())).unwrap_or_default(),
    ];
    let said = Said::new(constants, &own, best);
    let law = (best, solved.fit.scales, solved.fit.factor);
    errors.push(collected(following(&solved.data, &said, law, habit)));
    for rival in &RIVALS {
        let laws = rival.fitted(&solved.data, &solved.fit);
        errors.push(laws.map(|laws| collected(of_laws(&own, &laws, past))).unwrap_or_default());
    }
    errors.push(collected(of_twist(&own, past)));
    let labels = solved.named.chosen.iter().map(|w| solved.causes[w.cause].label()).collect();
    Ok((errors, labels))
}

/// The habit that forecasts the drives of a fit best: mean of the medians of drives, position at the longest length.
fn habit(solved: &Solved<'_>, theta: &[f64]) -> Habit {
    let said: Vec<Said<'_, '_>> = solved
        .data
        .shown
        .par_iter()
        .filter(|s| s.drive.has_pose())
        .map(|s| Said::new(&solved.data.constants, s, theta))
        .collect();
    let law = (theta, solved.fit.scales, solved.fit.factor);
    let score = |habit: Habit| {
        let of = |said: &Said<'_, '_>| following(&solved.data, said, law, habit);
        let each: Vec<f64> = said.par_iter().flat_map_iter(of).map(|e| e[LENGTHS.len() - 1][0]).collect();
        median(each).unwrap_or(f64::INFINITY)
    };
    let best = |tried: &mut dyn Iterator<Item = Habit>| {
        tried.map(|h| (score(h), h)).min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, h)| h)
    };
    let none = Habit { past: RULES.past[0], fading: None, freedom: 1.0 };
    let start = best(&mut RULES.past.into_iter().map(|past| Habit { past, ..none })).unwrap_or(none);
    let follow = RULES.fading.into_iter().flat_map(|fading| {
        RULES.freedom.into_iter().map(move |freedom| Habit { fading: Some(fading), freedom, ..start })
    });
    best(&mut follow.chain([start])).unwrap_or(start)
}
