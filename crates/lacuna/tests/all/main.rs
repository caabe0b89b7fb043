//! The program as its users start it, one file for each matter.

mod bad_cases;
mod bad_recordings;
mod bad_robots;
mod batch;
mod check;
mod columns_of_bags;
mod command_driven;
mod commands;
mod diagnose;
mod fleet_recipes;
mod forward;
mod long;
mod next;
mod odometry;
mod on_casters;
mod own_effects;
mod rehearse;
mod unknown_robots;
mod visits;

#[path = "../common/mod.rs"]
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
