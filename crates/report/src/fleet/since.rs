//! Since when an effect is there: where the share of recordings in which it is named changes.

/// Fewer recordings than this tell no change.
pub(super) const FEWEST: usize = 5;
/// A change is reported above this probability.
const SURE: f64 = 0.95;
/// Ends of the interval.
const TAILS: [f64; 2] = [0.05, 0.95];

pub(super) const METHOD: &str = "Since when: the recordings of a robot in their order, each with or without the effect \
    named. One share throughout is compared with one share before and another after an instant (uniform priors for \
    shares and instant, even odds for a change); a change is reported where it is at least 0.95 probable, with the 90 % interval \
    of its instant, which lies between two recordings.";

/// What the order of recordings says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Since {
    /// Too few recordings.
    TooFew,
    /// Named in every one: it was there from the start.
    Always,
    /// It came or went.
    Changed(Change),
    /// No change is reported; how probable one is.
    Unclear(f64),
}

/// A change of the share of recordings in which an effect is named.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Change {
    /// Whether it came; else it went.
    pub came: bool,
    /// Probability that there is a change.
    pub probability: f64,
    /// The first and the last recording, by number from 0, that may be the first one after it (90 %).
    pub first_after: [usize; 2],
    /// The likeliest one.
    pub best: usize,
}

/// Natural logarithms of n!.
fn factorials(count: usize) -> Vec<f64> {
    let mut out = vec![0.0; count + 2];
    for n in 1..out.len() {
        out[n] = out[n - 1] + (n as f64).ln();
    }
    out
}

/// Tells since when, from recordings in their order: whether the effect is named in each.
///
/// With k of n named and a uniform prior for the share, the evidence is k! (n − k)! / (n + 1)!; that of a change is the mean
/// over all places of the product of both sides' evidence.
pub fn since(named: &[bool]) -> Since {
    let count = named.len();
    let total = named.iter().filter(|n| **n).count();
    if count < FEWEST {
        return Since::TooFew;
    }
    if total == count {
        return Since::Always;
    }
    let log = factorials(count);
    let evidence = |k: usize, n: usize| log[k] + log[n - k] - log[n + 1];
    let constant = evidence(total, count);
    // For each place: how much better than one share throughout, and whether the share rises.
    let mut before = 0;
    let places: Vec<(f64, bool)> = (1..count)
        .map(|first| {
            before += usize::from(named[first - 1]);
            let (after, left) = (total - before, count - first);
            let better = (evidence(before, first) + evidence(after, left) - constant).exp();
            (better, after * first > before * left)
        })
        .collect();
    let odds = places.iter().map(|p| p.0).sum::<f64>() / places.len() as f64;
    let probability = odds / (1.0 + odds);
    let best = (1..count).max_by(|a, b| places[a - 1].0.total_cmp(&places[b - 1].0)).unwrap_or(1);
    if probability < SURE {
        return Since::Unclear(probability);
    }
    let came = places[best - 1].1;
    // Places at which the share changes the other way belong to another story.
    let weight = |first: usize| if places[first - 1].1 == came { places[first - 1].0 } else { 0.0 };
    let sum: f64 = (1..count).map(weight).sum();
    let first_after = TAILS.map(|tail| {
        let mut passed = 0.0;
        (1..count)
            .find(|first| {
                passed += weight(*first);
                passed >= tail * sum
            })
            .unwrap_or(count - 1)
    });
    Since::Changed(Change { came, probability, first_after, best })
}
