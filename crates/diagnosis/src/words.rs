//! Sentences for people.

use robot_model::Card;

use crate::hypothesis::{Place, Variant};
use crate::locate;
use crate::redundancy::Fault;
use crate::steady::{NINETY, UNNAMED_STRAIGHT};
use crate::verdict::{Cause, Diagnosis, Verdict};

pub(crate) fn side(s: usize) -> &'static str {
    if s == 0 { "left" } else { "right" }
}

pub(crate) fn named(name: &str, on: Option<usize>) -> String {
    on.map_or_else(|| name.to_owned(), |s| format!("{name}: {}", side(s)))
}

/// Name of a sensor fault: with its side, and with its number where the effect has several.
pub(crate) fn fault(f: &Fault) -> String {
    let card = f.card;
    let name = named(card.name, f.side);
    if card.strengths().count() > 1 { format!("{name}: {}", card.parameters[f.parameter].name) } else { name }
}

/// Unit of an effect's magnitude: that of its first strength.
pub(crate) fn unit(card: &Card) -> &'static str {
    card.strengths().next().map_or("-", |i| card.parameters[i].unit)
}

pub(crate) fn variant(v: &Variant) -> String {
    let card = v.card();
    let mut out = card.name.to_owned();
    if let Some(a) = v.axis {
        out = format!("{out}, along {}", card.axes[a]);
    }
    match v.place {
        Place::Whole => out,
        Place::Side(s) => named(&out, Some(s)),
        Place::Disc => out + ", at one place",
        Place::Onset => out + ", from an instant on",
    }
}

/// A number with as many digits as its uncertainty deserves.
pub(crate) fn quantity(c: &Cause) -> String {
    let Some(m) = c.magnitude else { return String::new() };
    let unit = if c.unit == "-" { String::new() } else { format!(" {}", c.unit) };
    match c.sigma.filter(|s| *s > 0.0 && s.is_finite()) {
        Some(s) => {
            let digits = (1 - s.log10().floor() as i32).clamp(0, 6) as usize;
            format!("{m:.digits$} ± {:.digits$}{unit} (90 %)", NINETY * s)
        }
        None => format!("{m:.3}{unit}"),
    }
}

/// The answer in sentences, the most important one first.
pub(crate) fn sentences(d: &Diagnosis) -> Vec<String> {
    let mut out = Vec::new();
    let causes: Vec<&Cause> = d.ranked.iter().filter(|c| c.effect != "none" && c.effect != "unknown").collect();
    match d.verdict {
        Verdict::NoMismatch => out.push("No mismatch: the calibrated simulation explains these recordings.".to_owned()),
        Verdict::Unknown => {
            out.push(
                "The simulation lacks something that is not in the catalogue: no effect in it explains these recordings.".to_owned(),
            );
            if let Some(c) = causes.first() {
                out.push(format!("The nearest is {}, {}, but it leaves too much.", c.name, quantity(c)));
            }
        }
        Verdict::Explained => {
            for c in causes.iter().filter(|c| c.probability > 0.5) {
                let place =
                    c.place.map_or(String::new(), |p| format!(" within {:.2} m of ({:.2}, {:.2}) m", p[2], p[0], p[1]));
                out.push(format!("Missing: {}, {}{place} (probability {:.2}).", c.name, quantity(c), c.probability));
            }
            if out.is_empty()
                && let Some(c) = causes.first()
            {
                out.push(format!(
                    "Most likely missing: {}, {} (probability {:.2}).",
                    c.name,
                    quantity(c),
                    c.probability
                ));
            }
        }
        Verdict::Withheld => out.push("These recordings permit no answer.".to_owned()),
    }
    for class in &d.indistinguishable {
        out.push(format!("These recordings cannot tell apart: {}.", class.join(", ")));
    }
    let unknown = d.ranked.iter().find(|c| c.effect == "unknown").map_or(0.0, |c| c.probability);
    if d.verdict == Verdict::Explained && unknown > 0.5 {
        out.push(format!(
            "Beside that, something is missing that the catalogue does not hold (probability {unknown:.2})."
        ));
    }
    if let Some(r) = d.located.remainder.as_ref().filter(|_| d.verdict != Verdict::NoMismatch) {
        out.push(locate::sentence(r));
    }
    out
}

/// The drive that reveals an effect best.
fn revealed_by(id: &str) -> Option<&'static str> {
    robot_model::effects::catalogue::<f64>().iter().map(|e| e.card()).find(|c| c.id == id).map(|c| c.revealed_by)
}

/// The answer of a speed-driven case in sentences.
pub(crate) fn steady(d: &Diagnosis, loads: &crate::steady::Loads, set_points: bool) -> Vec<String> {
    let mut out = Vec::new();
    match d.verdict {
        Verdict::Withheld => out.push("These recordings permit no answer: too little steady driving.".to_owned()),
        Verdict::NoMismatch => out.push("No mismatch that these loads could name.".to_owned()),
        Verdict::Unknown => {
            out.push("The loads differ, but in a way that no effect in the catalogue explains.".to_owned());
        }
        Verdict::Explained => {
            let name = |id: &str| d.ranked.iter().find(|c| c.effect == id).map_or(id.to_owned(), |c| c.name.clone());
            for class in &d.indistinguishable {
                let names: Vec<String> = class.iter().map(|i| name(i)).collect();
                let size = d.ranked.iter().find(|c| Some(&c.effect) == class.first()).map_or(String::new(), quantity);
                let tail = if names.len() > 1 {
                    "; these recordings cannot tell them apart".to_owned()
                } else {
                    format!(", {size}")
                };
                out.push(format!("Missing: {}{tail}.", names.join(" or ")));
                // The drives that reveal the members split the class; the first three are enough to begin with.
                let mut drives: Vec<&str> = Vec::new();
                for drive in class.iter().filter_map(|id| revealed_by(id)) {
                    if !drives.contains(&drive) && drives.len() < 3 {
                        drives.push(drive);
                    }
                }
                if class.len() > 1 {
                    out.push(format!("To tell them apart, record: {}.", drives.join("; ")));
                }
            }
        }
    }
    let pooled = |r: &&crate::steady::Ratio| {
        !loads.pooled.iter().any(|p| p.quantity == r.quantity && p.recording.split(", ").any(|n| n == r.recording))
    };
    for r in loads.pooled.iter().chain(loads.ratios.iter().filter(pooled)) {
        out.push(load(r));
    }
    if set_points && !loads.ratios.is_empty() {
        out.push("All figures compare set speeds, not measured ones.".to_owned());
    }
    out
}

fn load(r: &crate::steady::Ratio) -> String {
    use crate::steady::Quantity;
    let [slow, fast] = r.range;
    let at = match r.quantity {
        Quantity::StraightLoad | Quantity::Asymmetry if fast - slow > 0.05 => format!(" at {slow:.2} to {fast:.2} m/s"),
        Quantity::StraightLoad | Quantity::Asymmetry => format!(" at {:.2} m/s", r.speed[1]),
        _ => String::new(),
    };
    let what = r.quantity.name();
    let [a, b] = r.interval;
    if r.quantity == Quantity::EffectiveTrack {
        return format!(
            "{}: {what} {:.3} ± {:.3} m (90 %), {:.2} of the references'.",
            r.recording, r.value, r.half, r.ratio
        );
    }
    if r.quantity == Quantity::Asymmetry {
        return format!("{}: {what}{at} {:+.2} beyond the references' [{a:+.2}, {b:+.2}].", r.recording, r.ratio);
    }
    let judgement = if a > 1.0 || b < 1.0 {
        if r.quantity == Quantity::StraightLoad && a < UNNAMED_STRAIGHT && b > 1.0 / UNNAMED_STRAIGHT {
            ": differs, but cold drive trains vary as much: unexplained"
        } else {
            ""
        }
    } else {
        ": no difference"
    };
    let firm = if r.firm { "" } else { ", tentative" };
    format!(
        "{}: {what}{at} {:.2} times the references' [{a:.2}, {b:.2}] (90 %), from {:.0} s{firm}{judgement}.",
        r.recording, r.ratio, r.seconds
    )
}
