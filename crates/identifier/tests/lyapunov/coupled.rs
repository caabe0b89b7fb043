//! A general Hurwitz matrix: its Lyapunov equation, and the identity over it.

use identifier::{CoupledIdentifier, CoupledSample, HurwitzMatrix, Identifier, LyapunovError, Midpoint};
use proptest::prelude::*;

use super::decades;

const IDENTITY: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// A = −(S + K) with S positive definite and K skew: Hurwitz, and far from diagonal.
fn hurwitz() -> impl Strategy<Value = [[f64; 3]; 3]> {
    (prop::array::uniform3(prop::array::uniform3(-3.0..3.0_f64)), prop::array::uniform3(-20.0..20.0_f64)).prop_map(
        |(b, k)| {
            let skew = [[0.0, k[0], k[1]], [-k[0], 0.0, k[2]], [-k[1], -k[2], 0.0]];
            std::array::from_fn(|i| {
                std::array::from_fn(|j| {
                    let s: f64 = (0..3).map(|l| b[i][l] * b[j][l]).sum();
                    -(s + if i == j { 0.5 } else { 0.0 } + skew[i][j])
                })
            })
        },
    )
}

#[test]
fn the_matrix_of_erratum_11_is_hurwitz_with_a_p_of_its_own() {
    let a = [[-1.0, 10.0], [0.0, -1.0]];
    let unit = [[1.0, 0.0], [0.0, 1.0]];
    assert!(HurwitzMatrix::new(a, unit).is_err(), "P = I proves nothing here: A + A' has the eigenvalue 8");
    let proved = HurwitzMatrix::solve(a, unit).expect("Hurwitz");
    // By hand: p11 = 1/2, p12 = 10 p11/2, p22 = (1 + 20 p12)/2.
    let p = proved.p();
    assert!((p[(0, 0)] - 0.5).abs() < 1e-12 && (p[(0, 1)] - 2.5).abs() < 1e-12 && (p[(1, 1)] - 25.5).abs() < 1e-11);
}

#[test]
fn a_matrix_that_does_not_decay_is_refused_with_its_eigenvalues() {
    let error = HurwitzMatrix::solve([[0.0, 2.0], [-2.0, 0.0]], [[1.0, 0.0], [0.0, 1.0]]).expect_err("oscillates");
    let text = error.to_string();
    assert!(text.contains("not Hurwitz") && text.contains("2.000000i"), "{text}");
    let error = HurwitzMatrix::solve([[1.0, 0.0], [0.0, -3.0]], [[1.0, 0.0], [0.0, 1.0]]).expect_err("grows");
    assert!(error.to_string().contains("1.000000, -3") || error.to_string().contains("-3.000000, 1"), "{error}");
    let error = HurwitzMatrix::solve([[-1.0, f64::NAN], [0.0, -3.0]], [[1.0, 0.0], [0.0, 1.0]]).expect_err("NaN");
    assert_eq!(error, LyapunovError::NotFinite { matrix: "A", row: 0, column: 1 });
    let error = HurwitzMatrix::solve([[-1.0, 0.0], [0.0, -3.0]], [[1.0, 0.0], [0.0, -1.0]]).expect_err("Q indefinite");
    assert!(matches!(error, LyapunovError::NotProved { .. }), "{error}");
}

#[test]
fn for_a_diagonal_matrix_the_rows_are_the_scalar_identifiers() {
    let a = [[-8.0, 0.0], [0.0, -8.0]];
    let matrix = HurwitzMatrix::new(a, [[1.0, 0.0], [0.0, 1.0]]).expect("Hurwitz");
    let mut coupled = CoupledIdentifier::<f64, 2, 3>::new(matrix, 500.0, [0.0; 2]).expect("valid");
    let law = Midpoint::new(500.0).expect("valid");
    let mut rows = [Identifier::<_, 3>::new(8.0, law, 0.0), Identifier::new(8.0, law, 0.0)].map(|r| r.expect("valid"));
    let (h, mut x) = (1e-3, [0.0, 0.0]);
    for k in 0..3000 {
        let t = f64::from(k) * h;
        let next = [(3.0 * t).sin(), t.cos() - 1.0];
        let phi = [0.5, t.sin(), 0.2];
        let sample = CoupledSample { start: x, end: next, regressor: phi, known: [0.0; 2], h };
        let errors = coupled.follow(&sample);
        for (i, row) in rows.iter_mut().enumerate() {
            let step = row.step(x[i], next[i], &phi, h);
            assert!((step.error_after - errors[i]).abs() < 1e-12, "{k}");
        }
        x = next;
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn the_lyapunov_equation_is_solved(a in hurwitz()) {
        let proved = HurwitzMatrix::solve(a, IDENTITY).expect("Hurwitz");
        let off = (proved.q() - nalgebra::SMatrix::<f64, 3, 3>::identity()).norm();
        prop_assert!(off < 1e-8 * proved.p().norm() * proved.a().norm(), "{off}");
    }

    #[test]
    fn the_identity_is_exact_for_any_hurwitz_matrix(
        a in hurwitz(),
        h in decades(1e-4, 10.0),
        gain in decades(0.5, 5e4),
        star in prop::array::uniform4(prop::array::uniform3(-50.0..50.0_f64)),
        steps in prop::collection::vec(
            (prop::array::uniform4(-1.0..1.0_f64), prop::array::uniform3(-10.0..10.0_f64)), 2..30),
    ) {
        let matrix = HurwitzMatrix::solve(a, IDENTITY).expect("Hurwitz");
        let mut identifier = CoupledIdentifier::<f64, 3, 4>::new(matrix, gain, [0.0; 3]).expect("valid");
        let mut x = [0.0; 3];
        for (phi, next) in steps {
            let sample = CoupledSample { start: x, end: next, regressor: phi, known: [0.3; 3], h };
            let before = identifier;
            identifier.follow(&sample);
            let c = identifier.certificate(&before, &sample, &star);
            prop_assert!(c.residual <= 1e-9, "{c:?}");
            x = next;
        }
    }

    #[test]
    fn without_approximation_error_l_falls_over_a_general_matrix(
        a in hurwitz(),
        h in decades(1e-4, 1.0),
        gain in decades(0.5, 5e4),
        truth in prop::array::uniform4(prop::array::uniform3(-50.0..50.0_f64)),
        steps in prop::collection::vec(prop::array::uniform4(-1.0..1.0_f64), 2..40),
    ) {
        let matrix = HurwitzMatrix::solve(a, IDENTITY).expect("Hurwitz");
        let mut identifier = CoupledIdentifier::<f64, 3, 4>::new(matrix, gain, [0.0; 3]).expect("valid");
        let unit = nalgebra::SMatrix::<f64, 3, 3>::identity();
        let (left, right) = (unit - matrix.a() * (0.5 * h), unit + matrix.a() * (0.5 * h));
        let inverse = left.try_inverse().expect("A is Hurwitz");
        let mut x = nalgebra::SVector::<f64, 3>::new(1.0, -2.0, 0.5);
        for phi in steps {
            let force = nalgebra::SVector::<f64, 3>::from_fn(|j, _| (0..4).map(|i| truth[i][j] * phi[i]).sum());
            let next = inverse * (right * x + force * h);
            let sample = CoupledSample { start: x.into(), end: next.into(), regressor: phi, known: [0.0; 3], h };
            let before = identifier;
            identifier.follow(&sample);
            let c = identifier.certificate(&before, &sample, &truth);
            prop_assert!(c.after <= c.before * (1.0 + 1e-9), "{c:?}");
            x = next;
        }
    }
}
