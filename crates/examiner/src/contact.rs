//! The four contacts of the tyres with the ground, worked out side by side.

use crate::hidden::Hidden;
use crate::robot::Constants;
use crate::tyre::TyreTable;

/// Seconds that couple the force to the rate of deflection: damping of the carcass.
const CARCASS_TIME: f64 = 0.004;

/// Tyres of a robot.
#[derive(Debug, Clone)]
pub(crate) struct Contact {
    table: TyreTable,
    relaxation: f64,
    per_relaxation: f64,
    /// One over the longest deflection of a carcass.
    per_reach: f64,
    /// One over the slip at the peak, along and across.
    per_peak: [f64; 2],
    lateral: f64,
    grain: f64,
    /// Whether friction is bounded along and across apart.
    boxed: bool,
    /// Direction of the grain of the ground, world axes.
    grain_along: [f64; 2],
}

/// Forces on the robot and rates of deflection, along and across, by wheel.
pub(crate) struct Tyres {
    pub force: [[f64; 4]; 2],
    pub rates: [[f64; 4]; 2],
}

impl Contact {
    /// The tyres of a robot on the ground of a case.
    pub(crate) fn new(c: &Constants, hidden: &Hidden) -> Self {
        let (sin, cos) = hidden.foreign.grain_direction.sin_cos();
        Self {
            table: TyreTable::new(c.law, c.sliding_loss),
            relaxation: c.relaxation,
            per_relaxation: 1.0 / c.relaxation,
            per_reach: 1.0 / (1.5 * c.relaxation),
            per_peak: [1.0 / c.peak_slip, 1.0 / (c.peak_slip * c.side_slip)],
            lateral: c.lateral * (1.0 + hidden.lateral),
            grain: hidden.foreign.grain,
            boxed: hidden.foreign.friction_box,
            grain_along: [cos, sin],
        }
    }

    /// Deflection of a carcass at a steady slip velocity.
    pub(crate) fn steady(&self, slip: [f64; 2], rolled: f64) -> [f64; 2] {
        let speed = slip[0].hypot(slip[1]);
        let renew = (rolled + 0.01) * self.per_relaxation + speed * self.per_reach;
        slip.map(|s| s / renew)
    }

    /// Forces from deflections, slip velocities, rolling speeds and grips (adhesion times load).
    ///
    /// Rolling renews a carcass over the relaxation length, sliding bounds its deflection, so that
    /// the steady slip is exactly slip velocity over rolling speed, at rest too.
    #[inline]
    pub(crate) fn forces(
        &self,
        deflection: [[f64; 4]; 2],
        slip: [[f64; 4]; 2],
        rolled: [f64; 4],
        grip: [f64; 4],
        [sin, cos]: [f64; 2],
    ) -> Tyres {
        let mut rates = [[0.0; 4]; 2];
        let mut x = [0.0; 4];
        let mut y = [0.0; 4];
        let mut rho = [0.0; 4];
        for i in 0..4 {
            let speed = (slip[0][i] * slip[0][i] + slip[1][i] * slip[1][i]).sqrt();
            let renew = rolled[i] * self.per_relaxation + speed * self.per_reach;
            rates[0][i] = slip[0][i] - deflection[0][i] * renew;
            rates[1][i] = slip[1][i] - deflection[1][i] * renew;
            let along = deflection[0][i] + CARCASS_TIME * rates[0][i];
            let across = deflection[1][i] + CARCASS_TIME * rates[1][i];
            let long = (along * along + across * across).sqrt();
            let per_left = 1.0 / ((1.0 - long * self.per_reach).max(0.02) * self.relaxation);
            x[i] = along * per_left * self.per_peak[0];
            y[i] = across * per_left * self.per_peak[1];
            rho[i] = (x[i] * x[i] + y[i] * y[i]).sqrt();
        }
        let mut gain: [f64; 4] = std::array::from_fn(|i| grip[i] * self.table.gain(rho[i]));
        if self.grain > 0.0 {
            for i in 0..4 {
                let world = [x[i] * cos - y[i] * sin, x[i] * sin + y[i] * cos];
                let with = world[0] * self.grain_along[0] + world[1] * self.grain_along[1];
                let square = x[i] * x[i] + y[i] * y[i];
                gain[i] *= 1.0 - self.grain * with * with / square.max(1e-12);
            }
        }
        if self.boxed {
            let alone = |share: f64, grip: f64| grip * self.table.gain(share.abs()) * share;
            let along = std::array::from_fn(|i| alone(x[i], grip[i]));
            let across = std::array::from_fn(|i| alone(y[i], grip[i]) * self.lateral);
            return Tyres { force: [along, across], rates };
        }
        let force = [std::array::from_fn(|i| gain[i] * x[i]), std::array::from_fn(|i| gain[i] * y[i] * self.lateral)];
        Tyres { force, rates }
    }
}
