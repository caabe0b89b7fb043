//! What a slope pulls, taken off the torques of the drives.

use crate::pieces::{Usual, class};
use crate::run::SpeedRun;
use crate::settings::MEASURING;
use crate::straight::is_straight;

/// Takes off the torques of a row what its slope pulls back along the body's forward axis, N m for both sides. A row at which a side
/// shows nothing because the slope drives it says nothing and is left out.
pub(crate) fn take_off_row(run: &mut SpeedRun, i: usize, pull: f64, usual: &Usual) {
    let own = 0.5 * pull;
    // Along the turning of each side: sides that turn against each other are driven one by one.
    let along = [0, 1].map(|j| own * run.speed[j][i].signum());
    if (0..2).any(|j| along[j] < 0.0 && !run.reads(i, j)) {
        run.standing[i] = true;
        return;
    }

    // Without a sign a side that is driven beyond what it resists reads what it holds back. Spins resist more than any slope pulls;
    // in an arc nothing says what the inner side would read.
    let expected = usual.load[class(run.forward(i).abs())].or(usual.any()).unwrap_or(0.0);
    let is_spin = run.speed[0][i] * run.speed[1][i] < 0.0;
    let holds_back = along.map(|along| run.magnitude_only && !is_spin && 0.5 * expected + along < 0.0);
    if holds_back.contains(&true) && !is_straight(run, i, MEASURING.straight.hold) {
        run.standing[i] = true;
        return;
    }
    for j in 0..2 {
        let torque = run.torque[j][i];
        if !run.magnitude_only {
            run.torque[j][i] = torque - own;
        } else if run.reads(i, j) {
            let shown = if holds_back[j] { -torque.abs() } else { torque.abs() };
            run.torque[j][i] = (shown - along[j]).max(0.0);
        }
    }
}
