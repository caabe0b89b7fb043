//! Draws the cases of a set and seals them.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};
use examiner::{Plan, sha256};
use rayon::prelude::*;

use super::layout::Layout;
use super::seal::{Seal, Seals};
use crate::binary::sha256_of;
use crate::output;

/// Draws what is not there yet and returns the seals of all. Seals are on disk when this returns.
pub(super) fn draw(plans: &[&Plan], layout: &Layout) -> Result<Seals> {
    let program = std::env::current_exe().context("cannot tell which program this is")?;
    let program = sha256_of(&program)?;
    let mut seals = Seals::open(layout)?;
    // Says that what is in the folder is ours, should the drawing be interrupted.
    seals.save(layout)?;
    // Another examiner may draw another case from the same plan.
    let drawn_from = |plan: &Plan| sha256(format!("{program} {plan:?}").as_bytes());
    let known = |plan: &Plan| {
        let seal = seals.0.get(&plan.name);
        seal.is_some_and(|s| s.plan == drawn_from(plan) && s.is_there(layout, &plan.name))
    };
    let missing: Vec<&Plan> = plans.iter().copied().filter(|p| !known(p)).collect();
    let bar = output::progress(missing.len() as u64, "cases drawn")?;
    let drawn = missing
        .par_iter()
        .map(|plan| {
            let seal = one(plan, drawn_from(plan), layout);
            bar.inc(1);
            seal.map(|seal| (plan.name.clone(), seal)).with_context(|| format!("cannot draw case {}", plan.name))
        })
        .collect::<Result<Vec<_>>>()?;
    bar.finish_and_clear();
    seals.0.extend(drawn);
    seals.save(layout)?;
    Ok(seals)
}

/// Draws a case into its folder and its truth into another.
fn one(plan: &Plan, drawn_from: String, layout: &Layout) -> Result<Seal> {
    let drawn = plan.draw()?;
    // A case of another set may have had more recordings.
    let (case, truth) = (layout.case(&plan.name), layout.truth(&plan.name));
    clear(&case)?;
    clear(&truth)?;
    drawn.write(&case)?;
    drawn.write_truth(&truth)?;
    Ok(Seal::of(drawn_from, &drawn))
}

/// Removes a file, or a folder with all that it holds, if it is there.
pub(super) fn clear(path: &Path) -> Result<()> {
    let removed = match path {
        path if path.is_dir() => fs::remove_dir_all(path),
        path if path.exists() => fs::remove_file(path),
        _ => Ok(()),
    };
    removed.with_context(|| format!("cannot remove '{}'", path.display()))
}

#[cfg(test)]
mod tests {
    use examiner::{Content, EffectId, Mix, Settings, TyreLaw};

    use super::*;
    use crate::blind::truth;

    fn short() -> Vec<Plan> {
        let settings = Settings {
            content: Content::Effects(vec![EffectId::Payload]),
            law: Some(TyreLaw::Brush),
            duration_s: 5.0,
            references: 1,
            recordings: Some(1),
            heldout: 1,
            least_excess: 0.0,
            ..Settings::default()
        };
        examiner::set(3, 2, Mix::default(), &settings)
    }

    #[test]
    fn a_truth_that_was_changed_after_sealing_is_not_opened() {
        let folder = tempfile::tempdir().expect("a folder");
        let layout = Layout::new(folder.path().to_path_buf());
        let plans = short();
        let plans: Vec<&Plan> = plans.iter().collect();
        let seals = draw(&plans, &layout).expect("draws");
        assert_eq!(Seals::open(&layout).expect("opens"), seals, "they are on disk");
        assert_eq!(seals.0.len(), 2);
        for plan in &plans {
            let opened = truth::open(&layout, &plan.name, &seals).expect("untouched");
            assert_eq!(opened.truth.case, plan.name);
            assert_eq!(opened.responses["held_1"].len(), 416);
            seals.of(&plan.name).and_then(|s| s.check_case(&layout, &plan.name)).expect("untouched");
        }

        let path = layout.truth("x002").join("truth.json");
        let text = fs::read_to_string(&path).expect("a truth");
        fs::write(&path, text.replacen("explained", "unknown", 1).replacen("no mismatch", "explained", 1))
            .expect("writes");
        let error = format!("{:#}", truth::open(&layout, "x002", &seals).expect_err("tampered"));
        assert!(error.contains("truth of case x002") && error.contains("truth.json' was changed"), "{error}");
        truth::open(&layout, "x001", &seals).expect("the other is untouched");
        // It is not quietly put right either, until somebody deletes it.
        let again = draw(&plans, &layout).expect("nothing to draw");
        assert!(again == seals && truth::open(&layout, "x002", &again).is_err());
        clear(&layout.truth("x002")).expect("removes");
        let again = draw(&plans, &layout).expect("draws x002");
        assert!(again == seals && truth::open(&layout, "x002", &again).is_ok());

        fs::write(layout.case("x001").join("recordings").join("run_9.csv"), "a").expect("writes");
        let seal = seals.of("x001").expect("a seal");
        let error = format!("{:#}", seal.check_case(&layout, "x001").expect_err("a stranger"));
        assert!(error.contains("case x001") && error.contains("recordings/run_9.csv"), "{error}");
    }

    #[test]
    fn a_folder_with_cases_of_others_is_left_alone() {
        let folder = tempfile::tempdir().expect("a folder");
        let layout = Layout::new(folder.path().to_path_buf());
        fs::create_dir_all(layout.case("mine")).expect("creates");
        let error = draw(&[], &layout).expect_err("not ours").to_string();
        assert!(error.contains("--out"), "{error}");
    }
}
