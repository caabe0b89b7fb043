//! A robot as stated on the counts of a drive.

use verdict::{ErrorAhead, SimulatedPath};

use crate::drive::Drive;
use crate::forecast::{LENGTHS, forecast};
use crate::motion::{Laws, implied};
use crate::traces::predicted;
use crate::wheel::WheeledRobot;

/// The pose of a robot as stated, from the counts of its wheels alone (dead reckoning): from the first pose that was measured to the
/// end of the drive (anew after stretches without a pose), at the origin without any. Beside it errors over each of [`LENGTHS`], of
/// runs that begin anew every second.
pub fn simulate(robot: &WheeledRobot, drive: &Drive) -> SimulatedPath {
    let laws = Laws::given(robot);
    SimulatedPath {
        name: drive.name.clone(),
        time: drive.time.clone(),
        pose: predicted(robot, drive, &laws),
        ahead: ErrorAhead::of(LENGTHS, forecast(drive, &implied(robot, drive, &laws)).map(|e| e.medians())),
    }
}
