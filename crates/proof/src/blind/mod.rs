//! `cargo xtask blind`: draws robots with something hidden, seals what it is, diagnoses them and scores the answers.
//!
//! ```text
//! set --draw--> case folders, truth, seals --diagnose (lacuna, one process per case)--> answers
//! truth, if its seal holds, and answers --score--> rows --Totals--> figures and tables
//! ```

use std::fs;
use std::path::PathBuf;

use anyhow::{Context, Result, ensure};
use clap::{Args as ClapArgs, ValueEnum};
use examiner::Plan;
use rayon::ThreadPool;

use crate::{binary, output};

mod car;
mod causes;
mod command;
mod diagnose;
mod draw;
mod drawn;
mod figures;
mod given;
pub(crate) mod layout;
mod rolling;
mod said;
mod score;
pub(crate) mod seal;
mod set;
mod speed;
mod tables;
mod totals;
pub(crate) mod truth;
mod wheeled;
mod wide;
mod write;

use layout::Layout;
pub(crate) use score::statistics::Rate;

const EXAMPLES: &str = "\
Examples:
  cargo xtask blind                                    300 cases: draw, seal, diagnose, score
  cargo xtask blind --quick --judge                    12 cases; fails when a target is missed
  cargo xtask blind --draw-only --count 20 --out DIR   cases and truth for other tools
  cargo xtask blind --wide                             robots, sensors and visits of every sort
  cargo xtask blind --robots differential              two driven wheels and casters
  cargo xtask blind --kind speed --count 200           speed-driven cases
  cargo xtask blind --kind command --count 200         command-driven cases
  cargo xtask blind --kind odometry --count 240        wheel counts and a pose
  cargo xtask blind --kind gyro --count 240            wheel counts and a gyro alone
  cargo xtask blind --kind car --count 160             cars
  cargo xtask blind --kind car --references 1          cars with a drive in which nothing was hidden
  cargo xtask blind --kind all --count 200             so many of each kind
  cargo xtask blind --cases DIR --answers DIR          answers for given cases, without their truth

A second run goes on where the first one stopped.
The program that is examined is `lacuna` beside this one. After a change to it:
  cargo build --release -p lacuna --bin lacuna";

/// Arguments of `cargo xtask blind`.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// Folder of unpacked cases, one folder each, instead of drawing some.
    #[arg(long, value_name = "DIR", requires = "answers", conflicts_with_all = ["Drawing", "Running"])]
    cases: Option<PathBuf>,
    /// Folder for answers to these cases and held-out predictions.
    #[arg(long, value_name = "DIR", requires = "cases")]
    answers: Option<PathBuf>,
    /// Only these cases.
    #[arg(long, value_delimiter = ',')]
    only: Vec<String>,
    /// Kind of the robots; of the options, other kinds than torques know --seed, --count, --references, --out, --threads, --draw-only,
    /// --judge and --docs.
    #[arg(long, value_enum, default_value_t = Kind::Torque)]
    kind: Kind,
    #[command(flatten)]
    drawing: set::Drawing,
    #[command(flatten)]
    running: Running,
}

/// Kinds of robots.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Kind {
    /// Torques are given.
    Torque,
    /// Set speeds and currents are given.
    Speed,
    /// Commanded and measured wheel speeds and a pose are given.
    Command,
    /// Counts of the wheels and a pose are given.
    Odometry,
    /// Counts of the wheels and a gyro are given.
    Gyro,
    /// Throttle, steering command and a pose of a car are given.
    Car,
    /// Torques of a robot of any wheels are given, with wheel speeds, a gyro and a pose.
    Wheeled,
    /// So many of each kind, one after the other.
    All,
}

/// Marks about the tables in a page of the documentation.
const MARKS: [&str; 2] = ["<!-- begin: cargo xtask blind -->\n", "<!-- end: cargo xtask blind -->\n"];

#[derive(Debug, ClapArgs)]
#[command(next_help_heading = "Running")]
#[expect(clippy::struct_excessive_bools, reason = "flags of a command")]
struct Running {
    /// Folder for everything that is written [default: target/blind].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Cases at a time, each on one core [default: all cores].
    #[arg(long)]
    threads: Option<usize>,
    /// Draw and seal only.
    #[arg(long, conflicts_with_all = ["fresh", "judge"])]
    draw_only: bool,
    /// Diagnose again what was diagnosed before.
    #[arg(long)]
    fresh: bool,
    /// Fail when a target is missed.
    #[arg(long)]
    judge: bool,
    /// Also write the tables into the page of the set in docs/.
    #[arg(long, conflicts_with = "draw_only")]
    docs: bool,
}

/// Runs the command; true if nothing failed to run and, when judged, no target was missed.
pub(crate) fn run(args: &Args) -> Result<bool> {
    if let (Some(cases), Some(answers)) = (&args.cases, &args.answers) {
        return given::run(cases, answers, &args.only);
    }
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(args.running.threads.unwrap_or(0))
        .build()
        .context("cannot start the threads; give fewer with --threads")?;
    let out = |usual: &str| args.running.out.clone().map_or_else(|| output::folder(usual), Ok);
    let (seed, count) = args.drawing.seed_and_count();
    let Running { draw_only, judge, docs, .. } = args.running;
    let references = args.drawing.references_of_others();
    ensure!(
        references == 0 || !matches!(args.kind, Kind::Speed | Kind::All),
        "speed-driven cases have references of their own; leave out --references, or give another --kind"
    );
    ensure!(
        references == 0 || args.kind == Kind::Torque || !args.running.docs,
        "the pages of this kind show cases without references; leave out --docs or --references"
    );
    let of = |out: PathBuf| drawn::Set { seed, count, references, out, draw_only, judge, docs };
    let speed = |out: PathBuf| pool.install(|| drawn::run::<speed::SpeedDriven>(&of(out)));
    let command = |out: PathBuf| pool.install(|| drawn::run::<command::CommandDriven>(&of(out)));
    let rolling = |out: PathBuf| pool.install(|| drawn::run::<rolling::Rolling<rolling::Pose>>(&of(out)));
    let gyro = |out: PathBuf| pool.install(|| drawn::run::<rolling::Rolling<rolling::Gyro>>(&of(out)));
    let car = |out: PathBuf| pool.install(|| drawn::run::<car::Cars>(&of(out)));
    let wheeled = |out: PathBuf| pool.install(|| drawn::run::<wheeled::AnyWheels>(&of(out)));
    match args.kind {
        Kind::Torque => torque(args, out("blind")?, &pool),
        Kind::Speed => speed(out("blind-speed")?),
        Kind::Command => command(out("blind-command")?),
        Kind::Odometry => rolling(out("blind-odometry")?),
        Kind::Gyro => gyro(out("blind-gyro")?),
        Kind::Car => car(out("blind-car")?),
        Kind::Wheeled => wheeled(out("blind-wheeled")?),
        Kind::All => {
            let folder = out("blind-all")?;
            let kinds = [
                torque(args, folder.join("torque"), &pool)?,
                speed(folder.join("speed"))?,
                command(folder.join("command"))?,
                rolling(folder.join("odometry"))?,
                gyro(folder.join("gyro"))?,
                car(folder.join("car"))?,
                wheeled(folder.join("wheeled"))?,
            ];
            Ok(kinds.into_iter().all(|met| met))
        }
    }
}

/// Torque-driven cases.
fn torque(args: &Args, out: PathBuf, pool: &ThreadPool) -> Result<bool> {
    let layout = Layout::new(out);
    let plans = args.drawing.plans();
    let chosen = set::chosen(&plans, &args.only)?;
    let seals = pool.install(|| draw::draw(&chosen, &layout))?;
    println!("Cases sealed: {} of {}, in {}", chosen.len(), plans.len(), layout.seals().display());
    if args.running.draw_only {
        return Ok(true);
    }
    examine(args, &chosen, &layout, &seals, pool)
}

/// Diagnoses what was drawn, then opens the truth and scores.
fn examine(args: &Args, plans: &[&Plan], layout: &Layout, seals: &seal::Seals, pool: &ThreadPool) -> Result<bool> {
    let binary = binary::find()?;
    let outcomes = pool.install(|| diagnose::all(plans, layout, seals, &binary, args.running.fresh))?;
    let failed = outcomes.iter().filter(|o| o.is_err()).count();
    let rows = plans
        .iter()
        .zip(&outcomes)
        .map(|(plan, outcome)| score::row(layout, plan, seals, outcome.as_ref().ok()))
        .collect::<Result<Vec<_>>>()?;
    let figures = if args.drawing.is_wide() { wide::figures(&rows, failed) } else { figures::figures(&rows, failed) };
    let page = write::all(layout, &args.drawing.described(), &rows, &figures)?;
    if args.running.docs {
        let name = args.drawing.page();
        output::into_docs(name, MARKS, &output::below_title(&page)?)?;
        if name == "blind.md" {
            let picture = output::docs("blind-reliability.svg");
            fs::copy(layout.root().join(write::PICTURE), &picture)
                .with_context(|| format!("cannot write '{}'", picture.display()))?;
        }
    }
    let missed = figures.iter().any(|f| f.pass == Some(false));
    Ok(failed == 0 && !(args.running.judge && missed))
}
