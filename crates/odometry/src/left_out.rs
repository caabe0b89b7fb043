//! Sessions left out in turn, and forecast from counts alone by every calibration.

use crate::case::Case;
use crate::clock;
use crate::diagnose::{Solved, Start, solve};
use crate::drive::Drive;
use crate::error::OdometryError;
use crate::findings::Findings;
use crate::forecast::{Errors, LENGTHS, forecast};
use crate::motion::{Laws, implied};
use crate::rivals::{RIVALS, Rival};
use crate::settings::SETTINGS;
use crate::traces::trace;
use crate::wheel::WheeledRobot;
use crate::windows::laws;
use hierarchical_fit::telling::free_runs;
use inference::robust::{geometric_mean, mean_with_error};
use rayon::prelude::*;
use verdict::{FreeRun, Trace};

/// Errors of forecasts of left-out sessions, by calibration.
#[derive(Debug, Clone, Default)]
pub struct Table {
    /// Name of a calibration, and its errors over each of [`LENGTHS`](crate::LENGTHS).
    pub rows: Vec<(String, [Errors; 3])>,
    /// Sessions that were left out in turn.
    pub sessions: usize,
    /// By session: its name, and errors of each row, in the same order.
    pub by_session: Vec<(String, Vec<[Errors; 3]>)>,
    /// Labels of the causes that each fold named.
    pub named: Vec<Vec<String>>,
    /// Drives that were left out beside the simulations fitted without them.
    pub traces: Vec<Trace>,
    /// Whether causes that explain little were left out of the answer: with them nothing is forecast better.
    pub(crate) is_plainer: bool,
}

/// Names of the simulations beside the rivals.
const OURS: [&str; 4] = ["as stated", "re-tuned", "corrected", "placebo"];
/// Row of the answer.
const CORRECTED: usize = 2;

/// Leaves out each session of the recordings in turn, or each drive where there is one session, fits and names anew without
/// it, and forecasts it. `found`: what all drives of the case say.
///
/// # Errors
/// When the robot cannot be, or a fold leaves too few windows.
pub fn left_out(case: &Case, found: &Findings, progress: &dyn Fn(&str)) -> Result<Table, OdometryError> {
    case.robot.checked()?;
    let (case, clock) = clock::joined(case);
    let mut sessions: Vec<&str> = case.recordings.iter().map(|d| d.session.as_str()).collect();
    sessions.sort_unstable();
    sessions.dedup();
    let by_drive = sessions.len() < 2;
    let key = |d: &Drive| if by_drive { d.name.clone() } else { d.session.clone() };
    let mut keys: Vec<String> = case.recordings.iter().map(key).collect();
    keys.dedup();
    keys.sort();
    keys.dedup();
    if keys.len() < 2 {
        return Ok(Table { sessions: keys.len(), is_plainer: true, ..Table::default() });
    }

    progress("forecasting what is left out in turn");
    let start = Start { clock, of: found.solved.as_deref() };
    let fold = |left: String| -> Result<Fold<'_>, OdometryError> {
        let (drives, rest): (Vec<_>, Vec<_>) = case.recordings.iter().enumerate().partition(|(_, d)| key(d) == left);
        let rest: Vec<&Drive> = rest.into_iter().map(|(_, drive)| drive).collect();
        let solved = solve(&case.robot, &case.references, &rest, &start)?;
        let placed: Vec<&Drive> = rest.iter().copied().filter(|drive| !drive.heading_only).collect();
        let calibrated = |rival: &Rival| if placed.is_empty() { None } else { rival(&case.robot, &placed) };
        let rivals = RIVALS.iter().map(|(_, rival)| calibrated(rival)).collect();
        let place = drives.first().map_or(0, |(place, _)| *place);
        Ok(Fold { left, drives, place, solved, rivals })
    };
    let mut folds = keys.into_par_iter().map(fold).collect::<Result<Vec<Fold<'_>>, OdometryError>>()?;
    let table = of_folds(&case.robot, &folds, start.of);
    if found.plainer.is_none() {
        return Ok(table);
    }
    for fold in &mut folds {
        if let Some(plainer) = fold.solved.plainer() {
            fold.solved = plainer;
        }
    }
    let plainer = Table { is_plainer: true, ..of_folds(&case.robot, &folds, start.of) };
    Ok(if table.is_better_than(&plainer) { table } else { plainer })
}

/// A session that is left out, and the fit of the others.
struct Fold<'a> {
    left: String,
    /// The drives of it, with their places among all.
    drives: Vec<(usize, &'a Drive)>,
    /// How many of the others come before it.
    place: usize,
    solved: Solved,
    /// Classical calibrations on the others.
    rivals: Vec<Option<Laws>>,
}

/// Forecasts of what folds leave out; `whole`: the fit to all drives.
fn of_folds(robot: &WheeledRobot, folds: &[Fold<'_>], whole: Option<&Solved>) -> Table {
    let mut out = Table { sessions: folds.len(), ..Table::default() };
    let mut names: Vec<String> = OURS.iter().map(|n| (*n).to_owned()).collect();
    names.extend(RIVALS.iter().map(|(name, _)| (*name).to_owned()));
    let mut sums: Vec<[Errors; 3]> = vec![Default::default(); names.len()];
    for Fold { left, drives, place, solved, rivals } in folds {
        let labels = solved.named.chosen.iter().map(|w| solved.causes[w.cause].label()).collect();
        let placebo = solved.named.placebo.as_ref();
        let placebo = placebo.map(|(_, p)| laws(robot, &solved.constants, p.mean.as_slice()));
        let others: Vec<Option<&Laws>> =
            std::iter::once(placebo.as_ref()).chain(rivals.iter().map(Option::as_ref)).collect();
        let mut errors: Vec<[Errors; 3]> = vec![Default::default(); names.len()];
        for (index, drive) in drives {
            let when = whole.and_then(|whole| whole.onset.as_ref()).map(|onset| (onset, *index));
            let ours = solved.paths_of_left_out(robot, (drive, *place), when);
            let of_others = others.iter().map(|laws| laws.map(|laws| implied(robot, drive, laws)));
            let paths = { ours.iter().cloned() }.map(Some).chain(of_others);
            for (sum, path) in errors.iter_mut().zip(paths) {
                let Some(path) = path else { continue };
                sum.iter_mut().zip(forecast(drive, &path)).for_each(|(s, e)| s.extend(e));
            }
            let [stated, retuned, corrected] = ours;
            let corrected = (!solved.named.chosen.is_empty()).then_some(corrected);
            out.traces.push(trace(drive, [Some(stated), Some(retuned), corrected], true));
        }
        for (sum, e) in sums.iter_mut().zip(&errors) {
            sum.iter_mut().zip(e.clone()).for_each(|(s, e)| s.extend(e));
        }
        out.by_session.push((left.clone(), errors));
        out.named.push(labels);
    }
    out.rows = names.into_iter().zip(sums).collect();
    out
}

impl Table {
    /// Errors of what was left out, as a verdict has them.
    pub(crate) fn free_runs(&self) -> Vec<FreeRun> {
        let of_session = |(session, errors): &(String, Vec<[Errors; 3]>)| {
            free_runs(session, "counts alone", LENGTHS, |row, k| errors.get(row).and_then(|e| e[k].medians()))
        };
        self.by_session.iter().flat_map(of_session).collect()
    }

    /// Whether corrected forecasts are better than those of another table beyond what sessions differ by: by the logarithms of the errors'
    /// ratios, one of each session, the mean over all lengths and quantities, with the standard error of their mean.
    fn is_better_than(&self, other: &Self) -> bool {
        let medians = |table: &Self, session: usize| -> Vec<f64> {
            let of_length = |errors: &Errors| errors.medians().into_iter().flatten().flatten().collect::<Vec<f64>>();
            let rows = table.by_session.get(session).map(|(_, rows)| rows);
            rows.and_then(|rows| rows.get(CORRECTED)).iter().flat_map(|row| row.iter().flat_map(of_length)).collect()
        };
        let of_session = |session: usize| {
            let ratios = medians(self, session).into_iter().zip(medians(other, session)).map(|(a, b)| a / b);
            geometric_mean(ratios.filter(|ratio| ratio.is_finite() && *ratio > 0.0)).map(f64::ln)
        };
        let logarithms: Vec<f64> = (0..self.by_session.len()).filter_map(of_session).collect();
        let (mean, error) = mean_with_error(&logarithms);
        mean < -SETTINGS.doubt.errors * error
    }
}
