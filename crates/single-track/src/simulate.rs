//! A car as stated on the throttle and steering of a drive.

use verdict::{ErrorAhead, SimulatedPath};

use crate::car::Car;
use crate::constant_table::constants;
use crate::drive::Drive;
use crate::forecast::{LENGTHS, collected, of_laws};
use crate::model::{Laws, STEP};
use crate::rows::Shown;
use crate::settings::SETTINGS;
use crate::traces::predicted;

/// The motion of a car as stated, from throttle and steering alone: from the first pose that was measured with its velocity to the
/// end of the drive (anew after stretches without a pose), at rest at the origin without any. Beside it errors over each of
/// [`LENGTHS`], of runs that begin anew again and again from the measured pose.
pub fn simulate(car: &Car, drive: &Drive) -> SimulatedPath {
    let all = constants(car);
    let laws = Laws::at(&all, &vec![0.0; all.len()]);
    let pose = predicted(&laws, drive);
    let shown = Shown::new(drive, car.encoder_window);
    let errors = collected(of_laws(&shown, &laws, SETTINGS.traces.past));
    SimulatedPath {
        name: drive.name.clone(),
        time: (0..pose.len()).map(|k| drive.start + STEP * k as f64).collect(),
        pose,
        ahead: ErrorAhead::of(LENGTHS, errors.map(|e| e.medians().map(|m| m.map(Some)))),
    }
}
