//! Instructions on record, and what a new count says beside them.

use std::collections::BTreeMap;
use std::fmt;

use serde::{Deserialize, Serialize};

/// A kernel may take this much more than on record.
const RISE: f64 = 0.05;
/// Changes below this are not worth a word.
const WORTH: f64 = 0.01;

/// `benches/instructions.json`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Record {
    /// `rustc --version`.
    pub(super) compiler: String,
    /// What `pulp` takes in valgrind.
    pub(super) vector_unit: String,
    /// Instructions per step.
    pub(super) kernels: BTreeMap<String, f64>,
}

/// What a count says beside the one on record.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Said {
    /// Not worth a word.
    Same,
    /// It is less, or a little more.
    Changed { from: f64, to: f64 },
    /// It is too much more.
    Risen { from: f64, to: f64 },
    /// There is none on record.
    New { to: f64 },
    /// It is on record but could not be counted, and why.
    Lost(String),
    /// It is not on record and could not be counted.
    Absent(String),
}

impl Said {
    /// Whether the build may go on.
    pub(super) fn passes(&self) -> bool {
        !matches!(self, Self::Risen { .. } | Self::Lost(_))
    }
}

impl Record {
    /// Why counts of another machine cannot be compared with these; `None` if they can.
    pub(super) fn unlike(&self, compiler: &str, vector_unit: &str) -> Option<String> {
        let differs =
            |what: &str, here: &str, there: &str| format!("{what} here is '{here}', on record it is '{there}'");
        if self.compiler != compiler {
            return Some(differs("the compiler", compiler, &self.compiler));
        }
        (self.vector_unit != vector_unit).then(|| differs("the vector unit", vector_unit, &self.vector_unit))
    }

    /// Judges a count.
    pub(super) fn judge(&self, kernel: &str, counted: &Result<f64, String>) -> Said {
        match (self.kernels.get(kernel).copied(), counted) {
            (Some(_), Err(why)) => Said::Lost(why.clone()),
            (None, Err(why)) => Said::Absent(why.clone()),
            (None, Ok(to)) => Said::New { to: *to },
            (Some(from), Ok(to)) => {
                let (to, change) = (*to, to / from - 1.0);
                if change > RISE {
                    Said::Risen { from, to }
                } else if change.abs() > WORTH {
                    Said::Changed { from, to }
                } else {
                    Said::Same
                }
            }
        }
    }
}

impl fmt::Display for Said {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let percent = |from: f64, to: f64| 100.0 * (to / from - 1.0);
        match self {
            Self::Same => write!(f, "as on record"),
            Self::Changed { from, to } => {
                write!(f, "{:+.1} %, from {from:.1} to {to:.1} per step", percent(*from, *to))
            }
            Self::Risen { from, to } => write!(
                f,
                "RISEN by {:.1} %, from {from:.1} to {to:.1} instructions per step; find out why, or accept it with \
                 `cargo xtask instructions --write`",
                percent(*from, *to)
            ),
            Self::New { to } => {
                write!(f, "{to:.1} per step, not on record; put it there with `cargo xtask instructions --write`")
            }
            Self::Lost(why) => write!(f, "LOST: it is on record but could not be counted: {why}"),
            Self::Absent(why) => write!(f, "not counted: {why}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record() -> Record {
        Record {
            compiler: "rustc 1".into(),
            vector_unit: "4 lanes".into(),
            kernels: BTreeMap::from([("plant".to_owned(), 1000.0)]),
        }
    }

    #[test]
    fn a_rise_of_more_than_five_percent_fails_and_says_how_to_accept_it() {
        let said = |count: f64| record().judge("plant", &Ok(count));
        assert_eq!([1000.0, 1009.0, 991.0].map(said), [Said::Same, Said::Same, Said::Same]);
        assert!(said(1049.0).passes() && said(500.0).passes());
        assert_eq!(said(500.0).to_string(), "-50.0 %, from 1000.0 to 500.0 per step");
        let risen = said(1051.0);
        assert!(!risen.passes());
        let text = risen.to_string();
        assert!(text.contains("by 5.1 %, from 1000.0 to 1051.0") && text.contains("instructions --write"), "{text}");
    }

    #[test]
    fn a_kernel_that_is_on_record_must_be_counted() {
        let lost = Err("no example target".to_owned());
        assert!(!record().judge("plant", &lost).passes());
        assert!(record().judge("new", &lost).passes());
        assert_eq!(record().judge("new", &Ok(3.0)), Said::New { to: 3.0 });
    }

    #[test]
    fn counts_of_another_compiler_or_vector_unit_are_not_compared() {
        assert_eq!(record().unlike("rustc 1", "4 lanes"), None);
        assert!(record().unlike("rustc 2", "4 lanes").is_some_and(|why| why.contains("rustc 2")));
        assert!(record().unlike("rustc 1", "8 lanes").is_some_and(|why| why.contains("8 lanes")));
    }

    #[test]
    fn the_record_reads_back() {
        let text = serde_json::to_string_pretty(&record()).expect("text");
        assert_eq!(serde_json::from_str::<Record>(&text).expect("reads back"), record());
    }

    #[test]
    fn the_record_of_the_workspace_can_be_read() {
        let text = std::fs::read_to_string(crate::output::beside(super::super::FILE)).expect("the file");
        let record: Record = serde_json::from_str(&text).expect("reads");
        assert!(record.kernels.values().all(|count| *count > 0.0));
    }
}
