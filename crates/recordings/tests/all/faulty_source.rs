//! A source whose n-th read or search fails, for every n.

use std::io::{self, Cursor, Read, Seek, SeekFrom};

use crate::common::{Bag, keep, messages};
use recordings::{FileError, Mapping, Opened, ReadOptions, RecordingError, read_from};

/// Gives short reads, and fails one call of all.
struct Faulty {
    bytes: Cursor<Vec<u8>>,
    calls: usize,
    fail_at: usize,
}

impl Faulty {
    fn call(&mut self) -> io::Result<()> {
        self.calls += 1;
        if self.calls == self.fail_at { Err(io::Error::other("the disk is gone")) } else { Ok(()) }
    }
}

impl Read for Faulty {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        self.call()?;
        let most = into.len().min(61);
        self.bytes.read(&mut into[..most])
    }
}

impl Seek for Faulty {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.call()?;
        self.bytes.seek(to)
    }
}

/// Every n-th failure must be told as such; `read` is called until none is left.
fn fail_everywhere(bytes: &[u8], read: impl Fn(&mut Faulty) -> Result<(), RecordingError>) {
    for fail_at in 1.. {
        let mut source = Faulty { bytes: Cursor::new(bytes.to_vec()), calls: 0, fail_at };
        let result = read(&mut source);
        if source.calls < fail_at {
            result.unwrap();
            assert!(fail_at > 10, "{fail_at}");
            return;
        }
        let error = result.expect_err("a failed read must not pass");
        assert!(
            matches!(&error, RecordingError::File(FileError::CannotRead { message, .. }) if message == "the disk is gone"),
            "{error}"
        );
    }
}

#[test]
fn no_failed_read_of_a_bag_passes() {
    for compression in [None, Some(mcap::Compression::Zstd), Some(mcap::Compression::Lz4)] {
        let bytes = Bag { compression, ..Bag::default() }.write(&messages(20));
        fail_everywhere(&bytes, |source| {
            let mut kept = Vec::new();
            let passed = recordings::messages("a.mcap", source, &mut |message| {
                kept.push(keep(&message));
                Ok::<(), RecordingError>(())
            })?;
            assert_eq!((kept, passed.losses), (messages(20), vec![]));
            Ok(())
        });
    }
}

#[test]
fn no_failed_read_of_a_table_passes() {
    let mapping = Mapping::built_in("skid-steer-columns").unwrap();
    let rows: Vec<String> = (0..200).map(|i| format!("{i},2\n")).collect();
    let text = format!("time_s,gyro_z_rad_s\n{}", rows.concat());
    fail_everywhere(text.as_bytes(), |source| {
        let mut inputs = [Opened { name: "a.csv", source }];
        read_from(&mapping, "a", &mut inputs, &ReadOptions::default()).map(|read| assert!(read.losses.is_empty()))
    });
}
