//! `lacuna next`: which drive would tell the remaining causes apart best.

use pages::text_table::TextTable;
use pages::text_table::number;
use recordings::suggest::nearest;
use std::path::PathBuf;

use anyhow::{Context, Result, bail};
use case_files::envelope::Program;
use clap::Args as ClapArgs;
use inference::Options;
use robot_file::Causality;
use robot_model::Robot;
use serde_json::json;
use verdict::{Advice, Diagnosis, Manoeuvre, wheel_speeds};

use super::diagnose::{self, Input, NEXT_LENGTH};
use super::{Outcome, OwnEffects, Usage, listed, odometry};
use crate::console::{Progress, emit, emit_json, heading};

const EXAMPLES: &str = "\
Examples:
  lacuna next case/
  lacuna next case/ --profile drive.csv --picture drive.svg
  lacuna next case/ --manoeuvre 'fast spins, both ways' --profile spins.csv

The case is diagnosed first, as by `lacuna diagnose`. The profile has time,
wanted speed and yaw rate, wheel speeds, and whether the drives get no torque
(coasting); of robots whose files name their columns, the speeds of the body:
ahead, to the left, and turning. Record it, add it to the recordings, and
diagnose again.

Exit codes: 0 done, 1 failed, 2 wrong usage, 3 done but some input was lost.";

const USAGE: &str = "\
lacuna next [OPTIONS] <CASE>
       lacuna next [OPTIONS] --robot <NAME|FILE>
                   [--reference <PATH>...] --recordings <PATH>...";

/// Rows of a profile per second.
const RATE: f64 = 50.0;
/// Drives that the text shows.
const SHOWN: usize = 12;

/// Arguments of `lacuna next`.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES, override_usage = USAGE)]
pub(crate) struct Args {
    #[command(flatten)]
    input: Input,
    /// Length of the drives to choose from (of speed-driven robots it follows from the levels), 4 to 120 s.
    #[arg(long, value_name = "S", default_value_t = NEXT_LENGTH, value_parser = seconds)]
    seconds: f64,
    /// Write the best drive's profile as CSV, or that of --manoeuvre.
    #[arg(long, value_name = "FILE.csv")]
    profile: Option<PathBuf>,
    /// Name of the drive whose profile and picture are wanted, as in the table [default: the best that can be added to
    /// the recordings].
    #[arg(long, value_name = "NAME")]
    manoeuvre: Option<String>,
    /// Draw the profile and the expected bits of all drives as SVG.
    #[arg(long, value_name = "FILE.svg")]
    picture: Option<PathBuf>,
    #[command(flatten)]
    effects: OwnEffects,
    /// Write the advice as JSON to a file; `-` is standard output, instead of the text.
    #[arg(long, value_name = "FILE|-")]
    json: Option<String>,
}

/// Advises on the next drive of a case.
pub(crate) fn run(args: &Args, verbose: bool) -> Result<Outcome> {
    let known = args.effects.known()?;
    let progress = Progress::new(verbose);
    progress.stage("reading the recordings");
    if let Some(case) = odometry::case(&args.input)? {
        known.refused_for(case.kind().name())?;
        let diagnosis = case.diagnose(Some(args.seconds), &|what| progress.stage(what))?;
        drop(progress);
        return write(args, (case.robot_name(), &[]), &diagnosis, twists);
    }
    let (case, _) = diagnose::read(&args.input, known)?;
    let options = Options { next: Some(args.seconds), same_robot: args.input.same_robot, known, ..Options::default() };
    let diagnosis = case.diagnose(&options, &|what| progress.stage(what))?;
    drop(progress);
    let by_wheels = |wanted: &Manoeuvre| profile(wanted, &case.robot.robot, case.robot.causality);
    write(args, (&case.robot.name, &case.lost()), &diagnosis, by_wheels)
}

/// Writes the advice of a diagnosis, of a robot and with what was lost of its input.
fn write(
    args: &Args,
    (robot, lost): (&str, &[String]),
    diagnosis: &Diagnosis,
    profile: impl Fn(&Manoeuvre) -> String,
) -> Result<Outcome> {
    let Some(advice) = &diagnosis.next else {
        bail!("this diagnosis came without advice");
    };
    let wanted = chosen(advice, args.manoeuvre.as_deref())?;
    if let Some(file) = &args.profile {
        let Some(wanted) = wanted else { bail!("there is no drive to write: {}", withheld(advice)) };
        std::fs::write(file, profile(wanted)).with_context(|| format!("cannot write '{}'", file.display()))?;
    }
    if let Some(file) = &args.picture {
        let Some(wanted) = wanted else { bail!("there is no drive to draw: {}", withheld(advice)) };
        let svg = report::manoeuvre::svg(advice, wanted)?;
        std::fs::write(file, svg).with_context(|| format!("cannot write '{}'", file.display()))?;
    }
    if let Some(target) = &args.json {
        let whole = json!({ "format": 1, "program": Program::default(), "robot": robot, "lost": lost, "next": advice });
        emit_json(target, &whole)?;
    }
    if args.json.as_deref() != Some("-") {
        emit(&text(advice, wanted, diagnosis.sentences.first(), lost))?;
    }
    Ok(Outcome::of(lost))
}

fn seconds(text: &str) -> Result<f64, String> {
    let given: f64 = text.parse().map_err(|_| format!("'{text}' is no number of seconds"))?;
    if (4.0..=120.0).contains(&given) { Ok(given) } else { Err("give between 4 and 120 s".to_owned()) }
}

fn withheld(advice: &Advice) -> &str {
    advice.withheld.as_deref().unwrap_or("no drive can be suggested")
}

/// The drive that was asked for, or the best.
fn chosen<'a>(advice: &'a Advice, name: Option<&str>) -> Result<Option<&'a Manoeuvre>> {
    let Some(name) = name else { return Ok(advice.best()) };
    if let Some(found) = advice.manoeuvres.iter().find(|m| m.name == name) {
        return Ok(Some(found));
    }
    let near = nearest(name, advice.manoeuvres.iter().map(|m| m.name.as_str()));
    let near = near.map_or(String::new(), |n| format!("; did you mean '{n}'?"));
    bail!(Usage(format!("there is no drive '{name}' among those suggested for this case{near}")))
}

/// The profile as CSV, rows at equal times.
///
/// Wheels of a skid-steered body turn it less than rolling ones; those of a command-driven robot get the commands that
/// its simulation takes for the wanted twist.
fn profile(m: &Manoeuvre, robot: &Robot<f64>, causality: Causality) -> String {
    let commanded = causality == Causality::CommandDriven;
    let lever = if commanded { robot.half_track } else { robot.turning_lever() };
    let mut out = "t_s,v_m_s,omega_rad_s,wheel_speed_left_rad_s,wheel_speed_right_rad_s,torque_free\n".to_owned();
    for k in 0..=(m.length() * RATE).round() as usize {
        let t = k as f64 / RATE;
        let wanted = m.wanted(t);
        let [left, right] = wheel_speeds(wanted, robot.wheel_radius, lever);
        let free = u8::from(m.is_torque_free(t));
        out += &format!("{t:.2},{:.4},{:.4},{left:.4},{right:.4},{free}\n", wanted[0], wanted[1]);
    }
    out
}

/// The same of a robot that names its columns, whose wheels stand as they please: what its body is to do.
fn twists(m: &Manoeuvre) -> String {
    let mut out = "t_s,v_ahead_m_s,v_left_m_s,omega_rad_s\n".to_owned();
    for k in 0..=(m.length() * RATE).round() as usize {
        let t = k as f64 / RATE;
        let [ahead, left, turning] = m.wanted_twist(t);
        out += &format!("{t:.2},{ahead:.4},{left:.4},{turning:.4}\n");
    }
    out
}

fn text(advice: &Advice, wanted: Option<&Manoeuvre>, verdict: Option<&String>, lost: &[String]) -> String {
    let mut out = verdict.map_or(String::new(), |v| heading(v));
    if let Some(reason) = &advice.withheld {
        out += &format!("No further drive would help to decide: {reason}.\n");
    }
    out += &rivals(advice);
    out += &drives(advice);
    if let Some(m) = wanted {
        out += &format!("\n{}", heading(&format!("Next: {}", m.name)));
        out += &format!("{}\n", m.why);
        let [x, y, yaw] = m.start;
        // Of drives that may begin anywhere no place is told.
        out += &match m.start {
            [0.0, 0.0, 0.0] => format!("Begin anywhere; {:.0} s.\n", m.length()),
            _ => format!(
                "Begin at x {x:.2} m, y {y:.2} m, heading {:.0} degrees; {:.0} s.\n",
                yaw.to_degrees(),
                m.length()
            ),
        };
    }
    out += &listed("What limits this advice", &advice.limits);
    out += &listed("Lost input", lost);
    out
}

fn rivals(advice: &Advice) -> String {
    if advice.rivals.is_empty() {
        return String::new();
    }
    let mut table = TextTable::new(&["answer", ">probability"]);
    for r in &advice.rivals {
        table.row([r.name.clone(), format!("{:.2}", r.probability)]);
    }
    let title = format!("Answers still possible (uncertainty {:.2} bit)", advice.entropy_bits);
    format!("\n{}{}", heading(&title), table.render())
}

fn drives(advice: &Advice) -> String {
    if advice.manoeuvres.is_empty() {
        return String::new();
    }
    let mut table = TextTable::new(&["drive", ">expected bits", ">uncertainty of the size", "tells apart best"]);
    for m in advice.manoeuvres.iter().take(SHOWN) {
        let splits = m.splits.as_ref().map_or(String::new(), |[a, b]| format!("{a} | {b}"));
        let narrows = m.narrows.map_or(String::new(), |n| format!("x {}", number(n)));
        let name = if m.joins { m.name.clone() } else { format!("{} (*)", m.name) };
        table.row([name, format!("{:.2}", m.expected_bits), narrows, splits]);
    }
    let mut out = format!("\n{}{}", heading("Drives, the best first"), table.render());
    if advice.manoeuvres.iter().take(SHOWN).any(|m| !m.joins) {
        out += "  (*) cannot be added to these recordings: the robot is changed for it\n";
    }
    let more = advice.manoeuvres.len().saturating_sub(SHOWN);
    if more > 0 {
        out += &format!("  and {more} more, in the JSON\n");
    }
    out
}
