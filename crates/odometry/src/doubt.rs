//! Causes that evidence names and that explain little.

use catalogue::odometry::{CORNERING_SLIP, SLIP_WITH_SPEED, SLIP_WITH_TURNING};
use hierarchical_fit::{Cause, Evidence, Named, Prior, named_as};
use nalgebra::DVector;

use crate::fit::{Fit, scatter};
use crate::said::share;
use crate::settings::SETTINGS;
use crate::windows::Data;

/// The answer without causes that grow with rate, speed or acceleration, where it leaves nearly as much: such laws stand for each other,
/// and a little for everything that windows get wrong alike (counts that are lost, a floor, what a gyro gets wrong), which evidence
/// takes for noise of many windows. `None` where there are none, or where they show.
pub(crate) fn without_what_little_shows(
    data: &Data<'_>,
    (prior, fit): (&Prior, &Fit),
    causes: &[Cause],
    named: &Named,
) -> Option<Named> {
    let rules = SETTINGS.doubt;
    let grows = |cause: usize| {
        [&SLIP_WITH_TURNING, &SLIP_WITH_SPEED, &CORNERING_SLIP].into_iter().any(|spec| *spec == *causes[cause].spec)
    };
    let (doubted, rest): (Vec<_>, Vec<_>) = named.chosen.iter().partition(|w| grows(w.cause));
    if doubted.is_empty() {
        return None;
    }
    let rest: Vec<usize> = rest.iter().map(|w| w.cause).collect();
    let evidence = Evidence::new(&fit.theta, &fit.sessions, &scatter(data, fit.factors), &prior.mean)?;
    let mut out = named_as(&evidence, &prior.covariance, causes, &rest)?;
    let [(with, of_motion_with), (without, of_motion_without)] =
        [&named.posterior.mean, &out.posterior.mean].map(|mean: &DVector<f64>| share(data, mean));
    let taken = (of_motion_without.powi(2) - of_motion_with.powi(2)).max(0.0).sqrt();
    if with < rules.leaves * without && taken > rules.least {
        return None;
    }

    out.others.clone_from(&named.others);
    out.others.extend(doubted.iter().map(|w| (w.cause, w.probability.min(rules.listed))));
    out.others.sort_by(|a, b| b.1.total_cmp(&a.1));
    if out.chosen.is_empty() {
        out.posterior = out.retuned.clone();
        out.rival = None;
    }
    Some(out)
}
