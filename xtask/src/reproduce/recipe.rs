//! The frozen recipe: one file with the experiment and its variations.

use anyhow::{Context, Result};
use serde::Deserialize;
use sim::Recipe;
use toml::{Table, Value};

const FILE: &str = include_str!("../../recipes/hendzel-trojnacki-2014.toml");
const VARIATIONS: &str = "variation";

/// The recipe with some values set otherwise.
#[derive(Debug)]
pub(super) struct Variation {
    pub(super) name: String,
    /// Whether it gets as many draws as the sets.
    pub(super) full: bool,
    pub(super) recipe: Recipe,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    name: String,
    #[serde(default)]
    full: bool,
    set: Table,
}

/// The recipe and its variations.
pub(super) fn frozen() -> Result<(Recipe, Vec<Variation>)> {
    let mut base: Table = FILE.parse().context("the built-in recipe")?;
    let entries = match base.remove(VARIATIONS) {
        None => Vec::new(),
        Some(list) => list.try_into::<Vec<Entry>>().context("the variations of the recipe")?,
    };
    let variations: Result<Vec<Variation>> = entries
        .into_iter()
        .map(|Entry { name, full, set }| {
            let mut table = base.clone();
            overlay(&mut table, set).with_context(|| format!("variation `{name}`"))?;
            let recipe = table.try_into().with_context(|| format!("variation `{name}`"))?;
            Ok(Variation { name, full, recipe })
        })
        .collect();
    Ok((base.try_into().context("the built-in recipe")?, variations?))
}

/// Sets values of a table; each must be there already.
fn overlay(base: &mut Table, set: Table) -> Result<()> {
    for (key, value) in set {
        let place = base.get_mut(&key).with_context(|| format!("the recipe has no `{key}`"))?;
        match (place, value) {
            (Value::Table(inner), Value::Table(set)) => overlay(inner, set)?,
            (place, value) => *place = value,
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use sim::Recipe;

    use super::{frozen, overlay};

    #[test]
    fn the_frozen_recipe_is_the_default_one() {
        let (recipe, _) = frozen().expect("valid");
        assert!(recipe.disclosure.contains("Table 1 was in view"));
        let default =
            Recipe { title: recipe.title.clone(), disclosure: recipe.disclosure.clone(), ..Recipe::default() };
        assert_eq!(recipe, default);
    }

    #[test]
    fn every_variation_changes_something_and_passes_the_checks() {
        let (recipe, variations) = frozen().expect("valid");
        assert!(variations.len() > 30);
        for v in variations {
            assert_ne!(v.recipe, recipe, "{}", v.name);
            v.recipe.check().expect("a recipe that can be used");
        }
    }

    #[test]
    fn a_value_that_the_recipe_does_not_have_is_refused() {
        let mut base = "a = 1\n[b]\nc = 2".parse().expect("valid");
        let error = overlay(&mut base, "b.d = 3".parse().expect("valid")).expect_err("unknown");
        assert!(error.to_string().contains("`d`"));
        overlay(&mut base, "b.c = 4".parse().expect("valid")).expect("known");
        assert_eq!(base["b"]["c"].as_integer(), Some(4));
    }
}
