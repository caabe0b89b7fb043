//! Long recordings: screened once as they are read, a budget of their most telling minutes kept.

use std::path::PathBuf;

use anyhow::{Result, ensure};
use diagnosis::Coverage;
use diagnosis::long::{BUDGET, PIECE, Screening, Stretch};
use recordings::{
    Mapping, Opened, Passage, Read, ReadOptions, Recording, RecordingError, is_bag, pieces_from, read_from,
};

use crate::Causality;
use crate::inputs::{Loaded, load, runs, total_bytes};

/// Files of fewer bytes together are read whole before anything is asked of them.
const READ_WHOLE: u64 = 16 << 20;
/// Pieces that are looked at side by side.
const SIDE_BY_SIDE: usize = 4;

/// How much recorded time a diagnosis may rest on at most, of the recordings and of the references. By default ten minutes
/// of a torque-driven robot, which is simulated again and again, and two hours of others, whose loads are measured once.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Budget(Option<f64>);

impl Budget {
    /// A budget in minutes; zero means that everything is read and used, however long.
    pub fn of_minutes(minutes: f64) -> Self {
        Self(Some(if minutes > 0.0 { minutes * 60.0 } else { f64::INFINITY }))
    }

    /// Seconds for a robot.
    fn seconds(self, causality: Causality) -> f64 {
        self.0.unwrap_or(if causality == Causality::TorqueDriven { BUDGET } else { 12.0 * BUDGET })
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
        if budget.is_infinite() || total_bytes(mapping, paths)? < READ_WHOLE {
            let loaded = load(mapping, paths, options)?;
            if loaded.reads.iter().map(|r| length(&r.recording)).sum::<f64>() <= budget {
                return Ok((loaded, None));
            }
            let mut screening = Screening::new(&references, budget);
            for read in &loaded.reads {
                screening.take(&read.recording.pieces(piece_ns()))?;
            }
            let passed = loaded.reads.iter().map(Passed::of).collect::<Vec<_>>();
            return Ok(chosen(screening, &passed, loaded));
        }
        let mut screening = Screening::new(&references, budget);
        let screened =
            runs(mapping, paths, &|_, _| {}, |run, files| screened(mapping, run, files, *options, &mut screening))?;
        for passed in &screened.found {
            ensure!(
                passed.clocks < 2,
                "{}: its topics are stamped by {} clocks, so that a recording of this length cannot be cut into minutes; \
                 cut it before, or read it whole with --budget 0",
                passed.name,
                passed.clocks
            );
        }
        let loaded = Loaded {
            losses: screened.found.iter().flat_map(|p| p.passage.losses.clone()).collect(),
            sources: screened.found.iter().flat_map(|p| p.passage.sources.clone()).collect(),
            reads: Vec::new(),
            unmatched: screened.unmatched,
            ignored: screened.ignored,
        };
        Ok(chosen(screening, &screened.found, loaded))
    }
}

/// A recording that was passed over.
struct Passed {
    name: String,
    clocks: usize,
    passage: About,
}

/// What is told of a recording besides its samples.
struct About {
    losses: Vec<recordings::Loss>,
    sources: Vec<recordings::Source>,
    unused: Vec<recordings::UnusedColumn>,
}

impl Passed {
    fn of(read: &Read) -> Self {
        let Read { recording, losses, sources, unused } = read;
        let passage = About { losses: losses.clone(), sources: sources.clone(), unused: unused.clone() };
        Self { name: recording.name().to_owned(), clocks: 1, passage }
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
    Ok(Passed { name: run.to_owned(), clocks: clocks.len(), passage: About { losses, sources, unused } })
}

/// The chosen pieces in place of the recordings.
fn chosen(screening: Screening, passed: &[Passed], loaded: Loaded) -> (Loaded, Option<Coverage>) {
    let (stretches, coverage) = screening.finish();
    let read = |Stretch { recording, of, .. }: Stretch| {
        let about = passed.iter().find(|p| p.name == of).map(|p| &p.passage);
        let sources = about.map(|a| a.sources.clone()).unwrap_or_default();
        let unused = about.map(|a| a.unused.clone()).unwrap_or_default();
        Read { recording, losses: Vec::new(), sources, unused }
    };
    let reads = stretches.into_iter().map(read).collect();
    (Loaded { reads, ..loaded }, Some(coverage))
}

fn piece_ns() -> i64 {
    (PIECE * 1e9) as i64
}

/// Time from the first stamp to the last, s.
fn length(recording: &Recording) -> f64 {
    let spans = (0..recording.clocks().len()).filter_map(|clock| recording.span_ns(clock));
    spans.map(|(from, until)| (until - from) as f64 * 1e-9).fold(0.0, f64::max)
}
