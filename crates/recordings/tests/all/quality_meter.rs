//! Sample by sample finds what the whole slice shows.

// Numbers of samples are far below 2^63.
#![allow(clippy::cast_possible_wrap)]

use recordings::{Quality, QualityMeter};

fn metered(t_ns: &[i64], values: &[f64]) -> Quality {
    let mut meter = QualityMeter::default();
    t_ns.iter().zip(values).for_each(|(&t, &value)| meter.push(t, value));
    meter.finish()
}

/// An uneven 100 Hz signal of some blocks on a grid of 0.01, with a period of stamps of its own.
fn signal(samples: usize) -> (Vec<i64>, Vec<f64>) {
    // Scattered over -0.5 to 0.5 (multiplicative hash of Knuth, twice).
    let hash = |i: u64| (i.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 29).wrapping_mul(0xbf58_476d_1ce4_e5b9) >> 11;
    let wiggle = |i: usize| hash(i as u64 + 1) as f64 / (1_u64 << 53) as f64 - 0.5;
    let t_ns = (0..samples).map(|i| i as i64 * 10_000_000 + (wiggle(i) * 400_000.0) as i64).collect();
    let value = |i: usize| ((2.0 * (i as f64 * 0.003).sin() + 0.1 * wiggle(i + 7)) * 100.0).round() / 100.0;
    (t_ns, (0..samples).map(value).collect())
}

#[test]
fn short_signals_are_measured_as_a_whole() {
    for samples in [0, 1, 2, 50, 5000, 65_536] {
        let (t_ns, values) = signal(samples);
        assert_eq!(metered(&t_ns, &values), Quality::measure(&t_ns, &values), "{samples}");
    }
}

#[test]
fn long_signals_keep_counts_and_places_and_come_near_in_medians() {
    let (mut t_ns, mut values) = signal(200_000);
    // Defects in every block, and on and beside the samples at which blocks may end.
    let mut lost = Vec::new();
    for at in [100, 32_767, 32_768, 32_769, 65_534, 65_536, 98_000, 131_072, 199_990] {
        t_ns[at..].iter_mut().for_each(|t| *t += 2_000_000_000);
        lost.push(at);
    }
    for at in [500, 32_700, 70_000, 160_000] {
        t_ns[at] = t_ns[at - 1];
        values[at + 3] = f64::NAN;
    }
    t_ns[120_000..].iter_mut().for_each(|t| *t -= 3_600_000_000_000);
    values[90_000..90_300].fill(1.25);
    (values[77_777], values[188_888]) = (9.0, 9.0);

    let (block, whole) = (metered(&t_ns, &values), Quality::measure(&t_ns, &values));
    let (a, b) = (&block.timing, &whole.timing);
    assert_eq!((a.samples, a.span_ns, a.computed), (b.samples, b.span_ns, b.computed));
    assert_eq!(a.gaps.tally, b.gaps.tally);
    assert_eq!(a.gaps.tally.count, lost.len());
    assert_eq!(a.gaps.tally.first.iter().map(|at| at.sample).collect::<Vec<_>>(), lost[..5]);
    assert_eq!((a.gaps.longest_s, a.gaps.longest_at), (b.gaps.longest_s, b.gaps.longest_at));
    assert!((a.gaps.total_s - b.gaps.total_s).abs() < 1e-9);
    assert_eq!((&a.jumps_back, &a.duplicates, &a.out_of_order), (&b.jumps_back, &b.duplicates, &b.out_of_order));
    assert_eq!((a.jumps_back.count, a.duplicates.count), (1, 4));
    assert_eq!(a.largest_jump_s, b.largest_jump_s);
    let near = |a: f64, b: f64| (a / b - 1.0).abs() < 0.02;
    assert!(near(a.period_s.unwrap(), b.period_s.unwrap()) && near(a.jitter_mad_s, b.jitter_mad_s));
    assert!(near(a.jitter_99_s, b.jitter_99_s), "{} {}", a.jitter_99_s, b.jitter_99_s);
    assert!(near(block.noise.unwrap(), whole.noise.unwrap()), "{:?} {:?}", block.noise, whole.noise);

    let (a, b) = (&block.values, &whole.values);
    assert_eq!((&a.missing, a.longest_missing), (&b.missing, b.longest_missing));
    assert_eq!((a.low, a.high), (b.low, b.high));
    assert_eq!(a.high.map(|high| (high.value, high.samples)), Some((9.0, 2)));
    assert_eq!((&a.stuck, a.longest_stuck), (&b.stuck, b.longest_stuck));
    assert_eq!(a.longest_stuck.map(|(stretch, value)| (stretch.at.sample, value)), Some((90_000, 1.25)));
    let (grid, other) = (block.grid.unwrap(), whole.grid.unwrap());
    assert!((grid.step - 0.01).abs() < 1e-9 && (other.step - 0.01).abs() < 1e-9);
}

#[test]
fn a_missing_or_extreme_value_between_two_blocks_counts_once() {
    for shared in [f64::NAN, 50.0] {
        let (t_ns, mut values) = signal(100_000);
        values[32_000..33_000].fill(shared);
        let (block, whole) = (metered(&t_ns, &values).values, Quality::measure(&t_ns, &values).values);
        assert_eq!(block.missing, whole.missing);
        let samples = |values: &recordings::Values| values.high.map(|high| (high.value, high.samples));
        assert_eq!(samples(&block), samples(&whole));
    }
}

#[test]
fn counters_wrap_across_blocks() {
    let (t_ns, _) = signal(150_000);
    let ticks: Vec<f64> = (0..150_000_u32).map(|i| f64::from((i * 7) as u16)).collect();
    assert_eq!(metered(&t_ns, &ticks).wrap, Quality::measure(&t_ns, &ticks).wrap);
    assert_eq!(metered(&t_ns, &ticks).wrap.unwrap().count, 150_000 * 7 / 65_536);
}
