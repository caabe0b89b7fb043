//! Rolling resistance.

use crate::effect::{Card, Effect, Kind, Parameter, Redundancy, Role, Scale, Situation, Values, Wears, World};
use crate::scalar::Scalar;

/// T = Δf_r N r sign ω at each wheel
pub struct Law;

const CARD: Card = Card {
    id: "rolling_resistance",
    name: "rolling resistance",
    kind: Kind::Physics,
    law: "T = Δf_r N r sign ω at each wheel",
    seen: "Every metre costs more torque, in proportion to the load and whatever the speed.",
    parameters: &[
        Parameter { name: "Δf_r", unit: "-", role: Role::Strength, bounds: [-0.2, 1.0], neutral: 0.0, probes: &[0.03], scale: Scale::Own },
    ],
    signed: false,
    axes: &[],
    wears: Wears { everywhere: true, onset: true, disc: true, side: false },
    redundancy: Redundancy::None,
    interest: 0.01,
    rarity: 0.0,
    revealed_by: "straight drives both ways and coasting down",
    resembles: "grade and constant_pull in one-way drives; Coulomb friction at constant load",
    source: "Hendzel & Trojnacki 2014, a6 to a8 of Eq. 8",
};

impl<T: Scalar> Effect<T> for Law {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn act(&self, v: &Values<T>, _at: &Situation<T>, w: &mut World<T>) {
        for f in &mut w.rolling {
            *f += v[0];
        }
    }
}
