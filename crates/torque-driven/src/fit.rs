//! Gauss–Newton in free run: nuisance parameters, run-to-run deviations and the strengths and shapes of effects.

use std::cell::Cell;
use std::ops::Range;
use std::sync::Arc;

use faer::Mat;
use inference::algebra::half_quadratic;
use inference::least_squares::{self, Normal, Parameter, Settings, Step, minimise, saturated, saturation};
use rayon::prelude::*;
use robot_model::tunable::{COUNT as NUISANCES, tunables, tuned};
use robot_model::{Chassis, Robot};
use sim::rollout::Grid;

use crate::between_visits::{Deviations, VisitMove};
use crate::channel::{Channel, Channels};
use crate::drives::Drives;
pub(crate) use crate::hypothesis::Hypothesis;
use crate::run_numbers::{RunNumber, RunNumbers, UNKNOWN};
use crate::settings::fit::{Fit, SETTINGS};
use crate::simulate::{Body, Response, RunResponse, free_run};
use crate::unnamed::Acting;
use crate::windows::Cut;
use inference::KnownEffects;
use inference::hypothesis::{Dose, Sizes};
use inference::hypothesis::{Free, Place, Variant, variants_of};
use verdict::Correction;

/// Cost of a response that is not finite.
const HOPELESS: f64 = 1e300;
const FIT: Fit = SETTINGS.fit;

/// Everything a fit compares with and is bound by.
#[derive(Clone)]
pub(crate) struct Problem<'a> {
    pub(crate) robot: &'a Robot<f64>,
    /// One sigma of each tunable.
    pub(crate) sigma: [f64; NUISANCES],
    pub(crate) cuts: &'a [Cut],
    /// Whether drives in which the simulation was right taught constants and noise; otherwise the robot file did.
    pub(crate) has_references: bool,
    /// Whether constants are as unsure as they are before a drive of that visit: an effect may then hide in one.
    pub(crate) constants_are_loose: bool,
    /// Mean squared residual of each channel on the references.
    pub(crate) variance: Channels<f64>,
    /// Expected q/D of each segment's regime.
    pub(crate) regime: Vec<Vec<f64>>,
    /// Information about θ: `½ (θ − centre)ᵀ H (θ − centre)`.
    pub(crate) information: Mat<f64>,
    pub(crate) centre: [f64; NUISANCES],
    /// Common factor of the run-to-run deviations.
    pub(crate) spread: f64,
    /// Where the constants of each visit are, by its number.
    pub(crate) visits: Vec<VisitMove>,
    /// How far constants may have moved since the references, in what is usual between visits; zero within a visit.
    pub(crate) moves: f64,
    /// Share of the log-likelihood that counts, for correlation within a segment.
    pub(crate) likelihood_power: f64,
    /// Saturation of outliers.
    pub(crate) outlier_scale: f64,
    /// Integration step, s.
    pub(crate) step: f64,
    /// Largest torque commanded, N m.
    pub(crate) largest_torque: f64,
    /// Whether nobody changed the robot: what needs a hand on it is not weighed.
    pub(crate) same_robot: bool,
    /// The effects that are weighed: the catalogue's, and those of one's own.
    pub(crate) known: KnownEffects,
    /// An effect that is weighed as little as if the catalogue did not hold it.
    pub(crate) without: Option<&'static str>,
    pub(crate) drives: Drives,
}

impl Problem<'_> {
    /// What the usual sizes of effects are in proportion to.
    pub(crate) fn sizes(&self) -> Sizes {
        Sizes { largest_torque: self.largest_torque, robot: Some(*self.robot) }
    }
}

/// Whether a constant that moved by so many of its sigmas is as far as a fit may take it.
pub(crate) fn is_at_a_stop(sigmas: f64) -> bool {
    sigmas.abs() >= FIT.farthest
}

/// Where a fit stands.
#[derive(Clone)]
pub(crate) struct Point {
    pub(crate) theta: [f64; NUISANCES],
    /// What each run has to itself.
    pub(crate) run: Vec<RunNumbers>,
    /// What each visit has to itself.
    pub(crate) visits: Vec<Deviations>,
    pub(crate) effects: Vec<f64>,
}

/// Columns of a Jacobian, one response each.
pub(crate) struct Columns(pub(crate) Vec<Response>);

impl Problem<'_> {
    pub(crate) fn origin(&self) -> Point {
        let visits = vec![[0.0; NUISANCES]; self.visits.len()];
        Point { theta: self.centre, run: vec![UNKNOWN; self.cuts.len()], visits, effects: Vec::new() }
    }

    /// A hypothesis at a point, for files.
    pub(crate) fn correction(&self, h: &Hypothesis, theta: &[f64; NUISANCES], effects: &[f64]) -> Correction {
        let tunings = tunables::<f64>().into_iter().zip(self.sigma).zip(theta);
        let tuning = tunings.map(|((t, sigma), x)| (t.id.to_owned(), sigma * x)).collect();
        let names: Vec<&str> = self.cuts.iter().map(|c| c.name.as_str()).collect();
        let mut at = 0;
        let effects = h.parts.iter().map(|(variant, onsets)| {
            let n = variant.count();
            at += n;
            variant.at(&effects[at - n..at], onsets, &names)
        });
        let has_four_motors = self.robot.chassis == Chassis::FourMotors;
        Correction { tuning, has_four_motors, effects: effects.collect(), response: None }
    }

    /// Every form of every effect that these recordings may show in the motion.
    pub(crate) fn variants(&self) -> Vec<Variant> {
        // A forward velocity comes from a pose only.
        let segments = || self.cuts.iter().flat_map(|c| &c.segments);
        let pose = segments().any(|s| s.shows(Channel::ForwardVelocity));
        let mut all = variants_of(self.known, self.robot.chassis, pose);
        all.retain(|v| self.without != Some(v.spec().id));
        // Two of them explain what has no name, where only the robot file says what is usual; one is looked for in `later_side`.
        all.retain(|v| self.has_references || !matches!(v.place, Place::OnsetOfSide(_)));
        all.retain(|v| !self.same_robot || !catalogue::needs_a_hand(v.spec().id));
        all
    }

    /// Standard deviation of a number that runs have to themselves, in sigmas of θ or in the unit of its channel.
    pub(crate) fn run_scale(&self, number: RunNumber) -> f64 {
        match number {
            RunNumber::Constant { place, sigma } => sigma * self.spread / self.sigma[place],
            RunNumber::Offset { sigma, .. } => sigma,
        }
    }

    fn robot_of(&self, point: &Point, run: usize) -> Robot<f64> {
        let mut theta = point.theta;
        self.move_to_visit(&mut theta, point, run);
        for (number, value) in RunNumber::ALL.into_iter().zip(point.run[run]) {
            if let RunNumber::Constant { place, .. } = number {
                theta[place] += value * self.run_scale(number);
            }
        }
        tuned(self.robot, &self.sigma, &theta)
    }

    /// Response of the recordings `runs`.
    fn free(&self, lane: &Lane<'_>, runs: Range<usize>) -> Response {
        let body = |run| {
            let (robot, cut) = (self.robot_of(&lane.point, run), &self.cuts[run]);
            let doses = cut.with_given((lane.doses)(run));
            let torque = self.drives.delivered(run, cut, &robot, &doses, Grid::nearest(cut.period, self.step));
            Body { robot, doses, acting: lane.acting.clone(), torque }
        };
        let bodies: Vec<Body> = runs.clone().map(body).collect();
        let mut out = free_run(&self.cuts[runs.clone()], &bodies, runs.start, lane.part, self.step);
        for (y, own) in out.iter_mut().zip(&lane.point.run[runs]) {
            for (number, value) in RunNumber::ALL.into_iter().zip(own) {
                if let RunNumber::Offset { channel, sigma } = number {
                    y.iter_mut().flatten().for_each(|window| window[channel] += value * sigma);
                }
            }
        }
        out
    }

    /// Response at several points and doses at once.
    pub(crate) fn lanes(&self, lanes: &[Lane<'_>]) -> Vec<Response> {
        lanes.par_iter().map(|l| self.free(l, 0..self.cuts.len())).collect()
    }

    pub(crate) fn response(&self, point: &Point, h: &Hypothesis) -> Response {
        let doses = |run: usize| h.doses(&point.effects, run);
        let acting = h.acting_at(&point.effects);
        self.free(&Lane { point: point.clone(), doses: &doses, part: None, acting }, 0..self.cuts.len())
    }

    /// Response of one recording.
    pub(crate) fn run_response(&self, run: usize, point: &Point, h: &Hypothesis) -> RunResponse {
        let doses = |run: usize| h.doses(&point.effects, run);
        let acting = h.acting_at(&point.effects);
        self.free(&Lane { point: point.clone(), doses: &doses, part: None, acting }, run..run + 1).remove(0)
    }

    /// Response and columns of θ by finite steps.
    pub(crate) fn nuisance_columns(&self, point: &Point, h: &Hypothesis, base: &Response) -> Columns {
        let doses = |run: usize| h.doses(&point.effects, run);
        let lanes: Vec<Lane<'_>> = (0..NUISANCES)
            .map(|k| {
                let mut p = point.clone();
                p.theta[k] += FIT.constant_step;
                Lane { point: p, doses: &doses, part: None, acting: h.acting_at(&point.effects) }
            })
            .collect();
        let out = self.lanes(&lanes);
        Columns(out.into_iter().map(|y| difference(&y, base, 1.0 / FIT.constant_step)).collect())
    }

    /// Columns of the effects' free values, per unit, by finite steps.
    pub(crate) fn effect_columns(&self, point: &Point, h: &Hypothesis, base: &Response) -> Columns {
        let free = h.free(&self.sizes());
        let shifted: Vec<(Point, f64)> = free
            .iter()
            .enumerate()
            .map(|(i, f)| {
                let mut p = point.clone();
                let size = (FIT.effect_step * f.unit).max(FIT.least_effect_step * p.effects[i].abs());
                // Step towards the inside of the bounds.
                let d = if p.effects[i] + size > f.bounds[1] { -size } else { size };
                p.effects[i] += d;
                (p, d)
            })
            .collect();
        let doses: Vec<_> = shifted.iter().map(|(p, _)| move |run: usize| h.doses(&p.effects, run)).collect();
        let lanes: Vec<Lane<'_>> = shifted
            .iter()
            .zip(&doses)
            .map(|((p, _), d)| Lane { point: p.clone(), doses: d, part: None, acting: h.acting_at(&p.effects) })
            .collect();
        let out = self.lanes(&lanes);
        Columns(out.iter().zip(&shifted).zip(&free).map(|((y, (_, d)), f)| difference(y, base, f.unit / d)).collect())
    }

    /// Weighted square of a segment's residual, `Σ r²/R`, for its predicted windows.
    pub(crate) fn q(&self, run: usize, segment: usize, predicted: &[Channels<f64>]) -> f64 {
        let s = &self.cuts[run].segments[segment];
        let mut q = 0.0;
        for ((o, p), valid) in s.observed.iter().zip(predicted).zip(&s.valid) {
            for c in Channel::ALL {
                if valid[c] {
                    q += (o[c] - p[c]).powi(2) / self.variance[c];
                }
            }
        }
        q
    }

    /// Tempered, saturated cost of a segment, nats.
    pub(crate) fn segment_cost(&self, run: usize, segment: usize, q: f64) -> f64 {
        self.likelihood_power
            * saturated(q / self.regime[run][segment], self.cuts[run].segments[segment].count, self.outlier_scale)
    }

    /// Cost of a response, without priors.
    pub(crate) fn misfit(&self, response: &Response) -> f64 {
        (0..self.cuts.len()).map(|r| self.misfit_of_run(r, &response[r])).sum()
    }

    /// Cost of one recording's response; huge if it is not finite.
    pub(crate) fn misfit_of_run(&self, run: usize, response: &[Vec<Channels<f64>>]) -> f64 {
        let cost = |(s, y): (usize, &Vec<Channels<f64>>)| self.segment_cost(run, s, self.q(run, s, y));
        let f: f64 = response.iter().enumerate().map(cost).sum();
        if f.is_finite() { f } else { HOPELESS }
    }

    /// Cost of a point by what is known of the constants and of what runs have to themselves.
    pub(crate) fn prior(&self, point: &Point) -> f64 {
        let off: Vec<f64> = point.theta.iter().zip(&self.centre).map(|(a, b)| a - b).collect();
        let own = point.run.iter().flatten().chain(point.visits.iter().flatten());
        half_quadratic(&self.information, &off) + own.map(|u| 0.5 * u * u).sum::<f64>()
    }

    pub(crate) fn cost(&self, point: &Point, response: &Response) -> f64 {
        self.misfit(response) + self.prior(point)
    }

    pub(crate) fn weight(&self, run: usize, segment: usize, q: f64) -> f64 {
        let regime = self.regime[run][segment];
        self.likelihood_power / regime
            * saturation(q / regime, self.cuts[run].segments[segment].count, self.outlier_scale)
    }

    /// Gauss–Newton from `start`: at most `steps`, or a multiple of these without references, each damped only where it must be
    /// until the cost falls.
    ///
    /// The columns of θ are those given; they are renewed before step `renew` if that is reached. Where constants are loose
    /// they move so far that columns are renewed before every later step, and damping is kept from step to step
    /// (Marquardt 1963): fits with old columns stop half-way, where an effect is too small and constants make up for it.
    pub(crate) fn refine(&self, h: &Hypothesis, start: Fitted, steps: usize, renew: Option<usize>) -> Fitted {
        let settings = Settings {
            iterations: steps * self.patience(),
            least_fall: FIT.least_gain,
            least_relative_fall: 0.0,
            least_move: 0.0,
            ..self.damping()
        };
        let (free, renewed_at) = (h.free(&self.sizes()), Cell::new(None));
        let fit = FreeRunFit { problem: self, hypothesis: h, free, renew, renewed_at };
        minimise(&fit, start, &settings).at
    }

    /// Factor of the steps of every fit: from the robot file alone constants have farther to go than from references.
    fn patience(&self) -> usize {
        if self.constants_are_loose && !self.has_references { FIT.patience_by_file } else { 1 }
    }

    fn damping(&self) -> Settings {
        let undamped = Settings::gauss_newton();
        if !self.constants_are_loose {
            return undamped;
        }
        let Settings { lower, least_damping, .. } = Settings::default();
        Settings { first_damping: FIT.first_damping, lower, least_damping, ..undamped }
    }

    /// A fit's first point with its response and columns.
    pub(crate) fn begin(&self, h: &Hypothesis, point: Point, columns: Option<Arc<Columns>>) -> Fitted {
        let response = self.response(&point, h);
        let cost = self.cost(&point, &response);
        let columns = columns.unwrap_or_else(|| Arc::new(self.nuisance_columns(&point, h, &response)));
        Fitted { point, response, cost, columns }
    }
}

/// One lane of a simulation: a point, doses for each run, and optionally only one part of each segment.
pub(crate) struct Lane<'a> {
    pub(crate) point: Point,
    pub(crate) doses: &'a (dyn Fn(usize) -> Vec<Dose> + Sync),
    pub(crate) part: Option<usize>,
    /// What acts beside the doses.
    pub(crate) acting: Option<Acting>,
}

/// Where a fit has come to.
#[derive(Clone)]
pub(crate) struct Fitted {
    pub(crate) point: Point,
    pub(crate) response: Response,
    pub(crate) cost: f64,
    pub(crate) columns: Arc<Columns>,
}

/// A fit of the constants and of a hypothesis in free run.
struct FreeRunFit<'a> {
    problem: &'a Problem<'a>,
    hypothesis: &'a Hypothesis,
    free: Vec<Free>,
    /// Before which step the columns of θ are renewed, at the latest.
    renew: Option<usize>,
    /// Constants at which this fit renewed them last.
    renewed_at: Cell<Option<[f64; NUISANCES]>>,
}

impl FreeRunFit<'_> {
    /// Whether the columns of θ are those of a place that is no longer near.
    fn are_old(&self, point: &Point) -> bool {
        let has_moved = |from: [f64; NUISANCES]| {
            from.iter().zip(&point.theta).any(|(from, to)| (to - from).abs() > FIT.same_columns)
        };
        self.problem.constants_are_loose && self.renewed_at.get().is_none_or(has_moved)
    }
}

impl least_squares::Problem for FreeRunFit<'_> {
    type Point = Fitted;

    fn cost(&self, at: &Fitted) -> f64 {
        at.cost
    }

    fn parameters(&self, at: &Fitted) -> Vec<Parameter> {
        Problem::parameters(&at.point, &self.free)
    }

    fn linearise(&self, at: &mut Fitted, iteration: usize) -> Option<Normal> {
        let p = self.problem;
        if self.renew == Some(iteration) || (iteration > 0 && self.are_old(&at.point)) {
            self.renewed_at.set(Some(at.point.theta));
            at.columns = Arc::new(p.nuisance_columns(&at.point, self.hypothesis, &at.response));
        }
        let effects = p.effect_columns(&at.point, self.hypothesis, &at.response);
        let mut normal = p.normal(&at.point, &at.response, &at.columns, &effects)?;
        p.with_prior(&at.point, &mut normal);
        Some(normal)
    }

    fn moved(&self, from: &Fitted, step: &Step<'_>) -> Option<Fitted> {
        let point = self.problem.advanced(&from.point, step);
        Some(self.problem.begin(self.hypothesis, point, Some(from.columns.clone())))
    }
}

/// `(y − base)·factor`, number by number.
pub(crate) fn difference(y: &Response, base: &Response, factor: f64) -> Response {
    let windows = |y: &[Channels<f64>], base: &[Channels<f64>]| -> Vec<Channels<f64>> {
        y.iter().zip(base).map(|(y, base)| Channels::from_fn(|c| (y[c] - base[c]) * factor)).collect()
    };
    let segments = |(y, base): (&RunResponse, &RunResponse)| y.iter().zip(base).map(|(y, b)| windows(y, b)).collect();
    y.iter().zip(base).map(segments).collect()
}
