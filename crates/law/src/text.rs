//! Laws as formulas that read back.

use std::fmt;
use std::str::FromStr;

use crate::error::LawError;
use crate::factor::Factor;
use crate::place::Place;
use crate::term::{Law, Term};
use crate::variable::Variable;

/// A number as a formatter asks for it: with all digits, or with as many as its precision says.
fn number(x: f64, f: &fmt::Formatter<'_>) -> String {
    let rounded = |digits: usize| format!("{x:.*e}", digits.saturating_sub(1)).parse().unwrap_or(x);
    f.precision().map_or(x, rounded).to_string()
}

/// As people write it; a precision is the number of significant digits: `{:.4}`.
impl fmt::Display for Factor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (name, variable, numbers) = self.parts();
        let numbers = numbers.iter().map(|x| number(*x, f));
        let all: Vec<String> = variable.map(|v| v.symbol().to_owned()).into_iter().chain(numbers).collect();
        write!(f, "{name}({})", all.join(", "))
    }
}

impl fmt::Display for Term {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} = {} [{}]", self.place().symbol(), number(self.constant(), f), self.unit())?;
        self.factors().iter().try_for_each(|factor| {
            f.write_str(" * ")?;
            fmt::Display::fmt(factor, f)
        })
    }
}

impl fmt::Display for Law {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.terms().iter().enumerate().try_for_each(|(k, term)| {
            f.write_str(if k > 0 { "; " } else { "" })?;
            fmt::Display::fmt(term, f)
        })
    }
}

/// The variable of this symbol.
pub(crate) fn variable(name: &str) -> Result<Variable, LawError> {
    let known = || Variable::ALL.map(Variable::symbol).join(", ");
    let found = Variable::ALL.into_iter().find(|v| v.symbol() == name);
    found.ok_or_else(|| LawError::Unknown { what: "variable", name: name.to_owned(), known: known() })
}

fn place(name: &str) -> Result<Place, LawError> {
    let known = || Place::ALL.map(Place::symbol).join(", ");
    let found = Place::ALL.into_iter().find(|p| p.symbol() == name);
    found.ok_or_else(|| LawError::Unknown { what: "place", name: name.to_owned(), known: known() })
}

impl FromStr for Factor {
    type Err = LawError;

    fn from_str(text: &str) -> Result<Self, LawError> {
        let syntax = || LawError::Syntax(text.to_owned());
        let (name, rest) = text.trim().split_once('(').ok_or_else(syntax)?;
        let inside = rest.strip_suffix(')').ok_or_else(syntax)?;
        let mut all: Vec<&str> = inside.split(',').map(str::trim).collect();
        let own = if all.first().is_some_and(|first| first.parse::<f64>().is_err()) {
            Some(variable(all.remove(0))?)
        } else {
            None
        };
        let numbers = all.iter().map(|n| n.parse().map_err(|_| syntax())).collect::<Result<Vec<f64>, _>>()?;
        let unknown = || LawError::Unknown { what: "factor", name: text.to_owned(), known: Self::KINDS.to_owned() };
        Self::of_parts(name.trim(), own, &numbers).ok_or_else(unknown)?.checked()
    }
}

impl FromStr for Term {
    type Err = LawError;

    fn from_str(text: &str) -> Result<Self, LawError> {
        let syntax = || LawError::Syntax(text.to_owned());
        let (at, rest) = text.split_once('=').ok_or_else(syntax)?;
        let (constant, rest) = rest.split_once('[').ok_or_else(syntax)?;
        let (unit, rest) = rest.split_once(']').ok_or_else(syntax)?;
        let constant: f64 = constant.trim().parse().map_err(|_| syntax())?;
        let mut factors = rest.split('*');
        // Nothing stands between the unit and the first product sign.
        if factors.next().is_none_or(|before| !before.trim().is_empty()) {
            return Err(syntax());
        }
        let factors = factors.map(str::parse).collect::<Result<Vec<Factor>, _>>()?;
        let term = Self::new(place(at.trim())?, constant, &factors)?;
        let needed = term.unit();
        let wrong =
            || LawError::Unit { term: term.to_string(), given: unit.trim().to_owned(), needed: needed.to_string() };
        if crate::unit::read(unit) == Some(needed) { Ok(term) } else { Err(wrong()) }
    }
}

impl FromStr for Law {
    type Err = LawError;

    fn from_str(text: &str) -> Result<Self, LawError> {
        Self::new(text.split(';').map(str::parse).collect::<Result<_, _>>()?)
    }
}
