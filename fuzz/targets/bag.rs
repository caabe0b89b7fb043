//! MCAP and rosbag2: any bytes as every kind of bag, all messages and all fields, and through a mapping.
#![no_main]

use std::io::Cursor;

use libfuzzer_sys::fuzz_target;
use recordings::{Input, Mapping, Policy, ReadOptions, contents, read};

// Panics of libraries that the readers catch are no findings; those that get here still end the run.
fuzz_target!(init: std::panic::set_hook(Box::new(|_| {})), |bytes: &[u8]| {
    for name in ["a.mcap", "a.db3", "a.mcap.zstd", "a.db3.zstd"] {
        let _ = contents(name, &mut Cursor::new(bytes));
        if let Ok(mapping) = Mapping::built_in("kobuki-bag") {
            for policy in [Policy::Normal, Policy::Tolerant] {
                let _ = read(&mapping, "a", &[Input { name, bytes }], &ReadOptions { policy });
            }
        }
    }
});
