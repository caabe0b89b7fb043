//! `cargo xtask learn`: which adaptive laws keep what they learn.

use std::time::Instant;

use anyhow::Result;
use pages::page::Page;
use sim::learning::{Contender, Study, StudyRecipe, Tried};

use crate::document::{to_markdown, to_page, to_text, wrapped};
use crate::output;

mod figures;
mod tables;
mod words;

/// Draws that are asked for.
const FULL: u64 = 200;
/// Draws of the noise for Eq. 8, which has no first layer to draw and takes long to run ahead.
const NOISES: u64 = 4;

/// What to run.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Number of draws of first layers and noise.
    #[arg(long, default_value_t = FULL, value_parser = clap::value_parser!(u64).range(1..))]
    draws: u64,
    /// Seed of the draws.
    #[arg(long, default_value_t = 2028)]
    seed: u64,
    /// Also write docs/paper/learning.md.
    #[arg(long)]
    docs: bool,
}

/// What came out.
struct Outcome {
    args: Args,
    study: Study,
    /// The paper's ground, which changes at 12 s.
    tried: Vec<Tried>,
    /// Ground that stays as it is.
    steady: Vec<Tried>,
    seconds: f64,
}

impl Outcome {
    fn of(&self, contender: Contender) -> Option<&Tried> {
        self.tried.iter().find(|t| t.contender == contender)
    }
}

/// Runs the command; true if all that is asked is met.
pub(crate) fn run(args: Args) -> Result<bool> {
    let clock = Instant::now();
    let recipe = StudyRecipe::default();
    let study = Study::new(&recipe)?;
    let mut steady = recipe;
    steady.recipe.disturbance = 0.0;
    let steady_study = Study::new(&steady)?;
    let draws = |c: Contender| if c.sees_the_body() { args.draws.min(NOISES) } else { args.draws };
    let on_steady =
        [Contender::Constant, Contender::Paper, Contender::Memory, Contender::Structured, Contender::StructuredMemory];
    let count = Contender::ALL.into_iter().chain(on_steady).map(draws).sum();
    let bar = output::progress(count, "draws")?;
    let try_all = |study: &Study, contenders: &[Contender]| -> Result<Vec<Tried>> {
        contenders.iter().map(|c| Ok(study.ensemble(*c, args.seed, draws(*c), || bar.inc(1))?)).collect()
    };
    let tried = try_all(&study, &Contender::ALL)?;
    let steady = try_all(&steady_study, &on_steady)?;
    bar.finish_and_clear();
    let outcome = Outcome { args, study, tried, steady, seconds: clock.elapsed().as_secs_f64() };
    write(&outcome)
}

/// Prints the tables and writes page, Markdown and numbers.
fn write(o: &Outcome) -> Result<bool> {
    let figures = figures::all(o);
    let mut sections = vec![tables::judged(&figures)];
    sections.extend(tables::all(o));
    let intro = words::introduction(o, &figures);
    println!("{}", intro.iter().map(|p| wrapped(p)).collect::<Vec<_>>().join("\n\n"));
    println!("{}", to_text(&sections));

    let folder = output::folder("learn")?;
    let markdown = to_markdown("Laws that keep what they learn", &intro.join("\n\n"), &sections);
    output::write(&folder, "learning.md", &markdown)?;
    if o.args.docs {
        output::write(&output::docs("paper"), "learning.md", &markdown)?;
    }
    output::write(&folder, "summary.json", &serde_json::to_string_pretty(&figures)?)?;
    let mut page = Page::new("Laws that keep what they learn");
    for paragraph in &intro {
        page.paragraph(paragraph);
    }
    to_page(&mut page, &sections);
    output::write(&folder, "index.html", &page.render())?;
    println!("All of it: target/learn/index.html, learning.md, summary.json; {:.0} s", o.seconds);
    Ok(figures.iter().all(|f| f.pass != Some(false)))
}
