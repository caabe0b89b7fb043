//! `lacuna convert`: a recording in another format.

use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};
use case_files::envelope::Program;
use clap::Args as ClapArgs;
use recordings::{Recording, lost_in_csv, write_csv, write_mcap, write_parquet};
use serde_json::json;

use super::{Outcome, Reader, Usage, listed, only, sources};
use crate::console::{emit, emit_json, warning};

const EXAMPLES: &str = "\
Examples:
  lacuna convert walk/ --mapping kobuki-bag --out walk.parquet
  lacuna convert run_1.csv --out run_1.mcap
  lacuna convert pro_01.csv imu_01.csv --mapping husky-open --out run.csv

The ending of OUT says the format: mcap (JSON messages, one topic per signal,
all clocks in one file), parquet or csv (a table per clock; with several clocks
their names stand before the ending). Values are in SI and read back bit for
bit, by the built-in mapping lacuna; MCAP and Parquet keep what the mapping said
of signals and clocks, CSV cannot.

Exit codes: 0 done, 1 failed, 2 wrong usage, 3 done but some input was lost.";

/// Version of the JSON.
const FORMAT: u32 = 1;

/// Arguments of `lacuna convert`.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// Files or the folder of one recording.
    #[arg(required = true, num_args = 1..)]
    recording: Vec<PathBuf>,
    #[command(flatten)]
    reader: Reader,
    /// File to write: .mcap, .parquet or .csv.
    #[arg(short, long, value_name = "FILE")]
    out: PathBuf,
    /// Write over a file that is there.
    #[arg(long)]
    force: bool,
    /// Write what was written as JSON to a file; `-` is standard output, instead of the text.
    #[arg(long, value_name = "FILE|-")]
    json: Option<String>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Format {
    Mcap,
    Parquet,
    Csv,
}

/// The format that an ending means.
fn format(out: &Path) -> Result<Format> {
    let ending = out.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase();
    Ok(match ending.as_str() {
        "mcap" => Format::Mcap,
        "parquet" => Format::Parquet,
        "csv" => Format::Csv,
        _ => bail!(Usage(format!("'{}' must end in .mcap, .parquet or .csv, which says the format", out.display()))),
    })
}

/// The files to write and the clock of each; a single file for all clocks of an MCAP.
fn targets(recording: &Recording, out: &Path, format: Format) -> Vec<(PathBuf, usize)> {
    let used: Vec<usize> = (0..recording.clocks().len()).filter(|c| recording.span_ns(*c).is_some()).collect();
    if format == Format::Mcap || used.len() < 2 {
        return vec![(out.to_owned(), used.first().copied().unwrap_or(0))];
    }
    let ending = out.extension().unwrap_or_default().to_string_lossy().into_owned();
    let plain = |name: &str| -> String {
        let last = name.rsplit(['/', '\\']).next().unwrap_or_default();
        last.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect()
    };
    let mut names: Vec<String> = used.iter().map(|c| plain(&recording.clocks()[*c].name)).collect();
    for i in 0..names.len() {
        // Two clocks of the same name would be written over each other.
        if names.iter().filter(|n| **n == names[i]).count() > 1 {
            names[i] = format!("{}_{i}", names[i]);
        }
    }
    let file = |name: String| out.with_extension(format!("{name}.{ending}"));
    names.into_iter().map(file).zip(used).collect()
}

fn write(recording: &Recording, format: Format, clock: usize, path: &Path) -> Result<()> {
    let cannot = || format!("cannot write '{}'", path.display());
    let mut sink = BufWriter::new(File::create(path).with_context(cannot)?);
    match format {
        Format::Mcap => write_mcap(recording, &mut sink),
        Format::Parquet => write_parquet(recording, clock, &mut sink),
        Format::Csv => sink.write_all(write_csv(recording, clock).as_bytes()),
    }
    .and_then(|()| sink.flush())
    .with_context(cannot)
}

/// Converts a recording.
pub(crate) fn run(args: &Args) -> Result<Outcome> {
    let format = format(&args.out)?;
    let (loaded, mapping) = args.reader.load(&args.recording)?;
    let read = only(&loaded)?;
    let recording = &read.recording;
    let targets = targets(recording, &args.out, format);
    for (path, _) in &targets {
        ensure!(args.force || !path.exists(), "'{}' is there already; --force writes over it", path.display());
    }
    for (path, clock) in &targets {
        if let Err(error) = write(recording, format, *clock, path) {
            // Half a file would be taken for a whole one.
            let _ = fs::remove_file(path);
            return Err(error);
        }
    }
    let samples: usize = recording.channels().iter().map(recordings::Channel::len).sum();
    let written: Vec<String> = targets.iter().map(|(path, _)| path.display().to_string()).collect();
    let channels = recording.channels().len();
    let not_kept = if format == Format::Csv { lost_in_csv(recording) } else { Vec::new() };
    let lost: Vec<String> = loaded.lost().collect();
    if let Some(target) = &args.json {
        let told = json!({
            "format": FORMAT, "program": Program::default(), "recording": recording.name(), "mapping": mapping.name,
            "sources": sources(&loaded.sources), "written": written, "channels": channels, "samples": samples,
            "not_kept": not_kept, "lost": lost,
        });
        emit_json(target, &told)?;
    }
    if args.json.as_deref() != Some("-") {
        emit(&format!("{channels} channels with {samples} samples written to {}\n", written.join(", ")))?;
        emit(&listed("Not kept by CSV, so that a mapping has to say it anew", &not_kept))?;
    }
    for sentence in &lost {
        warning(sentence);
    }
    Ok(Outcome::of(&lost))
}
