//! What is said of a slope under all driving.

use verdict::{GroundSlope, Loads};

use crate::compare::{Judgement, judgement, reported, sigmas};
use crate::found::{is_by_slope, measured_slopes};
use crate::words::{change, compared};

/// The slope, and the track that it may have changed.
pub(crate) fn told(loads: &Loads, theirs: &str) -> Vec<String> {
    let slope = loads.slope.iter().map(|s| under_all(s, theirs));
    slope.chain(track_on_slope(loads, theirs)).collect()
}

/// One slope under all driving, or what pulls like one.
fn under_all(s: &GroundSlope, theirs: &str) -> String {
    let [least, most] = s.ratios;
    let loads =
        format!("the straight load goes with the direction of travel, from {least:.2} to {most:.2} times {theirs}");
    let rests = format!("90 %; {} stretches of straight driving", s.stretches);
    if s.is_level {
        let share = 100.0 * s.slope.to_radians().sin();
        let half = 100.0 * s.half.to_radians();
        return format!(
            "Something pulls the robot towards one direction under all driving, and it is no slope, for the accelerometer shows none: \
             {loads}, as by a force of {share:.1} ± {half:.1} % of its weight ({rests}). Wind, a rope or a cable does that; no cause of the \
             catalogue does. To find out, drive the same ways with nothing fastened to the robot and out of the wind. All other loads \
             below are of spins on the spot, in which this pull cancels out."
        );
    }
    format!(
        "Sloping ground under all driving: {loads}, as on a slope of {:.1} ± {:.1}° ({rests}). What this slope pulls is taken off all \
         loads below of recordings with a yaw rate.",
        s.slope, s.half
    )
}

/// Slopes inside recordings whose tilt was measured, where the loads say more than that.
pub(crate) fn inside(loads: &Loads) -> Vec<String> {
    let steepest = measured_slopes(loads).max_by(|a, b| a.slope.abs().total_cmp(&b.slope.abs()));
    let how_many = match measured_slopes(loads).count() {
        1 => String::new(),
        n => format!(", the steepest of {n}"),
    };
    steepest.map(|c| format!("Slope inside a recording{how_many}. {}", change(c))).into_iter().collect()
}

/// Another effective track on a slope, from which nothing follows.
fn track_on_slope(loads: &Loads, theirs: &str) -> Option<String> {
    let tracks = reported(loads).filter(|r| is_by_slope(r, loads) && judgement(r) == Judgement::Differs);
    let track = tracks.max_by(|a, b| sigmas(a).total_cmp(&sigmas(b)))?;
    Some(format!(
        "The effective track is {}. A slope changes it, for the lower wheels carry more and the body slides down while it turns: nothing \
         about tyres, ground or the gyro follows from it; to compare tracks, spin on level ground.",
        compared(track, theirs)
    ))
}
