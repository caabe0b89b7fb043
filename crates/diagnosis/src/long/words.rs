//! What a diagnosis of long recordings rests on, in sentences.

use super::{ComparedWith, Coverage, Why};

impl Coverage {
    /// What it rests on: `what` are the recordings or the references.
    pub fn sentence(&self, what: &str) -> String {
        let count = |why: Why| self.chosen.iter().filter(|c| c.why == why).count();
        let against = match self.compared_with {
            ComparedWith::References => "least like the references",
            ComparedWith::Beginning => "least like the beginning",
            ComparedWith::Nothing => "further",
        };
        format!(
            "Of {} of {what}, all screened, {} were taken: {} stretches ({} spread evenly, {} whose driving tells most, {} {against}).",
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
                "their mean squared residual of the law among signals is {median:.2} (median) to {largest:.2} (largest) of \
                 what is usual, that of the stretches that were taken up to {taken:.2}"
            ),
            _ => "they have no signals that a law could be told from".to_owned(),
        };
        format!("{} stretches of {what} were screened and left out: {unlike}", self.left_out)
    }
}

fn minutes(seconds: f64) -> String {
    if seconds < 5400.0 { format!("{:.1} min", seconds / 60.0) } else { format!("{:.1} h", seconds / 3600.0) }
}
