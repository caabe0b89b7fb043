//! Effects of the body.

use super::{Hold, Lines, Row, never};
use crate::at::At;
use crate::engine::Way::{Added, Held};
use crate::number::number;
use crate::origin::Section;
use crate::residual::Text;
use crate::vehicle::{Payload, Vehicle};

const LOAD: &str = "mass, height and inertia of a body of its own, payload";
const CENTRE: &str = "centre of mass of the chassis";
const FIXED_IN_BODY: &str = "its constant wrenches are fixed in the world, this force turns with the robot";

pub(super) const ROWS: [Row; 4] = [
    Row {
        id: "payload",
        section: Section::Body,
        hold: Hold::Special(load),
        ways: [Held(LOAD), Held(LOAD), Held(LOAD)],
        lines: Lines::OfConstants,
        except: never,
    },
    Row {
        id: "com_offset",
        section: Section::Body,
        hold: Hold::Law,
        ways: [Held(CENTRE), Held(CENTRE), Held(CENTRE)],
        lines: Lines::OfConstants,
        except: never,
    },
    Row {
        id: "constant_pull",
        section: Section::Body,
        hold: Hold::Law,
        ways: [Held("constant force of the actuator pull at the hitch"), Added(FIXED_IN_BODY), Added(FIXED_IN_BODY)],
        lines: Lines::Of(|at, v| {
            let moment = at.values()[0] * v.hitch()[1];
            Text::Force(vec![format!("force[0] -= {}", at.text(0)), format!("moment += {}", number(moment))])
        }),
        except: never,
    },
    Row {
        id: "quadratic_drag",
        section: Section::Body,
        hold: Hold::Special(|at, v| v.drag += at.values()[0]),
        ways: [
            Held("blunt drag of a sphere at the centre of mass, in a medium too thin for anything else"),
            Added("it has no medium, and Gazebo's drags differ by axis"),
            Added("its drags differ by axis"),
        ],
        lines: Lines::Of(|at, _| {
            Text::Force(
                vec!["speed = hypot(v[0], v[1])".to_owned()]
                    .into_iter()
                    .chain((0..2).map(|k| format!("force[{k}] -= {} * speed * v[{k}]", at.text(0))))
                    .collect(),
            )
        }),
        except: never,
    },
];

/// What the law adds to the robot becomes a body of its own.
fn load(at: &At<'_>, v: &mut Vehicle) {
    let before = v.robot;
    at.law().robot(at.values(), &mut v.robot);
    let mass = v.robot.mass - before.mass;
    if mass > 0.0 {
        let height = (v.robot.mass * v.robot.com[2] - before.mass * before.com[2]) / mass;
        v.payload = Some(Payload { mass, height, yaw_inertia: v.robot.yaw_inertia - before.yaw_inertia });
    }
}
