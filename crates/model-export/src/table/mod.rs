//! Which effect an engine holds, where, and what must be added where it does not.

use crate::at::At;
use crate::engine::{Engine, Way};
use crate::origin::Section;
use crate::residual::Text;
use crate::vehicle::Vehicle;

mod body;
mod command;
mod drivetrain;
mod ground;
mod sensors;

/// The translation of an effect.
pub(crate) struct Row {
    pub(crate) id: &'static str,
    /// The part of a model that it changes.
    pub(crate) section: Section,
    /// How it becomes values, where it is held.
    pub(crate) hold: Hold,
    /// MJCF, URDF, SDF.
    ways: [Way; 3],
    /// What is added where it is not held.
    pub(crate) lines: Lines,
    /// Why an engine that holds it elsewise does not hold it at these values.
    except: fn(&At<'_>, Engine) -> Option<&'static str>,
}

/// How an effect becomes values.
#[derive(Clone, Copy)]
pub(crate) enum Hold {
    /// By its own law, applied once to the robot at rest: the same always and everywhere.
    Law,
    /// By a translation of its own.
    Special(fn(&At<'_>, &mut Vehicle)),
}

/// What is added where an effect is not held.
#[derive(Clone, Copy)]
pub(crate) enum Lines {
    /// Lines with its values in them.
    Of(fn(&At<'_>, &Vehicle) -> Text),
    /// It goes into the constants by its law, and they have their lines.
    OfConstants,
}

impl Row {
    /// How an engine gets the effect at these values.
    pub(crate) fn way(&self, engine: Engine, at: &At<'_>) -> Way {
        match ((self.except)(at, engine), self.usual(engine)) {
            (Some(why), Way::Held(_)) => Way::Added(why),
            (_, way) => way,
        }
    }

    fn usual(&self, engine: Engine) -> Way {
        self.ways[engine as usize]
    }
}

/// The same in every case.
fn never(_: &At<'_>, _: Engine) -> Option<&'static str> {
    None
}

fn rows() -> impl Iterator<Item = &'static Row> {
    ground::ROWS.iter().chain(&body::ROWS).chain(&drivetrain::ROWS).chain(&command::ROWS).chain(&sensors::ROWS)
}

/// The translation of an effect of the catalogue.
pub(crate) fn row(id: &str) -> Option<&'static Row> {
    rows().find(|row| row.id == id)
}

/// How an engine gets an effect at its usual presence; `None` for an effect without translation.
pub fn way(engine: Engine, effect: &str) -> Option<Way> {
    row(effect).map(|row| row.usual(engine))
}
