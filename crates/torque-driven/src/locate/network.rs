//! The paper's network as a model of what the verdict leaves: a better simulator, not a cause.
//!
//! Ridge regression of the residual torque on a fixed layer of sigmoid units. In a free run the network sees what is
//! simulated, not what was measured: its torque follows from a first run, the next run from that torque, and so on
//! (waveform relaxation, a few rounds over segments of 2 s), so the ordinary path knows nothing of it.

use faer::Mat;
use nn_basis::{Activation, Basis, LinearNet, SigmoidLayer};
use sim::{Purpose, Stream};

use crate::channel::{Channel, Channels};
use crate::fit::{Hypothesis, Point, Problem};
use crate::locate::torque::Followed;
use crate::rms::rms;
use crate::run_numbers::UNKNOWN;
use crate::settings::locate::{Network, SETTINGS};
use crate::simulate::RunResponse;
use crate::windows::Cut;
use inference::algebra::solve_spd;
use verdict::ResidualModel;
use verdict::Word;

/// A recording's best point without it in the fit.
pub(crate) struct LeftOut {
    pub(crate) run: usize,
    /// Corrected, or re-tuned when there is nothing to correct with.
    pub(crate) point: Point,
}

/// Wheel speeds, yaw rate, torque commands.
pub(crate) const INPUTS: usize = 5;
const NAMES: [&str; INPUTS] = [
    "left wheel speed, rad/s",
    "right wheel speed, rad/s",
    "yaw rate, rad/s",
    "left command, N m",
    "right command, N m",
];
/// Units, and these with a constant.
const UNITS: usize = NETWORK.units;
const TERMS: usize = UNITS + 1;
const NETWORK: Network = SETTINGS.network;

type Input = [f64; INPUTS];
/// A recording with its free run.
type FreeRunOf = (usize, RunResponse);
type Net = LinearNet<f64, TERMS, 2>;

/// The fixed first layer and its scales.
struct Layer {
    units: SigmoidLayer<f64, INPUTS, UNITS>,
    rows: Vec<Vec<f64>>,
    scale: Input,
}

impl Layer {
    fn new(scale: Input) -> Option<Self> {
        let mut stream = Stream::new(NETWORK.seed, Purpose::IdentifierLayer, 2);
        let mut drawn = || stream.uniform(-NETWORK.range, NETWORK.range);
        let threshold: [f64; UNITS] = std::array::from_fn(|_| drawn());
        let weight: [Input; UNITS] = std::array::from_fn(|_| std::array::from_fn(|_| drawn()));
        let rows = threshold.iter().zip(&weight).map(|(t, w)| [&[*t], w.as_slice()].concat()).collect();
        Some(Self { units: SigmoidLayer::new(threshold, weight, scale, Activation::Logistic).ok()?, rows, scale })
    }

    fn terms(&self, input: &Input) -> [f64; TERMS] {
        let phi = self.units.regressor(input);
        // Centred: half is what a unit shows when its input says nothing.
        std::array::from_fn(|i| if i < UNITS { phi[i] - 0.5 } else { 1.0 })
    }
}

/// Sums of a regression over one recording's windows.
#[derive(Clone)]
struct Sums {
    matrix: Mat<f64>,
    right: Mat<f64>,
    squares: f64,
    count: f64,
}

impl Sums {
    fn empty() -> Self {
        Self { matrix: Mat::zeros(TERMS, TERMS), right: Mat::zeros(TERMS, 2), squares: 0.0, count: 0.0 }
    }

    fn add(&mut self, phi: &[f64; TERMS], torque: [f64; 2]) {
        for i in 0..TERMS {
            for j in 0..TERMS {
                self.matrix[(i, j)] += phi[i] * phi[j];
            }
            for (j, t) in torque.iter().enumerate() {
                self.right[(i, j)] += phi[i] * t;
            }
        }
        self.squares += torque[0] * torque[0] + torque[1] * torque[1];
        self.count += 1.0;
    }

    fn join(&mut self, other: &Self) {
        self.matrix += &other.matrix;
        self.right += &other.right;
        self.squares += other.squares;
        self.count += other.count;
    }

    fn solve(&self, ridge: f64) -> Option<Net> {
        let mut matrix = self.matrix.clone();
        for i in 0..TERMS {
            matrix[(i, i)] += ridge * self.count.max(1.0);
        }
        let (x, _) = solve_spd(&matrix, &self.right)?;
        Some(Net { weight: std::array::from_fn(|j| std::array::from_fn(|i| x[(i, j)])) })
    }

    /// Sum of squared errors of a network on these windows.
    fn error(&self, net: &Net) -> f64 {
        let mut e = self.squares;
        for (j, w) in net.weight.iter().enumerate() {
            for i in 0..TERMS {
                e -= 2.0 * w[i] * self.right[(i, j)];
                for k in 0..TERMS {
                    e += w[i] * self.matrix[(i, k)] * w[k];
                }
            }
        }
        e
    }
}

/// The network of these recordings, its ridge chosen by leaving each out in turn; `None` when nothing is better.
fn fit(parts: &[&Sums]) -> Option<Net> {
    let joined = |skip: Option<usize>| {
        let mut sum = Sums::empty();
        parts.iter().enumerate().filter(|(i, _)| Some(*i) != skip).for_each(|(_, p)| sum.join(p));
        sum
    };
    let nothing: f64 = parts.iter().map(|p| p.squares).sum();
    let error = |ridge: f64| -> Option<f64> {
        (0..parts.len()).map(|i| joined(Some(i)).solve(ridge).map(|net| parts[i].error(&net))).sum()
    };
    let (best, ridge) = if parts.len() > 1 {
        NETWORK.ridges.iter().filter_map(|&r| error(r).map(|e| (e, r))).min_by(|a, b| a.0.total_cmp(&b.0))?
    } else {
        (0.0, NETWORK.lone_ridge)
    };
    if best < nothing { joined(None).solve(ridge) } else { None }
}

/// Mean command of a window.
fn command(cut: &Cut, row: usize) -> [f64; 2] {
    let rows = &cut.torque[row..(row + cut.rows_per_window).min(cut.torque.len())];
    [0, 1].map(|j| rows.iter().map(|t| t[j]).sum::<f64>() / rows.len().max(1) as f64)
}

/// What the network sees in a window of a response.
fn input(cut: &Cut, row: usize, window: &Channels<f64>) -> Input {
    let [left, right] = command(cut, row);
    [window[Channel::LeftWheel], window[Channel::RightWheel], window[Channel::YawRate], left, right]
}

/// Regression sums of one recording: measured motion in, torque beyond the corrected model out.
fn sums(cut: &Cut, followed: &Followed, layer: &Layer) -> Sums {
    let mut out = Sums::empty();
    for segment in &cut.segments {
        for (w, (window, valid)) in segment.observed.iter().zip(&segment.valid).enumerate() {
            let row = segment.row + w * cut.rows_per_window;
            if ![Channel::LeftWheel, Channel::RightWheel, Channel::YawRate].into_iter().all(|c| valid[c]) {
                continue;
            }
            let Some(raw) = followed.raw.get(row..row + cut.rows_per_window) else { continue };
            let torque = [0, 1].map(|j| raw.iter().map(|t| t[j]).sum::<f64>() / raw.len() as f64);
            out.add(&layer.terms(&input(cut, row, window)), torque);
        }
    }
    out
}

/// Free run of one recording with the network in the loop.
fn free_run(p: &Problem<'_>, h: &Hypothesis, left: &LeftOut, layer: &Layer, net: &Net) -> RunResponse {
    let mut own = h.clone();
    for (_, onsets) in own.parts.iter_mut().filter(|(_, o)| !o.is_empty()) {
        *onsets = vec![onsets[left.run]];
    }
    let point = Point { run: vec![UNKNOWN], ..left.point.clone() };
    let plain = &p.cuts[left.run];
    let mut response = p.run_response(left.run, &left.point, h);
    for _ in 0..NETWORK.rounds {
        let mut cut = plain.clone();
        for (segment, y) in plain.segments.iter().zip(&response) {
            for (w, window) in y.iter().enumerate() {
                let row = segment.row + w * plain.rows_per_window;
                let [left, right] = net.output(&layer.terms(&input(plain, row, window)));
                for t in cut.torque.iter_mut().skip(row).take(plain.rows_per_window) {
                    t[0] += left;
                    t[1] += right;
                }
            }
        }
        let cuts = [cut];
        let alone = Problem {
            cuts: &cuts,
            regime: vec![p.regime[left.run].clone()],
            information: p.information.clone(),
            ..p.clone()
        };
        response = alone.run_response(0, &point, &own);
    }
    response
}

/// Largest size of each input over the recordings, at least a little.
fn scale(cuts: &[Cut]) -> Input {
    let mut out: Input = NETWORK.least_scale;
    for cut in cuts {
        for segment in &cut.segments {
            for (w, window) in segment.observed.iter().enumerate() {
                let input = input(cut, segment.row + w * cut.rows_per_window, window);
                for (s, v) in out.iter_mut().zip(input) {
                    *s = s.max(v.abs());
                }
            }
        }
    }
    out
}

/// A network for what the best answer leaves, if it lowers the error on recordings left out of its fit.
///
/// `followed` is the identifier's view of each recording through the corrected model.
pub(crate) fn residual_model(
    p: &Problem<'_>,
    h: &Hypothesis,
    left_out: &[LeftOut],
    followed: &[Followed],
) -> Option<ResidualModel> {
    if left_out.len() < 2 || followed.len() != p.cuts.len() {
        return None;
    }
    let layer = Layer::new(scale(p.cuts))?;
    let sums: Vec<Sums> = p.cuts.iter().zip(followed).map(|(c, f)| sums(c, f, &layer)).collect();

    // Each recording is run with the network of the others, and without any.
    let (mut without, mut with): (Vec<FreeRunOf>, Vec<FreeRunOf>) = (Vec::new(), Vec::new());
    for left in left_out {
        let others: Vec<&Sums> = sums.iter().enumerate().filter(|(r, _)| *r != left.run).map(|(_, s)| s).collect();
        let plain = p.run_response(left.run, &left.point, h);
        let better = fit(&others).map(|net| free_run(p, h, left, &layer, &net));
        with.push((left.run, better.unwrap_or_else(|| plain.clone())));
        without.push((left.run, plain));
    }

    let (a, b) = (rms(p, &without), rms(p, &with));
    let worse = b[0] > (1.0 - NETWORK.lowers) * a[0] || b[1] > (1.0 + NETWORK.raises) * a[1];
    if b.iter().any(|e| !e.is_finite()) || worse {
        return None;
    }

    let net = fit(&sums.iter().collect::<Vec<_>>())?;
    Some(ResidualModel {
        standing: "not a cause".into(),
        inputs: NAMES.into_iter().map(Word::from).zip(layer.scale).collect(),
        // The units are centred: half of each weight goes to the constant.
        weights: net.weight.map(|w| {
            let constant = w[UNITS] - 0.5 * w[..UNITS].iter().sum::<f64>();
            [&w[..UNITS], &[constant]].concat()
        }),
        first_layer: layer.rows,
        wheel_speed: [a[0], b[0]],
        yaw_rate: [a[1], b[1]],
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::locate::torque::follow;
    use crate::testing::{cutting, driven, problem};
    use crate::windows::cut;
    use inference::hypothesis::Dose;
    use robot_model::effects;
    use robot_model::presence::Presence;
    use testing::robot;

    /// The network for drives of the robot with this much viscous friction that nobody names.
    fn network(viscous: f64) -> Option<ResidualModel> {
        let effect =
            effects::catalogue::<f64>().into_iter().find(|e| e.spec().id == "viscous_friction").expect("known");
        let doses = [Dose { effect, values: vec![viscous], presence: Presence::default() }];
        let runs: Vec<_> = [20.0, 16.0, 12.0].map(|seconds| driven(&robot(), &doses, seconds)).into();
        let cuts: Vec<Cut> = runs.iter().map(|r| cut(r, &cutting())).collect();
        let robot = robot();
        let p = problem(&robot, &cuts);
        let followed: Vec<Followed> =
            runs.iter().zip(&cuts).map(|(r, c)| follow(r, c, &robot, &[], 5.0).expect("gains")).collect();
        let left_out: Vec<LeftOut> = (0..3).map(|run| LeftOut { run, point: p.origin() }).collect();
        residual_model(&p, &Hypothesis::default(), &left_out, &followed)
    }

    #[test]
    fn a_network_learns_a_friction_that_nobody_named_and_lowers_the_error_on_left_out_recordings() {
        let model = network(0.08).expect("a network");
        assert_eq!(model.standing, "not a cause");
        assert!(model.wheel_speed[1] < 0.5 * model.wheel_speed[0], "{:?}", model.wheel_speed);
        assert!(model.yaw_rate[1] < model.yaw_rate[0], "{:?}", model.yaw_rate);
        assert!(model.weights.iter().all(|w| w.len() == model.first_layer.len() + 1));
    }

    #[test]
    fn nothing_is_reported_when_nothing_is_left() {
        assert_eq!(network(0.0), None);
    }
}
