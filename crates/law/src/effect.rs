//! A law as an effect: what a file says takes part wherever the catalogue's effects do.

use std::any::Any;
use std::fmt;

use robot_model::effect::export::{Export, Residual, Section};
use robot_model::effect::{MAX_PARAMETERS, Parameter, Scopes, Values};
use robot_model::{Coefficients, Effect, EffectSpec, OperatingPoint};
use scalar::Scalar;

use crate::error::OwnEffectError;
use crate::factor::Factor;
use crate::motion::{Input, Motion};
use crate::python;
use crate::settings::SETTINGS;
use crate::term::{Law, Term};
use crate::unit::Unit;
use crate::variable::Variable;

/// An effect of one's own: a law under a name.
///
/// The values of its parameters are the law's numbers, in the order of [`Law::numbers`]: constants are strengths, zero
/// being neutral, and shape numbers are shapes, which start at those of the file. Variables stay within the range seen.
pub struct OwnEffect {
    law: Law,
    spec: &'static EffectSpec,
}

impl fmt::Debug for OwnEffect {
    /// Name, formula and range: all that an answer depends on.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {} {:?}", self.spec.id, self.law, self.law.seen())
    }
}

impl OwnEffect {
    /// The effect of a law. It is kept until the program ends, as the catalogue's effects are: make it once for a file.
    ///
    /// # Errors
    /// Names that no effect can have, and laws that a free run cannot take part in: with hidden states, more numbers than
    /// an effect has, terms in different units, a constant of zero, or a shape number out of its bounds.
    pub fn new(name: &str, law: Law) -> Result<&'static Self, OwnEffectError> {
        check(name, &law)?;
        let spec: &'static EffectSpec = kept(spec(name, &law));
        Ok(kept(Self { law, spec }))
    }

    /// The effect of one's own that an effect is, if it is one.
    pub fn of(effect: &'static dyn Effect<f64>) -> Option<&'static Self> {
        let any: &'static dyn Any = effect;
        any.downcast_ref()
    }

    /// As an effect of a plant.
    pub fn as_effect(&'static self) -> &'static dyn Effect<f64> {
        self
    }

    /// Its name.
    pub fn name(&self) -> &'static str {
        self.spec.name
    }

    /// What is known about it.
    pub fn spec(&self) -> &'static EffectSpec {
        self.spec
    }

    /// A sentence for each variable that goes beyond the range in which the law was seen; `range` is where a variable was.
    pub fn beyond_seen(&self, range: impl Fn(Variable) -> Option<[f64; 2]>) -> Vec<String> {
        let of = |(v, [low, high]): &(Variable, [f64; 2])| {
            let [from, to] = range(*v).filter(|[from, to]| from < low || to > high)?;
            Some(format!(
                "'{}' was seen for {} ({}) from {low:.3} to {high:.3} {unit}, and here it goes from {from:.3} to {to:.3} \
                 {unit}: beyond the range seen the law is held at its end",
                self.name(),
                v.symbol(),
                v.name(),
                unit = v.unit(),
            ))
        };
        let used = self.law.variables();
        self.law.seen().iter().filter(|(v, _)| used.contains(v)).filter_map(of).collect()
    }

    /// Its law, at the numbers of its file.
    pub fn law(&self) -> &Law {
        &self.law
    }
}

impl<T: Scalar> Effect<T> for OwnEffect {
    fn spec(&self) -> &'static EffectSpec {
        self.spec
    }

    fn apply(&self, values: &Values<T>, at: &OperatingPoint<T>, c: &mut Coefficients<T>) {
        let motion = Motion::seen_at(at, c);
        self.law.act_with(&motion, values).change(at, c);
    }
}

/// Keeps a value until the program ends.
fn kept<T>(value: T) -> &'static T {
    Box::leak(Box::new(value))
}

fn kept_text(text: String) -> &'static str {
    Box::leak(text.into_boxed_str())
}

fn kept_list<T>(list: Vec<T>) -> &'static [T] {
    Box::leak(list.into_boxed_slice())
}

fn check(name: &str, law: &Law) -> Result<(), OwnEffectError> {
    let first = name.chars().next().is_some_and(|c| c.is_ascii_lowercase());
    let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || matches!(c, '-' | '_');
    if !first || !name.chars().all(plain) {
        return Err(OwnEffectError::Name(name.to_owned()));
    }

    let factors = || law.terms().iter().flat_map(Term::factors);
    if let Some(state) = factors().find(|f| f.is_state()) {
        return Err(OwnEffectError::State(state.to_string()));
    }
    let count = law.numbers().len();
    if count > MAX_PARAMETERS {
        return Err(OwnEffectError::Numbers { count, most: MAX_PARAMETERS });
    }
    if let [first, second] = law.terms()
        && (first.unit() != second.unit())
    {
        let [first, second] = [first, second].map(|t| t.unit().to_string());
        return Err(OwnEffectError::Units { first, second });
    }
    if let Some(term) = law.terms().iter().find(|t| t.constant() == 0.0) {
        return Err(OwnEffectError::Zero(term.to_string()));
    }
    for factor in factors() {
        let width = if let Factor::Sign(_, width) = *factor { Some(width) } else { None };
        let sign = width.map(|value| (value, [SETTINGS.shapes.least, SETTINGS.shapes.most]));
        let shapes = factor.shapes().into_iter().map(|s| (s.value, s.bounds));
        if let Some((value, [low, high])) = sign.into_iter().chain(shapes).find(|(x, [a, b])| !(a..=b).contains(&x)) {
            let [value, low, high] = [value, low, high].map(|x| x.to_string());
            return Err(OwnEffectError::Shape { factor: factor.to_string(), value, low, high });
        }
    }
    Ok(())
}

/// All that is known about the effect of a law.
fn spec(name: &str, law: &Law) -> EffectSpec {
    let name = kept_text(name.to_owned());
    let parameters = kept_list(parameters(law));
    let size = law.terms().iter().map(|t| t.constant().powi(2)).sum::<f64>().sqrt();
    let places: Vec<&str> = law.terms().iter().map(|t| t.place().name()).collect();
    let on = |what: fn(&Input) -> bool| {
        law.terms().iter().any(|t| Input::ALL.iter().any(|input| what(input) && t.place().acts_on(*input)))
    };
    let section = if on(|i| matches!(i, Input::Torque(_) | Input::Radius(_))) {
        Section::Wheels
    } else if on(|i| matches!(i, Input::Force(_) | Input::Moment)) {
        Section::Body
    } else {
        Section::Ground
    };
    let lines = || kept_list(python::lines(law).into_iter().map(kept_text).collect());
    let residual = if on(|i| matches!(i, Input::Grip(_))) {
        Residual::Ground(lines())
    } else if on(|i| matches!(i, Input::Radius(_) | Input::LateralGrip)) {
        Export::ADDED_BY_HAND.residual
    } else {
        Residual::Force(lines())
    };
    EffectSpec {
        id: name,
        name,
        law: kept_text(law.to_string()),
        seen: kept_text(format!("A law of a file: {}.", places.join(" and "))),
        parameters,
        signed: true,
        scopes: Scopes { onset: true, ..Scopes::WHOLE },
        interest: SETTINGS.effect.interest * size,
        revealed_by: "drives both ways and at several speeds within the range in which the law was seen",
        source: "a law of one's own",
        export: Export { section, residual, ..Export::ADDED_BY_HAND },
        ..EffectSpec::PHYSICS
    }
}

/// The numbers of a law as parameters, each with a name of its own.
fn parameters(law: &Law) -> Vec<Parameter> {
    let mut out: Vec<Parameter> = Vec::new();
    let several = law.terms().len() > 1;
    for term in law.terms() {
        let constant = term.constant();
        let most = SETTINGS.effect.most * constant.abs();
        let of = if several { format!("constant of {}", term.place().symbol()) } else { "constant".to_owned() };
        let name = distinct(of, &out);
        out.push(Parameter::strength(name, unit(term.unit()), [-most, most], kept_list(vec![constant])));
        for factor in term.factors() {
            let symbols = factor.shape_symbols();
            for ((shape, of), symbol) in factor.shapes().iter().zip(factor.shape_units()).zip(symbols) {
                let variable = factor.variable().map_or("", Variable::symbol);
                let name = distinct(format!("{symbol} of {}({variable})", factor.parts().0), &out);
                let probes = kept_list(vec![shape.value]);
                let parameter = Parameter::shape(name, unit(of), shape.bounds, shape.value, probes);
                out.push(Parameter { step: Some(shape.unit), ..parameter });
            }
        }
    }
    out
}

fn unit(unit: Unit) -> &'static str {
    if unit == Unit::ONE { "-" } else { kept_text(unit.to_string()) }
}

/// A name that no other parameter has.
fn distinct(name: String, others: &[Parameter]) -> &'static str {
    let taken = |name: &str| others.iter().any(|p| p.name == name);
    let numbered = (2..).map(|n| format!("{name} {n}"));
    let free = std::iter::once(name.clone()).chain(numbered).find(|n| !taken(n));
    kept_text(free.unwrap_or(name))
}

#[cfg(test)]
mod tests {
    use robot_model::effect::Role;
    use robot_model::{Lanes, Robot, real};

    use super::*;

    fn effect(formula: &str) -> &'static OwnEffect {
        OwnEffect::new("my-law", formula.parse().expect("a law")).expect("an effect")
    }

    fn refused(name: &str, formula: &str) -> String {
        OwnEffect::new(name, formula.parse().expect("a law")).expect_err("refused").to_string()
    }

    fn point<T: Scalar>(robot: &Robot<T>) -> OperatingPoint<T> {
        OperatingPoint {
            time: real(1.5),
            position: [real(0.3), real(-0.2)],
            velocity: [real(0.7), real(0.05)],
            yaw_rate: real(-0.4),
            wheel_speed: [real(6.0), real(9.0)],
            wheel_angle: [real(1.0), real(2.0)],
            torque: [real(1.0), real(-2.0)],
            ..robot.at_rest()
        }
    }

    fn robot<T: Scalar>() -> Robot<T> {
        Robot::from(&robot_model::paper::Parameters::SET_B)
    }

    #[test]
    fn at_neutral_strength_nothing_changes_and_at_the_numbers_of_the_file_the_law_acts() {
        let robot = robot::<f64>();
        let at = point(&robot);
        for (formula, values) in [
            ("T_right = -0.5 [N m] * sgn(omega, 0.3)", vec![-0.5]),
            ("grip_all = -0.2 [1] * bump(omega, 4)", vec![-0.2, 4.0]),
            ("slope_x = 0.1 [rad]; slope_y = -0.2 [rad] * disc(0, 0, 1.5)", vec![0.1, -0.2, 0.0, 0.0, 1.5]),
            ("radius_left = 0.01 [m] * cos(phi, 2, 0.4)", vec![0.01, 0.4]),
        ] {
            let effect = effect(formula);
            let before = robot.coefficients();
            let mut neutral = [0.0; MAX_PARAMETERS];
            for (v, p) in neutral.iter_mut().zip(effect.spec().parameters) {
                *v = p.neutral;
            }
            let mut after = before;
            effect.apply(&neutral, &at, &mut after);
            assert_eq!(format!("{after:?}"), format!("{before:?}"), "{formula}");

            let mut own = [0.0; MAX_PARAMETERS];
            own[..values.len()].copy_from_slice(&values);
            let mut after = before;
            effect.apply(&own, &at, &mut after);
            let mut expected = before;
            effect.law().act(&Motion::seen_at(&at, &before), &[]).change(&at, &mut expected);
            assert_eq!(format!("{after:?}"), format!("{expected:?}"), "{formula}");
            assert_ne!(format!("{after:?}"), format!("{before:?}"), "{formula}");
        }
    }

    #[test]
    fn a_lane_has_the_bits_of_the_law_alone() {
        let effect = effect("T_both = -0.5 [N m s/rad] * pow(omega, 1) * bump(v, 0.8)");
        let (alone, wide) = (robot::<f64>(), robot::<Lanes<2>>());
        let mut lanes = wide.coefficients();
        let values = [[-0.5, 0.8], [0.25, 0.3]];
        let side_by_side: Values<Lanes<2>> =
            std::array::from_fn(|i| Lanes(values.map(|lane| lane.get(i).copied().unwrap_or_default())));
        effect.apply(&side_by_side, &point(&wide), &mut lanes);
        for (lane, own) in values.iter().enumerate() {
            let mut c = alone.coefficients();
            effect.apply(&[own[0], own[1], 0.0, 0.0, 0.0], &point(&alone), &mut c);
            assert_eq!([lanes.torque[0].0[lane], lanes.torque[1].0[lane]], c.torque);
        }
    }

    #[test]
    fn constants_are_strengths_and_shapes_start_at_the_numbers_of_the_file() {
        let effect = effect("T_left = 2 [N m s/rad] * pow(omega, 1) * bump(v, 0.8) * cos(phi, 1, 0)");
        let told: Vec<(&str, &str, Role)> = effect.spec().parameters.iter().map(|p| (p.name, p.unit, p.role)).collect();
        assert_eq!(
            told,
            [
                ("constant", "N m s/rad", Role::Strength),
                ("a of bump(v)", "m/s", Role::Shape),
                ("phase of cos(phi)", "rad", Role::Shape)
            ]
        );
        let phase = effect.spec().parameters[2];
        assert!(phase.neutral == 0.0 && phase.step.is_some_and(|step| step > 0.0));
        let static_effect: &'static dyn Effect<f64> = effect;
        assert!(OwnEffect::of(static_effect).is_some_and(|own| own.name() == "my-law"));
        assert!(OwnEffect::of(robot_model::effects::catalogue::<f64>()[0]).is_none());
    }

    #[test]
    fn names_and_laws_that_no_free_run_can_take_part_in_are_refused_in_one_sentence() {
        let dry = "T_right = -0.5 [N m] * sgn(omega, 0.3)";
        assert!(refused("My law", dry).contains("'My law' cannot be the name of an effect"));
        assert!(refused("a", "T_both = 2 [1] * lag(T, 0.5)").contains("'lag(T, 0.5)' has a hidden state"));
        let many = "slope_x = 1 [rad] * disc(0, 0, 1); slope_y = 1 [rad] * disc(0, 0, 1)";
        assert!(refused("a", many).contains("has 8 numbers; an effect has at most 5"));
        assert!(refused("a", "T_left = 1 [N m]; F_x = 1 [N]").contains("N m and N"));
        assert!(refused("a", "T_left = 0 [N m]").contains("constant of 'T_left = 0 [N m]' is zero"));
        let narrow = refused("a", "T_left = 1 [N m] * sgn(omega, 0)");
        assert!(narrow.contains("'sgn(omega, 0)' has 0, but this number lies from 0.000001 to 1000000"), "{narrow}");
        assert!(refused("a", "T_left = 1 [N m] * bump(omega, -2)").contains("'bump(omega, -2)' has -2"));
    }

    #[test]
    fn variables_are_held_within_the_range_seen() {
        let law: Law = "T_left = 2 [N m s/rad] * pow(omega, 1)".parse().expect("a law");
        let law = law.seen_within(&[(Variable::WheelSpeed, [-4.0, 5.0])]);
        let effect = OwnEffect::new("held", law).expect("an effect");
        let robot = robot::<f64>();
        let mut c = robot.coefficients();
        effect.apply(&[2.0, 0.0, 0.0, 0.0, 0.0], &point(&robot), &mut c);
        assert_eq!(c.torque[0], 10.0);
        let told = effect.beyond_seen(|_| Some([-3.0, 6.5]));
        assert!(told.len() == 1 && told[0].contains("omega (wheel speed) from -4.000 to 5.000 rad/s"), "{told:?}");
        assert!(effect.beyond_seen(|_| Some([-3.0, 4.5])).is_empty() && effect.beyond_seen(|_| None).is_empty());
    }
}
