//! Many recordings of many robots as a page: which robots differ, by which effect, since when, and whether it grows.

mod charts;
mod lists;
mod overview;
mod recording;
mod robots;
mod series;
mod since;
mod trend;

use crate::page::Page;

pub use recording::{DiagnosedRecording, Finding, Named};
pub use since::{Change, Since, since};
pub use trend::{Trend, trend};

/// The page of a fleet. Recordings may come in any order; `program` is what diagnosed them.
pub fn render(seen: &[DiagnosedRecording], program: &str) -> String {
    let all = series::Fleet::new(seen);
    let heading = overview::heading(&all);
    let mut page = Page::headed(&format!("Fleet: {heading}"), "Fleet", &[heading]);
    overview::add(&mut page, &all);
    robots::add(&mut page, &all);
    charts::add(&mut page, &all);
    lists::add(&mut page, &all);
    page.section("Method", "How this was judged");
    page.list(&[
        "An effect counts as named where the verdict is explained and the effect is more likely than not; its size stands with \
         the 90 % interval of its own diagnosis."
            .to_owned(),
        trend::METHOD.to_owned(),
        since::METHOD.to_owned(),
        "Sizes are those of recordings in which the effect was named: one that is about as large as can be seen is named \
         only where it comes out large, so that its mean is too large and a trend at its beginning too flat."
            .to_owned(),
        format!("Diagnosed by {program}."),
    ]);
    page.render()
}

#[cfg(test)]
mod tests;
