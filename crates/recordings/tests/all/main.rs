//! Tests of what this crate offers, one file for each matter: one program, because every further one is linked with all that
//! reads recordings.

mod bad_files;
mod bad_input;
mod bag_mapping;
mod faulty_source;
mod fingerprint;
mod good_input;
mod header_stamps;
mod late_rows;
mod mapping_toml;
mod named_columns;
mod parquet_tables;
mod quality;
mod quality_meter;
mod read_back;
mod sqlite;
mod survey;
mod table_contents;
mod written;

#[path = "../../../bags/tests/common/mod.rs"]
mod common;

#[test]
fn every_file_of_this_folder_is_part_of_this_program() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/all");
    for entry in std::fs::read_dir(folder).expect("the folder") {
        let file = entry.expect("an entry").file_name().into_string().expect("a name");
        let name = file.trim_end_matches(".rs");
        assert!(name == "main" || include_str!("main.rs").contains(&format!("mod {name};")), "{file}");
    }
}
