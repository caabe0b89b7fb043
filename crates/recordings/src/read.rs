//! The files of one run become one recording.

use sha2::{Digest, Sha256};

use crate::error::RecordingError;
use crate::header::Header;
use crate::loss::{Ledger, Loss, LossKind};
use crate::mapping::{Mapping, base_name};
use crate::recording::{Clock, Recording};
use crate::table::read_rows;

/// A file as the caller gives it: its name and its bytes.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// Name or path; its last part is matched against the mapping's patterns.
    pub name: &'a str,
    /// Contents.
    pub bytes: &'a [u8],
}

/// What to do with input that is not as it should be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Policy {
    /// Everything that would be a loss inside a file is an error.
    Strict,
    /// Skip rows with a wrong field count, an empty time or a repeated stamp and count them; refuse text in numbers,
    /// numbers that are not finite, a negative magnitude and time running backwards.
    #[default]
    Normal,
    /// Skip and count all of these; only what leaves nothing to read is an error.
    Tolerant,
}

/// How to read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ReadOptions {
    /// What to do with bad rows and cells.
    pub policy: Policy,
}

/// A file that went into a recording.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Source {
    /// Its name as given.
    pub name: String,
    /// Its length in bytes.
    pub bytes: usize,
    /// SHA-256 of its bytes, 64 hexadecimal digits.
    pub sha256: String,
}

/// A column that was there and that the mapping does not use.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnusedColumn {
    /// The file.
    pub file: String,
    /// The column's name.
    pub column: String,
}

/// What was read, and what was not.
#[derive(Debug, Clone, PartialEq)]
pub struct Read {
    /// The run.
    pub recording: Recording,
    /// What could not be read.
    pub losses: Vec<Loss>,
    /// The files, in the order of the mapping's entries; `sources[i]` carries clock `i` of the recording.
    pub sources: Vec<Source>,
    /// Columns that the mapping does not use: no loss, worth telling.
    pub unused: Vec<UnusedColumn>,
}

/// Reads the files of one run (see [`Mapping::group`]) into a recording named `run`.
///
/// Each file has a clock of its own. A file of the run that is not among `inputs` is a [`LossKind::MissingFile`].
///
/// # Errors
/// When a file fits no pattern or is given twice, is empty, is no text, lacks a column, or holds what
/// [`ReadOptions::policy`] does not let pass.
pub fn read(mapping: &Mapping, run: &str, inputs: &[Input<'_>], options: &ReadOptions) -> Result<Read, RecordingError> {
    let mut by_entry: Vec<Option<(&Input<'_>, &str)>> = vec![None; mapping.files.len()];
    for input in inputs {
        let (entry, id) = mapping.entry_of(input.name).ok_or_else(|| RecordingError::UnmatchedFile {
            file: input.name.to_owned(),
            mapping: mapping.name.clone(),
            patterns: mapping.patterns(),
        })?;
        if by_entry[entry].replace((input, id)).is_some() {
            let pattern = mapping.files[entry].pattern.clone();
            return Err(RecordingError::FileTwice { file: input.name.to_owned(), pattern });
        }
    }
    let Some((first, id)) = by_entry.iter().flatten().next().copied() else {
        return Err(RecordingError::NoFiles { run: run.to_owned() });
    };
    let folder = &first.name[..first.name.len() - base_name(first.name).len()];

    let (mut clocks, mut channels) = (Vec::new(), Vec::new());
    let (mut losses, mut sources, mut unused) = (Vec::new(), Vec::new(), Vec::new());
    for (file, slot) in mapping.files.iter().zip(&by_entry) {
        let Some((input, _)) = slot else {
            let file = format!("{folder}{}", file.file_of(id));
            losses.push(Loss { kind: LossKind::MissingFile, file, column: None, lines: Vec::new(), count: 1 });
            continue;
        };
        let header = Header::find(input, file, &mapping.name)?;
        let mut ledger = Ledger::new(input.name);
        channels.extend(read_rows(input, file, &header, clocks.len(), options.policy, &mut ledger)?);
        losses.extend(ledger.into_losses());
        let name = input.name.to_owned();
        clocks.push(Clock { name: name.clone(), nominal_rate_hz: file.time.rate_hz });
        unused.extend(header.unused.into_iter().map(|column| UnusedColumn { file: name.clone(), column }));
        sources.push(Source { name, bytes: input.bytes.len(), sha256: sha256(input.bytes) });
    }
    Ok(Read { recording: Recording::new(run, clocks, channels)?, losses, sources, unused })
}

/// The SHA-256 of bytes as hexadecimal digits.
fn sha256(bytes: &[u8]) -> String {
    use std::fmt::Write as _;
    let mut text = String::with_capacity(64);
    for byte in Sha256::digest(bytes) {
        // Writing to a string cannot fail.
        let _ = write!(text, "{byte:02x}");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sha256_is_that_of_fips_180() {
        assert_eq!(sha256(b"abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    }
}
