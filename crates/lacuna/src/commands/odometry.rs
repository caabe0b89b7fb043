//! Cases of which wheel motion and a pose are compared, as `lacuna diagnose` takes them.

use anyhow::{Result, bail};
use case_files::odometry::{self, OdometryCase};

use super::diagnose::Input;
use crate::console::warning;

/// The case that the arguments name, if its robot is of this kind.
pub(crate) fn case(input: &Input) -> Result<Option<OdometryCase>> {
    let parts = [input.reference.as_slice(), input.recordings.as_slice()];
    let case = odometry::read(input.case.as_deref(), input.robot.as_deref(), parts)?;
    if let (Some(case), Some(mapping)) = (&case, &input.mapping) {
        bail!(
            "robot '{}' is of kind odometry and names its columns itself, under [columns]; leave out --mapping {mapping}",
            case.robot
        );
    }
    if case.is_some() && (!input.simulation.is_empty() || !input.heldout.is_empty()) {
        bail!("robots of kind odometry take --reference and --recordings only; leave out --simulation and --heldout");
    }
    Ok(case)
}

/// Says what was asked for that such a diagnosis does not write yet.
pub(crate) fn warn_of_unused(asked: &[(bool, &str)]) {
    for (_, option) in asked.iter().filter(|(is, _)| *is) {
        warning(&format!("a diagnosis of kind odometry does not write what {option} asks for; use --json"));
    }
}
