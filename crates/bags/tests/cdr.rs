//! Messages written by another library, decoded here and by two other decoders.

use std::borrow::Cow;
use std::io::Cursor;

use bags::{Cell, Field, FieldReader, Topic, TopicContents, contents};
use proptest::prelude::*;
use re_cdr::{BigEndian, CdrReader, LittleEndian};
use re_ros_msg::MessageSchema;
use re_ros_msg::deserialize::primitive_array::PrimitiveArray;
use re_ros_msg::deserialize::{MapResolver, Value, decode_message};
use serde::{Deserialize, Serialize};

const SCHEMA: &str = "\
std_msgs/Header header
bool enabled
int16 code
string note
float64[] velocity
string[] name
uint8 mode
Part[] parts
float32[3] axis
uint64 counter
int32[<=4] few
Part single
int8 last
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
================================================================================
MSG: test_msgs/Part
uint8 KIND_A=1
uint16 id
float64 weight  # kg
";

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Header {
    sec: i32,
    nanosec: u32,
    frame_id: String,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Part {
    id: u16,
    weight: f64,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Status {
    header: Header,
    enabled: bool,
    code: i16,
    note: String,
    velocity: Vec<f64>,
    name: Vec<String>,
    mode: u8,
    parts: Vec<Part>,
    axis: [f32; 3],
    counter: u64,
    few: Vec<i32>,
    single: Part,
    last: i8,
}

fn status() -> impl Strategy<Value = Status> {
    let number = || prop_oneof![-1e6..1e6_f64, any::<f64>().prop_filter("a number", |v| !v.is_nan())];
    let part = move || (any::<u16>(), number()).prop_map(|(id, weight)| Part { id, weight });
    let header = (any::<i32>(), 0..1_000_000_000_u32, "[a-zä]{0,9}").prop_map(|(sec, nanosec, frame_id)| Header {
        sec,
        nanosec,
        frame_id,
    });
    let small = (header, any::<bool>(), any::<i16>(), "[ -~]{0,20}", any::<u8>(), any::<i8>(), any::<u64>());
    let joints = proptest::collection::vec((number(), "[a-z]{1,6}"), 0..5);
    let lists = (joints, proptest::collection::vec(part(), 0..4), proptest::collection::vec(any::<i32>(), 0..5));
    let axis = proptest::array::uniform3(-1e6_f32..1e6);
    (small, lists, axis, part()).prop_map(
        |((header, enabled, code, note, mode, last, counter), (joints, parts, few), axis, single)| {
            let (velocity, name) = joints.into_iter().unzip();
            Status { header, enabled, code, note, velocity, name, mode, parts, axis, counter, few, single, last }
        },
    )
}

fn write(status: &Status, little: bool) -> Vec<u8> {
    let mut bytes = vec![0, u8::from(little), 0, 0];
    bytes.extend(if little {
        cdr_encoding::to_vec::<_, LittleEndian>(status).unwrap()
    } else {
        cdr_encoding::to_vec::<_, BigEndian>(status).unwrap()
    });
    bytes
}

fn topic() -> Topic {
    Topic {
        name: "/status".to_owned(),
        message_type: "test_msgs/msg/Status".to_owned(),
        encoding: "cdr".to_owned(),
        schema_encoding: "ros2msg".to_owned(),
        schema: SCHEMA.as_bytes().into(),
        metadata: std::collections::BTreeMap::default(),
    }
}

const FIELDS: [&str; 16] = [
    "enabled",
    "code",
    "velocity[0]",
    "velocity[3]",
    "mode",
    "parts[1].id",
    "parts[1].weight",
    "axis[0]",
    "axis[2]",
    "counter",
    "few[2]",
    "single.weight",
    "last",
    "velocity[a]",
    "parts[0].weight",
    "velocity[0]",
];

fn expected(status: &Status) -> Vec<Option<f64>> {
    let named = || {
        let mut found = status.name.iter().enumerate().filter(|(_, name)| *name == "a");
        let index = found.next()?.0;
        if found.next().is_none() { status.velocity.get(index).copied() } else { None }
    };
    vec![
        Some(f64::from(u8::from(status.enabled))),
        Some(status.code.into()),
        status.velocity.first().copied(),
        status.velocity.get(3).copied(),
        Some(status.mode.into()),
        status.parts.get(1).map(|part| part.id.into()),
        status.parts.get(1).map(|part| part.weight),
        Some(status.axis[0].into()),
        Some(status.axis[2].into()),
        Some(status.counter as f64),
        status.few.get(2).map(|&few| few.into()),
        Some(status.single.weight),
        Some(status.last.into()),
        named(),
        status.parts.first().map(|part| part.weight),
        status.velocity.first().copied(),
    ]
}

/// The same fields by the decoder of `re_ros_msg`.
fn by_re_ros_msg(bytes: &[u8]) -> Option<Vec<Option<f64>>> {
    let schema = MessageSchema::parse("test_msgs/Status", SCHEMA).unwrap();
    let resolver = MapResolver::new(schema.dependencies.iter().map(|spec| (spec.name.clone(), spec)));
    let value = if bytes[1] == 1 {
        decode_message(&mut CdrReader::<LittleEndian>::new(&bytes[4..]), &schema.spec, &resolver)
    } else {
        decode_message(&mut CdrReader::<BigEndian>::new(&bytes[4..]), &schema.spec, &resolver)
    };
    let Value::Message(root) = value.ok()? else { return None };
    let number = |value: &Value| match value {
        Value::Bool(yes) => f64::from(u8::from(*yes)),
        Value::I8(v) => f64::from(*v),
        Value::U8(v) => f64::from(*v),
        Value::I16(v) => f64::from(*v),
        Value::U16(v) => f64::from(*v),
        Value::I32(v) => f64::from(*v),
        Value::U64(v) => *v as f64,
        Value::F64(v) => *v,
        other => panic!("{other:?}"),
    };
    let item = |name: &str, index: usize| match &root[name] {
        Value::PrimitiveSeq(PrimitiveArray::F64(list)) => list.get(index).copied(),
        Value::PrimitiveSeq(PrimitiveArray::I32(list)) => list.get(index).map(|&v| v.into()),
        Value::PrimitiveArray(PrimitiveArray::F32(list)) => list.get(index).map(|&v| v.into()),
        other => panic!("{other:?}"),
    };
    let inside = |value: &Value, field: &str| match value {
        Value::Message(map) => number(&map[field]),
        other => panic!("{other:?}"),
    };
    let Value::Sequence(parts) = &root["parts"] else { panic!("{root:?}") };
    let Value::PrimitiveSeq(PrimitiveArray::String(names)) = &root["name"] else { panic!("{root:?}") };
    let mut places = (0..names.len()).filter(|&index| names[index] == "a");
    let place = places.next().filter(|_| places.next().is_none());
    Some(vec![
        Some(number(&root["enabled"])),
        Some(number(&root["code"])),
        item("velocity", 0),
        item("velocity", 3),
        Some(number(&root["mode"])),
        parts.get(1).map(|part| inside(part, "id")),
        parts.get(1).map(|part| inside(part, "weight")),
        item("axis", 0),
        item("axis", 2),
        Some(number(&root["counter"])),
        item("few", 2),
        Some(inside(&root["single"], "weight")),
        Some(number(&root["last"])),
        place.and_then(|index| item("velocity", index)),
        parts.first().map(|part| inside(part, "weight")),
        item("velocity", 0),
    ])
}

fn bits(values: &[Option<f64>]) -> Vec<Option<u64>> {
    // NaN is a gap here.
    values.iter().map(|value| value.filter(|v| !v.is_nan()).map(f64::to_bits)).collect()
}

/// The fields of a message as numbers.
fn numbers(reader: &FieldReader, message: &[u8]) -> Option<Vec<Option<f64>>> {
    Some(reader.read(message)?.into_iter().map(Cell::number).collect())
}

proptest! {
    #[test]
    fn three_decoders_agree_with_what_was_written(status in status(), little in any::<bool>()) {
        let bytes = write(&status, little);
        let reader = FieldReader::new(&topic(), &FIELDS).unwrap();
        let ours = numbers(&reader, &bytes).unwrap();
        prop_assert_eq!(bits(&ours), bits(&expected(&status)));
        prop_assert_eq!(bits(&ours), bits(&by_re_ros_msg(&bytes).unwrap()));
        let back: Status = if little {
            cdr_encoding::from_bytes::<_, LittleEndian>(&bytes[4..]).unwrap().0
        } else {
            cdr_encoding::from_bytes::<_, BigEndian>(&bytes[4..]).unwrap().0
        };
        prop_assert_eq!(back, status.clone());

        let exact = FieldReader::new(&topic(), &["header.stamp", "header.stamp.nanosec", "counter"]).unwrap();
        let ns = i64::from(status.header.sec) * 1_000_000_000 + i64::from(status.header.nanosec);
        let whole = [ns.into(), status.header.nanosec.into(), status.counter.into()].map(Cell::Whole);
        prop_assert_eq!(exact.read(&bytes), Some(whole.to_vec()));
    }

    #[test]
    fn a_cut_message_does_not_decode(status in status(), little in any::<bool>(), cut in 1..40_usize) {
        let bytes = write(&status, little);
        let reader = FieldReader::new(&topic(), &FIELDS).unwrap();
        prop_assert_eq!(reader.read(&bytes[..bytes.len().saturating_sub(cut)]), None);
        let mut longer = bytes;
        longer.extend([0; 8]);
        prop_assert_eq!(reader.read(&longer), None);
    }

    #[test]
    fn changed_messages_decode_as_by_the_other_decoder_or_not_at_all(
        status in status(), little in any::<bool>(), changes in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..4)
    ) {
        let mut bytes = write(&status, little);
        for (index, byte) in changes {
            let index = 4 + index.index(bytes.len() - 4);
            bytes[index] = byte;
        }
        let reader = FieldReader::new(&topic(), &FIELDS).unwrap();
        if let (Some(ours), Some(theirs)) = (numbers(&reader, &bytes), by_re_ros_msg(&bytes)) {
            prop_assert_eq!(bits(&ours), bits(&theirs));
        }
    }

    #[test]
    fn arbitrary_bytes_never_panic(bytes in proptest::collection::vec(any::<u8>(), 0..300), schema in "[ -~\n]{0,200}") {
        let reader = FieldReader::new(&topic(), &FIELDS).unwrap();
        let _ = reader.read(&bytes);
        let _ = FieldReader::new(&Topic { schema: schema.into_bytes().into(), ..topic() }, &["data", "header.stamp"]);
    }
}

/// A message without header, its fields one after the other.
fn one(definition: &str, field: &str, body: &[u8]) -> Result<Option<Vec<Option<f64>>>, String> {
    let topic = Topic { schema: definition.as_bytes().into(), ..topic() };
    let bytes: Cow<'_, [u8]> = [&[0, 1, 0, 0], body].concat().into();
    FieldReader::new(&topic, &[field]).map(|reader| numbers(&reader, &bytes)).map_err(|error| error.to_string())
}

#[test]
fn what_cannot_be_read_is_said() {
    let message = |definition, field| one(definition, field, &[]).unwrap_err();
    assert_eq!(message("wstring text\nfloat64 x", "x"), "field `text` is a wstring, which is not read");
    assert_eq!(
        message("float64 velocity", "velocty"),
        "`velocty`: test_msgs/Status has no field `velocty`; did you mean `velocity`?"
    );
    assert_eq!(message("string text", "text"), "`text`: `text` is text, not a number");
    assert_eq!(message("float64[] v", "v"), "`v`: `v` is a list; say which item: v[0]");
    assert_eq!(message("float64[3] v", "v[3]"), "`v[3]`: `v` has at most 3 items, counted from 0");
    assert_eq!(
        message("float64[] v", "v[left]"),
        "`v[left]`: no list of names (name, names, joint_names) stands beside `v`"
    );
    assert_eq!(message("float64 x", "x.y"), "`x.y`: `x` is a number; nothing is inside it");
    assert_eq!(message("geometry_msgs/Vector3 v", "v"), "`v`: `v` is a message; its fields are: x, y, z");
    assert_eq!(message("test_msgs/Other o", "o.x"), "its schema does not define `test_msgs/Other`");
    assert!(message("float64 = = x", "x").starts_with("its schema does not parse"));
    let endless = "A a\n===\nMSG: test_msgs/A\nA a\n";
    assert!(message(endless, "a").ends_with("holds messages within messages without end"));
    let other = |topic: Topic| FieldReader::new(&topic, &["x"]).unwrap_err().to_string();
    assert!(other(Topic { encoding: "protobuf".to_owned(), ..topic() }).contains("only cdr and json are read"));
    assert!(other(Topic { schema_encoding: "omgidl".to_owned(), ..topic() }).contains("only ros2msg is read"));
    assert!(other(Topic { schema: [].into(), ..topic() }).contains("it is not built in"));
}

#[test]
fn small_messages_byte_for_byte() {
    assert_eq!(one("bool a\nuint16 b", "b", &[1, 0, 2, 1]), Ok(Some(vec![Some(258.0)])));
    assert_eq!(one("bool a\nuint16 b", "b", &[2, 0, 2, 1]), Ok(None));
    assert_eq!(one("float64[<=1] v\nuint8 b", "v[0]", &[2, 0, 0, 0, 0, 0, 0, 0]), Ok(None));
    // No alignment where a list is empty.
    assert_eq!(one("float64[] v\nuint8 b", "b", &[0, 0, 0, 0, 7]), Ok(Some(vec![Some(7.0)])));
    assert_eq!(
        one(
            "string[] name\nfloat32[] v",
            "v[b]",
            &[2, 0, 0, 0, 2, 0, 0, 0, 97, 0, 0, 0, 2, 0, 0, 0, 98, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 192, 63]
        ),
        Ok(Some(vec![Some(1.5)]))
    );
    // A length beyond the message.
    assert_eq!(one("uint8[] v", "v[0]", &[255, 255, 255, 255, 1]), Ok(None));
    let nan = [0, 0, 0, 0, 0, 0, 0xF8, 0x7F];
    assert_eq!(one("float64 v", "v", &nan), Ok(Some(vec![None])));
}

/// The bag of these messages and what is inside.
fn inside(messages: &[Vec<u8>]) -> TopicContents {
    let mut out = Cursor::new(Vec::new());
    let mut writer = mcap::WriteOptions::new().create(&mut out).unwrap();
    let schema = writer.add_schema("test_msgs/msg/Status", "ros2msg", SCHEMA.as_bytes()).unwrap();
    let channel_id = writer.add_channel(schema, "/status", "cdr", &std::collections::BTreeMap::new()).unwrap();
    for message in messages {
        let header = mcap::records::MessageHeader { channel_id, sequence: 0, log_time: 5, publish_time: 5 };
        writer.write_to_known_channel(&header, message).unwrap();
    }
    writer.finish().unwrap();
    drop(writer);
    contents("a.mcap", &mut Cursor::new(out.into_inner())).unwrap().topics.remove(0)
}

proptest! {
    #[test]
    fn fields_of_many_messages_are_those_of_each_one_together(
        messages in proptest::collection::vec((status(), 0..40_usize, any::<bool>()), 1..7),
    ) {
        // Some are cut off, so that they do not decode; some are as the one before.
        let mut all: Vec<Vec<u8>> = Vec::new();
        for (status, cut, again) in &messages {
            let bytes = write(status, cut % 2 == 0);
            let keep = if *cut < 30 { bytes.len() } else { bytes.len() * (cut - 30) / 10 };
            all.push(all.last().filter(|_| *again).cloned().unwrap_or_else(|| bytes[..keep].to_vec()));
        }
        let mut expected: Vec<Field> = Vec::new();
        let (mut undecodable, mut stamps) = (0, (0, 0));
        for message in &all {
            let one = inside(std::slice::from_ref(message));
            undecodable += one.undecodable;
            stamps = one.stamps.map_or(stamps, |one| (stamps.0 + one.set, stamps.1 + one.unset));
            for (index, field) in one.fields.unwrap().into_iter().enumerate() {
                let Some(known) = expected.get_mut(index) else {
                    expected.push(field);
                    continue;
                };
                prop_assert_eq!(&known.path, &field.path);
                let both = known.lengths.zip(field.lengths);
                known.lengths = both.map(|(a, b)| (a.0.min(b.0), a.1.max(b.1)));
                let new: Vec<String> = field.names.into_iter().filter(|name| !known.names.contains(name)).collect();
                known.names.extend(new);
            }
        }
        let together = inside(&all);
        prop_assert_eq!(together.fields.unwrap(), expected);
        prop_assert_eq!(together.undecodable, undecodable);
        prop_assert_eq!(together.stamps.map_or((0, 0), |stamps| (stamps.set, stamps.unset)), stamps);
    }
}
