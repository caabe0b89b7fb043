//! `docs/constants.md`: what a robot file of four wheels, or of two and casters, can hold.

use std::fmt::Write;

use robot_model::constants::{Bounds, Usual};
use robot_model::tunable::Tuning;
use robot_model::{Chassis, Constant, Robot};

/// The page.
pub(super) fn page() -> String {
    let mut out = String::from(
        "# Constants of a robot file\n\n\
         Keys under `[parameters]` of robots on four wheels, or on two driven wheels and casters (`causality`\n\
         torque-driven, speed-driven or command-driven). A constant is `{ value, unit, sigma, source }`; a unit of the same\n\
         quantity is converted. *Usual sigma* stands where a file states none: a share of the value, or in the unit of the\n\
         constant where a unit follows. \"fixed\": a diagnosis does not re-tune it. *Between visits*: by what share of its sigma\n\
         it moves usually from one day, place or load to another. Of speed-driven robots `torque_per_current` (N m/A at the\n\
         wheels of a side) turns currents into torques. Torques are held from row to row: a row's torque acts from its stamp\n\
         until the next one's. Poses are those of the middle between the wheels (of the driven axle on casters). This page is\n\
         printed by `cargo xtask book --docs` from the table of constants; do not edit it.\n\n\
         | key | unit | may be | when it is not given | usual sigma | between visits | acts on |\n\
         |---|---|---|---|---|---|---|\n",
    );
    for constant in Robot::<f64>::CONSTANTS {
        // Writing to a string cannot fail.
        let _ = writeln!(out, "{}", row(constant));
    }
    out
}

fn row(c: &Constant<f64>) -> String {
    let key = match c.both {
        Some(both) => format!("`{}` (`{both}`: both sides)", c.id),
        None => format!("`{}`", c.id),
    };
    let of = match c.of {
        [Chassis::Differential] => ", on casters",
        [] => "",
        _ => ", on four wheels",
    };
    let [sigma, moves] = match &c.tuning {
        Some(t) => {
            let sigma = match t.tuning {
                Tuning::Offset if t.unit != "-" => format!("{} {}", t.sigma, t.unit),
                Tuning::Factor | Tuning::Offset => format!("{}", t.sigma),
            };
            [sigma, if t.between_visits > 0.0 { format!("{}", t.between_visits) } else { "-".to_owned() }]
        }
        None => ["fixed".to_owned(), "-".to_owned()],
    };
    format!("| {key}{of} | {} | {} | {} | {sigma} | {moves} | {} |", c.unit, bounds(c.bounds), usual(c.usual), c.acts)
}

fn bounds(of: Bounds) -> String {
    match of {
        Bounds::Positive => "above 0".to_owned(),
        Bounds::NotNegative => "0 or more".to_owned(),
        Bounds::Finite => "any".to_owned(),
        Bounds::Within(low, high) => format!("{low} to {high}"),
        Bounds::BetweenAxles => "between the axles".to_owned(),
        Bounds::BetweenWheels => "between the wheels".to_owned(),
    }
}

fn usual(of: Usual) -> String {
    match of {
        Usual::Needed => "**needed**".to_owned(),
        Usual::Value(value) => format!("{value}"),
        Usual::Unlimited => "no limit".to_owned(),
        Usual::RearAxle => "rear axle".to_owned(),
        Usual::As(other) => format!("as `{other}`"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_in_the_repository_is_that_of_the_table() {
        let there = std::fs::read_to_string(crate::output::docs("constants.md")).unwrap_or_default();
        assert!(there == page(), "docs/constants.md is stale: run `cargo xtask book --docs`");
    }

    #[test]
    fn a_row_tells_what_is_needed_what_is_usual_and_what_moves() {
        let page = page();
        let row = |id: &str| page.lines().find(|line| line.starts_with(&format!("| `{id}`"))).expect("a row");
        assert!(row("mass").contains("**needed**") && row("mass").contains("| 0.01 | 0.6 |"), "{}", row("mass"));
        assert!(row("coulomb_left").contains("`coulomb`: both sides"), "{}", row("coulomb_left"));
        assert!(row("com_x").contains("0.004 m"), "{}", row("com_x"));
        assert!(row("wheel_radius").contains("| fixed | - |"), "{}", row("wheel_radius"));
        assert!(
            row("caster_rolling").contains("on casters") && row("caster_rolling").contains("as `rolling_resistance`")
        );
    }
}
