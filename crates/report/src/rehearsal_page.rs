//! A rehearsal as a page: how often each effect is found over its size.

use verdict::{Rehearsal, RehearsedEffect, RehearsedSize};

use crate::chart::{Chart, Line};
use crate::figure::{Drawing, Figure, Role};
use crate::page::{Cell, Page};
use crate::rehearsal_text::{driven, false_alarms, found_from, look_alikes, otherwise, with_unit};
use crate::words::number;

/// Columns of the numbers below a curve.
const NUMBERS: [&str; 9] = [
    "size",
    "of interest",
    "named first",
    "in one answer",
    "unknown",
    "nothing",
    "another",
    "no answer",
    "95 % interval",
];

/// The page: one file that opens in any browser and needs no network. `program` is what rehearsed.
pub fn render(rehearsal: &Rehearsal, robot: &str, program: &str) -> String {
    let found = rehearsal.effects.iter().filter(|effect| effect.found != verdict::FoundFrom::Never).count();
    let multiples = rehearsal.effects.iter().flat_map(|effect| &effect.sizes).map(|size| size.multiple);
    let largest = multiples.fold(0.0, f64::max);
    let heading = format!(
        "{found} of {} effects would be found on these inputs, at {largest} times their size of interest or less",
        rehearsal.effects.len()
    );
    let mut page = Page::headed(&format!("Rehearsal: {robot}"), &format!("Rehearsal of {robot}"), &[heading]);
    page.lead(&false_alarms(&rehearsal.fault_free));

    page.section("Found from", "Which effects, from which size on");
    let header = ["effect", "size of interest", "found from", "otherwise answered", "look-alikes"];
    page.table_of_words(&header, &rehearsal.effects.iter().map(row).collect::<Vec<_>>());
    page.note(
        "Found is an effect that the answer holds, alone or in a class that cannot be told apart. \"Found from\" is the \
         smallest simulated size above which none was missed; between sizes nobody looked. Look-alikes are other names in the \
         answers that name anything.",
    );

    page.section("Curves", "How often each is found over its size");
    page.grid(&rehearsal.effects.iter().map(figure).collect::<Vec<_>>());

    if !rehearsal.left_out.is_empty() {
        page.section("Left out", "Effects that were not rehearsed");
        let row = |l: &verdict::NotRehearsed| vec![l.effect.as_str().into(), Cell::from(l.why.as_ref())];
        page.table_of_words(&["effect", "why"], &rehearsal.left_out.iter().map(row).collect::<Vec<_>>());
    }

    page.section("Method", "What was driven, and what limits this");
    page.list(&driven(rehearsal));
    if !rehearsal.shortened.is_empty() {
        page.subheading("Shortened");
        page.list(&rehearsal.shortened);
    }
    page.subheading("Limits");
    page.list(&rehearsal.limits);
    page.list(&[format!("Rehearsed by {program}.")]);
    page.render()
}

fn row(effect: &RehearsedEffect) -> Vec<Cell> {
    vec![
        format!("{} ({})", effect.name, effect.effect).into(),
        with_unit(effect.interest, effect).into(),
        found_from(effect).into(),
        otherwise(&effect.sizes).into(),
        look_alikes(effect, usize::MAX).into(),
    ]
}

/// The curve of an effect.
fn figure(effect: &RehearsedEffect) -> Figure {
    let x: Vec<f64> = effect.sizes.iter().map(|size| size.size).collect();
    let of = |share: fn(&RehearsedSize) -> f64| effect.sizes.iter().map(share).collect::<Vec<f64>>();
    let found = of(|size| size.found[0]);
    let named = of(|size| size.answers.first as f64 / size.answers.replicas.max(1) as f64);
    let intervals = effect.sizes.iter().map(|size| [size.found[1], size.found[2]]).collect();
    let lines = vec![
        Line { role: Some(Role::After), ..Line::new("the answer holds it", &x, &found) },
        Line { role: Some(Role::After), intervals, ..Line::new("95 % interval", &x, &found) },
        Line { role: Some(Role::Before), ..Line::new("named first", &x, &named).dashed() },
    ];
    // At zero, so that all charts begin there.
    let marks = effect.sizes.iter().map(|size| (size.size, 0.0, format!("{} x", size.multiple))).collect();
    let unit = if effect.unit == "-" { String::new() } else { format!(", {}", effect.unit) };
    Figure {
        title: effect.name.clone(),
        caption: format!(
            "Share of replicas whose answer holds the effect, over its size, with 95 % intervals after Wilson; at the \
             bottom the same sizes as multiples of the size of interest, {}. Found from: {}.",
            with_unit(effect.interest, effect),
            found_from(effect)
        ),
        table: (NUMBERS.to_vec(), effect.sizes.iter().map(numbers).collect()),
        drawing: Drawing::Lines(Chart {
            x_label: format!("size{unit}"),
            y_label: "share of replicas".to_owned(),
            lines,
            marks,
            ..Chart::default()
        }),
    }
}

fn numbers(size: &RehearsedSize) -> Vec<Cell> {
    let a = &size.answers;
    let counts = [a.first, a.in_set, a.unknown, a.nothing, a.wrong, a.withheld];
    let [low, high] = [size.found[1], size.found[2]].map(|share| 100.0 * share);
    let mut row = vec![number(size.size).into(), format!("{} x", size.multiple).into()];
    row.extend(counts.map(|count| Cell::from(format!("{count}/{}", a.replicas))));
    row.push(format!("{low:.0} to {high:.0} %").into());
    row
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rehearsal_text::tests::rehearsal;

    #[test]
    fn the_page_has_a_curve_for_each_effect_and_names_stay_text() {
        let page = render(&rehearsal(), "<my-robot>", "lacuna 0");
        assert_eq!(page.matches("<figure").count(), 2);
        assert!(!page.contains("<my-"), "a name got through");
        for told in ["1 of 2 effects would be found", "clock_drift", "nothing 5", "10 to 90 %", "False alarms: 1 of 10"]
        {
            assert!(page.contains(told), "{told}");
        }
    }
}
