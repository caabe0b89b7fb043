//! A diagnosis as a page: what a sceptical colleague would ask, in the order in which it is asked.

mod ground;
mod left;
mod loads;
mod next;
mod place;
mod provenance;
mod recordings;
mod rivals;
mod timeline;
mod top;
mod worth;

use verdict::Diagnosis;

pub use provenance::{Input, Provenance};

use crate::page::Page;

/// The page of a diagnosis.
pub fn render(d: &Diagnosis, from: &Provenance) -> String {
    let heading = top::heading(d);
    // A robot without a name has that of its file: its folders say nothing here.
    let robot = from.robot.rsplit(['/', '\\']).next().unwrap_or_default();
    let title = format!("{robot}: {}", heading.join(" "));
    let eyebrow = format!("Diagnosis of {robot}, {}", from.causality);
    let mut page = Page::headed(&title, &eyebrow, &heading);
    top::add(&mut page, d);
    place::add(&mut page, d);
    loads::add(&mut page, d);
    recordings::add(&mut page, d);
    rivals::add(&mut page, d);
    worth::add(&mut page, d);
    left::add(&mut page, d, &from.lost);
    next::add(&mut page, d);
    provenance::add(&mut page, from);
    page.render()
}

#[cfg(test)]
mod tests {
    use verdict::{Diagnosis, Verdict};

    use super::{Provenance, render};

    #[test]
    fn a_diagnosis_that_says_nothing_still_makes_a_page() {
        let html = render(&Diagnosis::withheld(), &Provenance::default());
        for part in ["No answer", "keeps no simulated signals", "no error can be compared", "names no limit"] {
            assert!(html.contains(part), "lacks {part}");
        }
        assert!(!html.contains("* plotly.js ("), "there is no chart");
    }

    #[test]
    fn a_long_verdict_is_reported_before_its_explanation() {
        let first = "The wheels do not do what is commanded, and neither slip nor friction explains it";
        let why = "the wheels leave the command ".repeat(8);
        let sentences = vec![format!("{first}: {why}")];
        let d = Diagnosis { verdict: Verdict::Explained, sentences, ..Diagnosis::withheld() };
        let html = render(&d, &Provenance::default());
        assert!(
            html.contains(&format!("<span>{first}.</span>")) && html.contains("<p class=\"lead\">The wheels leave")
        );
    }
}
