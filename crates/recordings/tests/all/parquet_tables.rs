//! Parquet tables: whole, and refused when damaged.

use std::sync::Arc;

use parquet::basic::{Compression, ZstdLevel};
use parquet::data_type::{DoubleType, FloatType, Int64Type};
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::parser::parse_message_type;
use recordings::{Input, Mapping, Policy, Read, ReadOptions, RecordingError, Signal, named_columns, read};

const MAPPING: &str = r#"
[[files]]
pattern = "*.parquet"
time = { column = "t_us", unit = "us" }
[files.signals]
gyro_z = { column = "wz", unit = "deg/s" }
accel_x = { column = "ax", unit = "m/s^2" }
"#;

/// Times, rates with every third missing, and accelerations.
fn table(rows: i64, stamp: &str, compression: Compression) -> Vec<u8> {
    let schema = format!(
        "message table {{ required int64 t_us {stamp}; optional double wz; required float ax; required binary note (UTF8); }}"
    );
    let schema = Arc::new(parse_message_type(&schema).unwrap());
    let properties = Arc::new(WriterProperties::builder().set_compression(compression).build());
    let mut bytes = Vec::new();
    let mut writer = SerializedFileWriter::new(&mut bytes, schema, properties).unwrap();
    let mut group = writer.next_row_group().unwrap();
    let t: Vec<i64> = (0..rows).map(|i| 1_700_000_000_000_000 + 1000 * i).collect();
    let there: Vec<i16> = (0..rows).map(|i| i16::from(i % 3 != 2)).collect();
    let rates: Vec<f64> = (0..rows).filter(|i| i % 3 != 2).map(|i| 18.0 * i as f64).collect();
    let forces: Vec<f32> = (0..rows).map(|i| i as f32 / 4.0).collect();
    let mut column = group.next_column().unwrap().unwrap();
    column.typed::<Int64Type>().write_batch(&t, None, None).unwrap();
    column.close().unwrap();
    let mut column = group.next_column().unwrap().unwrap();
    column.typed::<DoubleType>().write_batch(&rates, Some(&there), None).unwrap();
    column.close().unwrap();
    let mut column = group.next_column().unwrap().unwrap();
    column.typed::<FloatType>().write_batch(&forces, None, None).unwrap();
    column.close().unwrap();
    let mut column = group.next_column().unwrap().unwrap();
    let notes = vec![parquet::data_type::ByteArray::from("x"); rows as usize];
    column.typed::<parquet::data_type::ByteArrayType>().write_batch(&notes, None, None).unwrap();
    column.close().unwrap();
    group.close().unwrap();
    writer.close().unwrap();
    bytes
}

fn run(mapping: &str, bytes: &[u8]) -> Result<Read, RecordingError> {
    let mapping = Mapping::parse("m.toml", mapping).unwrap();
    read(&mapping, "a", &[Input { name: "a.parquet", bytes }], &ReadOptions { policy: Policy::Strict })
}

#[test]
fn columns_units_gaps_and_stamps() {
    let kinds =
        [Compression::UNCOMPRESSED, Compression::SNAPPY, Compression::LZ4_RAW, Compression::ZSTD(ZstdLevel::default())];
    for compression in kinds {
        for stamp in ["", "(TIMESTAMP_MICROS)"] {
            let read = run(MAPPING, &table(9, stamp, compression)).unwrap();
            assert!(read.losses.is_empty(), "{:?}", read.losses);
            let gyro = read.recording.require(Signal::GyroZ).unwrap();
            assert_eq!(gyro.t_ns()[..3], [0, 1, 3].map(|i| 1_700_000_000_000_000_000 + 1_000_000 * i));
            assert_eq!(gyro.values()[2], 18.0 * 3.0 * (std::f64::consts::TAU / 360.0));
            let force = read.recording.require(Signal::AccelX).unwrap();
            assert_eq!((force.len(), force.values()[3]), (9, 0.75));
            assert_eq!(read.unused[0].column, "note");
            assert_eq!(read.sources[0].sha256.len(), 64);
        }
    }
    let missing =
        run(&MAPPING.replace("\"wz\"", "\"wy\""), &table(9, "", Compression::SNAPPY)).unwrap_err().to_string();
    assert!(
        missing.starts_with("a.parquet: line 1: no column `wy` (needed for gyro_z of mapping m.toml)"),
        "{missing}"
    );
    let text = run(&MAPPING.replace("\"wz\"", "\"note\""), &table(9, "", Compression::SNAPPY)).unwrap_err().to_string();
    assert!(text.starts_with("a.parquet: row 1, column note: `x` is not a number"), "{text}");
}

#[test]
fn cuts_are_refused_and_flips_do_not_panic() {
    for compression in [Compression::UNCOMPRESSED, Compression::SNAPPY] {
        let bytes = table(40, "", compression);
        for end in 0..bytes.len() {
            assert!(run(MAPPING, &bytes[..end]).is_err(), "cut at {end}");
        }
        let mut flipped = bytes.clone();
        for index in 0..bytes.len() {
            for bit in 0..8 {
                flipped[index] = bytes[index] ^ (1 << bit);
                let _ = run(MAPPING, &flipped);
            }
            flipped[index] = bytes[index];
        }
    }
}

#[test]
fn columns_by_their_names_are_those_of_the_file_with_instants_in_its_unit() {
    for stamp in ["", "(TIMESTAMP_MICROS)"] {
        let bytes = table(9, stamp, Compression::SNAPPY);
        let read = named_columns("a.parquet", &mut std::io::Cursor::new(&bytes), &["wz", "t_us", "note", "b"]).unwrap();
        assert_eq!(read.names, ["t_us", "wz", "ax", "note"]);
        let names: Vec<&str> = read.columns.iter().map(|column| column.name.as_str()).collect();
        assert_eq!(names, ["t_us", "wz", "note"]);
        let [time, rate, note] = &read.columns[..] else { panic!("three columns") };
        assert_eq!(time.cells[8].unwrap() - time.cells[0].unwrap(), 8000.0);
        assert_eq!((rate.cells[1], rate.cells[2]), (Some(18.0), None));
        assert_eq!((note.unread.clone(), note.cells.len()), (Some((1, "x".to_owned())), 9));
        assert!(named_columns("a.parquet", &mut std::io::Cursor::new(&bytes[..bytes.len() / 2]), &["wz"]).is_err());
    }
}
