//! Effects that a constant of the robot can stand for: the constant may have moved since the references.

use robot_model::Robot;
use robot_model::tunable::{COUNT as NUISANCES, tunables, tuned};

use crate::fit::{Point, Problem};
use crate::run_numbers::constant;
use crate::trial::Trial;
use inference::hypothesis::{Place, Variant, variants};

/// A constant that an effect is, under another name.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StandIn {
    /// Its place among the tunable constants.
    pub(crate) place: usize,
    relation: Relation,
}

/// How a constant's move, in the unit of its tuning (the logarithm of a factor, or an offset), and an effect's size go
/// together.
#[derive(Debug, Clone, Copy)]
enum Relation {
    /// The size is the offset.
    Offset,
    /// The size is what the factor adds to a value.
    Added(f64),
    /// The size is the share that the factor takes away.
    Lost,
}

impl StandIn {
    /// The constant that stands for a form of an effect, if one does.
    pub(crate) fn of(variant: &Variant, robot: &Robot<f64>) -> Option<Self> {
        let with = |relation, id| Some(Self { place: constant(id), relation });
        let added = |id, of: f64| (of > 0.0).then_some(()).and_then(|()| with(Relation::Added(of), id));
        match (variant.spec().id, variant.place) {
            ("torque_constant", Place::Whole) => added("torque_constant", 1.0),
            ("payload", Place::Whole) => added("mass", robot.mass),
            ("com_offset", Place::Whole) => match variant.axis {
                Some(0) => with(Relation::Offset, "com_x"),
                Some(1) => with(Relation::Offset, "com_y"),
                _ => None,
            },
            // The share of the adhesion that is lost everywhere.
            ("adhesion_patch", Place::Whole) => with(Relation::Lost, "adhesion"),
            ("turning_resistance", Place::Whole) => added("lateral_factor", 1.0),
            ("slip_stiffness", Place::Whole) => added("slip_at_peak", 1.0),
            ("stiction", Place::Whole) => with(Relation::Offset, "stribeck"),
            ("viscous_friction", Place::Whole) => added("viscous", robot.viscous[0]),
            ("rolling_resistance", Place::Whole) => added("rolling_resistance", robot.rolling_resistance),
            ("coulomb_side", Place::Side(0)) => added("coulomb_left", robot.coulomb[0]),
            ("coulomb_side", Place::Side(1)) => added("coulomb_right", robot.coulomb[1]),
            _ => None,
        }
    }

    /// Whether tyres of another law than the plant's look as if it had moved: how much of a torque reaches the ground, and scrub.
    pub(crate) fn may_be_of_tyres(self) -> bool {
        const OF_TYRES: [usize; 4] =
            [constant("torque_constant"), constant("lateral_factor"), constant("slip_at_peak"), constant("adhesion")];
        OF_TYRES.contains(&self.place)
    }

    /// How far it would have moved; `None` where it cannot move so far.
    pub(crate) fn moved(self, size: f64) -> Option<f64> {
        match self.relation {
            Relation::Offset => Some(size),
            Relation::Added(to) => (to + size > 0.0).then(|| (1.0 + size / to).ln()),
            Relation::Lost => (size < 1.0).then(|| (1.0 - size).ln()),
        }
    }

    /// Size of the effect that is this move.
    pub(crate) fn size(self, moved: f64) -> f64 {
        match self.relation {
            Relation::Offset => moved,
            Relation::Added(to) => to * (moved.exp() - 1.0),
            Relation::Lost => 1.0 - moved.exp(),
        }
    }

    /// Change of the effect's size with the move, without its sign.
    fn slope(self, size: f64) -> f64 {
        match self.relation {
            Relation::Offset => 1.0,
            Relation::Added(to) => to + size,
            Relation::Lost => 1.0 - size,
        }
    }
}

/// The constant that scales both sides, of an effect that scales one of them.
pub(crate) fn of_both_sides(variant: &Variant) -> Option<usize> {
    (variant.spec().id == "torque_constant_side").then_some(const { constant("torque_constant") })
}

/// Price of a constant that moved instead of an effect: `½ z² + ln K` with its move `z`, in standard deviations of what it
/// moves by between visits, and the number `K` of constants of which one moved. `None` where no constant stands for it.
fn price(variant: &Variant, size: f64, problem: &Problem<'_>) -> Option<f64> {
    let constant = StandIn::of(variant, problem.robot)?;
    let of_visits = spread(problem, constant.place)?;
    Some(0.5 * (constant.moved(size)? / of_visits).powi(2) + (NUISANCES as f64).ln())
}

/// What the constant that stands for an effect may have moved by since the references, as one sigma of the effect's size.
/// Zero without references: the constants' own sigmas are then in every fit.
pub(crate) fn sigma_of_size(problem: &Problem<'_>, variant: &Variant, size: f64) -> f64 {
    let moved = || {
        let constant = StandIn::of(variant, problem.robot)?;
        constant.moved(size)?;
        Some(spread(problem, constant.place)? * constant.slope(size))
    };
    if problem.has_references { moved().unwrap_or(0.0) } else { 0.0 }
}

/// Mass that constants took over from an extra mass or gave to it, kg, as one sigma of its size: the mass itself, and the motors' inertia,
/// since in straight driving `2 J / r²` is a mass, and only how the robot scrubs and turns tells them apart, which no plant has quite as its
/// robot. Where references hold the constants they take over nothing.
pub(crate) fn mass_elsewhere(problem: &Problem<'_>, variant: &Variant, theta: &[f64; NUISANCES]) -> f64 {
    if !problem.constants_are_loose || variant.spec().id != "payload" {
        return 0.0;
    }
    let [now, before] = [theta, &problem.centre].map(|at| tuned(problem.robot, &problem.sigma, at));
    let of_motors = 2.0 * (now.motor_inertia - before.motor_inertia) / problem.robot.wheel_radius.powi(2);
    of_motors.hypot(now.mass - before.mass)
}

/// Whether an effect of the catalogue is this constant under another name.
pub(crate) fn is_an_effect(place: usize, robot: &Robot<f64>) -> bool {
    variants(true).iter().any(|v| StandIn::of(v, robot).is_some_and(|constant| constant.place == place))
}

/// How far a constant may have moved since the references, one standard deviation, in the unit of its tuning; `None` of one
/// that did not, as within a visit.
fn spread(problem: &Problem<'_>, place: usize) -> Option<f64> {
    let moves = problem.sigma[place] * tunables::<f64>()[place].between_visits * problem.moves;
    (moves > 0.0).then_some(moves)
}

/// The parts of a hypothesis that a constant can stand for, by their place in it, and what each pays as a constant that moved.
pub(crate) fn instead(problem: &Problem<'_>, trial: &Trial) -> Vec<(usize, f64)> {
    let mut rest = trial.fitted.point.effects.as_slice();
    let mut out = Vec::new();
    for (part, (variant, _)) in trial.hypothesis.parts.iter().enumerate() {
        let (own, others) = rest.split_at(variant.count());
        rest = others;
        let size = own.first().copied().unwrap_or(0.0);
        out.extend(price(variant, size, problem).map(|price| (part, price)));
    }
    out
}

/// A fit whose only effect is a constant that moved: the constant's place, how far it moves usually, in its sigmas, and the
/// same motion with the constant moved and no effect.
pub(crate) fn as_constant(problem: &Problem<'_>, trial: &Trial) -> Option<(usize, f64, Point)> {
    let [(variant, _)] = trial.hypothesis.parts.as_slice() else { return None };
    let constant = StandIn::of(variant, problem.robot)?;
    let sigma = problem.sigma[constant.place];
    let mut point = Point { effects: Vec::new(), ..trial.fitted.point.clone() };
    point.theta[constant.place] += constant.moved(*trial.fitted.point.effects.first()?)? / sigma;
    Some((constant.place, spread(problem, constant.place)? / sigma, point))
}

/// The constants of a fit without its effects, each moved as if the effect were there everywhere, where it is a constant then.
pub(crate) fn everywhere(problem: &Problem<'_>, trial: &Trial) -> Point {
    let Trial { hypothesis, fitted } = trial;
    let mut point = Point { effects: Vec::new(), ..fitted.point.clone() };
    let mut sizes = fitted.point.effects.as_slice();
    for (variant, _) in &hypothesis.parts {
        let (own, rest) = sizes.split_at(variant.count());
        sizes = rest;
        let constant = StandIn::of(&Variant { place: Place::Whole, ..*variant }, problem.robot);
        let Some((constant, size)) = constant.zip(own.first()) else { continue };
        point.theta[constant.place] += constant.moved(*size).unwrap_or(0.0) / problem.sigma[constant.place];
    }
    point
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::Hypothesis;
    use crate::testing::{cutting, driven, problem};
    use crate::windows::cut;
    use testing::robot;

    #[test]
    fn an_effect_as_large_as_its_constants_sigma_costs_little_as_that_constant() {
        let robot = robot();
        let cuts = [cut(&driven(&robot, &[], 8.0), &cutting())];
        let problem = problem(&robot, &cuts);
        let of = |id: &str| problem.variants().into_iter().find(|v| v.spec().id == id).expect("in the catalogue");
        let priced = |id: &str, size: f64| price(&of(id), size, &problem);

        let sigma =
            problem.sigma[constant("torque_constant")] * tunables::<f64>()[constant("torque_constant")].between_visits;
        let one = priced("torque_constant", sigma.exp() - 1.0).expect("a constant stands for it");
        approx::assert_relative_eq!(one, 0.5 + (NUISANCES as f64).ln(), epsilon = 1e-9);
        let four = priced("torque_constant", (4.0 * sigma).exp() - 1.0).expect("a constant stands for it");
        approx::assert_relative_eq!(four, 8.0 + (NUISANCES as f64).ln(), epsilon = 1e-9);
        assert!(
            priced("payload", 0.3 * robot.mass).expect("mass stands for it") > 100.0,
            "a third of the mass is no drift"
        );
        let adhesion = problem.sigma[constant("adhesion")] * tunables::<f64>()[constant("adhesion")].between_visits;
        let lost = priced("adhesion_patch", 1.0 - (-2.0 * adhesion).exp()).expect("adhesion stands for it everywhere");
        approx::assert_relative_eq!(lost, 2.0 + (NUISANCES as f64).ln(), epsilon = 1e-9);
        assert_eq!(priced("grade", 0.05), None);
        let of_size = |id: &str, size: f64| sigma_of_size(&problem, &of(id), size);
        approx::assert_relative_eq!(of_size("torque_constant", 0.2), 1.2 * sigma, epsilon = 1e-12);
        assert_eq!(of_size("grade", 0.05), 0.0);
        assert_eq!(priced("torque_constant", -1.5), None, "no factor is negative");
    }

    #[test]
    fn where_constants_are_loose_an_extra_mass_is_as_unsure_as_what_they_took_over() {
        let robot = robot();
        let cuts = [cut(&driven(&robot, &[], 8.0), &cutting())];
        let mut problem = problem(&robot, &cuts);
        problem.constants_are_loose = true;
        let forms = problem.variants();
        let of = |id: &str| forms.iter().find(|v| v.spec().id == id).expect("in the catalogue");
        let mut theta = [0.0; NUISANCES];
        assert_eq!(mass_elsewhere(&problem, of("payload"), &theta), 0.0);
        let place = constant("motor_inertia");
        theta[place] = 4.0;
        let grown = robot.motor_inertia * ((4.0 * problem.sigma[place]).exp() - 1.0);
        let mass = 2.0 * grown / robot.wheel_radius.powi(2);
        approx::assert_relative_eq!(mass_elsewhere(&problem, of("payload"), &theta), mass, max_relative = 1e-9);
        assert_eq!(mass_elsewhere(&problem, of("torque_constant"), &theta), 0.0);
        theta[constant("mass")] = 2.0;
        let kg = robot.mass * ((2.0 * problem.sigma[constant("mass")]).exp() - 1.0);
        let both = mass.hypot(kg);
        approx::assert_relative_eq!(mass_elsewhere(&problem, of("payload"), &theta), both, max_relative = 1e-9);
        problem.constants_are_loose = false;
        assert_eq!(mass_elsewhere(&problem, of("payload"), &theta), 0.0, "references hold the constants");
    }

    #[test]
    fn a_fit_of_an_effect_that_is_a_constant_moves_as_that_constant_does() {
        let robot = robot();
        let cuts = [cut(&driven(&robot, &[], 8.0), &cutting())];
        let problem = problem(&robot, &cuts);
        let fit = |id: &str, effects: Vec<f64>| {
            let form = problem.variants().into_iter().find(|v| v.spec().id == id).expect("in the catalogue");
            let hypothesis = Hypothesis::single(form, Vec::new());
            let fitted = problem.begin(&hypothesis, Point { effects, ..problem.origin() }, None);
            Trial { hypothesis, fitted }
        };
        for (id, size) in [("viscous_friction", 0.02), ("payload", 0.5), ("torque_constant", -0.02)] {
            let trial = fit(id, vec![size]);
            let (place, usual, point) = as_constant(&problem, &trial).expect("a constant stands for it");
            let tunable = tunables::<f64>()[place];
            approx::assert_relative_eq!(usual, tunable.between_visits * problem.moves, epsilon = 1e-12);
            assert!(point.effects.is_empty());
            let moved = problem.begin(&Hypothesis::default(), point, None);
            let still = problem.begin(&Hypothesis::default(), problem.origin(), None);
            let [by_effect, by_constant] = [&trial.fitted, &moved].map(|f| problem.misfit(&f.response));
            let nothing = problem.misfit(&still.response);
            assert!(
                (by_effect - by_constant).abs() < 0.1 * (by_effect - nothing).abs(),
                "{id}: {by_effect} {by_constant}"
            );
        }
        assert!(as_constant(&problem, &fit("grade", vec![0.02, 0.0])).is_none());
    }

    #[test]
    fn grip_that_is_lost_at_a_place_is_adhesion_where_it_is_lost_everywhere() {
        let robot = robot();
        let cuts = [cut(&driven(&robot, &[], 8.0), &cutting())];
        let problem = problem(&robot, &cuts);
        let of = |id: &str, place: Place| {
            let is_it = |v: &Variant| v.spec().id == id && v.place == place;
            (problem.variants().into_iter().find(is_it).expect("in the catalogue"), Vec::new())
        };
        let parts = vec![of("grade", Place::Whole), of("adhesion_patch", Place::Disc)];
        let h = Hypothesis { parts, acting: None };
        let point = Point { effects: vec![0.01, 0.02, 0.25, 1.0, 0.5, 2.0], ..problem.origin() };
        let fitted = problem.begin(&h, point, None);
        let moved = everywhere(&problem, &Trial { hypothesis: h, fitted });
        let adhesion = constant("adhesion");
        let still = problem.origin();
        approx::assert_relative_eq!(
            (moved.theta[adhesion] - still.theta[adhesion]) * problem.sigma[adhesion],
            0.75_f64.ln(),
            epsilon = 1e-12
        );
        assert!((0..NUISANCES).all(|k| k == adhesion || moved.theta[k] == still.theta[k]) && moved.effects.is_empty());
    }

    #[test]
    fn each_part_of_a_hypothesis_can_be_a_constant() {
        let robot = robot();
        let cuts = [cut(&driven(&robot, &[], 8.0), &cutting())];
        let problem = problem(&robot, &cuts);
        let of = |id: &str| problem.variants().into_iter().find(|v| v.spec().id == id).expect("in the catalogue");
        let h = Hypothesis { parts: ["grade", "payload"].map(|id| (of(id), Vec::new())).to_vec(), acting: None };
        let point = Point { effects: vec![0.01, 0.02, 0.5], ..problem.origin() };
        let fitted = problem.begin(&h, point, None);
        let found = instead(&problem, &Trial { hypothesis: h, fitted });
        assert_eq!(found.iter().map(|(part, _)| *part).collect::<Vec<_>>(), [1]);
    }
}
