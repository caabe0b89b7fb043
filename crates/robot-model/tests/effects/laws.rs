//! Laws that tell where they are fixed.

use robot_model::{Effect, effects};

use crate::battery::instant;

#[test]
fn a_grade_is_fixed_in_the_world_and_a_pull_in_the_robot() {
    for heading in [0.0, 0.8, 2.5, -1.9_f64] {
        let (at, mut w) = instant(heading);
        effects::grade::Law.apply(&[0.02, -0.05, 0.0, 0.0, 0.0], &at, &mut w);
        let (c, s, [x, y]) = (heading.cos(), heading.sin(), w.tilt);
        let slope = 0.02_f64.hypot(0.05);
        let share = slope.sin() / slope;
        for (got, wanted) in [(c * x - s * y, 0.02), (s * x + c * y, -0.05)] {
            assert!((got - at.gravity * share * wanted).abs() < 1e-10, "heading {heading}: {got}");
        }
        let (at, mut w) = instant(heading);
        effects::constant_pull::Law.apply(&[4.0, 0.0, 0.0, 0.0, 0.0], &at, &mut w);
        assert_eq!(w.force, [-4.0, 0.0]);
        // x Fy − y Fx at the hitch.
        assert!((w.moment - (at.hitch[0] * w.force[1] - at.hitch[1] * w.force[0])).abs() < 1e-12);
    }
}
