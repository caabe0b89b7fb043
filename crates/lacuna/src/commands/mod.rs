//! The commands, one file each.

use std::path::PathBuf;

pub(crate) use ::report::sections::listed;
use anyhow::{Result, bail};
use case_files::case_folder::file_names;
use case_files::envelope::SourceFile;
use case_files::inputs::Loaded;
use case_files::{inputs, own_effects, which_mapping};
use clap::{Args as ClapArgs, ValueEnum};
use inference::KnownEffects;
use recordings::{Mapping, Policy, Read, ReadOptions, Source};

pub(crate) mod batch;
pub(crate) mod check;
pub(crate) mod completions;
pub(crate) mod convert;
pub(crate) mod diagnose;
pub(crate) mod effects;
pub(crate) mod explain;
pub(crate) mod export;
pub(crate) mod identify;
pub(crate) mod law;
pub(crate) mod man;
pub(crate) mod merge;
pub(crate) mod next;
mod odometry;
mod overview;
pub(crate) mod paths;
pub(crate) mod predict;
pub(crate) mod rehearse;
pub(crate) mod report;
pub(crate) mod robot;
pub(crate) mod screen;
pub(crate) mod simulate;

/// How a command that did not fail ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// All input was used.
    Done,
    /// Done, but some input was lost.
    InputLost,
    /// Done, and a mismatch was found by a caller who asked to be told; says more than lost input.
    Mismatch,
}

impl Outcome {
    /// By what was lost.
    pub(crate) fn of(lost: &[String]) -> Self {
        if lost.is_empty() { Self::Done } else { Self::InputLost }
    }
}

/// Arguments that make no sense: exit code 2, as for those that clap refuses.
#[derive(Debug)]
pub(crate) struct Usage(pub(crate) String);

impl std::fmt::Display for Usage {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Usage {}

/// What to do with bad rows and cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub(crate) enum Reading {
    /// Refuse everything that would be lost inside a file.
    Strict,
    /// Skip and count broken rows, sort rows that are late; refuse text in numbers and time running backwards.
    #[default]
    Normal,
    /// Skip and count these too.
    Tolerant,
}

impl Reading {
    /// As `recordings` takes it.
    pub(crate) fn options(self) -> ReadOptions {
        let policy = match self {
            Self::Strict => Policy::Strict,
            Self::Normal => Policy::Normal,
            Self::Tolerant => Policy::Tolerant,
        };
        ReadOptions { policy }
    }

    /// As on the command line.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Strict => "strict",
            Self::Normal => "normal",
            Self::Tolerant => "tolerant",
        }
    }
}

/// Laws that the simulation is given.
#[derive(Debug, ClapArgs)]
pub(crate) struct Adopted {
    /// Law files that become part of the simulation at their numbers, of references and recordings alike: what your simulation
    /// lacks in every drive (torque-driven robots).
    #[arg(long, value_name = "LAW.toml", value_delimiter = ',')]
    pub(crate) adopt: Vec<PathBuf>,
}

/// Effects of one's own.
#[derive(Debug, ClapArgs)]
pub(crate) struct OwnEffects {
    /// Law files, as `lacuna law --save` writes them: each is an effect of your own beside those of the catalogue, under
    /// the name that it gives (torque-driven robots).
    #[arg(long = "effects", value_name = "LAW.toml", value_delimiter = ',')]
    files: Vec<PathBuf>,
    #[command(flatten)]
    adopted: Adopted,
}

impl OwnEffects {
    /// The catalogue with these.
    pub(crate) fn known(&self) -> Result<KnownEffects> {
        own_effects::read(&self.files, &self.adopted.adopt)
    }

    /// Whether there are any.
    pub(crate) fn is_any(&self) -> bool {
        !self.files.is_empty() || !self.adopted.adopt.is_empty()
    }
}

/// How recordings are read.
#[derive(Debug, ClapArgs)]
pub(crate) struct Reader {
    /// Mapping file (column -> signal, unit, sign), or name of a built-in mapping [default: skid-steer-columns for tables;
    /// for bags the built-in one that fits].
    #[arg(long, value_name = "NAME|FILE")]
    mapping: Option<String>,
    /// What to do with bad rows and cells of recordings.
    #[arg(long, value_enum, default_value_t)]
    reading: Reading,
}

impl Reader {
    /// Reads files or folders; beside them the mapping that did.
    pub(crate) fn load(&self, paths: &[PathBuf]) -> Result<(Loaded, Mapping)> {
        let mapping = which_mapping::named_or_built_in(self.mapping.as_deref(), paths)?;
        Ok((inputs::load(&mapping, paths, &self.reading.options())?, mapping))
    }
}

/// The recording, when it is the only one.
pub(crate) fn only(loaded: &Loaded) -> Result<&Read> {
    let [read] = loaded.reads.as_slice() else {
        let names: Vec<String> = loaded.reads.iter().map(file_names).collect();
        bail!("give one recording at a time, not {}: {}", names.len(), names.join(", "));
    };
    Ok(read)
}

/// Files with their SHA-256.
pub(crate) fn sources(sources: &[Source]) -> Vec<SourceFile> {
    sources.iter().map(SourceFile::from).collect()
}
