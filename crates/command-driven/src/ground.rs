//! Wheel to body: rolling radius, effective track, centre of rotation, what turns cost, body lag.
//!
//! v = ρ r (ω_l + ω_r) / 2 · exp(−c ψ̇²) or · exp(−c |ψ̇|), ψ̇ = ρ r (ω_r − ω_l) / (χ b), lateral speed a ψ̇ at the pose sensor, with nominal
//! radius r and track b. Effective track and centre of rotation: Mandow et al. 2007, "Experimental kinematics for
//! wheeled skid-steer mobile robots". The speed that turning costs is empirical: of six laws of one constant (linear,
//! rational, quadratic, exponential, by curvature, root) the one with the square forecast left-out training windows of both
//! open robots best; the one in proportion is its rival. Neither can reverse the motion.

use crate::run::{STEP, WINDOW};
use crate::search::{Part, Timed};
use crate::settings::{GroundStarts, SETTINGS};
use crate::windows::{Window, Windows};
use verdict::{Element, GROUND_CONSTANTS, ResponseConstant};

const STARTS: GroundStarts = SETTINGS.ground_starts;

pub(crate) const RADIUS: usize = 0;
pub(crate) const TRACK: usize = 1;
pub(crate) const OFFSET: usize = 2;
pub(crate) const TURN_SLIP: usize = 3;
pub(crate) const BODY_LAG: usize = 4;
pub(crate) const SIDE_RADIUS: usize = 5;
pub(crate) const TURN_SLIP_LINEAR: usize = 6;

/// How the forward speed that turning costs grows with the yaw rate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum TurnSlip {
    /// exp(−c ψ̇²).
    #[default]
    Squared,
    /// exp(−c |ψ̇|).
    Linear,
}

impl TurnSlip {
    /// Both laws.
    pub(crate) const ALL: [Self; 2] = [Self::Squared, Self::Linear];

    /// The law of which these constants are.
    pub(crate) fn of(x: &[f64]) -> Self {
        if x[TURN_SLIP_LINEAR] > 0.0 { Self::Linear } else { Self::Squared }
    }
}

/// "The body rolls without slip on the nominal track."
pub(crate) fn neutral() -> Vec<f64> {
    GROUND_CONSTANTS.iter().map(|c| c.neutral).collect()
}

/// The fit of the body's motion to given wheel speeds.
pub(crate) struct GroundPart<'a> {
    windows: &'a Windows,
    /// Wheel speeds of every piece: measured ones, or forecasts.
    wheels: Vec<Vec<[f64; 2]>>,
    /// Nominal wheel radius and track, m.
    nominal: [f64; 2],
}

/// Pose in the frame of the window's first row: x, y (m), heading (rad).
pub(crate) type Poses = Vec<[f64; 3]>;

impl<'a> GroundPart<'a> {
    pub(crate) fn new(windows: &'a Windows, wheels: Vec<Vec<[f64; 2]>>, nominal: [f64; 2]) -> Self {
        Self { windows, wheels, nominal }
    }

    /// From measured wheel speeds.
    pub(crate) fn measured(windows: &'a Windows, nominal: [f64; 2]) -> Self {
        Self::new(windows, windows.pieces.iter().map(|p| p.wheel.clone()).collect(), nominal)
    }

    /// Poses of every window.
    pub(crate) fn poses(&self, x: &[f64]) -> Vec<Poses> {
        let twists: Vec<Vec<[f64; 2]>> = self.wheels.iter().map(|w| twist(x, self.nominal, w)).collect();
        self.windows.list.iter().map(|w| poses(x, &twists[w.piece][w.start..w.start + WINDOW])).collect()
    }
}

impl Timed<TurnSlip> {
    /// Poses of every window, each by the model that held in it.
    pub(crate) fn poses(&self, part: &GroundPart<'_>) -> Vec<Poses> {
        let mut out = part.poses(&self.model.x);
        if let Some((before, early)) = &self.early {
            let then = part.poses(&before.x);
            out.iter_mut().zip(then).zip(early).filter(|(_, early)| **early).for_each(|((p, then), _)| *p = then);
        }
        out
    }
}

/// Forward speed (m/s) and yaw rate (rad/s) of the body.
pub(crate) fn twist(x: &[f64], [radius, track]: [f64; 2], wheels: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let keep = if x[BODY_LAG] > 0.0 { (-STEP / x[BODY_LAG]).exp() } else { 0.0 };
    let mut late: Option<[f64; 2]> = None;
    let rolls = |[l, r]: [f64; 2]| {
        let (l, r) = (l * (1.0 + x[SIDE_RADIUS]), r * (1.0 - x[SIDE_RADIUS]));
        let yaw_rate = x[RADIUS] * radius * (r - l) / (x[TRACK] * track);
        let lost = (x[TURN_SLIP] * yaw_rate.abs() + x[TURN_SLIP_LINEAR]) * yaw_rate.abs();
        [x[RADIUS] * radius * 0.5 * (l + r) * (-lost).exp(), yaw_rate]
    };
    wheels
        .iter()
        .map(|w| {
            let now = rolls(*w);
            let was = late.unwrap_or(now);
            *late.insert([0, 1].map(|k| now[k] + keep * (was[k] - now[k])))
        })
        .collect()
}

/// Poses along a drive at these wheel speeds.
pub(crate) fn driven(x: &[f64], nominal: [f64; 2], wheels: &[[f64; 2]]) -> Poses {
    poses(x, &twist(x, nominal, wheels))
}

/// Poses by the trapezoidal rule.
fn poses(x: &[f64], twists: &[[f64; 2]]) -> Poses {
    let velocity = |[v, w]: [f64; 2], heading: f64| {
        let (sin, cos) = heading.sin_cos();
        let side = x[OFFSET] * w;
        [v * cos - side * sin, v * sin + side * cos]
    };
    let mut out = vec![[0.0; 3]];
    let mut pose = [0.0; 3];
    let mut last = velocity(twists[0], 0.0);
    for pair in twists.windows(2) {
        pose[2] += 0.5 * STEP * (pair[0][1] + pair[1][1]);
        let now = velocity(pair[1], pose[2]);
        for k in 0..2 {
            pose[k] += 0.5 * STEP * (last[k] + now[k]);
        }
        last = now;
        out.push(pose);
    }
    out
}

/// Errors of a forecast window in x, y (m) and heading (rad); zeros where nothing was recorded.
pub(crate) fn misses(windows: &Windows, w: &Window, forecast: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let piece = &windows.pieces[w.piece];
    let rows = w.start..w.start + WINDOW;
    let headings = piece.heading.as_ref().map(|h| &h[rows.clone()]);
    let positions = piece.position.as_ref().map(|p| &p[rows]);
    (0..WINDOW)
        .map(|i| {
            let mut out = [0.0; 3];
            if let Some(h) = headings {
                out[2] = forecast[i][2] - (h[i] - h[0]);
                if let Some(p) = positions {
                    let (sin, cos) = h[0].sin_cos();
                    let [x, y] = [p[i][0] - p[0][0], p[i][1] - p[0][1]];
                    out[0] = forecast[i][0] - (cos * x + sin * y);
                    out[1] = forecast[i][1] - (cos * y - sin * x);
                }
            }
            out
        })
        .collect()
}

impl Part for GroundPart<'_> {
    type Law = TurnSlip;

    fn constants(&self) -> &[ResponseConstant] {
        &GROUND_CONSTANTS
    }

    fn windows(&self) -> &Windows {
        self.windows
    }

    fn residuals(&self, _: TurnSlip, x: &[f64]) -> Vec<f64> {
        let poses = self.poses(x);
        let all = self.windows.list.iter().zip(&poses).flat_map(|(w, p)| misses(self.windows, w, p));
        all.flat_map(|m| m.map(|e| e / SETTINGS.residuals.pose)).collect()
    }

    fn free(&self, law: TurnSlip, element: Element) -> Vec<usize> {
        match element {
            Element::Radius => vec![RADIUS],
            Element::Track => vec![TRACK],
            Element::Offset => vec![OFFSET],
            Element::TurnSlip if law == TurnSlip::Linear => vec![TURN_SLIP_LINEAR],
            Element::TurnSlip => vec![TURN_SLIP],
            Element::BodyLag => vec![BODY_LAG],
            Element::SideRadius => vec![SIDE_RADIUS],
            _ => vec![],
        }
    }

    fn restrict(&self, law: TurnSlip, base: TurnSlip, elements: &[Element]) -> TurnSlip {
        if elements.contains(&Element::TurnSlip) { law } else { base }
    }

    fn guess(&self, constant: usize) -> f64 {
        match constant {
            TRACK => STARTS.track,
            TURN_SLIP | TURN_SLIP_LINEAR => STARTS.turn_slip,
            BODY_LAG => STARTS.body_lag,
            _ => GROUND_CONSTANTS[constant].neutral,
        }
    }

    fn starts(&self) -> (usize, &'static [f64]) {
        (TRACK, &STARTS.tracks)
    }
}
