//! MCAP, damaged or not.

mod chunk;
mod file;
mod framing;
mod hashing;
mod records;
mod summary;
mod window;

pub(crate) use file::pass;
