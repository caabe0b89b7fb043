//! A survey finds what reading finds that keeps all samples, and what is inside bags, by one pass.

use std::fmt::Write as _;
use std::io::Cursor;

use crate::common::{Bag, Kept, messages, wheel};
use mcap::Compression;
use recordings::{
    Contents, Fingerprint, Mapping, Opened, Policy, Quality, ReadOptions, contents, contents_of_beginning, read_from,
    survey_from,
};

const MAPPING: &str = r#"
[[files]]
topic = "/wheel"
time = { column = "stamp" }
signals.wheel_speed_left = { column = "speed", unit = "rad/s" }

[[files]]
topic = "/gyro"
time = { column = "log_time" }
signals.gyro_z = { column = "angular_velocity.z", unit = "rad/s" }
"#;

type Files<'a> = [(&'a str, &'a [u8])];

fn opened<'a>(files: &Files<'a>, cursors: &'a mut Vec<Cursor<&'a [u8]>>) -> Vec<Opened<'a>> {
    cursors.extend(files.iter().map(|(_, bytes)| Cursor::new(*bytes)));
    files.iter().zip(cursors).map(|((name, _), source)| Opened { name, source }).collect()
}

/// Surveys and reads; errors, channels, losses and all else must be the same. The number of samples.
#[track_caller]
fn compare(mapping: &Mapping, files: &Files<'_>, policy: Policy) -> usize {
    let options = ReadOptions { policy };
    let (mut some, mut others) = (Vec::new(), Vec::new());
    let survey = survey_from(mapping, "run", &mut opened(files, &mut some), &options);
    let read = read_from(mapping, "run", &mut opened(files, &mut others), &options);
    let (survey, read) = match (survey, read) {
        (Ok(survey), Ok(read)) => (survey, read),
        (survey, read) => {
            let errors = [survey.err().map(|e| e.to_string()), read.err().map(|e| e.to_string())];
            assert_eq!(errors[0], errors[1]);
            return 0;
        }
    };
    assert_eq!((survey.run.as_str(), survey.clocks.as_slice()), ("run", read.recording.clocks()));
    assert_eq!((&survey.losses, &survey.sources, &survey.unused), (&read.losses, &read.sources, &read.unused));
    assert_eq!(survey.channels.len(), read.recording.channels().len());
    for (surveyed, channel) in survey.channels.iter().zip(read.recording.channels()) {
        assert_eq!((surveyed.signal, surveyed.column.as_str()), (channel.signal(), channel.column()));
        assert_eq!((surveyed.clock, surveyed.attributes), (channel.clock(), channel.attributes()));
        assert_eq!(surveyed.quality, Quality::of(channel), "{}", channel.name());
        assert_eq!(surveyed.fingerprint, Fingerprint::of_channel(channel), "{}", channel.name());
    }
    assert_eq!(survey.fingerprint(), Fingerprint::of(&read.recording));
    let bags = files.iter().filter(|(name, _)| recordings::is_bag(name));
    let inside =
        |(name, bytes): &(&str, &[u8])| ((*name).to_owned(), contents(name, &mut Cursor::new(*bytes)).unwrap());
    assert_eq!(survey.contents, bags.map(inside).collect::<Vec<(String, Contents)>>());
    survey.channels.iter().map(|channel| channel.quality.timing.samples).sum()
}

/// Messages of which some are late, twice, never stamped, not numbers or broken.
fn faulty(count: u64) -> Vec<Kept> {
    let mut all = messages(count);
    for at in (10..all.len().saturating_sub(60)).step_by(50) {
        let late = all.remove(at);
        all.insert(at + 20, late);
        all[at + 5] = all[at + 3].clone();
        let (t, topic) = (all[at + 8].1, all[at + 8].0.clone());
        if topic == "/wheel" {
            all[at + 8].2 = wheel(t, f64::NAN);
            all[at + 10].2.truncate(17);
        }
    }
    all
}

#[test]
fn a_survey_is_what_reading_finds_of_bags_whole_or_not() {
    let mapping = Mapping::parse("m.toml", MAPPING).unwrap();
    let all = faulty(9000);
    for compression in [None, Some(Compression::Zstd), Some(Compression::Lz4)] {
        let bytes = Bag { compression, chunk_size: 4000, ..Bag::default() }.write(&all);
        let mut damaged = bytes.clone();
        damaged[bytes.len() / 3..bytes.len() / 3 + 40].fill(0xA5);
        let cut = &bytes[..bytes.len() / 2];
        for policy in [Policy::Strict, Policy::Normal, Policy::Tolerant] {
            let samples = [&bytes, &damaged, cut].map(|bytes| compare(&mapping, &[("a.mcap", bytes)], policy));
            let strict = policy == Policy::Strict;
            assert!(strict || samples[0] > 8000 && samples[1] > 5000 && samples[2] > 2000, "{samples:?}");
        }
    }
}

#[test]
fn parts_of_a_bag_are_one_run_and_each_is_looked_into() {
    let mapping = Mapping::parse("m.toml", MAPPING).unwrap();
    let all = faulty(4000);
    let parts = [&all[..1500], &all[1500..]].map(|part| Bag::default().write(part));
    let files = [("x/walk/walk_0.mcap", parts[0].as_slice()), ("x/walk/walk_1.mcap", &parts[1])];
    assert!(compare(&mapping, &files, Policy::Normal) > 3500);
}

#[test]
fn tables_are_surveyed_too() {
    let mapping = Mapping::built_in("skid-steer-columns").unwrap();
    let mut text = "time_s,gyro_z_rad_s,torque_left_Nm\n".to_owned();
    for i in 0..3000 {
        let torque = if i % 3 == 0 { "" } else { "2.5" };
        writeln!(text, "{},{},{torque}", f64::from(i) * 0.01, f64::from(i % 17)).unwrap();
    }
    assert_eq!(compare(&mapping, &[("run_1.csv", text.as_bytes())], Policy::Normal), 5000);
    text += "1,2\n";
    assert_eq!(compare(&mapping, &[("run_1.csv", text.as_bytes())], Policy::Normal), 5000);
    assert_eq!(compare(&mapping, &[("run_1.csv", text.as_bytes())], Policy::Strict), 0);
    assert_eq!(compare(&mapping, &[("run_1.csv", b"time_s,wz\n0,1\n")], Policy::Normal), 0);
}

#[test]
fn a_beginning_is_read_as_a_file_that_ends_there() {
    let bytes = Bag::default().write(&messages(400));
    let of = |most: usize| contents_of_beginning("a.mcap", &mut Cursor::new(&bytes), most as u64).unwrap();
    assert_eq!(of(bytes.len()), contents("a.mcap", &mut Cursor::new(&bytes)).unwrap());
    assert_eq!(of(bytes.len() + 1), of(bytes.len()));
    for most in [100, 5000, bytes.len() / 2, bytes.len() - 1] {
        assert_eq!(of(most), contents("a.mcap", &mut Cursor::new(&bytes[..most])).unwrap(), "{most}");
    }
    let half = of(bytes.len() / 2);
    assert!((80..200).contains(&half.topics[0].count), "{half:?}");
}
