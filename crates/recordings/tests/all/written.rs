//! What the writers write is read back by the libraries of the formats themselves, bit for bit, gaps included.

use std::collections::BTreeMap;
use std::io::{self, Write};

use parquet::file::metadata::RowGroupMetaData;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use proptest::prelude::*;
use recordings::{Attributes, Channel, Clock, Recording, Signal, write_mcap, write_parquet};

const SIGNALS: [Signal; 4] = [Signal::WheelSpeedLeft, Signal::TorqueRight, Signal::GyroZ, Signal::PoseYaw];

/// Stamp and bits of the samples of each channel.
type Samples = BTreeMap<String, Vec<(i64, u64)>>;

fn samples<'a>(channels: impl IntoIterator<Item = &'a Channel>, name: impl Fn(&Channel) -> String) -> Samples {
    let bits = |channel: &Channel| channel.samples().map(|(t_ns, value)| (t_ns, value.to_bits())).collect();
    channels.into_iter().map(|channel| (name(channel), bits(channel))).collect()
}

/// Channels with gaps of their own on two clocks, from `start` on.
fn recordings(start: impl Strategy<Value = i64>) -> impl Strategy<Value = Recording> {
    let value = prop_oneof![
        -1e3..1e3_f64,
        any::<f64>().prop_filter("finite", |value| value.is_finite()),
        Just(-0.0),
        Just(f64::MIN_POSITIVE / 4.0),
    ];
    let row = (1..2_000_000_000_i64, proptest::collection::vec(proptest::option::of(value), SIGNALS.len()));
    (start, proptest::collection::vec(row, 0..40)).prop_map(|(start, rows)| {
        let channels = SIGNALS.iter().enumerate().map(|(index, &signal)| {
            let mut now = start;
            let samples = rows.iter().filter_map(|(step, values)| {
                now += step;
                values[index].map(|value| (now, value))
            });
            let (t_ns, values) = samples.unzip();
            Channel::new(signal, index % 2, t_ns, values).unwrap()
        });
        let clock = |name: &str| Clock { name: name.to_owned(), nominal_rate_hz: None };
        Recording::new("run \"1\"", vec![clock("a"), clock("b")], channels.collect()).unwrap()
    })
}

/// The samples of an MCAP file, whose messages must be in order.
fn read_mcap(bytes: &[u8]) -> Samples {
    let (mut samples, mut last) = (Samples::new(), 0);
    for message in mcap::MessageStream::new(bytes).unwrap() {
        let message = message.unwrap();
        assert!(message.log_time >= last && message.log_time == message.publish_time);
        last = message.log_time;
        let text = str::from_utf8(&message.data).unwrap();
        let json: serde_json::Value = serde_json::from_str(text).unwrap();
        let stamp = &json["timestamp"];
        let (seconds, ns) = (stamp["sec"].as_u64().unwrap(), stamp["nsec"].as_u64().unwrap());
        assert_eq!(seconds * 1_000_000_000 + ns, message.log_time);
        assert_eq!(json["unit"], message.channel.metadata["unit"].as_str());
        // The digits themselves: a JSON library may round.
        let digits = text.split_once("\"value\":").unwrap().1.split(',').next().unwrap();
        assert!(json["value"].is_number());
        let list = samples.entry(message.channel.topic.clone()).or_default();
        assert_eq!(message.sequence as usize, list.len());
        list.push((i64::try_from(message.log_time).unwrap(), digits.parse::<f64>().unwrap().to_bits()));
    }
    samples
}

/// The samples of a Parquet table, whose rows must rise in time and hold something each.
fn read_parquet(bytes: Vec<u8>) -> Samples {
    let reader = SerializedFileReader::new(bytes::Bytes::from(bytes)).unwrap();
    let (mut samples, mut last) = (Samples::new(), i64::MIN);
    for row in reader.get_row_iter(None).unwrap() {
        let (mut now, mut filled) = (None, false);
        for (name, field) in row.unwrap().get_column_iter() {
            match field {
                Field::Long(t_ns) if name == "time_ns" => now = Some(*t_ns),
                Field::Double(value) => {
                    filled = true;
                    samples.entry(name.clone()).or_default().push((now.unwrap(), value.to_bits()));
                }
                Field::Null => {}
                other => panic!("{name}: {other:?}"),
            }
        }
        assert!(filled && now.unwrap() > last);
        last = now.unwrap();
    }
    samples
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(64) })]

    #[test]
    fn mcap_reads_back_bit_for_bit(run in recordings(prop_oneof![Just(0), Just(1_700_000_000_123_456_789)])) {
        let mut bytes = Vec::new();
        write_mcap(&run, &mut bytes).unwrap();
        let mut expected = samples(run.channels(), |channel| format!("/{}", channel.name()));
        expected.retain(|_, samples| !samples.is_empty());
        prop_assert_eq!(read_mcap(&bytes), expected);
        let summary = mcap::Summary::read(&bytes).unwrap().unwrap();
        prop_assert_eq!(summary.channels.len(), SIGNALS.len());
    }

    #[test]
    fn parquet_reads_back_bit_for_bit(
        run in recordings(prop_oneof![Just(0), Just(-5_000_000_000), Just(1_700_000_000_123_456_789)]),
    ) {
        for clock in 0..3 {
            let mut bytes = Vec::new();
            write_parquet(&run, clock, &mut bytes).unwrap();
            let channels = run.channels().iter().filter(|channel| channel.clock() == clock);
            let mut expected = samples(channels, |channel| channel.signal().column_name());
            expected.retain(|_, samples| !samples.is_empty());
            prop_assert_eq!(read_parquet(bytes), expected);
        }
    }
}

fn one_channel(t_ns: Vec<i64>) -> Recording {
    let values = t_ns.iter().map(|&t| t as f64 * 1e-9).collect();
    let attributes = Attributes { magnitude_only: true, dead_band: Some(0.59), set_point: false };
    let channel = Channel::new(Signal::CurrentLeft, 0, t_ns, values).unwrap().with_attributes(attributes);
    let clock = Clock { name: "pro_1.csv".to_owned(), nominal_rate_hz: None };
    Recording::new("run", vec![clock], vec![channel.with_column("curL")]).unwrap()
}

#[test]
fn mcap_says_what_it_holds() {
    let mut bytes = Vec::new();
    write_mcap(&one_channel(vec![1_500_000_000]), &mut bytes).unwrap();
    let message = mcap::MessageStream::new(&bytes).unwrap().next().unwrap().unwrap();
    let expected = r#"{"timestamp":{"sec":1,"nsec":500000000},"value":1.5,"unit":"A"}"#;
    assert_eq!(str::from_utf8(&message.data).unwrap(), expected);
    let channel = &message.channel;
    assert_eq!((channel.topic.as_str(), channel.message_encoding.as_str()), ("/current_left", "json"));
    let about = [
        ("clock", "0"),
        ("clock_name", "pro_1.csv"),
        ("column", "curL"),
        ("dead_band", "0.59"),
        ("magnitude_only", "true"),
        ("set_point", "false"),
        ("signal", "current_left"),
        ("unit", "A"),
    ];
    let found: Vec<(&str, &str)> = channel.metadata.iter().map(|(key, value)| (key.as_str(), value.as_str())).collect();
    assert_eq!(found, about);
    let schema = channel.schema.as_ref().unwrap();
    assert_eq!((schema.name.as_str(), schema.encoding.as_str()), ("recordings.Sample", "jsonschema"));
    let schema: serde_json::Value = serde_json::from_slice(&schema.data).unwrap();
    let message: serde_json::Value = serde_json::from_slice(&message.data).unwrap();
    let keys = |json: &serde_json::Value| json.as_object().unwrap().keys().cloned().collect::<Vec<_>>();
    assert_eq!(keys(&schema["properties"]), keys(&message));
    assert_eq!(keys(&schema["properties"]["timestamp"]["properties"]), keys(&message["timestamp"]));
}

#[test]
fn mcap_refuses_stamps_before_zero() {
    let error = write_mcap(&one_channel(vec![-5_000_000_000, 1]), &mut Vec::new()).unwrap_err();
    assert_eq!(error.kind(), io::ErrorKind::InvalidInput);
    assert!(error.to_string().starts_with("channel current_left: starts at -5 s; MCAP has no stamps before 0"));
}

#[test]
fn parquet_says_what_it_holds() {
    let mut bytes = Vec::new();
    write_parquet(&one_channel(vec![1, 2]), 0, &mut bytes).unwrap();
    let reader = SerializedFileReader::new(bytes::Bytes::from(bytes)).unwrap();
    let metadata = reader.metadata().file_metadata();
    let about: Vec<(&str, &str)> = metadata
        .key_value_metadata()
        .unwrap()
        .iter()
        .map(|pair| (pair.key.as_str(), pair.value.as_deref().unwrap()))
        .collect();
    let column = "current_left_A";
    assert_eq!(about[..2], [("recording", "run"), ("clock", "pro_1.csv")]);
    let of_column = |key: &str| about.iter().find(|(name, _)| *name == format!("{column}.{key}")).unwrap().1;
    assert_eq!(["signal", "unit", "source"].map(of_column), ["current_left", "A", "curL"]);
}

#[test]
fn long_tables_have_several_row_groups() {
    let run = one_channel((0..(1 << 20) + 10).collect());
    let mut bytes = Vec::new();
    write_parquet(&run, 0, &mut bytes).unwrap();
    let reader = SerializedFileReader::new(bytes::Bytes::from(bytes)).unwrap();
    let rows: Vec<i64> = reader.metadata().row_groups().iter().map(RowGroupMetaData::num_rows).collect();
    assert_eq!(rows, [1 << 20, 10]);
    let last = reader.get_row_group(1).unwrap().get_row_iter(None).unwrap().last().unwrap().unwrap();
    let fields: Vec<String> = last.get_column_iter().map(|(_, field)| field.to_string()).collect();
    assert_eq!(fields[0], "1048585");
}

/// A sink that takes some bytes and then fails.
struct Full(usize);

impl Write for Full {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0 = self.0.checked_sub(bytes.len()).ok_or(io::Error::from(io::ErrorKind::StorageFull))?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_full_disk_is_an_error_wherever_it_fills() {
    let run = one_channel((0..100).collect());
    let to_mcap: &dyn Fn(&mut Full) -> io::Result<()> = &|sink| write_mcap(&run, sink);
    for write in [to_mcap, &|sink| write_parquet(&run, 0, sink)] {
        let mut whole = Full(1 << 20);
        write(&mut whole).unwrap();
        let needed = (1 << 20) - whole.0;
        for room in 0..needed {
            assert_eq!(write(&mut Full(room)).unwrap_err().kind(), io::ErrorKind::StorageFull, "{room} of {needed}");
        }
        write(&mut Full(needed)).unwrap();
    }
}
