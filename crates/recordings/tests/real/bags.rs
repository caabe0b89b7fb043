//! The real bags that lie beside the workspace against the CSV that they came from, value for value; ignored
//! where they do not lie there.

use std::collections::HashMap;
use std::fs::{self, File};
use std::path::{Path, PathBuf};

use bags::{Cell, FieldReader, FileError};
use recordings::{Channel, Mapping, Opened, Policy, Read, ReadOptions, Signal, Topic, contents, messages, read_from};
use skipping::{Outcome, Skipped, beside};

/// Radians of a Kobuki wheel in one tick of its encoder, as its maker's driver has it: metres per tick over the radius.
const RADIANS_PER_TICK: f64 = 8.529_209_049_773_756e-5 / WHEEL_RADIUS;
const WHEEL_RADIUS: f64 = 0.035;
const TRACK: f64 = 0.23;
/// Start of the bags' stamps, ns.
const START_NS: i64 = 1_700_000_000_000_000_000;

fn data() -> Result<PathBuf, Skipped> {
    beside("data")
}

fn read_bag(mapping: &Mapping, path: &Path) -> Read {
    let mut file = File::open(path).unwrap();
    let name = path.display().to_string();
    let mut inputs = [Opened { name: &name, source: &mut file }];
    read_from(mapping, "run", &mut inputs, &ReadOptions { policy: Policy::Strict }).unwrap()
}

/// The columns of a CSV file.
fn columns(path: &Path) -> HashMap<String, Vec<f64>> {
    let mut reader = csv::Reader::from_path(path).unwrap();
    let names: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
    let mut columns: HashMap<String, Vec<f64>> = names.iter().map(|name| (name.clone(), Vec::new())).collect();
    for record in reader.records() {
        for (name, cell) in names.iter().zip(record.unwrap().iter()) {
            columns.get_mut(name).unwrap().push(cell.parse().unwrap());
        }
    }
    columns
}

/// The stamps that the bags' writer made of seconds.
fn stamps(seconds: &[f64]) -> Vec<i64> {
    seconds.iter().map(|t| START_NS + (t * 1e9) as i64).collect()
}

fn channel(read: &Read, signal: Signal) -> &Channel {
    read.recording.require(signal).unwrap()
}

#[track_caller]
fn assert_same(channel: &Channel, t_ns: &[i64], values: &[f64]) {
    assert_eq!(channel.len(), t_ns.len(), "{}", channel.name());
    for (index, (t, value)) in channel.samples().enumerate() {
        assert_eq!(t, t_ns[index], "{} {index}", channel.name());
        assert_eq!(value.to_bits(), (values[index] + 0.0).to_bits(), "{} {index}: {value}", channel.name());
    }
}

/// Encoder counts of 16 bits as angles since the start.
fn angles(ticks: &[f64]) -> Vec<f64> {
    let mut whole = 0.0;
    let steps = ticks.windows(2).map(|pair| {
        whole += (pair[1] - pair[0] + 32_768.0).rem_euclid(65_536.0) - 32_768.0;
        whole * RADIANS_PER_TICK
    });
    std::iter::once(0.0).chain(steps).collect()
}

/// Slopes of second order on uneven steps, of first order at the ends.
fn slopes(t: &[f64], x: &[f64]) -> Vec<f64> {
    let last = t.len() - 1;
    let slope = |i: usize| match i {
        0 => (x[1] - x[0]) / (t[1] - t[0]),
        i if i == last => (x[i] - x[i - 1]) / (t[i] - t[i - 1]),
        i => {
            let (before, after) = (t[i] - t[i - 1], t[i + 1] - t[i]);
            let a = -after / (before * (before + after));
            let b = (after - before) / (before * after);
            let c = before / (after * (before + after));
            a * x[i - 1] + b * x[i] + c * x[i + 1]
        }
    };
    (0..t.len()).map(slope).collect()
}

const KOBUKI: [&str; 3] = [
    "kobuki_run_a_sqlite3/kobuki_run_a_sqlite3.db3",
    "kobuki_run_a_mcap/kobuki_run_a_mcap.mcap",
    "kobuki_run_a_mcap_zstd/kobuki_run_a_mcap_zstd.mcap",
];

pub(crate) fn kobuki_wheels_currents_and_gyro_are_those_of_the_csv() -> Outcome {
    let data = data()?;
    let core = columns(&data.join("kobuki/run-a/core.csv"));
    let imu = columns(&data.join("kobuki/run-a/imu.csv"));
    let mapping = Mapping::built_in("kobuki-bag").unwrap();
    for bag in KOBUKI {
        let read = read_bag(&mapping, &data.join("ros2-bags").join(bag));
        assert!(read.losses.is_empty(), "{bag}: {:?}", read.losses);
        assert_eq!(read.sources[0].sha256.len(), 64);
        let mut unused: Vec<&str> = read.unused.iter().map(|unused| unused.column.as_str()).collect();
        unused.sort_unstable();
        assert_eq!(unused, ["/cmd_vel", "/odom"], "{bag}");
        let count = channel(&read, Signal::WheelAngleLeft).len();
        assert_eq!(count, 1999);
        let t = &core["t"][..count];
        let t_ns = stamps(t);
        let sides = [
            ("left", Signal::WheelAngleLeft, Signal::WheelSpeedLeft, Signal::CurrentLeft),
            ("right", Signal::WheelAngleRight, Signal::WheelSpeedRight, Signal::CurrentRight),
        ];
        for (side, angle, speed, current) in sides {
            let x = angles(&core[&format!("{side}_encoder")]);
            assert_same(channel(&read, angle), &t_ns, &x[..count]);
            assert_same(channel(&read, speed), &t_ns, &slopes(&core["t"], &x)[..count]);
            let amps: Vec<f64> = core[&format!("{side}_current_10mA")][..count].iter().map(|i| i * 0.01).collect();
            assert_same(channel(&read, current), &t_ns, &amps);
            assert!(channel(&read, current).attributes().magnitude_only);
        }
        assert_same(channel(&read, Signal::GyroZ), &stamps(&imu["t"][..1896]), &imu["wz"][..1896]);
        assert_eq!(read.recording.clocks().len(), 1);
    }
    Ok(())
}

/// Commands and odometry under other signals, for their numbers' sake.
const ODOMETRY: &str = r#"
[[files]]
topic = "/odom"
time = { column = "header.stamp" }
[files.signals]
pose_x = { column = "pose.pose.position.x", unit = "m" }
pose_y = { column = "pose.pose.position.y", unit = "m" }
body_vx = { column = "twist.twist.linear.x", unit = "m/s" }
gyro_z = { column = "twist.twist.angular.z", unit = "rad/s" }
gyro_x = { column = "pose.pose.orientation.z", unit = "rad/s" }
gyro_y = { column = "pose.pose.orientation.w", unit = "rad/s" }

[[files]]
topic = "/cmd_vel"
time = { column = "log_time" }
[files.signals]
body_vy = { column = "twist.linear.x", unit = "m/s" }
wheel_speed_left = { column = "twist.angular.z", unit = "rad/s" }

[[files]]
topic = "/joint_states"
time = { column = "log_time" }
[files.signals]
wheel_angle_left = { column = "position[0]", unit = "rad" }
wheel_angle_right = { column = "position[1]", unit = "rad" }
"#;

pub(crate) fn kobuki_commands_and_odometry_are_those_of_the_csv() -> Outcome {
    let data = data()?;
    let core = columns(&data.join("kobuki/run-a/core.csv"));
    let commands = columns(&data.join("kobuki/run-a/cmd.csv"));
    let mapping = Mapping::parse("odometry", ODOMETRY).unwrap();
    for bag in KOBUKI {
        let read = read_bag(&mapping, &data.join("ros2-bags").join(bag));
        assert!(read.losses.is_empty(), "{bag}: {:?}", read.losses);
        let sent = stamps(&commands["t_recv"][..627]);
        assert_same(channel(&read, Signal::BodyVy), &sent, &commands["v_cmd"][..627]);
        assert_same(channel(&read, Signal::WheelSpeedLeft), &sent, &commands["w_cmd"][..627]);

        let t = &core["t"][..1999];
        let [left, right] = ["left", "right"].map(|side| angles(&core[&format!("{side}_encoder")]));
        assert_same(channel(&read, Signal::WheelAngleLeft), &stamps(t), &left[..1999]);
        assert_same(channel(&read, Signal::WheelAngleRight), &stamps(t), &right[..1999]);
        let [mut vl, mut vr] = [slopes(&core["t"], &left), slopes(&core["t"], &right)];
        vl.truncate(1999);
        vr.truncate(1999);
        let forward: Vec<f64> = vl.iter().zip(&vr).map(|(l, r)| WHEEL_RADIUS * (l + r) / 2.0).collect();
        let turning: Vec<f64> = vl.iter().zip(&vr).map(|(l, r)| WHEEL_RADIUS * (r - l) / TRACK).collect();
        assert_same(channel(&read, Signal::BodyVx), &stamps(t), &forward);
        assert_same(channel(&read, Signal::GyroZ), &stamps(t), &turning);
        let values = |signal| channel(&read, signal).values();
        let (mut x, mut y, mut heading) = (0.0, 0.0, 0.0_f64);
        for i in 1..1999 {
            let (l, r) = (WHEEL_RADIUS * (left[i] - left[i - 1]), WHEEL_RADIUS * (right[i] - right[i - 1]));
            heading += (r - l) / TRACK;
            x += f64::midpoint(l, r) * heading.cos();
            y += f64::midpoint(l, r) * heading.sin();
            // Sines and cosines may differ in their last bit from machine to machine.
            assert!((values(Signal::PoseX)[i] - x).abs() < 1e-12, "{bag} {i}");
            assert!((values(Signal::PoseY)[i] - y).abs() < 1e-12, "{bag} {i}");
            let yaw = 2.0 * values(Signal::GyroX)[i].atan2(values(Signal::GyroY)[i]);
            assert!((yaw - heading).sin().abs() < 1e-12, "{bag} {i}");
        }
    }
    Ok(())
}

pub(crate) fn husky_speeds_currents_and_imu_are_those_of_the_csv() -> Outcome {
    let data = data()?;
    let drives = columns(&data.join("husky-open/ASPHALT/pro_00.csv"));
    let imu = columns(&data.join("husky-open/ASPHALT/imu_00.csv"));
    let mapping = Mapping::built_in("husky-bag").unwrap();
    let read = read_bag(&mapping, &data.join("ros2-bags/husky_asphalt_00_mcap/husky_asphalt_00_mcap.mcap"));
    assert!(read.losses.is_empty() && read.unused.is_empty(), "{:?}", read.losses);
    let t_ns = stamps(&drives["time"]);
    assert_eq!((t_ns.len(), imu["time"].len()), (338, 5186));
    assert_same(channel(&read, Signal::CurrentLeft), &t_ns, &drives["curL"]);
    assert_same(channel(&read, Signal::CurrentRight), &t_ns, &drives["curR"]);
    for (column, signal) in [("velL", Signal::CommandSpeedLeft), ("velR", Signal::CommandSpeedRight)] {
        let speeds: Vec<f64> = drives[column].iter().map(|v| v / 0.1651).collect();
        assert_same(channel(&read, signal), &t_ns, &speeds);
    }
    let t_ns = stamps(&imu["time"]);
    let axes = [("wx", Signal::GyroX), ("wy", Signal::GyroY), ("wz", Signal::GyroZ)];
    let forces = [("ax", Signal::AccelX), ("ay", Signal::AccelY), ("az", Signal::AccelZ)];
    for (column, signal) in axes.into_iter().chain(forces) {
        assert_same(channel(&read, signal), &t_ns, &imu[column]);
    }
    assert_eq!(channel(&read, Signal::GyroZ).column(), "/imu/data.angular_velocity.z");
    let rates: Vec<_> = read.recording.clocks().iter().map(|clock| clock.nominal_rate_hz).collect();
    assert_eq!(rates, [Some(6.5), Some(100.0)]);
    Ok(())
}

pub(crate) fn the_contents_are_those_that_the_bags_describe() -> Outcome {
    let data = data()?;
    for bag in KOBUKI {
        let path = data.join("ros2-bags").join(bag);
        let inside = contents(bag, &mut File::open(&path).unwrap()).unwrap();
        assert!(inside.losses.is_empty(), "{bag}: {:?}", inside.losses);
        assert_eq!(inside.bytes, fs::metadata(&path).unwrap().len());
        let mut counts: Vec<(&str, u64)> = inside.topics.iter().map(|topic| (&*topic.name, topic.count)).collect();
        counts.sort_unstable();
        assert_eq!(counts, [("/cmd_vel", 627), ("/imu/data", 1896), ("/joint_states", 1999), ("/odom", 1999)]);
        let joints = inside.topics.iter().find(|topic| topic.name == "/joint_states").unwrap();
        assert_eq!(joints.log_time_ns, (START_NS, START_NS + 39_999_839_000));
        let fields = joints.fields.as_ref().unwrap();
        let paths: Vec<&str> = fields.iter().map(|field| field.path.as_str()).collect();
        assert_eq!(paths, ["header.stamp", "position", "velocity", "effort"]);
        assert_eq!((fields[2].lengths, &fields[2].names[1]), (Some((2, 2)), &"wheel_right_joint".to_owned()));
    }
    Ok(())
}

pub(crate) fn built_in_definitions_decode_as_those_in_the_bags() -> Outcome {
    let data = data()?;
    let path = data.join("ros2-bags").join(KOBUKI[1]);
    let inside = contents("kobuki", &mut File::open(&path).unwrap()).unwrap();
    let mut readers: HashMap<String, [FieldReader; 2]> = HashMap::new();
    let mut compared = 0;
    messages("kobuki", &mut File::open(&path).unwrap(), &mut |message| {
        let topic = message.topic;
        let [own, built_in] = readers.entry(topic.name.clone()).or_insert_with(|| {
            let fields = inside.topics.iter().find(|other| other.name == topic.name).unwrap().fields.as_ref().unwrap();
            let paths: Vec<String> = fields
                .iter()
                .map(|field| if field.lengths.is_some() { format!("{}[1]", field.path) } else { field.path.clone() })
                .collect();
            let paths: Vec<&str> = paths.iter().map(String::as_str).collect();
            let bare = Topic { schema: [].into(), ..topic.clone() };
            [topic, &bare].map(|topic| FieldReader::new(topic, &paths).unwrap())
        });
        let values = own.read(message.bytes).unwrap();
        assert!(values.iter().any(|value| *value != Cell::Gap));
        assert_eq!(Some(values), built_in.read(message.bytes));
        compared += 1;
        Ok::<(), FileError>(())
    })
    .unwrap();
    assert_eq!((compared, readers.len()), (6521, 4));
    Ok(())
}
