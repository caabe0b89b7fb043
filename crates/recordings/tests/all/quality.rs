//! Each defect is planted in a clean signal and found there, where it is; in the clean signal nothing is found.

// Numbers of samples are far below 2^63.
#![allow(clippy::cast_possible_wrap)]

use proptest::prelude::*;
use recordings::{FindingKind, Quality, Severity};

/// Numbers that look random, in -1 to 1, the same for the same seed and index.
fn random(seed: u64, index: usize) -> f64 {
    let mut z = (seed ^ (index as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15)).wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (z >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

/// Near enough normal noise of standard deviation 1.
fn normal(seed: u64, index: usize) -> f64 {
    let sum: f64 = (0..12).map(|part| random(seed, 12 * index + part)).sum();
    sum / 2.0
}

const NOISE: f64 = 0.02;
const PERIOD_NS: i64 = 10_000_000;
const SAMPLES: usize = 2000;

/// A slow wave with noise, stamped at 100 Hz with 1 % of jitter.
fn clean(seed: u64) -> (Vec<i64>, Vec<f64>) {
    let t_ns = (0..SAMPLES).map(|i| i as i64 * PERIOD_NS + (random(seed, i) * 100_000.0) as i64).collect();
    let wave = |i: usize| 2.0 * (i as f64 * 0.01).sin() + 3.0 + NOISE * normal(seed + 1, i);
    (t_ns, (0..SAMPLES).map(wave).collect())
}

fn kinds(t_ns: &[i64], values: &[f64]) -> Vec<FindingKind> {
    Quality::measure(t_ns, values).findings("m/s").iter().map(|finding| finding.kind).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(48) })]

    #[test]
    fn in_a_clean_signal_nothing_is_found(seed in any::<u64>()) {
        let (t_ns, values) = clean(seed >> 1);
        let quality = Quality::measure(&t_ns, &values);
        prop_assert_eq!(quality.findings("m/s"), []);
        prop_assert_eq!((quality.grid, quality.wrap), (None, None));
        let rate = quality.timing.rate_hz().unwrap();
        prop_assert!((rate / 100.0 - 1.0).abs() < 1e-3, "{}", rate);
        // Differences of two uniform errors of ±0.1 ms: 99 % are below 0.18 ms, half below 0.0586 ms.
        prop_assert!((quality.timing.jitter_99_s / 1.8e-4 - 1.0).abs() < 0.1, "{}", quality.timing.jitter_99_s);
        prop_assert!((quality.timing.jitter_mad_s / 5.86e-5 - 1.0).abs() < 0.15, "{}", quality.timing.jitter_mad_s);
        let noise = quality.noise.unwrap();
        prop_assert!((noise / NOISE - 1.0).abs() < 0.1, "{}", noise);
    }

    #[test]
    fn gaps_are_counted_and_placed(seed in 0..1000_u64, at in 100..900_usize, lost in 3..400_usize) {
        let (mut t_ns, mut values) = clean(seed);
        for from in [1000 + at, at] {
            t_ns.drain(from..from + lost.min(900 - at + 3));
            values.drain(from..from + lost.min(900 - at + 3));
        }
        let lost = lost.min(900 - at + 3);
        let gaps = Quality::measure(&t_ns, &values).timing.gaps;
        prop_assert_eq!(gaps.tally.count, 2);
        let places: Vec<usize> = gaps.tally.first.iter().map(|place| place.sample).collect();
        prop_assert_eq!(places, [at, 1000 + at - lost]);
        prop_assert!((gaps.longest_s - (lost + 1) as f64 * 0.01).abs() < 3e-4);
        prop_assert_eq!(kinds(&t_ns, &values), [FindingKind::Gaps]);
    }

    #[test]
    fn a_clock_that_is_set_back_is_found(seed in 0..1000_u64, at in 100..1900_usize, back_s in 1..100_000_i64) {
        let (mut t_ns, values) = clean(seed);
        t_ns[at..].iter_mut().for_each(|t| *t -= back_s * 1_000_000_000);
        let timing = Quality::measure(&t_ns, &values).timing;
        prop_assert_eq!((timing.jumps_back.count, timing.jumps_back.first[0].sample), (1, at));
        prop_assert!((timing.largest_jump_s + back_s as f64).abs() < 0.02);
        prop_assert_eq!(kinds(&t_ns, &values), [FindingKind::JumpsBack]);
    }

    #[test]
    fn a_clock_that_is_set_ahead_is_no_gap(seed in 0..1000_u64, at in 100..1900_usize, ahead_s in 3..1000_i64) {
        // A way that is covered steadily shows whether time passed.
        let (mut t_ns, _) = clean(seed);
        let way: Vec<f64> = (0..SAMPLES).map(|i| i as f64 * 0.01 + 1e-4 * normal(seed, i)).collect();
        t_ns[at..].iter_mut().for_each(|t| *t += ahead_s * 1_000_000_000);
        prop_assert_eq!(kinds(&t_ns, &way), [FindingKind::JumpsAhead]);
        let timing = Quality::measure(&t_ns, &way).timing;
        prop_assert_eq!((timing.jumps_ahead.count, timing.jumps_ahead.first[0].sample), (1, at));
        prop_assert!((timing.largest_jump_s - ahead_s as f64).abs() < 0.02);

        // The same step with the way that belongs to it is a gap.
        let mut moved = way.clone();
        moved[at..].iter_mut().for_each(|x| *x += ahead_s as f64);
        prop_assert_eq!(kinds(&t_ns, &moved), [FindingKind::Gaps]);
    }

    #[test]
    fn repeated_and_reordered_stamps_are_counted(seed in 0..1000_u64, at in 100..900_usize) {
        let (mut t_ns, mut values) = clean(seed);
        t_ns[at] = t_ns[at - 1];
        t_ns.swap(at + 500, at + 501);
        values.swap(at + 500, at + 501);
        let timing = Quality::measure(&t_ns, &values).timing;
        prop_assert_eq!((timing.duplicates.count, timing.duplicates.first[0].sample), (1, at));
        prop_assert_eq!((timing.out_of_order.count, timing.out_of_order.first[0].sample), (1, at + 501));
        prop_assert_eq!(kinds(&t_ns, &values), [FindingKind::OutOfOrder, FindingKind::Duplicates]);
        // Three that come after the three that follow them.
        t_ns[at + 600..at + 606].rotate_left(3);
        values[at + 600..at + 606].rotate_left(3);
        let timing = Quality::measure(&t_ns, &values).timing;
        prop_assert_eq!((timing.out_of_order.count, timing.out_of_order.first[1].sample), (4, at + 603));
        prop_assert_eq!((timing.jumps_back.count, timing.gaps.tally.count), (0, 0));
    }

    #[test]
    fn one_wrong_stamp_is_no_gap(seed in 0..1000_u64, at in 100..1900_usize, off_s in 1..1000_i64) {
        let (mut t_ns, values) = clean(seed);
        t_ns[at] += off_s * 1_000_000_000;
        let timing = Quality::measure(&t_ns, &values).timing;
        prop_assert_eq!((timing.gaps.tally.count, timing.jumps_ahead.count, timing.jumps_back.count), (0, 1, 1));
    }

    #[test]
    fn samples_that_waited_are_no_gap(seed in 0..1000_u64, at in 100..1900_usize, waited in 4..60_usize) {
        let (mut t_ns, values) = clean(seed);
        let end = (at + waited).min(SAMPLES);
        let arrival = t_ns[end - 1];
        (at..end).for_each(|i| t_ns[i] = arrival + (i - at) as i64 * 10_000);
        let timing = Quality::measure(&t_ns[..end], &values[..end]).timing;
        prop_assert_eq!((timing.late.count, timing.gaps.tally.count), (1, 0));
        prop_assert_eq!(timing.late.first[0].sample, at);
    }

    #[test]
    fn missing_values_are_counted(seed in 0..1000_u64, at in 100..1900_usize, lost in 1..50_usize) {
        let (t_ns, mut values) = clean(seed);
        values[at..at + lost].fill(f64::NAN);
        values[3] = f64::INFINITY;
        let quality = Quality::measure(&t_ns, &values);
        prop_assert_eq!(quality.values.missing.count, lost + 1);
        prop_assert_eq!(quality.values.missing.first[1].sample, at);
        prop_assert_eq!(quality.values.longest_missing.unwrap().samples, lost);
        prop_assert_eq!(kinds(&t_ns, &values), [FindingKind::Missing]);
    }

    #[test]
    fn a_stuck_value_is_found(seed in 0..1000_u64, at in 100..1900_usize, held in 12..90_usize) {
        let (t_ns, mut values) = clean(seed);
        let value = values[at];
        // What is held where the signal turns back is clipped, for all that anyone can tell.
        prop_assume!((value - 3.0).abs() < 1.8);
        values[at..at + held].fill(value);
        let findings = Quality::measure(&t_ns, &values).findings("m/s");
        prop_assert_eq!(findings.len(), 1);
        prop_assert_eq!((findings[0].kind, findings[0].severity), (FindingKind::Stuck, Severity::Warning));
        prop_assert_eq!(findings[0].at.map(|place| place.sample), Some(at));
        prop_assert!((findings[0].number - (held - 1) as f64 * 0.01).abs() < 3e-4);
    }

    #[test]
    fn clipping_is_found_on_its_side(seed in 0..1000_u64, limit in 3.5..4.7_f64, step in prop_oneof![Just(0.0), Just(0.04)]) {
        let (t_ns, mut values) = clean(seed);
        let rounded = |x: f64| if step > 0.0 { (x / step).round() * step } else { x };
        for x in &mut values {
            *x = rounded(x.min(limit));
        }
        let quality = Quality::measure(&t_ns, &values);
        let (low, high) = (quality.values.low.unwrap(), quality.values.high.unwrap());
        prop_assert!(high.saturated && !low.saturated);
        prop_assert_eq!(high.value, rounded(limit));
        prop_assert_eq!(high.samples, values.iter().filter(|&&x| x == high.value).count());
        // Without clipping the same rounding is none.
        let (t_ns, mut values) = clean(seed);
        for x in &mut values {
            *x = rounded(*x);
        }
        let free = Quality::measure(&t_ns, &values).values;
        prop_assert!(!free.high.unwrap().saturated && !free.low.unwrap().saturated);
    }

    #[test]
    fn the_step_and_the_noise_are_measured(seed in 0..1000_u64, step in 0.001..0.04_f64, digits in 5..9_i32) {
        let (t_ns, mut values) = clean(seed);
        // Quantised, offset, and written with some decimals.
        let decimals = 10_f64.powi(digits);
        for x in &mut values {
            *x = (((*x / step).round() * step + 0.123) * decimals).round() / decimals;
        }
        let quality = Quality::measure(&t_ns, &values);
        let grid = quality.grid.unwrap();
        prop_assert!((grid.step / step - 1.0).abs() < 1e-3, "{:?}", grid);
        prop_assert!(grid.fit > 0.99);
        let noise = quality.noise.unwrap();
        prop_assert!((noise / NOISE - 1.0).abs() < 0.15, "{}", noise);
    }

    #[test]
    fn anything_is_measured_without_panic(
        t_ns in proptest::collection::vec(prop_oneof![any::<i64>(), 0..1000_i64], 0..300),
        values in proptest::collection::vec(prop_oneof![any::<f64>(), Just(0.0), Just(1.0)], 0..300),
    ) {
        let quality = Quality::measure(&t_ns, &values);
        let findings = quality.findings("");
        prop_assert_eq!(quality.timing.samples, t_ns.len().min(values.len()));
        prop_assert!(findings.windows(2).all(|pair| pair[0].severity >= pair[1].severity));
        prop_assert!(findings.iter().all(|finding| !finding.to_string().is_empty() && !finding.number.is_nan()));
    }
}

#[test]
fn no_samples_and_one() {
    let none = Quality::measure(&[], &[]);
    assert_eq!(none.findings("m").iter().map(ToString::to_string).collect::<Vec<_>>(), ["no sample"]);
    let one = Quality::measure(&[5], &[2.0]);
    assert_eq!((one.timing.period_s, one.timing.span_ns, one.values.median), (None, Some((5, 5)), Some(2.0)));
    assert_eq!(one.findings("m")[0].to_string(), "constant at 2 m");
}

#[test]
fn held_stepwise_and_computed_signals_are_reported() {
    let (t_ns, values) = clean(1);
    let held: Vec<f64> = (0..SAMPLES).map(|i| values[i - i % 2]).collect();
    assert_eq!(kinds(&t_ns, &held), [FindingKind::Held]);
    let steps: Vec<f64> = (0..SAMPLES).map(|i| (i / 200) as f64).collect();
    assert!(kinds(&t_ns, &steps).contains(&FindingKind::Stepwise));
    let even: Vec<i64> = (0..SAMPLES as i64).map(|i| i * PERIOD_NS).collect();
    assert_eq!(kinds(&even, &values), [FindingKind::ComputedStamps]);
}

#[test]
fn bursts_and_uneven_stamps_are_reported() {
    let (t_ns, values) = clean(2);
    // Four at a time.
    let bursts: Vec<i64> = (0..SAMPLES).map(|i| t_ns[i - i % 4 + 3] + (i % 4) as i64 * 5000).collect();
    let found = kinds(&bursts, &values);
    assert!(found.contains(&FindingKind::Bunched) && !found.contains(&FindingKind::Gaps), "{found:?}");
    let rate = Quality::measure(&bursts, &values).timing.rate_hz().unwrap();
    assert!((rate - 100.0).abs() < 1.0, "{rate}");
    // From half a period to one and a half.
    let mut now = 0;
    let mut uneven = || {
        (0..SAMPLES)
            .map(|i| {
                now += PERIOD_NS + (random(3, i) * 5.5e6) as i64;
                now
            })
            .collect::<Vec<_>>()
    };
    assert_eq!(kinds(&uneven(), &values), [FindingKind::Jitter]);
}

#[test]
fn a_clock_that_starts_years_ago_is_set_even_under_a_calm_signal() {
    let mut t_ns = clean(4).0;
    t_ns[700..].iter_mut().for_each(|t| *t += 1_700_000_000_000_000_000);
    let timing = Quality::measure(&t_ns, &[0.0; SAMPLES]).timing;
    assert_eq!((timing.jumps_ahead.count, timing.gaps.tally.count), (1, 0));
}

#[test]
fn counters_and_angles_wrap() {
    let t_ns = clean(5).0;
    let ticks: Vec<f64> = (0..SAMPLES).map(|i| f64::from((i * 163 + i % 3) as u16)).collect();
    let wrap = Quality::measure(&t_ns, &ticks).wrap.unwrap();
    assert_eq!((wrap.modulus, wrap.count), (65_536.0, SAMPLES * 163 / 65_536));
    let yaw: Vec<f64> = (0..SAMPLES).map(|i| (i as f64 * 0.02).sin().atan2((i as f64 * 0.02).cos())).collect();
    let wrap = Quality::measure(&t_ns, &yaw).wrap.unwrap();
    assert_eq!((wrap.modulus, wrap.count), (std::f64::consts::TAU, 6));
    let noise: Vec<f64> = (0..SAMPLES).map(|i| 128.0 + 128.0 * random(6, i)).collect();
    assert_eq!(Quality::measure(&t_ns, &noise).wrap, None);
}

#[test]
fn a_steady_way_is_no_grid_of_its_own_speed() {
    // Ticks at 315 per sample, give or take: near a grid of 315, exactly on one of 1.
    let t_ns = clean(9).0;
    let ticks: Vec<f64> = (0..SAMPLES).map(|i| (i as f64 * 315.0 + 5.0 * random(9, i)).round()).collect();
    let grid = Quality::measure(&t_ns, &ticks).grid.unwrap();
    assert_eq!((grid.step, grid.fit), (1.0, 1.0));
}

#[test]
fn the_highest_plateau_of_a_set_point_is_no_clipping() {
    let (t_ns, _) = clean(10);
    let mut steps: Vec<f64> = (0..SAMPLES).map(|i| (20.0 * random(10, i / 20)).round()).collect();
    // Shortly one below it, then there for as long as elsewhere.
    for (start, side) in [(100, 1.0), (500, -1.0)] {
        steps[start..start + 2].fill(29.0 * side);
        steps[start + 2..start + 20].fill(30.0 * side);
    }
    let values = Quality::measure(&t_ns, &steps).values;
    assert_eq!((values.high.unwrap().samples, values.low.unwrap().samples), (18, 18));
    assert!(!values.high.unwrap().saturated && !values.low.unwrap().saturated);
}

#[test]
fn a_dead_band_is_reported_with_its_width() {
    let t_ns = clean(7).0;
    let current = |i: usize| {
        let amps = 3.0 * (i as f64 * 0.05).sin().abs() + 0.3 * normal(8, i);
        if amps < 0.6 { 0.0 } else { (amps / 0.13).round() * 0.13 }
    };
    let values: Vec<f64> = (0..SAMPLES).map(current).collect();
    let grid = Quality::measure(&t_ns, &values).grid.unwrap();
    assert!((grid.step - 0.13).abs() < 1e-9, "{grid:?}");
    assert!((grid.dead_band.unwrap() - 0.65).abs() < 1e-9, "{grid:?}");
}
