//! What an engine does not hold: forces to add and readings to change, with their numbers.

use crate::at::At;
use crate::contact::SIDES;
use crate::engine::Engine;
use crate::number::{number, numbers};
use crate::vehicle::Vehicle;
use crate::xml::Element;

/// Wheel speed over which dry friction changes its sign, rad/s, as in `robot_model::plant`.
pub(crate) const FRICTION_REST: f64 = 0.15;
/// Wheel speed over which the Stribeck rise decays, rad/s, as in `robot_model::plant`.
pub(crate) const STRIBECK_SPEED: f64 = 0.6;

/// What the names in the lines of a residual mean.
const LEGEND: &str = "In the lines below: w, angle: speed and angle of each side's rear wheel (0 left, 1 right), rad/s, rad; \
    v: velocity of the centre of mass in body axes, m/s; ch, sh: cosine and sine of the heading; t: time, s; T: torque that \
    each side's drive delivers, N m; sign(x): x/0.15 kept within -1 and 1; share(i, x, y, r): 1 where wheel i is within r of \
    (x, y), else 0; grip[i]: friction of wheel i. To be added: torque at the rear wheel joint of each side, N m; force, N, and \
    moment, N m, in body axes at the centre of mass. y: what a sensor is to show.";

/// What to do in place of the engine.
pub(crate) enum Text {
    /// Lines of Python that add to torque, force or moment.
    Force(Vec<String>),
    /// Lines of Python that change the grip of wheels.
    Ground(Vec<String>),
    /// Lines of Python that change readings.
    Reading(Vec<String>),
    /// A sentence.
    Words(String),
}

/// A piece of physics that an engine does not hold.
pub(crate) struct Residual {
    title: String,
    why: String,
    text: Text,
}

impl Text {
    /// With the effect that it stands for and the reason.
    pub(crate) fn titled(self, at: &At<'_>, why: &str) -> Residual {
        Residual { title: at.card().id.to_owned(), why: why.to_owned(), text: self }
    }

    fn lines(&self) -> Vec<String> {
        match self {
            Self::Force(lines) | Self::Ground(lines) | Self::Reading(lines) => lines.clone(),
            Self::Words(words) => vec![words.clone()],
        }
    }
}

impl Residual {
    /// Constants that an engine does not hold, whether a robot file or an effect brought them in.
    pub(crate) fn of_constants(v: &Vehicle, engine: Engine) -> Vec<Self> {
        let (drive, rise) = (&v.robot.drive, v.world.stribeck);
        let new = |title: &str, why: &str, text| Self { title: title.to_owned(), why: why.to_owned(), text };
        let mut out = Vec::new();
        if engine != Engine::Mjcf && (drive.gain != 1.0 || drive.lag + drive.extra_lag != 0.0 || drive.delay != 0.0) {
            let words = format!(
                "In the controller, each side: delay the command by {} s, multiply by {}, limit to {} N m, then first-order \
                 lags of {} s and {} s in series. T is what comes out.",
                number(drive.delay),
                number(drive.gain),
                number(drive.limit),
                number(drive.lag),
                number(drive.extra_lag)
            );
            out.push(new(
                "drive (delay, gain, limit, lags)",
                "a joint takes the torque that it is given",
                Text::Words(words),
            ));
        }
        if drive.dead_band > 0.0 {
            let d = number(drive.dead_band);
            let lines = vec!["for j in (0, 1):".to_owned(), format!("    torque[j] -= min(max(T[j], -{d}), {d})")];
            out.push(new("dead band of the drive", "an actuator has no dead band", Text::Force(lines)));
        }
        if rise != [0.0; 2] {
            let lines = vec![
                format!("rise = [{}]  # N m", rise.map(number).join(", ")),
                "for j in (0, 1):".to_owned(),
                format!("    torque[j] -= rise[j] * exp(-(w[j] / {}) ** 2) * sign(w[j])", number(STRIBECK_SPEED)),
            ];
            let why = "dry friction of a joint does not rise towards rest";
            out.push(new("Stribeck friction (stiction)", why, Text::Force(lines)));
        }
        out
    }

    /// One sentence about what is missing and why.
    pub(crate) fn note(&self) -> String {
        format!("{}: {}", self.title, self.why)
    }
}

/// All residuals as comments at the end of a model.
pub(crate) fn comments(into: Element, v: &Vehicle, engine: Engine) -> Element {
    if v.residuals.is_empty() {
        return into;
    }
    let heading = format!("Residuals: what this engine does not hold. {} {LEGEND}", engine.residual_place());
    let each = v.residuals.iter().map(|r| format!("{}:\n{}\n", r.note(), indented(&r.text.lines(), 4)));
    into.comments(std::iter::once(heading).chain(each))
}

/// The residuals of a model for MuJoCo as a Python module; none where nothing is to be computed.
pub(crate) fn python(name: &str, v: &Vehicle) -> Option<String> {
    let of = |wanted: fn(&Text) -> bool, indent: usize| -> String {
        let found = v.residuals.iter().filter(|r| wanted(&r.text));
        let text = found.map(|r| {
            let mut lines = vec![format!("# {}", r.note())];
            lines.extend(r.text.lines());
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
        .filter(|r| matches!(r.text, Text::Words(_)))
        .map(|r| format!("# {}\n# {}", r.note(), r.text.lines()[0]))
        .collect();
    let text = include_str!("residual.py")
        .replace("NAME", &name.replace(['"', '\\', '\n'], "_"))
        .replace("CENTRE", &numbers(&v.robot.com).replace(' ', ", "))
        .replace("REST", &number(FRICTION_REST))
        .replace("SIDES", &format!("{:?}", SIDES.map(|s| format!("rear_{s}"))))
        .replace("# WORDS\n", &lines_of(&words.join("\n")))
        .replace("        # GROUND\n", &lines_of(&of(|t| matches!(t, Text::Ground(_)), 8)))
        .replace("        # FORCES\n", &lines_of(&of(|t| matches!(t, Text::Force(_)), 8)))
        .replace("    # READINGS\n", &lines_of(&of(|t| matches!(t, Text::Reading(_)), 4)));
    Some(text)
}

fn lines_of(text: &str) -> String {
    if text.is_empty() { String::new() } else { format!("{text}\n") }
}

fn indented(lines: &[String], by: usize) -> String {
    lines.iter().map(|l| format!("{:by$}{l}", "")).collect::<Vec<_>>().join("\n")
}
