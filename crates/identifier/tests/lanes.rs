//! Identifiers side by side: every lane has the bits of one of its own, certificates included.

use identifier::{
    AngleRow, Certificate, Euler, Exponential, Identifier, Lanes, Law, Leaky, Ledger, Midpoint, Projection, Rate,
};

const N: usize = 4;
const GAINS: [f64; N] = [500.0, 50.0, 2000.0, 1e5];

fn regressor(k: u32, lane: usize) -> [f64; 3] {
    let t = f64::from(k) * 1e-3 * (1.0 + lane as f64);
    [0.5 + 0.3 * t.sin(), 0.4, (3.0 * t).cos()]
}

fn output(k: u32, lane: usize) -> f64 {
    (f64::from(k) * 2e-3).sin() + 0.3 * lane as f64
}

fn bits(c: &Certificate<f64>) -> [u64; 5] {
    [c.before, c.after, c.change, c.predicted, c.residual].map(f64::to_bits)
}

fn agree<L: Law<f64, 3>, W: Law<Lanes<N>, 3>>(name: &str, alone: impl Fn(f64) -> L, wide: W) {
    let mut together = Identifier::new(Lanes([8.0; N]), wide, Lanes([0.0; N])).expect("valid");
    let mut ledger = Ledger::new(Lanes([8.0; N]));
    let mut each: Vec<_> =
        GAINS.map(|g| (Identifier::new(8.0, alone(g), 0.0).expect("valid"), Ledger::new(8.0))).into_iter().collect();
    for k in 0..2000 {
        let at = |k: u32| Lanes(std::array::from_fn(|i| output(k, i)));
        let phis: [[f64; 3]; N] = std::array::from_fn(|i| regressor(k, i));
        let phi = [0, 1, 2].map(|j| Lanes(phis.map(|p| p[j])));
        let step = together.step(at(k), at(k + 1), &phi, Lanes([1e-3; N]));
        let certificate = together.certificate(&step, &[Lanes([2.0; N]); 3]);
        ledger.add(&certificate);
        for (i, (identifier, ledger)) in each.iter_mut().enumerate() {
            let step = identifier.step(output(k, i), output(k + 1, i), &phis[i], 1e-3);
            let one = identifier.certificate(&step, &[2.0; 3]);
            ledger.add(&one);
            let c = &certificate;
            let lane = [c.before, c.after, c.change, c.predicted, c.residual].map(|x| x.0[i].to_bits());
            assert_eq!(lane, bits(&one), "{name}, lane {i}, step {k}");
        }
    }
    for (i, (found, (identifier, wanted))) in ledger.apart().iter().zip(&each).enumerate() {
        assert_eq!(found, wanted, "{name}, lane {i}");
        let weight = together.model().weight.map(|w| w.0[i].to_bits());
        assert_eq!(weight, identifier.model().weight.map(f64::to_bits), "{name}, lane {i}");
        assert!(found.rises() > 0.0 && found.worst_residual() < 1e-9, "{name}: {found:?}");
    }
}

#[test]
fn every_lane_of_every_law_has_the_bits_of_its_own() {
    let gain = Lanes(GAINS);
    let all = |x: f64| Lanes([x; N]);
    agree("Euler", |g| Euler::new(g).expect("valid"), Euler::new(gain).expect("valid"));
    let midpoint = |g| Midpoint::new(g).expect("valid");
    let wide = Midpoint::new(gain).expect("valid");
    agree("midpoint", midpoint, wide);
    agree("exponential", |g| Exponential::new(g).expect("valid"), Exponential::new(gain).expect("valid"));
    agree(
        "dead zone",
        |g| Exponential::with_dead_zone(g, 0.1).expect("valid"),
        Exponential::with_dead_zone(gain, all(0.1)).expect("valid"),
    );
    agree(
        "projection",
        |g| Projection::new(midpoint(g), 3.0).expect("valid"),
        Projection::new(wide, all(3.0)).expect("valid"),
    );
    agree(
        "leak",
        |g| Leaky::new(midpoint(g), Rate::Error(1e-2)).expect("valid"),
        Leaky::new(wide, Rate::Error(all(1e-2))).expect("valid"),
    );
}

#[test]
fn one_bad_lane_is_enough_to_be_refused() {
    assert!(Midpoint::new(Lanes([1.0, 0.0])).is_err() && Midpoint::new(Lanes([1.0, f64::NAN])).is_err());
    assert!(AngleRow::new(Lanes([8.0, 8.0]), Lanes([0.0, f64::INFINITY])).is_err());
    assert!(Exponential::with_dead_zone(Lanes([1.0; 2]), Lanes([0.1, -0.1])).is_err());
}
