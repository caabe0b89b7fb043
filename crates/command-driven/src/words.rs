//! The answer of a command-driven case in sentences.

use crate::identify::Identify;
use crate::left::{Remains, SIGNALS};
use crate::run::ResponseRun;
use crate::search::{Part, Trial};
use crate::settings::SETTINGS;
use verdict::{Diagnosis, Parameter, Response, Verdict};

/// Why a law that forecasts wheel speeds is not believed: the heading of the body without and with it, rad.
pub(crate) fn contradicted([before, after]: [f64; 2]) -> String {
    format!(
        "the response that forecasts the wheel speeds best sends the body elsewhere: the heading is then off by {after:.2} rad (rms) in forecasts \
         over 2 s, and by {before:.2} rad without it; so it is not believed"
    )
}

/// Errors that the sentences give: as it is, re-tuned, corrected, placebo, drive corrected alone (rms).
pub(crate) struct Figures {
    pub(crate) wheel: [f64; 5],
    pub(crate) position: Option<[f64; 5]>,
    pub(crate) yaw: [f64; 5],
}

/// A number with as many digits as its interval deserves.
fn value(p: &Parameter) -> String {
    let unit = if p.unit == "-" { String::new() } else { format!(" {}", p.unit) };
    match p.half_width.filter(|h| *h > 0.0 && h.is_finite()) {
        Some(h) => {
            let digits = (1 - h.log10().floor() as i32).clamp(0, 4) as usize;
            format!("{:.digits$} ± {h:.digits$}{unit}", p.value)
        }
        None => format!("{:.3}{unit}", p.value),
    }
}

fn find<'a>(r: &'a Response, id: &str) -> Option<&'a Parameter> {
    r.parameters.iter().find(|p| p.id == id)
}

fn list(r: &Response, items: &[(&str, &str)]) -> Vec<String> {
    items.iter().filter_map(|(id, what)| find(r, id).map(|p| format!("{what} {}", value(p)))).collect()
}

/// The answer in sentences, the most important one first.
pub(crate) fn sentences(
    d: &Diagnosis,
    r: &Response,
    figures: (&Figures, bool),
    track: f64,
    references: bool,
    remains: &Remains,
    begun: Vec<String>,
) -> Vec<String> {
    let mut out = if d.verdict == Verdict::Unknown { unknown(remains) } else { Vec::new() };
    if d.verdict == Verdict::Unknown && r.parameters.is_empty() {
        return out;
    }
    let what_is_known = explained(d, r, figures, track, references);
    if d.verdict == Verdict::Unknown {
        out.push("What is known of the rest explains little:".to_owned());
    }
    out.extend(what_is_known);
    // What began comes right behind what leads.
    out.splice(1..1, begun);
    if d.verdict == Verdict::Explained && remains.something() > SETTINGS.left.likely {
        out.push(format!("Something else is missing as well, of which no cause is known: {}", where_left(remains)));
    }
    out
}

/// What is another one since an instant: constants before and after.
pub(crate) fn begun<I: Identify>(of: &I, t: &Trial<I::Law>, runs: &[ResponseRun]) -> Option<String> {
    let began = t.began.as_ref()?;
    let when = began.instants.iter().filter_map(|i| {
        let [from, until] = i.range?;
        Some(format!("{:.0} s of '{}' (90 %: {from:.0} to {until:.0} s)", i.interval[0], runs[i.run].name))
    });
    let part = of.part(&began.windows[1]);
    let number = |v: f64, unit: &str| {
        let unit = if unit == "-" { String::new() } else { format!(" {unit}") };
        if v.is_finite() { format!("{v:.3}{unit}") } else { "no limit".to_owned() }
    };
    let changes = began.changed.iter().flat_map(|e| part.free(t.model.law, *e)).map(|k| {
        let c = &part.constants()[k];
        let [then, now] = [&began.before.model, &t.model].map(|m| number(m.x[k], c.unit));
        format!("{} {now} instead of {then}", c.id.replace('_', " "))
    });
    Some(format!(
        "It begins inside a recording: from {} on the robot answers otherwise than before: {}.",
        when.collect::<Vec<_>>().join(", "),
        changes.collect::<Vec<_>>().join(", ")
    ))
}

/// What no cause explains, where and when, and what to do.
fn unknown(remains: &Remains) -> Vec<String> {
    vec![
        format!(
            "Unknown: no cause of the catalogue explains these recordings; {:.0} % of the mismatch is left.",
            100.0 * remains.share
        ),
        format!("The mismatch is {}", where_left(remains)),
        "Look at what acts on the robot there and then, and record a drive in which it shows again.".to_owned(),
    ]
}

/// "on the left side: ... is off by ...", with the clearest stretch.
fn where_left(remains: &Remains) -> String {
    let worst = remains.worst();
    let (signal, unit) = SIGNALS[worst];
    let when = remains.spans.iter().find(|s| s.signal == signal).map_or(String::new(), |s| {
        format!(", most clearly from {:.0} to {:.0} s of '{}'", s.interval[0], s.interval[1], s.recording)
    });
    let given = if worst < 2 { "from the commands" } else { "from the measured wheel speeds" };
    format!(
        "{}: forecast {given}, the {signal} is off by {:.3} {unit} rms on windows left out of the fit, where {:.3} {unit} \
         would be usual{when}.",
        remains.place(),
        remains.error[worst],
        remains.floor[worst]
    )
}

/// What is said of the response where something beside it is missing.
pub(crate) const NOTHING_ELSE: &str =
    "Nothing else is missing: the wheels do what is commanded and the body follows them, as the simulation says.";

/// What the named causes say.
/// `is_drive_confirmed`: whether forecasts of the wheels gain by what was fitted between command and wheel.
fn explained(
    d: &Diagnosis,
    r: &Response,
    (figures, is_drive_confirmed): (&Figures, bool),
    track: f64,
    references: bool,
) -> Vec<String> {
    if d.verdict == Verdict::NoMismatch {
        let none = "No mismatch: the wheels do what is commanded and the body follows them, as the simulation says.";
        return std::iter::once(none.to_owned()).chain(retuned(d)).collect();
    }
    let drive = is_drive_confirmed && r.parameters.iter().any(|p| p.element.is_drive());
    let ground = r.parameters.iter().any(|p| !p.element.is_drive());
    let simulation = if references { "the references' response" } else { "the command" };
    let mut out = Vec::new();
    let w = &figures.wheel;
    if drive {
        out.push(format!(
            "The wheels do not do what is commanded, and neither slip nor friction explains it: \
             their speeds differ from {simulation} by {:.2} rad/s rms. With the drive's \
             controller as fitted, {:.2} rad/s remain on windows left out of the fit; with each \
             side responding on its own, as under friction or slip, {:.2} rad/s remain.",
            w[0], w[2], w[3]
        ));
        out.push(controller(r));
    } else {
        out.push(format!(
            "The wheels do what is commanded (within {:.2} rad/s rms): the mismatch arises \
             between wheels and ground.",
            w[0]
        ));
    }
    if ground {
        out.push(on_ground(r, track));
    } else {
        out.push(
            "From wheel to body nothing is missing: the body follows the wheels without \
                  further slip."
                .to_owned(),
        );
    }
    out.extend(retuned(d));
    let mut shares = Vec::new();
    for (what, unit, e) in figures.position.iter().map(|e| ("position", "m", e)).chain([("yaw", "rad", &figures.yaw)]) {
        shares.push(format!(
            "{what} {:.2} {unit} as simulated, {:.2} with track and radius re-tuned, {:.2} with the drive alone corrected, \
             {:.2} with both",
            e[0], e[1], e[4], e[2]
        ));
    }
    out.push(format!(
        "Rms error of forecasts over 2 s from the commands alone, on windows left \
                      out of the fit: {}.",
        shares.join("; ")
    ));
    out
}

/// What was fitted and confirmed by nothing.
pub(crate) fn not_taken(ratio: f64) -> String {
    format!(
        "constants of the response were fitted and are not told: windows left out of the fit are forecast with {ratio:.2} times the \
         error that they have without them"
    )
}

/// Constants within the sigma of the robot file.
fn retuned(d: &Diagnosis) -> impl Iterator<Item = String> {
    d.retuned.iter().map(|r| format!("Re-tune {}.", r.sentence()))
}

fn controller(r: &Response) -> String {
    let mut parts = list(
        r,
        &[
            ("dead_time", "dead time"),
            ("forward_gain", "gain of forward speed"),
            ("turn_gain", "of turning"),
            ("side_gain", "difference of the sides"),
            ("turn_limit", "turning (half the difference of the sides) limited to"),
            ("forward_limit", "forward speed (mean of the sides) limited to"),
        ],
    );
    if let Some(p) = find(r, "wheel_limit") {
        let how = r
            .scaling
            .as_deref()
            .filter(|_| r.scaling_is_told)
            .unwrap_or("speeds are limited (these recordings do not tell whether each side is clipped alone or both are slowed together)");
        parts.push(format!("from a wheel speed of {} on, {how}", value(p)));
    }
    parts.extend(list(
        r,
        &[
            ("forward_ramp", "acceleration of forward speed limited to"),
            ("turn_ramp", "of turning to"),
            ("side_ramp", "acceleration of each side limited to"),
            ("lag", "lag"),
            ("natural_frequency", "second-order lag of"),
            ("damping", "damping"),
        ],
    ));
    format!("From command to wheel, with 90 % intervals: {}.", parts.join(", "))
}

fn on_ground(r: &Response, track: f64) -> String {
    let mut parts = Vec::new();
    if let Some(p) = find(r, "track_factor") {
        let half = p.half_width.map_or(String::new(), |h| format!(" ± {:.3}", h * track));
        let times = p.value / p.simulated.unwrap_or(1.0);
        parts.push(format!("effective track {:.3}{half} m, {times:.2} times the simulated", p.value * track));
    }
    parts.extend(list(
        r,
        &[
            ("radius_factor", "rolling radius times"),
            ("centre_offset", "pose sensor ahead of the centre of rotation by"),
            ("turn_slip", "forward speed times exp(−c ψ̇²) in turns with c"),
            ("turn_slip_linear", "forward speed times exp(−c |ψ̇|) in turns with c"),
            ("body_lag", "body or pose late by"),
            ("side_radius", "left radius larger and right smaller by"),
        ],
    ));
    format!("From wheel to body, slip with 90 % intervals: {}.", parts.join(", "))
}
