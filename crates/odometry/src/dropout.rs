//! Counts that an encoder lost in some windows.
//!
//! A window far off is an outlier, or a wheel lost a share of its counts in it. An outlier costs at most what the fit lets it
//! cost, `c²/2` with c the sigmas of an outlier; a share of one wheel takes `z²` of the window's misfit away and costs the width
//! that it might have had, `ln(|column| / (σ √2π))`. All wheels and none compete for the same windows, and so does an instant that
//! is off: counts that come late in one drive are missing where it stops, and nowhere in steady motion.

use crate::case::Case;
use crate::constants::Quantity;
use crate::fit::{Fit, columns};
use crate::settings::{Dropout, SETTINGS};
use crate::windows::Data;
use catalogue::odometry::LOST_COUNTS;
use hierarchical_fit::{ALIKE, Estimate, NAMED, NamedCause, ODDS};
use inference::evidence::logistic;
use inference::robust::{NINETY, mean, rms};

const RULES: Dropout = SETTINGS.dropout;

/// Windows of a drive in which a wheel's counts fall short.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Lost {
    /// Index among the measured wheels.
    pub(crate) wheel: usize,
    pub(crate) drive: usize,
    /// From when to when, s, with the share of counts that was lost meanwhile.
    pub(crate) spans: Vec<([f64; 2], f64)>,
    /// Evidence of each wheel that it lost counts here, over that of outliers, nats.
    pub(crate) evidence: Vec<(usize, f64)>,
}

impl Lost {
    /// From when to when, s, spans that follow each other as one.
    pub(crate) fn joined(&self) -> Vec<[f64; 2]> {
        let mut out: Vec<[f64; 2]> = Vec::new();
        for ([from, until], _) in &self.spans {
            match out.last_mut() {
                Some(last) if last[1] >= *from => last[1] = *until,
                _ => out.push([*from, *until]),
            }
        }
        out
    }
}

/// Log odds of each wheel over all others and none together.
pub(crate) fn log_odds(lost: &[Lost]) -> Vec<(usize, f64)> {
    let mut sums: Vec<(usize, f64)> = Vec::new();
    for &(wheel, nats) in lost.iter().flat_map(|found| &found.evidence) {
        match sums.iter_mut().find(|(w, _)| *w == wheel) {
            Some((_, sum)) => *sum += nats,
            None => sums.push((wheel, ODDS + nats)),
        }
    }
    let rivals = |wheel: usize| {
        let others = sums.iter().filter(|(w, _)| *w != wheel).map(|(_, s)| *s).chain([0.0]);
        let largest = others.clone().fold(f64::MIN, f64::max);
        largest + others.map(|s| (s - largest).exp()).sum::<f64>().ln()
    };
    sums.iter().map(|&(wheel, sum)| (wheel, sum - rivals(wheel))).collect()
}

/// Counts that were lost so often that they widen the scale of the errors and hide each other: looked for in short windows,
/// beside a fit to the windows that are not far off. `first` is a fit to all, `stated` what is known without them: the one
/// begins of which most windows are nearer. `refit` fits what is not left out, from where another fit ended.
///
/// The fit, and what was lost beside it; `None` where the scale is not widened.
pub(crate) fn often(
    data: &Data<'_>,
    first: &Fit,
    stated: &[f64],
    refit: impl Fn(&Data<'_>, Vec<f64>) -> Option<Fit>,
) -> Option<(Vec<f64>, Vec<Lost>)> {
    let usual = |theta: &[f64]| data.usual_scale(&data.errors(theta));
    let mut theta = if usual(stated) < usual(&first.theta) { stated.to_vec() } else { first.theta.clone() };
    if first.scale < RULES.widened * usual(&theta) {
        return None;
    }
    for _ in 0..RULES.rounds {
        let errors = data.errors(&theta);
        let usual = data.usual_scale(&errors);
        let mut rest = data.clone();
        for (dropped, errors) in rest.dropped.iter_mut().zip(&errors) {
            let far: Vec<bool> = errors.iter().map(|e| size(e, usual) > RULES.outlier.powi(2)).collect();
            let count = far.iter().filter(|far| **far).count();
            if count as f64 <= RULES.most * far.len() as f64 {
                *dropped = far;
            }
        }
        theta = refit(&rest, theta)?.theta;
    }
    let short = data.with_windows(RULES.length);
    let scale = short.usual_scale(&short.errors(&theta));
    let lost = lost(&short, &theta, scale, 1.0);
    // Without them the windows must agree far better: heavy tails of other causes would not go away.
    let mut rest = data.clone();
    leave_out(&mut rest, &lost);
    let left = rest.scale(&rest.errors(&theta));
    (first.scale > RULES.falls * left).then_some((theta, lost))
}

/// Leaves out the spans in which counts were lost.
pub(crate) fn leave_out(data: &mut Data<'_>, lost: &[Lost]) {
    for found in lost {
        data.leave_out(found.drive, &found.joined());
    }
}

/// Squared errors of a window in sigmas.
fn size(errors: &[f64; 3], scale: f64) -> f64 {
    errors.iter().map(|e| (e / scale).powi(2)).sum()
}

/// How much of a column an error is, and what that takes away of its square in sigmas.
fn projected(column: [f64; 3], error: [f64; 3], scale: f64) -> (f64, f64) {
    let dot = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let times = dot(column, error) / dot(column, column).max(f64::MIN_POSITIVE);
    (times, times * dot(column, error) / (scale * scale))
}

/// Evidence over an outlier of what leaves `left` of a window's squared error, less the width that its size might have had, nats.
fn gain(column: [f64; 3], size: f64, left: f64, scale: f64) -> f64 {
    let length = column.iter().map(|c| c * c).sum::<f64>().sqrt();
    let width = (length / (scale * std::f64::consts::TAU.sqrt())).max(1.0);
    let outlier = SETTINGS.windows.outlier.powi(2);
    0.5 * (size.min(outlier) - left.min(outlier)) - width.ln()
}

/// Evidence over an outlier that a window's counts are late or early, zero where it is none, nats.
fn shifted(column: [f64; 3], error: [f64; 3], scale: f64) -> f64 {
    let (by, taken) = projected(column, error, scale);
    if by.abs() > RULES.late {
        return 0.0;
    }
    let size = size(&error, scale);
    gain(column, size, size - taken, scale).max(0.0)
}

/// A window in which a wheel lost counts.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Loss {
    /// Share of the counts that was lost.
    share: f64,
    /// What it takes away of the window's squared error in sigmas.
    taken: f64,
    /// Evidence over an outlier and over counts that are late or early, nats.
    nats: f64,
}

/// What a wheel lost of its counts in a window, `most` of them at most; `column` is the errors' change with the logarithm of the
/// wheel's radius, `late` that with the clock's offset.
fn loss(column: [f64; 3], late: [f64; 3], error: [f64; 3], scale: f64, most: f64) -> Option<Loss> {
    // Missing counts shorten what the wheels imply, and the column with it: the error is that times minus what is lost over what
    // is kept.
    let (times, taken) = projected(column, error, scale);
    let over_kept = -times;
    let share = over_kept / (1.0 + over_kept);
    if over_kept <= 0.0 || share <= RULES.lost || share > most {
        return None;
    }

    let size = size(&error, scale);
    let left = (size - taken) / (1.0 + RULES.linear.powi(2) * taken);
    Some(Loss { share, taken, nats: gain(column, size, left, scale) - shifted(late, error, scale) })
}

/// Finds windows far off that one wheel's missing counts account for, of which it lost the share `most` at most.
pub(crate) fn lost(data: &Data<'_>, theta: &[f64], scale: f64, most: f64) -> Vec<Lost> {
    let errors = data.errors(theta);
    let offset = data.constants.iter().position(|c| matches!(c.quantity, Quantity::ClockOffset));
    let wheels: Vec<(usize, usize)> = data
        .constants
        .iter()
        .enumerate()
        .filter_map(|(k, c)| if let Quantity::Radius(wheel) = c.quantity { Some((k, wheel)) } else { None })
        .collect();
    let mut out: Vec<Lost> = Vec::new();
    for drive in 0..data.drives.len() {
        let size = |e: &[f64; 3]| size(e, scale);
        let far: Vec<usize> =
            (0..errors[drive].len()).filter(|&w| size(&errors[drive][w]) > RULES.outlier.powi(2)).collect();
        if far.is_empty() || far.len() as f64 > RULES.most * errors[drive].len() as f64 {
            continue;
        }
        let columns = columns(data, theta, drive);
        let total: f64 = far.iter().map(|&w| size(&errors[drive][w])).sum();
        let late = |w: usize| offset.map_or([0.0; 3], |k| columns[k][w]);
        let of_wheel = |&(k, wheel): &(usize, usize)| {
            let (mut explained, mut nats) = (0.0, 0.0);
            let mut spans = Vec::new();
            for &w in &far {
                let Some(loss) = loss(columns[k][w], late(w), errors[drive][w], scale, most) else { continue };
                explained += loss.taken;
                nats += loss.nats;
                if loss.nats > 0.0 {
                    spans.push((data.span(drive, w), loss.share));
                }
            }
            (explained, nats, Lost { wheel, drive, spans, evidence: Vec::new() })
        };
        let weighed: Vec<(f64, f64, Lost)> = wheels.iter().map(of_wheel).collect();
        let evidence: Vec<(usize, f64)> = weighed.iter().map(|(_, nats, found)| (found.wheel, *nats)).collect();
        let best = weighed.into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((explained, _, found)) = best
            && explained > RULES.share * total
            && found.spans.len() >= RULES.windows
        {
            out.push(Lost { evidence, ..found });
        }
    }
    // Several encoders do not fail at once: then the body slid.
    let one = out.iter().all(|found| found.wheel == out[0].wheel);
    // Whether counts were lost at all is asked first; which wheel lost them may stay open.
    let over_none = out.iter().flat_map(|found| found.evidence.iter().filter(|(w, _)| *w == found.wheel));
    let over_none = ODDS + over_none.map(|(_, nats)| nats).sum::<f64>();
    if one && over_none > NAMED { out } else { Vec::new() }
}

/// Wheels that account for the same windows within the odds.
pub(crate) fn alike(lost: &[Lost], wheel: usize) -> Vec<usize> {
    let odds = log_odds(lost);
    let Some((_, own)) = odds.iter().find(|(w, _)| *w == wheel).copied() else { return Vec::new() };
    odds.iter().filter(|(w, o)| *w != wheel && own - o < ALIKE).map(|(w, _)| *w).collect()
}

/// Encoders that lost counts, as causes that are named.
pub(crate) fn named(case: &Case, data: &Data<'_>, lost: &[Lost]) -> Vec<NamedCause> {
    let measured = case.robot.measured();
    let mut out: Vec<NamedCause> = Vec::new();
    let odds = log_odds(lost);
    let label_of = |wheel: usize| format!("{} ({})", LOST_COUNTS.id, case.robot.wheels[measured[wheel]].name);
    for found in lost {
        let wheel = &case.robot.wheels[measured[found.wheel]].name;
        let label = label_of(found.wheel);
        let own = odds.iter().find(|(w, _)| *w == found.wheel).map_or(f64::NEG_INFINITY, |(_, odds)| *odds);
        let intervals = found.joined().into_iter().map(|span| (data.drives[found.drive].name.clone(), span));
        let share = mean(found.spans.iter().map(|(_, s)| *s)).unwrap_or(0.0);
        let spread = rms(found.spans.iter().map(|(_, s)| s - share)).unwrap_or(0.0);
        match out.iter_mut().find(|n| n.label == label) {
            Some(same) => same.intervals.extend(intervals),
            None => out.push(NamedCause {
                spec: &LOST_COUNTS,
                label,
                probability: logistic(own),
                alike: alike(lost, found.wheel).into_iter().map(label_of).collect(),
                estimates: vec![Estimate {
                    name: format!("share of the counts of {wheel} that is lost"),
                    unit: "1",
                    given: 0.0,
                    value: share,
                    half_width: (NINETY * spread).max(RULES.least_width),
                    sigmas: 0.0,
                }],
                intervals: intervals.collect(),
                onset: None,
            }),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::constants::{Measured, constants};
    use crate::drive::Drive;
    use crate::wheel::WheeledRobot;

    fn found(evidence: &[(usize, f64)]) -> Lost {
        Lost { wheel: 0, drive: 0, spans: Vec::new(), evidence: evidence.to_vec() }
    }

    #[test]
    fn counts_that_come_late_are_not_lost() {
        let (scale, most) = (0.01, 0.5);
        // A third of the counts of a straight window is missing.
        let (wheel, error) = ([0.4, 0.0, 0.0], [-0.2, 0.0, 0.0]);
        let lost = loss(wheel, [0.0; 3], error, scale, most).expect("a loss");
        approx::assert_relative_eq!(lost.share, 1.0 / 3.0, epsilon = 1e-9);
        assert!(lost.nats > 20.0, "{lost:?}");
        // The body goes on while the wheel has stopped: half a second of delay does the same.
        let late = loss(wheel, [-0.4, 0.0, 0.0], error, scale, most).expect("a loss");
        assert!(late.nats <= 0.0, "{late:?}");
        // Two seconds are no delay, and a delay that turns the body does nothing here.
        for other in [[-0.1, 0.0, 0.0], [0.0, 0.0, 0.4]] {
            assert_eq!(loss(wheel, other, error, scale, most), Some(lost), "{other:?}");
        }
    }

    #[test]
    fn wheels_and_none_share_one_probability() {
        let lost = [found(&[(0, 6.0), (1, -40.0)]), found(&[(0, 2.0), (1, -1.0)])];
        let odds = log_odds(&lost);
        approx::assert_relative_eq!(odds[0].1, 8.0 + ODDS, epsilon = 1e-9);
        let same = log_odds(&[found(&[(0, 30.0), (1, 30.0)])]);
        approx::assert_relative_eq!(same[0].1, 0.0, epsilon = 1e-6);
        assert_eq!(alike(&[found(&[(0, 30.0), (1, 30.0)])], 0), [1]);
        assert!(alike(&lost, 0).is_empty());
    }

    /// Where a body is that speeds up to 0.4 m/s in 16 s, goes on for 6 s, stops at once and stands for 10 s, again and again.
    fn way(time: f64) -> f64 {
        let t = time.rem_euclid(32.0);
        let ramp = t.min(16.0);
        5.6 * (time / 32.0).floor() + 0.0125 * ramp * ramp + 0.4 * (t.clamp(16.0, 22.0) - 16.0)
    }

    /// A drive straight on, whose wheel has turned by `wheel` until an instant.
    fn straight(robot: &WheeledRobot, wheel: impl Fn(f64) -> f64) -> Drive {
        let time: Vec<f64> = (0..2560).map(|k| 0.05 * f64::from(k)).collect();
        Drive {
            name: "straight".into(),
            session: "one".into(),
            turns: time.iter().map(|t| vec![(wheel(*t) - wheel(t - 0.05)) / robot.wheels[0].radius]).collect(),
            steering: Some(vec![0.0; time.len()]),
            pose: time.iter().map(|t| [way(*t), 0.0, 0.0]).collect(),
            heading_only: false,
            told: Vec::new(),
            time,
        }
    }

    #[test]
    fn a_wheel_that_stops_before_the_body_lost_nothing_and_one_that_misses_counts_in_steady_motion_did() {
        let robot = WheeledRobot::tricycle(0.0325, 0.15);
        let constants = constants(&robot, Measured::POSE);
        let theta = vec![0.0; constants.len()];
        let found = |wheel: &dyn Fn(f64) -> f64| {
            let drive = straight(&robot, wheel);
            let data = Data::new(&robot, &constants, vec![&drive]).expect("windows");
            lost(&data, &theta, 0.01, RULES.linear_most)
        };

        let early = found(&|time| way(time + 0.5));
        assert!(early.is_empty(), "{early:?}");

        let missing = |time: f64| 4.0 * (time / 32.0).floor() + (time.rem_euclid(32.0) - 16.0).clamp(0.0, 4.0);
        let lost = found(&|time| way(time) - 0.4 / 3.0 * missing(time));
        assert_eq!(lost.len(), 1, "{lost:?}");
        let spans = &lost[0].spans;
        assert_eq!(spans.len(), 4, "{spans:?}");
        assert!(spans.iter().all(|(_, share)| (share - 1.0 / 3.0).abs() < 0.02), "{spans:?}");
    }
}
