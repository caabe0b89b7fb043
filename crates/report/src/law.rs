//! A law for what has no name, in the words of the field.

use verdict::{Claim, Event, FoundEvents, FoundLaw, FoundPlace, LawFreeRun, Opposed, Shared, UnnamedCause, one_of};

/// What is told of a cause without a name: a label and a text for each line; empty where nothing was found.
pub(crate) fn lines(cause: &UnnamedCause) -> Vec<(&'static str, String)> {
    let mut out = Vec::new();
    match (&cause.claim, &cause.law) {
        (Claim::Events, _) => out.extend(cause.events.iter().flat_map(of_events)),
        (Claim::Place, None) => out.extend(cause.place.iter().flat_map(of_place)),
        (Claim::Law, Some(law)) => out.extend(of_law(law)),
        (Claim::Place, Some(law)) => {
            out.push(("where", place(law)));
            out.push((
                "law",
                format!("none in the measured signals predicts it (the best leaves {:.0} %)", 100.0 * law.left),
            ));
        }
        _ => out.push(("law", "none was found that fits".to_owned())),
    }
    if cause.is_without_references() {
        out.push(("without references", "it may be what the simulation lacks in every drive of this robot".to_owned()));
    }
    out.extend(in_every_drive(cause));
    out
}

fn in_every_drive(cause: &UnnamedCause) -> Option<(&'static str, String)> {
    let common = cause.in_every_drive.as_ref()?;
    let text = format!(
        "{}: {}; its coefficient in the references is {:.2} of that in the recordings, so that it is not what differs. `lacuna law VERDICT.json --in-every-drive \
         --save law.toml` writes it, and `lacuna diagnose ... --adopt law.toml` takes it into the simulation",
        common.place, common.formula, common.in_references
    );
    Some(("lacks in every drive", text))
}

/// What the references hold of it.
fn in_references(told: Option<String>) -> String {
    told.map_or_else(String::new, |told| format!(" (references: {told})"))
}

/// Events that are listed one by one; of more, a line tells how many there are.
const LISTED: usize = 12;

fn of_events(found: &FoundEvents) -> Vec<(&'static str, String)> {
    let place = one_of(&found.place, &found.places_alike);
    let mut recordings: Vec<&str> = found.events.iter().map(|e| e.recording.as_str()).collect();
    recordings.dedup();
    let lengths = found.events.iter().map(|e| e.until - e.from);
    let (shortest, longest) = lengths.fold((f64::MAX, 0.0_f64), |(a, b), x| (a.min(x), b.max(x)));
    let mut out = vec![
        ("where", place),
        (
            "events",
            format!(
                "{} in {} recordings, of {shortest:.1} to {longest:.1} s, in {:.0} % of the time{}; \
                 free runs with them leave {:.0} % of what re-tuning leaves unexplained",
                found.events.len(),
                recordings.len(),
                100.0 * found.filled,
                in_references(found.in_references.map(|share| format!("{:.1} %", 100.0 * found.filled * share))),
                100.0 * found.left.max(0.0)
            ),
        ),
    ];
    out.extend(found.events.iter().take(LISTED).map(|e| ("when", of_event(e))));
    if found.events.len() > LISTED {
        out.push(("when", format!("and {} more (--json lists all)", found.events.len() - LISTED)));
    }
    out.extend(found.opposed.iter().map(|o| ("acts", against(o))));
    out.extend(found.shared.iter().map(|s| ("in common", in_common(s))));
    if found.shared.is_empty() {
        out.push(("in common", "nothing in the measured signals".to_owned()));
    }
    out.push(("law", "none in the measured signals predicts them, so that no forecast is offered".to_owned()));
    out
}

fn of_place(found: &FoundPlace) -> Vec<(&'static str, String)> {
    let mut place = one_of(&found.place, &found.places_alike);
    if let Some((next, worse)) = &found.next_place {
        place = format!("{place} [next likeliest place: {next}, whose log-likelihood is {worse:.0} nats lower]");
    }
    let unit = if found.unit == "1" { String::new() } else { format!(" {}", found.unit) };
    vec![
        ("where", place),
        (
            "how much",
            format!(
                "{:.2}{unit} rms{}; an input there that the fit may choose anew every 0.1 s leaves {:.0} % of \
                 what re-tuned constants leave unexplained",
                found.size,
                in_references(found.in_references.map(|share| format!("{:.0} % of its mean square", 100.0 * share))),
                100.0 * found.left.max(0.0)
            ),
        ),
        ("law", "none in the measured signals predicts it, so that no forecast is offered".to_owned()),
    ]
}

fn of_event(e: &Event) -> String {
    let unit = if e.unit == "1" { String::new() } else { format!(" {}", e.unit) };
    format!(
        "{}, {:.1} to {:.1} s: {} {:+.2} \u{b1} {:.2}{unit} (90 %) against the simulation",
        e.recording, e.from, e.until, e.input, e.size, e.half
    )
}

fn against(o: &Opposed) -> String {
    let like = o.like.as_ref().map_or_else(String::new, |like| format!(", as {like}"));
    format!(
        "against the commanded torque in {:.0} % of the windows of 0.1 s with an event (the drive delivers {:.0} % less, median), \
         against the wheel's motion in {:.0} %{like}",
        100.0 * o.torque,
        100.0 * o.of_torque,
        100.0 * o.motion
    )
}

fn in_common(s: &Shared) -> String {
    let unit = if s.unit == "1" { String::new() } else { format!(" {}", s.unit) };
    format!(
        "{:.0} % of them begin with an amount of {} {} {:.2}{unit}, as {:.0} % of all other windows have",
        100.0 * s.of_events,
        s.variable,
        if s.above { "above" } else { "below" },
        s.bound,
        100.0 * s.elsewhere
    )
}

fn of_law(law: &FoundLaw) -> Vec<(&'static str, String)> {
    let mut out = vec![("where", place(law)), ("law", law.formula.clone())];
    let number = |n: &verdict::LawNumber| {
        let half = n.half.map_or("not determined".to_owned(), |half| format!("± {half:.2e}"));
        format!("{} {:.4} {half} {}", n.of, n.value, n.unit)
    };
    out.push(("numbers (90 %)", law.numbers.iter().map(number).collect::<Vec<_>>().join("; ")));
    if let Some((name, share)) = &law.nearest_name {
        out.push(("like", format!("{name} explains {:.0} % of what this law explains", 100.0 * share)));
    }
    let ranges = law.seen.iter().map(|(symbol, [low, high])| format!("{symbol} {low:.3} to {high:.3}"));
    let gains: Vec<String> = law.gains.iter().map(|(name, gain)| format!("{name} {gain:.0}")).collect();
    let seen: Vec<String> = ranges.chain([format!("gains in nats: {}", gains.join(", "))]).collect();
    out.push(("seen", seen.join("; ")));
    out.extend(proof(&law.free_runs).map(|text| ("proof", text)));
    let alike = if law.alike.is_empty() { "none".to_owned() } else { law.alike.join(" | ") };
    out.push(("cannot be told from", alike));
    out
}

fn place(law: &FoundLaw) -> String {
    let mut out = one_of(&law.place, &law.places_alike);
    if let Some((next, worse)) = &law.next_place {
        out = format!("{out} [next likeliest place: {next}, whose log-likelihood is {worse:.0} nats lower]");
    }
    out
}

/// Errors on recordings that were left out, over all of them.
fn proof(rows: &[LawFreeRun]) -> Option<String> {
    let mut quantities: Vec<&str> = rows.iter().map(|r| r.quantity.as_str()).collect();
    quantities.sort_unstable();
    quantities.dedup();
    let of = |quantity: &str| {
        let own = || rows.iter().filter(|r| r.quantity == quantity);
        let rms = |read: &dyn Fn(&LawFreeRun) -> f64| {
            (own().map(|r| read(r).powi(2)).sum::<f64>() / own().count().max(1) as f64).sqrt()
        };
        let named = rms(&|r| r.named.unwrap_or(r.retuned));
        format!(
            "{quantity}: as it is {:.3}, re-tuned {:.3}, best name {named:.3}, law {:.3}, law shifted in time {:.3}",
            rms(&|r| r.nominal),
            rms(&|r| r.retuned),
            rms(&|r| r.law),
            rms(&|r| r.shifted)
        )
    };
    let all: Vec<String> = quantities.into_iter().map(of).collect();
    (!all.is_empty()).then(|| format!("drives not used; {}", all.join("; ")))
}
