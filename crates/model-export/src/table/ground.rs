//! Effects of the ground and of the wheels on it.

use super::{Hold, Lines, Row, never};
use crate::at::At;
use crate::contact::grips;
use crate::engine::Engine;
use crate::engine::Way::{Added, Held};
use crate::number::{number, numbers};
use crate::origin::Section;
use crate::residual::Text;
use crate::vehicle::Vehicle;

const FRICTION: &str = "friction of the wheels' contacts with the ground";
const TAGS: &str = "mu1 and mu2 of the wheels, in gazebo tags";
const JOINTS: &str = "dry friction of the wheel joints, at the loads at rest";
const RADIUS: &str = "radius of the wheels of that side";

pub(super) const ROWS: [Row; 9] = [
    Row {
        id: "adhesion_patch",
        section: Section::Ground,
        hold: Hold::Special(grip),
        ways: [Held(FRICTION), Held(TAGS), Held("mu and mu2 of the wheels' surfaces, or of a disc on the ground")],
        lines: Lines::Of(|at, _| {
            let [x, y, radius] = at.place().unwrap_or_default();
            Text::Ground(vec![
                "for i in range(4):".to_owned(),
                format!("    grip[i] *= 1.0 - {} * share(i, {})", at.text(0), [x, y, radius].map(number).join(", ")),
            ])
        }),
        except: |at, engine| match engine {
            _ if at.place().is_none() => None,
            Engine::Mjcf => Some(
                "soft contacts with two surfaces in one place share the load, so that a disc on the ground would act by half",
            ),
            Engine::Urdf => Some("it describes a robot, not the ground"),
            Engine::Sdf => None,
        },
    },
    Row {
        id: "slip_stiffness",
        section: Section::Ground,
        hold: Hold::Law,
        ways: [
            Held("solreffriction and solimp of the contacts: creep at a rim speed in the middle"),
            Held("slip compliance of the wheels, by Gazebo's wheel slip plugin"),
            Held("slip compliance of the wheels, by Gazebo's wheel slip plugin"),
        ],
        lines: Lines::OfConstants,
        except: never,
    },
    Row {
        id: "turning_resistance",
        section: Section::Ground,
        hold: Hold::Law,
        ways: [
            Held("friction of the contacts along the axles"),
            Held("mu1 of the wheels, in gazebo tags"),
            Held("mu of the wheels' surfaces"),
        ],
        lines: Lines::OfConstants,
        except: never,
    },
    Row {
        id: "rolling_resistance",
        section: Section::Ground,
        hold: Hold::Law,
        ways: [Held(JOINTS), Held(JOINTS), Held(JOINTS)],
        lines: Lines::Of(|at, v| {
            let [x, y, radius] = at.place().unwrap_or_default();
            let torque = |i: usize| at.values()[0] * grips(v)[i].load * v.world.radius[i];
            Text::Force(vec![
                format!("at_wheel = [{}]  # N m", [0, 1, 2, 3].map(|i| number(torque(i))).join(", ")),
                "for i in range(4):".to_owned(),
                format!(
                    "    torque[i % 2] -= at_wheel[i] * share(i, {}) * sign(w[i % 2])",
                    [x, y, radius].map(number).join(", ")
                ),
            ])
        }),
        except: |at, _| at.place().map(|_| "joint friction is the same wherever the robot is"),
    },
    Row {
        id: "free_spin",
        section: Section::Ground,
        hold: Hold::Law,
        ways: [
            Held("friction of the contacts across the axles of that side"),
            Held("mu2 of the wheels of that side, in gazebo tags"),
            Held("mu2 of the surfaces of that side's wheels"),
        ],
        lines: Lines::OfConstants,
        except: never,
    },
    Row {
        id: "contact_loss",
        section: Section::Ground,
        hold: Hold::Law,
        ways: [
            Held("friction of each wheel's contact in proportion to the load that it has"),
            Held("mu1 and mu2 of each wheel in proportion to the load that it has"),
            Held("mu and mu2 of each wheel in proportion to the load that it has"),
        ],
        lines: Lines::OfConstants,
        except: never,
    },
    Row {
        id: "grade",
        section: Section::Ground,
        hold: Hold::Law,
        ways: [
            Held("direction of gravity"),
            Added("it describes a robot, not the world; in Gazebo gravity is a property of the world"),
            Held("direction of the world's gravity"),
        ],
        lines: Lines::Of(|at, v| {
            let steep = at.values()[0].hypot(at.values()[1]).max(1e-12);
            let pull = v.robot.mass * v.robot.gravity * steep.sin() / steep;
            let [x, y] = [0, 1].map(|i| pull * at.values()[i]);
            Text::Force(vec![
                format!("# {} N in the world's axes", numbers(&[x, y])),
                format!("force[0] += {} * ch + {} * sh", number(x), number(y)),
                format!("force[1] += {} * ch - {} * sh", number(y), number(x)),
            ])
        }),
        except: never,
    },
    Row {
        id: "wheel_eccentricity",
        section: Section::Wheels,
        hold: Hold::Special(eccentric),
        ways: [
            Held("place of the wheels' shapes off their axles; wheel angles count"),
            Held("origin of the wheels' shapes off their axles; wheel angles count"),
            Held("pose of the wheels' shapes off their axles; wheel angles count"),
        ],
        lines: Lines::OfConstants,
        except: never,
    },
    Row {
        id: "wheel_radius_mismatch",
        section: Section::Wheels,
        hold: Hold::Law,
        ways: [Held(RADIUS), Held(RADIUS), Held(RADIUS)],
        lines: Lines::OfConstants,
        except: never,
    },
];

/// Another grip everywhere is that of the robot; at a place, that of a disc.
fn grip(at: &At<'_>, v: &mut Vehicle) {
    let left = 1.0 - at.values()[0];
    match at.place() {
        Some([x, y, radius]) => v.patches.push([x, y, radius, left]),
        None => v.robot.adhesion *= left,
    }
}

fn eccentric(at: &At<'_>, v: &mut Vehicle) {
    for (side, _) in at.sides().iter().enumerate().filter(|(_, has)| **has) {
        v.eccentric[side][0] += at.values()[0];
        v.eccentric[side][1] += at.values()[1];
    }
}
