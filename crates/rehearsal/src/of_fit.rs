//! Rehearsals of robots whose constants are fitted to whole drives: by the equations of that fit, without simulating anything.
//!
//! About the fit a drive says `g = −Λ δ + ε` of the deviations `δ` of the constants, with its curvature `Λ` and noise `ε ~ N(0, Λ)`. A
//! replica draws `δ` (the robot within what its file states, what a drive has of its own, and what is hidden) and `ε`, and causes are
//! named from these equations as a diagnosis names them from its own.

use std::collections::BTreeSet;

use hierarchical_fit::{Hideable, Rehearsable, Session};
use nalgebra::{DMatrix, DVector};
use verdict::{Rehearsal, RehearsedDrives};

use crate::assemble::{Effect, Hidden, assembled};
use crate::error::RehearsalError;
use crate::plan::Plan;
use crate::random::{Purpose, Stream};
use crate::score::Scored;
use crate::settings::SETTINGS;
use crate::words;

/// What a replica is drawn from.
struct Drawn<'a> {
    of: &'a Rehearsable,
    seed: u64,
    references: usize,
    /// Of each drive a root of its curvature: noise of its slope is this times numbers of unit variance.
    roots: Vec<DMatrix<f64>>,
}

/// Which causes would be found with the drives of a fit, from which size on, and how often one would be alarmed for nothing. Of the plan
/// neither seconds nor recordings count: whole drives are taken, and all of them.
///
/// # Errors
/// A plan with which nothing can be rehearsed, and names that are no cause's.
pub fn rehearse_fit(of: &Rehearsable, plan: &Plan) -> Result<Rehearsal, RehearsalError> {
    let labels: Vec<String> = of.causes.iter().map(|c| c.cause.label()).collect();
    // All wheels by the name alone, or one of them.
    let names: BTreeSet<&str> =
        of.causes.iter().map(|c| c.cause.spec.id).chain(labels.iter().map(String::as_str)).collect();
    let plan = plan.checked(&Vec::from_iter(names))?;
    let references = plan.references.unwrap_or(of.references);
    let drawn = Drawn { of, seed: plan.seed, references, roots: roots(of) };
    let effects = of.causes.iter().filter(|c| plan.wants(c.cause.spec.id) || plan.wants(&c.cause.label()));
    let effects: Vec<Effect<&Hideable>> = effects
        .map(|hideable| Effect {
            of: hideable,
            id: hideable.cause.label(),
            name: hideable.cause.spec.name,
            interest: hideable.size(1.0),
            unit: hideable.told.unit,
            sizes: plan
                .sizes
                .iter()
                .filter(|m| hideable.signs(**m).contains(&true))
                .map(|m| (*m, hideable.size(*m)))
                .collect(),
        })
        .collect();
    let drives = RehearsedDrives {
        seed: plan.seed,
        replicas: plan.replicas,
        fault_free_replicas: plan.fault_free,
        references,
        recordings: of.drives.iter().map(|(name, seconds, _)| (name.clone(), *seconds)).collect(),
        noise: of.noise.clone(),
        wanted_share: SETTINGS.plan.wanted,
    };
    let answer =
        |replica: usize, hidden: Option<(&&Hideable, f64)>| drawn.answer(replica, hidden.map(|(h, m)| (*h, m)));
    let rehearsal = assembled(&plan, drives, &effects, &answer);
    Ok(Rehearsal { limits: words::limits_of_fit(&plan, references), ..rehearsal })
}

/// Roots of the curvature of each drive; of one that has none, no noise.
fn roots(of: &Rehearsable) -> Vec<DMatrix<f64>> {
    let n = of.stated.len();
    of.drives.iter().map(|(.., session)| session.root().unwrap_or_else(|| DMatrix::zeros(n, n))).collect()
}

impl Drawn<'_> {
    /// What is named of a replica.
    fn answer(&self, replica: usize, hidden: Hidden<'_, Hideable>) -> Scored {
        let of = self.of;
        let label = hidden.map(|(hideable, _)| hideable.cause.label());
        let within = |stream: &mut Stream| stream.normal_within(SETTINGS.constants.farthest);
        let robot = self.vector(Purpose::Constants, &[replica], &of.stated, within);
        let moved = self.vector(Purpose::Visit, &[replica], &of.between, within);

        let references: Vec<Session> = (0..self.references).map(|k| self.drive([replica, 1, k], &robot)).collect();
        let mut truth = robot;
        if !references.is_empty() {
            truth += moved;
        }
        if let Some(hidden) = hidden {
            truth += self.of_cause(replica, hidden);
        }
        let recordings: Vec<Session> = (0..of.drives.len()).map(|k| self.drive([replica, 0, k], &truth)).collect();

        let named = of.after_references(&references).and_then(|prior| of.named(&prior, &recordings));
        let Some(named) = named else {
            return Scored::failed("the equations of these drives have no solution".to_owned());
        };
        let labels: Vec<String> = of.causes.iter().map(|c| c.cause.label()).collect();
        let told: BTreeSet<&str> =
            named.chosen.iter().flat_map(|w| w.class.iter().map(|&c| labels[c].as_str())).collect();
        match named.chosen.first() {
            Some(first) => Scored::of_names(Some(&labels[first.cause]), told, label.as_deref()),
            None => Scored::nothing(),
        }
    }

    /// Equations of a drive, or of a reference on its inputs, of a robot with these deviations.
    fn drive(&self, path: [usize; 3], truth: &DVector<f64>) -> Session {
        let place = path[2] % self.of.drives.len();
        let (.., session) = &self.of.drives[place];
        let own = self.vector(Purpose::Drive, &path, &self.of.scatter, Stream::normal);
        let ones = DVector::from_element(truth.len(), 1.0);
        let noise = &self.roots[place] * self.vector(Purpose::Noise, &path, &ones, Stream::normal);
        let off = truth + own;
        let turned = &session.curvature * &off;
        let (slope, cost) = (noise - &turned, 0.5 * off.dot(&turned));
        Session { slope, cost, ..session.clone() }
    }

    /// What a cause of so many usual sizes does to the constants: its size along its first direction, whatever it usually has along the
    /// others.
    fn of_cause(&self, replica: usize, (hideable, multiple): (&Hideable, f64)) -> DVector<f64> {
        let mut stream = Stream::new(self.seed, Purpose::Direction, &[replica]);
        let cause = &hideable.cause;
        let mut out = DVector::zeros(self.of.stated.len());
        for (place, (direction, usual)) in cause.directions.iter().enumerate() {
            let drawn = stream.normal();
            let along = match hideable.signs(multiple) {
                _ if place > 0 => drawn,
                [true, true] => drawn.signum(),
                [is_larger, _] => {
                    if is_larger {
                        1.0
                    } else {
                        -1.0
                    }
                }
            };
            for &(k, weight) in direction {
                out[k] += multiple * usual * along * weight;
            }
        }
        out
    }

    fn vector(
        &self,
        purpose: Purpose,
        path: &[usize],
        sigmas: &DVector<f64>,
        draw: impl Fn(&mut Stream) -> f64,
    ) -> DVector<f64> {
        let mut stream = Stream::new(self.seed, purpose, path);
        sigmas.map(|sigma| sigma * draw(&mut stream))
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;
    use hierarchical_fit::{Cause, Told};
    use verdict::FoundFrom;

    use super::*;

    /// Three drives that show the first of two constants alone, and both of them together.
    fn rehearsable() -> Rehearsable {
        let session = |weights: [f64; 2], information: f64| {
            let along = DVector::from_row_slice(&weights);
            let mut out = Session::of_nothing(2);
            out.curvature.ger(information, &along, &along, 1.0);
            out
        };
        let cause = |spec, constant: usize, room: [f64; 2]| {
            let cause = Cause { spec, of: None, directions: vec![(vec![(constant, 1.0)], 0.1)], possible: None };
            let told = Told { value: 2.0, is_factor: constant == 0, unit: "m", room };
            Hideable::new(&cause, |_| told).expect("it moves a constant")
        };
        let wide = [f64::NEG_INFINITY, f64::INFINITY];
        Rehearsable {
            drives: vec![
                ("alone".to_owned(), 20.0, session([1.0, 0.0], 4e6)),
                ("both".to_owned(), 20.0, session([1.0, 1.0], 4e6)),
                ("again".to_owned(), 20.0, session([1.0, 1.0], 4e6)),
            ],
            references: 0,
            stated: DVector::from_element(2, 0.01),
            scatter: DVector::from_element(2, 1e-4),
            between: DVector::from_element(2, 1e-3),
            causes: vec![
                cause(&catalogue::odometry::STEERING_ZERO, 0, wide),
                cause(&catalogue::odometry::POSE_MOUNTING, 1, [-0.001, 1.0]),
            ],
            noise: Vec::new(),
        }
    }

    fn drawn(of: &Rehearsable) -> Drawn<'_> {
        Drawn { of, seed: 7, references: 0, roots: roots(of) }
    }

    #[test]
    fn large_causes_are_found_small_ones_are_not_and_nothing_is_found_where_nothing_is_hidden() {
        let told = rehearse_fit(&rehearsable(), &Plan::of_fit()).expect("a rehearsal");
        assert_eq!(told.fault_free.replicas, 200);
        assert!(told.fault_free.alarmed() < 6, "{:?}", told.fault_free);
        for effect in &told.effects {
            // Half a size of interest is five sigmas of what is stated.
            let [smallest, .., half, whole] = &effect.sizes[..] else { panic!("{effect:?}") };
            assert!(smallest.answers.found() < 20 && half.answers.found() > 30, "{effect:?}");
            assert!(whole.answers.first == 40 && effect.found != FoundFrom::Never, "{effect:?}");
        }
        let of = |id: &str| told.effects.iter().find(|e| e.effect == id).expect(id);
        assert_relative_eq!(of("steering_zero").sizes[3].size, 2.0 * 0.1_f64.exp_m1(), max_relative = 1e-12);
        assert_relative_eq!(of("pose_mounting").sizes[3].size, 0.1, max_relative = 1e-12);
    }

    #[test]
    fn references_let_smaller_causes_be_found_and_the_seed_alone_decides() {
        let with = |references: usize| {
            let plan = Plan { references: Some(references), sizes: vec![0.1], ..Plan::of_fit() };
            rehearse_fit(&rehearsable(), &plan).expect("a rehearsal")
        };
        // A tenth of the size of interest is one sigma of the robot file, and ten of what a robot moves after its references.
        let found = |told: &Rehearsal| told.effects.iter().map(|e| e.sizes[0].answers.first).sum::<usize>();
        let (none, three) = (with(0), with(3));
        assert!(found(&none) < 20 && found(&three) > 60, "{} {}", found(&none), found(&three));
        assert_eq!(with(3), three);
        assert!(none.limits.iter().any(|l| l.contains("no reference")));
    }

    #[test]
    fn a_drive_shows_what_its_robot_is_with_noise_as_large_as_its_information_says() {
        let of = rehearsable();
        let (drawn, truth) = (drawn(&of), DVector::from_row_slice(&[0.02, -0.01]));
        let curvature = &of.drives[1].2.curvature;
        let replicas = 4000;
        let (mut mean, mut square) = (DVector::zeros(2), DMatrix::zeros(2, 2));
        for replica in 0..replicas {
            // What differs from drive to drive scatters the slope too.
            let off = drawn.drive([replica, 0, 1], &truth).slope + curvature * &truth;
            square.ger(1.0 / replicas as f64, &off, &off, 1.0);
            mean += off / replicas as f64;
        }
        let own = 1e-8 * curvature * curvature;
        assert_relative_eq!(square, curvature + own, max_relative = 0.08);
        assert!(mean.norm() < 0.06 * curvature.trace().sqrt() * 3.0, "{mean}");
    }

    #[test]
    fn a_root_times_its_transpose_is_the_matrix_though_it_is_singular() {
        let session = &rehearsable().drives[1].2;
        let root = session.root().expect("eigenvalues");
        assert_relative_eq!(&root * root.transpose(), session.curvature.clone(), max_relative = 1e-9);
    }

    #[test]
    fn a_constant_that_cannot_be_smaller_is_made_larger_alone() {
        let of = rehearsable();
        let drawn = drawn(&of);
        let signs = |cause: usize| -> BTreeSet<i8> {
            let one = |replica| drawn.of_cause(replica, (&of.causes[cause], 1.0));
            (0..40).map(|replica| one(replica).sum().signum() as i8).collect()
        };
        assert_eq!((signs(0), signs(1)), (BTreeSet::from([-1, 1]), BTreeSet::from([1])));
    }

    #[test]
    fn names_that_are_no_causes_are_refused_and_what_cannot_be_hidden_is_told() {
        let mut of = rehearsable();
        let plan = Plan { effects: vec!["pose_mountin".to_owned()], ..Plan::of_fit() };
        let refused = rehearse_fit(&of, &plan).expect_err("no such cause").to_string();
        assert!(refused.contains("pose_mounting"), "{refused}");

        of.causes[1].told.room = [-0.001, 0.001];
        let plan = Plan { effects: vec!["pose_mounting".to_owned()], ..Plan::of_fit() };
        let told = rehearse_fit(&of, &plan).expect("a rehearsal");
        assert_eq!((told.effects.len(), told.left_out.len()), (0, 1));
    }
}
