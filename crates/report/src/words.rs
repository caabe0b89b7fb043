//! How probabilities, sizes, places and times are written for people: on pages and on the terminal.

use verdict::{Cause, Cell, Diagnosis, FreeRun, Span, Verdict};

pub use inference::robust::NINETY;
pub use inference::words::probability;

pub use pages::text_table::number;
/// Intervals shown per cause.
const INTERVALS: usize = 3;

/// Whether a cause is "nothing is missing" or "something that is not in the catalogue": answers, but no causes.
pub fn is_no_cause(c: &Cause) -> bool {
    c.effect == "none" || c.effect == "unknown"
}

/// The size of a cause and its 90 % interval, with as many digits as that deserves; empty where they are not known.
pub fn size(c: &Cause) -> [String; 2] {
    let Some(m) = c.magnitude else { return Default::default() };
    let unit = if c.unit == "-" { String::new() } else { format!(" {}", c.unit) };
    let Some(half) = c.sigma.map(|s| NINETY * s).filter(|h| *h > 0.0 && h.is_finite()) else {
        return [number(m) + &unit, String::new()];
    };
    let digits = (1 - half.log10().floor() as i32).clamp(0, 6) as usize;
    [format!("{m:.digits$}{unit}"), format!("[{:.digits$}, {:.digits$}]", m - half, m + half)]
}

/// The same, with the interval as words.
pub(crate) fn size_in_words(c: &Cause) -> [String; 2] {
    let [value, interval] = size(c);
    let interval = interval.trim_matches(['[', ']']).replace(", ", " to ");
    [value, if interval.is_empty() { interval } else { format!("90\u{a0}%: {interval}") }]
}

/// Side, place and time of a cause.
pub fn where_and_when(c: &Cause) -> String {
    let mut parts = Vec::new();
    if let Some(side) = &c.side {
        parts.push(side.to_string());
    }
    if let Some([x, y, r]) = c.place {
        parts.push(format!("within {r:.2} m of ({x:.2}, {y:.2}) m"));
    }
    let intervals = c.intervals.iter().flatten();
    let spans: Vec<String> =
        intervals.flat_map(|(run, spans)| spans.iter().map(move |[a, b]| format!("{run} {a:.1}-{b:.1} s"))).collect();
    if !spans.is_empty() {
        let more = spans.len().saturating_sub(INTERVALS);
        let more = if more > 0 { format!(" and {more} more") } else { String::new() };
        parts.push(spans[..spans.len().min(INTERVALS)].join(", ") + &more);
    }
    let at_bounds: Vec<String> = c.at_bounds().map(|(name, value)| format!("{name} = {}", number(value))).collect();
    if !at_bounds.is_empty() {
        parts.push(format!("at the end of its range: {}", at_bounds.join(", ")));
    }
    parts.join("; ")
}

/// The range of a cell.
pub fn range(cell: &Cell) -> String {
    match cell.range.as_slice() {
        [[a, b]] if cell.by == "heading" => format!("{:.0}° to {:.0}°", a.to_degrees(), b.to_degrees()),
        [[a, b]] => format!("{a} to {b} {}", cell.unit),
        [[a, b], [c, d]] => format!("x {a} to {b}, y {c} to {d} {}", cell.unit),
        _ => String::new(),
    }
}

/// Beginning and end of a stretch, each with its 90 % interval.
pub fn borders(s: &Span) -> [String; 2] {
    let at = |t: f64, range: Option<[f64; 2]>, border: &str| {
        range.map_or_else(|| border.to_owned(), |[a, b]| format!("{t:.1} s [{a:.1}, {b:.1}]"))
    };
    [at(s.interval[0], s.onset, "start"), at(s.interval[1], s.end, "end")]
}

/// What the errors of a diagnosis's free runs are errors of.
pub fn free_runs(d: &Diagnosis) -> &'static str {
    if d.response.is_some() {
        "Forecasts over windows of 2 s from the commands alone (placebo: the best wrong cause \
         with as many constants)"
    } else if d.steady.is_some() {
        "Forecasts of recordings left out of the fit (rms error; placebo: the best other law)"
    } else if d.verdict == Verdict::Unknown && d.free_runs.iter().any(|r| r.placebo.is_some()) {
        "Free runs on recordings left out of the fit, restarted from a measured state every 2 s unless the row says \
         otherwise (rms error; corrected: with the nearest effect, which does not explain them; placebo: the best other effect)"
    } else if d.free_runs.iter().any(|r| r.placebo.is_some()) {
        "Free runs on recordings left out of the fit, restarted from a measured state every 2 s unless the row says \
         otherwise (rms error; placebo: the best other effect)"
    } else {
        "Free runs on recordings left out of the fit, restarted from a measured state every 2 s unless the row says \
         otherwise (rms error)"
    }
}

/// A ratio as a change; with a minus that is one.
pub(crate) fn percent(ratio: f64) -> String {
    format!("{:+.0}\u{a0}%", 100.0 * (ratio - 1.0)).replace('-', "−")
}

/// A quantity that ends with its unit, taken apart.
pub(crate) fn quantity_and_unit(quantity: &str) -> (String, String) {
    // "torque of a side, N m, last third": what follows the unit belongs to the name.
    let parts: Vec<&str> = quantity.split(", ").collect();
    match parts.as_slice() {
        [name, unit] => ((*name).to_owned(), (*unit).to_owned()),
        [name, unit, rest @ ..] => (format!("{name}, {}", rest.join(", ")), (*unit).to_owned()),
        _ => (quantity.to_owned(), String::new()),
    }
}

/// Quantities of free runs in the order in which they come.
pub(crate) fn quantities(runs: &[FreeRun]) -> Vec<&str> {
    let mut out: Vec<&str> = Vec::new();
    for r in runs {
        if !out.contains(&r.quantity.as_str()) {
            out.push(&r.quantity);
        }
    }
    out
}

/// The sentences that give the verdict: the first, and those that name further causes in the same way. Their
/// probabilities are shown beside them.
pub(crate) fn verdict(d: &Diagnosis, most: usize) -> Vec<String> {
    let kind = |s: &str| s.split_once(": ").map(|s| s.0.to_owned());
    let first = d.sentences.first().map(String::as_str).unwrap_or_default();
    let more = d.sentences.iter().skip(1).take_while(|s| kind(s).is_some() && kind(s) == kind(first));
    std::iter::once(first)
        .chain(more.map(String::as_str))
        .take(most)
        .map(|s| s.split_once(" (probability").map_or_else(|| s.to_owned(), |s| format!("{}.", s.0)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::{quantity_and_unit, where_and_when};
    use verdict::{Cause, Estimate};

    #[test]
    fn a_number_at_the_end_of_its_range_is_told_by_name() {
        let mut cause = Cause::plain("stiction", "stiction", 0.8);
        for (name, value, at_bound) in [("Ts", 0.0, true), ("v", 0.1, false)] {
            cause.parameters.insert(name.to_owned(), Estimate { value, sigma: None, at_bound });
        }
        assert_eq!(where_and_when(&cause), "at the end of its range: Ts = 0");
    }

    #[test]
    fn units_are_told_from_names() {
        let parts = |s| quantity_and_unit(s);
        assert_eq!(parts("yaw rate, rad/s"), ("yaw rate".to_owned(), "rad/s".to_owned()));
        assert_eq!(parts("yaw rate, rad/s, last third"), ("yaw rate, last third".to_owned(), "rad/s".to_owned()));
        assert_eq!(parts("share"), ("share".to_owned(), String::new()));
    }
}
