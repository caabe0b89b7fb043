//! Many recordings of many robots as a page: which robots differ, by which effect, since when, and whether it grows.

mod charts;
mod lists;
mod overview;
mod robots;
mod series;
mod since;
mod trend;

use crate::page::Page;

pub use since::{Change, Since, since};
pub use trend::{Trend, trend};

/// One recording of one robot.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Seen {
    /// Its name.
    pub id: String,
    /// Which vehicle.
    pub robot: String,
    /// When it was recorded, ms since 1970.
    pub date: Option<i64>,
    /// What was found.
    pub told: Told,
}

/// What was found in a recording.
#[derive(Debug, Clone, Default, PartialEq)]
pub enum Told {
    /// Nothing is missing.
    #[default]
    NoMismatch,
    /// These effects.
    Explained(Vec<Named>),
    /// Something that is not in the catalogue.
    Unknown,
    /// No answer is permitted, for this reason.
    Withheld(String),
    /// It could not be diagnosed, for this reason.
    Failed(String),
}

impl Told {
    /// Whether it says that there is, or is not, a mismatch.
    fn is_answer(&self) -> bool {
        !matches!(self, Self::Withheld(_) | Self::Failed(_))
    }

    fn is_mismatch(&self) -> bool {
        matches!(self, Self::Explained(_) | Self::Unknown)
    }
}

/// An effect that a recording was found to have.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Named {
    /// Effect id.
    pub effect: String,
    /// Name for people, with its side.
    pub name: String,
    /// `left` or `right`, when it sits on one side.
    pub side: Option<String>,
    /// Probability.
    pub probability: f64,
    /// Size in `unit`.
    pub magnitude: Option<f64>,
    /// Its 90 % interval.
    pub interval: Option<[f64; 2]>,
    /// Unit of the size.
    pub unit: String,
}

/// The page of a fleet. Recordings may come in any order; `program` is what diagnosed them.
pub fn render(seen: &[Seen], program: &str) -> String {
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
