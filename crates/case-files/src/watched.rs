//! Files of which somebody is told how much was read.

use std::cell::Cell;
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};

/// How far the reading of all files is: bytes that were read, of how many.
pub type Watch<'a> = &'a dyn Fn(u64, u64);

/// What several files share.
pub(crate) struct Pass<'a> {
    done: Cell<u64>,
    of: u64,
    watch: Watch<'a>,
}

impl<'a> Pass<'a> {
    /// Over this many bytes.
    pub(crate) fn new(of: u64, watch: Watch<'a>) -> Self {
        Self { done: Cell::new(0), of, watch }
    }
}

/// A file that tells what is read of it.
pub(crate) struct Watched<'p, 'a> {
    file: File,
    pass: &'p Pass<'a>,
}

impl<'p, 'a> Watched<'p, 'a> {
    pub(crate) fn new(file: File, pass: &'p Pass<'a>) -> Self {
        Self { file, pass }
    }
}

impl Read for Watched<'_, '_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.file.read(buffer)?;
        let pass = self.pass;
        // A reader that looks at a place twice is never further than the end.
        pass.done.set((pass.done.get() + count as u64).min(pass.of));
        (pass.watch)(pass.done.get(), pass.of);
        Ok(count)
    }
}

impl Seek for Watched<'_, '_> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.file.seek(to)
    }
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;
    use std::io::Write;

    use super::*;

    #[test]
    fn what_was_read_is_reported_and_never_more_than_there_is() {
        let mut file = tempfile::tempfile().expect("a file");
        file.write_all(&[7; 100]).expect("writes");
        let told = RefCell::new(Vec::new());
        let watch = |done, of| told.borrow_mut().push((done, of));
        let pass = Pass::new(100, &watch);
        let mut watched = Watched::new(file, &pass);
        for _ in 0..2 {
            watched.seek(SeekFrom::Start(0)).expect("seeks");
            let mut buffer = [0; 64];
            watched.read_exact(&mut buffer).expect("reads");
        }
        assert_eq!(told.borrow().as_slice(), [(64, 100), (100, 100)]);
    }
}
