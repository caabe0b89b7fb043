//! Every file in `tests/bad/` has an entry here that says what must be told of it, and every entry its file.

use std::collections::BTreeSet;
use std::fs;
use std::io::Cursor;
use std::path::{Path, PathBuf};

use recordings::{FileError, Input, Mapping, ReadOptions, messages, read};

/// File, and words that the error or the first loss must hold.
const MANIFEST: &[(&str, &str)] = &[
    ("bomb.mcap", "1 damaged chunk of messages dropped, byte 25"),
    ("broken.mcap.zstd", "1 file without its end: it was cut off, byte 0"),
    ("column_twice.csv", "column `gyro_z_rad_s` occurs more than once"),
    ("empty.csv", "the file is empty"),
    ("endless_chunk.mcap", "1 stretch of damaged bytes skipped, byte 8"),
    ("endless_footer.parquet", "not a readable Parquet file"),
    ("header_only.csv", "line 1 is a header but no row follows it"),
    ("header_only.db3", "not a readable rosbag2 sqlite3 file"),
    ("magic_only.mcap", "1 file without its end: it was cut off, byte 8"),
    ("magic_only.parquet", "not a readable Parquet file"),
    ("no_bag.db3", "not a readable rosbag2 sqlite3 file"),
    ("no_bag.mcap", "1 stretch of damaged bytes skipped, byte 0"),
    ("semicolons.csv", "set delimiter = \";\" in the mapping"),
    ("short_attachment.mcap", "nothing"),
    ("text_in_number.csv", "`oops` is not a number"),
    ("too_many_counted.mcap", "1152921504606846976 messages not found that the file counts"),
    ("undescribed_channel.mcap", "1 message of an undescribed topic skipped, byte 25"),
    ("unknown_record.mcap", "1 record of unknown kind skipped, byte 25"),
    ("utf16.csv", "the header is not UTF-8 text"),
];

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad")
}

/// What is told of a file.
fn told(name: &str, bytes: &[u8]) -> String {
    let built_in = include_str!("../../mappings/skid-steer-columns.toml");
    let mapping = match Path::new(name).extension().and_then(|ending| ending.to_str()) {
        Some("csv") => Some(Mapping::parse("csv", built_in).unwrap()),
        Some("parquet") => Some(Mapping::parse("parquet", &built_in.replace("*.csv", "*.parquet")).unwrap()),
        _ => None,
    };
    if let Some(mapping) = mapping {
        let read = read(&mapping, "bad", &[Input { name, bytes }], &ReadOptions::default());
        return read.map_or_else(|error| error.to_string(), |read| format!("{:?}", read.losses));
    }
    match messages(name, &mut Cursor::new(bytes), &mut |_| Ok::<(), FileError>(())) {
        Err(error) => error.to_string(),
        Ok(passed) => passed.losses.first().map_or("nothing".to_owned(), ToString::to_string),
    }
}

#[test]
fn every_bad_file_is_reported_as_the_manifest_says() {
    for (name, words) in MANIFEST {
        let bytes = fs::read(folder().join(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
        let told = told(name, &bytes);
        assert!(told.contains(words), "{name}: {told}");
    }
}

#[test]
fn every_bad_file_has_an_entry() {
    let known: BTreeSet<String> = MANIFEST.iter().map(|(name, _)| (*name).to_owned()).collect();
    let there: BTreeSet<String> =
        fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    assert_eq!(there, known);
}
