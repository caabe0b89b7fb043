//! Good files: units, signs, gaps, clocks, delimiters; and what is written reads back.

use proptest::prelude::*;
use recordings::{
    Channel, Clock, Input, LossKind, Mapping, Policy, Read, ReadOptions, Recording, RecordingError, Signal, read,
    write_csv,
};

const STRICT: ReadOptions = ReadOptions { policy: Policy::Strict };

fn read_one(mapping: &str, bytes: &[u8]) -> Result<Read, RecordingError> {
    let mapping = Mapping::parse("m.toml", mapping).unwrap();
    read(&mapping, "a", &[Input { name: "a.csv", bytes }], &STRICT)
}

#[test]
fn units_signs_gaps_and_unused_columns() {
    let mapping = r#"
        [[files]]
        pattern = "*.csv"
        delimiter = ";"
        time = { column = "stamp", unit = "ms" }
        [files.signals]
        gyro_z = { column = "yaw rate", unit = "deg/s", sign = -1 }
        accel_x = { column = "ax", unit = "g" }
    "#;
    let text = b"\xef\xbb\xbf\"stamp\"; \"yaw rate\" ;ax;note\r\n0;90;;hello\r\n2.5;;1;\r\n5;\"-180\";-1;x\r\n";
    let read = read_one(mapping, text).unwrap();
    let gyro = read.recording.get(Signal::GyroZ).unwrap();
    assert_eq!(gyro.t_ns(), [0, 5_000_000]);
    assert!((gyro.values()[0] + std::f64::consts::FRAC_PI_2).abs() < 1e-15);
    assert!((gyro.values()[1] - std::f64::consts::PI).abs() < 1e-15);
    assert_eq!((gyro.column(), gyro.clock(), gyro.unit().symbol()), ("yaw rate", 0, "rad/s"));
    let accel = read.recording.by_name("accel_x").unwrap();
    assert_eq!(accel.samples().collect::<Vec<_>>(), [(2_500_000, 9.80665), (5_000_000, -9.80665)]);
    assert_eq!(read.unused.len(), 1);
    assert_eq!((read.unused[0].file.as_str(), read.unused[0].column.as_str()), ("a.csv", "note"));
    assert!(read.losses.is_empty());
}

/// A table as a German spreadsheet writes it.
const EUROPEAN: &str = r#"
[[files]]
pattern = "*.csv"
delimiter = ";"
decimal = ","
time = { column = "t", unit = "ms" }
[files.signals]
gyro_z = { column = "wz", unit = "deg/s" }
body_vx = { column = "v", unit = "km/h" }
"#;

#[test]
fn decimal_commas_and_units_in_the_header() {
    let text = "\u{feff}t [ms];wz (deg/s);v;\n0,5;\"180,0\";3,6;\n1,25;;-7,2;\n";
    let read = read_one(EUROPEAN, text.as_bytes()).unwrap();
    let gyro = read.recording.get(Signal::GyroZ).unwrap();
    assert_eq!((gyro.t_ns(), gyro.values()), (&[500_000][..], &[std::f64::consts::PI][..]));
    assert_eq!(
        read.recording.get(Signal::BodyVx).unwrap().samples().collect::<Vec<_>>(),
        [(500_000, 1.0), (1_250_000, -2.0)]
    );

    let message = |text: &str| read_one(EUROPEAN, text.as_bytes()).unwrap_err().to_string();
    assert!(message("t;wz;v\n0;1.5;1\n").contains("column wz: `1.5` is not a number"));
    assert_eq!(
        message("t;wz [rad/s];v\n0;1,5;1\n"),
        "a.csv: line 1: column `wz [rad/s]` says rad/s, the mapping another unit; correct the mapping"
    );
    assert!(message("t [s];wz;v\n0;1,5;1\n").contains("column `t [s]` says s"));
    assert!(message("t;wz [a];wz [b];v\n0;1;1;1\n").contains("column `wz` occurs more than once"));
    let both = Mapping::parse("m.toml", &EUROPEAN.replace("\";\"", "\",\"")).unwrap_err().to_string();
    assert!(both.contains("a comma cannot stand both in numbers and between fields"), "{both}");
}

#[test]
fn a_file_without_stamps_counts_rows() {
    let mapping = "[[files]]\npattern = \"*.csv\"\ntime = { rate_hz = 4 }\n\
                   signals.gyro_z = { column = \"w\", unit = \"rad/s\" }";
    let read = read_one(mapping, b"w\n1\n2\n3\n").unwrap();
    let gyro = read.recording.get(Signal::GyroZ).unwrap();
    assert_eq!(gyro.t_ns(), [0, 250_000_000, 500_000_000]);
    assert_eq!(read.recording.clocks()[0].nominal_rate_hz, Some(4.0));
}

#[test]
fn two_files_on_two_clocks() {
    let mapping = Mapping::built_in("husky-open").unwrap();
    let pro = Input { name: "x/pro_01.csv", bytes: b"time,curL,curR,velL,velR\n0.0,3.61,0.0,0.1651,0.3302\n" };
    let imu = Input { name: "x/imu_01.csv", bytes: b"time,wx,wy,wz,ax,ay,az\n0.0,1,2,3,4,5,6\n0.01,1,2,3,4,5,6\n" };
    let run = read(&mapping, "01", &[imu, pro], &STRICT).unwrap();
    let speed = run.recording.require(Signal::CommandSpeedRight).unwrap();
    assert!((speed.values()[0] - 2.0).abs() < 1e-12);
    assert!(speed.attributes().set_point);
    assert_eq!((speed.clock(), run.recording.require(Signal::GyroZ).unwrap().clock()), (0, 1));
    assert_eq!(run.recording.clocks()[1], Clock { name: "x/imu_01.csv".to_owned(), nominal_rate_hz: Some(100.0) });
    assert_eq!(run.recording.span_ns(1), Some((0, 10_000_000)));
    let current = run.recording.require(Signal::CurrentLeft).unwrap().attributes();
    assert!(current.magnitude_only);
    assert_eq!(run.sources.iter().map(|source| source.name.as_str()).collect::<Vec<_>>(), [pro.name, imu.name]);
    assert_eq!((run.sources[0].bytes, run.sources[0].sha256.len()), (pro.bytes.len(), 64));

    let alone = read(&mapping, "01", &[pro], &STRICT).unwrap();
    assert_eq!(alone.losses[0].kind, LossKind::MissingFile);
    assert_eq!(alone.losses[0].to_string(), "x/imu_01.csv: 1 file is missing; its signals are absent");
    assert_eq!(alone.recording.channels().len(), 4);
}

/// Channels with gaps of their own, on one clock, with stamps since 1970 among them.
fn recordings() -> impl Strategy<Value = Recording> {
    let value = prop_oneof![-1e3..1e3_f64, any::<f64>().prop_filter("finite", |v| v.is_finite())];
    let row = (1..2_000_000_000_i64, proptest::collection::vec(proptest::option::of(value), 3));
    let start = prop_oneof![Just(0), Just(-5_000_000_000), Just(1_700_000_000_123_456_789_i64)];
    (start, proptest::collection::vec(row, 1..20)).prop_map(|(start, rows)| {
        let signals = [Signal::WheelSpeedLeft, Signal::TorqueRight, Signal::PoseYaw];
        let channels = signals.iter().enumerate().filter_map(|(index, &signal)| {
            let mut now = start;
            let samples = rows.iter().filter_map(|(step, values)| {
                now += step;
                values[index].map(|value| (now, value))
            });
            let (t_ns, values): (Vec<_>, Vec<_>) = samples.unzip();
            (!values.is_empty()).then(|| Channel::new(signal, 0, t_ns, values).unwrap())
        });
        let clock = Clock { name: "a.csv".to_owned(), nominal_rate_hz: None };
        Recording::new("a", vec![clock], channels.collect()).unwrap()
    })
}

proptest! {
    #[test]
    fn what_is_written_reads_back_bit_for_bit(original in recordings()) {
        prop_assume!(!original.channels().is_empty());
        let text = write_csv(&original, 0);
        let mapping = Mapping::built_in("skid-steer-columns").unwrap();
        let back = read(&mapping, "a", &[Input { name: "a.csv", bytes: text.as_bytes() }], &STRICT).unwrap();
        prop_assert!(back.losses.is_empty() && back.unused.is_empty());
        prop_assert_eq!(original.channels().len(), back.recording.channels().len());
        for (before, after) in original.channels().iter().zip(back.recording.channels()) {
            prop_assert_eq!(before.signal(), after.signal());
            prop_assert_eq!(before.t_ns(), after.t_ns());
            let bits = |channel: &Channel| channel.values().iter().map(|v| v.to_bits()).collect::<Vec<_>>();
            prop_assert_eq!(bits(before), bits(after));
        }
    }

    #[test]
    fn arbitrary_bytes_never_panic(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
        let mapping = Mapping::built_in("skid-steer-columns").unwrap();
        let mut whole = b"time_s,gyro_z_rad_s\n".to_vec();
        whole.extend(&bytes);
        for policy in [Policy::Strict, Policy::Normal, Policy::Tolerant] {
            for bytes in [&whole, &bytes] {
                let _ = read(&mapping, "a", &[Input { name: "a.csv", bytes }], &ReadOptions { policy });
            }
        }
    }
}
