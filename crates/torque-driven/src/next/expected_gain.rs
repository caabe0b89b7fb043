//! What a drive would show: for every rival as the truth, how far each other falls behind when it may re-tune itself.

use faer::Mat;
use inference::algebra::half_quadratic;
use inference::expected_information::Forecast;
use inference::least_squares::{Normal, Step};
use robot_model::Robot;
use robot_model::tunable::COUNT as NUISANCES;

use super::follow::{Follower, observe, on_drive};
use super::menu::{Entry, Setup};
use super::rivals::Rival;
use crate::channel::{Channel, Channels};
use crate::fit::{Columns, Hypothesis, Point, Problem};
use crate::regimes::Regimes;
use crate::settings::next::SETTINGS;
use crate::simulate::Response;
use inference::algebra::solve_spd;
use robot_model::tunable::tuned;

/// Everything that stays the same from drive to drive.
pub(crate) struct Forecaster<'a> {
    pub(crate) problem: &'a Problem<'a>,
    pub(crate) regimes: &'a Regimes,
    pub(crate) rivals: &'a [Rival],
    pub(crate) follower: Follower,
}

/// What is expected of one drive.
pub(crate) struct ExpectedGain {
    /// By the rival that is true.
    pub(crate) views: Vec<Forecast>,
    /// Root mean square of what tells a pair apart, in units of what fault-free drives show, by
    /// channel: `[truth][other]`.
    pub(crate) shows: Vec<Vec<Channels<f64>>>,
    /// One sigma of the first rival's size after the drive over that before.
    pub(crate) narrows: Option<f64>,
}

/// How far one rival falls behind another.
struct Gap {
    /// Fall of the log-likelihood, nats.
    behind: f64,
    /// Residual that is left, weighted.
    left: Vec<f64>,
    shows: Channels<f64>,
}

impl Forecaster<'_> {
    /// The robot as it stands for a drive.
    fn prepared(&self, setup: Setup) -> Robot<f64> {
        let r = *self.problem.robot;
        let s = SETTINGS.setups;
        match setup {
            Setup::AsItIs => r,
            Setup::Loaded => {
                Robot { mass: r.mass * (1.0 + s.load_mass), yaw_inertia: r.yaw_inertia * (1.0 + s.load_inertia), ..r }
            }
            Setup::Lifted => {
                Robot { mass: s.lifted_inertia, yaw_inertia: s.lifted_inertia, gravity: s.lifted_gravity, ..r }
            }
        }
    }

    /// What a drive would show if each of the rivals in turn were true.
    pub(crate) fn expected_gain(&self, entry: &Entry) -> Option<ExpectedGain> {
        let robot = self.prepared(entry.setup);
        let (mut views, mut shows, mut narrows) = (Vec::new(), Vec::new(), None);
        for truth in 0..self.rivals.len() {
            let (gaps, own) = self.truth(&robot, entry, truth)?;
            if truth == 0 {
                narrows = own;
            }
            views.push(view(&gaps));
            shows.push(gaps.iter().map(|g| g.shows).collect());
        }
        Some(ExpectedGain { views, shows, narrows })
    }

    /// Gaps to all rivals when one is true, and by how much its own size is narrowed.
    fn truth(&self, robot: &Robot<f64>, entry: &Entry, truth: usize) -> Option<(Vec<Gap>, Option<f64>)> {
        let p = self.problem;
        let k = &self.rivals[truth];
        let ground = entry.setup != Setup::Lifted;
        let tuned_robot = tuned(robot, &p.sigma, &k.point.theta);
        let true_point = Point { effects: k.further.clone(), ..k.point.clone() };
        let doses = k.hypothesis.doses(&true_point.effects, 0);
        let mut cut = self.follower.drive(&tuned_robot, &doses, &entry.course, entry.start, ground);
        if cut.segments.is_empty() {
            return None;
        }
        let blank = on_drive(p, robot, &cut, vec![1.0; cut.segments.len()]);
        let shown = blank.response(&true_point, &k.hypothesis);
        let tuning = blank.nuisance_columns(&true_point, &k.hypothesis, &shown);
        drop(blank);
        observe(&mut cut, &shown[0]);
        let regime = cut.segments.iter().map(|s| self.regimes.expected(s)).collect();
        let new = on_drive(p, robot, &cut, regime);
        let gaps = (0..self.rivals.len())
            .map(|l| if l == truth { Some(Gap::none(&new)) } else { self.gap(&new, &tuning, l) })
            .collect::<Option<Vec<_>>>()?;
        let own = if truth == 0 { narrowing(&new, &tuning, k) } else { None };
        Some((gaps, own))
    }

    /// The least gap over the ways in which the rival may have its onset.
    fn gap(&self, new: &Problem<'_>, tuning: &Columns, l: usize) -> Option<Gap> {
        let rival = &self.rivals[l];
        let length = new.cuts[0].torque.len() as f64 * new.cuts[0].period;
        let forms = rival.onsets(length);
        let gaps = forms.iter().filter_map(|h| gap_of(new, tuning, rival, h));
        gaps.min_by(|a, b| a.behind.total_cmp(&b.behind))
    }
}

/// One sigma of a rival's first strength with the drive over that without.
fn narrowing(new: &Problem<'_>, tuning: &Columns, k: &Rival) -> Option<f64> {
    if k.free.is_empty() {
        return None;
    }
    let shown = new.response(&k.point, &k.hypothesis);
    let columns = new.effect_columns(&k.point, &k.hypothesis, &shown);
    let normal = new.normal(&k.point, &shown, tuning, &columns)?;
    let n = normal.matrix.nrows();
    let sigma = |m: &Mat<f64>| Some(solve_spd(m, &Mat::identity(n, n))?.0[(NUISANCES, NUISANCES)].sqrt());
    Some(sigma(&(&k.information + &normal.matrix))? / sigma(&k.information)?)
}

impl Gap {
    fn none(new: &Problem<'_>) -> Self {
        let numbers = new.cuts[0].segments.iter().map(|s| s.observed.len() * Channel::ALL.len()).sum();
        Self { behind: 0.0, left: vec![0.0; numbers], shows: Channels::all(0.0) }
    }
}

/// How far `rival` falls behind the truth that `new` shows: one Gauss–Newton step of its tuning and sizes within what is
/// known of them, then a free run there,
/// `d = ½ min_δ [(Δμ − S δ)ᵀ R⁻¹ (Δμ − S δ) + δᵀ P⁻¹ δ]`, tempered and saturated as the cost of a fit is.
fn gap_of(new: &Problem<'_>, tuning: &Columns, rival: &Rival, h: &Hypothesis) -> Option<Gap> {
    let base = new.response(&rival.point, h);
    let sizes = new.effect_columns(&rival.point, h, &base);
    let mut normal = new.normal(&rival.point, &base, tuning, &sizes)?;
    normal.matrix += &rival.information;
    let stay = cost(new, rival, &rival.point, &base);
    let mut best = (stay, base);
    let parameters = Problem::parameters(&rival.point, &rival.free);
    if let Some(delta) = normal.step(&parameters, 0.0) {
        let values = Normal::values(&parameters, &delta);
        let point = new.advanced(&rival.point, &Step { values, delta: &delta, damping: 0.0, normal: &normal });
        let response = new.response(&point, h);
        let moved = cost(new, rival, &point, &response);
        if moved < best.0 {
            best = (moved, response);
        }
    }

    let (behind, response) = best;
    let cut = &new.cuts[0];
    let (mut left, mut sum, mut count) = (Vec::new(), Channels::all(0.0), Channels::all(0.0_f64));
    for (s, segment) in cut.segments.iter().enumerate() {
        let weight = new.weight(0, s, new.q(0, s, &response[0][s]) + expected(new, s)).sqrt();
        for ((o, y), valid) in segment.observed.iter().zip(&response[0][s]).zip(&segment.valid) {
            for c in Channel::ALL {
                let scaled = if valid[c] { (o[c] - y[c]) / new.variance[c].sqrt() } else { 0.0 };
                left.push(weight * scaled);
                sum[c] += scaled * scaled;
                count[c] += f64::from(valid[c]);
            }
        }
    }
    let shows = Channels::from_fn(|c| (sum[c] / count[c].max(1.0)).sqrt());
    Some(Gap { behind, left, shows })
}

/// Expected misfit of a segment when the model is right.
fn expected(new: &Problem<'_>, segment: usize) -> f64 {
    new.cuts[0].segments[segment].count * new.regime[0][segment]
}

/// Cost above that of the truth, nats: misfit beyond what noise leaves, and how far the rival had to move.
fn cost(new: &Problem<'_>, rival: &Rival, point: &Point, response: &Response) -> f64 {
    let misfit: f64 = (0..new.cuts[0].segments.len())
        .map(|s| {
            let noise = expected(new, s);
            new.segment_cost(0, s, noise + new.q(0, s, &response[0][s])) - new.segment_cost(0, s, noise)
        })
        .sum();
    let moved: Vec<f64> = (0..NUISANCES)
        .map(|k| point.theta[k] - rival.point.theta[k])
        .chain(rival.free.iter().enumerate().map(|(i, f)| (point.effects[i] - rival.point.effects[i]) / f.unit))
        .collect();
    misfit + half_quadratic(&rival.information, &moved) + point.run[0].iter().map(|u| 0.5 * u * u).sum::<f64>()
}

/// Log-likelihood ratios to expect: what two rivals lack in common makes theirs go together.
fn view(gaps: &[Gap]) -> Forecast {
    let norm: Vec<f64> = gaps.iter().map(|g| g.left.iter().map(|x| x * x).sum::<f64>().sqrt()).collect();
    let alike = |a: usize, b: usize| -> f64 {
        let product: f64 = gaps[a].left.iter().zip(&gaps[b].left).map(|(x, y)| x * y).sum();
        if norm[a] * norm[b] > 0.0 { product / (norm[a] * norm[b]) } else { f64::from(a == b) }
    };
    let believed = SETTINGS.expected.believed;
    Forecast::new(gaps.iter().map(|g| believed * g.behind.max(0.0)).collect(), alike)
}
