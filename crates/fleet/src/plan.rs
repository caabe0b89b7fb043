//! What is done before and what is still to do.

use std::collections::HashMap;

use anyhow::Result;
use rayon::prelude::*;

use super::Settings;
use super::key;
use super::row::Outcome;
use super::store::{Index, Store};
use super::unit::{Setup, Unit};

/// What a run has before it.
#[derive(Debug, Default)]
pub struct Plan {
    /// Units that still need work.
    pub to_do: Vec<Unit>,
    /// Units that are finished, with their present labels.
    pub done_before: usize,
    /// Those of them of which some input was lost.
    pub lost_before: usize,
    /// Units that are left for another run.
    pub left: usize,
}

/// Looks up which units are finished: those of whose present input there is a row with an answer. Rows whose labels (vehicle,
/// date, path) have changed are written anew; failed units are tried again.
///
/// # Errors
/// When the store cannot be read or written.
pub fn plan(units: Vec<Unit>, store: &Store, settings: &Settings) -> Result<Plan> {
    let index = store.index()?;
    let mut setups: HashMap<String, String> = HashMap::new();
    let text = |setup: &Setup| format!("{setup:?}");
    for unit in &units {
        if !index.of(&unit.id).is_empty() && !setups.contains_key(&text(&unit.setup)) {
            setups.insert(text(&unit.setup), key::of_setup(&unit.setup, settings));
        }
    }
    let looked_up = |unit: Unit| -> Result<(Unit, Option<bool>)> {
        let before = match setups.get(&text(&unit.setup)) {
            Some(of_setup) => finished(&unit, of_setup, &index, store)?,
            None => None,
        };
        Ok((unit, before))
    };
    let mut out = Plan::default();
    for (unit, before) in units.into_par_iter().map(looked_up).collect::<Result<Vec<_>>>()? {
        match before {
            Some(lost) => {
                out.done_before += 1;
                out.lost_before += usize::from(lost);
            }
            None => out.to_do.push(unit),
        }
    }
    if let Some(limit) = settings.limit.filter(|limit| *limit < out.to_do.len()) {
        out.left = out.to_do.len() - limit;
        out.to_do.truncate(limit);
    }
    Ok(out)
}

/// Whether some of a unit's present input was lost, if it has an answer.
fn finished(unit: &Unit, of_setup: &str, index: &Index, store: &Store) -> Result<Option<bool>> {
    let names = index.of(&unit.id);
    if names.is_empty() {
        return Ok(None);
    }
    let Ok(key) = key::of_unit(unit, of_setup) else { return Ok(None) };
    let name = Store::name(&unit.id, &key);
    if !names.contains(&name) {
        return Ok(None);
    }
    // What cannot be read is done again.
    let Some(row) = store.row(&name).ok().filter(|row| row.outcome == Outcome::Done && store.has_answer(row)) else {
        return Ok(None);
    };
    let labelled = row.labelled(unit);
    if labelled != row {
        store.keep_row(&labelled)?;
    }
    Ok(Some(!row.lost.is_empty()))
}
