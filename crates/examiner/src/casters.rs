//! Two driven wheels and casters: where they stand, how a caster swings, and what loads it.

use crate::plant::{ANGLE, Plant, State, VELOCITY, YAW_RATE};
use crate::random::Stream;
use crate::robot::GRAVITY;

/// Speed of a caster's wheel over which its resistance changes sign, m/s.
const ROLLS: f64 = 0.02;
/// Rate of swinging over which the friction of its pivot changes sign, rad/s.
const SWINGS: f64 = 0.5;

/// The casters of a robot; one counts as two at one place, each under half of the load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Casters {
    /// Pivots, ahead of and left of the middle of the driven axle, m.
    pub places: [[f64; 2]; 2],
    /// From the pivot back to where the wheel touches, m.
    pub trail: f64,
    /// Rolling resistance over load.
    pub rolling: f64,
    /// Dry friction of a pivot, N m.
    pub swivel: f64,
}

impl Casters {
    /// Casters for a robot of this size: one or two behind, one ahead, or one ahead and one behind.
    pub(crate) fn draw(s: &mut Stream, half_track: f64, radius: f64, mass: f64) -> Self {
        let far = half_track * s.uniform(1.1, 1.5);
        let aside = half_track * s.uniform(0.5, 0.8);
        Self {
            places: match s.index(4) {
                0 => [[-far, 0.0]; 2],
                1 => [[far, 0.0]; 2],
                2 => [[-far, aside], [-far, -aside]],
                _ => [[far, 0.0], [-far, 0.0]],
            },
            trail: radius * s.uniform(0.25, 0.45),
            rolling: s.uniform(0.015, 0.04),
            swivel: 2e-4 * mass * GRAVITY * radius,
        }
    }

    /// Where the centre of mass lies ahead of the axle: towards the casters, so far that they bear a quarter or so.
    pub(crate) fn centre(&self, s: &mut Stream) -> f64 {
        s.uniform(0.2, 0.35) * 0.5 * (self.places[0][0] + self.places[1][0])
    }

    /// Where their wheels touch the ground now.
    fn touching(&self, s: &State) -> [[f64; 2]; 2] {
        [0, 1].map(|k| {
            let ([x, y], (sin, cos)) = (self.places[k], s[ANGLE + 2 * k].sin_cos());
            [x - self.trail * cos, y - self.trail * sin]
        })
    }
}

/// What a caster does to the body.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Push {
    /// Force in body axes, N.
    pub force: [f64; 2],
    /// Where the wheel touches, in body axes, m.
    pub at: [f64; 2],
    /// Rate of the caster's angle, rad/s.
    pub swing: f64,
}

impl Plant {
    /// Loads of caster, driven wheel, caster, driven wheel (left, then right), as on equal springs under a body that leans
    /// by the specific force `felt`; `centre` is that of the mass.
    pub(crate) fn loads_on_casters(&self, casters: &Casters, s: &State, centre: [f64; 2], felt: [f64; 2]) -> [f64; 4] {
        let [first, second] = casters.touching(s);
        let wheels = [1, 3].map(|i| [self.at[0][i], self.at[1][i]]);
        let at = [first, wheels[0], second, wheels[1]].map(|[x, y]| [x - centre[0], y - centre[1]]);
        let sum = |f: &dyn Fn([f64; 2]) -> f64| at.iter().map(|p| f(*p)).sum::<f64>();
        let (x, y) = (sum(&|p| p[0]), sum(&|p| p[1]));
        let (xx, xy, yy) = (sum(&|p| p[0] * p[0]), sum(&|p| p[0] * p[1]), sum(&|p| p[1] * p[1]));

        // 4 a + x b + y c = m g; x a + xx b + xy c = −m h fx; y a + xy b + yy c = −m h fy, by Cramer's rule.
        let rows = [[4.0, x, y], [x, xx, xy], [y, xy, yy]];
        let right = [GRAVITY, -self.height * felt[0], -self.height * felt[1]].map(|v| self.mass * v);
        let whole = determinant(rows);
        let [a, b, c] = [0, 1, 2].map(|k| {
            let mut rows = rows;
            for (row, value) in rows.iter_mut().zip(right) {
                row[k] = value;
            }
            determinant(rows) / whole
        });
        at.map(|[px, py]| (a + b * px + c * py).max(0.0))
    }

    /// What a caster under `load` does, with `added` to its resistance.
    pub(crate) fn push(&self, casters: &Casters, k: usize, s: &State, load: f64, added: f64) -> Push {
        let ([x, y], (sin, cos)) = (casters.places[k], s[ANGLE + 2 * k].sin_cos());
        let w = s[YAW_RATE];
        let [vx, vy] = [s[VELOCITY] - w * y, s[VELOCITY + 1] + w * x];
        let (along, across) = (vx * cos + vy * sin, vy * cos - vx * sin);
        // Its wheel does not slide sideways.
        let swing = across / casters.trail - w;

        let resistance = (casters.rolling + self.hidden.caster_drag + added).max(0.0) * load * (along / ROLLS).tanh();
        let sideways = casters.swivel * (swing / SWINGS).tanh() / casters.trail;
        Push {
            force: [-resistance * cos + sideways * sin, -resistance * sin - sideways * cos],
            at: casters.touching(s)[k],
            swing,
        }
    }
}

fn determinant([a, b, c]: [[f64; 3]; 3]) -> f64 {
    a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
}

#[cfg(test)]
mod tests {
    use crate::hidden::Hidden;
    use crate::plant::{ANGLE, Moment, N, Plant, SPEED};
    use crate::robot::{Constants, GRAVITY};
    use crate::{RobotClass, TyreLaw, integrate};

    fn robot(seed: u64) -> Constants {
        Constants::nominal(seed, RobotClass::Medium, TyreLaw::Brush).on_casters(seed)
    }

    #[test]
    fn loads_bear_the_weight_at_its_place_however_the_casters_stand() {
        for seed in 0..12 {
            let c = robot(seed);
            let casters = c.casters.expect("casters");
            let plant = Plant::new(&c, &Hidden::default());
            let mut s = [0.0; N];
            (s[ANGLE], s[ANGLE + 2]) = (0.3 * seed as f64, -1.0);
            let loads = plant.loads_on_casters(&casters, &s, c.centre, [0.0; 2]);
            let touching = casters.touching(&s);
            let x = loads[0] * touching[0][0] + loads[2] * touching[1][0];
            let weight = c.mass * GRAVITY;
            assert!((loads.iter().sum::<f64>() / weight - 1.0).abs() < 1e-9, "{loads:?}");
            assert!((x / weight - c.centre[0]).abs() < 1e-9, "{loads:?} at {touching:?}");
        }
    }

    #[test]
    fn a_robot_that_reverses_swings_its_casters_round() {
        let c = robot(0);
        let plant = Plant::new(&c, &Hidden::default());
        let mut s = plant.settled([0.0, 0.0, 0.0, 0.5, 0.0, 0.05], [0.5 / c.radius; 2], [0.0; 2]);
        let ahead = s[ANGLE].cos();
        let m = Moment { torque: [-0.25 * c.torque_scale(), -0.2 * c.torque_scale()], ..Moment::default() };
        for _ in 0..16_000 {
            integrate::advance(&plant, &mut s, &m, integrate::STEP);
        }
        assert!(ahead > 0.9 && s[ANGLE].cos() < -0.5, "{} {}", ahead, s[ANGLE].cos());
        assert!(s[SPEED + 1] < 0.0 && s[3] < 0.0);
    }
}
