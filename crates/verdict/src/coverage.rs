//! What a diagnosis of long recordings rests on, in figures and sentences.

use serde::{Deserialize, Serialize};

/// What pieces were compared with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ComparedWith {
    /// The law among signals that the references follow.
    References,
    /// That of the first minutes of the recordings themselves: there were no references, or too little of them.
    Beginning,
    /// Nothing: the recordings lack the signals for a law.
    Nothing,
}

/// A piece on which the diagnosis rests.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Chosen {
    /// Its name in the rest of the diagnosis.
    pub name: String,
    /// Recording that it is of.
    pub recording: String,
    /// When it begins and ends, s since the recording's start.
    pub interval: [f64; 2],
    /// Why it was chosen.
    pub why: Why,
    /// Mean squared residual of the law over what is usual; the worst of its targets. `None` without a law.
    pub unlike: Option<f64>,
}

/// What a diagnosis of long recordings rests on, and what it leaves out.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Coverage {
    /// Recorded time that was screened, s.
    pub screened: f64,
    /// Recorded time that the diagnosis rests on, s.
    pub diagnosed: f64,
    /// What pieces were compared with.
    pub compared_with: ComparedWith,
    /// The pieces that the diagnosis rests on.
    pub chosen: Vec<Chosen>,
    /// Pieces that were left out.
    pub left_out: usize,
    /// How far pieces are from the law: least, lower quartile, median, upper quartile, largest.
    pub unlike: [Option<f64>; 5],
    /// The same of those that were left out: median and largest.
    pub unlike_left_out: [Option<f64>; 2],
}

/// Why a piece was chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Why {
    /// One of those spread evenly over the recording.
    Spread,
    /// Its driving tells most about the robot's constants (D-optimal with the others).
    Telling,
    /// It is least like the law of the references.
    Unlike,
}

impl Coverage {
    /// What it rests on: `what` are the recordings or the references.
    pub fn sentence(&self, what: &str) -> String {
        let count = |why: Why| self.chosen.iter().filter(|c| c.why == why).count();
        let against = match self.compared_with {
            ComparedWith::References => "least like the references",
            ComparedWith::Beginning => "least like the beginning",
            ComparedWith::Nothing => "others",
        };
        format!(
            "Of {} of {what}, all screened, {} were diagnosed in full: {} stretches ({} spread \
             evenly, {} with the most informative driving, {} {against}).",
            minutes(self.screened),
            minutes(self.diagnosed),
            self.chosen.len(),
            count(Why::Spread),
            count(Why::Telling),
            count(Why::Unlike),
        )
    }

    /// What was left out, and how unlike that is.
    pub fn limit(&self, what: &str) -> String {
        let taken = self.chosen.iter().filter_map(|c| c.unlike).fold(0.0, f64::max);
        let unlike = match self.unlike_left_out {
            [Some(median), Some(largest)] => format!(
                "the relations among signals fit them with a mean squared residual of {median:.2} \
                 (median) to {largest:.2} (largest) times the usual; in the stretches that were \
                 diagnosed it is up to {taken:.2}"
            ),
            _ => "how much they deviate is unknown, since they lack the signals to compare".to_owned(),
        };
        format!("{} stretches of {what} were screened but not diagnosed: {unlike}", self.left_out)
    }
}

fn minutes(seconds: f64) -> String {
    if seconds < 5400.0 { format!("{:.1} min", seconds / 60.0) } else { format!("{:.1} h", seconds / 3600.0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chosen(why: Why, unlike: Option<f64>) -> Chosen {
        Chosen { name: "a".to_owned(), recording: "r".to_owned(), interval: [0.0, 30.0], why, unlike }
    }

    fn coverage(chosen: Vec<Chosen>) -> Coverage {
        Coverage {
            screened: 7200.0,
            diagnosed: 1230.0,
            compared_with: ComparedWith::References,
            chosen,
            left_out: 40,
            unlike: [None; 5],
            unlike_left_out: [Some(1.06), Some(2.5)],
        }
    }

    #[test]
    fn a_diagnosis_of_stretches_says_how_many_were_chosen_for_which_reason() {
        let why = [Why::Spread, Why::Spread, Why::Spread, Why::Telling, Why::Unlike, Why::Unlike];
        let mut of = coverage(why.map(|why| chosen(why, None)).to_vec());
        let text = "Of 2.0 h of the recordings, all screened, 20.5 min were diagnosed in full: 6 stretches (3 spread \
                    evenly, 1 with the most informative driving, 2 least like the references).";
        assert_eq!(of.sentence("the recordings"), text);
        of.compared_with = ComparedWith::Beginning;
        assert!(of.sentence("the recordings").ends_with(", 2 least like the beginning)."));
        of.compared_with = ComparedWith::Nothing;
        assert!(of.sentence("the recordings").ends_with(", 2 others)."));
    }

    #[test]
    fn what_was_left_out_is_told_with_how_unlike_it_is_beside_what_was_taken() {
        let unlike = [Some(1.5), None, Some(3.25), Some(2.0)];
        let mut of = coverage(unlike.map(|unlike| chosen(Why::Spread, unlike)).to_vec());
        let text = "40 stretches of the references were screened but not diagnosed: the relations among signals fit \
                    them with a mean squared residual of 1.06 (median) to 2.50 (largest) times the usual; in the \
                    stretches that were diagnosed it is up to 3.25";
        assert_eq!(of.limit("the references"), text);
        of.unlike_left_out = [None; 2];
        let text = "40 stretches of the references were screened but not diagnosed: how much they deviate is \
                    unknown, since they lack the signals to compare";
        assert_eq!(of.limit("the references"), text);
    }

    #[test]
    fn times_are_told_in_minutes_and_from_an_hour_and_a_half_on_in_hours() {
        assert_eq!([90.0, 5394.0, 5400.0, 9000.0].map(minutes), ["1.5 min", "89.9 min", "1.5 h", "2.5 h"]);
    }
}
