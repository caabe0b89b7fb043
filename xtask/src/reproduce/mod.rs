//! `cargo xtask reproduce`: Table 1 and the figures of Hendzel & Trojnacki 2014, and what they can mean.

use std::time::Instant;

use anyhow::{Context, Result};
use indicatif::ProgressBar;
use pages::page::Page;
use pages::reproduction::{Signals, figures};
use sim::table1::{Check, Distribution, distributions, judge, typical};
use sim::{Draw, Experiment, Recipe, RobotSet, Trajectory};

use crate::document::{to_markdown, to_page, to_text, wrapped};
use crate::output;

mod numbers;
mod recipe;
mod tables;
mod words;

use recipe::Variation;

/// Draws that the tolerance was stated for.
const FULL: u64 = 1000;
/// Draws of a variation; medians need no more.
const VARIED: u64 = 200;

/// What to run.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Number of random first layers per set; variations get at most 200.
    #[arg(long, default_value_t = FULL, value_parser = clap::value_parser!(u64).range(1..))]
    draws: u64,
    /// Seed of the first layers.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Leave out what moves the indices.
    #[arg(long)]
    no_variations: bool,
    /// Also write docs/paper/reproduction.md.
    #[arg(long)]
    docs: bool,
}

/// Many draws of one recipe.
struct Ensemble {
    name: String,
    draws: Vec<Draw>,
    constant: Draw,
    table: Vec<Distribution>,
    checks: Vec<Check>,
}

impl Ensemble {
    fn run(
        name: &str,
        recipe: &Recipe,
        set: RobotSet,
        seed: u64,
        draws: u64,
        bar: &ProgressBar,
    ) -> Result<(Experiment, Self)> {
        let what = || format!("in `{name}`");
        let experiment = Experiment::new(recipe, set).with_context(what)?;
        let draws = experiment.ensemble(seed, draws, || bar.inc(1)).with_context(what)?;
        let constant = experiment.constant_regressor().with_context(what)?;
        let (table, checks) = (distributions(&draws), judge(&draws, &experiment.trajectory().windows));
        Ok((experiment, Self { name: name.to_owned(), draws, constant, table, checks }))
    }

    fn missed(&self) -> impl Iterator<Item = &Check> {
        self.checks.iter().filter(|c| !c.pass)
    }
}

/// What came out.
struct Outcome {
    args: Args,
    recipe: Recipe,
    /// The judged set first.
    rows: Vec<Ensemble>,
    variations: Vec<Ensemble>,
    run: Trajectory,
    seconds: f64,
}

impl Outcome {
    fn judged(&self) -> &Ensemble {
        &self.rows[0]
    }
}

/// Runs the command; true if set B is within tolerance.
pub(crate) fn run(args: Args) -> Result<bool> {
    let (recipe, mut variations) = recipe::frozen()?;
    let clock = Instant::now();
    let (full, varied): (Vec<Variation>, Vec<Variation>) = variations.drain(..).partition(|v| v.full);
    let varied = if args.no_variations { Vec::new() } else { varied };
    let few = args.draws.min(VARIED);
    let bar = output::progress(args.draws * (3 + full.len() as u64) + few * varied.len() as u64, "first layers")?;
    let name = |set: RobotSet| format!("{} ({} kg)", set.name(), recipe.sets.of(set).robot.mass);
    let row = |name: &str, recipe: &Recipe, set, draws| Ensemble::run(name, recipe, set, args.seed, draws, &bar);

    let (experiment, judged) = row(&name(RobotSet::B), &recipe, RobotSet::B, args.draws)?;
    let mut rows = vec![judged];
    for set in [RobotSet::A, RobotSet::C] {
        rows.push(row(&name(set), &recipe, set, args.draws)?.1);
    }
    for v in &full {
        rows.push(row(&format!("B, {}", v.name), &v.recipe, RobotSet::B, args.draws)?.1);
    }
    let variations: Result<Vec<_>> = varied.iter().map(|v| Ok(row(&v.name, &v.recipe, RobotSet::B, few)?.1)).collect();
    let variations = variations?;
    bar.finish_and_clear();

    let run = experiment.trajectory().clone();
    let outcome = Outcome { args, recipe, rows, variations, run, seconds: clock.elapsed().as_secs_f64() };
    write(&outcome, &experiment)?;
    Ok(outcome.judged().missed().next().is_none())
}

/// Prints the summary and writes the page, the Markdown and the numbers.
fn write(o: &Outcome, experiment: &Experiment) -> Result<()> {
    let sections = tables::all(o);
    println!("{}\n{}\n{}", o.recipe.title, words::setting(o), to_text(&sections));
    println!("{}\n\n{}", wrapped(&o.recipe.disclosure), wrapped(&words::verdict(o)));

    let folder = output::folder("reproduce")?;
    output::write(&folder, "summary.json", &serde_json::to_string_pretty(&numbers::summary(o))?)?;
    output::write(&folder, "numbers.json", &serde_json::to_string_pretty(&numbers::all(o))?)?;
    let intro = words::introduction(o);
    let markdown = to_markdown("The paper, reproduced", &intro.join("\n\n"), &sections);
    output::write(&folder, "reproduction.md", &markdown)?;
    if o.args.docs {
        output::write(&output::docs("paper"), "reproduction.md", &markdown)?;
    }

    let chosen = typical(&o.judged().draws).context("no draws")?;
    let signals = signals(&o.run, experiment.trace(o.args.seed, chosen.number)?);
    let mut page = Page::new(&o.recipe.title);
    for paragraph in &intro {
        page.paragraph(paragraph);
    }
    to_page(&mut page, &sections[..2]);
    let note = format!(
        "Figures 5 to 7 show draw {} of set B, whose four indices lie nearest to the medians: a typical one, not the best.",
        chosen.number
    );
    figures(&mut page, &note, &signals);
    to_page(&mut page, &sections[2..]);
    output::write(&folder, "index.html", &page.render())?;
    println!("\nPage and numbers: target/reproduce/index.html, reproduction.md, numbers.json, summary.json");
    Ok(())
}

fn signals(run: &Trajectory, trace: sim::Trace) -> Signals {
    let states = || run.states.iter().skip(1);
    let side = |f: &dyn Fn(usize) -> Vec<f64>| [f(0), f(1)];
    Signals {
        path: [states().map(|s| s.x).collect(), states().map(|s| s.y).collect()],
        desired: side(&|i| run.desired.iter().map(|p| p[i]).collect()),
        torque: side(&|i| run.torques.iter().map(|u| u[i]).collect()),
        angle: side(&|i| states().map(|s| s.angle[i]).collect()),
        speed: side(&|i| states().map(|s| s.speed[i]).collect()),
        time: trace.time,
        angle_estimate: trace.angle_estimate,
        angle_error: trace.angle_error,
        angle_error_estimated_speed: trace.angle_error_estimated_speed,
        speed_estimate: trace.speed_estimate,
        speed_error: trace.speed_error,
        weight: trace.weight,
        events: run.windows.start.to_vec(),
    }
}
