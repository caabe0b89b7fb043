//! `lacuna diagnose`: names what a simulation lacks.

use crate::mcap_out;
use robot_file::RobotSpec;
use std::path::PathBuf;

use ::report::diagnosis_text;
use anyhow::{Context, Result, bail};
use case_files::case_folder::{self, CaseFolder};
use case_files::columns_case::ColumnsCase;
use case_files::envelope::Envelope;
use case_files::long::Budget;
use case_files::parts::{simulation_of, unread_folders};
use case_files::report_page::{page, page_of_columns};
use case_files::visits::GivenVisit;
use case_files::{kind, own_effects, predictions, which_mapping};
use clap::{Args as ClapArgs, ValueEnum};
use inference::{KnownEffects, Options, SearchForLaw};
use recordings::Mapping;
use verdict::{Diagnosis, Verdict};

use super::{Outcome, OwnEffects, Reading, odometry, report};
use crate::console::{Progress, Stages, emit, emit_json, warning};

const EXAMPLES: &str = "\
Examples:
  lacuna diagnose case/
  lacuna diagnose case/ --json verdict.json --predictions out/
  lacuna diagnose case/ --fail-on mismatch        guards a simulator in CI
  lacuna diagnose case/ --report page.html
  lacuna diagnose case/ --effects my-law.toml     weighs a law of your own too
  lacuna diagnose --robot robot.toml --mapping my-robot.toml \\
         --reference monday/ --recordings tuesday/run_3.csv tuesday/run_4.csv
  lacuna diagnose case/ --visit 'today=*'         references and recordings are of
                                                  one day, place and load
  lacuna diagnose case/ --visit 'monday=reference/mon_*' \\
         --visit 'tuesday=reference/tue_*,recordings/run_1.csv'
  lacuna diagnose --robot husky-a200 --mapping husky-open \\
         --reference FLOORING --recordings SANDY_LOAM
  lacuna diagnose --robot husky-drive --recordings drives/ --heldout unseen/
  lacuna diagnose --robot my-differential.toml --recordings drives/
        wheel counts and a pose, with a robot file of kind = \"odometry\"
  lacuna diagnose --robot my-differential.toml --recordings drives/ \\
         --heldout new/ --predictions poses/      where counts alone lead to
  lacuna diagnose --robot my-car.toml --recordings drives/
        throttle, steering, pose or gyro and encoder, with one of kind = \"car\"

A case folder:
  robot.toml    or robot.json; or name a robot with --robot
  reference/    real drives in which the simulation was right (may be missing:
                the robot file then stands in their place, as sure as it states,
                and smaller effects pass for constants)
  simulation/   logs of your simulator on the torques of the recordings (may be
                missing)
  recordings/   drives in which it was not
  heldout/      inputs whose response is to be predicted (may be missing)

Built-in robots: husky-a200, kobuki, husky-drive, warthog-drive,
  hendzel-trojnacki-2014; of wheel counts and a pose (kind = \"odometry\"):
  differential, tricycle, omni-3, omni-4, mecanum-4, skid-steer-4; cars
  (kind = \"car\"): car, dart
Built-in mappings: skid-steer-columns, husky-open (CSV); husky-bag, kobuki-bag
  (ROS 2 bags); lacuna (what `lacuna convert` writes)

Exit codes: 0 done, 1 failed, 2 wrong usage, 3 done but some of the recordings was lost,
  4 done and a mismatch was found (with --fail-on mismatch; replaces 3).";

/// Where each stage begins, as a share of the time of a torque-driven case; measured on drawn cases.
/// What there is to say where nothing can be predicted.
const NOTHING_HELD_OUT: &str =
    "there is no held-out drive, so nothing was predicted; give some with heldout/ or --heldout";

const STAGES: Stages = &[
    ("reading the recordings", 0.0),
    ("calibrating on the references", 0.005),
    ("screening every effect", 0.15),
    ("re-tuning without any effect", 0.23),
    ("fitting the finalists", 0.32),
    ("looking for a second effect", 0.47),
    ("comparing on data that was not fitted", 0.85),
    ("looking for a law without a name", 0.95),
];

/// Length of the drives that are advised, s.
pub(crate) const NEXT_LENGTH: f64 = 12.0;
const USAGE: &str = "\
lacuna diagnose [OPTIONS] <CASE>
       lacuna diagnose [OPTIONS] --robot <NAME|FILE>
                       [--reference <PATH>...] --recordings <PATH>...";

/// A case on the command line.
#[derive(Debug, ClapArgs)]
pub(crate) struct Input {
    /// Folder with robot.toml (or robot.json), recordings/ and perhaps reference/, simulation/ and heldout/.
    #[arg(required_unless_present_all = ["robot", "recordings"])]
    pub(crate) case: Option<PathBuf>,
    /// Robot file, or name of a built-in robot.
    #[arg(long, value_name = "NAME|FILE")]
    pub(crate) robot: Option<String>,
    /// Mapping file (column -> signal, unit, sign), or name of a built-in mapping [default: skid-steer-columns for tables;
    /// for bags the built-in one that fits].
    #[arg(long, value_name = "NAME|FILE")]
    pub(crate) mapping: Option<String>,
    /// Files or folders of real drives in which the simulation was right; without any, recordings are compared with the
    /// robot file, whose constants are as sure as it states.
    #[arg(long, value_name = "PATH", num_args = 1.., conflicts_with = "case")]
    pub(crate) reference: Vec<PathBuf>,
    /// Files or folders of logs of your simulator, run on the torques of the recordings: they say what the simulation
    /// believes, the robot file is checked against them, and recordings are compared with the robot that they show.
    #[arg(long, value_name = "PATH", num_args = 1..)]
    pub(crate) simulation: Vec<PathBuf>,
    /// Files or folders of drives in which it was not.
    #[arg(long, value_name = "PATH", num_args = 1.., conflicts_with = "case")]
    pub(crate) recordings: Vec<PathBuf>,
    /// Files or folders of inputs whose response is to be predicted.
    #[arg(long, value_name = "PATH", num_args = 1.., conflicts_with = "case")]
    pub(crate) heldout: Vec<PathBuf>,
    /// Nobody changed the robot since it was right: its mass, motors and wheels are what they were, so no such cause is
    /// weighed (torque- and speed-driven robots).
    #[arg(long)]
    pub(crate) same_robot: bool,
    /// Drives of one day, place and load, between which constants do not move (torque-driven robots): a name, and which
    /// references and recordings these are, by file or folder, `*` standing for anything. Again for each visit. Drives that
    /// no --visit names: references are one visit and recordings another, or several by folder or start time.
    #[arg(long, value_name = "NAME=FILE[,FILE...]", value_parser = GivenVisit::parse)]
    pub(crate) visit: Vec<GivenVisit>,
    /// What to do with bad rows and cells of recordings.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) reading: Reading,
    /// Recorded time that the diagnosis rests on at most, of the recordings and of the references. Longer ones are screened
    /// whole, and their most telling minutes are taken; 0 takes everything [default: 10 for torque-driven robots, 60 for
    /// others].
    #[arg(long, value_name = "MINUTES", value_parser = minutes)]
    pub(crate) budget: Option<f64>,
}

/// A number of minutes.
pub(crate) fn minutes(text: &str) -> Result<f64, String> {
    let minutes = text.parse::<f64>().ok().filter(|m| m.is_finite() && (*m == 0.0 || *m >= 3.0));
    minutes.ok_or_else(|| "give 3 minutes or more, or 0 for everything".to_owned())
}

/// Arguments of `lacuna diagnose`.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES, override_usage = USAGE)]
pub(crate) struct Args {
    #[command(flatten)]
    input: Input,
    /// Write everything as JSON to a file; `-` is standard output, instead of the text.
    #[arg(long, value_name = "FILE|-")]
    json: Option<String>,
    /// Write the predicted responses of the held-out drives as CSV into this folder.
    #[arg(long, value_name = "DIR")]
    predictions: Option<PathBuf>,
    /// Draw the verdict as one SVG picture: probabilities of the causes, errors on drives left out of the fit.
    #[arg(long, value_name = "FILE.svg")]
    picture: Option<PathBuf>,
    /// Write a page that shows the verdict, all evidence for it and the next drive (as with --next): one file that opens
    /// in any browser, offline.
    #[arg(long, value_name = "PAGE.html")]
    report: Option<String>,
    /// Write recorded and simulated signals, their difference and the verdict as MCAP for Foxglove, with a layout beside
    /// it (FILE.layout.json).
    #[arg(long, value_name = "FILE.mcap")]
    mcap: Option<PathBuf>,
    /// End with exit code 4 when there is a mismatch, whether it could be explained or not.
    #[arg(long, value_enum, value_name = "WHAT")]
    fail_on: Option<FailOn>,
    /// Advise on the next drive too, in the JSON and as a sentence: a few seconds more (`lacuna next` shows all of it).
    #[arg(long)]
    next: bool,
    /// When to look for a law that has no name in the catalogue (torque-driven robots; a few seconds more): where the cause
    /// is unknown or the best name leaves much of the mismatch, always, or never.
    #[arg(long, value_enum, value_name = "WHEN", default_value_t)]
    law: LawWhen,
    #[command(flatten)]
    effects: OwnEffects,
    /// Weigh this effect of the motion as little as if the catalogue did not hold it: shows what would be said of a cause
    /// without a name.
    #[arg(long, value_name = "EFFECT", value_parser = effect)]
    without: Option<&'static str>,
}

/// An effect by its id.
fn effect(id: &str) -> Result<&'static str, String> {
    let all = robot_model::effects::catalogue::<f64>();
    let found = all.iter().map(|e| e.spec().id).find(|known| *known == id);
    found.ok_or_else(|| {
        format!(
            "no effect of torque-driven robots is called '{id}', and no other cause can be left out; `lacuna effects` lists them"
        )
    })
}

/// When a law is looked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
enum LawWhen {
    /// Whatever the answer is.
    Always,
    /// Where the cause is unknown, or the best name leaves much of the mismatch.
    #[default]
    Unknown,
    /// Never.
    Never,
}

impl From<LawWhen> for SearchForLaw {
    fn from(when: LawWhen) -> Self {
        match when {
            LawWhen::Always => Self::Always,
            LawWhen::Unknown => Self::Unknown,
            LawWhen::Never => Self::Never,
        }
    }
}

/// What shall count as a failure of the simulation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum FailOn {
    /// The verdict is explained or unknown.
    Mismatch,
}

/// How a diagnosis ended for a caller who may have asked to be told of a mismatch.
fn outcome(verdict: Verdict, fail_on: Option<FailOn>, lost: &[String]) -> Outcome {
    match (fail_on, verdict) {
        (Some(FailOn::Mismatch), Verdict::Explained | Verdict::Unknown) => Outcome::Mismatch,
        _ => Outcome::of(lost),
    }
}

/// Diagnoses a case.
pub(crate) fn run(args: &Args, verbose: bool) -> Result<Outcome> {
    let known = args.effects.known()?;
    let progress = Progress::of(STAGES, verbose);
    progress.stage("reading the recordings");
    for folder in args.input.case.iter().flat_map(|case| unread_folders(case)) {
        warning(&format!(
            "folder '{folder}/' of the case holds recordings and was not read: the parts of a case are reference/, recordings/, \
             heldout/ and simulation/"
        ));
    }
    if let Some(case) = odometry::case(&args.input)? {
        known.refused_for(case.kind().name())?;
        return verdict_of_columns(args, &case, progress);
    }
    let next = (args.next || args.report.is_some()).then_some(NEXT_LENGTH);
    let options = Options {
        next,
        same_robot: args.input.same_robot,
        law: args.law.into(),
        without: args.without,
        known,
        ..Options::default()
    };
    let (case, mapping) = read(&args.input, known)?;
    let diagnosis = case.diagnose(&options, &|what| progress.stage(what))?;
    drop(progress);

    let name = args.input.mapping.as_deref().unwrap_or(&mapping);
    let envelope = Envelope::new(diagnosis, &case, &options, name, args.input.reading.name())?;
    let (diagnosis, lost) = (&envelope.diagnosis, &envelope.lost);
    if let Some(dir) = &args.predictions {
        let cannot = kind::of(case.robot.causality).no_prediction().filter(|_| diagnosis.predictions.is_empty());
        if let Some(why) = cannot {
            warning(why);
        } else if diagnosis.predictions.is_empty() {
            warning(NOTHING_HELD_OUT);
        } else {
            predictions::write(dir, diagnosis)?;
        }
    }
    write_drawings(args, diagnosis, || page(&envelope))?;
    if let Some(target) = &args.json {
        emit_json(target, &serde_json::to_value(&envelope)?)?;
    }
    if args.json.as_deref() != Some("-") {
        // Tables say themselves which column is which signal, and a case folder may hold a mapping of its own.
        let is_named = args.input.mapping.is_some() || which_mapping::own(args.input.case.as_deref()).is_some();
        let found = (!is_named && mapping != which_mapping::SELF_DESCRIBING).then_some(mapping.as_str());
        emit(&diagnosis_text::render(diagnosis, lost, &case.not_used(), found))?;
    }
    Ok(outcome(diagnosis.verdict, args.fail_on, &case.lost_of_recordings()))
}

/// Diagnoses a case whose robot file names its columns.
fn verdict_of_columns(args: &Args, case: &ColumnsCase, progress: Progress) -> Result<Outcome> {
    let next = (args.next || args.report.is_some()).then_some(NEXT_LENGTH);
    let diagnosis = case.diagnose(next, &|what| progress.stage(what))?;
    drop(progress);

    let envelope = case.envelope(diagnosis);
    match &args.predictions {
        Some(_) if envelope.diagnosis.predicted_paths.is_empty() => warning(NOTHING_HELD_OUT),
        Some(dir) => predictions::write_paths(dir, &envelope.diagnosis)?,
        None => {}
    }
    write_drawings(args, &envelope.diagnosis, || page_of_columns(&envelope))?;
    if let Some(target) = &args.json {
        emit_json(target, &serde_json::to_value(&envelope)?)?;
    }
    if args.json.as_deref() != Some("-") {
        emit(&diagnosis_text::render(&envelope.diagnosis, &[], case.ignored(), None))?;
    }
    Ok(outcome(envelope.diagnosis.verdict, args.fail_on, &[]))
}

/// Writes the picture, the page and the MCAP that were asked for.
fn write_drawings(args: &Args, diagnosis: &Diagnosis, page: impl Fn() -> String) -> Result<()> {
    if let Some(file) = &args.picture {
        let svg = ::report::picture::svg(diagnosis)?;
        std::fs::write(file, svg).with_context(|| format!("cannot write '{}'", file.display()))?;
    }
    if let Some(file) = &args.report {
        report::write_page(file, &page())?;
    }
    if let Some(file) = &args.mcap {
        if diagnosis.traces.is_empty() {
            warning("this diagnosis has no recording beside the simulation; the MCAP holds the verdict alone");
        }
        mcap_out::write(file, diagnosis)?;
    }
    Ok(())
}

/// Where the parts of a case are.
pub(crate) struct Located {
    pub(crate) robot: RobotSpec,
    /// References, recordings, held-out drives.
    pub(crate) paths: [Vec<PathBuf>; 3],
    pub(crate) mapping: Mapping,
}

/// What the arguments name, the robot with effects that are known.
pub(crate) fn located(args: &Input, known: KnownEffects) -> Result<Located> {
    let (robot, paths) = match (&args.case, &args.robot) {
        (Some(folder), robot) => case_folder::located(known, folder, robot.as_deref())?,
        (None, Some(robot)) => (
            case_folder::robot_with(known, robot)?,
            [&args.reference, &args.recordings, &args.heldout].map(Clone::clone),
        ),
        (None, None) => bail!("no robot was named; do so with --robot"),
    };
    own_effects::ensure_torque_driven(&robot)?;
    let mapping = which_mapping::of_case(args.mapping.as_deref(), args.case.as_deref(), &paths.concat())?;
    Ok(Located { robot, paths, mapping })
}

/// The case that the arguments name, and the name of the mapping that read it.
pub(crate) fn read(args: &Input, known: KnownEffects) -> Result<(CaseFolder, String)> {
    let (options, budget) = (args.reading.options(), args.budget.map(Budget::of_minutes).unwrap_or_default());
    let Located { robot, paths: [reference, recordings, heldout], mapping } = located(args, known)?;
    let in_folder = args.case.as_deref().map(simulation_of).unwrap_or_default();
    let simulation = [args.simulation.clone(), in_folder].concat();
    let case = CaseFolder::within(budget, robot, [&reference, &recordings, &heldout], &mapping, &options)?
        .with_simulation(&simulation, &mapping, &options)?
        .with_visits(&args.visit)?;
    Ok((case, mapping.name))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mismatch_goes_before_lost_input_and_only_where_it_was_asked_for() {
        let lost = ["a row".to_owned()];
        for verdict in [Verdict::Explained, Verdict::Unknown] {
            assert_eq!(outcome(verdict, Some(FailOn::Mismatch), &lost), Outcome::Mismatch);
            assert_eq!(outcome(verdict, None, &[]), Outcome::Done);
        }
        for verdict in [Verdict::NoMismatch, Verdict::Withheld] {
            assert_eq!(outcome(verdict, Some(FailOn::Mismatch), &[]), Outcome::Done);
            assert_eq!(outcome(verdict, Some(FailOn::Mismatch), &lost), Outcome::InputLost);
        }
    }
}
