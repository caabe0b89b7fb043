//! A law as lines of Python, for simulators whose models are Python beside an engine.
//!
//! The names are those of the legend of an exported model; `{0}`, `{1}`, ... stand for the law's numbers in the order of
//! [`Law::numbers`], `{rim}` and `{half track}` for the wheels' radius and half the track, m, `{weight}` for the weight, N.

use crate::factor::Factor;
use crate::motion::Input;
use crate::settings::SETTINGS;
use crate::term::{Law, Term};
use crate::variable::{Of, Variable};

/// Lines that add what a law does.
pub(crate) fn lines(law: &Law) -> Vec<String> {
    let mut out = Vec::new();
    let mut first = 0;
    for term in law.terms() {
        for &(input, of) in term.place().inputs() {
            out.extend(added(input, &product(law, term, of, first)));
        }
        first += 1 + term.factors().iter().map(|f| f.shapes().len()).sum::<usize>();
    }
    out
}

/// Lines that add a value to an input; none where there is nothing to add it to.
fn added(input: Input, value: &str) -> Vec<String> {
    match input {
        Input::Torque(j) => vec![format!("torque[{j}] += {value}")],
        Input::Force(k) => vec![format!("force[{k}] += {value}")],
        Input::Moment => vec![format!("moment += {value}")],
        Input::Grip(j) => {
            let least = SETTINGS.effect.least_share;
            vec![format!("for i in ({j}, {}):", j + 2), format!("    grip[i] *= max(1.0 + {value}, {least:?})")]
        }
        Input::Slope(0) => vec![
            format!("rise = {value}"),
            "force[0] -= {weight} * rise * ch".to_owned(),
            "force[1] += {weight} * rise * sh".to_owned(),
        ],
        Input::Slope(_) => vec![
            format!("rise = {value}"),
            "force[0] -= {weight} * rise * sh".to_owned(),
            "force[1] -= {weight} * rise * ch".to_owned(),
        ],
        Input::LateralGrip | Input::Radius(_) => Vec::new(),
    }
}

/// A term's value; its constant is number `first` of the law.
fn product(law: &Law, term: &Term, of: Of, first: usize) -> String {
    let mut at = first + 1;
    let mut all = vec![format!("({{{first}}})")];
    for factor in term.factors() {
        let numbers: Vec<String> = (at..at + factor.shapes().len()).map(|i| format!("{{{i}}}")).collect();
        at += numbers.len();
        all.push(format!("({})", value(law, *factor, of, &numbers)));
    }
    all.join(" * ")
}

/// A factor's value with its shape numbers.
fn value(law: &Law, factor: Factor, of: Of, n: &[String]) -> String {
    let s = SETTINGS.shapes;
    let x = factor.variable().map(|v| held(law, v, of)).unwrap_or_default();
    let number = |i: usize| n.get(i).map_or("", String::as_str);
    let a = number(0);
    match factor {
        Factor::Power(_, p) if p % 2 == 0 => format!("{x} * abs({x})"),
        Factor::Power(_, p) => format!("{x} ** {p}"),
        Factor::EvenPower(_, p) => format!("abs({x}) ** {p}"),
        Factor::Sign(_, width) => format!("tanh({x} / {width:?})"),
        Factor::Excess(..) => format!("max({x} - {a}, 0.0) + min({x} + {a}, 0.0)"),
        Factor::Clip(..) => format!("min(max({x}, -{a}), {a})"),
        Factor::Bump(..) => format!("exp(-min(({x} / {a}) ** 2, {:?}))", s.deepest),
        Factor::Above(..) => format!("0.5 * (1.0 + tanh((abs({x}) - {a}) / ({:?} * {a})))", s.edge),
        Factor::Turn(_, times, _) => format!("cos({times} * {x} + {a})"),
        Factor::Oscillation(..) => format!("cos({a} * t + {})", number(1)),
        Factor::Rise(_) => format!("1.0 - exp(-min(max(t, 0.0) / {a}, {:?}))", s.deepest),
        Factor::Disc(..) => {
            let (y, radius) = (number(1), number(2));
            format!("0.5 * (1.0 + tanh(({radius} - hypot(at[0] - {a}, at[1] - {y})) / {:?}))", s.border)
        }
        // No effect has a hidden state.
        Factor::Lag(..) | Factor::Heat(..) => "0.0".to_owned(),
    }
}

/// A variable, held within the range seen.
fn held(law: &Law, v: Variable, of: Of) -> String {
    let x = variable(v, of);
    match law.seen().iter().find(|(w, _)| *w == v && v != Variable::Heading) {
        Some((_, [low, high])) => format!("min(max({x}, {low:?}), {high:?})"),
        None => x,
    }
}

/// What a place sees of a variable.
fn variable(v: Variable, of: Of) -> String {
    let pair = |one: &dyn Fn(usize) -> String| match of {
        Of::Side(j) => one(j),
        Of::Difference => format!("(0.5 * ({} - {}))", one(1), one(0)),
        Of::Body | Of::Axis(_) => format!("(0.5 * ({} + {}))", one(0), one(1)),
    };
    match v {
        Variable::WheelSpeed => pair(&|j| format!("w[{j}]")),
        Variable::Torque => pair(&|j| format!("T[{j}]")),
        Variable::Power => pair(&|j| format!("(T[{j}] * w[{j}])")),
        Variable::Slip => {
            pair(&|j| format!("({{rim}} * w[{j}] - v[0] {} {{half track}} * r)", if j == 0 { '+' } else { '-' }))
        }
        Variable::Velocity => format!("v[{}]", usize::from(of == Of::Axis(1))),
        Variable::LateralVelocity => "v[1]".to_owned(),
        Variable::YawRate => "r".to_owned(),
        Variable::WheelAngle => pair(&|j| format!("angle[{j}]")),
        Variable::Heading => "heading".to_owned(),
        Variable::Time => "t".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(formula: &str) -> Vec<String> {
        lines(&formula.parse::<Law>().expect("a law"))
    }

    #[test]
    fn each_side_has_its_own_variables_and_numbers_have_their_places() {
        assert_eq!(
            of("T_both = -0.5 [N m] * sgn(omega, 0.3) * bump(v, 0.8)"),
            [0, 1].map(|j| format!(
                "torque[{j}] += ({{0}}) * (tanh(w[{j}] / 0.3)) * (exp(-min((v[0] / {{1}}) ** 2, 60.0)))"
            ))
        );
        assert_eq!(of("M_z = 2 [N m s^2/rad^2] * pow(omega, 2)").len(), 1);
        let slope = of("slope_x = 0.1 [rad]; slope_y = 0.2 [rad] * cos(heading, 1, 0)");
        assert_eq!(slope[0], "rise = ({0})");
        assert_eq!(slope[3], "rise = ({1}) * (cos(1 * heading + {2}))");
    }

    #[test]
    fn what_is_beyond_the_range_seen_is_held_at_its_end() {
        let law: Law = "F_x = -3 [N s/m] * pow(v, 1)".parse().expect("a law");
        let law = law.seen_within(&[(Variable::Velocity, [-1.0, 1.5])]);
        assert_eq!(lines(&law), ["force[0] += ({0}) * (min(max(v[0], -1.0), 1.5) ** 1)"]);
    }
}
