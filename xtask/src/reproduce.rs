//! `cargo xtask reproduce`: Table 1 and the figures of Hendzel & Trojnacki 2014.

use std::fmt::Write;
use std::time::Instant;

use anyhow::Context;
use clap::ValueEnum;
use report::reproduction::{Condition, Index, Reproduction, Signals};
use sim::table1::{Check, Distribution, distributions, judge, typical};
use sim::{Draw, Experiment, Recipe, RobotSet, Trajectory};

use crate::output;

mod numbers;
use numbers::{found, numbers, summary, text};

const RECIPE: &str = include_str!("../recipes/hendzel-trojnacki-2014.toml");
/// Draws that the tolerance was stated for.
const FULL: u64 = 1000;

/// What to run.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Number of random first layers.
    #[arg(long, default_value_t = FULL, value_parser = clap::value_parser!(u64).range(1..))]
    draws: u64,
    /// Seed of the first layers.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Robot: A 20 kg, B 40 kg, C 90 kg. The tolerance is judged for B; A and C are shown beside it.
    #[arg(long, default_value = "B", ignore_case = true)]
    set: Set,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "UPPER")]
enum Set {
    A,
    B,
    C,
}

impl From<Set> for RobotSet {
    fn from(set: Set) -> Self {
        match set {
            Set::A => Self::A,
            Set::B => Self::B,
            Set::C => Self::C,
        }
    }
}

/// What came out.
struct Outcome<'a> {
    args: &'a Args,
    recipe: Recipe,
    run: &'a Trajectory,
    draws: Vec<Draw>,
    constant: Draw,
    table: Vec<Distribution>,
    checks: Vec<Check>,
    seconds: [f64; 2],
}

impl Outcome<'_> {
    fn judged(&self) -> bool {
        self.args.set == Set::B
    }

    fn within(&self) -> bool {
        self.checks.iter().all(|c| c.pass)
    }

    fn setting(&self) -> String {
        format!(
            "Set {:?} ({} kg), {} draws of the first layer, seed {}; {} samples of {} s, {} Runge-Kutta steps each.",
            self.args.set,
            self.run.parameters.mass,
            self.args.draws,
            self.args.seed,
            self.recipe.samples,
            self.recipe.step,
            self.recipe.substeps
        )
    }

    fn verdict(&self) -> String {
        let missed = self.checks.iter().filter(|c| !c.pass).count();
        let mut text = match (self.within(), self.judged()) {
            (true, _) => "Reproduced in kind: every condition of the tolerance is met.".to_owned(),
            (false, true) => {
                format!("Not reproduced: {missed} conditions of the tolerance are missed.")
            }
            (false, false) => format!("{missed} conditions are missed."),
        };
        if !self.judged() {
            text += " The tolerance is judged for set B only; this set is shown beside it.";
        }
        if self.args.draws < FULL {
            let _ = write!(text, " It was stated for {FULL} draws; these are {}.", self.args.draws);
        }
        text
    }
}

/// Runs the command; true if set B is within tolerance, or another set was asked for.
pub(crate) fn run(args: &Args) -> anyhow::Result<bool> {
    let recipe: Recipe = toml::from_str(RECIPE).context("the built-in recipe")?;
    let clock = Instant::now();
    let experiment = Experiment::new(&recipe, args.set.into())?;
    let plant = clock.elapsed().as_secs_f64();
    let clock = Instant::now();
    let bar = output::progress(args.draws, "first layers")?;
    let draws = experiment.ensemble(args.seed, args.draws, || bar.inc(1))?;
    bar.finish_and_clear();
    let constant = experiment.constant_regressor()?;
    let outcome = Outcome {
        args,
        recipe,
        run: experiment.trajectory(),
        table: distributions(&draws),
        checks: judge(&draws, &experiment.trajectory().windows),
        constant,
        draws,
        seconds: [plant, clock.elapsed().as_secs_f64()],
    };
    print!("{}", text(&outcome));
    let folder = output::folder("reproduce")?;
    output::write(&folder, "summary.json", &serde_json::to_string_pretty(&summary(&outcome))?)?;
    output::write(&folder, "numbers.json", &serde_json::to_string_pretty(&numbers(&outcome))?)?;
    output::write(&folder, "index.html", &report::reproduction::page(&page(&outcome, &experiment)?))?;
    println!("\nPage and numbers: target/reproduce/index.html, numbers.json, summary.json");
    Ok(outcome.within() || !outcome.judged())
}

fn page(o: &Outcome, experiment: &Experiment) -> anyhow::Result<Reproduction> {
    let chosen = typical(&o.draws).context("no draws")?;
    let indices = o.table.iter().zip(o.constant.table1()).map(|(d, constant)| Index {
        name: d.name.into(),
        paper: d.paper,
        quantiles: d.quantiles,
        percentile: d.percentile,
        constant,
    });
    let conditions = o.checks.iter().map(|c| Condition {
        rule: c.rule,
        name: c.name.clone(),
        found: format!("{} {}", found(c), c.unit).trim().into(),
        target: format!("{} {}", c.target, c.unit).trim().into(),
        pass: c.pass,
    });
    Ok(Reproduction {
        title: o.recipe.title.clone(),
        setting: o.setting(),
        verdict: o.verdict(),
        disclosure: o.recipe.disclosure.clone(),
        indices: indices.collect(),
        conditions: conditions.collect(),
        figures_of: format!(
            "Figures 5 to 7 show draw {}, whose four indices lie nearest to the medians: a typical one, not the best.",
            chosen.number
        ),
        signals: signals(o.run, experiment.trace(o.args.seed, chosen.number)?),
    })
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

#[cfg(test)]
mod tests {
    use sim::Recipe;

    #[test]
    fn the_frozen_recipe_is_the_default_one() {
        let recipe: Recipe = toml::from_str(super::RECIPE).expect("valid");
        assert!(recipe.disclosure.contains("Table 1 was in view"));
        let default =
            Recipe { title: recipe.title.clone(), disclosure: recipe.disclosure.clone(), ..Recipe::default() };
        assert_eq!(recipe, default);
    }
}
