//! Checks of the constructors, the angle rows and single precision.

use crate::{AngleRow, Identifier, IdentifierError, Ledger, Midpoint};

#[test]
fn gains_that_cannot_work_are_refused() {
    assert_eq!(Midpoint::new(0.0), Err(IdentifierError::NotPositive { name: "gain gamma" }));
    let law = Midpoint::new(500.0).expect("valid");
    assert!(Identifier::<_, 6>::new(-8.0, law, 0.0).is_err());
    assert!(Identifier::<_, 6>::new(8.0, law, f64::NAN).is_err());
    assert!(AngleRow::new(f64::INFINITY, 0.0).is_err());
}

#[test]
fn the_angle_error_decays_with_the_pole_whatever_the_wheel_does() {
    let mut row = AngleRow::new(8.0, -1.0).expect("valid");
    let angle = |t: f64| t * t + nalgebra::ComplexField::sin(3.0 * t);
    let h = 1e-3;
    for k in 0..1000 {
        let (t, end) = (f64::from(k) * h, f64::from(k + 1) * h);
        let mean_speed = (angle(end) - angle(t)) / h;
        let error = row.step(angle(t), angle(end), mean_speed, h);
        let expected = nalgebra::ComplexField::exp(-8.0 * end);
        assert!((error - expected).abs() < 3e-5, "{error} {expected} at {end}");
    }
}

#[test]
fn single_precision_holds_the_identity_to_its_rounding() {
    let mut identifier = Identifier::new(8.0_f32, Midpoint::new(500.0).expect("valid"), 0.0).expect("valid");
    let mut ledger = Ledger::new(8.0_f32);
    for k in 0..2000_u16 {
        let x = f32::from(k) * 1e-3;
        let step = identifier.step(x, x + 1e-3, &[0.5; 6], 1e-3);
        ledger.add(&identifier.certificate(&step, &[2.0; 6]));
    }
    assert!(ledger.worst_residual() < 1e-4, "{}", ledger.worst_residual());
    assert!(ledger.holds() && identifier.model().output > 1.9);
}

#[test]
fn a_residual_that_is_not_a_number_is_not_lost() {
    let mut identifier = Identifier::new(8.0, Midpoint::new(500.0).expect("valid"), 0.0).expect("valid");
    let mut ledger = Ledger::new(8.0);
    for x in [1.0, f64::NAN, 1.0] {
        let step = identifier.step(x, x, &[1.0], 1e-3);
        ledger.add(&identifier.certificate(&step, &[0.0]));
    }
    assert!(!ledger.worst_residual().is_finite() && !ledger.holds());
}
