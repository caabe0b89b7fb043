//! The three sums of a weak form. Every number is summed in one order, whatever a vector holds: the same bits everywhere.

use pulp::Simd;

/// Columns of one row of `count` signals, behind which zeros stand: the signals, then their products.
///
/// Whole vectors are written; what stands too much is written over by the next product or, at the end, zero.
#[inline(always)]
pub(crate) fn monomials<S: Simd>(simd: S, row: &[f64], count: usize, out: &mut [f64]) {
    out[..count].copy_from_slice(&row[..count]);
    let mut at = count;
    for i in 0..count {
        let factor = simd.splat_f64s(row[i]);
        let length = (count - i).next_multiple_of(S::F64_LANES);
        let (others, _) = S::as_simd_f64s(&row[i..i + length]);
        let (products, _) = S::as_mut_simd_f64s(&mut out[at..at + length]);
        for (product, other) in products.iter_mut().zip(others) {
            *product = simd.mul_f64s(factor, *other);
        }
        at += count - i;
    }
}

/// Adds rows of columns to `LAGS` windows, each with weights of its own: `sums[at_l + c] += Σ_r weights_l[r] rows[r, c]`.
#[inline(always)]
pub(crate) fn add_rows<S: Simd, const LAGS: usize>(
    simd: S,
    rows: &[f64],
    pitch: usize,
    weights: [&[f64]; LAGS],
    at: [usize; LAGS],
    sums: &mut [f64],
) {
    let vectors = pitch / S::F64_LANES;
    let (rows, _) = S::as_simd_f64s(rows);
    let (sums, _) = S::as_mut_simd_f64s(sums);
    let count = rows.len() / vectors;
    let weights = weights.map(|w| &w[..count]);
    let at = at.map(|a| a / S::F64_LANES);
    let mut v = 0;
    while v + 2 <= vectors {
        strip::<S, LAGS, 2>(simd, rows, vectors, v, weights, at, sums);
        v += 2;
    }
    if v < vectors {
        strip::<S, LAGS, 1>(simd, rows, vectors, v, weights, at, sums);
    }
}

#[inline(always)]
fn strip<S: Simd, const LAGS: usize, const WIDE: usize>(
    simd: S,
    rows: &[S::f64s],
    vectors: usize,
    v: usize,
    weights: [&[f64]; LAGS],
    at: [usize; LAGS],
    sums: &mut [S::f64s],
) {
    let mut sum = [[simd.splat_f64s(0.0); WIDE]; LAGS];
    for l in 0..LAGS {
        sum[l].copy_from_slice(&sums[at[l] + v..][..WIDE]);
    }
    for (r, row) in rows.chunks_exact(vectors).enumerate() {
        let row = &row[v..v + WIDE];
        for l in 0..LAGS {
            let weight = simd.splat_f64s(weights[l][r]);
            for i in 0..WIDE {
                sum[l][i] = simd.add_f64s(sum[l][i], simd.mul_f64s(weight, row[i]));
            }
        }
    }
    for l in 0..LAGS {
        sums[at[l] + v..][..WIDE].copy_from_slice(&sum[l]);
    }
}

/// Rows of the Gram matrix that are summed at once.
const TALL: usize = 4;

/// Adds `Σ_w g_w g_wᵀ` of windows of `pitch` numbers to a square matrix; of its upper triangle only a strip is right.
#[inline(always)]
pub(crate) fn add_products<S: Simd>(simd: S, windows: &[f64], pitch: usize, products: &mut [f64]) {
    let vectors = pitch / S::F64_LANES;
    let (wide, _) = S::as_simd_f64s(windows);
    let (products, _) = S::as_mut_simd_f64s(products);
    for i in (0..pitch).step_by(TALL) {
        let end = (i + TALL).div_ceil(S::F64_LANES);
        let mut v = 0;
        while v + 2 <= end {
            tile::<S, 2>(simd, windows, wide, [i, v, vectors], products);
            v += 2;
        }
        if v < end {
            tile::<S, 1>(simd, windows, wide, [i, v, vectors], products);
        }
    }
}

#[inline(always)]
fn tile<S: Simd, const WIDE: usize>(
    simd: S,
    windows: &[f64],
    wide: &[S::f64s],
    [i, v, vectors]: [usize; 3],
    products: &mut [S::f64s],
) {
    let mut sum = [[simd.splat_f64s(0.0); WIDE]; TALL];
    for t in 0..TALL {
        sum[t].copy_from_slice(&products[(i + t) * vectors + v..][..WIDE]);
    }
    let numbers = windows.chunks_exact(vectors * S::F64_LANES);
    for (row, window) in wide.chunks_exact(vectors).zip(numbers) {
        let (row, column) = (&row[v..v + WIDE], &window[i..i + TALL]);
        for t in 0..TALL {
            let factor = simd.splat_f64s(column[t]);
            for c in 0..WIDE {
                sum[t][c] = simd.add_f64s(sum[t][c], simd.mul_f64s(factor, row[c]));
            }
        }
    }
    for t in 0..TALL {
        products[(i + t) * vectors + v..][..WIDE].copy_from_slice(&sum[t]);
    }
}
