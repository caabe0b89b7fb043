#![doc = include_str!("../README.md")]

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use libtest_mimic::{Arguments, Completion, Trial, run};

/// Why a test could not run here.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Skipped(String);

impl Skipped {
    /// The reason, in a few words.
    pub fn because(reason: impl Into<String>) -> Self {
        Self(reason.into())
    }
}

/// How a test ends that did not panic.
pub type Outcome = Result<(), Skipped>;

/// Name and function of a test.
pub type Test = (&'static str, fn() -> Outcome);

/// What lies in `../shared` beside the repository.
///
/// # Errors
///
/// The reason to skip a test, where it is not there.
pub fn beside(what: &str) -> Result<PathBuf, Skipped> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared").join(what);
    if path.exists() { Ok(path) } else { Err(Skipped(format!("there is no ../shared/{what}"))) }
}

/// Runs tests by name as `cargo test` does; what [`tests!`] expands to.
#[doc(hidden)]
pub fn conclude(tests: &[Test]) -> ExitCode {
    let trial = |&(name, test): &Test| {
        Trial::ignorable_test(name, move || {
            Ok(match test() {
                Ok(()) => Completion::Completed,
                Err(Skipped(reason)) => Completion::ignored_with(reason),
            })
        })
    };
    run(&Arguments::from_args(), tests.iter().map(trial).collect()).exit_code()
}

/// The `main` of a test target: runs these tests. One that is not listed is dead code, which the lints refuse.
#[macro_export]
macro_rules! tests {
    ($($test:path),+ $(,)?) => {
        fn main() -> std::process::ExitCode {
            $crate::conclude(&[$((stringify!($test), $test as fn() -> $crate::Outcome)),+])
        }
    };
}

#[cfg(test)]
mod tests {
    use super::beside;

    #[test]
    fn what_is_not_beside_the_repository_is_named() {
        let skipped = beside("data/no-such-thing").expect_err("it is not there");
        assert_eq!(skipped.0, "there is no ../shared/data/no-such-thing");
    }
}
