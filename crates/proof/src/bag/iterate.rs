//! The plain iteration: what the `mcap` library's documentation shows for reading a file.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use anyhow::{Context, Result};

/// What an iteration met.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Counted {
    pub(super) messages: u64,
    /// Bytes of all messages.
    pub(super) bytes: u64,
}

/// Meets every message of a bag.
pub(super) fn iterate(bag: &Path) -> Result<Counted> {
    let shown = bag.display();
    let file = File::open(bag).with_context(|| format!("cannot read '{shown}'"))?;
    let mut counted = Counted::default();
    for message in mcap::io::MessageReader::new(BufReader::new(file)) {
        let message = message.with_context(|| format!("'{shown}' after {} messages", counted.messages))?;
        counted.messages += 1;
        counted.bytes += message.data.len() as u64;
    }
    Ok(counted)
}
