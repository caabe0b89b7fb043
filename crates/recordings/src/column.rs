//! What becomes of the samples of a column while rows arrive: they are kept, or measured and let go.

use crate::channel::{Attributes, Channel};
use crate::error::RecordingError;
use crate::mapping::ColumnMapping;
use crate::signal::Signal;

/// How far (ns) a stamp may lie before the latest one and still be sorted into its place: messages overtake each other
/// on a network, by less than a second; what goes further back is a clock that was set anew.
pub(crate) const SORTED_WITHIN_NS: i64 = 1_000_000_000;

/// Takes the samples of columns: one that was given none makes another for each column.
pub(crate) trait Keep: Clone {
    /// What there is of a column at the end.
    type Kept;

    /// Whether all samples stay in memory, so that files have to be small enough.
    const HOLDS_ALL: bool;

    /// One for the samples of a column.
    fn of(&self, _column: &ColumnMapping) -> Self {
        self.clone()
    }

    /// Takes a sample, at most [`SORTED_WITHIN_NS`] before the latest one; false when there is one at this instant,
    /// which stays.
    fn add(&mut self, now_ns: i64, value: f64) -> bool;

    /// What was kept; `None` without a sample.
    fn finish(self) -> Option<Self::Kept>;
}

/// A column that is a signal, with what was kept of its samples.
pub(crate) struct Column<K> {
    pub(crate) signal: Signal,
    /// Its name in the file.
    pub(crate) source: String,
    /// Index of its clock.
    pub(crate) clock: usize,
    pub(crate) attributes: Attributes,
    pub(crate) kept: K,
}

/// Instants, strictly rising, and values.
pub(crate) type Series = (Vec<i64>, Vec<f64>);

impl Column<Series> {
    pub(crate) fn into_channel(self) -> Result<Channel, RecordingError> {
        let (t_ns, values) = self.kept;
        let channel = Channel::new(self.signal, self.clock, t_ns, values)?;
        Ok(channel.with_attributes(self.attributes).with_column(self.source))
    }
}
