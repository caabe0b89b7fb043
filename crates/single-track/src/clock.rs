//! Clocks of the car and of the pose before any fit: two devices may start apart and run at unlike rates.

use std::borrow::Cow;

use hierarchical_fit::{Estimate, NamedCause};
use odometry::alignment::{Clocks, Compared, fine_grid, speeds};

use crate::case::Case;
use crate::drive::Drive;
use crate::model::STEP;
use crate::settings::{Clock, SETTINGS};
use catalogue::CauseSpec;
use catalogue::car::{CAR_CLOCK_DELAY, CAR_CLOCK_RATE};
use inference::robust::{MAD_TO_SIGMA, NINETY, median_absolute_deviation};

const RULES: Clock = SETTINGS.clock;

/// How the car's clock differs from that of the pose, by gyro and encoder.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Apart {
    /// Offset at the start, s, and rate: the car is behind by `offset + rate t`.
    pub(crate) usual: [f64; 2],
    /// One sigma of both.
    sigma: [f64; 2],
}

/// The same case with the car's channels at the instants of the pose's clock, and by how much the recordings' clocks are apart,
/// beyond the references' where there are some.
pub(crate) fn joined(case: &Case) -> (Cow<'_, Case>, Option<Apart>) {
    let [references, recordings] = [&case.references, &case.recordings].map(|drives| Some((drives, clocks(drives)?)));
    let of = |found: &Option<(&Vec<Drive>, Clocks)>| found.as_ref().map(|(_, clocks)| Apart::new(clocks));
    let (usual, here) = (of(&references), of(&recordings));
    let moved = |found: Option<(&Vec<Drive>, Clocks)>, given: &[Drive]| {
        found.map_or_else(|| given.to_vec(), |(drives, clocks)| in_time(drives, &clocks))
    };
    if usual.is_none() && here.is_none() {
        return (Cow::Borrowed(case), None);
    }
    let joined = Case {
        car: case.car.clone(),
        references: moved(references, &case.references),
        recordings: moved(recordings, &case.recordings),
    };
    // Clocks that are apart in the references, too, are none of what differs.
    let differs = here.filter(|here| usual.is_none_or(|usual| here.differs_from(&usual)));
    (Cow::Owned(joined), differs)
}

/// The clocks of drives with a pose; `None` where those of most agree, or are apart by no more than a fit finds.
fn clocks(drives: &[Drive]) -> Option<Clocks> {
    let compared: Vec<Compared> = drives.iter().filter_map(compared).collect();
    let found = Clocks::of_most(&compared, RULES.wrong)?;
    let [offset, rate] = found.usual;
    let length = drives.iter().map(Drive::duration).fold(0.0, f64::max);
    (offset.abs().max((offset + rate * length).abs()) > RULES.apart).then_some(found)
}

/// Speed and turning by pose and by the car; `None` without a pose.
fn compared(drive: &Drive) -> Option<Compared> {
    if !drive.has_pose() {
        return None;
    }
    let time: Vec<f64> = (0..drive.pose.len()).map(|k| STEP * k as f64).collect();
    let has = [drive.messages.iter().any(|m| m.encoder.is_some()), drive.messages.iter().any(|m| m.gyro.is_some())];
    // What the car does not measure is left out of both.
    let only = |speeds: [f64; 2]| [0, 1].map(|k| if has[k] { speeds[k] } else { f64::NAN });
    let of_pose = speeds(&time, &drive.pose).into_iter().map(|s| s.map(only)).collect();

    let mut next = 0;
    let of_car = fine_grid(drive.duration()).map(|t| {
        while next + 2 < drive.messages.len() && drive.messages[next + 1].time <= t {
            next += 1;
        }
        let (before, after) = (drive.messages.get(next)?, drive.messages.get(next + 1)?);
        let share = (t - before.time) / (after.time - before.time);
        if !(0.0..=1.0).contains(&share) || after.time - before.time > RULES.held {
            return None;
        }
        let between = |a: Option<f64>, b: Option<f64>| a.zip(b).map_or(f64::NAN, |(a, b)| a + share * (b - a));
        Some([between(before.encoder, after.encoder).abs(), between(before.gyro, after.gyro)])
    });
    Some(Compared::new(of_pose, of_car.collect()))
}

/// Drives with the car's channels at the instants of the pose's clock; those that show no clock of their own by what is usual.
fn in_time(drives: &[Drive], clocks: &Clocks) -> Vec<Drive> {
    let mut own = clocks.of_drives.iter();
    let moved = |drive: &Drive| {
        if !drive.has_pose() {
            return drive.clone();
        }
        let mut out = drive.clone();
        out.correct_clock(own.next().copied().flatten().unwrap_or(clocks.usual));
        out
    };
    drives.iter().map(moved).collect()
}

impl Apart {
    fn new(clocks: &Clocks) -> Self {
        let known: Vec<[f64; 2]> = clocks.of_drives.iter().flatten().copied().collect();
        let sigma = [0, 1].map(|k| {
            let all: Vec<f64> = known.iter().map(|c| c[k]).collect();
            let scatter = median_absolute_deviation(&all).unwrap_or(0.0) * MAD_TO_SIGMA;
            (scatter / (all.len() as f64).sqrt()).hypot(RULES.resolution[k])
        });
        Self { usual: clocks.usual, sigma }
    }

    fn differs_from(&self, other: &Self) -> bool {
        (0..2).any(|k| (self.usual[k] - other.usual[k]).abs() > RULES.sure * self.sigma[k].hypot(other.sigma[k]))
    }

    /// Whether the clocks run at unlike rates.
    fn is_rate(&self) -> bool {
        self.usual[1].abs() > RULES.sure * self.sigma[1]
    }

    /// What a verdict says of it.
    fn spec(&self) -> &'static CauseSpec {
        if self.is_rate() { &CAR_CLOCK_RATE } else { &CAR_CLOCK_DELAY }
    }

    /// The cause, before all others: without it none of them could have been seen. `rest` is the delay that a fit found beside
    /// it.
    pub(crate) fn lead(&self, named: &mut Vec<NamedCause>, rest: Option<&Estimate>) {
        named.retain(|cause| cause.spec != &CAR_CLOCK_DELAY);
        let [mut offset, rate] = self.usual;
        let [mut of_offset, of_rate] = self.sigma.map(|sigma| NINETY * sigma);
        if let Some(rest) = rest {
            offset -= rest.value;
            of_offset = of_offset.hypot(rest.half_width);
        }
        let estimate = |name: &str, unit: &'static str, value: f64, half_width: f64| Estimate {
            name: name.to_owned(),
            unit,
            given: 0.0,
            value,
            half_width,
            sigmas: value * NINETY / half_width,
        };
        let delay = |name: &str| estimate(name, "s", -offset, of_offset);
        let estimates = if self.is_rate() {
            let rate = estimate("share by which the car's clock is slow", "1", rate, of_rate);
            vec![rate, delay("delay of the car's channels at the start")]
        } else {
            vec![delay("the car's channels come late by")]
        };
        let spec = self.spec();
        let label = spec.id.to_owned();
        let cause = NamedCause {
            spec,
            label,
            probability: RULES.probability,
            alike: Vec::new(),
            estimates,
            intervals: Vec::new(),
            onset: None,
        };
        named.insert(0, cause);
    }
}
