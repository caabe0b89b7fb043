//! Drives with a known load, for tests.

use inference::Options;
use robot_model::Robot;
use robot_model::paper::Parameters;
use robot_model::tunable::tunables;
use verdict::{Diagnosis, Load, Quantity};

use crate::BodyRates;
use crate::clock::Alignment;
use crate::run::SpeedRun;
use crate::{SteadyCase, diagnose_steady};

/// Torque of the robot's weight at a wheel's radius, N m, and the usual straight load, N m.
pub(crate) const WEIGHT: f64 = 121.5;
pub(crate) const STRAIGHT: f64 = 11.0;
const RATE: f64 = 6.5;
const RATE_STEP: f64 = 0.1;

/// A part of a drive: speeds of the sides, m/s; how long, s; slope uphill along the body, degrees; straight load and
/// scrub couple, N m; share of its yaw rate that the body takes; what each side reads of its torque.
#[derive(Clone, Copy)]
pub(crate) struct Leg {
    pub(crate) speed: [f64; 2],
    pub(crate) seconds: f64,
    pub(crate) slope: f64,
    pub(crate) straight: f64,
    pub(crate) scrub: f64,
    pub(crate) turned: f64,
    pub(crate) sides: [f64; 2],
}

impl Leg {
    pub(crate) const fn straight(seconds: f64) -> Self {
        Self { speed: [0.24, 0.24], seconds, slope: 0.0, straight: STRAIGHT, scrub: 20.0, turned: 1.0, sides: [1.0; 2] }
    }

    pub(crate) const fn turn(seconds: f64) -> Self {
        Self { speed: [0.08, 0.24], ..Self::straight(seconds) }
    }

    /// A turn to the right.
    pub(crate) const fn right(seconds: f64) -> Self {
        Self { speed: [0.24, 0.08], ..Self::straight(seconds) }
    }

    pub(crate) const fn slope(self, slope: f64) -> Self {
        Self { slope, ..self }
    }
}

/// What a Husky without signs would have recorded; with roll and pitch rates if `gyro`.
pub(crate) fn drive(legs: &[Leg], gyro: bool) -> SpeedRun {
    const DEAD_BAND: f64 = 1.68;
    const TRACK: f64 = 0.77;
    let rows: Vec<Leg> =
        legs.iter().flat_map(|leg| std::iter::repeat_n(*leg, (leg.seconds * RATE).round() as usize)).collect();
    let time: Vec<f64> = (0..rows.len()).map(|i| i as f64 / RATE).collect();
    // A repeating scatter: no random numbers, no lucky draw.
    let scatter = |i: usize| [0.8, -1.1, 0.4, -0.1, 0.9, -0.9][i % 6];
    let torque = |side: usize| -> Vec<f64> {
        rows.iter()
            .enumerate()
            .map(|(i, leg)| {
                let turn = (leg.speed[1] - leg.speed[0]).signum() * f64::from(leg.speed[1] != leg.speed[0]);
                let way = leg.speed[side].signum();
                let pull = WEIGHT * leg.slope.to_radians().sin();
                let own = 0.5 * (leg.straight * way + pull) + if side == 1 { turn } else { -turn } * leg.scrub;
                let shown = leg.sides[side] * own * leg.speed[side].signum() + scatter(i + 3 * side);
                if shown > DEAD_BAND { shown } else { 0.0 }
            })
            .collect()
    };
    let yaw: Vec<f64> = rows.iter().map(|leg| leg.turned * (leg.speed[1] - leg.speed[0]) / TRACK).collect();
    let steps = (time[time.len() - 1] / RATE_STEP) as usize;
    let grid: Vec<f64> = (0..=steps).map(|k| k as f64 * RATE_STEP).collect();
    let row = |t: f64| ((t * RATE) as usize).min(rows.len() - 1);
    // The nose rises within a step.
    let pitch: Vec<f64> = grid
        .iter()
        .map(|t| -(rows[row(*t)].slope - rows[row((t - RATE_STEP).max(0.0))].slope).to_radians() / RATE_STEP)
        .collect();
    let body_rates = gyro.then(|| BodyRates {
        rate: [vec![0.0; grid.len()], pitch, grid.iter().map(|t| yaw[row(*t)]).collect()],
        time: grid,
        step: RATE_STEP,
        level: None,
        level_sigma: crate::settings::MEASURING.mounting.known,
        is_zero_known: true,
    });
    SpeedRun {
        name: "run".to_owned(),
        speed: [0, 1].map(|j| rows.iter().map(|leg| leg.speed[j]).collect()),
        commanded: None,
        averaged: None,
        torque: [torque(0), torque(1)],
        dead_band: DEAD_BAND,
        hidden: DEAD_BAND,
        set_points: true,
        magnitude_only: true,
        alignment: Some(Alignment { lag: vec![0.0; time.len()], left_out: Vec::new() }),
        yaw_rate: Some(yaw),
        gyro_share: None,
        body_rates,
        level: None,
        standing: vec![false; time.len()],
        changed: vec![false; time.len()],
        unused: Vec::new(),
        time,
    }
}

/// The same with an accelerometer that is mounted with its nose up by `tilt`, degrees.
pub(crate) fn levelled(legs: &[Leg], tilt: f64) -> SpeedRun {
    let mut run = drive(legs, true);
    let mut ends = Vec::new();
    for leg in legs {
        ends.push((ends.last().map_or(0.0, |e: &(f64, f64)| e.0) + leg.seconds, leg.slope));
    }
    let slope = |t: f64| ends.iter().find(|e| t < e.0).map_or(0.0, |e| e.1);
    if let Some(rates) = &mut run.body_rates {
        let noise = |k: usize| [0.3, -0.4, 0.2, 0.1, -0.2][k % 5];
        let level = |(k, t): (usize, &f64)| (slope(*t) + tilt + noise(k / 20)).to_radians();
        rates.level = Some(rates.time.iter().enumerate().map(level).collect());
    }
    run
}

/// Straight driving and turns both ways, some rounds of it.
pub(crate) fn rounds(n: usize) -> Vec<Leg> {
    let round = [Leg::straight(12.0), Leg::turn(8.0), Leg::straight(12.0), Leg::right(8.0)];
    round.into_iter().cycle().take(4 * n).collect()
}

/// A Husky, about.
pub(crate) fn robot() -> Robot<f64> {
    Robot {
        mass: 75.0,
        yaw_inertia: 5.0,
        half_wheelbase: 0.256,
        half_track: 0.2854,
        wheel_radius: 0.1651,
        adhesion: 0.6,
        rest_speed: 0.03,
        lateral_factor: 0.7,
        coulomb: [3.0; 2],
        ..Robot::from(&Parameters::SET_C)
    }
}

/// The diagnosis of drives against one of three rounds.
pub(crate) fn diagnosis(recordings: &[&[Leg]]) -> Diagnosis {
    diagnosis_with(recordings, &Options::default())
}

/// The same with options.
pub(crate) fn diagnosis_with(recordings: &[&[Leg]], options: &Options) -> Diagnosis {
    let recordings =
        recordings.iter().enumerate().map(|(k, legs)| SpeedRun { name: k.to_string(), ..drive(legs, false) });
    let case = case(vec![drive(&rounds(3), false)], recordings.collect());
    diagnose_steady(&case, options, &|_| {}).expect("a diagnosis")
}

/// A case of these drives.
pub(crate) fn case(references: Vec<SpeedRun>, recordings: Vec<SpeedRun>) -> SteadyCase {
    SteadyCase {
        robot: robot(),
        sigma: tunables::<f64>().map(|constant| constant.sigma),
        torque_sigma: 0.1,
        geometry_sigma: [0.01; 2],
        references,
        recordings,
    }
}

/// A load of a recording.
pub(crate) fn value(run: &SpeedRun, quantity: Quantity) -> Option<f64> {
    let loads: Vec<Load> = crate::extract::extract(run).0;
    loads.into_iter().find(|l| l.quantity == quantity).map(|l| l.value)
}
