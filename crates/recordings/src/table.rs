//! One CSV file against one entry of a mapping: rows become samples, and what does not is counted.

use csv::ByteRecord;

use crate::channel::Channel;
use crate::error::RecordingError;
use crate::header::Header;
use crate::loss::{Ledger, LossKind, in_words};
use crate::mapping::FileMapping;
use crate::read::{Input, Policy};
use crate::row::{Gathered, Row};

/// Reads the rows below `header`; the channels that hold samples, on clock `clock`.
pub(crate) fn read_rows(
    input: &Input<'_>,
    file: &FileMapping,
    header: &Header<'_>,
    clock: usize,
    policy: Policy,
    ledger: &mut Ledger<'_>,
) -> Result<Vec<Channel>, RecordingError> {
    let mut rows = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        // Numbers need no quotes, and an open quote would swallow the rest of the file.
        .quoting(false)
        .delimiter(file.delimiter)
        .from_reader(header.body);
    let mut gathered: Vec<Gathered> = header.columns.iter().map(|_| Gathered::default()).collect();
    let mut record = ByteRecord::new();
    let mut last_ns = None;
    let mut number = 0_u64;
    // Reading from memory without UTF-8 checks and with any number of fields cannot fail; an error ends the rows.
    while rows.read_byte_record(&mut record).unwrap_or(false) {
        let offset = record.position().map_or(0, csv::Position::byte);
        let mut row = Row { input, header, file, policy, record: &record, number, offset, ledger };
        row.take(&mut last_ns, &mut gathered)?;
        number += 1;
    }
    if number == 0 {
        return Err(RecordingError::NoRows { file: input.name.to_owned(), line: header.line });
    }
    let (mut channels, mut empty) = (Vec::new(), Vec::new());
    for (found, samples) in header.columns.iter().zip(gathered) {
        let mapped = found.mapped;
        if samples.t_ns.is_empty() {
            empty.push(mapped);
            continue;
        }
        let channel = Channel::new(mapped.signal, clock, samples.t_ns, samples.values)?;
        channels.push(channel.with_attributes(mapped.attributes).with_column(&mapped.column));
    }
    if channels.is_empty() {
        let losses = in_words(ledger.losses());
        return Err(RecordingError::NoSamples { file: input.name.to_owned(), losses });
    }
    for mapped in empty.iter().filter(|mapped| !mapped.optional) {
        ledger.add(LossKind::EmptyColumn, Some(&mapped.column), || None);
    }
    Ok(channels)
}
