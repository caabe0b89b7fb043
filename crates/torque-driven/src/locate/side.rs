//! On which side the mismatch sits, and whether a named effect contradicts it.

use crate::channel::{Channel, Channels};
use crate::settings::locate::SETTINGS;
use inference::robust::NINETY_FIVE;
use verdict::{Cause, Finding, ResidualTorque};

/// The side on which the mismatch sits: where the residual torque leaves the references' band, if one side clearly
/// holds most of it; else where the wheel speed's excess does. Motion passes from side to side through the body, torque
/// less so.
pub(crate) fn side(excess: &Channels<f64>, findings: &[Finding], residual: &[ResidualTorque]) -> Option<&'static str> {
    let leaves = |side: &str| residual.iter().any(|t| t.side == side && !t.spans.is_empty());
    let holds = |side: &str| findings.iter().any(|f| f.side.as_deref() == Some(side) && f.significant);
    let clear = SETTINGS.sides.clear;
    let clearly = |[l, r]: [f64; 2], seen: &dyn Fn(&str) -> bool| match () {
        () if l > clear * r && seen("left") => Some("left"),
        () if r > clear * l && seen("right") => Some("right"),
        () => None,
    };
    let torques = ["left", "right"].map(|side| torque(residual, side));
    clearly(torques, &leaves).or_else(|| clearly(Channel::WHEELS.map(|wheel| excess[wheel]), &holds))
}

/// Mean squared residual torque beyond the references' band on a side.
fn torque(all: &[ResidualTorque], side: &str) -> f64 {
    let own = all.iter().filter(|t| t.side == side);
    own.map(|t| {
        let half = 0.5 * (t.band[1] - t.band[0]) / NINETY_FIVE;
        (t.rms * t.rms - half * half).max(0.0)
    })
    .sum()
}

/// What to say when an effect is named on one side while the mismatch sits on the other, by the wheel speeds and by
/// the residual torque.
pub(crate) fn contradiction(named: &[Cause], located: Option<&str>, residual: &[ResidualTorque]) -> Option<String> {
    let located = located?;
    let cause = named.iter().find(|c| c.side.as_deref().is_some_and(|s| s != located))?;
    let named = cause.side.as_deref()?;
    // Forces pass from side to side through the body: the torque must not speak for the named side.
    if torque(residual, named) > torque(residual, located) {
        return None;
    }
    Some(format!(
        "The side is uncertain: {} is named on the {named} side, but the mismatch shows on the \
         {located} side. Do not rely on the side.",
        cause.name.split(':').next().unwrap_or(&cause.name)
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use verdict::TorqueCertificate;

    fn finding(side: &'static str, ratio: f64) -> Finding {
        Finding {
            signal: format!("{side} wheel speed"),
            side: Some(side.into()),
            ratio,
            recording: "run".to_owned(),
            interval: [0.0, 2.0],
            p: 1e-9,
            significant: true,
        }
    }

    fn residual(side: &'static str, rms: f64) -> ResidualTorque {
        let certificate = TorqueCertificate { holds: true, error_energy: 0.0, bound: 1.0, identity: 0.0 };
        let recording = "run".to_owned();
        ResidualTorque {
            recording,
            side: side.into(),
            mean: -rms,
            rms,
            band: [-0.1, 0.1],
            spans: Vec::new(),
            certificate,
        }
    }

    #[test]
    fn an_effect_on_the_wrong_side_is_said_to_contradict() {
        let findings = [finding("left", 3.0), finding("right", 90.0)];
        let excess = |left: f64| {
            Channels::from_fn(|c| match c {
                Channel::LeftWheel => left,
                Channel::RightWheel => 80.0,
                Channel::YawRate => 5.0,
                _ => 0.0,
            })
        };
        let located = side(&excess(2.0), &findings, &[]);
        assert_eq!(located, Some("right"));
        let mut cause = Cause::plain("coulomb_side", "dragging brake on one side: left", 0.9);
        cause.side = Some("left".into());
        let torques = [residual("left", 0.05), residual("right", 0.6)];
        let said = contradiction(std::slice::from_ref(&cause), located, &torques).expect("a contradiction");
        assert!(said.contains("named on the left") && said.contains("shows on the right"), "{said}");
        // The torque speaks for the named side: no contradiction.
        let torques = [residual("left", 0.6), residual("right", 0.05)];
        assert_eq!(contradiction(std::slice::from_ref(&cause), located, &torques), None);
        cause.side = Some("right".into());
        assert_eq!(contradiction(&[cause], located, &torques), None);
        // Excess alike on both sides locates nothing.
        assert_eq!(side(&excess(50.0), &findings, &[]), None);
    }
}
