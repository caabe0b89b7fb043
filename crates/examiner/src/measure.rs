//! Measures what a draw hides: free-run errors, excess over the noise, when and where.

use std::collections::BTreeMap;

use crate::draw::{Cause, Draw, HiddenRuns};
use crate::effect::EffectId;
use crate::free::{error, predict, restarts, rms, shown};
use crate::hidden::{Disc, Hidden};
use crate::random::Stream;
use crate::run::Run;
use crate::truth::{EffectTruth, RecordingTruth};

impl Draw<'_> {
    /// Free-run errors with and without what is hidden, the excess of each effect, intervals.
    pub(crate) fn measure(&self, drawn: &mut HiddenRuns, in_runs: &[Hidden], causes: &[Cause]) {
        let none = Hidden::default();
        // Summed squares: with all, and without each.
        let mut with = [0.0; 2];
        let mut without = vec![[0.0; 2]; causes.len()];
        let mut coverage = vec![Vec::new(); causes.len()];
        for (i, (run, h)) in drawn.recordings.iter().zip(in_runs).enumerate() {
            let noise = Stream::new(self.seed, "restart", i as u64);
            let starts = restarts(run, &self.sheet, noise);
            let real = shown(run, h);
            let err = |h: &Hidden| error(&real, &predict(&self.robot, h, run, &starts, self.row));
            let bare = err(&none);
            let full = if causes.is_empty() { bare } else { err(h) };
            let mut intervals: BTreeMap<String, Vec<[f64; 2]>> = run.events.short(&h.foreign).into_iter().collect();
            for (j, cause) in causes.iter().enumerate() {
                let lacking = match (causes.len(), cause) {
                    (2, Cause::Effect(id)) => err(&lacks(h, *id)),
                    _ => bare,
                };
                for c in 0..2 {
                    without[j][c] += lacking[c] * lacking[c];
                }
                let Cause::Effect(id) = cause else { continue };
                let Some(found) = presence(*id, h, run, self.row, &self.robot.wheels()) else {
                    continue;
                };
                let share: f64 = found.iter().map(|f| f[1] - f[0]).sum::<f64>();
                coverage[j].push(share / (run.rows.len() as f64 * self.row));
                intervals.insert(id.id(), found);
            }
            for c in 0..2 {
                with[c] += full[c] * full[c];
            }
            drawn.truths.insert(
                format!("run_{}", i + 1),
                RecordingTruth {
                    intervals_s: intervals,
                    kinds: run.kinds.iter().map(|k| k.name().to_owned()).collect(),
                    freerun_without_effect: bare,
                    freerun_with_effect: full,
                    rms: rms(real.into_iter()),
                },
            );
        }
        for (j, e) in drawn.effects.iter_mut().enumerate() {
            let ratio = |c: usize| (without[j][c] / with[c].max(1e-12)).sqrt();
            e.excess = ratio(0).max(ratio(1));
            // Free runs hardly see sensors, which redundancy shows: against what is just visible.
            e.excess = match causes[j] {
                Cause::Effect(EffectId::EncoderDropout) => e.magnitude / 0.01,
                Cause::Effect(EffectId::GyroBias) => e.magnitude.abs() / 0.006,
                Cause::Effect(EffectId::GyroScale) => e.magnitude.abs() / 0.01,
                _ => e.excess,
            };
            if e.x.is_some() {
                let seen = coverage[j].iter().sum::<f64>() / coverage[j].len() as f64;
                let visits = coverage[j].iter().filter(|c| **c > 0.03).count();
                if !(0.06..0.8).contains(&seen) || visits < 2 {
                    // Nothing can place a disc that was not entered, or not left.
                    e.excess = e.excess.min(1.0);
                }
                e.coverage_recordings = Some(std::mem::take(&mut coverage[j]));
            }
        }
    }
}

/// Notes how much of the held-out runs is inside the discs of effects.
pub(crate) fn note_coverage(effects: &mut [EffectTruth], runs: &[Run]) {
    for e in effects {
        let (Some(x), Some(y), Some(radius)) = (e.x, e.y, e.radius) else {
            continue;
        };
        let disc = Disc { x, y, radius };
        let share = |run: &Run| {
            let inside = run.seen.iter().filter(|s| disc.holds(s.body[0], s.body[1]));
            inside.count() as f64 / run.seen.len() as f64
        };
        e.coverage_heldout = Some(runs.iter().map(share).collect());
    }
}

/// When a local effect was present: while at least half of the wheels were inside, or from its instant on.
fn presence(id: EffectId, h: &Hidden, run: &Run, row: f64, wheels: &[[f64; 2]]) -> Option<Vec<[f64; 2]>> {
    let end = run.rows.len() as f64 * row;
    let disc = match id {
        EffectId::AdhesionPatch => h.ice?.0,
        EffectId::RollingResistance => match h.onset {
            Some((at, _)) => return Some(vec![[at, end]]),
            None => h.mud?.0,
        },
        _ => return None,
    };
    let mut found: Vec<[f64; 2]> = Vec::new();
    let mut was = false;
    let clean = |t: f64| (t * 1000.0).round() / 1000.0;
    for (k, s) in run.seen.iter().enumerate() {
        // The ground acts on wheels: it is there while at least half of them are on it.
        let (sin, cos) = s.body[2].sin_cos();
        let on = |ahead: f64, left: f64| {
            disc.holds(s.body[0] + cos * ahead - sin * left, s.body[1] + sin * ahead + cos * left)
        };
        let is = 2 * wheels.iter().filter(|[ahead, left]| on(*ahead, *left)).count() >= wheels.len();
        let now = clean(k as f64 * row);
        if is && !was {
            found.push([now, clean(end)]);
        } else if was
            && !is
            && let Some(last) = found.last_mut()
        {
            last[1] = now;
        }
        was = is;
    }
    Some(found)
}

/// The same without one of its effects.
fn lacks(h: &Hidden, id: EffectId) -> Hidden {
    let (mut out, none) = (h.clone(), Hidden::default());
    match id {
        EffectId::ViscousFriction => out.viscous = none.viscous,
        EffectId::Stiction => out.stiction = none.stiction,
        EffectId::CoulombSide => out.coulomb = none.coulomb,
        EffectId::Payload => {
            (out.payload, out.payload_inertia, out.payload_height) = (0.0, 0.0, 0.0);
        }
        EffectId::ComOffset => out.centre = none.centre,
        EffectId::Grade => out.slope = none.slope,
        EffectId::AdhesionPatch => out.ice = none.ice,
        EffectId::RollingResistance => (out.mud, out.onset) = (None, None),
        EffectId::QuadraticDrag => out.drag = none.drag,
        EffectId::ConstantPull => out.pull = none.pull,
        EffectId::WheelRadiusMismatch => out.radius = none.radius,
        EffectId::TorqueConstant => out.torque_gain = none.torque_gain,
        EffectId::MotorLag => out.lag = none.lag,
        EffectId::TorqueSaturation => out.limit = none.limit,
        EffectId::TransportDelay => out.delay = none.delay,
        EffectId::BacklashDeadZone => out.dead_zone = none.dead_zone,
        EffectId::BeltLoss => out.belt = none.belt,
        EffectId::TurningResistance => out.lateral = none.lateral,
        EffectId::WheelEccentricity => out.runout = none.runout,
        EffectId::ThermalDrift => out.drift = none.drift,
        EffectId::GyroBias => out.gyro_bias = none.gyro_bias,
        EffectId::GyroScale => out.gyro_scale = none.gyro_scale,
        EffectId::EncoderDropout => out.frozen = none.frozen,
        EffectId::CasterDrag => out.caster_drag = none.caster_drag,
    }
    out
}
