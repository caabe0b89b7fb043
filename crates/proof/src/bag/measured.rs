//! What both programs took, against what is asked.

use pages::text_table::{TextTable, number};
use sim::statistics::median;

use crate::child::Ended;
use crate::output::{Asked, Figure};

/// `lacuna check` may take this many times the plain iteration.
const TIMES: f64 = 3.0;
/// And hold this much memory, MiB.
const MEMORY: f64 = 256.0;

/// The runs of both programs.
#[derive(Debug, Default)]
pub(super) struct Measured {
    pub(super) iteration: Vec<Ended>,
    pub(super) check: Vec<Ended>,
}

impl Measured {
    /// All figures, judged where something is asked.
    pub(super) fn figures(&self) -> Vec<Figure> {
        let [iteration, check] = [&self.iteration, &self.check].map(|runs| Costs::of(runs));
        let ratio = check.seconds / iteration.seconds;
        let mut figures = vec![
            Figure::free("plain iteration, median time", iteration.seconds, "s"),
            Figure::free("lacuna check, median time", check.seconds, "s"),
            Figure::free("lacuna check, times the iteration", ratio, "").asked(Asked::AtMost(TIMES)),
        ];
        let mut told = |name: &str, value: Option<f64>, unit: &str, asked: Option<f64>| {
            let Some(value) = value else { return };
            let figure = Figure::free(name, value, unit);
            figures.push(match asked {
                Some(most) => figure.asked(Asked::AtMost(most)),
                None => figure,
            });
        };
        told("plain iteration, processor time", iteration.processor, "s", None);
        told("lacuna check, processor time", check.processor, "s", None);
        told("plain iteration, peak memory", iteration.memory, "MiB", None);
        told("lacuna check, peak memory", check.memory, "MiB", Some(MEMORY));
        figures
    }

    /// The figures as text.
    pub(super) fn table(&self) -> String {
        let mut table = TextTable::new(&["figure", ">found", "", "asked", ""]);
        for figure in self.figures() {
            let met = figure.pass.map_or("", |pass| if pass { "met" } else { "MISSED" });
            let target = figure.target.unwrap_or_default();
            table.row([figure.name, number(figure.value), figure.unit, target, met.to_owned()]);
        }
        table.render()
    }
}

/// Median times and the largest memory of several runs.
struct Costs {
    seconds: f64,
    processor: Option<f64>,
    memory: Option<f64>,
}

impl Costs {
    fn of(runs: &[Ended]) -> Self {
        let memory = runs.iter().filter_map(|run| run.memory).max();
        Self {
            seconds: median(runs.iter().map(|run| run.seconds)),
            processor: Some(median(runs.iter().filter_map(|run| run.processor))).filter(|s| s.is_finite()),
            memory: memory.map(|bytes| bytes as f64 / f64::from(1 << 20)),
        }
    }
}
