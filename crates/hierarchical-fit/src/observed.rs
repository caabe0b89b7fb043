//! What a fit needs of a drive and of the model that it is compared with.

/// What a row is about; its errors share a scale with those of its kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Place and heading, m.
    Pose = 0,
    /// Yaw rate, rad/s.
    Gyro = 1,
    /// Speed that an encoder shows: m/s, or rad/s of a wheel.
    Encoder = 2,
}

impl Kind {
    /// Every kind, in the order of its declaration.
    pub const ALL: [Self; 3] = [Self::Pose, Self::Gyro, Self::Encoder];
}

/// A row of a drive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// What it is about.
    pub kind: Kind,
    /// From when it is known, s from the start.
    pub time: f64,
    /// Whether the robot moves in it.
    pub is_moving: bool,
    /// How much it counts beside rows that overlap with it.
    pub weight: f64,
}

/// How far a constant may be from what is given: deviations of a factor are logarithms.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread {
    /// One sigma of what is known of it.
    pub sigma: f64,
    /// One sigma that it has as a cause.
    pub usual: f64,
    /// One sigma by which drives differ.
    pub scatter: f64,
    /// Least and largest deviation.
    pub bounds: [f64; 2],
}

/// A drive that a model is compared with, row by row.
pub trait Observed: Clone + Send + Sync {
    /// What it is compared with, but for the values of the constants.
    type Model: Clone + Send + Sync;

    /// Length of the windows that rows tell of, up to when they become known, s.
    const WINDOW: f64;

    /// Least sigmas of errors, by kind.
    const FLOOR: [f64; 3];

    /// Remaining error over the motion, beyond which fits begin from where every cause is free, too.
    const NEAR: f64;

    /// Error with causes over that of constants re-tuned within what is known, from which on the causes are not needed.
    const HARDLY: f64;

    /// Whether a cause may begin or end in each drive anew. So free a hypothesis takes what laws that are not quite the robot's leave, too,
    /// where the motion depends on more than the counts do: of a drawn car whose clock was 2 s apart it made a delay that begins.
    const ANEW: bool = false;

    /// Its name.
    fn name(&self) -> &str;

    /// How long it is, s.
    fn seconds(&self) -> f64;

    /// Its rows.
    fn rows(&self) -> &[Row];

    /// Errors of all rows at deviations `theta` of the constants, in the unit of their kinds: model minus measurement; 0 where
    /// there is none.
    fn errors(&self, model: &Self::Model, theta: &[f64]) -> Vec<f64>;

    /// Change of the errors with each constant.
    fn columns(&self, model: &Self::Model, theta: &[f64]) -> Vec<Vec<f64>>;

    /// What a robot that keeps still would err by in the rows of [`Observed::judged_by`].
    fn sizes(&self) -> Vec<f64>;

    /// What the noise of what is measured alone makes of the errors of the rows of [`Observed::judged_by`], root mean square.
    fn noise(&self) -> f64 {
        0.0
    }

    /// The kind of rows by which a model is judged.
    fn judged_by(&self) -> Kind;

    /// Rows of a kind between two that can be compared with each other: those between belong to one window, or count as one.
    fn apart(&self, kind: Kind) -> usize;
}
