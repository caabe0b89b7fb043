//! Shares with their intervals: how often something is so.

use std::fmt;

use crate::robust::NINETY_FIVE;

/// How often something is so.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Rate {
    /// How often it was so.
    pub hits: usize,
    /// How often it was asked.
    pub count: usize,
}

impl FromIterator<bool> for Rate {
    fn from_iter<I: IntoIterator<Item = bool>>(all: I) -> Self {
        all.into_iter().fold(Self::default(), |r, hit| Self { hits: r.hits + usize::from(hit), count: r.count + 1 })
    }
}

impl Rate {
    /// Hits over all, if there are any.
    pub fn share(self) -> Option<f64> {
        (self.count > 0).then(|| self.hits as f64 / self.count as f64)
    }

    /// Wilson's 95 % interval of the share `p = hits/count`; everything where nothing was counted:
    /// `(p + z²/2n ± z √(p (1 − p)/n + z²/4n²)) / (1 + z²/n)` with z = 1.96.
    pub fn interval(self) -> [f64; 2] {
        let Some(p) = self.share() else { return [0.0, 1.0] };
        let (n, z2) = (self.count as f64, NINETY_FIVE * NINETY_FIVE);
        let centre = p + z2 / (2.0 * n);
        let half = NINETY_FIVE * (p * (1.0 - p) / n + z2 / (4.0 * n * n)).sqrt();
        let whole = 1.0 + z2 / n;
        [((centre - half) / whole).max(0.0), ((centre + half) / whole).min(1.0)]
    }

    /// "3 of 4", for few cases, which need no interval; "-" where nothing was counted.
    pub fn counted(self) -> String {
        if self.count == 0 { "-".to_owned() } else { format!("{} of {}", self.hits, self.count) }
    }
}

impl fmt::Display for Rate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(share) = self.share() else { return f.write_str("-") };
        let [low, high] = self.interval().map(|x| 100.0 * x);
        write!(f, "{:.1} % ({}/{}; {low:.0} to {high:.0})", 100.0 * share, self.hits, self.count)
    }
}

#[cfg(test)]
mod tests {
    use super::Rate;

    #[test]
    fn wilson_intervals_are_those_of_the_formula() {
        // n = 1, p = 0: centre z²/2 = 1.9208, half the same, whole 4.8416.
        let [low, high] = Rate { hits: 0, count: 1 }.interval();
        assert!(low == 0.0 && (high - 3.8416 / 4.8416).abs() < 1e-12);
        // 8 of 10: the textbook's 0.4902 to 0.9433.
        let [low, high] = Rate { hits: 8, count: 10 }.interval();
        assert!((low - 0.4902).abs() < 5e-5 && (high - 0.9433).abs() < 5e-5, "{low} {high}");
        assert_eq!(Rate::default().interval(), [0.0, 1.0]);
    }

    #[test]
    fn rates_count_and_say_so() {
        let rate: Rate = [true, false, true, true].into_iter().collect();
        assert_eq!((rate.hits, rate.count, rate.share()), (3, 4, Some(0.75)));
        assert_eq!(rate.to_string(), "75.0 % (3/4; 30 to 95)");
        assert_eq!((rate.counted(), Rate::default().counted()), ("3 of 4".to_owned(), "-".to_owned()));
        assert_eq!(Rate::default().to_string(), "-");
    }
}
