//! `lacuna rehearse`: which effects a diagnosis would find on a robot's own inputs.

use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::time::{Duration, Instant};

use anyhow::{Result, ensure};
use case_files::case_folder::CaseFolder;
use case_files::columns_case::ColumnsCase;
use case_files::envelope::Program;
use case_files::own_effects;
use clap::Args as ClapArgs;
use inference::{KnownEffects, Options};
use rehearsal::{Plan, RehearsalError, Rehearsing, RehearsingLoads, RehearsingResponse, rehearse_fit};
use robot_file::Causality;
use serde_json::json;
use verdict::Rehearsal;

use super::diagnose::{self, Input};
use super::report::write_page;
use super::{Adopted, Outcome, Usage, listed, odometry};
use crate::console::{Counted, Progress, emit, emit_json};

const EXAMPLES: &str = "\
Examples:
  lacuna rehearse case/
  lacuna rehearse case/ --effects payload,grade --size 0.5,1,2 --replicas 10
  lacuna rehearse case/ --effects my-law.toml     a law of your own
  lacuna rehearse case/ --references 0            what references are worth
  lacuna rehearse case/ --html page.html --json rehearsal.json

The torques of the recordings are driven again by the plant of the robot file,
its constants drawn within the sigmas that the file states, with and without
each effect; sensors get the rates, gaps and noise of the recordings. Every
replica is diagnosed as by `lacuna diagnose`, and the answers are counted.
Effects are present throughout, one at a time.

Before the first drive there is nothing but torques that you plan: make a case
of them with `lacuna simulate robot.toml plan.csv -o case/recordings/plan.csv`.

Of robots whose files name their columns (wheel counts, cars, any wheels) the
constants are fitted to the recordings, and replicas are drawn from the
equations of that fit: of whole drives, 40 of each size, in seconds. Sizes are
then multiples of what a cause usually has [default: 0.125,0.25,0.5,1].

Of robots whose wheel speeds are given loads of as much steady driving as was
recorded are drawn, 3 of each size [default: 1,2,4], in minutes.

Of robots that are given commands whole drives are driven again by the response
of their references, or by wheels that do what is commanded, and diagnosed: 3 of
each size [default: 0.25,0.5,1], in minutes.

With the defaults it takes minutes: of each drive the first 12 s, of two
recordings, each size three times. More of each takes longer in proportion.
The same seed gives the same answer, whatever the number of threads.

Exit codes: 0 done, 1 failed, 2 wrong usage, 3 done but some input was lost.";

const USAGE: &str = "\
lacuna rehearse [OPTIONS] <CASE>
       lacuna rehearse [OPTIONS] --robot <NAME|FILE>
                       [--reference <PATH>...] --recordings <PATH>...";

/// Arguments of `lacuna rehearse`.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES, override_usage = USAGE)]
pub(crate) struct Args {
    #[command(flatten)]
    input: Input,
    /// Sizes to simulate, in multiples of each effect's size of interest [default: 0.5,1,2,4].
    #[arg(long, value_name = "X,Y", value_delimiter = ',')]
    size: Vec<f64>,
    /// Effects to hide, as `lacuna effects` lists them; law files (LAW.toml) are effects of your own [default: all that the
    /// plant can have].
    #[arg(long, value_name = "A,B", value_delimiter = ',')]
    effects: Vec<String>,
    #[command(flatten)]
    adopted: Adopted,
    /// References of a replica, on the inputs of the recordings: what one more is worth; 0 is none
    /// [default: those of the case, on their own inputs].
    #[arg(long, value_name = "COUNT", value_parser = references)]
    references: Option<usize>,
    /// Replicas of each size.
    /// [default: 3; 40 where the equations of a fit are used].
    #[arg(long, value_name = "COUNT")]
    replicas: Option<usize>,
    /// Replicas in which nothing is hidden: how often one would be alarmed for nothing [default:
    /// 12, or as many as of each size; 24 of steady loads; 200 where the equations of a fit are used].
    #[arg(long, value_name = "COUNT")]
    fault_free: Option<usize>,
    /// Beginning of each recording and reference that is driven again, s [default: 12].
    #[arg(long, value_name = "S")]
    seconds: Option<f64>,
    /// Recordings that are driven again, at most [default: 2].
    #[arg(long, value_name = "COUNT", value_parser = drives)]
    drives: Option<usize>,
    /// Seed of all that is drawn.
    #[arg(long, value_name = "NUMBER", default_value_t = Plan::default().seed)]
    seed: u64,
    /// Write everything as JSON to a file; `-` is standard output, instead of the text.
    #[arg(long, value_name = "FILE|-")]
    json: Option<String>,
    /// Make a page with the curves: one file that opens in any browser, offline.
    #[arg(long, value_name = "PAGE.html|-")]
    html: Option<String>,
}

/// More references than anybody records.
const MOST_REFERENCES: usize = 1000;

fn references(text: &str) -> Result<usize, String> {
    let number = text.parse::<usize>().ok().filter(|number| *number <= MOST_REFERENCES);
    number.ok_or_else(|| format!("give a whole number from 0 to {MOST_REFERENCES}"))
}

fn drives(text: &str) -> Result<usize, String> {
    let number = text.parse::<usize>().ok().filter(|number| *number > 0);
    number.ok_or_else(|| "give a whole number from 1 on".to_owned())
}

impl Args {
    /// The effects to hide, law files apart from names.
    fn files_and_names(&self) -> (Vec<PathBuf>, Vec<&str>) {
        let is_file = |given: &&str| Path::new(given).extension().is_some_and(|e| e.eq_ignore_ascii_case("toml"));
        let (files, names): (Vec<&str>, Vec<&str>) = self.effects.iter().map(|given| given.trim()).partition(is_file);
        (files.into_iter().map(PathBuf::from).collect(), names)
    }

    /// Refuses what is of robots whose drives are simulated again in part.
    fn refuse_parts_of_drives(&self, robot: &str) -> Result<()> {
        for (given, option) in [(self.seconds.is_some(), "--seconds"), (self.drives.is_some(), "--drives")] {
            if given {
                return Err(Usage(format!(
                    "{option} is of robots that are given torques; of '{robot}' whole drives are taken, and all of them; leave it out"
                ))
                .into());
            }
        }
        Ok(())
    }

    fn plan(&self, known: KnownEffects, usual: Plan) -> Plan {
        let (_, names) = self.files_and_names();
        let of_catalogue = names.into_iter().map(|name| name.to_lowercase().replace(['-', ' '], "_"));
        let own = known.own().iter().map(|own| own.name().to_owned());
        Plan {
            sizes: if self.size.is_empty() { usual.sizes } else { self.size.clone() },
            effects: of_catalogue.chain(own).collect(),
            references: self.references,
            replicas: self.replicas.unwrap_or(usual.replicas),
            fault_free: self.fault_free.unwrap_or(usual.fault_free),
            seed: self.seed,
            seconds: self.seconds.unwrap_or(usual.seconds),
            recordings: self.drives.unwrap_or(usual.recordings),
        }
    }
}

/// Rehearses a case.
pub(crate) fn run(args: &Args, verbose: bool) -> Result<Outcome> {
    let known = own_effects::read(&args.files_and_names().0, &args.adopted.adopt)?;
    for target in [&args.json, &args.html].into_iter().flatten() {
        is_writable(target)?;
    }

    let progress = Progress::new(verbose);
    progress.stage("reading the recordings");
    if let Some(case) = odometry::case(&args.input)? {
        known.refused_for(case.kind().name())?;
        return of_fit(args, &case, progress);
    }
    let robot = diagnose::located(&args.input, known)?.robot;
    let plan = args.plan(known, Plan::default());
    if robot.causality == Causality::TorqueDriven {
        let names: Vec<&str> = known.all().map(|effect| effect.spec().id).collect();
        plan.checked(&names).map_err(told)?;
    }
    let (folder, mapping) = diagnose::read(&args.input, known)?;
    let options = Options { known, ..Options::default() };
    match robot.causality {
        Causality::TorqueDriven => {}
        Causality::SpeedDriven => return of_loads(args, (&folder, &mapping), &options, progress, verbose),
        Causality::CommandDriven => {
            known.refused_for(robot.causality.name())?;
            return of_response(args, (&folder, &mapping), progress, verbose);
        }
    }
    let case = folder.torque_driven()?;
    progress.stage("looking which effects these inputs can show");
    let rehearsing = Rehearsing::new(&case, &plan, &options).map_err(told)?;
    drop(progress);

    let rehearsal = counted(rehearsing.count(), verbose, |listener| rehearsing.run(listener)).map_err(told)?;
    tell(args, &folder, &mapping, &rehearsal)
}

/// Rehearses a robot whose wheel speeds are given.
fn of_loads(
    args: &Args,
    (folder, mapping): (&CaseFolder, &str),
    options: &Options,
    progress: Progress,
    verbose: bool,
) -> Result<Outcome> {
    args.refuse_parts_of_drives(&folder.robot.name)?;
    let plan = args.plan(options.known, Plan::of_loads());
    let case = folder.speed_driven()?;
    let rehearsing = RehearsingLoads::new(&case, &plan, options, &|what| progress.stage(what)).map_err(told)?;
    drop(progress);
    let rehearsal = counted(rehearsing.count(), verbose, |listener| rehearsing.run(listener));
    tell(args, folder, mapping, &rehearsal)
}

/// Rehearses a robot that is given commands.
fn of_response(
    args: &Args,
    (folder, mapping): (&CaseFolder, &str),
    progress: Progress,
    verbose: bool,
) -> Result<Outcome> {
    args.refuse_parts_of_drives(&folder.robot.name)?;
    let plan = args.plan(KnownEffects::default(), Plan::of_response());
    let case = folder.command_driven()?;
    let rehearsing = RehearsingResponse::new(&case, &plan, &|what| progress.stage(what)).map_err(told)?;
    drop(progress);
    let rehearsal = counted(rehearsing.count(), verbose, |listener| rehearsing.run(listener));
    tell(args, folder, mapping, &rehearsal)
}

/// Runs so many diagnoses with a line for each.
fn counted<T>(diagnoses: usize, verbose: bool, run: impl FnOnce(&(dyn Fn(&str) + Sync)) -> T) -> T {
    let progress = Counted::new(diagnoses, "diagnoses", verbose);
    let last = Mutex::new(Instant::now());
    run(&|line| {
        // Time since the line before: of all threads together.
        let took =
            last.lock().map_or(Duration::ZERO, |mut last| std::mem::replace(&mut *last, Instant::now()).elapsed());
        progress.one(line, took);
    })
}

/// Writes a rehearsal of a folder with what was lost.
fn tell(args: &Args, folder: &CaseFolder, mapping: &str, rehearsal: &Rehearsal) -> Result<Outcome> {
    let lost = folder.lost();
    let about = json!({ "robot": folder.robot.to_json()?, "mapping": mapping, "lost": lost });
    write(args, rehearsal, &folder.robot.name, about)?;
    if ![&args.json, &args.html].iter().any(|target| target.as_deref() == Some("-")) {
        emit(&listed("Input that was lost", &lost))?;
    }
    Ok(Outcome::of(&lost))
}

/// Rehearses a case whose constants are fitted to whole drives.
fn of_fit(args: &Args, case: &ColumnsCase, progress: Progress) -> Result<Outcome> {
    args.refuse_parts_of_drives(case.robot_name())?;
    let plan = args.plan(KnownEffects::default(), Plan::of_fit());
    let rehearsable = case.rehearsable(&|what| progress.stage(what))?;
    progress.stage("naming the causes of replicas");
    let rehearsal = rehearse_fit(&rehearsable, &plan).map_err(told)?;
    drop(progress);
    write(args, &rehearsal, case.robot_name(), json!({ "robot": case.robot() }))?;
    Ok(Outcome::of(&[]))
}

/// Writes what was asked for; `about` is what stands beside a rehearsal in JSON.
fn write(args: &Args, rehearsal: &Rehearsal, robot: &str, mut about: serde_json::Value) -> Result<()> {
    if let Some(target) = &args.html {
        write_page(target, &::report::rehearsal_page::render(rehearsal, robot, &program()))?;
    }
    if let Some(target) = &args.json {
        about["format"] = json!(1);
        about["program"] = json!(Program::default());
        about["rehearsal"] = json!(rehearsal);
        emit_json(target, &about)?;
    }
    if ![&args.json, &args.html].iter().any(|target| target.as_deref() == Some("-")) {
        emit(&::report::rehearsal_text::render(rehearsal))?;
    }
    Ok(())
}

/// A plan that makes no sense is wrong usage.
fn told(error: RehearsalError) -> anyhow::Error {
    if error.is_of_plan() { Usage(error.to_string()).into() } else { error.into() }
}

fn program() -> String {
    let Program { name, version } = Program::default();
    format!("{name} {version}")
}

/// Refuses a folder, and a file in a folder that is not there, before minutes are spent on what cannot be written.
fn is_writable(target: &str) -> Result<()> {
    ensure!(!Path::new(target).is_dir(), "cannot write '{target}': it is a folder; name a file in it");
    let folder = Path::new(target).parent().filter(|folder| target != "-" && !folder.as_os_str().is_empty());
    let Some(folder) = folder else { return Ok(()) };
    ensure!(
        folder.is_dir(),
        "cannot write '{target}': there is no folder '{}'; make it, or name another place",
        folder.display()
    );
    Ok(())
}
