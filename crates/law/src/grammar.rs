//! Every candidate: each variable may enter each factor at each place where symmetry allows.

use std::f64::consts::FRAC_PI_2;

use crate::factor::Factor;
use crate::place::Place;
use crate::settings::SETTINGS;
use crate::term::Term;
use crate::variable::Variable;

/// Usual sizes of what a law may depend on, in a set of recordings.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Scales {
    /// Root mean square of each variable.
    pub usual: Vec<(Variable, f64)>,
    /// Places on the ground that were driven over, m.
    pub spots: Vec<[f64; 2]>,
}

impl Scales {
    fn of(&self, v: Variable) -> Option<f64> {
        self.usual.iter().find(|(w, _)| *w == v).map(|(_, size)| *size).filter(|s| s.is_finite() && *s > 0.0)
    }
}

/// Whether a variable has a meaning at a place: one side's own variables there, else the body's.
///
/// A force of both axes has one constant, so that only the velocity along each axis enters.
fn allows(place: Place, v: Variable) -> bool {
    match place {
        Place::ForceBoth => v == Variable::Velocity,
        // Its own drive decides what a wheel's radius does with its angle; the body's places have no wheel angle.
        _ => v != Variable::WheelAngle || !place.on_other_sides().is_empty(),
    }
}

/// The dry law of a variable: its sign, smooth about zero.
pub fn dry_sign(v: Variable) -> Factor {
    let g = SETTINGS.grammar;
    let width = match v {
        Variable::WheelSpeed => g.dry_wheel,
        Variable::Slip | Variable::Velocity | Variable::LateralVelocity => g.dry_speed,
        Variable::YawRate => g.dry_yaw,
        _ => g.dry_torque,
    };
    Factor::Sign(v, width)
}

/// Factors by which a variable may enter, without those that need a second column.
fn of_variable(v: Variable, scales: &Scales) -> Vec<Factor> {
    let g = SETTINGS.grammar;
    let Some(usual) = scales.of(v) else { return Vec::new() };
    let mut out: Vec<Factor> = (1..=3).flat_map(|p| [Factor::Power(v, p), Factor::EvenPower(v, p)]).collect();
    out.push(dry_sign(v));
    for share in g.sizes {
        let a = share * usual;
        out.extend([Factor::Excess(v, a), Factor::Clip(v, a), Factor::Bump(v, a), Factor::Above(v, a)]);
    }
    out
}

/// Factors that a second one may be multiplied by: what limits a law to a regime, a stretch or a place.
fn modulators(scales: &Scales) -> Vec<Factor> {
    let g = SETTINGS.grammar;
    let mut out = Vec::new();
    for v in Variable::ALL.into_iter().filter(|v| v.is_amount()) {
        if let Some(usual) = scales.of(v) {
            let a = g.sizes[0] * usual;
            out.extend([Factor::EvenPower(v, 1), Factor::EvenPower(v, 2), Factor::Bump(v, a), Factor::Above(v, a)]);
        }
    }
    out.extend(g.rises.map(Factor::Rise));
    out.extend(g.rises.map(|t| Factor::Above(Variable::Time, t)));
    for spot in &scales.spots {
        out.extend(g.radii.map(|radius| Factor::Disc(spot[0], spot[1], radius)));
    }
    out
}

/// Harmonics, each with its quarter turn: two columns of one candidate.
fn harmonics(place: Place) -> Vec<[Factor; 2]> {
    let g = SETTINGS.grammar;
    let mut out = Vec::new();
    if allows(place, Variable::WheelAngle) {
        let wheel = |n, phase| Factor::Turn(Variable::WheelAngle, n, phase);
        out.extend((1..=g.harmonics).map(|n| [wheel(n, 0.0), wheel(n, -FRAC_PI_2)]));
    }
    let heading = |n, phase| Factor::Turn(Variable::Heading, n, phase);
    out.extend((1..=2).map(|n| [heading(n, 0.0), heading(n, -FRAC_PI_2)]));
    out.extend(g.frequencies.map(|w| [Factor::Oscillation(w, 0.0), Factor::Oscillation(w, -FRAC_PI_2)]));
    out
}

/// All candidates with the constant one: terms that share a column's place come as pairs where a
/// phase or a direction has to be found, alone otherwise.
pub fn candidates(scales: &Scales) -> Vec<Vec<Term>> {
    let mut out: Vec<Vec<Term>> = Vec::new();
    let modulators = modulators(scales);
    let mut push = |terms: &[(Place, &[Factor])]| {
        let made: Result<Vec<Term>, _> = terms.iter().map(|(place, f)| Term::new(*place, 1.0, f)).collect();
        out.extend(made);
    };
    for place in Place::ALL {
        if matches!(place, Place::SlopeX | Place::SlopeY) {
            continue;
        }
        let bases: Vec<Factor> = Variable::ALL
            .into_iter()
            .filter(|v| v.is_amount() && allows(place, *v))
            .flat_map(|v| of_variable(v, scales))
            .collect();
        if place != Place::ForceBoth {
            push(&[(place, &[])]);
            for m in &modulators {
                push(&[(place, &[*m])]);
            }
            for [a, b] in harmonics(place) {
                push(&[(place, &[a]), (place, &[b])]);
            }
        }
        for base in &bases {
            // What is even already stands among the modulators.
            let odd = matches!(base, Factor::Power(..) | Factor::Sign(..));
            if place == Place::ForceBoth || !modulators.iter().any(|m| m == base) {
                push(&[(place, &[*base])]);
            }
            // A product: only of what has a sign, so that no pair stands twice.
            let simple = odd && !matches!(base, Factor::Power(_, 3));
            for m in modulators.iter().filter(|m| simple && m.variable() != base.variable()) {
                push(&[(place, &[*base, *m])]);
            }
        }
    }
    // A slope has a direction: both axes of the map are one candidate.
    push(&[(Place::SlopeX, &[]), (Place::SlopeY, &[])]);
    for m in &modulators {
        push(&[(Place::SlopeX, &[*m]), (Place::SlopeY, &[*m])]);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scales() -> Scales {
        let usual = Variable::ALL.map(|v| (v, 1.0)).to_vec();
        Scales { usual, spots: vec![[1.0, 2.0]] }
    }

    #[test]
    fn candidates_are_many_distinct_and_of_every_place() {
        let all = candidates(&scales());
        assert!(all.len() > 1000, "{}", all.len());
        let mut text: Vec<String> =
            all.iter().map(|c| c.iter().map(Term::to_string).collect::<Vec<_>>().join("; ")).collect();
        for place in Place::ALL {
            assert!(text.iter().any(|t| t.contains(place.symbol())), "{place:?}");
        }
        text.sort_unstable();
        let before = text.len();
        text.dedup();
        assert_eq!(text.len(), before, "a candidate stands twice");
    }

    #[test]
    fn what_was_not_driven_is_no_candidate() {
        let all = candidates(&Scales::default());
        assert!(all.iter().flatten().flat_map(Term::factors).all(|f| f.variable() != Some(Variable::Torque)));
    }
}
