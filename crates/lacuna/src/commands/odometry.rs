//! Cases of robots whose files name their columns themselves, as `lacuna diagnose` takes them: wheel motion beside a pose, and
//! cars.

use anyhow::{Result, bail};
use case_files::columns_case::ColumnsCase;

use super::Reading;
use super::diagnose::Input;
use crate::console::warning;

/// The case that the arguments name, if its robot is of one of these kinds.
pub(crate) fn case(input: &Input) -> Result<Option<ColumnsCase>> {
    let parts = [&input.reference, &input.recordings, &input.heldout].map(Vec::as_slice);
    let (folder, robot) = (input.case.as_deref(), input.robot.as_deref());
    let Some(case) = ColumnsCase::read(folder, robot, parts)? else { return Ok(None) };
    let kind = case.kind().name();
    if let Some(mapping) = &input.mapping {
        bail!(
            "robot '{}' is of kind {kind} and names its columns itself, under [columns]; leave out --mapping {mapping}",
            case.robot()
        );
    }
    if !input.simulation.is_empty() {
        bail!("robots of kind {kind} take --reference, --recordings and --heldout; leave out --simulation");
    }
    if matches!(input.reading, Reading::Tolerant) {
        warning(&format!(
            "--reading tolerant says nothing to robots of kind {kind}: a cell that is no number and a time that does not rise are refused"
        ));
    }
    if !input.visit.is_empty() {
        bail!(
            "robots of kind {kind} take no --visit: of their constants it is not known which move from one visit to another, so \
             all references count as one visit and all recordings as another; leave it out"
        );
    }
    Ok(Some(case))
}
