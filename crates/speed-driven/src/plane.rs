//! One slope under all driving: the straight load goes with the direction of travel.
//!
//! On a plane that falls by `θ` a robot that travels at the angle `δ` from uphill needs `S + m g r sin θ cos δ`: more one way, less the
//! other, below any friction where it is steep. Ground that resists more does so in every direction.

use inference::robust::{NINETY, mean, median};
use verdict::GroundSlope;

use crate::directed_pull::{Stretch, on_one_slope, pull_of, rivals};
use crate::heading::{apart, directions, headings, levels_at_rows};
use crate::pieces::{Usual, class, pieces};
use crate::run::SpeedRun;
use crate::settings::{CHANGES, MEASURING, changes::Jumps, changes::Plane};
use crate::slope_pull::take_off_row;
use crate::straight::{Reading, readings};

const PLANE: Plane = CHANGES.plane;
const JUMPS: Jumps = CHANGES.jumps;

/// The slope under all driving, and where uphill is in each recording.
struct Found {
    told: GroundSlope,
    /// Direction uphill, rad from where the robot looked at first; `None` of a recording that says nothing.
    uphill: Vec<Option<f64>>,
}

/// Straight driving of a recording, stretch by stretch.
pub(crate) fn stretches(run: &SpeedRun, usual: &Usual) -> Vec<Stretch> {
    let (Some(direction), Some(any)) = (directions(run), usual.any()) else { return Vec::new() };
    let readings = readings(run);
    let levels = levels_at_rows(run);
    let rows = (0..run.time.len()).filter(|&i| readings[i].is_some() && !run.standing[i]);
    let of = |rows: Vec<usize>| {
        if (rows.len() as f64) * run.period() < PLANE.stretch {
            return None;
        }
        let seen = || rows.iter().filter_map(|&i| readings[i]);
        let is_bound = 2 * seen().filter(|r| r.is_exact()).count() < rows.len();
        let load = median(seen().filter(|r| r.is_exact() != is_bound).map(Reading::value))?;
        let middle = rows[rows.len() / 2];
        let usual = usual.load[class(run.forward(middle).abs())].unwrap_or(any);
        let way = run.forward(middle).signum();
        // An accelerometer is averaged, so that the ends of a stretch show what was driven before and after it.
        let lasts = rows.len() as f64 * run.period() >= 2.0 * MEASURING.rows.level_mean;
        let tilt = levels.as_ref().filter(|_| lasts);
        let tilt = tilt.and_then(|level| median(rows.iter().map(|&i| way * level[i])));
        Some(Stretch { from: run.time[rows[0]], direction: direction[middle], load, usual, tilt, is_bound, way })
    };
    pieces(&run.time, rows, PLANE.gap).into_iter().filter_map(of).collect()
}

/// What an accelerometer says of a slope under all driving.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Tilts {
    /// The body tilts as the slope makes it, or nothing measures that.
    AsOnSlope,
    /// The body stays level.
    Level,
    /// Neither.
    Otherwise,
}

/// Whether the body tilts as a slope of so many degrees under all driving makes it, where an accelerometer shows that.
fn tilts(all: &[Vec<Stretch>], degrees: f64, uphill: &[Option<f64>]) -> Tilts {
    // What a slope leaves of the tilts, what is seen there, what level ground leaves, and the slope's own, each less the lean
    // of an accelerometer, which shows in all headings.
    let of_run = |(stretches, uphill): (&Vec<Stretch>, &Option<f64>)| -> Vec<[f64; 4]> {
        let Some(uphill) = uphill else { return Vec::new() };
        // Along the body, in which an accelerometer leans, whichever way it goes.
        let pair =
            |s: &Stretch| Some([s.tilt?, degrees.to_radians() * (s.direction - uphill).cos()].map(|x| s.way * x));
        let pairs: Vec<[f64; 2]> = stretches.iter().filter_map(pair).collect();
        let lean = |of: &dyn Fn(&[f64; 2]) -> f64| {
            if pairs.len() < PLANE.leans_from { 0.0 } else { mean(pairs.iter().map(of)).unwrap_or(0.0) }
        };
        let [off, seen_on_level, own] = [lean(&|[seen, own]| seen - own), lean(&|pair| pair[0]), lean(&|pair| pair[1])];
        pairs
            .iter()
            .map(|pair| [pair[0] - pair[1] - off, pair[0] - off, pair[0] - seen_on_level, pair[1] - own])
            .collect()
    };
    let all: Vec<[f64; 4]> = all.iter().zip(uphill).flat_map(of_run).collect();
    let [by_slope, seen, by_level, own] = [0, 1, 2, 3].map(|k| all.iter().map(|row| row[k].powi(2)).sum::<f64>());
    if all.is_empty() || by_slope < PLANE.tilt_left * seen {
        Tilts::AsOnSlope
    } else if by_level < PLANE.tilt_left * own {
        Tilts::Level
    } else {
        Tilts::Otherwise
    }
}

/// What each slope that is tried costs with the price of what it chooses, nats; `weight` is `m g r`, N m.
pub(crate) fn costs_of_slopes(all: &[Vec<Stretch>], is_unsigned: bool, usual: &Usual, weight: f64) -> Vec<f64> {
    let steps = (PLANE.steepest / PLANE.step).round() as usize;
    let on = |degrees: f64| on_one_slope(all, is_unsigned, usual.unequal.ln(), pull_of(weight, degrees)).0;
    (0..=steps).map(|k| on(PLANE.step * k as f64)).collect()
}

/// Finds one slope under all driving, if that explains the straight loads and neither level ground nor two grounds do. `weight` is
/// `m g r`, N m, and by which share torques may be off against it.
fn find(runs: &[SpeedRun], usual: &Usual, (weight, scale_sigma): (f64, f64)) -> Option<Found> {
    let is_unsigned = runs.iter().any(|run| run.magnitude_only);
    let all: Vec<Vec<Stretch>> = runs.iter().map(|run| stretches(run, usual)).collect();
    let several_ways = |stretches: &&Vec<Stretch>| {
        let apart = |a: &Stretch, b: &Stretch| apart(a.direction, b.direction) > JUMPS.other_heading;
        stretches.iter().any(|a| stretches.iter().any(|b| apart(a, b)))
    };
    let turned = all.iter().filter(several_ways).count();
    let number: usize = all.iter().map(Vec::len).sum();
    if turned == 0 || number < PLANE.least_stretches {
        return None;
    }

    // Likeliest slope, by the cost of all recordings.
    let spread = usual.unequal.ln();
    let costs = costs_of_slopes(&all, is_unsigned, usual, weight);
    let steps = costs.len() - 1;
    let best = (0..=steps).min_by(|&a, &b| costs[a].total_cmp(&costs[b]))?;
    let slope = PLANE.step * best as f64;
    let gain = rivals(&all, is_unsigned, spread, weight) - costs[best];
    if slope < PLANE.least || best == steps || gain < PLANE.least_gain {
        return None;
    }

    // Where the cost has risen by half a sigma squared, to both sides.
    let rise = 0.5 * NINETY * NINETY;
    let reaches = |k: &usize| costs[*k] > costs[best] + rise;
    let below = (0..best).rev().find(reaches).unwrap_or(0);
    let above = (best..=steps).find(reaches).unwrap_or(steps);
    let half = 0.5 * PLANE.step * (above - below) as f64;
    // Loads that any slope explains tell none.
    if half >= slope {
        return None;
    }
    let over = || all.iter().flatten().map(|s| s.load / s.usual);
    let uphill = on_one_slope(&all, is_unsigned, spread, pull_of(weight, slope)).1;
    let tilts = tilts(&all, slope, &uphill);
    if tilts == Tilts::Otherwise {
        return None;
    }
    let told = GroundSlope {
        is_level: tilts == Tilts::Level,
        slope,
        half: half.max(PLANE.step).hypot(NINETY * scale_sigma * slope),
        ratios: [over().fold(f64::MAX, f64::min), over().fold(0.0, f64::max)],
        stretches: number,
    };
    Some(Found { told, uphill })
}

/// Finds one slope under all driving and takes what it pulls off the torques, so that all that follows is of level ground; `weight`
/// with its relative error.
pub(crate) fn take_off(runs: &mut [SpeedRun], usual: &Usual, weight: (f64, f64)) -> Option<GroundSlope> {
    let found = find(runs, usual, weight)?;
    if found.told.is_level {
        keep_spins(runs);
    } else {
        level(runs, &found, usual, weight.0);
    }
    Some(found.told)
}

/// Leaves out all but spins on the spot. What pulls without being a slope may pull more here than there, so that it cannot be taken off;
/// in spins it drives one side by as much as it holds back the other.
fn keep_spins(runs: &mut [SpeedRun]) {
    for run in runs {
        for i in 0..run.time.len() {
            run.standing[i] |= run.speed[0][i] * run.speed[1][i] >= 0.0;
        }
        (run.body_rates, run.level) = (None, None);
    }
}

/// Takes what the slope pulls off the torques.
fn level(runs: &mut [SpeedRun], found: &Found, usual: &Usual, weight: f64) {
    let pull = pull_of(weight, found.told.slope);
    for (run, uphill) in runs.iter_mut().zip(&found.uphill) {
        let (Some(heading), Some(uphill)) = (headings(run), uphill) else { continue };
        for (i, heading) in heading.iter().enumerate() {
            take_off_row(run, i, pull * (heading - uphill).cos(), usual);
        }
        // What is left of turning rates about the other axes is the slope's.
        (run.body_rates, run.level) = (None, None);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{Leg, STRAIGHT, WEIGHT, case, drive, rounds};
    use crate::{diagnose_steady, settings::CHANGES};
    use inference::Options;
    use verdict::Verdict;

    const USUAL: Usual = Usual { load: [Some(STRAIGHT), None, None], unequal: CHANGES.pieces.alike };
    /// Seconds of a turn, and by how much it turns, rad.
    const TURN: f64 = 8.0;
    const TURNED: f64 = TURN * 0.16 / 0.77;
    /// A straight leg and those of the turn after it.
    const LEGS: usize = 1 + TURN as usize;

    /// Straight stretches with turns between them on a plane that rises by `slope` degrees towards `uphill`.
    fn on_plane(slope: f64, uphill: f64) -> Vec<Leg> {
        let along = |turned: f64| slope * (TURNED * turned - uphill).cos();
        let parts = TURN as u32;
        let turn = move |k: u32| {
            (0..parts).map(move |part| {
                let turned = f64::from(k) + (f64::from(part) + 0.5) / f64::from(parts);
                Leg::turn(1.0).slope(along(turned))
            })
        };
        let pair = |k: u32| std::iter::once(Leg::straight(10.0).slope(along(f64::from(k)))).chain(turn(k));
        (0..5).flat_map(pair).collect()
    }

    fn found(runs: &[SpeedRun]) -> Option<GroundSlope> {
        find(runs, &USUAL, (WEIGHT, 0.0)).map(|found| found.told)
    }

    #[test]
    fn an_accelerometer_confirms_a_slope_with_a_lean_of_its_own_or_refuses_it() {
        let slope = 3.0_f64;
        let at = |k: u32, tilt: f64| Stretch {
            from: 0.0,
            direction: 0.9 * f64::from(k),
            load: STRAIGHT,
            usual: STRAIGHT,
            tilt: Some(tilt),
            is_bound: false,
            way: 1.0,
        };
        let own = |k: u32| slope.to_radians() * (0.9 * f64::from(k)).cos();
        let all = |tilt: &dyn Fn(u32) -> f64| vec![(0..7).map(|k| at(k, tilt(k))).collect::<Vec<_>>()];
        let told = |tilt: &dyn Fn(u32) -> f64| tilts(&all(tilt), slope, &[Some(0.0)]);
        assert_eq!([told(&own), told(&|k| own(k) + 0.06)], [Tilts::AsOnSlope; 2]);
        assert_eq!([told(&|_| 0.0), told(&|k| 0.06 + 0.1 * own(k))], [Tilts::Level; 2], "a rope or wind pulls");
        assert_eq!([told(&|k| -own(k)), told(&|k| 0.1 * f64::from(k % 3))], [Tilts::Otherwise; 2]);
        // What leans in the body shows the other way round where it drives backward.
        let there_and_back = |k: u32| {
            let way = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
            let heading = 1.6 * f64::from(k / 2);
            let direction = if way > 0.0 { heading } else { heading + std::f64::consts::PI };
            Stretch { direction, way, ..at(0, 0.06 * way) }
        };
        assert_eq!(tilts(&[(0..4).map(there_and_back).collect()], slope, &[Some(0.0)]), Tilts::Level);
        let unseen = vec![Stretch { tilt: None, ..at(0, 0.0) }];
        assert_eq!(tilts(&[unseen], slope, &[Some(0.0)]), Tilts::AsOnSlope, "nothing speaks against it");
    }

    #[test]
    fn a_plane_is_found_by_loads_in_several_directions_and_its_pull_leaves() {
        for slope in [2.0, 3.0, 4.0] {
            let mut runs = [drive(&on_plane(slope, 0.4), false), drive(&on_plane(slope, 2.0), false)];
            let all = find(&runs, &USUAL, (WEIGHT, 0.0)).expect("a slope");
            let unsure = find(&runs, &USUAL, (WEIGHT, 0.1)).expect("a slope").told;
            assert!(unsure.half > all.told.half && unsure.half > NINETY * 0.1 * unsure.slope, "{unsure:?}");
            assert!((all.told.slope - slope).abs() < all.told.half.max(0.5), "{:?}", all.told);
            assert!(all.told.ratios[0] < 0.8 && all.told.ratios[1] > 1.2 && all.told.stretches >= 8, "{:?}", all.told);
            level(&mut runs, &all, &USUAL, WEIGHT);
            assert_eq!(found(&runs), None, "its pull was taken off");
            let loads = runs.iter().flat_map(readings).flatten().filter(|r| r.is_exact()).map(Reading::value);
            let off = loads.map(|load| (load / STRAIGHT - 1.0).abs()).fold(0.0, f64::max);
            assert!(off < 0.4, "{slope} degrees: a load is {off} off");
        }
    }

    #[test]
    fn level_ground_soft_ground_a_patch_and_a_rope_are_no_slope() {
        let flat = on_plane(0.0, 0.0);
        assert_eq!(found(&[drive(&flat, false), drive(&flat, false)]), None);
        let load = |factor: f64, from: usize, until: usize| {
            let own = |(k, leg): (usize, &Leg)| {
                if (from..until).contains(&(k / LEGS)) { factor * leg.straight } else { leg.straight }
            };
            let legs: Vec<Leg> = flat.iter().enumerate().map(|leg| Leg { straight: own(leg), ..*leg.1 }).collect();
            drive(&legs, false)
        };
        assert_eq!(found(&[load(2.2, 0, 5), load(2.2, 0, 5)]), None, "soft everywhere");
        assert_eq!(found(&[load(2.2, 2, 5), load(2.2, 0, 2)]), None, "soft in a part");
        // A rope holds back whichever way the robot looks: forward takes more, backward less.
        let rope = |k: usize, leg: &Leg| match k % (2 * LEGS) {
            0 => leg.slope(3.0),
            LEGS => Leg { speed: [-0.24; 2], ..leg.slope(3.0) },
            _ => *leg,
        };
        let legs: Vec<Leg> = flat.iter().enumerate().map(|(k, leg)| rope(k, leg)).collect();
        assert_eq!(found(&[drive(&legs, false), drive(&legs, false)]), None);
    }

    #[test]
    fn a_verdict_leads_with_the_slope_and_finds_nothing_else() {
        let runs = [0.4, 2.0].map(|uphill| drive(&on_plane(4.0, uphill), false));
        let runs: Vec<SpeedRun> =
            runs.into_iter().enumerate().map(|(k, run)| SpeedRun { name: k.to_string(), ..run }).collect();
        let d = diagnose_steady(&case(vec![drive(&rounds(3), false)], runs), &Options::default(), &|_| {});
        let d = d.expect("a diagnosis");
        assert_eq!((d.verdict, d.ranked[0].effect.as_str()), (Verdict::Explained, "grade"), "{:?}", d.sentences);
        assert!(d.sentences[0].starts_with("Sloping ground under all driving"), "{:?}", d.sentences);
        assert!(d.sentences[1].starts_with("Apart from that the simulation explains"), "{:?}", d.sentences);
        let angle = d.ranked[0].magnitude.expect("an angle").to_degrees();
        assert!((angle - 4.0).abs() < 1.0, "{angle}");
    }

    #[test]
    fn a_track_of_turns_on_a_slope_says_nothing_of_tyres_or_the_gyro() {
        let runs = [0.4, 2.0].map(|uphill| drive(&on_plane(4.0, uphill), false));
        let runs = runs.into_iter().enumerate().map(|(k, run)| SpeedRun { name: k.to_string(), ..run }).collect();
        let case = case(vec![drive(&rounds(3), false)], runs);
        let d = diagnose_steady(&case, &Options::default(), &|_| {}).expect("a diagnosis");
        let mut loads = d.steady.expect("loads");
        let is_track = |r: &&mut verdict::Ratio| r.quantity == verdict::Quantity::EffectiveTrack;
        for track in loads.ratios.iter_mut().chain(&mut loads.pooled).filter(is_track) {
            (track.ratio, track.interval) = (0.8, [0.77, 0.83]);
        }
        let told = |loads: &verdict::Loads| {
            let strongest = crate::found::strongest(loads);
            let has_track = strongest.iter().any(|r| r.quantity == verdict::Quantity::EffectiveTrack);
            (has_track, crate::slope_sentences::told(loads, "those of the references"))
        };
        let (has_track, sentences) = told(&loads);
        assert!(!has_track && sentences.len() == 2, "{sentences:?}");
        assert!(sentences[1].contains("0.80 times") && sentences[1].contains("A slope changes it"), "{sentences:?}");
        loads.slope = None;
        assert_eq!(told(&loads), (true, Vec::new()));
    }

    #[test]
    fn what_pulls_like_a_slope_on_ground_that_an_accelerometer_shows_level_is_unknown() {
        let pulled = |(k, uphill): (usize, f64)| {
            let run = drive(&on_plane(4.0, uphill), false);
            SpeedRun { name: k.to_string(), level: Some(vec![0.0; run.time.len()]), ..run }
        };
        let runs = [0.4, 2.0].into_iter().enumerate().map(pulled).collect();
        let d = diagnose_steady(&case(vec![drive(&rounds(3), false)], runs), &Options::default(), &|_| {});
        let d = d.expect("a diagnosis");
        assert_eq!((d.verdict, d.ranked[0].effect.as_str()), (Verdict::Unknown, "unknown"), "{:?}", d.sentences);
        assert!(d.sentences[0].starts_with("Something pulls the robot towards one direction"), "{:?}", d.sentences);
        let loads = d.steady.expect("loads");
        assert!(
            loads.slope.is_some_and(|slope| slope.is_level && (slope.slope - 4.0).abs() < 1.0),
            "{:?}",
            loads.slope
        );
        assert!(loads.changes.found.is_empty() && loads.changes.hidden.is_empty(), "{:?}", loads.changes);
    }
}
