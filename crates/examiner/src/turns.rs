//! Items in turn, so that each comes up about as often as another.

use crate::random::Stream;

/// All items in rounds, each round shuffled.
pub(crate) struct Turns<T> {
    all: Vec<T>,
    left: Vec<T>,
    stream: Stream,
}

impl<T: Copy + PartialEq> Turns<T> {
    pub(crate) fn new(all: &[T], stream: Stream) -> Self {
        Self { all: all.to_vec(), left: Vec::new(), stream }
    }

    /// The next items that differ from each other; as many as there are, at most.
    pub(crate) fn different(&mut self, count: usize) -> Vec<T> {
        let mut out: Vec<T> = Vec::with_capacity(count);
        while out.len() < count.min(self.all.len()) {
            if self.left.is_empty() {
                self.left.clone_from(&self.all);
                self.stream.shuffle(&mut self.left);
            }
            out.extend(self.left.pop().filter(|item| !out.contains(item)));
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::Turns;
    use crate::random::Stream;

    #[test]
    fn rounds_hold_every_item_and_a_draw_no_item_twice() {
        let mut turns = Turns::new(&[1, 2, 3], Stream::new(1, "turns", 0));
        let mut round = [turns.different(1), turns.different(1), turns.different(1)].concat();
        round.sort_unstable();
        assert_eq!(round, [1, 2, 3]);
        for _ in 0..10 {
            let pair = turns.different(2);
            assert_ne!(pair[0], pair[1]);
        }
        assert_eq!(turns.different(5).len(), 3);
    }
}
