//! Every cut and every flipped bit of small bags: no panic, nothing wrong, nothing lost in silence.

mod common;

use std::collections::HashMap;

use bags::{FileError, Loss, LossKind};
use common::{Bag, Kept, messages, read};
use mcap::Compression;
use proptest::prelude::*;

/// Twenty messages in several chunks, uncompressed, zstd and lz4.
fn bags() -> [(&'static str, Vec<u8>); 3] {
    let bag = |compression| Bag { compression, ..Bag::default() }.write(&messages(20));
    [("none", bag(None)), ("zstd", bag(Some(Compression::Zstd))), ("lz4", bag(Some(Compression::Lz4)))]
}

/// Fails when a message is not an original one, comes twice or out of order, or when one is missing and nobody says so.
#[track_caller]
fn assert_honest(what: &str, original: &[Kept], result: &Result<(Vec<Kept>, Vec<Loss>), FileError>) {
    let Ok((kept, losses)) = result else { return };
    let place: HashMap<&Kept, usize> = original.iter().enumerate().map(|(index, message)| (message, index)).collect();
    let places: Option<Vec<usize>> = kept.iter().map(|message| place.get(message).copied()).collect();
    let places = places.unwrap_or_else(|| panic!("{what}: a message that was not there: {kept:?}"));
    assert!(places.windows(2).all(|pair| pair[0] < pair[1]), "{what}: {places:?}");
    assert!(kept.len() == original.len() || !losses.is_empty(), "{what}: lost in silence");
}

#[test]
fn whole_bags_read_whole() {
    for (name, bytes) in bags() {
        let (kept, losses) = read(&bytes).unwrap();
        assert_eq!((kept, losses), (messages(20), vec![]), "{name}");
    }
}

#[test]
fn every_cut_is_reported_and_costs_no_whole_chunk() {
    let original = messages(20);
    for (name, bytes) in bags() {
        let mut most = 0;
        for end in 0..bytes.len() {
            let result = read(&bytes[..end]);
            assert_honest(&format!("{name} cut at {end}"), &original, &result);
            let (kept, losses) = result.unwrap();
            assert!(losses.iter().any(|loss| loss.kind == LossKind::CutOff), "{name} cut at {end}: {losses:?}");
            // What was whole stays, however much is cut off behind it.
            assert!(
                kept.len() >= most && kept == original[..kept.len()],
                "{name} cut at {end}: {} {losses:?}",
                kept.len()
            );
            most = kept.len();
        }
        assert_eq!(most, 20, "{name}");
    }
}

#[test]
fn every_flipped_bit_is_reported_or_harmless_and_costs_one_chunk_at_most() {
    let original = messages(20);
    for (name, bytes) in bags() {
        let largest_chunk = {
            let mut reader = mcap::sans_io::linear_reader::LinearReader::new_with_options(
                mcap::sans_io::linear_reader::LinearReaderOptions::default().with_emit_chunks(true),
            );
            largest_chunk(&mut reader, &bytes)
        };
        let mut flipped = bytes.clone();
        let mut told = 0;
        for index in 0..bytes.len() {
            for bit in 0..8 {
                flipped[index] = bytes[index] ^ (1 << bit);
                let result = read(&flipped);
                let what = format!("{name} byte {index} bit {bit}");
                assert_honest(&what, &original, &result);
                let (kept, losses) = result.unwrap();
                assert!(kept.len() + largest_chunk >= original.len(), "{what}: {} {losses:?}", kept.len());
                told += usize::from(!losses.is_empty());
            }
            flipped[index] = bytes[index];
        }
        // With checksums over everything, every flip shows.
        assert_eq!(told, bytes.len() * 8, "{name}");
    }
}

/// Most messages in one chunk.
fn largest_chunk(reader: &mut mcap::sans_io::linear_reader::LinearReader, bytes: &[u8]) -> usize {
    use mcap::sans_io::linear_reader::LinearReadEvent;
    let (mut most, mut since, mut given) = (0, 0, 0);
    while let Some(event) = reader.next_event() {
        match event.unwrap() {
            LinearReadEvent::ReadRequest(ask) => {
                let ask = ask.min(bytes.len() - given);
                reader.insert(ask).copy_from_slice(&bytes[given..given + ask]);
                reader.notify_read(ask);
                given += ask;
            }
            LinearReadEvent::Record { opcode, data } => match mcap::parse_record(opcode, data).unwrap() {
                mcap::records::Record::Chunk { .. } => since = 0,
                mcap::records::Record::MessageIndex(index) => {
                    since += index.records.len();
                    most = most.max(since);
                }
                _ => {}
            },
        }
    }
    assert!(most > 1 && most < 20, "several chunks of several messages are wanted, not {most}");
    most
}

#[test]
fn bags_without_chunks_checksums_or_summary_are_cut_and_flipped_without_panic() {
    let original = messages(6);
    let mut kinds = Vec::new();
    for (chunked, summary, checksums) in [(false, true, true), (false, false, false), (true, false, false)] {
        kinds.push(Bag { chunked, summary, checksums, compression: Some(Compression::Lz4), ..Bag::default() });
    }
    for bag in kinds {
        let bytes = bag.write(&original);
        assert_eq!(read(&bytes).unwrap(), (original.clone(), vec![]));
        for end in 0..bytes.len() {
            let (kept, losses) = read(&bytes[..end]).unwrap();
            assert!(kept == original[..kept.len()] && !losses.is_empty());
        }
        let mut flipped = bytes.clone();
        for index in 0..bytes.len() {
            for bit in 0..8 {
                flipped[index] = bytes[index] ^ (1 << bit);
                let (_, losses) = read(&flipped).unwrap();
                assert!(!bag.checksums || !losses.is_empty(), "byte {index} bit {bit}");
            }
            flipped[index] = bytes[index];
        }
    }
}

#[test]
fn messages_without_a_checksum_are_counted() {
    let unchecked = |bag: Bag| {
        let bytes = bag.write(&messages(20));
        bags::messages("a.mcap", &mut std::io::Cursor::new(&bytes), &mut |_| Ok::<(), FileError>(())).unwrap().unchecked
    };
    assert_eq!(unchecked(Bag::default()), 0);
    assert_eq!(unchecked(Bag { checksums: false, ..Bag::default() }), 20);
    assert_eq!(unchecked(Bag { chunked: false, ..Bag::default() }), 0);
    assert_eq!(unchecked(Bag { chunked: false, checksums: false, ..Bag::default() }), 20);
}

#[test]
fn damage_in_the_middle_leaves_what_is_before_and_behind() {
    let original = messages(200);
    for compression in [None, Some(Compression::Zstd), Some(Compression::Lz4)] {
        let bytes = Bag { compression, ..Bag::default() }.write(&original);
        let mut broken = bytes.clone();
        let middle = bytes.len() / 3;
        // Long enough to reach into a chunk, whatever stands here.
        broken[middle..middle + 600].fill(0xAA);
        let result = read(&broken);
        assert_honest("middle", &original, &result);
        let (kept, losses) = result.unwrap();
        assert_eq!(kept.first(), original.first());
        assert_eq!(kept.last(), original.last());
        let lost = original.len() - kept.len();
        assert!(lost > 0 && lost < 40, "{lost}");
        let missing = losses.iter().find(|loss| loss.kind == LossKind::MissingMessage).unwrap();
        assert_eq!(missing.count, lost);
        let place = losses.iter().find(|loss| !loss.lines.is_empty()).unwrap();
        assert!(place.lines[0] <= middle as u64 && place.lines[0] + 1000 > middle as u64, "{place}");

        // A hole, as a lost block of a disk leaves it.
        let mut holed = bytes[..middle].to_vec();
        holed.extend(&bytes[middle + 600..]);
        let result = read(&holed);
        assert_honest("hole", &original, &result);
        assert_eq!(result.unwrap().0.last(), original.last());
    }
}

proptest! {
    #[test]
    fn pieces_put_together_anyhow_never_panic_and_give_no_wrong_message(
        kind in 0..3_usize,
        pieces in proptest::collection::vec((any::<prop::sample::Index>(), any::<prop::sample::Index>()), 1..6),
        noise in proptest::collection::vec(any::<u8>(), 0..40),
    ) {
        let original = messages(20);
        let bytes = &bags()[kind].1;
        let mut mixed = noise;
        for (from, to) in pieces {
            let (from, to) = (from.index(bytes.len()), to.index(bytes.len()));
            mixed.extend(&bytes[from.min(to)..from.max(to)]);
        }
        for start in [&[][..], mcap::MAGIC] {
            let (kept, losses) = read(&[start, &mixed].concat()).unwrap();
            prop_assert!(kept.iter().all(|message| original.contains(message)));
            prop_assert!(!losses.is_empty());
        }
    }
}

#[test]
fn a_bag_compressed_as_a_whole_gives_what_is_before_its_damage() {
    let original = messages(200);
    let packed = zstd::encode_all(Bag::default().write(&original).as_slice(), 0).unwrap();
    let read = |bytes: &[u8]| {
        let mut kept = Vec::new();
        let passed = bags::messages("a.mcap.zstd", &mut std::io::Cursor::new(bytes), &mut |message| {
            kept.push(common::keep(&message));
            Ok::<(), FileError>(())
        });
        passed.map(|passed| (kept, passed))
    };
    let (kept, passed) = read(&packed).unwrap();
    assert_eq!((kept, passed.losses), (original.clone(), vec![]));
    assert_eq!(passed.bytes, packed.len() as u64);
    for end in (4..packed.len()).step_by(101) {
        let (kept, passed) = read(&packed[..end]).unwrap();
        assert_eq!(kept, original[..kept.len()]);
        assert_eq!(passed.losses[0].kind, LossKind::CutOff);
    }
}

#[test]
fn two_channels_of_one_topic_are_one_topic() {
    let mut bytes = Vec::new();
    let mut writer = mcap::Writer::new(std::io::Cursor::new(&mut bytes)).unwrap();
    let mut nth = 0;
    let ids = [(); 2].map(|()| {
        nth += 1;
        let metadata = std::collections::BTreeMap::from([("publisher".to_owned(), nth.to_string())]);
        writer.add_channel(0, "/a", "json", &metadata).unwrap()
    });
    for (sequence, channel_id) in (0..).zip(ids) {
        let header = mcap::records::MessageHeader { channel_id, sequence, log_time: 1, publish_time: 1 };
        writer.write_to_known_channel(&header, b"{}").unwrap();
    }
    writer.finish().unwrap();
    drop(writer);
    let passed = bags::messages("a.mcap", &mut std::io::Cursor::new(&bytes), &mut |_| Ok::<(), FileError>(())).unwrap();
    assert_ne!(ids[0], ids[1]);
    assert_eq!((passed.topics.len(), passed.losses), (1, vec![]));
}

#[test]
fn lengths_are_never_believed() {
    let original = messages(20);
    for (name, bytes) in bags() {
        for index in 0..bytes.len() - 8 {
            for length in [u64::MAX, 1 << 62, 1 << 40, 1 << 31, 0] {
                let mut wrong = bytes.clone();
                wrong[index..index + 8].copy_from_slice(&length.to_le_bytes());
                assert_honest(&format!("{name} {index} {length}"), &original, &read(&wrong));
            }
        }
    }
}
