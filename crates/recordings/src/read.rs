//! The files of one run become one recording.

use std::collections::BTreeSet;
use std::io::Cursor;

use bags::{Contents, Format, LOG_TIME, Loss, LossKind, Place, ReadSeek, Stored, head, read_whole, refuse_large};

use crate::column::{Column, Keep};
use crate::column_samples::ColumnSamples;
use crate::described::settle;
use crate::error::RecordingError;
use crate::group::parts;
use crate::input::{Input, Opened, Policy, ReadOptions};
use crate::mapping::{FileMapping, Mapping, base_name};
use crate::parquet;
use crate::recording::{Clock, Recording};
use crate::table;
use crate::topics::read_bags;

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

/// A column or topic that was there and that the mapping does not use.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnusedColumn {
    /// The file.
    pub file: String,
    /// The name of the column or topic.
    pub column: String,
}

/// What was read, and what was not.
#[derive(Debug, Clone, PartialEq)]
pub struct Read {
    /// The run.
    pub recording: Recording,
    /// What could not be read.
    pub losses: Vec<Loss>,
    /// The files, in the order of the mapping's entries.
    pub sources: Vec<Source>,
    /// Columns and topics that the mapping does not use: no loss, worth telling.
    pub unused: Vec<UnusedColumn>,
}

/// Reads the files of one run (see [`Mapping::group`]) into a recording named `run`.
///
/// Each CSV or Parquet file has a clock of its own; so have the log times and the header stamps of a bag, unless the
/// mapping says otherwise. A file of the run that is not among `inputs` is a [`LossKind::MissingFile`].
///
/// # Errors
/// When a file fits no pattern or is given twice, is empty, is no text, lacks a column, a topic or a field, or holds
/// what [`ReadOptions::policy`] does not let pass.
pub fn read(mapping: &Mapping, run: &str, inputs: &[Input<'_>], options: &ReadOptions) -> Result<Read, RecordingError> {
    let mut cursors: Vec<Cursor<&[u8]>> = inputs.iter().map(|input| Cursor::new(input.bytes)).collect();
    let mut opened: Vec<Opened<'_>> =
        inputs.iter().zip(&mut cursors).map(|(input, source)| Opened { name: input.name, source }).collect();
    read_from(mapping, run, &mut opened, options)
}

/// As [`read`], from anything that can be read and searched: MCAP files need not fit into memory.
///
/// # Errors
/// As [`read`], and when a source fails.
pub fn read_from(
    mapping: &Mapping,
    run: &str,
    inputs: &mut [Opened<'_>],
    options: &ReadOptions,
) -> Result<Read, RecordingError> {
    let Gathered { clocks, columns, losses, sources, unused, .. } =
        gather(mapping, run, inputs, options.policy, (&ColumnSamples::default(), false))?;
    let channels = columns.into_iter().map(Column::into_channel).collect::<Result<_, _>>()?;
    Ok(Read { recording: Recording::new(run, clocks, channels)?, losses, sources, unused })
}

/// Reads the files of one run, whose samples go to clones of `keep`. With `look_inside` the same pass tells what is
/// inside bags.
pub(crate) fn gather<'a, K: Keep>(
    mapping: &Mapping,
    run: &str,
    inputs: &mut [Opened<'a>],
    policy: Policy,
    (keep, look_inside): (&K, bool),
) -> Result<Gathered<K::Kept>, RecordingError> {
    let mut by_entry: Vec<Vec<&mut Opened<'a>>> = mapping.files.iter().map(|_| Vec::new()).collect();
    let mut first: Option<(usize, &str, &str)> = None;
    for input in inputs {
        let (entry, id) = mapping.entry_of(input.name).ok_or_else(|| RecordingError::UnmatchedFile {
            file: input.name.to_owned(),
            mapping: mapping.name.clone(),
            patterns: mapping.patterns(),
        })?;
        let twice = by_entry[entry].iter().any(|other| other.name == input.name);
        if twice || (mapping.files[entry].topic.is_none() && !by_entry[entry].is_empty()) {
            let pattern = mapping.files[entry].pattern.clone();
            return Err(RecordingError::FileTwice { file: input.name.to_owned(), pattern });
        }
        first = first.filter(|&(other, ..)| other <= entry).or(Some((entry, input.name, id)));
        by_entry[entry].push(input);
    }
    let Some((_, name, id)) = first else {
        return Err(RecordingError::NoFiles { run: run.to_owned() });
    };
    let folder = &name[..name.len() - base_name(name).len()];

    let mut gathering = Gathering { mapping, policy, keep, look_inside, so_far: Gathered::default() };
    for (entry, mut files) in by_entry.into_iter().enumerate().filter(|(entry, _)| mapping.leads(*entry)) {
        files.sort_by_key(|file| parts(file.name));
        match (&mut files[..], &mapping.files[entry].topic) {
            ([], _) if mapping.alternatives() => {}
            ([], _) => {
                let file = format!("{folder}{}", mapping.files[entry].file_of(id));
                let kind = LossKind::MissingFile;
                let loss = Loss { kind, file, column: None, place: Place::Line, lines: Vec::new(), count: 1 };
                gathering.so_far.losses.push(loss);
            }
            (files, Some(_)) => gathering.bags(entry, files)?,
            ([file, ..], None) => gathering.table(entry, file)?,
        }
    }
    Ok(gathering.so_far)
}

/// What the files of a run hold.
pub(crate) struct Gathered<K> {
    pub(crate) clocks: Vec<Clock>,
    pub(crate) columns: Vec<Column<K>>,
    pub(crate) losses: Vec<Loss>,
    pub(crate) sources: Vec<Source>,
    pub(crate) unused: Vec<UnusedColumn>,
    /// What is inside bags, with their names.
    pub(crate) contents: Vec<(String, Contents)>,
}

impl<K> Default for Gathered<K> {
    fn default() -> Self {
        let (clocks, columns, contents) = (Vec::new(), Vec::new(), Vec::new());
        Self { clocks, columns, losses: Vec::new(), sources: Vec::new(), unused: Vec::new(), contents }
    }
}

/// How a run is read, and what has been so far.
struct Gathering<'m, K: Keep> {
    mapping: &'m Mapping,
    policy: Policy,
    keep: &'m K,
    look_inside: bool,
    so_far: Gathered<K::Kept>,
}

impl<K: Keep> Gathering<'_, K> {
    /// Reads a file that is one table: CSV or Parquet.
    fn table(&mut self, entry: usize, input: &mut Opened<'_>) -> Result<(), RecordingError> {
        let so_far = &mut self.so_far;
        let (name, file, clock) = (input.name, &self.mapping.files[entry], so_far.clocks.len());
        let (keep, mapping) = ((self.keep, self.policy), &self.mapping.name);
        let own_clock = Clock { name: name.to_owned(), nominal_rate_hz: file.time.rate_hz };
        let stored = Stored::of(name, &head(name, &mut *input.source)?);
        let mut whole = match stored {
            Stored::As(Format::Parquet) | Stored::Compressed => {
                Some(read_whole(name, &mut *input.source)?.unbroken(name)?)
            }
            Stored::As(Format::Csv | Format::Mcap | Format::Sqlite) => None,
        };
        let (unused, bytes, sha256) = match whole.take() {
            Some(whole) if Stored::of(name, &whole.bytes) == Stored::As(Format::Parquet) => {
                let table = parquet::read_rows(keep, name, whole.bytes, file, mapping, clock, &mut so_far.losses)?;
                if file.self_describing {
                    let described = parquet::described(table.columns, &table.about);
                    so_far.columns.extend(settle(name, described, &mut so_far.clocks));
                } else {
                    so_far.columns.extend(table.columns);
                    so_far.clocks.push(own_clock);
                }
                (table.unused, whole.file_bytes, whole.sha256)
            }
            packed => {
                if K::HOLDS_ALL && packed.is_none() {
                    refuse_large(name, &mut *input.source)?;
                }
                let mut unpacked = packed.map(|whole| (Cursor::new(whole.bytes), whole.file_bytes, whole.sha256));
                let source: &mut dyn ReadSeek = match &mut unpacked {
                    Some((bytes, ..)) => bytes,
                    None => &mut *input.source,
                };
                let table = table::read_rows(keep, (name, source), (file, mapping), clock, &mut so_far.losses)?;
                so_far.columns.extend(table.columns);
                so_far.clocks.push(own_clock);
                let (bytes, sha256) =
                    unpacked.map_or((table.bytes, table.sha256), |(_, bytes, sha256)| (bytes, sha256));
                (table.unused, bytes, sha256)
            }
        };
        so_far.unused.extend(unused.into_iter().map(|column| UnusedColumn { file: name.to_owned(), column }));
        so_far.sources.push(Source { name: name.to_owned(), bytes: bytes as usize, sha256 });
        Ok(())
    }

    /// Reads the parts of a bag for all entries with the pattern of entry `first`.
    fn bags(&mut self, first: usize, parts: &mut [&mut Opened<'_>]) -> Result<(), RecordingError> {
        let pattern = &self.mapping.files[first].pattern;
        let entries: Vec<&FileMapping> = self.mapping.files.iter().filter(|file| file.pattern == *pattern).collect();
        let names: Vec<&str> = parts.iter().map(|part| part.name).collect();
        self.so_far.losses.extend(missing_parts(&names, &self.mapping.files[first]));
        let describing = self.mapping.files[first].self_describing;
        let clock = |entry: &&FileMapping| if describing { 0 } else { self.clock(names[0], entry) };
        let clocks: Vec<usize> = entries.iter().map(clock).collect();
        let keeping = (self.keep, self.look_inside);
        let bags = read_bags(keeping, &self.mapping.name, parts, &entries, &clocks, self.policy)?;
        let so_far = &mut self.so_far;
        let columns = bags.columns.into_iter().flatten();
        if describing {
            so_far.columns.extend(settle(names[0], columns.collect(), &mut so_far.clocks));
        } else {
            so_far.columns.extend(columns.map(|(column, _)| column));
        }
        so_far.contents.extend(names.iter().map(|&name| name.to_owned()).zip(bags.contents));
        let wanted = |topic: &str| entries.iter().any(|entry| entry.topic.as_deref() == Some(topic));
        for (name, part) in names.iter().map(|&name| name.to_owned()).zip(bags.parts) {
            for topic in part.topics.into_iter().filter(|topic| !wanted(&topic.name)) {
                so_far.unused.push(UnusedColumn { file: name.clone(), column: topic.name });
            }
            so_far.losses.extend(part.losses);
            so_far.sources.push(Source { name, bytes: part.bytes as usize, sha256: part.sha256 });
        }
        so_far.losses.extend(bags.losses);
        Ok(())
    }

    /// The clock of a topic: the one that the mapping names, or that of the bag's log times or stamps.
    fn clock(&mut self, bag: &str, entry: &FileMapping) -> usize {
        let log = entry.time.column.as_deref() == Some(LOG_TIME);
        let name = match &entry.clock {
            Some(clock) => format!("{bag} {clock}"),
            None if log => format!("{bag} log"),
            None => format!("{bag} stamps"),
        };
        let (rate, clocks) = (entry.time.rate_hz, &mut self.so_far.clocks);
        if let Some(index) = clocks.iter().position(|clock| clock.name == name) {
            let clock = &mut clocks[index];
            clock.nominal_rate_hz = clock.nominal_rate_hz.filter(|&other| Some(other) == rate);
            return index;
        }
        clocks.push(Clock { name, nominal_rate_hz: rate });
        clocks.len() - 1
    }
}

/// The numbers that are left out between the parts of a split bag.
fn missing_parts(names: &[&str], entry: &FileMapping) -> Vec<Loss> {
    let number = |name: &str| -> Option<u32> {
        let (id, whole) = (entry.run_id(name)?, entry.whole_run_id(name)?);
        id.strip_prefix(whole)?.strip_prefix('_')?.parse().ok()
    };
    let numbers: BTreeSet<u32> = names.iter().filter_map(|name| number(name)).collect();
    let Some(&last) = numbers.last() else { return Vec::new() };
    let count = (last as usize + 1).saturating_sub(numbers.len());
    let Some(lost) = (0..=last).find(|number| !numbers.contains(number)) else { return Vec::new() };
    let folder = &names[0][..names[0].len() - base_name(names[0]).len()];
    let id = entry.whole_run_id(names[0]).unwrap_or_default();
    let file = format!("{folder}{}", entry.file_of(&format!("{id}_{lost}")));
    let kind = LossKind::MissingFile;
    vec![Loss { kind, file, column: None, place: Place::Line, lines: Vec::new(), count }]
}
