//! What a rehearsal needs of a fit: what its drives say of the constants, and what may be wrong with these.

use nalgebra::{DMatrix, DVector};
use verdict::SensorNoise;

use crate::answered::is_moved;
use crate::cause::Cause;
use crate::data::Prior;
use crate::name::{Named, name};
use crate::observed::{Kind, Observed};
use crate::said::Valued;
use crate::session::Session;
use crate::solve::Solved;
use crate::weigh::Evidence;

/// What the drives of a case can say of the constants, whatever they said.
#[derive(Debug, Clone)]
pub struct Rehearsable {
    /// Drives by name, with their length, s, and their equations about the fit.
    pub drives: Vec<(String, f64, Session)>,
    /// References that the case has.
    pub references: usize,
    /// Sigmas with which the robot file knows the constants.
    pub stated: DVector<f64>,
    /// One sigma by which drives differ.
    pub scatter: DVector<f64>,
    /// One sigma by which constants move between references and recordings.
    pub between: DVector<f64>,
    /// What may be hidden.
    pub causes: Vec<Hideable>,
    /// What is measured, as the fit found it to scatter.
    pub noise: Vec<SensorNoise>,
}

/// A cause that may be hidden.
#[derive(Debug, Clone, PartialEq)]
pub struct Hideable {
    /// The cause.
    pub cause: Cause,
    /// Deviation of the constant that is its size, where it has its usual one.
    pub usual: f64,
    /// That constant as it is told.
    pub told: Told,
}

/// A constant as it is told.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Told {
    /// Its value.
    pub value: f64,
    /// Whether its deviation is the logarithm of a factor.
    pub is_factor: bool,
    /// Unit of its value.
    pub unit: &'static str,
    /// How much farther it can deviate, below and above.
    pub room: [f64; 2],
}

impl Hideable {
    /// A cause whose size is the first constant that it moves, of which `told` knows the rest; `None` where it moves none.
    pub fn new(cause: &Cause, told: impl Fn(usize) -> Told) -> Option<Self> {
        let (direction, usual) = cause.directions.first()?;
        let &(k, weight) = direction.first()?;
        Some(Self { cause: cause.clone(), usual: usual * weight.abs(), told: told(k) })
    }

    /// By how much the value of its constant changes at so many of its usual sizes.
    pub fn size(&self, multiple: f64) -> f64 {
        let deviation = multiple * self.usual;
        if self.told.is_factor { self.told.value.abs() * deviation.exp_m1() } else { deviation }
    }

    /// Whether the constant can be larger, and smaller, by so many of its usual sizes.
    pub fn signs(&self, multiple: f64) -> [bool; 2] {
        let deviation = multiple * self.usual;
        let [below, above] = self.told.room;
        let [least, most] =
            self.cause.possible.map_or([below, above], |range| [below.max(range.least), above.min(range.most)]);
        [deviation < most, -deviation > least]
    }
}

impl Rehearsable {
    /// What drives whose equations these are name after what is known; `None` where the equations have no solution.
    pub fn named(&self, prior: &Prior, sessions: &[Session]) -> Option<Named> {
        let evidence = self.evidence(prior, sessions)?;
        let causes: Vec<Cause> = self.causes.iter().map(|hideable| hideable.cause.clone()).collect();
        let mut named = name(&evidence, &prior.covariance, &causes)?;
        let Named { chosen, posterior, .. } = &mut named;
        chosen.retain(|w| is_moved(&causes[w.cause], prior, posterior));
        Some(named)
    }

    /// What is known after drives whose equations these are and in which the robot was as stated.
    pub fn after_references(&self, sessions: &[Session]) -> Option<Prior> {
        let variance = |sigma: &DVector<f64>| DMatrix::from_diagonal(&sigma.component_mul(sigma));
        let stated = Prior { mean: DVector::zeros(self.stated.len()), covariance: variance(&self.stated) };
        if sessions.is_empty() {
            return Some(stated);
        }
        let posterior = self.evidence(&stated, sessions)?.posterior(&stated.covariance)?;
        let covariance = posterior.covariance + variance(&self.scatter) + variance(&self.between);
        Some(Prior { mean: posterior.mean, covariance })
    }

    fn evidence(&self, prior: &Prior, sessions: &[Session]) -> Option<Evidence> {
        Evidence::new(&vec![0.0; self.stated.len()], sessions, &self.scatter, &prior.mean)
    }
}

impl<D: Observed> Solved<D> {
    /// What these drives can say. `said_of`: what readings of a kind are, with their unit.
    pub fn rehearsable(
        &self,
        constants: &[impl Valued],
        references: usize,
        said_of: impl Fn(Kind) -> (String, &'static str),
    ) -> Rehearsable {
        let Self { data, fit, causes, .. } = self;
        let drives = data.drives.iter().zip(&fit.sessions);
        let seconds: f64 = data.drives.iter().map(Observed::seconds).sum();
        let noise = |kind: Kind| {
            let rows = data.drives.iter().flat_map(Observed::rows).filter(|row| row.kind == kind).count();
            let (channel, unit) = said_of(kind);
            (rows > 0).then(|| SensorNoise {
                channel: channel.into(),
                sigma: fit.noise.sigma[kind as usize],
                unit: unit.into(),
                rate: fit.noise.power[kind as usize] * rows as f64 / seconds,
                source: "what the fit leaves, at the rate of independent readings".into(),
            })
        };
        let told = |k: usize| {
            let (constant, at) = (&constants[k], fit.theta[k]);
            let room = data.spreads[k].bounds.map(|bound| bound - at);
            Told { value: constant.value(at), is_factor: constant.is_factor(), unit: constant.unit(), room }
        };
        Rehearsable {
            drives: drives
                .map(|(drive, session)| (drive.name().to_owned(), drive.seconds(), session.clone()))
                .collect(),
            references,
            stated: DVector::from_iterator(data.spreads.len(), data.spreads.iter().map(|spread| spread.sigma)),
            scatter: data.scatter(fit.factor),
            between: data.between_visits(),
            causes: causes.iter().filter_map(|cause| Hideable::new(cause, told)).collect(),
            noise: Kind::ALL.into_iter().filter_map(noise).collect(),
        }
    }
}
