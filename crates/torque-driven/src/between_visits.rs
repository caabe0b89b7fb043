//! How constants move from one visit to another: visits of their own in a fit, and what the references teach of it.

use faer::Mat;
use inference::DiagnosisError;
use inference::algebra::{inverse_spd, solve_spd};
use inference::least_squares::Normal;
use robot_model::tunable::{COUNT as NUISANCES, tunables};

use crate::calibrate::Calibration;
use crate::fit::{Columns, Fitted, Point, Problem};
use crate::settings::fit::{BetweenVisits, SETTINGS};
use crate::visit::VisitNumbers;
use crate::windows::Cut;

const BETWEEN: BetweenVisits = SETTINGS.between_visits;

/// A visit's deviations of the constants, in units of how far each is expected to move.
pub(crate) type Deviations = [f64; NUISANCES];

/// Where the constants of a visit are, seen from those of a fit, in the constants' sigmas.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct VisitMove {
    /// What is known of their move.
    pub(crate) offset: [f64; NUISANCES],
    /// One sigma of what is not; zero where they do not move further.
    pub(crate) sigma: [f64; NUISANCES],
}

impl VisitMove {
    const NONE: Self = Self { offset: [0.0; NUISANCES], sigma: [0.0; NUISANCES] };

    /// Of a visit of which nothing is known.
    fn unknown(factor: f64) -> Self {
        Self { sigma: usual_moves().map(|sigma| factor * sigma), ..Self::NONE }
    }

    /// Whether a fit finds more about it.
    fn is_free(&self) -> bool {
        self.sigma.iter().any(|sigma| *sigma > 0.0)
    }
}

/// How far each constant usually moves between visits, one standard deviation in its sigma.
pub(crate) fn usual_moves() -> [f64; NUISANCES] {
    tunables::<f64>().map(|t| t.between_visits)
}

/// Constants of a visit that references are of.
#[derive(Debug, Clone)]
pub(crate) struct VisitConstants {
    pub(crate) theta: [f64; NUISANCES],
    /// Information about them.
    pub(crate) information: Mat<f64>,
}

/// What is known of moves between visits.
#[derive(Debug, Clone)]
pub(crate) struct Moves {
    /// By how much constants move between visits, in what is usual.
    pub(crate) factor: f64,
    /// Whether references of several visits taught that factor.
    pub(crate) taught: bool,
    /// Constants of each visit of the references; none where they are of one.
    pub(crate) known: Vec<VisitConstants>,
    /// By number of the visit, where its constants are; beyond the last they are where those of the fit are.
    pub(crate) visits: Vec<VisitMove>,
    /// The factor for the recordings that are diagnosed: zero where references of their visits teach their constants.
    pub(crate) of_recordings: f64,
    /// Their visits that may have moved each by itself: two or more, or one beside visits of the references.
    pub(crate) apart: Vec<usize>,
    /// Whether a fit of them takes constants to have moved.
    pub(crate) are_loose: bool,
}

impl Default for Moves {
    /// As far as is usual.
    fn default() -> Self {
        Self {
            factor: 1.0,
            taught: false,
            known: Vec::new(),
            visits: Vec::new(),
            of_recordings: 1.0,
            apart: Vec::new(),
            are_loose: false,
        }
    }
}

impl Moves {
    /// Whether there were moves that a mismatch may come from: since the references, or between visits of the recordings.
    /// How far a robot is from its file is in every fit without references.
    pub(crate) fn may_have_been(&self, since_references: bool) -> bool {
        self.of_recordings > 0.0 && (since_references || !self.apart.is_empty())
    }
}

impl Calibration {
    /// The same for recordings of these visits: where the references teach their constants, these are taken, and nothing is
    /// taken to have moved since.
    pub(crate) fn for_visits(mut self, numbers: &VisitNumbers) -> Self {
        let (new_ones, shared) = (numbers.new_ones(), numbers.shared());
        if new_ones.is_empty() && !self.moves.known.is_empty() {
            self.take_constants_of(&shared);
        }
        let centre = self.theta;
        let offset = |of: &VisitConstants| std::array::from_fn(|k| of.theta[k] - centre[k]);
        let moves = &mut self.moves;
        moves.apart = Vec::new();
        moves.visits = moves.known.iter().map(|of| VisitMove { offset: offset(of), ..VisitMove::NONE }).collect();
        moves.of_recordings = if new_ones.is_empty() { 0.0 } else { moves.factor };
        if new_ones.len() + shared.len() > 1 && !new_ones.is_empty() {
            // A fit with these visits and one without take the same points.
            let most = new_ones.iter().max().map_or(0, |last| last + 1);
            moves.visits.resize(most.max(moves.visits.len()), VisitMove::NONE);
            moves.apart = new_ones;
        }
        self
    }

    /// Takes the constants of visits of the references, of several their mean and what is known of one of them.
    fn take_constants_of(&mut self, visits: &[usize]) {
        let of: Vec<&VisitConstants> = visits.iter().filter_map(|&v| self.moves.known.get(v)).collect();
        let covariances: Vec<Mat<f64>> = of.iter().filter_map(|v| inverse_spd(&v.information)).collect();
        if covariances.is_empty() || covariances.len() < of.len() {
            return;
        }
        let share = 1.0 / of.len() as f64;
        let theta = std::array::from_fn(|k| of.iter().map(|v| share * v.theta[k]).sum());
        let mean = Mat::from_fn(NUISANCES, NUISANCES, |i, j| covariances.iter().map(|c| share * c[(i, j)]).sum());
        if let Some(information) = inverse_spd(&mean) {
            (self.theta, self.information) = (theta, information);
        }
    }

    /// The same where constants may have moved since the references.
    pub(crate) fn on_another_visit(mut self) -> Self {
        let factor = self.moves.of_recordings;
        self.moves.are_loose = true;
        if !self.moves.apart.is_empty() {
            let Moves { visits, apart, .. } = &mut self.moves;
            for &visit in apart.iter() {
                visits[visit] = VisitMove::unknown(factor);
            }
        } else if let Some(mut covariance) = inverse_spd(&self.information) {
            let moves = usual_moves().map(|sigma| (factor * sigma).powi(2));
            (0..NUISANCES).for_each(|k| covariance[(k, k)] += moves[k]);
            self.information = inverse_spd(&covariance).unwrap_or(self.information);
        }
        self
    }
}

/// A visit of its own for each of the references' visits, where there are several; as far apart as is usual.
pub(crate) fn visits_of_references(cuts: &[Cut]) -> Vec<VisitMove> {
    let visits = cuts.iter().filter_map(|cut| cut.visit).max().map_or(0, |last| last + 1);
    if visits > 1 { vec![VisitMove::unknown(1.0); visits] } else { Vec::new() }
}

impl Problem<'_> {
    /// Adds to the constants of a run what its visit moved them by.
    pub(crate) fn move_to_visit(&self, theta: &mut [f64; NUISANCES], point: &Point, run: usize) {
        let Some(visit) = self.cuts[run].visit else { return };
        let Some((moved, deviations)) = self.visits.get(visit).zip(point.visits.get(visit)) else { return };
        for (k, x) in theta.iter_mut().enumerate() {
            *x += moved.offset[k] + moved.sigma[k] * deviations[k];
        }
    }

    /// Visits whose constants a fit finds, with the runs of each.
    pub(crate) fn free_visits(&self) -> Vec<(usize, Vec<usize>)> {
        let free = self.visits.iter().enumerate().filter(|(_, visit)| visit.is_free());
        let runs = |v: usize| (0..self.cuts.len()).filter(|&r| self.cuts[r].visit == Some(v)).collect::<Vec<_>>();
        free.map(|(v, _)| (v, runs(v))).filter(|(_, runs)| !runs.is_empty()).collect()
    }

    /// Equations of the runs of a visit without the visit's own deviations: they move the constants of these runs alone.
    pub(crate) fn without_visit(&self, point: &Point, of_runs: Normal, visit: usize) -> Option<Normal> {
        let (sigma, n) = (&self.visits[visit].sigma, of_runs.matrix.nrows());
        let own = Mat::from_fn(NUISANCES, NUISANCES, |i, j| {
            sigma[i] * of_runs.matrix[(i, j)] * sigma[j] + if i == j { 1.0 } else { 0.0 }
        });
        let right = Mat::from_fn(NUISANCES, n + 1, |i, j| {
            if j < n {
                sigma[i] * of_runs.matrix[(i, j)]
            } else {
                sigma[i] * of_runs.gradient[(i, 0)] - point.visits[visit][i]
            }
        });
        of_runs.reduced(&own, &right)
    }
}

/// The common factor of the moves between the references' visits by marginal likelihood of the linearised model, and the
/// point with the same constants in its unit.
///
/// As the factor of the deviations between runs, but linearised where the fit stands: visits may be far apart.
pub(crate) fn likeliest_factor(problem: &mut Problem<'_>, at: &Fitted) -> Result<(f64, Point), DiagnosisError> {
    let mut best: Option<(f64, f64, Point)> = None;
    for factor in BETWEEN.factors {
        problem.visits.iter_mut().for_each(|visit| *visit = VisitMove::unknown(factor));
        let mut point = at.point.clone();
        point.visits.iter_mut().flatten().for_each(|deviation| *deviation /= factor);

        let Some(mut normal) = problem.normal(&point, &at.response, &at.columns, &Columns(Vec::new())) else {
            continue;
        };
        problem.with_prior(&point, &mut normal);
        let Some((x, logdet)) = solve_spd(&normal.matrix, &normal.gradient) else { continue };
        let gain: f64 = (0..NUISANCES).map(|i| 0.5 * x[(i, 0)] * normal.gradient[(i, 0)]).sum();
        let moved: f64 = point.visits.iter().flatten().map(|deviation| 0.5 * deviation * deviation).sum();
        let prior = -0.5 * (factor.ln() / BETWEEN.factor_width).powi(2);
        let value = normal.gain + gain - moved - 0.5 * (normal.log_determinant + logdet) + prior;
        if best.as_ref().is_none_or(|(most, ..)| value > *most) {
            best = Some((value, factor, point));
        }
    }
    let (_, factor, point) = best.ok_or(DiagnosisError::Singular { stage: "calibration" })?;
    problem.visits.iter_mut().for_each(|visit| *visit = VisitMove::unknown(factor));
    Ok((factor, point))
}

/// Constants of each visit of the references: from its own drives, and from the others' as far as visits differ.
///
/// `information`: about the constants that the visits scatter about, of all drives and of what was known before.
pub(crate) fn constants_of_visits(
    problem: &Problem<'_>,
    at: &Fitted,
    information: &Mat<f64>,
) -> Result<Vec<VisitConstants>, DiagnosisError> {
    let of_visit = |(visit, runs): (usize, Vec<usize>)| {
        let of_runs = problem.normal_of_runs(&at.point, &at.response, &at.columns, &runs)?;
        let own = of_runs.matrix.clone();
        let others = information - &problem.without_visit(&at.point, of_runs, visit)?.matrix;
        let mut elsewhere = inverse_spd(&others)?;
        let VisitMove { sigma, .. } = &problem.visits[visit];
        (0..NUISANCES).for_each(|k| elsewhere[(k, k)] += sigma[k].powi(2));
        let theta = std::array::from_fn(|k| at.point.theta[k] + sigma[k] * at.point.visits[visit][k]);
        Some(VisitConstants { theta, information: own + inverse_spd(&elsewhere)? })
    };
    let all: Option<Vec<VisitConstants>> = problem.free_visits().into_iter().map(of_visit).collect();
    all.ok_or(DiagnosisError::Singular { stage: "calibration" })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::calibrate::calibrate;
    use crate::fit::Hypothesis;
    use crate::run_numbers::constant;
    use crate::settings::fit;
    use crate::testing::{cutting, driven, problem};
    use crate::visit::{KnownBy, Visit};
    use crate::windows::cut;
    use inference::Options;
    use robot_model::tunable::{tuned, usual_sigma};
    use testing::robot;

    /// The robot's constants so many usual moves away.
    fn moved(moves: f64) -> [f64; NUISANCES] {
        let mut theta = [0.0; NUISANCES];
        for id in ["adhesion", "rolling_resistance", "coulomb_left", "coulomb_right", "viscous", "torque_constant"] {
            theta[constant(id)] = moves * usual_moves()[constant(id)];
        }
        theta
    }

    /// Two drives of a visit on which the constants were so many usual moves away.
    fn drives(visit: usize, moves: f64) -> Vec<Cut> {
        let there = tuned(&robot(), &usual_sigma(), &moved(moves));
        let drive = |seconds: f64| Cut { visit: Some(visit), ..cut(&driven(&there, &[], seconds), &cutting()) };
        vec![drive(16.0), drive(20.0)]
    }

    /// What references of two visits teach that lie so many usual moves apart.
    fn taught(apart: f64) -> Calibration {
        let cuts = [drives(0, -0.5 * apart), drives(1, 0.5 * apart)].concat();
        calibrate(&robot(), &usual_sigma(), &cuts, 5.0, &Options::default()).expect("determined")
    }

    /// The numbers of visits that references and recordings are of.
    fn numbers(references: &[&str], recordings: &[&str]) -> VisitNumbers {
        let of = |names: &[&str]| -> Vec<Option<Visit>> {
            names.iter().map(|n| Some(Visit { name: (*n).to_owned(), known_by: KnownBy::User })).collect()
        };
        VisitNumbers::new(&of(references), &of(recordings))
    }

    #[test]
    fn visits_far_apart_teach_a_larger_factor_than_visits_that_are_alike() {
        let (alike, far) = (taught(0.0).moves, taught(5.0).moves);
        assert!(alike.taught && far.taught);
        assert!(alike.factor < 1.0 && far.factor > 1.0, "alike {}, far {}", alike.factor, far.factor);

        let one = calibrate(&robot(), &usual_sigma(), &drives(0, 0.0), 5.0, &Options::default()).expect("determined");
        assert!(!one.moves.taught && one.moves.known.is_empty());
        assert_eq!(one.moves.factor.to_bits(), 1.0_f64.to_bits(), "one visit teaches nothing of others");
    }

    #[test]
    fn each_visit_has_the_constants_of_its_own_drives() {
        let apart = taught(4.0);
        let drag = constant("rolling_resistance");
        let of = |visit: usize| apart.moves.known[visit].theta[drag];
        // Rolling resistance and dry friction are told apart by little; what both take is certain.
        let taken = |theta: &[f64; NUISANCES]| {
            let r = tuned(&robot(), &usual_sigma(), theta);
            r.rolling_resistance * r.mass * r.gravity * r.wheel_radius + r.coulomb[0] + r.coulomb[1]
        };
        for (visit, moves) in [(0, -2.0), (1, 2.0)] {
            let found = taken(&apart.moves.known[visit].theta);
            approx::assert_relative_eq!(found, taken(&moved(moves)), max_relative = 0.08);
        }

        // Recordings of the second visit are compared with its constants, which have not moved since.
        let second = apart.clone().for_visits(&numbers(&["a", "b"], &["b"]));
        assert_eq!((second.theta[drag].to_bits(), second.moves.of_recordings), (of(1).to_bits(), 0.0));
        assert!(!second.moves.may_have_been(true));
        // Those of both, with each visit's own.
        let both = apart.clone().for_visits(&numbers(&["a", "b"], &["b", "a"]));
        for visit in [0, 1] {
            approx::assert_relative_eq!(
                both.theta[drag] + both.moves.visits[visit].offset[drag],
                of(visit),
                epsilon = 1e-9
            );
        }
        // Those of a third, with what lies between, and as far away as the two are from each other.
        let third = apart.clone().for_visits(&numbers(&["a", "b"], &["c"]));
        assert_eq!(
            (third.theta[drag].to_bits(), third.moves.of_recordings),
            (apart.theta[drag].to_bits(), apart.moves.factor)
        );
        let sigma = |c: &Calibration| inverse_spd(&c.information).expect("positive definite")[(drag, drag)].sqrt();
        let wider = third.clone().on_another_visit();
        approx::assert_relative_eq!(
            sigma(&wider),
            sigma(&third).hypot(apart.moves.factor * usual_moves()[drag]),
            max_relative = 1e-6
        );
    }

    #[test]
    fn several_new_visits_may_each_have_moved_by_itself() {
        let calibration = Calibration::by_file().for_visits(&numbers(&[], &["a", "b", "a"]));
        assert!(calibration.moves.may_have_been(false) && calibration.moves.visits.iter().all(|v| !v.is_free()));
        let moved = calibration.on_another_visit().moves;
        assert_eq!(moved.visits.iter().map(VisitMove::is_free).collect::<Vec<_>>(), [true, true]);

        let one = Calibration::by_file().for_visits(&numbers(&[], &["a", "a"])).moves;
        assert!(!one.may_have_been(false), "how far a robot is from its file is in the fit");
        // Beside a visit of the references only the new one may have moved.
        let beside = Calibration::by_file().for_visits(&numbers(&["a"], &["a", "b"])).on_another_visit().moves;
        assert_eq!(beside.visits.iter().map(VisitMove::is_free).collect::<Vec<_>>(), [false, true]);
    }

    #[test]
    fn a_fit_of_visits_ends_where_no_deviation_makes_it_cheaper() {
        let robot = robot();
        let cuts = [drives(0, -1.0), drives(1, 1.0)].concat();
        let p = Problem { visits: visits_of_references(&cuts), ..problem(&robot, &cuts) };
        let none = Hypothesis::default();
        let fitted = p.refine(&none, p.begin(&none, p.origin(), None), 12, Some(3));
        let together = Problem { visits: Vec::new(), ..p.clone() };
        let pooled = together.refine(&none, together.begin(&none, together.origin(), None), 12, Some(3));
        assert!(fitted.cost < 0.5 * pooled.cost, "visits {}, pooled {}", fitted.cost, pooled.cost);

        for (visit, k) in (0..2).flat_map(|visit| (0..NUISANCES).map(move |k| (visit, k))) {
            for step in [-0.3, 0.3] {
                let mut point = fitted.point.clone();
                point.visits[visit][k] += step;
                let cost = p.cost(&point, &p.response(&point, &none));
                assert!(
                    cost > fitted.cost - fit::SETTINGS.fit.least_gain,
                    "visit {visit}, constant {k}: {cost} from {}",
                    fitted.cost
                );
            }
        }
    }
}
