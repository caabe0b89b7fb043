//! Numbers that begin at a line of the cache: a vector that straddles two lines costs two loads.

/// Bytes of a line of the cache.
const LINE: usize = 64;
/// Numbers in a line.
pub(crate) const NUMBERS: usize = LINE / size_of::<f64>();

/// A fixed number of f64 that begin at a line of the cache.
#[derive(Debug)]
pub(crate) struct Aligned {
    data: Vec<f64>,
    first: usize,
    count: usize,
}

impl Aligned {
    /// `count` zeros.
    pub(crate) fn zeros(count: usize) -> Self {
        let data = vec![0.0; count + NUMBERS];
        // The data never move afterwards: the vector never grows.
        let first = data.as_ptr().align_offset(LINE).min(NUMBERS);
        Self { data, first, count }
    }

    #[inline(always)]
    pub(crate) fn all(&self) -> &[f64] {
        &self.data[self.first..self.first + self.count]
    }

    #[inline(always)]
    pub(crate) fn all_mut(&mut self) -> &mut [f64] {
        &mut self.data[self.first..self.first + self.count]
    }
}

impl Clone for Aligned {
    fn clone(&self) -> Self {
        let mut copy = Self::zeros(self.count);
        copy.all_mut().copy_from_slice(self.all());
        copy
    }
}
