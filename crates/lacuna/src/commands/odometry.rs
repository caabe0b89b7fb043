//! Cases of robots whose files name their columns themselves, as `lacuna diagnose` takes them: wheel motion beside a pose, and
//! cars.

use anyhow::{Result, bail};
use case_files::car::{self, CarCase};
use case_files::columns::{ColumnsEnvelope, Kind};
use case_files::odometry::{self, OdometryCase};
use verdict::Diagnosis;

use super::diagnose::Input;
use crate::console::warning;

/// A case of one of these kinds.
pub(crate) enum Case {
    /// Of kind odometry.
    Odometry(Box<OdometryCase>),
    /// Of kind car.
    Car(Box<CarCase>),
}

impl Case {
    /// Its kind, as robot files write it.
    pub(crate) fn kind(&self) -> &'static str {
        match self {
            Self::Odometry(_) => Kind::Odometry.name(),
            Self::Car(_) => Kind::Car.name(),
        }
    }

    fn robot(&self) -> &str {
        match self {
            Self::Odometry(case) => &case.robot,
            Self::Car(case) => &case.robot,
        }
    }

    /// Other things in the folders, which were not read.
    pub(crate) fn ignored(&self) -> &[String] {
        match self {
            Self::Odometry(case) => &case.ignored,
            Self::Car(case) => &case.ignored,
        }
    }

    /// Diagnoses the case.
    pub(crate) fn diagnose(&self, progress: &dyn Fn(&str)) -> Result<Diagnosis> {
        match self {
            Self::Odometry(case) => case.diagnose(progress),
            Self::Car(case) => case.diagnose(progress),
        }
    }

    /// A diagnosis with what it was made from.
    pub(crate) fn envelope(&self, diagnosis: Diagnosis) -> ColumnsEnvelope {
        match self {
            Self::Odometry(case) => case.envelope(diagnosis),
            Self::Car(case) => case.envelope(diagnosis),
        }
    }
}

/// The case that the arguments name, if its robot is of one of these kinds.
pub(crate) fn case(input: &Input) -> Result<Option<Case>> {
    let parts = [&input.reference, &input.recordings, &input.heldout].map(Vec::as_slice);
    let (folder, robot) = (input.case.as_deref(), input.robot.as_deref());
    let case = match car::read(folder, robot, parts)? {
        Some(case) => Some(Case::Car(Box::new(case))),
        None => odometry::read(folder, robot, parts)?.map(|case| Case::Odometry(Box::new(case))),
    };
    let Some(case) = case else { return Ok(None) };
    let kind = case.kind();
    if let Some(mapping) = &input.mapping {
        bail!(
            "robot '{}' is of kind {kind} and names its columns itself, under [columns]; leave out --mapping {mapping}",
            case.robot()
        );
    }
    if !input.simulation.is_empty() {
        bail!("robots of kind {kind} take --reference, --recordings and --heldout; leave out --simulation");
    }
    if !input.visit.is_empty() {
        bail!(
            "robots of kind {kind} take no --visit: of their constants it is not known which move from one visit to another, so \
             all references count as one visit and all recordings as another; leave it out"
        );
    }
    Ok(Some(case))
}

/// Says what was asked for that such a diagnosis does not write yet.
pub(crate) fn warn_of_unused(kind: &str, asked: &[(bool, &str)]) {
    for (_, option) in asked.iter().filter(|(is, _)| *is) {
        warning(&format!("a diagnosis of kind {kind} does not write what {option} asks for; use --json"));
    }
}
