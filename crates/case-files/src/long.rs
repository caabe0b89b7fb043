//! Long recordings: screened once as they are read, a budget of their most telling minutes kept.

use std::collections::HashMap;
use std::path::PathBuf;

use anyhow::{Result, ensure};
use diagnosis::long::{BUDGET, PIECE, Screen, Screening, Stretch};
use rayon::prelude::*;
use recordings::{
    Mapping, Opened, Passage, Read, ReadOptions, Recording, RecordingError, is_bag, pieces_from, read_from,
};
use robot_file::{Causality, RobotSpec};
use serde::Serialize;
use verdict::Coverage;

use crate::inputs::{Loaded, Plan, load};
use crate::kind;
use crate::watched::Pass;

/// Files of fewer bytes together are read whole before anything is asked of them.
const READ_WHOLE: u64 = 16 << 20;
/// Runs of fewer bytes are read side by side, this many.
const SMALL: u64 = 4 << 20;
const MANY: usize = 32;
/// Pieces of a long run that are looked at side by side.
const SIDE_BY_SIDE: usize = 2;
/// Most seconds that screening alone would take.
const MOST_TAKEN: f64 = 6.0 * BUDGET;

/// How much recorded time a diagnosis may rest on at most, of the recordings and of the references. By default ten minutes
/// of a torque-driven robot, which is simulated again and again, and an hour of others, whose loads are measured once.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Budget(Option<f64>);

impl Budget {
    /// A budget in minutes; zero means that everything is read and used, however long.
    pub fn of_minutes(minutes: f64) -> Self {
        Self(Some(if minutes > 0.0 { minutes * 60.0 } else { f64::INFINITY }))
    }

    /// Seconds for a robot.
    fn seconds(self, causality: Causality) -> f64 {
        self.0.unwrap_or_else(|| kind::of(causality).budget())
    }

    /// Reads recordings; of those that are longer together, the most telling pieces, compared with `references`.
    ///
    /// # Errors
    /// As [`load`]; and a long bag whose topics have several clocks, since its pieces cannot be put together.
    pub fn load(
        self,
        mapping: &Mapping,
        paths: &[PathBuf],
        options: &ReadOptions,
        (causality, references): (Causality, &[Read]),
    ) -> Result<(Loaded, Option<Coverage>)> {
        let budget = self.seconds(causality);
        let references: Vec<&Recording> = references.iter().map(|r| &r.recording).collect();
        let plan = Plan::new(mapping, paths)?;
        if budget.is_infinite() || (0..plan.len()).map(|run| plan.bytes(run)).sum::<u64>() < READ_WHOLE {
            let loaded = load(mapping, paths, options)?;
            if loaded.reads.iter().map(|r| length(&r.recording)).sum::<f64>() <= budget {
                return Ok((loaded, None));
            }
            let mut screening = Screening::new(&references, budget);
            for read in &loaded.reads {
                screening.take(&read.recording.pieces(piece_ns()))?;
            }
            let passed = loaded.reads.iter().map(Passed::of).collect::<Vec<_>>();
            let (reads, coverage, _) = chosen(screening, &passed);
            return Ok((Loaded { reads, ..loaded }, Some(coverage)));
        }
        let mut screening = Screening::new(&references, budget);
        let passed = stream(mapping, &plan, *options, &mut screening)?;
        let (reads, coverage, _) = chosen(screening, &passed);
        let loaded = Loaded {
            losses: passed.iter().flat_map(|p| p.losses.clone()).collect(),
            sources: passed.iter().flat_map(|p| p.sources.clone()).collect(),
            reads,
            unmatched: plan.unmatched,
            ignored: plan.ignored,
            ..Loaded::default()
        };
        Ok((loaded, Some(coverage)))
    }

    /// Screens recordings, however short, beside references: what would be taken, and every piece that was looked at.
    ///
    /// # Errors
    /// As [`Self::load`].
    pub fn screen(
        self,
        robot: &RobotSpec,
        [references, recordings]: [&[PathBuf]; 2],
        mapping: &Mapping,
        options: &ReadOptions,
    ) -> Result<Screened> {
        let (reference, lost) = if references.is_empty() {
            (Vec::new(), Vec::new())
        } else {
            let (loaded, _) = self.load(mapping, references, options, (robot.causality, &[]))?;
            let lost = loaded.lost().collect();
            (loaded.reads, lost)
        };
        let plan = Plan::new(mapping, recordings)?;
        let reference: Vec<&Recording> = reference.iter().map(|r| &r.recording).collect();
        let mut screening = Screening::new(&reference, self.seconds(robot.causality).min(MOST_TAKEN));
        let passed = stream(mapping, &plan, *options, &mut screening)?;
        let (_, coverage, pieces) = chosen(screening, &passed);
        let losses = passed.into_iter().flat_map(|p| p.losses).collect();
        let loaded = Loaded { losses, unmatched: plan.unmatched, ..Loaded::default() };
        Ok(Screened { coverage, pieces, lost: lost.into_iter().chain(loaded.lost()).collect() })
    }
}

/// What screening alone tells.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Screened {
    /// What a diagnosis would take.
    pub coverage: Coverage,
    /// Every piece, in order.
    pub pieces: Vec<Screen>,
    /// What could not be read, in sentences.
    pub lost: Vec<String>,
}

/// Passes once over all runs: small ones side by side, long ones in pieces.
fn stream(mapping: &Mapping, plan: &Plan, options: ReadOptions, screening: &mut Screening) -> Result<Vec<Passed>> {
    let mut out = Vec::with_capacity(plan.len());
    let is_small = |run: &usize| plan.bytes(*run) < SMALL;
    let mut runs = (0..plan.len()).peekable();
    while let Some(first) = runs.next() {
        if !is_small(&first) {
            let pass = Pass::new(0, &|_, _| {});
            out.push(plan.open(first, &pass, |run, files| screened(mapping, run, files, options, screening))?);
            continue;
        }
        let mut small = vec![first];
        while small.len() < MANY
            && let Some(next) = runs.next_if(is_small)
        {
            small.push(next);
        }
        let reads: Vec<Read> = small
            .into_par_iter()
            .map(|run| plan.open(run, &Pass::new(0, &|_, _| {}), |run, files| read_from(mapping, run, files, &options)))
            .collect::<Result<_>>()?;
        let pieces: Vec<Recording> = reads.iter().flat_map(|read| read.recording.pieces(piece_ns())).collect();
        screening.take(&pieces)?;
        out.extend(reads.iter().map(Passed::of));
    }
    for passed in &out {
        ensure!(
            passed.clocks < 2,
            "{}: its topics are stamped by {} clocks, so that a recording of this length cannot be cut into minutes; \
             cut it before, or read it whole with --budget 0",
            passed.name,
            passed.clocks
        );
    }
    Ok(out)
}

/// A recording that was passed over.
struct Passed {
    name: String,
    clocks: usize,
    losses: Vec<recordings::Loss>,
    sources: Vec<recordings::Source>,
    unused: Vec<recordings::UnusedColumn>,
}

impl Passed {
    fn of(read: &Read) -> Self {
        let Read { recording, losses, sources, unused } = read;
        let name = recording.name().to_owned();
        Self { name, clocks: 1, losses: losses.clone(), sources: sources.clone(), unused: unused.clone() }
    }
}

/// Screens one run as it is read. Runs in several tables are read whole, one table after the other.
fn screened(
    mapping: &Mapping,
    run: &str,
    files: &mut [Opened<'_>],
    options: ReadOptions,
    screening: &mut Screening,
) -> Result<Passed, RecordingError> {
    if files.len() > 1 && !files.iter().all(|f| is_bag(f.name)) {
        let read = read_from(mapping, run, files, &options)?;
        screening.take(&read.recording.pieces(piece_ns()))?;
        return Ok(Passed::of(&read));
    }
    let mut waiting = Vec::with_capacity(SIDE_BY_SIDE);
    let Passage { clocks, losses, sources, unused, .. } =
        pieces_from(mapping, run, files, &options, piece_ns(), &mut |piece| {
            waiting.push(piece);
            if waiting.len() == SIDE_BY_SIDE {
                screening.take(&waiting)?;
                waiting.clear();
            }
            Ok(())
        })?;
    screening.take(&waiting)?;
    Ok(Passed { name: run.to_owned(), clocks: clocks.len(), losses, sources, unused })
}

/// The chosen pieces as recordings, what they stand for, and every piece that was looked at.
fn chosen(screening: Screening, passed: &[Passed]) -> (Vec<Read>, Coverage, Vec<Screen>) {
    let (stretches, coverage, pieces) = screening.finish();
    let by_name: HashMap<&str, &Passed> = passed.iter().map(|p| (p.name.as_str(), p)).collect();
    let read = |Stretch { recording, of, .. }: Stretch| {
        let about = by_name.get(of.as_str());
        let sources = about.map(|a| a.sources.clone()).unwrap_or_default();
        let unused = about.map(|a| a.unused.clone()).unwrap_or_default();
        Read { recording, losses: Vec::new(), sources, unused }
    };
    (stretches.into_iter().map(read).collect(), coverage, pieces)
}

fn piece_ns() -> i64 {
    (PIECE * 1e9) as i64
}

/// Time from the first stamp to the last, s.
fn length(recording: &Recording) -> f64 {
    let spans = (0..recording.clocks().len()).filter_map(|clock| recording.span_ns(clock));
    spans.map(|(from, until)| (until - from) as f64 * 1e-9).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A table of eleven minutes at 10 rows a second.
    fn table(folder: &std::path::Path) -> PathBuf {
        let row = |time: f64| format!("{time:.1},{:.4},{:.4}", time.sin(), (0.3 * time).cos());
        let mut lines = vec!["time_s,wheel_speed_left_rad_s,torque_left_Nm".to_owned()];
        lines.extend((0..6601).map(|k| row(0.1 * f64::from(k))));
        let path = folder.join("long.csv");
        std::fs::write(&path, lines.join("\n")).expect("written");
        path
    }

    #[test]
    fn all_is_used_where_that_is_wished_and_ten_minutes_of_a_torque_driven_robot_otherwise() {
        let folder = tempfile::tempdir().expect("a folder");
        let paths = [table(folder.path())];
        let mapping = Mapping::built_in("skid-steer-columns").expect("built in");
        let coverage = |budget: Budget, causality| {
            budget.load(&mapping, &paths, &ReadOptions::default(), (causality, &[])).expect("it can be read").1
        };
        assert_eq!(coverage(Budget::of_minutes(0.0), Causality::TorqueDriven), None);
        assert_eq!(coverage(Budget::default(), Causality::SpeedDriven), None);
        let cut = coverage(Budget::default(), Causality::TorqueDriven).expect("it is longer than ten minutes");
        assert!(cut.left_out > 0 && cut.diagnosed <= 600.0 && cut.screened > 650.0, "{cut:?}");
    }
}
