//! All locators over one case.

use crate::calibrate::problem;
use crate::fit::{Fitted, Hypothesis, Problem};
use crate::judged::Judged;
use crate::leave_out::{Forecasts, Simulated};
use crate::locate::band::residual_torque;
use crate::locate::cells::{cells, channel_probabilities, findings};
use crate::locate::fault_free::FaultFree;
use crate::locate::network::{LeftOut, residual_model};
use crate::locate::remainder::{excess, remainder};
use crate::locate::side::{contradiction, side};
use crate::locate::times::spans;
use crate::locate::torque::{Followed, follow};
use crate::locate::traces::traces;
use crate::run::Run;
use crate::settings::{decision, locate::SETTINGS};
use crate::simulate::Response;
use crate::windows::Cut;
use robot_model::tunable::tuned;
use verdict::Trace;
use verdict::{Cause, Cell, Finding};
use verdict::{Located, ResidualModel};

/// Where the mismatch was found, and what contradicts the verdict.
pub(crate) struct Whereabouts {
    pub(crate) findings: Vec<Finding>,
    pub(crate) cells: Vec<Cell>,
    pub(crate) told: Located,
    pub(crate) contradiction: Option<String>,
    pub(crate) traces: Vec<Trace>,
}

/// The identifier over each run beside the calibrated model.
fn followed(problem: &Problem<'_>, runs: &[Run]) -> Vec<Followed> {
    let robot = tuned(problem.robot, &problem.sigma, &problem.centre);
    let all = runs.iter().zip(problem.cuts);
    all.filter_map(|(run, cut)| follow(run, cut, &robot, &[], problem.largest_torque).ok()).collect()
}

/// A network for what is left, beside the best answer's own model.
fn network(answer: &Judged<'_>, best: &Fitted, simulated: &[Simulated]) -> Option<ResidualModel> {
    let p = answer.problem;
    let none = Hypothesis::default();
    let h = answer.winner().map_or(&none, |w| &w.trial.hypothesis);
    let robot = tuned(p.robot, &p.sigma, &best.point.theta);
    let seen = |(r, (run, cut)): (usize, (&Run, &Cut))| {
        follow(run, cut, &robot, &h.doses(&best.point.effects, r), p.largest_torque).ok()
    };
    let followed: Vec<Followed> = answer.case.recordings.iter().zip(p.cuts).enumerate().filter_map(seen).collect();
    let left_out = simulated.iter().enumerate().filter(|(_, s)| s.left_out);
    let left_out: Vec<LeftOut> =
        left_out.map(|(run, s)| LeftOut { run, point: s.models.best().point.clone() }).collect();
    residual_model(p, h, &left_out, &followed)
}

/// Locates the mismatch of the calibrated model, and what the best answer's fit leaves of it.
pub(crate) fn locate(
    answer: &Judged<'_>,
    calibrated: &Response,
    best: &Fitted,
    forecasts: &Forecasts,
    unexplained: Option<f64>,
    ranked: &[Cause],
) -> Whereabouts {
    let p = answer.problem;
    let references =
        problem(p.robot, answer.case, answer.references, answer.calibration, p.largest_torque, answer.options);
    let fault_free = FaultFree::new(&references);
    let energy = fault_free.energy_of(p, calibrated);
    let findings = findings(p, &energy, &channel_probabilities(&energy, &fault_free));
    let torque =
        residual_torque(p.cuts, &followed(p, &answer.case.recordings), &followed(&references, &answer.case.references));
    let left = fault_free.energy_of(p, &best.response);
    let side = side(&excess(&energy), &findings, &torque);
    let likely = decision::SETTINGS.answer.likely;
    let named: Vec<Cause> = ranked.iter().filter(|c| c.probability > likely).cloned().collect();
    Whereabouts {
        contradiction: contradiction(&named, side, &torque),
        cells: cells(p, &references, &energy, &fault_free),
        told: Located {
            spans: spans(p, &energy, &fault_free),
            torque,
            remainder: unexplained.map(|share| remainder(p, share, &left, &channel_probabilities(&left, &fault_free))),
            side: side.map(Into::into),
            residual_model: unexplained
                .filter(|share| *share > SETTINGS.network.left)
                .and_then(|_| network(answer, best, &forecasts.simulated)),
        },
        findings,
        traces: traces(p, &fault_free, &forecasts.simulated),
    }
}
