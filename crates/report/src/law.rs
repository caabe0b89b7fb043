//! A law for what has no name, in the words of the field.

use verdict::{Claim, FoundLaw, LawFreeRun, UnnamedCause};

/// What is told of a cause without a name: a label and a text for each line; empty where nothing was found.
pub(crate) fn lines(cause: &UnnamedCause) -> Vec<(&'static str, String)> {
    let mut out = Vec::new();
    match (&cause.claim, &cause.law) {
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
    if let Some(common) = &cause.in_every_drive {
        let text = format!(
            "{}: {} (references {:.2} of the recordings'); it is not what differs",
            common.place, common.formula, common.in_references
        );
        out.push(("lacks in every drive", text));
    }
    out
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
    let mut out = law.place.clone();
    if !law.places_alike.is_empty() {
        out = format!("{out}, or {}", law.places_alike.join(", or "));
    }
    if let Some((next, worse)) = &law.next_place {
        out = format!("{out} [next place: {next}, {worse:.0} nats worse]");
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
