//! What is inside a table without a mapping: columns, gaps, times, however it is written.

use std::io::{self, Cursor, Read, Seek, SeekFrom};

use recordings::{
    Channel, Clock, Recording, RecordingError, Signal, TableContents, TableFormat, UnitBy, table_contents,
    write_parquet,
};

fn look(bytes: &[u8]) -> Result<TableContents, RecordingError> {
    table_contents("a.csv", &mut Cursor::new(bytes))
}

/// Numbers, empty cells and others of each column.
fn counts(table: &TableContents) -> Vec<(u64, u64, u64)> {
    table.columns.iter().map(|column| (column.numbers, column.empty, column.other)).collect()
}

#[test]
fn cells_are_counted_and_rows_that_do_not_fit_are_not() {
    let text = b"\xef\xbb\xbf\n \nt,v,mode\n0,1e3,on\n0.1,,off\n\n0.2,nan,\n0.3,-2\n0.4,\"5\",on\n";
    let table = look(text).unwrap();
    let names: Vec<&str> = table.columns.iter().map(|column| column.name.as_str()).collect();
    assert_eq!(names, ["t", "v", "mode"]);
    assert_eq!((table.rows, table.misfits, table.headless), (5, 1, false));
    assert_eq!(counts(&table), [(4, 0, 0), (2, 1, 1), (0, 1, 3)]);
    assert_eq!(table.columns[1].range, Some((5.0, 1000.0)));
    let examples: Vec<Option<&str>> = table.columns.iter().map(|column| column.example.as_deref()).collect();
    assert_eq!(examples, [None, Some("nan"), Some("on")]);
    assert_eq!(table.format, TableFormat::Csv { delimiter: b',', decimal_comma: false });
    assert_eq!((table.bytes, table.sha256.len()), (text.len() as u64, 64));
    let time = table.columns[0].time.unwrap();
    assert!((time.span_s - 0.4).abs() < 1e-12 && (time.rate_hz - 7.5).abs() < 1e-9 && time.unit_by == UnitBy::Nothing);
}

#[test]
fn a_column_called_time_is_the_time_where_others_rise_as_well() {
    let table = look(b"seq,odometer_m,stamp\n1,0.5,17\n2,0.6,17.5\n3,0.7,18\n").unwrap();
    assert!(table.columns.iter().all(|column| column.time.is_some()));
    assert_eq!(table.time().map(|column| column.name.as_str()), Some("stamp"));
    assert_eq!(look(b"a,b\n1,3\n2,1\n0,2\n").unwrap().time(), None);
}

#[test]
fn what_is_no_table_is_refused() {
    let message = |bytes: &[u8]| look(bytes).unwrap_err().to_string();
    assert!(message(b"").contains("the file is empty"));
    assert!(message(b"t,v\n").contains("no row follows"));
    assert!(message(b"\xff\xfet\0").contains("not UTF-8 text"));
    assert!(message(b"\x89MCAP0\r\n").contains("not a readable table file: it is a bag"));
    assert!(message(b"PAR1").contains("not a readable Parquet file"));
    assert!(look(b"1,2\n3,4\n").unwrap().headless);
}

#[test]
fn a_parquet_table_shows_the_same() {
    let gyro = Channel::new(Signal::GyroZ, 0, vec![0, 10_000_000, 20_000_000], vec![0.5, -0.25, 1.0]).unwrap();
    let speed = Channel::new(Signal::WheelSpeedLeft, 0, vec![10_000_000], vec![3.0]).unwrap();
    let clock = Clock { name: "c".to_owned(), nominal_rate_hz: None };
    let mut bytes = Vec::new();
    write_parquet(&Recording::new("run", vec![clock], vec![gyro, speed]).unwrap(), 0, &mut bytes).unwrap();
    let table = look(&bytes).unwrap();
    assert_eq!((table.format, table.rows, table.bytes), (TableFormat::Parquet, 3, bytes.len() as u64));
    assert_eq!(counts(&table), [(3, 0, 0), (1, 2, 0), (3, 0, 0)]);
    let time = table.time().unwrap();
    assert_eq!((time.name.as_str(), time.time.unwrap().unit), ("time_ns", "ns"));
    assert!((time.time.unwrap().rate_hz - 100.0).abs() < 1e-6);
    let packed = zstd::encode_all(&b"t,v\n0,1\n1,2\n2,3\n"[..], 0).unwrap();
    assert_eq!(look(&packed).unwrap().rows, 3);
}

/// A header, and then one byte without end.
struct Endless {
    at: u64,
    byte: u8,
}

impl Read for Endless {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        for slot in buffer.iter_mut() {
            *slot = b"t,v\n".get(self.at as usize).copied().unwrap_or(self.byte);
            self.at += 1;
        }
        Ok(buffer.len())
    }
}

impl Seek for Endless {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        let SeekFrom::Start(at) = to else { return Err(io::Error::other("no end")) };
        self.at = at;
        Ok(at)
    }
}

#[test]
fn a_line_without_end_is_refused() {
    let error = table_contents("a.csv", &mut Endless { at: 0, byte: b'1' }).unwrap_err().to_string();
    assert!(error.contains("a line is longer than"), "{error}");
}

#[test]
fn cutting_a_table_anywhere_never_panics() {
    let whole = b"\xef\xbb\xbft;v;w\r\n0,5;\"1\";1\r\n0,6;-2,5e-3;x\r\n";
    for end in 0..whole.len() {
        let _ = look(&whole[..end]);
        for bit in 0..8 {
            let mut flipped = whole.to_vec();
            flipped[end] ^= 1 << bit;
            let _ = look(&flipped);
        }
    }
}
