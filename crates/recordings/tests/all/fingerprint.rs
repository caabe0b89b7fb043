//! The same data have the same fingerprint whatever the file, the format and the time of day; other data have not.

use proptest::prelude::*;
use recordings::{
    Channel, Clock, Fingerprint, Input, Mapping, ReadOptions, Recording, Signal, group_by_content, read, write_csv,
};

/// A wave with its own shape per seed.
fn samples(seed: u64, count: u32) -> (Vec<i64>, Vec<f64>) {
    let shape = 0.1 + (seed % 1000) as f64 * 1e-3;
    let t_ns = (0..count).map(|i| i64::from(i) * 153_846_154 / 10).collect();
    (t_ns, (0..count).map(|i| (f64::from(i) * shape).sin() + (f64::from(i) * 0.7 * shape).cos()).collect())
}

fn print((t_ns, values): &(Vec<i64>, Vec<f64>)) -> Fingerprint {
    Fingerprint::of_samples(t_ns, values)
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(64) })]

    #[test]
    fn another_time_of_day_is_the_same(seed in any::<u64>(), offset in -1_000_000_000_i64..1_800_000_000_000_000_000) {
        let (t_ns, values) = samples(seed, 400);
        let later = t_ns.iter().map(|t| t + offset).collect();
        prop_assert_eq!(print(&(t_ns, values.clone())), print(&(later, values)));
    }

    #[test]
    fn rounding_by_a_format_changes_little(seed in any::<u64>(), offset_s in 0..2_000_000_000_u32) {
        let run = samples(seed, 2000);
        let seconds = |t: &i64| ((*t as f64 * 1e-9 + f64::from(offset_s)) * 1e9).round() as i64;
        let in_doubles = (run.0.iter().map(seconds).collect(), run.1.iter().map(|x| x / 3.0 * 3.0).collect());
        prop_assert!(print(&run).shared(&print(&in_doubles)) > 0.9);
        let single = (run.0.clone(), run.1.iter().map(|&x| f64::from(x as f32)).collect());
        prop_assert!(print(&run).shared(&print(&single)) > 0.6);
    }

    #[test]
    fn a_part_is_found_in_the_whole(seed in any::<u64>(), from in 0..3000_usize, count in 300..1000_usize) {
        let run = samples(seed, 4000);
        let part = (run.0[from..from + count].to_vec(), run.1[from..from + count].to_vec());
        prop_assert!(print(&run).shared(&print(&part)) > 0.98);
        prop_assert!(print(&part).is_same(&print(&run)));
    }

    #[test]
    fn other_data_share_nothing(seed in any::<u64>(), other in 1..999_u64) {
        let (run, other) = (samples(seed, 1000), samples((seed % 1000).wrapping_add(other), 1000));
        prop_assert_eq!(print(&run).shared(&print(&other)), 0.0);
        // The same values at another rate are other data too.
        let slower = (run.0.iter().map(|t| t * 2).collect(), run.1.clone());
        prop_assert_eq!(print(&run).shared(&print(&slower)), 0.0);
    }

    #[test]
    fn any_samples_give_a_fingerprint(
        t_ns in proptest::collection::vec(any::<i64>(), 0..50),
        values in proptest::collection::vec(any::<f64>(), 0..50),
    ) {
        let print = Fingerprint::of_samples(&t_ns, &values);
        prop_assert_eq!(print.shared(&print), if print.says_nothing() { 0.0 } else { 1.0 });
    }
}

#[test]
fn round_stamps_are_not_torn_by_the_rounding_of_seconds() {
    let run = ((0..2000).map(|i| i * 10_000_000).collect::<Vec<i64>>(), samples(1, 2000).1);
    let since_1970 = |t: &i64| ((*t as f64 * 1e-9 + 1.7e9) * 1e9) as i64;
    let in_doubles = (run.0.iter().map(since_1970).collect::<Vec<i64>>(), run.1.clone());
    assert_ne!(run.0.iter().map(|t| t + 1_700_000_000_000_000_000).collect::<Vec<_>>(), in_doubles.0);
    assert!(print(&run).shared(&print(&in_doubles)) > 0.99);
}

#[test]
fn what_hardly_changes_says_nothing() {
    let t_ns: Vec<i64> = (0..1000).map(|i| i * 1_000_000).collect();
    let switch: Vec<f64> = (0..1000).map(|i| f64::from(i / 300)).collect();
    for values in [vec![1.5; 1000], switch, vec![f64::NAN; 1000]] {
        let print = Fingerprint::of_samples(&t_ns, &values);
        assert!(print.says_nothing());
        assert!(!print.is_same(&print));
    }
}

#[test]
fn long_runs_are_thinned_and_still_recognised() {
    let run = samples(5, 100_000);
    let part = (run.0[20_000..40_000].to_vec(), run.1[20_000..40_000].to_vec());
    let (whole, part) = (print(&run), print(&part));
    assert!(whole.shared(&part) > 0.98 && part.shared(&whole) > 0.98);
    assert_eq!(whole.shared(&print(&samples(900, 100_000))), 0.0);
    assert_eq!(Fingerprint::union([whole.clone(), part]), whole);
}

fn recording(seed: u64, offset_ns: i64) -> Recording {
    let clock = Clock { name: "a".to_owned(), nominal_rate_hz: None };
    let channel = |signal, seed| {
        let (t_ns, values) = samples(seed, 300);
        Channel::new(signal, 0, t_ns.iter().map(|t| t + offset_ns).collect(), values).unwrap()
    };
    let channels = vec![channel(Signal::GyroZ, seed), channel(Signal::WheelSpeedLeft, seed + 1)];
    Recording::new("r", vec![clock], channels).unwrap()
}

#[test]
fn a_recording_is_recognised_after_a_format_and_grouped() {
    let original = recording(3, 0);
    let text = write_csv(&recording(3, 1_700_000_000_000_000_000), 0);
    let mapping = Mapping::built_in("skid-steer-columns").unwrap();
    let input = Input { name: "b.csv", bytes: text.as_bytes() };
    let copy = read(&mapping, "b", &[input], &ReadOptions::default()).unwrap().recording;
    assert_eq!(Fingerprint::of(&original), Fingerprint::of(&copy));
    let prints = [&original, &recording(500, 0), &copy, &recording(700, 0)].map(Fingerprint::of);
    assert_eq!(group_by_content(&prints), [vec![0, 2], vec![1], vec![3]]);
    assert_eq!(group_by_content(&[]), Vec::<Vec<usize>>::new());
}
