//! What can be wrong with a law, and with an effect of one's own.

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

/// Why a law cannot be an effect of one's own.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum OwnEffectError {
    /// No name of an effect.
    #[error(
        "'{0}' cannot be the name of an effect; write small letters, digits, '-' and '_', with a letter first, as \"my-law\""
    )]
    Name(String),
    /// It remembers what was before.
    #[error("'{0}' has a hidden state, which simulations do not carry; leave this factor out")]
    State(String),
    /// Too many numbers.
    #[error("the law has {count} numbers; an effect has at most {most}: leave out a factor or a term")]
    Numbers {
        /// How many it has.
        count: usize,
        /// How many it may have.
        most: usize,
    },
    /// Two terms whose sizes cannot be added up.
    #[error(
        "the constants of the law are in {first} and {second}; give terms in different units a file of their own each"
    )]
    Units {
        /// Of the first term.
        first: String,
        /// Of the second.
        second: String,
    },
    /// A constant without a size.
    #[error("the constant of '{0}' is zero; give its usual size, at which a fit of it starts")]
    Zero(String),
    /// A shape number out of its bounds.
    #[error("'{factor}' has {value}, but this number lies from {low} to {high}")]
    Shape {
        /// The factor.
        factor: String,
        /// The number.
        value: String,
        /// Its least value.
        low: String,
        /// Its largest.
        high: String,
    },
}
