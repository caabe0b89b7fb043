//! Mappings, and a small CSV read with whatever they say.
#![no_main]

use libfuzzer_sys::fuzz_target;
use recordings::{Input, Mapping, ReadOptions, read};

fuzz_target!(|text: &str| {
    if let Ok(mapping) = Mapping::parse("m.toml", text) {
        let bytes = b"t,a,b\n0.0,1,2\n0.1,,3\n0.2,5,6\n";
        let _ = read(&mapping, "a", &[Input { name: "a.csv", bytes }], &ReadOptions::default());
    }
});
