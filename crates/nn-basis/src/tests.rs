//! Values, limits and checks of the bases.

use crate::{Activation, Basis, BasisError, Constant, Lanes, LinearNet, SigmoidLayer};

#[test]
fn logistic_and_tanh_have_their_known_values_and_limits() {
    let logistic = |z: f64| Activation::Logistic.apply(z);
    assert_eq!((logistic(0.0), logistic(1e4), logistic(-1e4)), (0.5, 1.0, 0.0));
    assert!((logistic(1.0) - 0.731_058_578_630_004_9).abs() < 1e-15);
    assert!((Activation::Tanh.apply(1.0_f64) - 0.761_594_155_955_764_9).abs() < 1e-15);
}

#[test]
fn inputs_are_scaled() {
    let layer = SigmoidLayer::new([0.25], [[2.0, -1.0]], [10.0, 4.0], Activation::Tanh).expect("valid");
    let phi = layer.regressor(&[5.0_f64, 2.0]);
    assert!((phi[0] - 0.75_f64.tanh()).abs() < 1e-15);
}

#[test]
fn single_precision_works() {
    let layer = SigmoidLayer::new([0.1_f32; 2], [[1.0], [2.0]], [3.0], Activation::Logistic).expect("valid");
    assert!(layer.regressor(&[1.0]).iter().all(|p| *p > 0.5 && *p < 1.0));
}

#[test]
fn what_is_not_finite_is_refused_with_its_place() {
    let build = |threshold, weight, scale| SigmoidLayer::<f64, 2, 1>::new(threshold, weight, scale, Activation::Tanh);
    assert_eq!(build([f64::NAN], [[1.0; 2]], [1.0; 2]), Err(BasisError::Threshold { unit: 0 }));
    assert_eq!(build([0.0], [[1.0, f64::INFINITY]], [1.0; 2]), Err(BasisError::Weight { unit: 0, input: 1 }));
    assert_eq!(build([0.0], [[1.0; 2]], [1.0, 0.0]), Err(BasisError::Scale { input: 1 }));
    assert_eq!(Constant::new([0.5, f64::NAN]), Err(BasisError::Threshold { unit: 1 }));
}

#[test]
fn a_constant_ignores_its_input() {
    let basis = Constant::new([0.5_f64; 6]).expect("valid");
    assert_eq!(basis.regressor(&[1.0, 2.0]), basis.regressor(&[-7.0, 0.0]));
}

#[test]
fn the_net_is_linear_and_adapts_one_output() {
    let mut net = LinearNet::<f64, 2, 2>::default();
    net.adapt(1, &[1.0, 2.0], 0.5, 0.0);
    net.adapt(7, &[1.0, 2.0], 0.5, 0.0);
    assert_eq!(net.output(&[1.0, 1.0]), [0.0, 1.5]);
    net.adapt(1, &[0.0, 0.0], 0.0, 0.5);
    assert_eq!(net.output(&[1.0, 1.0]), [0.0, 0.75]);
}

#[test]
fn layers_side_by_side_give_what_each_gives_alone() {
    let layer = |w: f64, a| SigmoidLayer::new([0.1, w], [[w, -1.0], [0.5, w]], [3.0, 0.7], a).expect("finite");
    for activation in [Activation::Logistic, Activation::Tanh] {
        let layers = [layer(0.3, activation), layer(-2.0, activation), layer(7.0, activation)];
        let wide = SigmoidLayer::side_by_side(&layers).expect("of one kind");
        let phi = wide.regressor(&[Lanes([0.4, 1.0, -3.0]), Lanes([1.0, 2.0, 0.1])]);
        for (i, x) in [[0.4, 1.0], [1.0, 2.0], [-3.0, 0.1]].into_iter().enumerate() {
            assert_eq!(phi.map(|p| p.0[i].to_bits()), layers[i].regressor(&x).map(f64::to_bits));
        }
    }
    assert!(SigmoidLayer::side_by_side(&[layer(1.0, Activation::Tanh), layer(1.0, Activation::Logistic)]).is_none());
}
