//! What this crate writes, it reads back by the built-in mapping `lacuna`: samples bit for bit, and all that the format
//! can hold beside them.

use proptest::prelude::*;
use recordings::{
    Attributes, Channel, Clock, Input, Mapping, Policy, Read, ReadOptions, Recording, RecordingError, Signal, read,
    write_csv, write_mcap, write_parquet,
};

const SIGNALS: [Signal; 4] = [Signal::TorqueLeft, Signal::CurrentRight, Signal::GyroZ, Signal::PoseYaw];

fn attributes() -> impl Strategy<Value = Attributes> {
    let dead_band = proptest::option::of(0.0..3.0_f64);
    (any::<bool>(), dead_band, any::<bool>()).prop_map(|(magnitude_only, dead_band, set_point)| Attributes {
        magnitude_only,
        dead_band,
        set_point,
    })
}

/// Recordings on two clocks, at least one sample each.
fn runs(start: impl Strategy<Value = i64>) -> impl Strategy<Value = Recording> {
    let value = prop_oneof![
        -1e3..1e3_f64,
        any::<f64>().prop_filter("finite", |value| value.is_finite()),
        Just(-0.0),
        Just(f64::MIN_POSITIVE / 4.0),
    ];
    let samples = proptest::collection::vec((1..2_000_000_000_i64, value), 1..20);
    let channel = (samples, attributes(), "[a-z/]{1,8}(\\[é\"\\])?");
    let rate = || proptest::option::of(0.1..1e4_f64);
    (start, proptest::array::uniform4(channel), rate(), rate()).prop_map(|(start, channels, rate_a, rate_b)| {
        let channels =
            channels.into_iter().zip(SIGNALS).enumerate().map(|(index, ((samples, about, column), signal))| {
                let mut now = start;
                let stamped = samples.into_iter().map(|(step, value)| {
                    now += step;
                    (now, value)
                });
                let (t_ns, values) = stamped.unzip();
                Channel::new(signal, index % 2, t_ns, values).unwrap().with_attributes(about).with_column(column)
            });
        // The same name twice: clocks are told apart by more than their names.
        let clock = |nominal_rate_hz| Clock { name: "drives \"1\"".to_owned(), nominal_rate_hz };
        Recording::new("run", vec![clock(rate_a), clock(rate_b)], channels.collect()).unwrap()
    })
}

fn read_back(name: &str, bytes: &[u8]) -> Result<Read, RecordingError> {
    let mapping = Mapping::built_in("lacuna").unwrap();
    read(&mapping, "run", &[Input { name, bytes }], &ReadOptions { policy: Policy::Strict })
}

/// Stamps and bits.
fn bits(channel: &Channel) -> Vec<(i64, u64)> {
    channel.samples().map(|(t_ns, value)| (t_ns, value.to_bits())).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(64) })]

    #[test]
    fn mcap_keeps_everything(run in runs(prop_oneof![Just(0), Just(1_700_000_000_123_456_789)])) {
        let mut bytes = Vec::new();
        write_mcap(&run, &mut bytes).unwrap();
        let read = read_back("run.mcap", &bytes).unwrap();
        prop_assert_eq!(&read.recording, &run);
        for (found, channel) in read.recording.channels().iter().zip(run.channels()) {
            prop_assert_eq!(bits(found), bits(channel));
        }
        prop_assert!(read.losses.is_empty() && read.unused.is_empty());
    }

    #[test]
    fn parquet_and_csv_keep_a_clock_each(run in runs(prop_oneof![Just(-5_000_000_000), Just(1_700_000_000_123_456_789)])) {
        for clock in 0..2 {
            let mut bytes = Vec::new();
            write_parquet(&run, clock, &mut bytes).unwrap();
            let table = read_back("run.parquet", &bytes).unwrap();
            let text = read_back("run.csv", write_csv(&run, clock).as_bytes()).unwrap();
            prop_assert_eq!(&table.recording.clocks()[0], &run.clocks()[clock]);
            let expected: Vec<&Channel> = run.channels().iter().filter(|channel| channel.clock() == clock).collect();
            for read in [&table, &text] {
                prop_assert_eq!(read.recording.channels().len(), expected.len());
                prop_assert!(read.losses.is_empty() && read.unused.is_empty());
            }
            for (index, channel) in expected.into_iter().enumerate() {
                let (found, plain) = (&table.recording.channels()[index], &text.recording.channels()[index]);
                prop_assert_eq!((found.signal(), bits(found)), (channel.signal(), bits(channel)));
                prop_assert_eq!((found.attributes(), found.column()), (channel.attributes(), channel.column()));
                prop_assert_eq!((plain.signal(), bits(plain)), (channel.signal(), bits(channel)));
            }
        }
    }
}

#[test]
fn each_file_is_a_run_by_itself() {
    let mapping = Mapping::built_in("lacuna").unwrap();
    let sorted = mapping.group(&["x/run.mcap", "x/run.csv", "x/run.parquet", "x/notes.txt"]);
    let runs: Vec<(&str, usize, usize)> =
        sorted.groups.iter().map(|group| (&*group.run, group.files.len(), group.missing.len())).collect();
    assert_eq!(runs, [("x/run", 1, 0); 3]);
    assert_eq!(sorted.unmatched, ["x/notes.txt"]);
    // No parts of a bag, which rosbag2 would call so.
    assert_eq!(mapping.group(&["run/run_1.mcap", "run/run_2.mcap"]).groups.len(), 2);
}

#[test]
fn what_others_wrote_under_the_same_names_is_not_taken_for_ours() {
    let clock = Clock { name: "c".to_owned(), nominal_rate_hz: None };
    let gyro = Channel::new(Signal::GyroZ, 0, vec![1], vec![1.0]).unwrap();
    let mut bytes = Vec::new();
    write_mcap(&Recording::new("run", vec![clock], vec![gyro]).unwrap(), &mut bytes).unwrap();
    assert!(read_back("run.mcap", &bytes).is_ok());
    let mut out = std::io::Cursor::new(Vec::new());
    let mut writer = mcap::Writer::new(&mut out).unwrap();
    for message in mcap::MessageStream::new(&bytes).unwrap() {
        let message = message.unwrap();
        let mut channel = (*message.channel).clone();
        channel.metadata.clear();
        writer.write(&mcap::Message { channel: channel.into(), ..message }).unwrap();
    }
    writer.finish().unwrap();
    drop(writer);
    let error = read_back("run.mcap", &out.into_inner()).unwrap_err();
    assert!(matches!(error, RecordingError::NoSamples { .. }), "{error}");
}
