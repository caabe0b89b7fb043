//! How the header stamps of a topic lie against its log times, in a sentence.

use recordings::{Delay, TopicContents};

/// What there is to say of a topic; nothing where messages have no header stamps.
pub(super) fn sentence(topic: &TopicContents) -> Option<String> {
    let (name, stamps) = (&topic.name, topic.stamps.as_ref()?);
    let Some(delay) = &stamps.delay else {
        let advice = "the driver does not set it; map the topic with time = { column = \"log_time\" }";
        return Some(format!("{name}: header.stamp is 0 in every message: {advice}"));
    };
    let mut out = format!("{name}: {}", told(delay));
    // Log times that are copies of the stamps tell nothing of clocks.
    let copied = delay.smallest_ms == 0.0 && delay.largest_ms == 0.0;
    if let Some(drift) = delay.drift.filter(|_| !copied) {
        let (from, to) = drift.between_ppm;
        out += &format!(", drift {} ppm ({} to {})", short(drift.ppm), short(from), short(to));
    }
    if stamps.unset > 0 {
        out += &format!("; header.stamp is 0 in {} of {} messages", stamps.unset, stamps.unset + stamps.set);
    }
    Some(out)
}

fn told(delay: &Delay) -> String {
    let Delay { median_ms, smallest_ms, largest_ms, .. } = *delay;
    if smallest_ms == 0.0 && largest_ms == 0.0 {
        return "logged at its stamp throughout".to_owned();
    }
    // A stamp after the log time is reported as such, not as a delay below zero.
    let (sign, word, [least, most]) = if median_ms < 0.0 {
        (-1.0, "before", [largest_ms, smallest_ms])
    } else {
        (1.0, "after", [smallest_ms, largest_ms])
    };
    let (factor, unit) = if least.abs().max(most.abs()) < 1e4 { (1.0, "ms") } else { (1e-3, "s") };
    let [median, least, most] = [median_ms, least, most].map(|ms| short(sign * factor * ms));
    format!("logged {median} {unit} ({least} to {most} {unit}) {word} its stamp")
}

/// A number with two digits that count, or all before the point.
fn short(x: f64) -> String {
    if x == 0.0 {
        return "0".to_owned();
    }
    let decimals = (1 - x.abs().log10().floor() as i32).clamp(0, 6) as usize;
    let text = format!("{x:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::short;

    #[test]
    fn numbers_are_short() {
        let shown = [1.94, 0.4, 12.4, 1234.5, -0.0312, 0.0, 1.0, 1e-9].map(short);
        assert_eq!(shown, ["1.9", "0.4", "12", "1234", "-0.031", "0", "1", "0"]);
    }
}
