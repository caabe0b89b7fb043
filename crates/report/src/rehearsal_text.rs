//! A rehearsal as text: which effects would be found, from which size on, and what is taken for what.

use inference::rate::Rate;
use inference::words::two_digits;
use pages::text_table::TextTable;
use verdict::{Answers, FoundFrom, Rehearsal, RehearsedEffect, RehearsedSize};

use crate::sections::{heading, listed};
use crate::words::number;

/// Other names that a row shows.
const SHOWN: usize = 3;

/// A rehearsal as text for a terminal.
pub fn render(rehearsal: &Rehearsal) -> String {
    let mut out = format!("{}\n", false_alarms(&rehearsal.fault_free));
    if !rehearsal.effects.is_empty() {
        for part in ["\n", &heading("Effects that would be found"), &effects(rehearsal), LEGEND] {
            out += part;
        }
    }
    let left_out: Vec<String> = rehearsal.left_out.iter().map(|l| format!("{}: {}", l.effect, l.why)).collect();
    out += &listed("Not rehearsed", &left_out);
    out += &listed("What was driven", &driven(rehearsal));
    out += &listed("Shortened", &rehearsal.shortened);
    out += &listed("What limits this", &rehearsal.limits);
    out
}

/// How to read the table.
const LEGEND: &str = "  at 1 x: replicas that name it first + those whose answer holds it beside or in one class with another, of all;
    -: a size beyond what the catalogue calls sensible
  otherwise: what was answered instead; look-alikes: other names in the answers, and in how many of those that name anything
";

/// How often nothing was alarmed for, in a sentence.
pub(crate) fn false_alarms(answers: &Answers) -> String {
    let rate = Rate { hits: answers.alarmed(), count: answers.replicas };
    let [low, high] = rate.interval().map(|share| 100.0 * share);
    let names: Vec<String> = answers.others.iter().map(|(name, count)| format!("{name} {count}")).collect();
    let named = if names.is_empty() { String::new() } else { format!(", named: {}", names.join(", ")) };
    let withheld = match answers.withheld {
        0 => String::new(),
        n => format!("; {n} got no answer"),
    };
    format!(
        "False alarms: {} of {} replicas in which nothing was hidden (95 %: {low:.0} to {high:.0} %){named}{withheld}.",
        rate.hits, rate.count
    )
}

fn effects(rehearsal: &Rehearsal) -> String {
    let mut multiples: Vec<f64> =
        rehearsal.effects.iter().flat_map(|effect| effect.sizes.iter().map(|size| size.multiple)).collect();
    multiples.sort_unstable_by(f64::total_cmp);
    multiples.dedup();

    let mut columns = vec!["effect".to_owned(), ">size of interest".to_owned(), ">found from".to_owned()];
    let at = multiples.iter().enumerate();
    columns.extend(at.map(|(place, m)| if place == 0 { format!(">at {m} x") } else { format!(">{m} x") }));
    columns.extend(["otherwise", "look-alikes"].map(str::to_owned));
    let mut table = TextTable::new(&columns.iter().map(String::as_str).collect::<Vec<_>>());
    for effect in &rehearsal.effects {
        let cell = |multiple: &f64| {
            let size = effect.sizes.iter().find(|size| size.multiple == *multiple);
            size.map_or_else(|| "-".to_owned(), |size| share(&size.answers))
        };
        let first = [effect.effect.clone(), with_unit(effect.interest, effect), found_from(effect)];
        let last = [otherwise(&effect.sizes), look_alikes(effect, SHOWN)];
        table.row(first.into_iter().chain(multiples.iter().map(cell)).chain(last));
    }
    table.render()
}

/// A size with its unit.
pub(crate) fn with_unit(size: f64, effect: &RehearsedEffect) -> String {
    if ["-", "1"].contains(&&*effect.unit) { number(size) } else { format!("{} {}", number(size), effect.unit) }
}

/// From where on an effect is found, in words.
pub(crate) fn found_from(effect: &RehearsedEffect) -> String {
    match effect.found {
        FoundFrom::Below(size) => format!("{} or less", with_unit(size, effect)),
        FoundFrom::Size(size) => with_unit(size, effect),
        FoundFrom::Never => "not found".to_owned(),
    }
}

/// Found of all; those that were not named first behind a plus.
fn share(answers: &Answers) -> String {
    match answers.in_set {
        0 => format!("{}/{}", answers.first, answers.replicas),
        in_set => format!("{}+{in_set}/{}", answers.first, answers.replicas),
    }
}

/// Answers that do not hold the effect, over all sizes.
pub(crate) fn otherwise(sizes: &[RehearsedSize]) -> String {
    let sum = |of: fn(&Answers) -> usize| sizes.iter().map(|size| of(&size.answers)).sum::<usize>();
    let kinds = [
        ("nothing", sum(|a| a.nothing)),
        ("unknown", sum(|a| a.unknown)),
        ("another", sum(|a| a.wrong)),
        ("no answer", sum(|a| a.withheld)),
    ];
    let there = kinds.iter().filter(|(_, count)| *count > 0);
    there.map(|(kind, count)| format!("{kind} {count}")).collect::<Vec<_>>().join(", ")
}

/// Other names in the answers.
pub(crate) fn look_alikes(effect: &RehearsedEffect, most: usize) -> String {
    let all = &effect.look_alikes;
    let shown = all.iter().take(most).map(|alike| format!("{} {}/{}", alike.effect, alike.count, alike.of));
    let more = all.len().saturating_sub(most);
    let more = (more > 0).then(|| format!("{more} more"));
    shown.chain(more).collect::<Vec<_>>().join(", ")
}

/// What a replica consists of.
pub(crate) fn driven(rehearsal: &Rehearsal) -> Vec<String> {
    let drives = &rehearsal.drives;
    let recordings: Vec<String> =
        drives.recordings.iter().map(|(name, seconds)| format!("{name} ({seconds:.1} s)")).collect();
    let noise: Vec<String> = drives
        .noise
        .iter()
        .map(|n| format!("{} {} {} at {} Hz ({})", n.channel, number(n.sigma), n.unit, two_digits(n.rate), n.source))
        .collect();
    let mut out = vec![
        format!(
            "{} replicas of each size, {} with nothing hidden, seed {}; found is what at least {:.0} % of replicas have",
            drives.replicas,
            drives.fault_free_replicas,
            drives.seed,
            100.0 * drives.wanted_share
        ),
        format!("inputs of {}; {} fault-free references", recordings.join(", "), drives.references),
    ];
    if !noise.is_empty() {
        out.push(format!("noise (one sigma): {}", noise.join(", ")));
    }
    out
}

#[cfg(test)]
pub(crate) mod tests {
    use std::collections::BTreeMap;

    use verdict::{LookAlike, NotRehearsed, REHEARSAL_FORMAT, RehearsedDrives, SensorNoise};

    use super::*;

    /// A rehearsal of two effects.
    pub(crate) fn rehearsal() -> Rehearsal {
        let size = |multiple: f64, first: usize, in_set: usize| RehearsedSize {
            multiple,
            size: 2.0 * multiple,
            answers: Answers { replicas: 4, first, in_set, nothing: 4 - first - in_set, ..Answers::default() },
            found: [0.25 * (first + in_set) as f64, 0.1, 0.9],
            driven: 1.0,
        };
        let effect = |id: &str, found: FoundFrom| RehearsedEffect {
            effect: id.to_owned(),
            name: format!("{id} <my-name>"),
            interest: 2.0,
            unit: "kg".into(),
            sizes: vec![size(0.5, 0, 0), size(1.0, 1, 2)],
            found,
            look_alikes: vec![LookAlike { effect: "grade".to_owned(), count: 2, of: 3 }],
        };
        Rehearsal {
            format: REHEARSAL_FORMAT,
            drives: RehearsedDrives {
                seed: 1,
                replicas: 4,
                fault_free_replicas: 10,
                references: 3,
                recordings: BTreeMap::from([("run".to_owned(), 12.0)]),
                noise: vec![SensorNoise {
                    channel: "gyro_z".into(),
                    sigma: 0.006,
                    unit: "rad/s".into(),
                    rate: 97.0,
                    source: "measured".into(),
                }],
                wanted_share: 0.5,
            },
            fault_free: Answers {
                replicas: 10,
                wrong: 1,
                nothing: 9,
                others: BTreeMap::from([("grade".to_owned(), 1)]),
                ..Answers::default()
            },
            effects: vec![effect("payload", FoundFrom::Size(2.0)), effect("stiction", FoundFrom::Never)],
            left_out: vec![NotRehearsed { effect: "clock_drift".to_owned(), why: "clocks".into() }],
            shortened: vec!["of each drive the first 12 s".to_owned()],
            limits: vec!["laws".to_owned()],
        }
    }

    #[test]
    fn the_text_says_what_is_found_from_where_and_what_is_taken_for_what() {
        let text = render(&rehearsal());
        let told = [
            "False alarms: 1 of 10 replicas in which nothing was hidden (95 %: 2 to 40 %), named: grade 1.",
            "clock_drift: clocks",
            "gyro_z 0.006000 rad/s at 97 Hz (measured)",
            "of each drive the first 12 s",
        ];
        for sentence in told {
            assert!(text.contains(sentence), "{sentence}\n{text}");
        }
        let row = text.lines().find(|line| line.contains("payload")).expect("a row");
        let cells: Vec<&str> = row.split("  ").map(str::trim).filter(|cell| !cell.is_empty()).collect();
        assert_eq!(cells, ["payload", "2.000 kg", "2.000 kg", "0/4", "1+2/4", "nothing 5", "grade 2/3"]);
        assert!(text.contains("not found"));
    }
}
