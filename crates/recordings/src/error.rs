//! The crate's one error type.

use bags::{FileError, Place};

use crate::signal::Signal;
use crate::spot::Spot;
use crate::units::Unit;

/// Why a mapping, a file or a channel was refused. Each sentence says what, where and what to do.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)] // the sentences are the documentation of the fields
pub enum RecordingError {
    /// Nothing in the file, or blanks only.
    #[error("{file}: the file is empty; give a CSV file with a header line and rows")]
    EmptyFile { file: String },

    /// A header line and nothing after it.
    #[error("{file}: line {line} is a header but no row follows it; was the recording cut off?")]
    NoRows { file: String, line: u64 },

    /// Bytes that are no UTF-8 text.
    #[error("{file}: line {line}: the header is not UTF-8 text; save the file as CSV in UTF-8")]
    NotText { file: String, line: u64 },

    /// A column that the mapping asks for.
    #[error("{file}: line {line}: no column `{column}` (needed for {key}); {hint}")]
    MissingColumn { file: String, line: u64, column: String, key: String, hint: String },

    /// A mapped column name that occurs twice in the header.
    #[error(
        "{file}: line {line}: column `{column}` occurs more than once; rename one so that it is clear which is meant"
    )]
    DuplicateColumn { file: String, line: u64, column: String },

    /// A unit in the header that contradicts the mapping.
    #[error("{file}: line {line}: column `{column}` says {stated}, the mapping another unit; correct the mapping")]
    HeaderUnit { file: String, line: u64, column: String, stated: String },

    /// None of the optional columns is there.
    #[error("{file}: line {line}: none of the columns of mapping {mapping} is here; {hint}")]
    NoSignals { file: String, line: u64, mapping: String, hint: String },

    /// Rows, but not one sample that could be used.
    #[error("{file}: not one sample could be read ({losses}); check the file and the columns of the mapping")]
    NoSamples { file: String, losses: String },

    /// Too many or too few fields (strict reading).
    #[error("{file}: line {line}: {found} fields where the header has {expected}; repair or delete the line")]
    WrongFieldCount { file: String, line: u64, found: usize, expected: usize },

    /// A row with an empty time cell (strict reading).
    #[error("{file}: {place} {line}, column {column}: the time is empty; give it or delete the line")]
    NoTime { file: String, place: Place, line: u64, column: String },

    /// Header stamps that the driver left at 0: all, or one in strict reading.
    #[error(
        "{file}: topic `{topic}`: header.stamp is 0 in {messages}: the driver does not set it; \
         use time = {{ column = \"log_time\" }} in the mapping"
    )]
    UnsetStamp { file: String, topic: String, messages: String },

    /// Text where a number is expected.
    #[error(
        "{file}: {place} {line}, column {column}: `{text}` is not a number; \
         correct it, leave the cell empty, or read in tolerant mode (`--reading tolerant`) to skip it"
    )]
    NotANumber { file: String, place: Place, line: u64, column: String, text: String },

    /// NaN, infinity, or too large for the arithmetic.
    #[error(
        "{file}: {place} {line}, column {column}: `{text}` is not a finite number in range; \
         a missing sample is an empty cell (or read in tolerant mode (`--reading tolerant`) to skip it)"
    )]
    NotFinite { file: String, place: Place, line: u64, column: String, text: String },

    /// A negative number in a column that the mapping declares to be without sign.
    #[error(
        "{file}: {place} {line}, column {column}: {text} is negative, but the mapping says magnitude_only; \
         correct the mapping (magnitude_only = false)"
    )]
    NegativeMagnitude { file: String, place: Place, line: u64, column: String, text: String },

    /// A stamp before the one above it.
    #[error(
        "{file}: {place} {line}, column {column}: time runs backwards, from {before_s} s to {now_s} s; \
         sort the rows, split the file there, or read in tolerant mode (`--reading tolerant`) to skip them \
         (rows that are up to 1 s late are sorted, unless reading is strict; a longer step is a clock that was set anew)"
    )]
    TimeBackwards { file: String, place: Place, line: u64, column: String, before_s: f64, now_s: f64 },

    /// The same stamp twice (strict reading).
    #[error("{file}: {place} {line}, column {column}: the stamp {now_s} s occurs twice; delete one of the lines")]
    DuplicateStamp { file: String, place: Place, line: u64, column: String, now_s: f64 },

    /// TOML that does not parse, an unknown key, a wrong type.
    #[error("{spot}: {message}")]
    MappingSyntax { spot: Spot, message: String },

    /// A key with a value that makes no sense.
    #[error("{spot}: {key}: {message}")]
    MappingValue { spot: Spot, key: String, message: String },

    /// A signal id outside the vocabulary.
    #[error("{spot}: no signal is called `{name}`; {hint}")]
    UnknownSignal { spot: Spot, name: String, hint: String },

    /// A unit name that is not understood.
    #[error("{spot}: {key}: no unit is called `{unit}`; {hint}")]
    UnknownUnit { spot: Spot, key: String, unit: String, hint: String },

    /// A unit of another quantity than the key's.
    #[error(
        "{spot}: {key}: wrong unit `{unit}`, {} where {} is expected; \
         give a unit of that kind, such as {expected}{hint}",
        is.quantity(), expected.quantity()
    )]
    WrongUnit { spot: Spot, key: String, unit: String, is: Unit, expected: Unit, hint: String },

    /// No built-in mapping has this name.
    #[error("no built-in mapping is called `{name}`; {hint}")]
    UnknownMapping { name: String, hint: String },

    /// A file that fits none of the mapping's patterns.
    #[error("{file}: fits no pattern of mapping {mapping} ({patterns}); rename the file or add a pattern")]
    UnmatchedFile { file: String, mapping: String, patterns: String },

    /// Two files of one run for the same entry of the mapping.
    #[error("{file}: a second file for the pattern {pattern} of one run; read them as two runs")]
    FileTwice { file: String, pattern: String },

    /// `read` was called without files.
    #[error("run {run}: no file was given; give at least one")]
    NoFiles { run: String },

    /// A signal that a caller cannot do without.
    #[error("recording {recording}: no signal {signal} ({}); map a column to it; mapped are: {mapped}", signal.unit())]
    MissingSignal { recording: String, signal: Signal, mapped: String },

    /// A file that cannot be read at all.
    #[error(transparent)]
    File(#[from] FileError),

    /// A loss where none is accepted (strict reading).
    #[error("{0}; read without strict mode to take what is left")]
    Lost(String),

    /// A topic that the mapping asks for.
    #[error("{file}: no topic `{topic}` (needed by mapping {mapping}); {hint}")]
    MissingTopic { file: String, topic: String, mapping: String, hint: String },

    /// A field that a topic's message does not have.
    #[error("{file}: `{topic}.{field}`: {message}")]
    BadField { file: String, topic: String, field: String, message: String },

    /// A topic whose messages cannot be decoded.
    #[error("{file}: topic `{topic}` ({message_type}): {message}")]
    BadTopic { file: String, topic: String, message_type: String, message: String },

    /// A channel whose stamps and values do not pair up.
    #[error("channel {channel}: {stamps} stamps but {values} values; give one stamp per value")]
    UnequalLengths { channel: String, stamps: usize, values: usize },

    /// A channel whose stamps do not rise.
    #[error("channel {channel}: stamp {index} is {now_ns} ns, not after {before_ns} ns; stamps must rise")]
    StampsNotRising { channel: String, index: usize, before_ns: i64, now_ns: i64 },

    /// A channel with NaN or infinity.
    #[error("channel {channel}: value {index} is not finite; leave the sample out: a gap is a missing sample")]
    ValueNotFinite { channel: String, index: usize },

    /// A recording with two channels for one signal.
    #[error("recording {recording}: two channels are called {channel}; give each signal once")]
    ChannelTwice { recording: String, channel: String },

    /// A channel that names a clock that its recording does not have.
    #[error("recording {recording}: channel {channel} is on clock {clock}, but there are {clocks}")]
    NoSuchClock { recording: String, channel: String, clock: usize, clocks: usize },
}

impl RecordingError {
    /// The place in a text that somebody has written, where it is about one.
    pub fn spot(&self) -> Option<&Spot> {
        match self {
            Self::MappingSyntax { spot, .. }
            | Self::MappingValue { spot, .. }
            | Self::UnknownSignal { spot, .. }
            | Self::UnknownUnit { spot, .. }
            | Self::WrongUnit { spot, .. } => Some(spot),
            _ => None,
        }
    }
}
