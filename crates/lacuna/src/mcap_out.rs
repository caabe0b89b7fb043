//! A diagnosis as MCAP for Foxglove: what was recorded, what the simulation says, their difference, and the verdict.
//!
//! | topic | messages | what it holds |
//! |---|---|---|
//! | `/RUN/SIGNAL`, such as `/run_1/left_wheel_speed` | `lacuna.Compared` | recorded, nominal, retuned, corrected, residual_before, residual_after |
//! | `/RUN/mismatch` | `lacuna.Mismatch` | squared mismatch divided by that of fault-free drives, before and after the correction |
//! | `/RUN/state/...` | `lacuna.State` | when a signal mismatches, when a named cause is present |
//! | `/RUN/pose`, `/RUN/path` | `foxglove.PoseInFrame`, `foxglove.PosesInFrame` | position on the ground |
//! | `/verdict` | `foxglove.Log` | the sentences of the verdict, what limits it, the intervals |
//!
//! Messages are JSON with their schema in the file. A recording begins at 0 s, as all times of a diagnosis do.

use std::collections::BTreeMap;
use std::io::Cursor;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use mcap::records::MessageHeader;
use mcap::{Compression, WriteOptions};
use serde_json::Value;
use verdict::Diagnosis;

use schema::Schema;

mod layout;
mod messages;
mod names;
mod schema;

/// A message type, a time and what is said then.
struct Message {
    topic: String,
    schema: Schema,
    log_time_ns: u64,
    content: Value,
}

/// Writes a diagnosis as `FILE.mcap`, and beside it `FILE.layout.json`: a layout in which Foxglove shows it.
///
/// # Errors
/// When a file cannot be written.
pub(crate) fn write(file: &Path, diagnosis: &Diagnosis) -> Result<()> {
    let save = |path: &Path, bytes: &[u8]| {
        std::fs::write(path, bytes).with_context(|| format!("cannot write '{}'", path.display()))
    };
    save(file, &bytes(diagnosis)?)?;
    save(&layout_beside(file), (serde_json::to_string_pretty(&layout::layout(diagnosis))? + "\n").as_bytes())
}

/// `out.layout.json` of `out.mcap`.
pub(crate) fn layout_beside(file: &Path) -> PathBuf {
    file.with_extension("layout.json")
}

/// The bytes of the MCAP: chunks compressed with zstd, with indexes and checksums; messages in the order of their times.
///
/// # Errors
/// None that a diagnosis could cause: those of the writer.
pub(crate) fn bytes(diagnosis: &Diagnosis) -> Result<Vec<u8>> {
    let mut messages = messages::of(diagnosis);
    messages.sort_by_key(|message| message.log_time_ns);
    let mut file = Cursor::new(Vec::new());
    let mut writer = WriteOptions::new().compression(Some(Compression::Zstd)).library("lacuna").create(&mut file)?;
    let mut channels: BTreeMap<String, (u16, u32)> = BTreeMap::new();
    for Message { topic, schema, log_time_ns, content } in messages {
        let (channel_id, sequence) = if let Some(&known) = channels.get(&topic) {
            known
        } else {
            let schema = writer.add_schema(schema.name(), "jsonschema", schema.text().as_bytes())?;
            (writer.add_channel(schema, &topic, "json", &BTreeMap::new())?, 0)
        };
        channels.insert(topic, (channel_id, sequence + 1));
        let header = MessageHeader { channel_id, sequence, log_time: log_time_ns, publish_time: log_time_ns };
        writer.write_to_known_channel(&header, content.to_string().as_bytes())?;
    }
    writer.finish()?;
    drop(writer);
    Ok(file.into_inner())
}

#[cfg(test)]
mod tests;
