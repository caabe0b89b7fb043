//! Robots side by side, for [`Rollout::run_vectorised`](super::Rollout::run_vectorised): one lane each.

use std::array::from_fn;

use robot_model::presence::{Disc, Presence};
use robot_model::{Active, Effect, Lanes, Plant, Robot, Scalar, State, effects};

use super::{Input, Start};

/// Robots as one, all on the chassis of the first.
pub fn robots<const N: usize>(robots: [&Robot<f64>; N]) -> Robot<Lanes<N>> {
    Robot::assemble(robots[0].chassis, |constant| Lanes(robots.map(constant)))
}

/// One effect at values and with a presence for each lane; `None` when the catalogue does not hold it.
///
/// Side, and whether there is a disc at all, are those of the first lane; a lane without a disc gets the first one's.
pub fn effect<const N: usize>(
    effect: &dyn Effect<f64>,
    values: [&[f64]; N],
    presence: [Presence<f64>; N],
) -> Option<Active<Lanes<N>>> {
    let id = effect.spec().id;
    let law = effects::catalogue::<Lanes<N>>().into_iter().find(|e| e.spec().id == id)?;
    Some(effect_of(law, values, presence))
}

/// The same of an effect that is given for lanes, whether the catalogue holds it or not.
pub fn effect_of<const N: usize>(
    law: &'static dyn Effect<Lanes<N>>,
    values: [&[f64]; N],
    presence: [Presence<f64>; N],
) -> Active<Lanes<N>> {
    let values: Vec<Lanes<N>> = (0..values[0].len()).map(|v| Lanes(values.map(|lane| lane[v]))).collect();

    let disc = presence[0].disc.map(|first| {
        let of = |read: fn(&Disc<f64>) -> f64| Lanes(presence.map(|p| read(p.disc.as_ref().unwrap_or(&first))));
        Disc { centre: [of(|d| d.centre[0]), of(|d| d.centre[1])], radius: of(|d| d.radius) }
    });
    let presence = Presence {
        from: Lanes(presence.map(|p| p.from)),
        until: Lanes(presence.map(|p| p.until)),
        disc,
        side: presence[0].side,
    };
    Active::new(law, &values, presence)
}

/// States as one.
pub fn states<const N: usize>(states: [&State<f64>; N]) -> State<Lanes<N>> {
    let of = |read: &dyn Fn(&State<f64>) -> f64| Lanes(states.map(read));
    let two = |read: fn(&State<f64>) -> [f64; 2]| [0, 1].map(|i| of(&|s| read(s)[i]));
    State {
        time: of(&|s| s.time),
        position: two(|s| s.position),
        heading: two(|s| s.heading),
        velocity: two(|s| s.velocity),
        yaw_rate: of(&|s| s.yaw_rate),
        wheel_speed: two(|s| s.wheel_speed),
        passive: two(|s| s.passive),
        wheel_angle: two(|s| s.wheel_angle),
        torque: two(|s| s.torque),
        lagged: two(|s| s.lagged),
        specific: two(|s| s.specific),
        rate: [0, 1, 2].map(|i| of(&|s| s.rate[i])),
        needed: two(|s| s.needed),
    }
}

/// Measured motions as one state, each at its time in s; the drives are at rest.
pub fn starts<const N: usize>(plant: &Plant<'_, Lanes<N>>, starts: [&Start; N], time: [f64; N]) -> State<Lanes<N>> {
    let each: [State<f64>; N] = from_fn(|i| State { time: time[i], ..starts[i].state() });
    let mut s = states(each.each_ref());
    let velocity = s.velocity;
    plant.set_velocity(&mut s, velocity);
    s
}

/// Both sides' values of each lane's own series at its own place.
#[inline(always)]
pub fn pick<const N: usize>(series: &[&[[f64; 2]]; N], at: impl Fn(usize) -> usize) -> [Lanes<N>; 2] {
    let mut out = [Lanes::zero(); 2];
    for i in 0..N {
        let [left, right] = series[i][at(i)];
        out[0].0[i] = left;
        out[1].0[i] = right;
    }
    out
}

/// Torque commands of each lane, held over its rows, with delays that are rounded to whole steps.
///
/// Unlike [`Hold`](super::Hold), the first command counts as held for long before the first row. Series that end sooner
/// go on with their last command.
pub struct Held<'a, const N: usize> {
    torque: [&'a [[f64; 2]]; N],
    late: [usize; N],
    substeps: usize,
    now: [Lanes<N>; 2],
}

impl<'a, const N: usize> Held<'a, N> {
    /// Commands of each side, N m, at least one in each lane; `late` steps pass before they reach the drive.
    pub fn new(torque: [&'a [[f64; 2]]; N], late: [usize; N], substeps: usize) -> Self {
        Self { torque, late, substeps, now: [Lanes::zero(); 2] }
    }
}

impl<const N: usize> Input<Lanes<N>> for Held<'_, N> {
    #[inline(always)]
    fn advance(&mut self, row: usize, step: usize, plant: &Plant<'_, Lanes<N>>, s: &mut State<Lanes<N>>) {
        // Without a delay a command holds for the whole row.
        if step == 0 || self.late != [0; N] {
            let k = row * self.substeps + step;
            self.now = pick(
                &self.torque,
                #[inline(always)]
                |i| (k.saturating_sub(self.late[i]) / self.substeps).min(self.torque[i].len() - 1),
            );
        }

        plant.step_drive(s, self.now);
        plant.step_under(s, plant.delivered(s));
    }
}
