//! What recordings show beyond the simulation: the structure of both parts, with what begins inside a recording.

use verdict::{Alternative, Element};

use crate::common::common;
use crate::controller::Law;
use crate::ground::TurnSlip;
use crate::identify::{Base, OfDrive, OfGround};
use crate::onset;
use crate::search::{Trial, Weighed};
use crate::windows::Windows;

/// What was found in the recordings.
#[derive(Debug, Clone)]
pub(crate) struct Identified {
    pub(crate) drive: Trial<Law>,
    pub(crate) ground: Trial<TurnSlip>,
    /// Evidence for every element that was tried.
    pub(crate) evidence: Weighed,
    /// What was fitted, though references have it alike: it is not told.
    pub(crate) shared: Vec<Element>,
    pub(crate) alternatives: Vec<Alternative>,
    /// Whether every other way to hold the sides at a wheel's limit forecasts worse.
    pub(crate) scaling_is_told: bool,
}

/// Finds what the recordings show beyond the simulation.
pub(crate) fn identify(windows: &Windows, base: &Base, nominal: [f64; 2], progress: &dyn Fn(&str)) -> Identified {
    progress("fitting wheel speeds to commands");
    let of_drive = onset::found(&OfDrive, windows, &base.drive);
    progress("fitting the motion of the body to wheel speeds");
    let of_ground = onset::found(&OfGround { nominal }, windows, &base.ground);
    Identified {
        drive: of_drive.trial,
        ground: of_ground.trial,
        evidence: of_drive.evidence.into_iter().chain(of_ground.evidence).collect(),
        shared: Vec::new(),
        alternatives: of_drive.alternatives,
        scaling_is_told: of_drive.scaling_is_told,
    }
}

/// The same beyond one response for references and recordings; `None` where all that was found has to differ.
pub(crate) fn beyond_common(
    [references, recordings]: [&Windows; 2],
    known: &Identified,
    (mut base, mut found): (Base, Identified),
    nominal: [f64; 2],
) -> Option<(Base, Identified)> {
    let windows = [references, recordings];
    let (of_drive, of_ground): (Weighed, Weighed) = found.evidence.iter().partition(|(e, _)| e.is_drive());
    let mut evidence = [of_drive, of_ground];
    let of_drive = common(&OfDrive, windows, [&known.drive, &found.drive], &evidence[0]);
    let of_ground = common(&OfGround { nominal }, windows, [&known.ground, &found.ground], &evidence[1]);
    let is_shared = of_drive.is_some() || of_ground.is_some();
    if let Some(drive) = of_drive {
        (base.drive, found.drive, evidence[0]) = (drive.base, drive.trial, drive.evidence);
        found.shared.extend(drive.shared);
    }
    if let Some(ground) = of_ground {
        (base.ground, found.ground, evidence[1]) = (ground.base, ground.trial, ground.evidence);
        found.shared.extend(ground.shared);
    }
    found.evidence = evidence.concat();
    is_shared.then_some((base, found))
}
