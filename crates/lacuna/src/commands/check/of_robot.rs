//! What the columns of a robot file read, for people.

use case_files::check::{ColumnRead, DriveRead, OfRobot};
use pages::text_table::{TextTable, number};

use crate::commands::listed;
use crate::console::heading;

pub(super) fn text(of_robot: &OfRobot) -> String {
    let OfRobot { robot, kind, drives } = of_robot;
    let mut out =
        format!("\n{}", heading(&format!("By the columns of {robot} (kind {}: {})", kind.name(), kind.compares())));
    let mut table = TextTable::new(&["recording", "column", ">values", ">Hz", ">from s", ">to s"]);
    for drive in drives {
        for ColumnRead { column, values, span: [from, to] } in &drive.columns {
            let rate = if to > from { number((*values as f64 - 1.0) / (to - from)) } else { "-".to_owned() };
            let seconds = |t: f64| format!("{t:.2}");
            table.row([drive.name.clone(), column.clone(), values.to_string(), rate, seconds(*from), seconds(*to)]);
        }
    }
    if drives.iter().any(|drive| !drive.columns.is_empty()) {
        out += &table.render();
    }
    let read = |drive: &DriveRead| Some(format!("{}: {}", drive.name, drive.drive.as_ref().ok()?));
    out += &listed("Can be diagnosed", &drives.iter().filter_map(read).collect::<Vec<_>>());
    out + &listed("Noted", &drives.iter().flat_map(|drive| drive.told.clone()).collect::<Vec<_>>())
}
