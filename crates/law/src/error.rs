//! What can be wrong with a law.

/// What can be wrong with a law.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum LawError {
    /// A term has too many factors.
    #[error("a term has {0} factors; at most 3 are possible")]
    Factors(usize),
    /// A law has no term or too many.
    #[error("a law has {0} terms; give one or two, separated by ';'")]
    Terms(usize),
    /// A number is not finite.
    #[error("a number of '{0}' is not finite; give numbers such as 0.66")]
    NotFinite(String),
    /// A range begins above its end.
    #[error("the range of '{variable}' is {low} to {high}; write the least value first, then the largest")]
    Range {
        /// The variable.
        variable: String,
        /// As written.
        low: String,
        /// As written.
        high: String,
    },
    /// A variable cannot enter a factor.
    #[error("'{variable}' cannot enter '{factor}'; see the table of factors in docs/law.md")]
    Variable {
        /// The factor.
        factor: String,
        /// The variable.
        variable: String,
    },
    /// The text is no term.
    #[error("'{0}' is no term; write it as \"T_right = -0.66 [N m] * sgn(omega, 0.3)\"")]
    Syntax(String),
    /// A place, variable or factor is not known.
    #[error("no {what} is called '{name}'; known are {known}")]
    Unknown {
        /// Place, variable or factor.
        what: &'static str,
        /// The text.
        name: String,
        /// Those that exist.
        known: String,
    },
    /// The unit does not close the term.
    #[error("the constant of '{term}' is in {given}; the term closes with {needed} only")]
    Unit {
        /// The term.
        term: String,
        /// The unit in the text.
        given: String,
        /// The unit that closes it.
        needed: String,
    },
}
