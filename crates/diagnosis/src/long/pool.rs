//! Which pieces of a stream are kept: never more than three times as many as are wanted.

use faer::Mat;
use verdict::Why;

use super::rows::SIGNALS;
use crate::settings::SETTINGS;
use inference::algebra::solve_spd;

type Information = [[f64; SIGNALS]; SIGNALS];

/// A piece that may be chosen.
#[derive(Clone)]
pub(super) struct Member<T> {
    /// Its number in the stream.
    pub(super) number: usize,
    pub(super) unlike: f64,
    pub(super) information: Information,
    pub(super) piece: T,
}

/// The pieces that are kept of a stream.
pub(super) struct Pool<T> {
    wanted: usize,
    spread: Vec<Member<T>>,
    /// Every how many pieces one is kept for the spread.
    stride: usize,
    telling: Vec<Member<T>>,
    unlike: Vec<Member<T>>,
}

impl<T: Clone> Pool<T> {
    pub(super) fn new(wanted: usize) -> Self {
        Self { wanted, spread: Vec::new(), stride: 1, telling: Vec::new(), unlike: Vec::new() }
    }

    /// A third for each reason; the rest are those that are least alike.
    fn third(&self) -> usize {
        (self.wanted / 3).max(1)
    }

    /// Offers the next piece of the stream.
    pub(super) fn offer(&mut self, member: &Member<T>) {
        if member.number.is_multiple_of(self.stride) {
            self.spread.push(member.clone());
            while self.spread.len() > self.third() {
                self.stride *= 2;
                let stride = self.stride;
                self.spread.retain(|m| m.number.is_multiple_of(stride));
            }
        }
        self.exchange(member);
        let place = self.unlike.partition_point(|m| m.unlike >= member.unlike);
        if place < self.wanted {
            self.unlike.insert(place, member.clone());
            self.unlike.truncate(self.wanted);
        }
    }

    /// Takes the piece for another one where that raises the determinant of the information most (Fedorov's exchange).
    fn exchange(&mut self, member: &Member<T>) {
        if self.telling.len() < self.third() {
            self.telling.push(member.clone());
            return;
        }
        let determinant = |left_out: Option<usize>| {
            let others = self.telling.iter().enumerate().filter(|(i, _)| Some(*i) != left_out).map(|(_, m)| m);
            log_determinant(others.chain(left_out.map(|_| member)))
        };
        let now = determinant(None);
        let best = (0..self.telling.len()).map(|i| (determinant(Some(i)), i)).max_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((_, place)) = best.filter(|best| best.0 > now) {
            self.telling[place] = member.clone();
        }
    }

    /// The chosen pieces in the order of the stream, no more than wanted, each with the first reason for it.
    pub(super) fn chosen(self) -> Vec<(Member<T>, Why)> {
        let reasons = [(self.spread, Why::Spread), (self.telling, Why::Telling), (self.unlike, Why::Unlike)];
        let mut out: Vec<(Member<T>, Why)> = Vec::new();
        for (members, why) in reasons {
            for member in members {
                if out.len() < self.wanted && !out.iter().any(|(m, _)| m.number == member.number) {
                    out.push((member, why));
                }
            }
        }
        out.sort_by_key(|(m, _)| m.number);
        out
    }
}

/// `ln det(Σ information + ridge I)`.
fn log_determinant<'a, T: 'a>(members: impl Iterator<Item = &'a Member<T>>) -> f64 {
    let mut sum = Mat::from_fn(SIGNALS, SIGNALS, |i, j| if i == j { SETTINGS.choice.ridge } else { 0.0 });
    for member in members {
        for i in 0..SIGNALS {
            for j in 0..SIGNALS {
                sum[(i, j)] += member.information[i][j];
            }
        }
    }
    let none = Mat::zeros(SIGNALS, 1);
    solve_spd(&sum, &none).map_or(f64::NEG_INFINITY, |(_, log_determinant)| log_determinant)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn member(number: usize, unlike: f64, excites: usize) -> Member<usize> {
        let mut information = [[0.0; SIGNALS]; SIGNALS];
        information[excites][excites] = 1.0;
        Member { number, unlike, information, piece: number }
    }

    #[test]
    fn a_stream_of_any_length_is_represented_by_its_spread_its_extremes_and_its_variety() {
        let mut pool = Pool::new(9);
        for number in 0..1000 {
            // Number 500 alone drives in another way, and 700 to 705 are unlike the rest.
            let excites = if number == 500 { 3 } else { number % 2 };
            let unlike = if (700..706).contains(&number) { 100.0 } else { 1.0 };
            pool.offer(&member(number, unlike, excites));
            assert!(pool.spread.len() + pool.telling.len() + pool.unlike.len() <= 3 * 9);
        }
        let chosen = pool.chosen();
        assert_eq!(chosen.len(), 9);
        let of = |why: Why| chosen.iter().filter(|c| c.1 == why).map(|c| c.0.number).collect::<Vec<_>>();
        assert_eq!(of(Why::Spread), [0, 512]);
        assert!(of(Why::Telling).contains(&500), "{:?}", of(Why::Telling));
        assert!(of(Why::Unlike).iter().all(|n| (700..706).contains(n)), "{:?}", of(Why::Unlike));
        assert!(chosen.windows(2).all(|w| w[0].0.number < w[1].0.number));
    }

    #[test]
    fn what_is_short_enough_is_chosen_whole() {
        let mut pool = Pool::new(9);
        (0..7).for_each(|number| pool.offer(&member(number, 1.0, 0)));
        assert_eq!(pool.chosen().len(), 7);
    }
}
