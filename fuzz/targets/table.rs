//! CSV and Parquet through mappings.
#![no_main]

use std::io::Cursor;

use libfuzzer_sys::fuzz_target;
use recordings::{Input, Mapping, Policy, ReadOptions, read, table_contents};

// Panics of libraries that the readers catch are no findings; those that get here still end the run.
fuzz_target!(init: std::panic::set_hook(Box::new(|_| {})), |bytes: &[u8]| {
    let Ok(mapping) = Mapping::built_in("skid-steer-columns") else { return };
    let _ = table_contents("a.csv", &mut Cursor::new(bytes));
    for policy in [Policy::Strict, Policy::Normal, Policy::Tolerant] {
        let _ = read(&mapping, "a", &[Input { name: "a.csv", bytes }], &ReadOptions { policy });
    }
    let text = "[[files]]\npattern = \"*.parquet\"\ntime = { column = \"t\", unit = \"s\" }\n\
                signals.gyro_z = { column = \"wz\", unit = \"rad/s\" }";
    if let Ok(mapping) = Mapping::parse("m.toml", text) {
        let _ = read(&mapping, "a", &[Input { name: "a.parquet", bytes }], &ReadOptions::default());
    }
});
