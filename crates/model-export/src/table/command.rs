//! Effects between the command and the torque.

use super::{Hold, Lines, Row, never};
use crate::engine::Way::{Added, Held};
use crate::origin::Section;
use crate::residual::Text;

const NO_DRIVE: &str = "a joint takes the torque that it is given; what comes before belongs to the controller";
const LIMIT: &str = "effort limit of the driven joints";

pub(super) const ROWS: [Row; 6] = [
    Row {
        id: "torque_constant",
        section: Section::Drive,
        hold: Hold::Law,
        ways: [Held("gain of the actuators"), Added(NO_DRIVE), Added(NO_DRIVE)],
        lines: Lines::OfConstants,
        except: never,
    },
    Row {
        id: "torque_saturation",
        section: Section::Drive,
        hold: Hold::Law,
        ways: [Held("range of the actuators' commands: the limit comes before the lag"), Held(LIMIT), Held(LIMIT)],
        lines: Lines::OfConstants,
        except: never,
    },
    Row {
        id: "motor_lag",
        section: Section::Drive,
        hold: Hold::Law,
        ways: [
            Held("time constant of the actuators' filter; the smaller of two lags is a delay to first order"),
            Added(NO_DRIVE),
            Added(NO_DRIVE),
        ],
        lines: Lines::OfConstants,
        except: never,
    },
    Row {
        id: "transport_delay",
        section: Section::Drive,
        hold: Hold::Law,
        ways: [Held("delay of the actuators"), Added(NO_DRIVE), Added(NO_DRIVE)],
        lines: Lines::OfConstants,
        except: never,
    },
    Row {
        id: "backlash_dead_zone",
        section: Section::Drive,
        hold: Hold::Law,
        ways: [Added("actuators have no dead band"), Added(NO_DRIVE), Added(NO_DRIVE)],
        lines: Lines::OfConstants,
        except: never,
    },
    Row {
        id: "battery_sag",
        section: Section::Drive,
        hold: Hold::Law,
        ways: [Added("the torque of an actuator does not depend on that of another"), Added(NO_DRIVE), Added(NO_DRIVE)],
        lines: Lines::Of(|at, _| {
            Text::Force(vec![
                format!("lost = min({} * (abs(T[0]) + abs(T[1])), 0.8)", at.text(0)),
                "for j in (0, 1):".to_owned(),
                "    torque[j] -= lost * T[j]".to_owned(),
            ])
        }),
        except: never,
    },
];
