//! A short speed profile made for the rivals at hand: cross-entropy search over levels of speed and yaw rate.

use rayon::prelude::*;
use sim::{Purpose, Stream};

use super::menu::{Entry, Scope, Setup};
use crate::settings::next::{Profile, SETTINGS};
use verdict::Course;

const PROFILE: Profile = SETTINGS.profile;

/// Speed and yaw rate of each piece of a profile, in shares of the limits.
type Levels = Vec<[f64; 2]>;

fn entry(scope: &Scope, levels: &[[f64; 2]]) -> Entry {
    let scaled: Vec<[f64; 2]> = levels.iter().map(|l| [l[0] * scope.limits[0], l[1] * scope.limits[1]]).collect();
    Entry {
        name: "speed profile made for these causes".to_owned(),
        setup: Setup::AsItIs,
        start: scope.start,
        course: Course::of_levels(&scaled, scope.length),
        optimised: true,
    }
}

/// Wheels turn no faster than driving straight at the limit, or spinning at the limit, makes them.
fn within(level: [f64; 2]) -> [f64; 2] {
    let size = (level[0].abs() + level[1].abs()).max(1.0);
    level.map(|x| x / size)
}

/// The best profile found, with what `worth` says of it, if it says anything of any.
pub(crate) fn optimised(scope: &Scope, worth: impl Fn(&Entry) -> Option<f64> + Sync) -> Option<(Entry, f64)> {
    let count = ((scope.length / PROFILE.each).round() as usize).clamp(PROFILE.fewest, PROFILE.most);
    let mut mean: Levels = vec![[0.0; 2]; count];
    let mut spread: Levels = vec![[PROFILE.first_spread; 2]; count];
    let mut all: Vec<(Levels, f64)> = Vec::new();
    for round in 0..PROFILE.rounds {
        let draws: Vec<Levels> = (0..PROFILE.candidates)
            .map(|i| {
                let mut s = Stream::new(PROFILE.seed, Purpose::Search, round * PROFILE.candidates + i);
                let mut level =
                    |k: usize| within([0, 1].map(|c| (mean[k][c] + spread[k][c] * s.normal()).clamp(-1.0, 1.0)));
                (0..count).map(&mut level).collect()
            })
            .collect();
        let judged = |levels: Levels| worth(&entry(scope, &levels)).map(|value| (levels, value));
        let found: Vec<(Levels, f64)> = draws.into_par_iter().filter_map(judged).collect();
        all.extend(found);
        all.sort_by(|a, b| b.1.total_cmp(&a.1));

        // The next round is drawn about the best so far.
        let elite = &all[..all.len().min(PROFILE.elite)];
        if elite.is_empty() {
            return None;
        }
        for k in 0..count {
            for c in 0..2 {
                let n = elite.len() as f64;
                let centre = elite.iter().map(|e| e.0[k][c]).sum::<f64>() / n;
                let square = elite.iter().map(|e| (e.0[k][c] - centre).powi(2)).sum::<f64>() / n;
                (mean[k][c], spread[k][c]) = (centre, square.sqrt().max(PROFILE.least_spread));
            }
        }
    }
    all.first().map(|(levels, value)| (entry(scope, levels), *value))
}
