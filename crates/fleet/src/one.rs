//! One unit, from its files to its row. Whatever goes wrong with it becomes a row as well.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use anyhow::{Result, ensure};
use case_files::envelope::{Answered, Envelope};
use case_files::inputs::Plan;

use super::Settings;
use super::columns::Columns;
use super::key;
use super::prepared::Prepared;
use super::row::{Measured, Row};
use super::unit::{Setup, Unit};

/// What recordings of a robot are compared with, or why there is nothing.
pub(crate) type Ready = Arc<Result<Robot, Unprepared>>;

/// A robot with what its recordings are compared with.
pub(crate) enum Robot {
    /// Its recordings are read with a mapping.
    Mapped(Box<Prepared>),
    /// Its file names their columns.
    Columns(Columns),
}

/// A robot that could not be prepared.
pub(crate) struct Unprepared {
    key: String,
    why: String,
}

/// Prepares a robot.
pub(crate) fn prepare(setup: &Setup, settings: &Settings) -> Ready {
    let prepared = guarded(|| match Columns::new(setup, settings)? {
        Some(columns) => Ok(Robot::Columns(columns)),
        None => Ok(Robot::Mapped(Box::new(Prepared::new(setup, settings)?))),
    });
    Arc::new(prepared.map_err(|why| Unprepared { key: key::of_setup(setup, settings), why }))
}

/// Diagnoses a unit: its row, and the whole answer where there is one.
pub(crate) fn diagnose(unit: &Unit, ready: &Ready, settings: &Settings) -> (Row, Option<Answered>) {
    let (robot, of_setup) = match &**ready {
        Ok(Robot::Mapped(prepared)) => (prepared.robot.name.as_str(), &prepared.key),
        Ok(Robot::Columns(columns)) => (columns.robot.as_str(), &columns.key),
        Err(unprepared) => ("", &unprepared.key),
    };
    // A mapping that cannot be read makes no key, and no answer.
    let key = key::of_unit(unit, of_setup).unwrap_or_else(|_| of_setup.clone());
    let answer = match &**ready {
        Ok(Robot::Mapped(prepared)) => guarded(|| {
            let (measured, envelope) = answer(unit, prepared, settings)?;
            Ok((measured, robot.to_owned(), Answered::Mapped(Box::new(envelope))))
        }),
        Ok(Robot::Columns(columns)) => guarded(|| {
            let (measured, name, envelope) = columns.answer(&unit.recording)?;
            Ok((measured, name, Answered::Columns(Box::new(envelope))))
        }),
        Err(unprepared) => Err(unprepared.why.clone()),
    };
    match answer {
        Ok((measured, robot, answered)) => (Row::done(unit, &key, &robot, measured, &answered), Some(answered)),
        Err(why) => (Row::failed(unit, &key, robot, why), None),
    }
}

fn answer(unit: &Unit, prepared: &Prepared, settings: &Settings) -> Result<(Measured, Envelope)> {
    let mapping = prepared.mapping(&unit.recording)?;
    let plan = Plan::new(&mapping, &unit.recording)?;
    ensure!(
        plan.names().len() == 1,
        "this is not one recording but {}: {}; give each by itself",
        plan.names().len(),
        plan.names().join(", ")
    );
    let read = prepared.read(&mapping, &unit.recording, settings)?;
    let measured = Measured::of(&read.0.reads[0].recording, read.1.as_ref());
    let (diagnosis, case) = prepared.diagnose(read, settings)?;
    let name = unit.setup.mapping.as_deref().unwrap_or(&mapping.name);
    Ok((measured, Envelope::new(diagnosis, &case, &settings.options, name, &settings.reading_name)?))
}

/// Does something that may fail or panic: of either the sentence.
fn guarded<T>(work: impl FnOnce() -> Result<T>) -> Result<T, String> {
    // Nothing of what it held is used afterwards.
    match catch_unwind(AssertUnwindSafe(work)) {
        Ok(result) => result.map_err(|error| format!("{error:#}")),
        Err(payload) => {
            Err(format!("defect in lacuna: {}; please report it together with the input", words(&*payload)))
        }
    }
}

fn words(payload: &(dyn Any + Send)) -> &str {
    let text = payload.downcast_ref::<&str>().copied();
    text.or_else(|| payload.downcast_ref::<String>().map(String::as_str)).unwrap_or("no message")
}

#[cfg(test)]
mod tests {
    use super::guarded;

    #[test]
    fn a_panic_becomes_a_sentence() {
        let message = guarded(|| -> anyhow::Result<()> { panic!("row {}", 7) }).expect_err("it panics");
        assert!(message.starts_with("defect in lacuna: row 7; please report"), "{message}");
        let message = guarded(|| -> anyhow::Result<()> { anyhow::bail!("no") }).expect_err("it fails");
        assert_eq!(message, "no");
    }
}
