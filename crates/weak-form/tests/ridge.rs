//! Laws between columns are found again, and what the windows do not determine is refused.

use weak_form::{Gram, Shape, WeakForm, WeakFormError};

/// Three signals: two that move by themselves, and `2 x − 0.7 y² + 0.3 x y`.
fn drive() -> (Shape, Gram) {
    let shape = Shape::new(3, 31, 8, 4).expect("in range");
    let mut weak = WeakForm::new(shape);
    for i in 0..4000 {
        let t = 0.01 * f64::from(i);
        let (x, y) = ((1.3 * t).sin() + 0.2 * t.cos(), 1.0 + (0.7 * t).cos() * (2.1 * t).sin());
        weak.push(&[x, y, 2.0 * x - 0.7 * y * y + 0.3 * x * y]).expect("a row");
    }
    (shape, weak.gram())
}

#[test]
fn a_law_is_found_among_all_columns() {
    let (shape, gram) = drive();
    let [yy, xy] = [(1, 1), (0, 1)].map(|(i, j)| shape.product(i, j).expect("a column"));
    let regressors = [0, 1, shape.product(0, 0).expect("a column"), xy, yy];
    let law = gram.ridge(&[2], &regressors, 0.0).expect("determined");
    for (r, expected) in [2.0, 0.0, 0.0, 0.3, -0.7].into_iter().enumerate() {
        approx::assert_abs_diff_eq!(law.coefficient(r, 0), expected, epsilon = 1e-7);
    }
    assert!(law.unexplained()[0] < 1e-10);
    assert!(law.coefficient(5, 0).is_nan() && law.coefficient(0, 1).is_nan());
}

#[test]
fn a_penalty_makes_coefficients_smaller() {
    let (_, gram) = drive();
    let [free, held] = [0.0, 1.0].map(|penalty| gram.ridge(&[2], &[0], penalty).expect("determined"));
    // One regressor: half of it, whatever its unit.
    approx::assert_relative_eq!(held.coefficient(0, 0), 0.5 * free.coefficient(0, 0), max_relative = 1e-14);
    assert!(held.unexplained()[0] > free.unexplained()[0]);
}

#[test]
fn what_the_windows_do_not_determine_is_refused() {
    let (shape, gram) = drive();
    let [yy, xy] = [(1, 1), (0, 1)].map(|(i, j)| shape.product(i, j).expect("a column"));
    // The third signal is a combination of the others.
    let twins = [0, 2, xy, yy];
    assert!(matches!(gram.ridge(&[1], &twins, 0.0), Err(WeakFormError::NotDetermined { regressors: 4, .. })));
    assert!(gram.ridge(&[1], &twins, 1e-3).is_ok());
    assert!(matches!(gram.ridge(&[1], &[0, 0], 0.0), Err(WeakFormError::NotDetermined { .. })));
    assert!(matches!(gram.ridge(&[1], &[], 0.0), Err(WeakFormError::NotDetermined { .. })));
    assert!(matches!(gram.ridge(&[1], &[9], 0.0), Err(WeakFormError::NoSuchColumn { column: 9, columns: 9 })));
    assert!(matches!(gram.ridge(&[1], &[0], f64::NAN), Err(WeakFormError::Penalty { .. })));
    assert!(matches!(gram.ridge(&[1], &[0], -1.0), Err(WeakFormError::Penalty { .. })));
    let nothing = WeakForm::new(shape).gram();
    assert!(matches!(nothing.ridge(&[1], &[0], 0.0), Err(WeakFormError::NotDetermined { windows: 0, .. })));
    let mut other = WeakForm::new(Shape::new(3, 31, 9, 4).expect("in range")).gram();
    assert!(matches!(other.add(&gram), Err(WeakFormError::OtherShape { .. })));
}
