//! The weak form is what its definition says, bit for bit, however its rows come in.

use proptest::prelude::*;
use weak_form::{Gram, Shape, WeakForm};

/// The definition, with all columns of all rows stored: lower triangle of `Σ g gᵀ`, windows, broken windows.
fn plain(shape: Shape, signals: &[f64]) -> (Vec<f64>, u64, u64) {
    let (s, weights, columns) = (shape.signals(), shape.weights(), shape.columns());
    let rows: Vec<&[f64]> = signals.chunks_exact(s).collect();
    let column = |row: &[f64], c: usize| match shape.factors(c) {
        Some((i, Some(j))) => row[i] * row[j],
        Some((i, None)) => row[i],
        None => unreachable!("columns are counted"),
    };
    let stored: Vec<Vec<f64>> = rows.iter().map(|row| (0..columns).map(|c| column(row, c)).collect()).collect();
    let (mut gram, mut windows, mut broken) = (vec![0.0; columns * (columns + 1) / 2], 0, 0);
    for first in (0..).map(|w| w * shape.stride()).take_while(|first| first + shape.width() <= rows.len()) {
        if rows[first..first + shape.width()].iter().any(|row| row.iter().any(|z| !z.is_finite())) {
            broken += 1;
            continue;
        }
        windows += 1;
        let g: Vec<f64> =
            (0..columns).map(|c| (0..weights.len()).fold(0.0, |g, k| g + weights[k] * stored[first + k][c])).collect();
        let mut at = 0;
        for i in 0..columns {
            for j in 0..=i {
                gram[at] += g[i] * g[j];
                at += 1;
            }
        }
    }
    (gram, windows, broken)
}

/// Pushes rows in portions of the given numbers of rows, over and over.
fn streamed(shape: Shape, signals: &[f64], portions: &[usize]) -> (Gram, WeakForm) {
    let mut weak = WeakForm::new(shape);
    let mut rest = signals;
    for portion in portions.iter().cycle() {
        let (now, later) = rest.split_at((portion * shape.signals()).min(rest.len()));
        weak.push(now).expect("whole rows");
        // Asking in between changes nothing.
        if portion % 3 == 0 {
            weak.gram();
        }
        rest = later;
        if rest.is_empty() {
            break;
        }
    }
    (weak.gram(), weak)
}

fn shapes() -> impl Strategy<Value = Shape> {
    (1..6_usize, 1..70_usize, 1..60_usize, 0..6_u32)
        .prop_map(|(signals, width, stride, exponent)| Shape::new(signals, width, stride, exponent).expect("in range"))
}

fn drives() -> impl Strategy<Value = (Shape, Vec<f64>)> {
    (shapes(), 0..400_usize).prop_flat_map(|(shape, rows)| {
        // Now and then a number is missing.
        let number = prop_oneof![600 => -10.0..10.0_f64, 1 => Just(f64::NAN), 1 => Just(f64::INFINITY)];
        (Just(shape), proptest::collection::vec(number, rows * shape.signals()))
    })
}

fn bits(numbers: &[f64]) -> Vec<u64> {
    numbers.iter().map(|x| x.to_bits()).collect()
}

proptest! {
    #[test]
    fn it_has_the_bits_of_its_definition_in_any_portions(
        (shape, signals) in drives(),
        portions in proptest::collection::vec(1..80_usize, 1..10),
    ) {
        let (gram, windows, broken) = plain(shape, &signals);
        let (found, weak) = streamed(shape, &signals, &portions);
        prop_assert_eq!(bits(found.lower()), bits(&gram));
        prop_assert_eq!((found.windows(), weak.broken_windows()), (windows, broken));
        let broken_rows = signals.chunks_exact(shape.signals()).filter(|r| !r.iter().all(|z| z.is_finite())).count();
        prop_assert_eq!(weak.broken_rows(), broken_rows as u64);
        prop_assert_eq!(windows + broken, shape.windows_in((signals.len() / shape.signals()) as u64));
    }

    #[test]
    fn parts_that_were_cut_as_documented_add_up((shape, signals) in drives(), cut in 0.0..1.0_f64) {
        let all = shape.windows_in((signals.len() / shape.signals()) as u64);
        let middle = (all as f64 * cut) as u64;
        let part = |windows: std::ops::Range<u64>| {
            let rows = shape.rows_of_windows(windows);
            let (from, to) = (rows.start as usize * shape.signals(), rows.end as usize * shape.signals());
            streamed(shape, &signals[from.min(to)..to], &[7]).0
        };
        let mut sum = part(0..middle);
        sum.add(&part(middle..all)).expect("one shape");
        let whole = streamed(shape, &signals, &[100]).0;
        prop_assert_eq!(sum.windows(), whole.windows());
        for c in 0..shape.columns() {
            for d in 0..=c {
                let [a, b] = [&sum, &whole].map(|g| g.at(c, d).expect("a number"));
                let size = (whole.at(c, c).expect("a number") * whole.at(d, d).expect("a number")).sqrt();
                prop_assert!((a - b).abs() <= 1e-12 * size, "({}, {}): {} {}", c, d, a, b);
            }
        }
    }

    #[test]
    fn twice_the_signals_are_two_four_and_eight_times_the_sums((shape, signals) in drives()) {
        let twice: Vec<f64> = signals.iter().map(|z| 2.0 * z).collect();
        let [once, twice] = [&signals, &twice].map(|s| streamed(shape, s, &[50]).0);
        let degree = |c: usize| if c < shape.signals() { 1 } else { 2 };
        for c in 0..shape.columns() {
            for d in 0..=c {
                // Powers of two are exact.
                let factor = f64::from(1 << (degree(c) + degree(d)));
                prop_assert_eq!(once.at(c, d).map(|x| factor * x), twice.at(c, d));
            }
        }
    }
}

#[test]
fn after_a_restart_windows_begin_anew() {
    let shape = Shape::new(2, 20, 7, 3).expect("in range");
    let signals: Vec<f64> = (0..300).map(|i| f64::from(i % 17) - 8.0).collect();
    let mut weak = WeakForm::new(shape);
    // 73 rows, a gap, and the rest: no window reaches over the gap.
    weak.push(&signals[..146]).expect("whole rows");
    weak.restart();
    weak.push(&signals[146..]).expect("whole rows");
    let parts = [&signals[..146], &signals[146..]].map(|part| plain(shape, part));
    assert_eq!(weak.gram().windows(), parts[0].1 + parts[1].1);
    for (found, (a, b)) in weak.gram().lower().iter().zip(parts[0].0.iter().zip(&parts[1].0)) {
        approx::assert_relative_eq!(*found, a + b, max_relative = 1e-12, epsilon = 1e-9);
    }
}

#[test]
fn memory_does_not_grow_with_the_rows() {
    let mut weak = WeakForm::new(Shape::new(13, 49, 12, 4).expect("in range"));
    let before = weak.memory();
    for i in 0..20_000 {
        weak.push(&[f64::from(i % 100); 13]).expect("a row");
    }
    assert_eq!(weak.memory(), before);
    assert!(before < 256 << 10, "{before} bytes");
    // A long stride needs no more: rows that are worked off are forgotten.
    let long = WeakForm::new(Shape::new(13, 49, 100_000, 4).expect("in range")).memory();
    assert!(long < 256 << 10, "{long} bytes");
}

#[test]
fn portions_that_are_no_rows_are_refused_and_nothing_is_taken() {
    let mut weak = WeakForm::new(Shape::new(3, 2, 1, 1).expect("in range"));
    let error = weak.push(&[1.0; 7]).expect_err("no rows");
    assert_eq!(
        error.to_string(),
        "a portion has 7 numbers, which is no multiple of the 3 signals of a row; push whole rows"
    );
    weak.push(&[1.0; 6]).expect("two rows");
    assert_eq!(weak.gram().windows(), 1);
}
