//! Clocks of counts and pose before any fit: two devices may start apart and run at unlike rates.

use std::borrow::Cow;

use crate::alignment::{Clocks, Compared, fine_speeds, speeds};
use crate::case::Case;
use crate::drive::Drive;
use crate::motion::{Laws, implied};
use crate::settings::{Clock, SETTINGS};
use crate::wheel::WheeledRobot;

const RULES: Clock = SETTINGS.clock;

/// The same case with drives whose clocks start apart by unlike times brought to what is usual among them, which the fit then
/// finds, and without the pose where no counts stand beside it. Counts and pose that two devices write, or that were joined by
/// hand, start so.
///
/// With the usual offset and rate of the recordings, where they disagree.
pub(crate) fn joined(case: &Case) -> (Cow<'_, Case>, Option<[f64; 2]>) {
    let [references, recordings] = [&case.references, &case.recordings].map(|drives| together(&case.robot, drives));
    let usual = recordings.as_ref().map(|(_, usual)| *usual);
    if references.is_none() && recordings.is_none() {
        return (Cow::Borrowed(case), usual);
    }
    let or_as_given = |drives: Option<(Vec<Drive>, [f64; 2])>, given: &[Drive]| {
        drives.map_or_else(|| given.to_vec(), |(drives, _)| drives)
    };
    let joined = Case {
        robot: case.robot.clone(),
        references: or_as_given(references, &case.references),
        recordings: or_as_given(recordings, &case.recordings),
    };
    (Cow::Owned(joined), usual)
}

/// The clocks of drives; `None` where those of most agree as they are.
fn of_most(robot: &WheeledRobot, drives: &[Drive]) -> Option<Clocks> {
    let compared = |drive: &Drive| {
        let path = implied(robot, drive, &Laws::given(robot));
        Compared::new(speeds(&drive.time, &drive.pose), fine_speeds(&drive.time, &path))
    };
    Clocks::of_most(&drives.iter().map(compared).collect::<Vec<Compared>>(), RULES.wrong)
}

/// `None` where the clocks of most agree as they are.
fn together(robot: &WheeledRobot, drives: &[Drive]) -> Option<(Vec<Drive>, [f64; 2])> {
    let Clocks { usual, of_drives } = of_most(robot, drives)?;
    let mut moved = Vec::new();
    let mut of = |(drive, found): (&Drive, &Option<[f64; 2]>)| {
        let apart = found.map_or(0.0, |f| f[0] - usual[0]);
        let mut out = drive.clone();
        if apart.abs() > RULES.apart {
            out.shift_counts(apart);
            moved.push(format!("{} in '{}'", behind(usual[0] + apart), drive.name));
        }
        out.forget_pose_beyond(usual, apart);
        out
    };
    let mut out: Vec<Drive> = drives.iter().zip(&of_drives).map(&mut of).collect();
    if let (Some(first), false) = (out.first_mut(), moved.is_empty()) {
        first.told.push(format!(
            "by the speeds of counts and pose their clocks are apart by unlike times: that of the counts is {}; the counts of these \
             drives were moved to what is usual among all, {}, before the comparison",
            moved.join(", "),
            behind(usual[0])
        ));
    }
    Some((out, usual))
}

/// "1.5 s behind", "0.3 s ahead"
fn behind(offset: f64) -> String {
    format!("{:.1} s {}", offset.abs(), if offset < 0.0 { "ahead" } else { "behind" })
}
