//! Elements of a response as causes, with probabilities, sizes and intervals.

use std::collections::BTreeMap;
use verdict::{Cause, Earned, Element, Estimate, Parameter, ResponseConstant};

use crate::identify::{Identified, Simulated};
use crate::search::{Evidence, Part, Trial, sigmas};
use inference::evidence::{logistic, none_of};
use inference::robust::NINETY;

pub(crate) fn earned((element, e): &(Element, Evidence)) -> Earned {
    Earned { element: *element, rise: e.rise, standard_error: e.standard_error, probability: probability(e) }
}

fn probability(e: &Evidence) -> f64 {
    logistic(e.score)
}

/// Fitted constants of a part with their intervals.
pub(crate) fn parameters<P: Part>(part: &P, t: &Trial<P::Law>, simulated: &[f64]) -> Vec<Parameter> {
    let sigmas = sigmas(part, t);
    let belongs = |k: usize| t.elements.iter().copied().find(|e| part.free(t.model.law, *e).contains(&k));
    let with_sigma = t.free.iter().zip(sigmas);
    with_sigma
        .filter_map(|(&k, sigma)| {
            let c: &ResponseConstant = &part.constants()[k];
            let value = t.model.x[k];
            Some(Parameter {
                element: belongs(k)?,
                id: c.id.into(),
                unit: c.unit.into(),
                value,
                half_width: sigma.map(|s| NINETY * s),
                simulated: Some(simulated[k]).filter(|s| s.is_finite()),
                at_bound: value <= c.bounds[0] || value >= c.bounds[1],
            })
        })
        .collect()
}

/// A cause, what it is called, its elements in causal order.
const CAUSES: [(&str, &str, &[Element]); 9] = [
    (
        "drive_command",
        "the drive's controller does not hold the command: gains, limits, ramps",
        &[
            Element::Gain,
            Element::TurnLimit,
            Element::ForwardLimit,
            Element::WheelLimit,
            Element::Ramp,
            Element::SideGain,
        ],
    ),
    ("transport_delay", "dead time from command to wheel", &[Element::DeadTime]),
    ("motor_lag", "lag of the wheels' speed control", &[Element::Lag]),
    ("effective_track", "effective track: the body turns otherwise than the track says", &[Element::Track]),
    ("rolling_radius", "rolling radius, or a longitudinal slip that is always there", &[Element::Radius]),
    ("turning_slip", "forward speed lost in turns", &[Element::TurnSlip]),
    ("turn_centre_offset", "centre of rotation away from the pose sensor", &[Element::Offset]),
    ("body_lag", "body (or pose sensor) late behind the wheels", &[Element::BodyLag]),
    ("wheel_radius_mismatch", "wheels of one side of another radius", &[Element::SideRadius]),
];
/// Causes below this probability are not listed: what left-out windows say nothing about keeps the 0.05 of its prior.
const LISTED: f64 = 0.1;
/// Beyond this, probabilities do not order causes; the way from command to ground does.
const SURE: f64 = 0.999;

/// Causes by probability; of those that are sure, the one nearer to the command first.
pub(crate) fn ranked(found: &Identified, parameters: &[Parameter], off: f64, off_error: f64, track: f64) -> Vec<Cause> {
    let mut out = Vec::new();
    let mut present = Vec::new();
    for (effect, name, elements) in CAUSES {
        let own = found.evidence.iter().filter(|(e, _)| elements.contains(e));
        let p = own.map(|(_, e)| probability(e)).fold(0.0, f64::max);
        present.push(p);
        if p < LISTED {
            continue;
        }
        let mut cause = Cause::plain(effect, name, p);
        let of: Vec<&Parameter> = parameters.iter().filter(|q| elements.contains(&q.element)).collect();
        cause.parameters = of.iter().map(|q| (q.id.to_string(), estimate(q))).collect();
        match of.as_slice() {
            [] => {}
            _ if effect == "drive_command" => {
                // The size of a controller that does something else is what the wheels do otherwise.
                (cause.magnitude, cause.sigma, cause.unit) = (Some(off), Some(off_error), "rad/s".into());
            }
            [w, z] if effect == "motor_lag" => {
                // A second-order lag is late by 2 ζ / ω.
                let lag = 2.0 * z.value / w.value;
                let relative = |q: &Parameter| q.half_width.map(|h| h / NINETY / q.value);
                let sigma = relative(w).zip(relative(z)).map(|(a, b)| lag * a.hypot(b));
                (cause.magnitude, cause.sigma, cause.unit) = (Some(lag), sigma, "s".into());
            }
            [q, ..] => {
                let (factor, unit) =
                    if effect == "effective_track" { (track, "m".into()) } else { (1.0, q.unit.clone()) };
                cause.magnitude = Some(factor * q.value);
                cause.sigma = q.half_width.map(|h| factor * h / NINETY);
                cause.unit = unit;
            }
        }
        out.push(cause);
    }
    out.push(Cause::plain("none", "nothing is missing", none_of(present)));
    out.push(Cause::plain("unknown", "something that is not in the catalogue", 0.0));
    out.sort_by(|a, b| b.probability.min(SURE).total_cmp(&a.probability.min(SURE)));
    out
}

fn estimate(p: &Parameter) -> Estimate {
    Estimate { value: p.value, sigma: p.half_width.map(|h| h / NINETY), at_bound: p.at_bound }
}

/// Every fitted constant by name, for the re-tuned constants of the answer.
pub(crate) fn tuning(parameters: &[Parameter]) -> BTreeMap<String, f64> {
    parameters.iter().map(|p| (p.id.to_string(), p.value)).collect()
}

/// What the simulation has for each constant.
pub(crate) fn simulated(base: &Simulated) -> [&[f64]; 2] {
    debug_assert_eq!(
        (base.drive.x.len(), base.ground.x.len()),
        (verdict::DRIVE_CONSTANTS.len(), verdict::GROUND_CONSTANTS.len())
    );
    [&base.drive.x, &base.ground.x]
}
