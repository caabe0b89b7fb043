//! The files of one run, measured instead of kept.

use bags::{Contents, Loss};

use crate::channel::Attributes;
use crate::column::Column;
use crate::column_meter::{ColumnMeter, Measured};
use crate::error::RecordingError;
use crate::fingerprint::Fingerprint;
use crate::input::{Opened, ReadOptions};
use crate::mapping::Mapping;
use crate::quality::Quality;
use crate::read::{Gathered, Source, UnusedColumn, gather};
use crate::recording::{Clock, refuse_twice};
use crate::signal::Signal;

/// What was measured of a channel.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct SurveyedChannel {
    /// What is measured.
    pub signal: Signal,
    /// The column (field, topic) that it came from.
    pub column: String,
    /// Index into [`Survey::clocks`] of the clock that stamped the samples.
    pub clock: usize,
    /// What the mapping says beyond the numbers.
    pub attributes: Attributes,
    /// How good it is, as a [`QualityMeter`](crate::QualityMeter) finds it: up to 65 536 samples as a whole, longer ones
    /// in blocks.
    pub quality: Quality,
    /// What it contains.
    pub fingerprint: Fingerprint,
}

/// What a run is, without its samples.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Survey {
    /// The run's name.
    pub run: String,
    /// What [`SurveyedChannel::clock`] counts.
    pub clocks: Vec<Clock>,
    /// The channels that hold samples, in the order of [`Signal::ALL`].
    pub channels: Vec<SurveyedChannel>,
    /// What could not be read.
    pub losses: Vec<Loss>,
    /// The files, in the order of the mapping's entries.
    pub sources: Vec<Source>,
    /// Columns and topics that the mapping does not use: no loss, worth telling.
    pub unused: Vec<UnusedColumn>,
    /// The bags among the files, and what is inside each: what [`contents`](crate::contents()) tells, by the same pass.
    pub contents: Vec<(String, Contents)>,
}

impl Survey {
    /// The content of all channels together.
    pub fn fingerprint(&self) -> Fingerprint {
        Fingerprint::union(self.channels.iter().map(|channel| channel.fingerprint.clone()))
    }
}

/// As [`read_from`](crate::read_from), but channels are measured as they pass, by a thread of their own, and let go:
/// one pass over each file, in memory that does not grow with the length of a bag.
///
/// # Errors
/// As [`read_from`](crate::read_from).
///
/// ```
/// use std::io::Cursor;
/// use recordings::{Mapping, Opened, ReadOptions, Signal, survey_from};
///
/// let mapping = Mapping::built_in("skid-steer-columns")?;
/// let mut file = Cursor::new(b"time_s,gyro_z_rad_s\n0.00,\n0.01,0.25\n");
/// let mut files = [Opened { name: "run_1.csv", source: &mut file }];
/// let survey = survey_from(&mapping, "run_1", &mut files, &ReadOptions::default())?;
/// assert_eq!(survey.channels[0].signal, Signal::GyroZ);
/// assert_eq!(survey.channels[0].quality.timing.samples, 1);
/// # Ok::<(), recordings::RecordingError>(())
/// ```
pub fn survey_from(
    mapping: &Mapping,
    run: &str,
    inputs: &mut [Opened<'_>],
    options: &ReadOptions,
) -> Result<Survey, RecordingError> {
    let Gathered { clocks, columns, losses, sources, unused, contents } =
        ColumnMeter::with(|meter| gather(mapping, run, inputs, options.policy, (meter, true)))?;
    let mut channels: Vec<SurveyedChannel> = columns.into_iter().map(surveyed).collect();
    channels.sort_by_key(|channel| channel.signal);
    refuse_twice(run, channels.iter().map(|channel| channel.signal))?;
    Ok(Survey { run: run.to_owned(), clocks, channels, losses, sources, unused, contents })
}

fn surveyed(column: Column<Measured>) -> SurveyedChannel {
    let Column { signal, source, clock, attributes, kept: (quality, fingerprint) } = column;
    SurveyedChannel { signal, column: source, clock, attributes, quality, fingerprint }
}
