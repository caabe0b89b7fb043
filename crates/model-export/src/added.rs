//! What an engine does not hold, written beside its model: comments, and Python for MuJoCo.

use robot_model::effect::export::Engine;

use crate::contact::{driven, names, wheels};
use crate::number::{number, numbers};
use crate::residual::Does;
use crate::vehicle::Vehicle;
use crate::xml::Element;

/// Wheel speed over which dry friction changes its sign, rad/s, as in `robot_model::plant`.
const FRICTION_REST: f64 = 0.15;

/// What the names in the lines of a residual mean.
const LEGEND: &str = "In the lines below: w, angle: speed and angle of each side's driven wheel (0 left, 1 right), rad/s, rad; \
    v: velocity of the centre of mass in body axes, m/s; r: yaw rate, rad/s; at: place of the chassis, m; heading, ch, sh: \
    heading, rad, its cosine and sine; t: time, s; T: torque that \
    each side's drive delivers, N m; sign(x): x/0.15 kept within -1 and 1; share(i, x, y, r): 1 where wheel i is within r of \
    (x, y), else 0; grip[i]: friction of wheel i. To be added: torque at the driven wheel joint of each side, N m; force, N, and \
    moment, N m, in body axes at the centre of mass. y: what a sensor is to show.";

/// Where the lines of a residual belong.
const fn place_of(engine: Engine) -> &'static str {
    match engine {
        Engine::Mjcf => "The class Residual of the Python file beside this one does this before every mj_step.",
        Engine::Urdf => {
            "Add torque to the driven wheel joints where the controller writes its efforts (ros2_control: the hardware \
             interface's write), and force and moment as a wrench on the link chassis."
        }
        Engine::Sdf => {
            "A system plugin's PreUpdate adds torque with Joint::SetForce to the driven wheel joints, and force and \
             moment with Link::AddWorldWrench to the link chassis."
        }
    }
}

/// All residuals as comments at the end of a model.
pub(crate) fn comments(into: Element, v: &Vehicle, engine: Engine) -> Element {
    if v.residuals.is_empty() {
        return into;
    }
    let heading = format!("Residuals: what this engine does not hold. {} {LEGEND}", place_of(engine));
    let each = v.residuals.iter().map(|r| format!("{}:\n{}\n", r.note(), indented(&r.lines, 4)));
    into.comments(std::iter::once(heading).chain(each))
}

/// The residuals of a model for MuJoCo as a Python module; none where nothing is to be computed.
pub(crate) fn python(name: &str, v: &Vehicle) -> Option<String> {
    let of = |wanted: Does, indent: usize| -> String {
        let found = v.residuals.iter().filter(|r| r.does == wanted);
        let text = found.map(|r| {
            let mut lines = vec![format!("# {}", r.note())];
            lines.extend(r.lines.iter().cloned());
            indented(&lines, indent)
        });
        text.collect::<Vec<_>>().join("\n")
    };
    if v.residuals.is_empty() {
        return None;
    }
    let words: Vec<String> = v
        .residuals
        .iter()
        .filter(|r| r.does == Does::Words)
        .map(|r| format!("# {}\n# {}", r.note(), r.lines[0]))
        .collect();
    let text = include_str!("residual.py")
        .replace("NAME", &name.replace(['"', '\\', '\n'], "_"))
        .replace("CENTRE", &numbers(&v.robot.com).replace(' ', ", "))
        .replace("REST", &number(FRICTION_REST))
        .replace("SIDES", &format!("{:?}", [0, 1].map(|side| driven(&v.robot, side).collect::<Vec<_>>())))
        .replace("BODIES", &format!("{:?}", bodies(v)))
        .replace("PAIRS", &format!("{:?}", &names(&v.robot)[wheels(&v.robot)]))
        .replace("# WORDS\n", &lines_of(&words.join("\n")))
        .replace("        # GROUND\n", &lines_of(&of(Does::Ground, 8)))
        .replace("        # FORCES\n", &lines_of(&of(Does::Force, 8)))
        .replace("    # READINGS\n", &lines_of(&of(Does::Reading, 4)));
    Some(text)
}

/// What each contact is a part of: casters are the chassis' own.
fn bodies(v: &Vehicle) -> [&'static str; 4] {
    let turning = wheels(&v.robot);
    std::array::from_fn(|i| if turning.contains(&i) { names(&v.robot)[i] } else { "chassis" })
}

fn lines_of(text: &str) -> String {
    if text.is_empty() { String::new() } else { format!("{text}\n") }
}

fn indented(lines: &[String], by: usize) -> String {
    lines.iter().map(|l| format!("{:by$}{l}", "")).collect::<Vec<_>>().join("\n")
}
