//! The quality of a channel that comes sample by sample, in memory that does not grow.

use super::Quality;

/// Samples that are measured at once.
const BLOCK: usize = 1 << 15;
/// Where a block may end before that: at even stamps, so that nothing that takes several samples is cut.
const SEARCHED: usize = 256;
/// Periods before and at the end of a block that must be even, none twice another: more than a reordering or a burst
/// is looked at.
const EVEN_PERIODS: usize = 17;

/// Measures samples one by one in blocks of 32 768, the last one of up to twice as many.
///
/// Up to 65 536 samples the result is that of [`Quality::measure`]. Beyond, counts, places and extremes are still
/// those of all samples, what is usual (a gap, a stuck value) is judged within each block, and medians, quantiles, the
/// noise and shares are the means of the blocks', each by its number of samples; `distinct` is that of the block with
/// the most. A signal that is on no grid in one block is on none, which is not looked for any more.
///
/// ```
/// use recordings::QualityMeter;
/// let mut meter = QualityMeter::default();
/// for i in 0..200_000 {
///     meter.push(i * 1_000_000, (i as f64 * 0.01).sin());
/// }
/// let quality = meter.finish();
/// assert_eq!(quality.timing.samples, 200_000);
/// assert_eq!(quality.timing.rate_hz(), Some(1000.0));
/// ```
#[derive(Debug, Clone, Default)]
pub struct QualityMeter {
    t_ns: Vec<i64>,
    values: Vec<f64>,
    measured: Option<Quality>,
}

impl QualityMeter {
    /// Takes the next sample, in the order of the file; a value that is not finite is missing.
    pub fn push(&mut self, t_ns: i64, value: f64) {
        self.t_ns.push(t_ns);
        self.values.push(value);
        if self.t_ns.len() > 2 * BLOCK {
            let end = self.block_end();
            self.measure(end);
            // The last sample begins the next block too, so that the step between them counts.
            self.t_ns.drain(..end - 1);
            self.values.drain(..end - 1);
        }
    }

    /// The quality of all samples.
    pub fn finish(mut self) -> Quality {
        self.measure(self.t_ns.len());
        self.measured.unwrap_or_else(|| Quality::measure(&[], &[]))
    }

    fn measure(&mut self, end: usize) {
        let perhaps_on_grid = !self.measured.as_ref().is_some_and(Quality::shows_no_grid);
        let block = Quality::measure_part(&self.t_ns[..end], &self.values[..end], perhaps_on_grid);
        self.measured = Some(match self.measured.take() {
            Some(earlier) => earlier.joined(block, self.values[0]),
            None => block,
        });
    }

    /// Where the stamps are even enough to end a block.
    fn block_end(&self) -> usize {
        let is_even = |end: &usize| {
            let periods =
                || self.t_ns[end - EVEN_PERIODS..=*end].windows(2).map(|pair| pair[1].saturating_sub(pair[0]));
            let (least, most) = (periods().min().unwrap_or(0), periods().max().unwrap_or(0));
            least > 0 && most / 2 < least
        };
        (BLOCK - SEARCHED..=BLOCK).rev().find(is_even).unwrap_or(BLOCK)
    }
}
