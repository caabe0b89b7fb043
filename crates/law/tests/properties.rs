//! Units close, formulas read back, values stay finite.

use law::{Factor, Law, Memory, Motion, Place, Term, Unit, Variable};
use proptest::prelude::*;

fn variable() -> impl Strategy<Value = Variable> {
    proptest::sample::select(Variable::ALL.to_vec())
}

fn amount() -> impl Strategy<Value = Variable> {
    variable().prop_filter("an amount", |v| v.is_amount())
}

fn angle() -> impl Strategy<Value = Variable> {
    variable().prop_filter("an angle", |v| v.is_angle())
}

fn factor() -> impl Strategy<Value = Factor> {
    let x = || -1e6..1e6_f64;
    prop_oneof![
        (amount(), 1..=3_u8).prop_map(|(v, p)| Factor::Power(v, p)),
        (amount(), 1..=3_u8).prop_map(|(v, p)| Factor::EvenPower(v, p)),
        (amount(), x()).prop_map(|(v, a)| Factor::Sign(v, a)),
        (amount(), x()).prop_map(|(v, a)| Factor::Excess(v, a)),
        (amount(), x()).prop_map(|(v, a)| Factor::Clip(v, a)),
        (amount(), x()).prop_map(|(v, a)| Factor::Bump(v, a)),
        (amount(), x()).prop_map(|(v, a)| Factor::Above(v, a)),
        (angle(), 1..=8_u8, x()).prop_map(|(v, n, p)| Factor::Turn(v, n, p)),
        (x(), x()).prop_map(|(w, p)| Factor::Oscillation(w, p)),
        x().prop_map(Factor::Rise),
        (amount(), x()).prop_map(|(v, t)| Factor::Lag(v, t)),
        (amount(), 1..=3_u8, x()).prop_map(|(v, q, t)| Factor::Heat(v, q, t)),
        (x(), x(), x()).prop_map(|(x, y, r)| Factor::Disc(x, y, r)),
    ]
}

fn term() -> impl Strategy<Value = Term> {
    let place = proptest::sample::select(Place::ALL.to_vec());
    (place, -1e9..1e9_f64, proptest::collection::vec(factor(), 0..=3))
        .prop_map(|(place, constant, factors)| Term::new(place, constant, &factors).expect("allowed"))
}

fn law() -> impl Strategy<Value = Law> {
    proptest::collection::vec(term(), 1..=2).prop_map(|terms| Law::new(terms).expect("one or two"))
}

fn any() -> impl Strategy<Value = f64> {
    proptest::num::f64::NORMAL | proptest::num::f64::ZERO
}

proptest! {
    #[test]
    fn every_term_closes(term in term()) {
        let unit = term.factors().iter().fold(term.unit(), |unit: Unit, f| unit * f.unit());
        prop_assert_eq!(unit, term.place().unit());
    }

    #[test]
    fn a_formula_reads_back(law in law()) {
        prop_assert_eq!(law.to_string().parse::<Law>().expect("reads"), law);
    }

    #[test]
    fn a_rounded_formula_reads_back_as_nearly_the_same(law in law()) {
        let rounded: Law = format!("{law:.6}").parse().expect("reads");
        prop_assert_eq!(rounded.terms().len(), law.terms().len());
        for (rounded, exact) in rounded.terms().iter().zip(law.terms()) {
            prop_assert!((rounded.constant() - exact.constant()).abs() <= 5e-6 * exact.constant().abs());
            prop_assert_eq!(rounded.unit(), exact.unit());
        }
    }

    #[test]
    fn a_file_reads_back(law in law(), low in -1e3..0.0_f64, high in 0.0..1e3_f64) {
        let seen: Vec<_> = law.variables().into_iter().map(|v| (v, [low, high])).collect();
        let law = law.seen_within(&seen);
        let text = toml::to_string(&law).expect("writes");
        prop_assert_eq!(toml::from_str::<Law>(&text).expect("reads"), law);
    }

    #[test]
    fn values_are_finite(law in law(), x in proptest::collection::vec(any(), 16), dt in 1e-4..1.0_f64) {
        let m = Motion {
            time: x[0],
            position: [x[1], x[2]],
            heading: [x[3].cos(), x[3].sin()],
            velocity: [x[4], x[5]],
            yaw_rate: x[6],
            wheel_speed: [x[7], x[8]],
            wheel_angle: [x[9], x[10]],
            torque: [x[11], x[12]],
            slip: [x[13], x[14]],
        };
        let mut memory = Memory::new(&law);
        memory.step(&law, &m, dt);
        let a = law.act(&m, memory.states());
        let all = [a.torque, a.force, [a.moment, a.lateral_grip], a.grip, a.radius, a.slope].concat();
        prop_assert!(all.iter().all(|x| x.is_finite()), "{law}: {all:?}");
    }

    #[test]
    fn any_text_gives_an_answer(text in ".{0,60}") {
        let _ = text.parse::<Law>();
    }
}

#[test]
fn a_wrong_unit_is_refused_and_the_right_one_named() {
    let error = "T_left = 1 [N s/rad] * pow(omega, 1)".parse::<Law>().expect_err("wrong");
    assert!(error.to_string().contains("closes with N m s/rad"), "{error}");
    let error = "T_left = 1 [N m] * pow(phi, 1)".parse::<Law>().expect_err("wrong");
    assert!(error.to_string().contains("'phi' cannot enter 'pow'"), "{error}");
    assert!("T_left = 1 [N m] * sgn(speed, 1)".parse::<Law>().expect_err("wrong").to_string().contains("omega"));
}

#[test]
fn a_law_is_held_within_the_range_in_which_it_was_seen() {
    let law: Law = "T_left = 2 [N m s/rad] * pow(omega, 1)".parse().expect("a law");
    let fast = Motion { wheel_speed: [9.0, 0.0], ..Motion::default() };
    assert_eq!(law.act(&fast, &[]).torque[0], 18.0);
    let seen = law.seen_within(&[(Variable::WheelSpeed, [-4.0, 5.0])]);
    assert_eq!(seen.act(&fast, &[]).torque[0], 10.0);
}

#[test]
fn a_range_upside_down_or_without_end_is_refused_in_a_sentence() {
    let read = |range: &str| {
        let text = format!("formula = \"T_both = -0.5 [N m] * sgn(omega, 0.3)\"\n[seen]\nomega = {range}\n");
        toml::from_str::<Law>(&text)
    };
    assert!(read("[-4, 5]").is_ok());
    let reversed = read("[5, -4]").expect_err("refused").to_string();
    assert!(reversed.contains("the range of 'omega' is 5 to -4; write the least value first"), "{reversed}");
    let endless = read("[-4, inf]").expect_err("refused").to_string();
    assert!(endless.contains("a number of 'omega' is not finite"), "{endless}");
}
