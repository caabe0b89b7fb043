//! What a file written by this crate says of its channels beyond their samples: the writers' half and the readers'.

use std::collections::BTreeMap;

use crate::channel::{Attributes, Channel};
use crate::column::Column;
use crate::recording::{Clock, Recording};

/// The attributes of a channel as keys and values.
pub(crate) fn attributes(channel: &Channel) -> Vec<(&'static str, String)> {
    let Attributes { magnitude_only, dead_band, set_point } = channel.attributes();
    let mut said = vec![("set_point", set_point.to_string()), ("magnitude_only", magnitude_only.to_string())];
    said.extend(dead_band.map(|width| ("dead_band", width.to_string())));
    said
}

/// The clock's declared rate as a key and value, where it has one.
pub(crate) fn clock_rate(recording: &Recording, clock: usize) -> Option<(&'static str, String)> {
    let rate = recording.clocks().get(clock)?.nominal_rate_hz?;
    Some(("clock_rate_hz", rate.to_string()))
}

/// What a file says of one channel.
pub(crate) struct Described {
    /// Where the samples came from.
    column: Option<String>,
    attributes: Attributes,
    /// Number of its clock among those of the file.
    clock: usize,
    clock_name: Option<String>,
    clock_rate_hz: Option<f64>,
}

impl Described {
    /// Reads what `say` says to each key; `None` where it describes no signal of this name.
    pub(crate) fn read<'s>(signal: &str, say: impl Fn(&str) -> Option<&'s str>) -> Option<Self> {
        if say("signal") != Some(signal) {
            return None;
        }
        let number = |key: &str| say(key)?.parse().ok().filter(|value: &f64| value.is_finite());
        let attributes = Attributes {
            magnitude_only: say("magnitude_only") == Some("true"),
            dead_band: number("dead_band"),
            set_point: say("set_point") == Some("true"),
        };
        Some(Self {
            column: say("column").map(str::to_owned),
            attributes,
            clock: say("clock").and_then(|clock| clock.parse().ok()).unwrap_or(0),
            clock_name: say("clock_name").map(str::to_owned),
            clock_rate_hz: number("clock_rate_hz"),
        })
    }
}

/// Gives columns what is said of them, and adds their clocks in the order of the file; those of which nothing is said
/// stay as they are, on a clock called `file`.
pub(crate) fn settle<K>(
    file: &str,
    columns: Vec<(Column<K>, Option<Described>)>,
    clocks: &mut Vec<Clock>,
) -> Vec<Column<K>> {
    let number = |described: &Option<Described>| described.as_ref().map(|described| described.clock);
    let mut index_of: BTreeMap<Option<usize>, usize> = columns.iter().map(|(_, said)| (number(said), 0)).collect();
    for (&clock, index) in &mut index_of {
        let said = columns.iter().find(|(_, said)| number(said) == clock).and_then(|(_, said)| said.as_ref());
        let name = said.and_then(|said| said.clock_name.clone()).unwrap_or_else(|| file.to_owned());
        *index = clocks.len();
        clocks.push(Clock { name, nominal_rate_hz: said.and_then(|said| said.clock_rate_hz) });
    }
    let settled = columns.into_iter().map(|(column, said)| {
        let clock = index_of.get(&number(&said)).copied().unwrap_or_default();
        let Some(said) = said else { return Column { clock, ..column } };
        Column { clock, source: said.column.unwrap_or(column.source), attributes: said.attributes, ..column }
    });
    settled.collect()
}
