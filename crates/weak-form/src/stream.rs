//! Rows in, in any portions; windows and their Gram matrix out.

use pulp::{Arch, Simd, WithSimd};

use crate::aligned::{Aligned, NUMBERS};
use crate::kernel::{add_products, add_rows, monomials};
use crate::settings::{SETTINGS, Stream};
use crate::{Gram, Shape, WeakFormError};

const STREAM: Stream = SETTINGS.stream;

/// The weak form of a stream of rows.
///
/// Rows are equally spaced in time. A window begins every [`Shape::stride`] rows, the first one at the first row. Memory
/// depends on the shape alone.
#[derive(Debug, Clone)]
pub struct WeakForm {
    shape: Shape,
    weights: Vec<f64>,
    /// Numbers from one row of columns to the next: a multiple of what any vector holds.
    pitch: usize,
    /// One row of signals with zeros behind it.
    row: Aligned,
    /// Columns of the rows of the present block.
    block: Aligned,
    rows: usize,
    /// Sums of the windows that are open; the window that began in stage `c` has place `c % open`.
    sums: Aligned,
    broken: Vec<bool>,
    /// Strides since the start, and rows of the present one that are in the sums.
    stage: u64,
    done: usize,
    /// Windows that are not in the Gram matrix yet.
    waiting: Aligned,
    waiting_count: usize,
    products: Aligned,
    windows: u64,
    broken_windows: u64,
    broken_rows: u64,
}

impl WeakForm {
    /// A weak form that has seen nothing.
    pub fn new(shape: Shape) -> Self {
        let pitch = shape.columns().next_multiple_of(NUMBERS);
        let open = shape.width().div_ceil(shape.stride());
        Self {
            shape,
            weights: shape.weights(),
            pitch,
            row: Aligned::zeros(shape.signals() + NUMBERS),
            // The last row's columns are written in whole vectors.
            block: Aligned::zeros(STREAM.rows.min(shape.stride()) * pitch + NUMBERS),
            rows: 0,
            sums: Aligned::zeros(open * pitch),
            broken: vec![false; open],
            stage: 0,
            done: 0,
            waiting: Aligned::zeros(STREAM.windows * pitch),
            waiting_count: 0,
            products: Aligned::zeros(pitch * pitch),
            windows: 0,
            broken_windows: 0,
            broken_rows: 0,
        }
    }

    /// What its windows are.
    pub fn shape(&self) -> Shape {
        self.shape
    }

    /// Takes rows: `S` numbers each, one row after the other, as many rows as there are at hand.
    ///
    /// A row with a number that is not finite, or beyond 1e70, breaks the windows that hold it: they are left out and counted.
    ///
    /// # Errors
    /// Numbers that are no whole number of rows; nothing is taken then.
    pub fn push(&mut self, rows: &[f64]) -> Result<(), WeakFormError> {
        let signals = self.shape.signals();
        if !rows.len().is_multiple_of(signals) {
            return Err(WeakFormError::NotRows { numbers: rows.len(), signals });
        }
        Arch::new().dispatch(Push { to: self, rows });
        Ok(())
    }

    /// Begins anew with the next row, as after a gap: open windows are dropped, what was summed stays.
    pub fn restart(&mut self) {
        (self.stage, self.done, self.rows) = (0, 0, 0);
        self.broken.fill(false);
    }

    /// The Gram matrix of all windows that are complete. Rows may be pushed afterwards: nothing changes by having asked.
    pub fn gram(&mut self) -> Gram {
        Arch::new().dispatch(Push { to: self, rows: &[] });
        let count = self.shape.columns();
        let products = self.products.all();
        let lower = (0..count).flat_map(|i| &products[i * self.pitch..][..=i]).copied().collect();
        Gram::from_parts(self.shape, lower, self.windows)
    }

    /// Windows that were left out because a row of theirs was broken.
    pub fn broken_windows(&self) -> u64 {
        self.broken_windows
    }

    /// Rows with a number that is not finite or beyond 1e70.
    pub fn broken_rows(&self) -> u64 {
        self.broken_rows
    }

    /// Bytes that it holds besides itself; they depend on the shape alone.
    pub fn memory(&self) -> usize {
        let aligned = [&self.row, &self.block, &self.sums, &self.waiting, &self.products];
        let numbers = self.weights.len() + aligned.iter().map(|a| a.all().len() + NUMBERS).sum::<usize>();
        numbers * size_of::<f64>() + self.broken.len()
    }
}

/// Rows on their way in, compiled for every vector unit that the machine may have. No rows: what waits is added.
struct Push<'a> {
    to: &'a mut WeakForm,
    rows: &'a [f64],
}

impl WithSimd for Push<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { to, rows } = self;
        for row in rows.chunks_exact(to.shape.signals()) {
            to.take(simd, row);
            if to.rows == STREAM.rows || to.done + to.rows == to.shape.stride() {
                to.close_block(simd);
            }
        }
        if rows.is_empty() {
            to.close_block(simd);
            to.close_windows(simd);
        }
    }
}

impl WeakForm {
    /// Puts the columns of a row into the block.
    #[inline(always)]
    fn take<S: Simd>(&mut self, simd: S, row: &[f64]) {
        if self.done + self.rows == 0 {
            let begun = place(self.stage, 0, self.broken.len());
            self.sums.all_mut()[begun * self.pitch..][..self.pitch].fill(0.0);
            self.broken[begun] = false;
        }
        let whole = row.iter().fold(true, |whole, z| whole & (z.abs() <= STREAM.largest));
        let padded = self.row.all_mut();
        if whole {
            padded[..row.len()].copy_from_slice(row);
        } else {
            padded[..row.len()].fill(0.0);
            self.broken_rows += 1;
            let (width, stride, open) = (self.shape.width(), self.shape.stride(), self.broken.len());
            let at = self.done + self.rows;
            for lag in (0..open).take_while(|lag| lag * stride + at < width && *lag as u64 <= self.stage) {
                self.broken[place(self.stage, lag, open)] = true;
            }
        }
        monomials(simd, self.row.all(), self.shape.signals(), &mut self.block.all_mut()[self.rows * self.pitch..]);
        self.rows += 1;
    }

    /// Adds the block's rows to all open windows and ends those that they complete.
    #[inline(always)]
    fn close_block<S: Simd>(&mut self, simd: S) {
        let (width, stride, open) = (self.shape.width(), self.shape.stride(), self.broken.len());
        let (from, to) = (self.done, self.done + self.rows);
        // Every lag but the last sees all rows of a stage.
        let last = open - 1;
        let seen_by_last = (width - last * stride).min(to).saturating_sub(from);
        let block = &self.block.all()[..self.rows * self.pitch];
        let weights = |lag: usize| &self.weights[lag * stride + from..];
        let at = |lag: usize| place(self.stage, lag, open) * self.pitch;
        let sums = self.sums.all_mut();
        let mut lag = 0;
        while lag + 4 <= last {
            let lags = [lag, lag + 1, lag + 2, lag + 3];
            add_rows(simd, block, self.pitch, lags.map(weights), lags.map(at), sums);
            lag += 4;
        }
        while lag < last {
            add_rows(simd, block, self.pitch, [weights(lag)], [at(lag)], sums);
            lag += 1;
        }
        if seen_by_last > 0 {
            add_rows(simd, &block[..seen_by_last * self.pitch], self.pitch, [weights(last)], [at(last)], sums);
            if last * stride + to >= width && self.stage >= last as u64 {
                self.close_window(simd, place(self.stage, last, open));
            }
        }
        self.rows = 0;
        self.done = to;
        if to == stride {
            self.done = 0;
            self.stage += 1;
        }
    }

    #[inline(always)]
    fn close_window<S: Simd>(&mut self, simd: S, place: usize) {
        if self.broken[place] {
            self.broken_windows += 1;
            return;
        }
        self.windows += 1;
        let window = &self.sums.all()[place * self.pitch..][..self.pitch];
        self.waiting.all_mut()[self.waiting_count * self.pitch..][..self.pitch].copy_from_slice(window);
        self.waiting_count += 1;
        if self.waiting_count == STREAM.windows {
            self.close_windows(simd);
        }
    }

    /// Adds the windows that wait to the Gram matrix.
    #[inline(always)]
    fn close_windows<S: Simd>(&mut self, simd: S) {
        let windows = &self.waiting.all()[..self.waiting_count * self.pitch];
        add_products(simd, windows, self.pitch, self.products.all_mut());
        self.waiting_count = 0;
    }
}

/// Where the sums of the window stand that began `lag` stages ago.
#[inline(always)]
fn place(stage: u64, lag: usize, open: usize) -> usize {
    // Where no window began so long ago the place is of no use yet.
    ((stage + open as u64 - lag as u64) % open as u64) as usize
}
