//! The paper's online identifier as a locator: its estimate of what the calibrated model's wheel dynamics lack.
//!
//! The identifier follows x of `ẋ = −a x + G(x, u)`. Of G the calibrated model knows a part, `G_m = ẋ_m + a x` with
//! `J ẋ_m = u − load`, where `load` is what the model needs to turn its wheels as they were measured. With G_m as the
//! identifier's known part, `J Ŵᵀφ` is the residual torque. The free runs know nothing of it: what is looked for is
//! shown by the weights, not absorbed by them.

use std::convert::Infallible;
use std::iter::Peekable;

use identifier::{Identifier, IdentifierError, Ledger, Midpoint, Sample};
use nn_basis::{Basis, dot};
use robot_model::{Active, Plant, Robot, State};
use sim::rollout::{AtSpeed, DriveAlone, Grid, Hold, Rollout, Visitor};
use sim::{Purpose, Recipe, Stream, UNITS};

use crate::run::Run;
use crate::settings::locate::{Identifying, SETTINGS};
use crate::windows::{Cut, Segment};
use inference::hypothesis::Dose;
use verdict::TorqueCertificate;

const IDENTIFYING: Identifying = SETTINGS.identifier;

/// What an identifier made of a recording.
pub(crate) struct Followed {
    /// Torque beyond the model, row by row and side by side, as the wheels show it: noisy, N m.
    pub(crate) raw: Vec<[f64; 2]>,
    /// The identifier's estimate of it, N m.
    pub(crate) estimate: Vec<[f64; 2]>,
    /// Measured wheel speeds, rad/s, and the model's yaw rate on these wheels, rad/s.
    pub(crate) speed: Vec<[f64; 2]>,
    pub(crate) certificate: [TorqueCertificate; 2],
}

/// Wheel speed as the slope of the angle over rows nearby; gaps are bridged by straight lines.
fn speeds(angle: &[Option<f64>], period: f64) -> Vec<f64> {
    let mut whole = Vec::with_capacity(angle.len());
    let mut last: Option<(usize, f64)> = None;
    for (k, a) in angle.iter().enumerate().filter_map(|(k, a)| a.map(|a| (k, a))) {
        let (from, value) = last.unwrap_or((k, a));
        for i in whole.len()..k {
            let share = if k > from { (i as f64 - from as f64) / (k - from) as f64 } else { 0.0 };
            whole.push(value + share * (a - value));
        }
        whole.push(a);
        last = Some((k, a));
    }
    whole.resize(angle.len(), last.map_or(0.0, |l| l.1));
    (0..whole.len())
        .map(|k| {
            let near = IDENTIFYING.half.min(k).min(whole.len() - 1 - k);
            let (mut sum, mut squares) = (0.0, 0.0);
            for i in 1..=near {
                sum += i as f64 * (whole[k + i] - whole[k - i]);
                squares += 2.0 * (i * i) as f64;
            }
            if squares > 0.0 { sum / squares / period } else { 0.0 }
        })
        .collect()
}

/// Mean torque over each row that the drives deliver less what the model's wheels need at the measured speeds, N m.
fn surplus(run: &Run, cut: &Cut, robot: &Robot<f64>, doses: &[Dose], speed: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let active: Vec<Active<f64>> = cut.given.iter().chain(doses).map(Dose::active).collect();
    let grid = Grid::nearest(run.period, IDENTIFYING.step);
    let plant = Plant::new(robot, &active, grid.step());
    let hold = Hold::new(grid, plant.drive().delay);

    let mut s = State::default();
    if let Some(first) = cut.segments.first() {
        s.yaw_rate = first.start.yaw_rate;
        plant.set_velocity(&mut s, first.start.velocity);
    }

    let measured = |row: usize, step: usize| {
        let share = (step as f64 + 0.5) / grid.substeps as f64;
        let now = [0, 1].map(|j| speed[row][j] + share * (speed[row + 1][j] - speed[row][j]));
        (now, [0.0; 2])
    };
    let rows = speed.len().saturating_sub(1);
    let mut surplus = Surplus {
        cut,
        starts: cut.segments.iter().peekable(),
        substeps: grid.substeps as f64,
        sum: [0.0; 2],
        rows: Vec::with_capacity(rows),
    };
    let Ok(()) = Rollout::new(&plant, rows, grid.substeps).run(
        &mut s,
        &mut (DriveAlone(|row, step| hold.command(&run.torque, row, step)), AtSpeed(measured)),
        &mut surplus,
    );
    surplus.rows
}

/// Takes the mean over each row of what the drives deliver beyond what the wheels need.
struct Surplus<'a> {
    cut: &'a Cut,
    starts: Peekable<std::slice::Iter<'a, Segment>>,
    substeps: f64,
    sum: [f64; 2],
    rows: Vec<[f64; 2]>,
}

impl Visitor<f64> for Surplus<'_> {
    type Stop = Infallible;

    fn begin(&mut self, row: usize, _: &Plant<'_, f64>, s: &mut State<f64>) -> Result<(), Infallible> {
        // Only where the robot is: how the body moves follows from its wheels.
        if let Some(Segment { start, .. }) = self.starts.next_if(|s| s.row == row) {
            s.position = start.position;
            s.heading = [start.yaw.cos(), start.yaw.sin()];
            s.wheel_angle = start.wheel_angle;
            s.time = self.cut.time(row as f64);
        }
        self.sum = [0.0; 2];
        Ok(())
    }

    fn step(&mut self, _: usize, _: usize, plant: &Plant<'_, f64>, s: &State<f64>) {
        let (delivered, gain) = (plant.delivered(s), plant.drive().gain);
        for j in 0..2 {
            self.sum[j] += (delivered[j] - s.needed[j] * gain) / self.substeps;
        }
    }

    fn end(&mut self, _: usize, _: &Plant<'_, f64>, _: &State<f64>) {
        self.rows.push(self.sum);
    }
}

/// Lets the paper's identifier follow both wheel speeds of a recording, the robot with its doses as the known part.
///
/// # Errors
/// Never with the paper's gains; passed on rather than hidden.
pub(crate) fn follow(
    run: &Run,
    cut: &Cut,
    robot: &Robot<f64>,
    doses: &[Dose],
    largest_torque: f64,
) -> Result<Followed, IdentifierError> {
    let speed: Vec<[f64; 2]> = {
        let [left, right] = [0, 1].map(|j| speeds(&run.angle[j], run.period));
        left.into_iter().zip(right).map(|(l, r)| [l, r]).collect()
    };
    let surplus = surplus(run, cut, robot, doses, &speed);

    let inertia = 2.0 * robot.wheel_inertia + robot.motor_inertia;
    let recipe = Recipe::default().identifier;
    let fastest = speed.iter().flatten().fold(IDENTIFYING.least_speed, |a, v| a.max(v.abs()));
    let speed_scale = recipe.network.speed_scale * fastest;
    let torque_scale = largest_torque.max(IDENTIFYING.least_torque);
    let scale = [1.0, 1.0, speed_scale, speed_scale, torque_scale, torque_scale];
    let mut stream = Stream::new(IDENTIFYING.seed, Purpose::IdentifierLayer, 0);
    let (pole, law, h) = (recipe.pole, Midpoint::new(recipe.gain)?, run.period);

    let mut raw = vec![[0.0; 2]; surplus.len()];
    let mut estimate = raw.clone();
    let mut certificate = [TorqueCertificate { holds: true, error_energy: 0.0, bound: 0.0, identity: 0.0 }; 2];
    for j in 0..2 {
        let Ok(layer) = recipe.network.layer::<UNITS>(&mut stream, scale) else { continue };
        let mut identifier = Identifier::new(pole, law, speed[0][j])?;
        let mut ledger = Ledger::new(pole);
        for (k, torque) in surplus.iter().enumerate() {
            let (start, end) = (speed[k][j], speed[k + 1][j]);
            let rate = torque[j] / inertia;
            let mean = |i: usize| 0.5 * (speed[k][i] + speed[k + 1][i]);
            let u = run.torque[k];
            let phi = layer.regressor(&[0.0, 0.0, mean(j), mean(1 - j), u[j], u[1 - j]]);
            let known = pole * mean(j) + rate;
            let step = identifier.follow(&Sample { start, end, regressor: phi, known, h });
            ledger.add(&identifier.certificate(&step, &[0.0; UNITS]));
            raw[k][j] = inertia * ((end - start) / h - rate);
            estimate[k][j] = 0.5 * inertia * (dot(&step.before.weight, &phi) + dot(&step.after.weight, &phi));
        }
        certificate[j] = TorqueCertificate {
            holds: ledger.holds(),
            error_energy: ledger.error_energy(),
            bound: ledger.bound(),
            identity: ledger.worst_residual(),
        };
    }
    Ok(Followed { raw, estimate, speed, certificate })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{cutting, driven};
    use crate::windows::cut;
    use robot_model::effects;
    use robot_model::presence::Presence;
    use testing::robot;

    pub(super) fn brake(side: usize, torque: f64) -> Dose {
        let effect = effects::catalogue::<f64>().into_iter().find(|e| e.spec().id == "coulomb_side").expect("known");
        Dose { effect, values: vec![torque], presence: Presence { side: Some(side), ..Presence::default() } }
    }

    /// The identifier's view of a synthetic drive through the model without the dose.
    fn seen(doses: &[Dose]) -> Followed {
        let run = driven(&robot(), doses, 24.0);
        let cut = cut(&run, &cutting());
        follow(&run, &cut, &robot(), &[], 5.0).expect("the paper's gains")
    }

    #[test]
    fn the_residual_torque_is_the_hidden_torque_where_the_wheel_turns_steadily() {
        const HIDDEN: f64 = 0.6;
        let f = seen(&[brake(1, HIDDEN)]);
        let settled = 100;
        let mut shown = [(0.0, 0.0); 2];
        for k in settled..f.estimate.len() {
            for j in 0..2 {
                // Away from rest the brake's sign is that of the wheel.
                if f.speed[k][j].abs() > 2.0 && (f.speed[k + 1][j] - f.speed[k][j]).abs() < 0.05 {
                    shown[j].0 += f.estimate[k][j] * f.speed[k][j].signum();
                    shown[j].1 += 1.0;
                }
            }
        }
        let [left, right] = shown.map(|(sum, n)| sum / n);
        assert!(shown.iter().all(|s| s.1 > 100.0), "{shown:?}");
        // Within 10 % of the hidden torque on its side, and as little on the other.
        assert!((right + HIDDEN).abs() < 0.1 * HIDDEN, "right {right}");
        assert!(left.abs() < 0.1 * HIDDEN, "left {left}");
    }

    #[test]
    fn every_step_is_certified_and_the_identifier_follows_what_the_model_lacks() {
        for doses in [vec![], vec![brake(0, 0.4)]] {
            for c in seen(&doses).certificate {
                assert!(c.holds && c.identity < 1e-9 && c.error_energy <= c.bound, "{c:?}");
            }
        }
        // The weights take the hidden torque up, so the following error alone would hide it: the energy of the error
        // hardly grows, that of the estimate does.
        let energy = |f: &Followed| f.estimate.iter().skip(100).map(|t| t[0] * t[0]).sum::<f64>();
        let (fault_free, ill) = (seen(&[]), seen(&[brake(0, 0.4)]));
        assert!(energy(&ill) > 30.0 * energy(&fault_free), "{} {}", energy(&ill), energy(&fault_free));
    }

    #[test]
    fn speeds_bridge_gaps() {
        let mut angle: Vec<Option<f64>> = (0..100).map(|k| Some(0.05 * f64::from(k))).collect();
        for a in &mut angle[40..55] {
            *a = None;
        }
        let v = speeds(&angle, 0.01);
        assert!(v[1..99].iter().all(|v| (v - 5.0).abs() < 1e-9));
    }
}
