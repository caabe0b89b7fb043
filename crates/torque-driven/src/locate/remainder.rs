//! What the best answer leaves: how much, in which signal, in what kind of driving.

use crate::channel::{Channel, Channels};
use crate::fit::Problem;
use crate::locate::fault_free::Energy;
use crate::settings::locate::{Remaining, SETTINGS};
use verdict::{Regime, Remainder};

/// Limits of |yaw rate| (rad/s) and |forward velocity| (m/s) that split the driving in two.
const LIMITS: [(Channel, &str, [f64; 3]); 2] =
    [(Channel::YawRate, "turning", REMAINING.turning), (Channel::ForwardVelocity, "speed", REMAINING.speed)];
const REMAINING: Remaining = SETTINGS.remainder;

/// Energy of each channel beyond what is fault-free, never below zero.
pub(crate) fn excess(energy: &Energy) -> Channels<f64> {
    Channels::from_fn(|c| {
        let all = energy.iter().flatten().flatten().map(|w| w[c]).filter(|e| e.is_finite());
        all.map(|e| e - 1.0).sum::<f64>().max(0.0)
    })
}

/// Where what is left of `share` sits.
pub(crate) fn remainder(
    problem: &Problem<'_>,
    share: f64,
    energy: &Energy,
    probabilities: &Channels<Option<f64>>,
) -> Remainder {
    let excess = excess(energy);
    let total: f64 = excess.iter().sum();
    let mut order: Vec<Channel> = Channel::ALL.into_iter().filter(|&c| excess[c] > 0.0).collect();
    order.sort_by(|&a, &b| excess[b].total_cmp(&excess[a]));
    let by_signal = order.iter().map(|&c| (c.name().to_owned(), excess[c] / total)).collect();
    let stands = |c: &Channel| probabilities[*c].is_some_and(|p| p < REMAINING.stands_out / Channel::ALL.len() as f64);
    let largest = order.first().copied().filter(stands);
    let alike = |[one, other]: [Channel; 2]| excess[other] > REMAINING.alike * excess[one];
    let place = largest.map(|c| match c.side() {
        Some(side) if alike([c, Channel::WHEELS[1 - side]]) => "in the wheel speeds of both sides".to_owned(),
        Some(side) => format!("on the {} side", inference::words::side(side)),
        None => format!("in the {}", c.name()),
    });
    Remainder { share, by_signal, place, regime: largest.and_then(|c| regime(problem, energy, c)) }
}

/// The kind of driving that holds most of a channel's remainder for the least time.
fn regime(problem: &Problem<'_>, energy: &Energy, channel: Channel) -> Option<Regime> {
    let mut best: Option<Regime> = None;
    for (by_channel, by, limits) in LIMITS {
        // Size of the quantity and excess of each window.
        let mut windows: Vec<(f64, f64)> = Vec::new();
        for (cut, run) in problem.cuts.iter().zip(energy) {
            for (segment, e) in cut.segments.iter().zip(run) {
                for ((e, shown), valid) in e.iter().zip(&segment.observed).zip(&segment.valid) {
                    if valid[by_channel] && e[channel].is_finite() {
                        windows.push((shown[by_channel].abs(), e[channel] - 1.0));
                    }
                }
            }
        }

        let (all, count) = (windows.iter().map(|w| w.1).sum::<f64>(), windows.len() as f64);
        if all <= 0.0 {
            continue;
        }
        for range in limits.iter().flat_map(|&l| [[0.0, l], [l, f64::INFINITY]]) {
            let inside = || windows.iter().filter(|w| w.0 >= range[0] && w.0 < range[1]);
            let time = inside().count() as f64 / count;
            let share = (inside().map(|w| w.1).sum::<f64>() / all).min(1.0);
            let beyond = share - time;
            let better = best.as_ref().is_none_or(|b| beyond > b.share - b.time);
            if share >= REMAINING.most && beyond >= REMAINING.beyond_time && better {
                best = Some(Regime { by: by.into(), unit: by_channel.unit().into(), range, share, time });
            }
        }
    }
    best
}

/// A remainder as a sentence.
pub(crate) fn sentence(r: &Remainder) -> String {
    let place = r.place.as_ref().map_or(String::new(), |p| format!(", mostly {p}"));
    let driving = r.regime.as_ref().filter(|_| r.place.is_some()).map_or(String::new(), |regime| {
        let [from, until] = regime.range;
        let (word, limit) = if from > 0.0 { ("above", from) } else { ("below", until) };
        let of = if regime.by == "turning" { "yaw rates" } else { "speeds" };
        format!(" at {of} {word} {limit} {}", regime.unit)
    });
    format!("{:.0} % of the mismatch is still unexplained{place}{driving}.", 100.0 * r.share)
}
