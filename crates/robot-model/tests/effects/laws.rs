//! Laws that tell where they are fixed.

use robot_model::effect::{LoadTerm, MAX_PARAMETERS};
use robot_model::{Effect, effects};

use crate::battery::{instant, numbers_of};

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

/// Steady loads of turns are averaged over headings only where a slope is among the causes.
#[test]
fn nothing_but_a_slope_asks_for_the_heading() {
    for effect in effects::catalogue::<f64>() {
        let spec = effect.spec();
        let mut values = [0.0; MAX_PARAMETERS];
        values.iter_mut().zip(spec.parameters).for_each(|(v, p)| *v = p.probes[0]);
        let at_heading = |heading: f64| {
            let (at, mut coefficients) = instant(heading);
            effect.apply(&values, &at, &mut coefficients);
            numbers_of(&coefficients)
        };
        let is_alike = at_heading(0.3) == at_heading(-1.9);
        assert_eq!(is_alike, spec.load_term != Some(LoadTerm::Slope), "{}", spec.id);
    }
}
