//! Whether the units of a formula close.
//!
//! A number in a formula was fitted, and has whatever unit it needs; so has a product with one. A formula is wrong in units
//! where numbers cannot help: a sum, or a greater or smaller of two, of parts without a number of their own and of different
//! dimensions, or a sine, tangent or logarithm of such a part with a dimension. That the whole has another dimension than what it
//! describes is not counted: a factor of one closes it.

use serde::Deserialize;

/// Exponents of m, kg and s.
pub(super) type Dimension = [f64; 3];

const NONE: Dimension = [0.0; 3];

/// A formula: a number, a variable `x3` by its index, or a function's name with its arguments.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(untagged)]
pub(super) enum Tree {
    Number(f64),
    Name(String),
    Node(Vec<Tree>),
}

/// What a part of a formula has.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Has {
    /// A number that takes any dimension.
    Any,
    Known(Dimension),
}

/// Whether the units of a formula of variables with these dimensions close.
pub(super) fn close(tree: &Tree, variables: &[Dimension]) -> bool {
    of(tree, variables).is_some()
}

/// `None` where they do not.
fn of(tree: &Tree, variables: &[Dimension]) -> Option<Has> {
    match tree {
        Tree::Number(_) => Some(Has::Any),
        Tree::Name(name) => {
            let index: usize = name.strip_prefix('x')?.parse().ok()?;
            Some(Has::Known(*variables.get(index)?))
        }
        Tree::Node(parts) => {
            let (Tree::Name(function), arguments) = parts.split_first()? else { return None };
            let all = arguments.iter().map(|a| of(a, variables)).collect::<Option<Vec<_>>>()?;
            applied(function, &all)
        }
    }
}

fn applied(function: &str, arguments: &[Has]) -> Option<Has> {
    use Has::{Any, Known};
    let both = |with: fn(f64, f64) -> f64| match *arguments {
        [Known(a), Known(b)] => Some(Known(std::array::from_fn(|i| with(a[i], b[i])))),
        [_, _] => Some(Any),
        _ => None,
    };
    match (function, arguments) {
        ("mul", _) => both(|a, b| a + b),
        ("div", _) => both(|a, b| a - b),
        ("add" | "sub" | "min" | "max", &[Any, other] | &[other, Any]) => Some(other),
        ("add" | "sub" | "min" | "max", &[Known(a), Known(b)]) => is_same(a, b).then_some(Known(a)),
        ("abs" | "neg", &[a]) => Some(a),
        ("sqrt", &[Known(a)]) => Some(Known(a.map(|e| 0.5 * e))),
        ("sqrt", &[Any]) => Some(Any),
        ("sin" | "cos" | "tan" | "tanh" | "exp" | "log", &[Any]) => Some(Known(NONE)),
        ("sin" | "cos" | "tan" | "tanh" | "exp" | "log", &[Known(a)]) => is_same(a, NONE).then_some(Known(NONE)),
        _ => None,
    }
}

fn is_same(a: Dimension, b: Dimension) -> bool {
    // Halves and quarters, by roots of roots, are exact.
    a == b
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A velocity, a wheel speed, an angle.
    const VARIABLES: [Dimension; 3] = [[1.0, 0.0, -1.0], [0.0, 0.0, -1.0], NONE];

    fn closes(formula: &serde_json::Value) -> bool {
        close(&serde_json::from_value(formula.clone()).expect("a formula"), &VARIABLES)
    }

    #[test]
    fn sums_of_different_dimensions_close_only_with_a_number_of_their_own() {
        use serde_json::json;
        assert!(!closes(&json!(["add", "x0", "x1"])));
        assert!(closes(&json!(["add", "x0", ["mul", 0.3, "x1"]])));
        assert!(closes(&json!(["sub", "x0", 0.3])));
        assert!(closes(&json!(["add", "x0", ["div", ["mul", "x0", "x0"], "x0"]])));
        assert!(closes(&json!(["add", "x0", ["sqrt", ["mul", "x0", "x0"]]])));
        assert!(!closes(&json!(["max", ["abs", "x0"], "x2"])));
        // What a number closes within, it does not close around.
        assert!(!closes(&json!(["mul", 2.0, ["add", "x0", "x1"]])));
    }

    #[test]
    fn arguments_of_transcendental_functions_have_no_dimension() {
        use serde_json::json;
        assert!(!closes(&json!(["tanh", "x0"])));
        assert!(closes(&json!(["tanh", ["div", "x0", 0.1]])));
        assert!(closes(&json!(["sin", "x2"])));
        assert!(!closes(&json!(["log", ["mul", "x0", "x1"]])));
        assert!(closes(&json!(["cos", ["div", "x0", "x0"]])));
        // A sine is a plain number.
        assert!(!closes(&json!(["add", ["sin", "x2"], "x0"])));
        assert!(closes(&json!(["add", ["sin", "x2"], "x2"])));
    }

    #[test]
    fn what_is_no_formula_does_not_close() {
        use serde_json::json;
        for wrong in [json!("x3"), json!("y"), json!(["mul", "x0"]), json!(["gamma", "x2"]), json!([])] {
            assert!(!closes(&wrong), "{wrong}");
        }
    }
}
