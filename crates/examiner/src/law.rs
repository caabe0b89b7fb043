//! Laws of another grammar: formulas that the search for a law does not hold as they stand, but for one, `turn_drag`, which it does.
//!
//! With torque scale or weight times a share as `a`, wheel speed `ω`, forward speed `v`, yaw rate `r` and heading `ψ`:
//!
//! ```text
//! arctan_drag             T = -a (2/π) atan(ω/ω₀)                  of a side, or both
//! warming_friction        T = -a h sgn ω,  τ ḣ = |ω|/ω₀ - h         of a side, or both
//! wide_hysteresis         T = -a z,  ż = (ω - |ω| z)/θ             of a side, or both
//! resonant_friction       T = -a sgn ω / (1 + ((|ω| - ω₁)/ω₀)²)    of a side, or both
//! fading_friction         T = -a sgn ω / (1 + (ω/ω₀)²)             of a side, or both
//! turn_drag               F = -a (v/v₀) |r|/r₀                     fore-aft
//! logarithmic_drag        F = -a ln(1 + (v/v₀)²) v/|v|             along the velocity
//! heading_drag            F = -a (1 + cos(ψ - φ)) v/v₀             fore-aft
//! fading_turn_resistance  M = -a (r/r₀) / (1 + (v/v₀)²)            on the body
//! fading_grip             grip of all wheels times 1 / (1 + a (r/r₀)²)
//! ```

use std::f64::consts::{FRAC_2_PI, PI};

use serde::{Deserialize, Serialize};

use crate::effect::Sizing;
use crate::hidden::Hidden;
use crate::random::Stream;
use crate::robot::GRAVITY;
use crate::run::{Motion, Row, Run};
use crate::truth::EffectTruth;

/// The kinds of laws.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "the module gives the formula of each")]
pub enum LawKind {
    ArctanDrag,
    WarmingFriction,
    WideHysteresis,
    ResonantFriction,
    FadingFriction,
    TurnDrag,
    LogarithmicDrag,
    HeadingDrag,
    FadingTurnResistance,
    FadingGrip,
}

impl LawKind {
    /// All of them.
    pub const ALL: [Self; 10] = [
        Self::ArctanDrag,
        Self::WarmingFriction,
        Self::WideHysteresis,
        Self::ResonantFriction,
        Self::FadingFriction,
        Self::TurnDrag,
        Self::LogarithmicDrag,
        Self::HeadingDrag,
        Self::FadingTurnResistance,
        Self::FadingGrip,
    ];

    /// Whether it is a torque of drives.
    fn is_of_drives(self) -> bool {
        matches!(
            self,
            Self::ArctanDrag
                | Self::WarmingFriction
                | Self::WideHysteresis
                | Self::ResonantFriction
                | Self::FadingFriction
        )
    }
}

/// A law with its numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ForeignLaw {
    kind: LawKind,
    /// `a` of each side; of the body, and of grip, the first.
    size: [f64; 2],
    /// `ω₀`, rad/s; `v₀` and `r₀` are those of a robot whose wheels turn so fast.
    omega: f64,
    /// `v₀`, m/s.
    speed: f64,
    /// `r₀`, rad/s.
    turn: f64,
    /// `τ` s, `θ` rad, `ω₁` rad/s, or `φ` rad.
    shape: f64,
}

/// What a law does at an instant: N m at the drives, N and N m on the body, shares of grip.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Acting {
    /// Torque of each side.
    pub torque: [f64; 2],
    /// Force, forward and to the left.
    pub force: [f64; 2],
    /// Yaw moment.
    pub moment: f64,
    /// Share by which the grip of all wheels rises.
    pub grip: f64,
}

/// A row of a drive with a law: what moves, and what the law does.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct LawRow {
    /// Place, m, heading, rad, velocity in body axes, m/s, and yaw rate, rad/s.
    pub body: [f64; 6],
    /// Wheel speed of each side, rad/s.
    pub wheel_speed: [f64; 2],
    /// Wheel angle of each side, rad.
    pub wheel_angle: [f64; 2],
    /// Torque that each side is commanded, N m.
    pub torque: [f64; 2],
    /// What the law does.
    pub acting: Acting,
}

/// What friction takes from a wheel, N m: dry friction, which presliding smooths, and a torque that holds as it stands.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Friction {
    pub dry: f64,
    pub smooth: f64,
}

impl ForeignLaw {
    /// What it takes from a wheel that turns with this speed.
    pub(crate) fn friction(&self, side: usize, omega: f64, memory: f64) -> Friction {
        let (a, over) = (self.size[side], omega / self.omega);
        let dry = |share: f64| Friction { dry: a * share, smooth: 0.0 };
        let smooth = |share: f64| Friction { dry: 0.0, smooth: a * share };
        match self.kind {
            LawKind::ArctanDrag => smooth(FRAC_2_PI * over.atan()),
            LawKind::WarmingFriction => dry(memory),
            LawKind::WideHysteresis => smooth(memory),
            LawKind::ResonantFriction => dry(1.0 / (1.0 + ((omega.abs() - self.shape) / self.omega).powi(2))),
            LawKind::FadingFriction => dry(1.0 / (1.0 + over * over)),
            _ => Friction::default(),
        }
    }

    /// Rate of the memory of a side whose wheels turn with this speed, 1/s.
    pub(crate) fn memory_rate(&self, omega: f64, memory: f64) -> f64 {
        match self.kind {
            LawKind::WarmingFriction => (omega.abs() / self.omega - memory) / self.shape,
            LawKind::WideHysteresis => (omega - omega.abs() * memory) / self.shape,
            _ => 0.0,
        }
    }

    /// Force in body axes and yaw moment on a body at this heading, with this velocity and yaw rate.
    pub(crate) fn on_body(&self, heading: f64, [vx, vy]: [f64; 2], turn: f64) -> ([f64; 2], f64) {
        let a = self.size[0];
        let (over, square) = (vx / self.speed, (vx * vx + vy * vy) / (self.speed * self.speed));
        match self.kind {
            LawKind::TurnDrag => ([-a * over * (turn / self.turn).abs(), 0.0], 0.0),
            LawKind::LogarithmicDrag => {
                let per_speed = a * square.ln_1p() / square.sqrt().max(1e-9) / self.speed;
                ([-per_speed * vx, -per_speed * vy], 0.0)
            }
            LawKind::HeadingDrag => ([-a * (1.0 + (heading - self.shape).cos()) * over, 0.0], 0.0),
            LawKind::FadingTurnResistance => ([0.0; 2], -a * turn / self.turn / (1.0 + square)),
            _ => ([0.0; 2], 0.0),
        }
    }

    /// Factor on the grip of all wheels at a yaw rate.
    pub(crate) fn on_grip(&self, turn: f64) -> f64 {
        match self.kind {
            LawKind::FadingGrip => 1.0 / (1.0 + self.size[0] * (turn / self.turn).powi(2)),
            _ => 1.0,
        }
    }

    /// The rows of a drive with what it does there.
    pub(crate) fn rows(&self, run: &Run, row: f64) -> Vec<LawRow> {
        let rows = run.seen.iter().zip(&run.rows).zip(self.along(&run.seen, row));
        let of = |((m, r), acting): ((&Motion, &Row), Acting)| LawRow {
            body: m.body,
            wheel_speed: m.speed,
            wheel_angle: m.angle,
            torque: r.torque,
            acting,
        };
        rows.map(of).collect()
    }

    /// What it does at each row of a motion.
    fn along(&self, seen: &[Motion], row: f64) -> Vec<Acting> {
        let mut memory = [0.0; 2];
        let at = |m: &Motion| {
            let mut out = Acting::default();
            for side in 0..2 {
                let omega = m.speed[side];
                // Rows are short beside what a memory takes to change.
                memory[side] += row * self.memory_rate(omega, memory[side]);
                let taken = self.friction(side, omega, memory[side]);
                out.torque[side] = -taken.dry * omega.signum() - taken.smooth;
            }
            let [_, _, heading, vx, vy, turn] = m.body;
            (out.force, out.moment) = self.on_body(heading, [vx, vy], turn);
            out.grip = self.on_grip(turn) - 1.0;
            out
        };
        seen.iter().map(at).collect()
    }
}

/// Hides a law and says what was hidden.
pub(crate) fn hide(kind: LawKind, z: &Sizing<'_>, s: &mut Stream, h: &mut Hidden) -> EffectTruth {
    let c = z.robot;
    let sizes = if kind.is_of_drives() {
        [0.06, 0.1, 0.16].map(|share| share * c.torque_scale())
    } else {
        match kind {
            LawKind::FadingGrip => [0.5, 0.9, 1.5],
            LawKind::FadingTurnResistance => [0.1, 0.17, 0.28].map(|share| share * c.mass * GRAVITY * c.half_track),
            _ => [0.03, 0.05, 0.08].map(|share| share * c.mass * GRAVITY),
        }
    };
    let size = z.draw(s, sizes, 0.5);
    let mut e = EffectTruth::new(crate::outsider::ID.to_owned(), z.severity.number());
    e.kind = serde_json::to_value(kind).ok().and_then(|v| v.as_str().map(str::to_owned));
    let of_side = [[1.0, 0.0], [0.0, 1.0], [1.0, 1.0]][if kind.is_of_drives() { s.index(3) } else { 2 }];
    e.side = match of_side {
        [1.0, 0.0] => Some("left".to_owned()),
        [0.0, 1.0] => Some("right".to_owned()),
        _ => None,
    };
    e.magnitude = size;
    // Wheels of all sizes of robots turn with up to ten radians per second or so.
    let omega = s.uniform(1.5, 4.0);
    h.foreign.law = Some(ForeignLaw {
        kind,
        size: of_side.map(|on| on * size),
        omega,
        speed: s.uniform(3.0, 6.0) * c.radius,
        turn: s.uniform(0.5, 1.0),
        shape: match kind {
            LawKind::WarmingFriction => s.uniform(3.0, 9.0),
            LawKind::WideHysteresis => s.uniform(0.4, 1.5),
            LawKind::ResonantFriction => s.uniform(3.0, 7.0),
            _ => s.uniform(-PI, PI),
        },
    });
    e
}

#[cfg(test)]
mod tests {
    use super::*;

    fn law(kind: LawKind, shape: f64) -> ForeignLaw {
        ForeignLaw { kind, size: [2.0, 0.0], omega: 2.0, speed: 0.5, turn: 0.5, shape }
    }

    fn rows(omega: f64, count: usize) -> Vec<Motion> {
        vec![Motion { body: [0.0, 0.0, 0.3, 0.5, 0.0, 0.5], speed: [omega; 2], ..Motion::default() }; count]
    }

    #[test]
    fn laws_do_what_their_formulas_say() {
        let at = |kind: LawKind, shape: f64, omega: f64| law(kind, shape).along(&rows(omega, 1), 1e-6)[0];
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-4, "{a} {b}");
        close(at(LawKind::ArctanDrag, 0.0, 2.0).torque[0], -1.0);
        close(at(LawKind::ArctanDrag, 0.0, 2.0).torque[1], 0.0);
        close(at(LawKind::FadingFriction, 0.0, -2.0).torque[0], 1.0);
        close(at(LawKind::ResonantFriction, 5.0, 5.0).torque[0], -2.0);
        close(at(LawKind::TurnDrag, 0.0, 0.0).force[0], -2.0);
        close(at(LawKind::LogarithmicDrag, 0.0, 0.0).force[0], -2.0 * std::f64::consts::LN_2);
        close(at(LawKind::HeadingDrag, 0.3, 0.0).force[0], -4.0);
        close(at(LawKind::FadingTurnResistance, 0.0, 0.0).moment, -1.0);
        close(at(LawKind::FadingGrip, 0.0, 0.0).grip, -2.0 / 3.0);
    }

    #[test]
    fn memories_settle_and_a_hysteresis_turns_with_the_wheel() {
        let warm = law(LawKind::WarmingFriction, 2.0).along(&rows(4.0, 1500), 0.01);
        assert!(warm[10].torque[0] > -0.5 && (warm[1499].torque[0] + 4.0).abs() < 0.01, "{:?}", warm[1499]);
        let mut there_and_back = rows(2.0, 300);
        there_and_back.extend(rows(-2.0, 300));
        let turned = law(LawKind::WideHysteresis, 0.5).along(&there_and_back, 0.01);
        assert!((turned[299].torque[0] + 2.0).abs() < 0.01 && (turned[599].torque[0] - 2.0).abs() < 0.01);
        assert!(turned[301].torque[0] < -1.5, "it keeps pulling for a while");
    }
}
