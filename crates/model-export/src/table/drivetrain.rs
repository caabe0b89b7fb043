//! Effects between the motors and the wheels.

use super::{Hold, Lines, Row, never};
use crate::engine::Way::{Added, Held};
use crate::origin::Section;
use crate::residual::Text;

const DRY: &str = "dry friction of the wheel joints";
const VISCOUS: &str = "damping of the wheel joints";
const STRIBECK: &str = "dry friction of a joint does not rise towards rest";
const IN_TIME: &str = "friction of a joint does not change in time";
const BY_LOAD: &str = "friction of a joint does not depend on its torque";
const BY_ANGLE: &str = "torques of a joint do not depend on its angle in this way";

pub(super) const ROWS: [Row; 8] = [
    Row {
        id: "coulomb_friction",
        section: Section::Wheels,
        hold: Hold::Law,
        ways: [Held(DRY), Held(DRY), Held(DRY)],
        lines: Lines::OfConstants,
        except: never,
    },
    Row {
        id: "coulomb_side",
        section: Section::Wheels,
        hold: Hold::Law,
        ways: [Held(DRY), Held(DRY), Held(DRY)],
        lines: Lines::OfConstants,
        except: never,
    },
    Row {
        id: "viscous_friction",
        section: Section::Wheels,
        hold: Hold::Law,
        ways: [Held(VISCOUS), Held(VISCOUS), Held(VISCOUS)],
        lines: Lines::OfConstants,
        except: never,
    },
    Row {
        id: "stiction",
        section: Section::Wheels,
        hold: Hold::Law,
        ways: [Added(STRIBECK), Added(STRIBECK), Added(STRIBECK)],
        lines: Lines::OfConstants,
        except: never,
    },
    Row {
        id: "thermal_drift",
        section: Section::Wheels,
        hold: Hold::Law,
        ways: [Added(IN_TIME), Added(IN_TIME), Added(IN_TIME)],
        lines: Lines::Of(|at, _| {
            Text::Force(vec![
                format!("grown = {} * (1.0 - exp(-t / {}))  # t: s since the start of the run", at.text(0), at.text(1)),
                format!("for j in {}:", at.sides_text()),
                "    torque[j] -= grown * sign(w[j])".to_owned(),
            ])
        }),
        except: never,
    },
    Row {
        id: "load_dependent_friction",
        section: Section::Wheels,
        hold: Hold::Law,
        ways: [Added(BY_LOAD), Added(BY_LOAD), Added(BY_LOAD)],
        lines: Lines::Of(|at, _| {
            Text::Force(vec![
                format!("for j in {}:", at.sides_text()),
                format!("    torque[j] -= {} * abs(T[j]) * sign(w[j])", at.text(0)),
            ])
        }),
        except: never,
    },
    Row {
        id: "drivetrain_ripple",
        section: Section::Wheels,
        hold: Hold::Law,
        ways: [Added(BY_ANGLE), Added(BY_ANGLE), Added(BY_ANGLE)],
        lines: Lines::Of(|at, _| {
            Text::Force(vec![
                format!("for j in {}:", at.sides_text()),
                format!("    torque[j] += {} * cos(angle[j]) + {} * sin(angle[j])", at.text(0), at.text(1)),
            ])
        }),
        except: never,
    },
    Row {
        id: "belt_loss",
        section: Section::Wheels,
        hold: Hold::Law,
        ways: [
            Held("dry friction of a tendon over both wheels of that side, in place of their equality"),
            Added("wheels that mimic each other do so at any torque"),
            Added("wheels that mimic each other do so at any torque"),
        ],
        lines: Lines::Of(|at, _| {
            Text::Words(format!(
                "Take <mimic> out of the front wheel joint ({}) and couple it to the rear one by a torque that never exceeds \
                 {} N m: torque = clip(gain * (rear speed - front speed), -{limit}, {limit}) on the front joint and its opposite \
                 on the rear one, the gain as large as the step allows.",
                at.side_name().unwrap_or("both sides"),
                at.text(0),
                limit = at.text(0)
            ))
        }),
        except: never,
    },
];
