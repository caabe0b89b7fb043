//! Drives left out in turn, and forecast from throttle and steering by every model.

use rayon::prelude::*;

use crate::forecast::{ByLength, Habit, LENGTHS, collected, following, of_followed, of_laws, of_twist};
use crate::model::Laws;
use crate::rivals::RIVALS;
use crate::rows::Shown;
use crate::settings::{Forecast, SETTINGS};
use crate::traces::trace;
use hierarchical_fit::Solved;
use hierarchical_fit::telling::free_runs;
use inference::robust::median;
use verdict::{FreeRun, Trace};

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
    /// The drives beside the simulations that were fitted without them.
    pub traces: Vec<Trace>,
}

impl Table {
    /// The same as rows of a verdict.
    pub(crate) fn free_runs(&self) -> Vec<FreeRun> {
        let of_drive = |(drive, errors): &(String, Vec<ByLength>)| {
            let medians = |row: usize, k: usize| errors.get(row).and_then(|e| e[k].medians()).map(|m| m.map(Some));
            free_runs(drive, "throttle and steering alone", LENGTHS, medians)
        };
        self.by_drive.iter().flat_map(of_drive).collect()
    }
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
pub(crate) fn left_out_of(solved: &Solved<Shown<'_>>, progress: &dyn Fn(&str)) -> Table {
    let left: Vec<usize> = (0..solved.data.drives.len()).filter(|&k| solved.data.drives[k].drive.has_pose()).collect();
    let mut out = Table::default();
    if left.len() < 2 {
        return out;
    }
    let fold = |&k: &usize| fold(solved, k);
    progress("forecasting drives that were left out");
    let folds: Vec<Fold> = left.par_iter().filter_map(fold).collect();

    let rivals = RIVALS.iter().map(|r| r.name).chain([TWIST]);
    let names: Vec<String> = OURS.into_iter().chain(rivals).map(str::to_owned).collect();
    let mut sums = vec![ByLength::default(); names.len()];
    for (k, fold) in folds.iter().enumerate() {
        let others = folds.iter().enumerate().filter(|(j, _)| *j != k).map(|(_, f)| f);
        let errors = fold.errors(chosen(&others.collect::<Vec<_>>()));
        for (sum, e) in sums.iter_mut().zip(&errors) {
            sum.iter_mut().zip(e.clone()).for_each(|(s, e)| s.extend(e));
        }
        out.by_drive.push((fold.name.clone(), errors));
        out.named.push(fold.named.clone());
        out.traces.extend(fold.trace.clone());
    }
    out.drives = folds.len();
    out.rows = names.into_iter().zip(sums).collect();
    out
}

/// A drive that was left out: its forecasts under everything that is chosen on other drives.
struct Fold {
    name: String,
    named: Vec<String>,
    /// For each past of the start: models but the one that follows.
    plain: Vec<Vec<ByLength>>,
    /// For each past: of each habit, the model that follows.
    following: Vec<Vec<ByLength>>,
    trace: Option<Trace>,
}

impl Fold {
    fn errors(&self, [past, habit]: [usize; 2]) -> Vec<ByLength> {
        let mut out = self.plain[past].clone();
        out.insert(FOLLOWING, self.following[past][habit].clone());
        out
    }
}

/// Habits of following, of which one is chosen.
fn habits() -> Vec<Habit> {
    let of = |fading| RULES.freedom.into_iter().map(move |freedom| Habit { fading, freedom });
    RULES.fading.into_iter().flat_map(of).collect()
}

/// The past and the habit that forecast other drives best: median error of position at the longest length.
fn chosen(others: &[&Fold]) -> [usize; 2] {
    let pairs = (0..RULES.past.len()).flat_map(|p| (0..habits().len()).map(move |h| [p, h]));
    let score = |[p, h]: [usize; 2]| {
        let each = others.iter().flat_map(|f| f.following[p][h][LENGTHS.len() - 1].position.iter().copied());
        median(each).unwrap_or(f64::INFINITY)
    };
    pairs.map(|pair| (score(pair), pair)).min_by(|a, b| a.0.total_cmp(&b.0)).map_or([0, 0], |(_, pair)| pair)
}

fn fold(all: &Solved<Shown<'_>>, left: usize) -> Option<Fold> {
    let own = &all.data.drives[left];
    let solved = all.without(left)?;
    let constants = &solved.data.model;
    let best = solved.corrected_of_left_out_beside(left, all);
    let best = best.as_slice();
    let laws = |theta: &[f64]| Some(Laws::at(constants, theta));
    let mut models = vec![
        laws(solved.prior.mean.as_slice()),
        laws(solved.named.retuned.mean.as_slice()),
        laws(best),
        solved.named.placebo.as_ref().and_then(|(_, p)| laws(p.mean.as_slice())),
    ];
    models.extend(RIVALS.iter().map(|rival| rival.fitted(&solved.data, &solved.fit)));
    let plain = |past: f64| -> Vec<ByLength> {
        let of = |laws: &Option<Laws>| laws.map(|l| collected(of_laws(own, &l, past))).unwrap_or_default();
        models.iter().map(of).chain([collected(of_twist(own, past))]).collect()
    };
    let scatter = solved.data.scatter(solved.fit.factor);
    let follow = |habit: Habit| following(constants, &scatter, own, (best, solved.fit.noise.of_single_rows()), habit);
    let followed: Vec<_> = habits().into_iter().map(follow).collect();
    let forecast = |past: f64| {
        let of = |f: &Vec<(usize, Vec<f64>)>| collected(of_followed(constants, own, f, past));
        followed.iter().map(of).collect()
    };
    Some(Fold {
        name: own.drive.name.clone(),
        named: solved.named.chosen.iter().map(|w| solved.causes[w.cause].label()).collect(),
        plain: RULES.past.into_iter().map(plain).collect(),
        following: RULES.past.into_iter().map(forecast).collect(),
        trace: trace(&solved, own, |_| best, true),
    })
}
