//! Columns of tables by the names in their header.

use std::io::Cursor;

use recordings::{NamedColumns, RecordingError, named_columns};

fn read(text: &str) -> Result<NamedColumns, RecordingError> {
    named_columns("a.csv", &mut Cursor::new(text), &["t", "speed"])
}

#[test]
fn the_same_columns_are_read_however_a_table_is_written() {
    let plain = read("t,note,speed\n0.0,a,1.5\n0.5,b,\n1.0,c,-2\n").expect("a table");
    assert_eq!(plain.names, ["t", "note", "speed"]);
    assert_eq!(plain.columns[1].cells, [Some(1.5), None, Some(-2.0)]);
    assert!(plain.told.is_empty());

    let marked = "\u{feff}t;note;speed\r\n0,0;a;1,5\r\n0,5;b;\r\n1,0;c;-2\r\n";
    for text in [marked, "t\tnote\tspeed\n0.0\ta\t1.5\n0.5\tb\t\n1.0\tc\t-2\n"] {
        let read = read(text).expect("a table");
        assert_eq!((&read.names, &read.columns), (&plain.names, &plain.columns));
        assert!(read.told[0].starts_with("cells are taken to be separated by"), "{:?}", read.told);
    }
}

#[test]
fn what_is_no_number_is_kept_with_its_row() {
    let read = read("t,speed\n0.0,nan\n0.5,fast\n1.0,slow\n").expect("a table");
    let speed = &read.columns[1];
    assert_eq!(speed.unread, Some((2, "fast".to_owned())));
    assert!(speed.cells.iter().all(|cell| cell.is_some_and(f64::is_nan)));
}

#[test]
fn what_is_no_table_is_refused_with_its_place() {
    let refused = |text: &str| read(text).expect_err("no table").to_string();
    assert!(refused(" \n").contains("the file is empty; give a CSV file"));
    assert!(refused("t,speed\n0.0,1.0\n0.5\n").contains("line 3: 1 fields where the header has 2"));
    assert!(refused("t,speed,speed\n0.0,1.0,2.0\n").contains("column `speed` occurs more than once"));
    let bag = named_columns("a.csv", &mut Cursor::new(b"SQLite format 3\0..."), &["t"]).expect_err("a bag");
    assert!(bag.to_string().contains("it is a bag"), "{bag}");
}
