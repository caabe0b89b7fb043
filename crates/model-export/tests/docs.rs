//! The table of the documentation is that of the program.

use std::path::Path;

use model_export::{Engine, Way, way};
use robot_model::effects::catalogue;

const MARKS: [&str; 2] = ["<!-- table -->\n", "<!-- end of table -->\n"];

fn table() -> String {
    let mut out = String::from("| effect | MJCF | URDF | SDF |\n| --- | --- | --- | --- |\n");
    for effect in catalogue::<f64>() {
        let id = effect.spec().id;
        let cell = |engine| match way(engine, id) {
            Some(Way::Held(value)) => value.to_owned(),
            Some(Way::Added(why)) => format!("*added*: {why}"),
            None => panic!("{id} has no translation"),
        };
        let cells = Engine::ALL.map(cell).join(" | ");
        out += &["| `", id, "` | ", &cells, " |\n"].concat();
    }
    out
}

/// With `LACUNA_WRITE_DOCS` set it writes the table instead.
#[test]
fn the_table_of_what_engines_hold_is_up_to_date() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/export.md");
    let text = std::fs::read_to_string(&path).expect("docs/export.md");
    let (before, rest) = text.split_once(MARKS[0]).expect("a place for the table");
    let (found, after) = rest.split_once(MARKS[1]).expect("its end");
    let wanted = format!("\n{}\n", table());
    if std::env::var_os("LACUNA_WRITE_DOCS").is_some() {
        std::fs::write(&path, [before, MARKS[0], &wanted, MARKS[1], after].concat()).expect("writes");
        return;
    }
    assert!(found == wanted, "docs/export.md is stale: run LACUNA_WRITE_DOCS=1 cargo test -p model-export --test docs");
}
