//! The SHA-256 of a file while it is read: by a thread of its own, since it takes longer than everything else about
//! bytes that are compressed already, pictures.

use std::sync::mpsc::{Receiver, SyncSender, channel, sync_channel};
use std::thread;

use sha2::{Digest, Sha256};

/// Files below this length are not worth a thread.
const WORTH_A_THREAD: u64 = 1 << 20;
/// Buffers that wait for the thread at most.
const MOST_WAITING: usize = 2;
/// Buffers above this length are waited for, so that there are not several of them: that of a record may be 64 MiB.
const LARGE: usize = 8 << 20;

/// Takes buffers that were read, in order, and gives them back for others.
pub(super) enum Hashing {
    Here { sum: Sha256, free: Vec<u8> },
    There { hash: SyncSender<(Vec<u8>, usize)>, hashed: Receiver<Hashed>, away: usize },
}

/// What the thread sends back.
pub(super) enum Hashed {
    /// A buffer that is free again.
    Buffer(Vec<u8>),
    /// The sum of all, when there are no more.
    Sum(Sha256),
}

impl Hashing {
    /// Of a file of this length.
    pub(super) fn new(length: u64) -> Self {
        let (hash, asked) = sync_channel(MOST_WAITING);
        let (give, hashed) = channel();
        let work = move || {
            let mut sum = Sha256::new();
            while let Ok((buffer, count)) = asked.recv() {
                let buffer: Vec<u8> = buffer;
                sum.update(buffer.get(..count).unwrap_or(&buffer));
                // Nobody waits when the reading ended early.
                let _ = give.send(Hashed::Buffer(buffer));
            }
            let _ = give.send(Hashed::Sum(sum));
        };
        let thread = || thread::Builder::new().name("hash".to_owned()).spawn(work);
        if length >= WORTH_A_THREAD && thread().is_ok() {
            Self::There { hash, hashed, away: 0 }
        } else {
            Self::Here { sum: Sha256::new(), free: Vec::new() }
        }
    }

    /// A buffer to read into, empty.
    pub(super) fn free(&mut self) -> Vec<u8> {
        let mut buffer = match self {
            Self::Here { free, .. } => std::mem::take(free),
            Self::There { hashed, away, .. } => match hashed.try_recv() {
                Ok(Hashed::Buffer(buffer)) => {
                    *away -= 1;
                    buffer
                }
                Ok(Hashed::Sum(_)) | Err(_) => Vec::new(),
            },
        };
        buffer.clear();
        buffer
    }

    /// Takes the first `count` bytes of a buffer.
    pub(super) fn take(&mut self, buffer: Vec<u8>, count: usize) {
        match self {
            Self::Here { sum, free } => {
                sum.update(buffer.get(..count).unwrap_or(&buffer));
                *free = buffer;
            }
            Self::There { hash, hashed, away } => {
                let is_large = buffer.len() > LARGE;
                // The thread waits as long as there is a sender.
                *away += usize::from(hash.send((buffer, count)).is_ok());
                while is_large && *away > 0 && hashed.recv().is_ok() {
                    *away -= 1;
                }
            }
        }
    }

    /// The sum of all bytes that were taken, as hexadecimal digits.
    pub(super) fn finish(self) -> String {
        let sum = match self {
            Self::Here { sum, .. } => Some(sum),
            Self::There { hash, hashed, .. } => {
                drop(hash);
                hashed.iter().find_map(|hashed| match hashed {
                    Hashed::Sum(sum) => Some(sum),
                    Hashed::Buffer(_) => None,
                })
            }
        };
        sum.map(|sum| hex::encode(sum.finalize())).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sum_is_that_of_the_bytes_in_order_by_a_thread_or_without() {
        let bytes: Vec<u8> = (0..20_u32 << 20).map(|i| (i.wrapping_mul(i) >> 7) as u8).collect();
        // Each part is given in pieces and then as a whole.
        let twice: Vec<u8> = bytes.chunks(LARGE / 3 * 4).flat_map(|part| [part, part]).flatten().copied().collect();
        let expected = hex::encode(Sha256::digest(twice));
        for length in [0, WORTH_A_THREAD] {
            let mut hashing = Hashing::new(length);
            assert_eq!(matches!(hashing, Hashing::There { .. }), length > 0);
            for part in bytes.chunks(LARGE / 3 * 4) {
                for part in part.chunks(part.len() / 777 + 1).chain([&[][..]]) {
                    let mut buffer = hashing.free();
                    assert_eq!(buffer, [0; 0]);
                    buffer.extend_from_slice(part);
                    buffer.extend_from_slice(b"not passed yet");
                    hashing.take(buffer, part.len());
                }
                let mut buffer = hashing.free();
                buffer.extend_from_slice(part);
                hashing.take(buffer, part.len());
            }
            assert_eq!(hashing.finish(), expected, "{length}");
        }
    }
}
