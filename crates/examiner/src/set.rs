//! Sets of cases with a given mix.

use crate::random::{Stream, key};
use crate::turns::Turns;
use crate::{Case, Content, DrawnCase, EffectId, Error, Outsider, Setting, Settings, Severity, TyreLaw};

/// Relative shares of the kinds of cases in a set.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mix {
    /// Nothing hidden.
    pub null: f64,
    /// One effect of the vocabulary.
    pub single: f64,
    /// Two of them.
    pub pair: f64,
    /// Something outside the vocabulary.
    pub outsider: f64,
    /// Three effects.
    pub triple: f64,
}

impl Default for Mix {
    fn default() -> Self {
        Self { null: 0.2, single: 0.5, pair: 0.18, outsider: 0.12, triple: 0.0 }
    }
}

/// A case that is still to be drawn; cases can be drawn in any order and on any thread.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Plan {
    /// Its name, which says nothing about its content.
    pub name: String,
    /// Its seed.
    pub seed: u64,
    /// Its settings.
    pub settings: Settings,
}

impl Plan {
    /// Draws the case.
    ///
    /// # Errors
    /// If the settings make no case.
    pub fn draw(&self) -> Result<DrawnCase, Error> {
        Case::draw(&self.name, self.seed, &self.settings)
    }
}

/// Plans a set of `n` cases. Kinds come in the shares of the mix, effects, outsiders, severities,
/// tyre laws and settings in turn, all in an order that the seed draws.
pub fn set(seed: u64, n: usize, mix: Mix, settings: &Settings) -> Vec<Plan> {
    let shares = [mix.null, mix.single, mix.pair, mix.outsider, mix.triple].map(|s| s.max(0.0));
    let counts = apportion(n, shares);
    let mut s = Stream::new(seed, "set", 0);
    let effects = EffectId::of(settings.casters);
    let mut singles = turns(&mut s, &effects, counts[1]);
    let physical: Vec<_> = effects.into_iter().filter(|e| !e.is_sensor()).collect();
    let firsts = turns(&mut s, &physical, counts[2]);
    let mut seconds = turns(&mut s, &physical, counts[2]);
    for i in 0..counts[2] {
        // A pair is of two different effects.
        if seconds[i] == firsts[i] {
            let at = physical.iter().position(|e| *e == firsts[i]).unwrap_or(0);
            seconds[i] = physical[(at + 1) % physical.len()];
        }
    }
    let mut contents = vec![Content::Null; counts[0]];
    contents.extend(singles.drain(..).map(|e| Content::Effects(vec![e])));
    let pairs = firsts.into_iter().zip(seconds);
    contents.extend(pairs.map(|(a, b)| Content::Effects(vec![a, b])));
    let outsiders = turns(&mut s, &Outsider::of(settings.casters), counts[3]);
    contents.extend(outsiders.into_iter().map(Content::Outsider));
    let mut threes = Turns::new(&physical, Stream::new(seed, "three at once", 0));
    contents.extend((0..counts[4]).map(|_| Content::Effects(threes.different(3))));
    let severities = turns(&mut s, &Severity::ALL, n);
    let mut plans: Vec<_> = contents
        .into_iter()
        .zip(severities)
        .enumerate()
        .map(|(i, (content, severity))| Settings {
            content,
            severity: Some(severity),
            law: settings.law.or(Some([TyreLaw::Brush, TyreLaw::Pacejka][i % 2])),
            setting: settings.setting.or(Some([Setting::Normal, Setting::Weak][i / 2 % 2])),
            ..settings.clone()
        })
        .collect();
    s.shuffle(&mut plans);
    plans
        .into_iter()
        .enumerate()
        .map(|(i, settings)| Plan {
            name: format!("x{:03}", i + 1),
            seed: key(seed, "case of set", i as u64),
            settings,
        })
        .collect()
}

/// Whole numbers that sum to `n` in the given shares, by largest remainder.
fn apportion(n: usize, shares: [f64; 5]) -> [usize; 5] {
    let total: f64 = shares.iter().sum();
    let exact = shares.map(|s| if total > 0.0 { n as f64 * s / total } else { 0.0 });
    let mut counts = exact.map(|e| e as usize);
    let mut order = [0, 1, 2, 3, 4];
    order.sort_by(|a, b| exact[*b].fract().total_cmp(&exact[*a].fract()));
    let missing = n.saturating_sub(counts.iter().sum());
    for i in order.into_iter().cycle().take(missing) {
        counts[i] += 1;
    }
    counts
}

/// `n` items: rounds of all items, each round shuffled.
fn turns<T: Copy>(s: &mut Stream, items: &[T], n: usize) -> Vec<T> {
    let mut out = Vec::with_capacity(n + items.len());
    while out.len() < n {
        let mut round = items.to_vec();
        s.shuffle(&mut round);
        out.extend(round);
    }
    out.truncate(n);
    out
}

#[cfg(test)]
mod tests {
    use super::{Mix, apportion, set};
    use crate::{Content, Settings};

    #[test]
    fn a_set_has_its_mix_and_is_stable() {
        assert_eq!(apportion(10, [0.2, 0.5, 0.18, 0.12, 0.0]), [2, 5, 2, 1, 0]);
        let plans = set(4, 100, Mix::default(), &Settings::default());
        let nulls = plans.iter().filter(|p| p.settings.content == Content::Null);
        assert_eq!((plans.len(), nulls.count()), (100, 20));
        assert_eq!(plans, set(4, 100, Mix::default(), &Settings::default()));
        assert_ne!(plans, set(5, 100, Mix::default(), &Settings::default()));
    }
}
