//! The robots of the DRIVE data set, where they lie beside the repository; ignored where they do not.

use case_files::case_folder::{self, CaseFolder};
use command_driven::diagnose_response;
use proof::drive_layout::lay_out;
use recordings::ReadOptions;
use skipping::{Outcome, Skipped, beside};
use verdict::{Diagnosis, Verdict};

/// A robot of the data set, diagnosed on the first two thirds of its windows and held against the last third.
fn diagnosed(name: &str) -> Result<Diagnosis, Skipped> {
    let source = beside(&format!("data/drive-husky/{name}.csv"))?;
    let folder = tempfile::tempdir().unwrap();
    let written = lay_out(&source, folder.path(), 2.0 / 3.0).unwrap();
    let mapping = case_folder::mapping(&written.mapping.display().to_string()).unwrap();
    let robot = case_folder::robot(&format!("{name}-drive")).unwrap();
    let paths = ["recordings", "heldout"].map(|p| vec![folder.path().join(p)]);
    let case = CaseFolder::from_paths(robot, [&[], &paths[0], &paths[1]], &mapping, &ReadOptions::default()).unwrap();
    Ok(diagnose_response(&case.command_driven().unwrap(), &inference::Options::default(), &|_| {}).unwrap())
}

/// As it is, re-tuned, corrected, placebo on held-out windows.
fn errors(d: &Diagnosis, quantity: &str, statistic: &str) -> [f64; 4] {
    let starts = format!("{quantity} ({statistic}), ");
    let row = d.free_runs.iter().find(|r| r.recording == "held out" && r.quantity.starts_with(&starts)).unwrap();
    [row.nominal, row.retuned, row.corrected, row.placebo.unwrap()]
}

fn the_husky_did_not_drive_what_was_commanded() -> Outcome {
    let d = diagnosed("husky")?;
    assert_eq!(d.verdict, Verdict::Explained);
    assert_eq!(d.ranked[0].effect, "drive_command", "{:?}", d.ranked);
    assert!(
        d.sentences[0].contains("do not do what is commanded") && d.sentences[0].contains("neither slip nor friction")
    );
    let response = d.response.as_ref().unwrap();
    assert!(response.scaling.as_ref().unwrap().contains("in proportion"), "{:?}", response.scaling);
    assert!(response.scaling_is_told);
    for (quantity, most) in [("wheel speed", 0.5), ("position", 0.32), ("yaw", 0.25), ("position at the end", 0.32)] {
        for statistic in ["rms", "median"] {
            let [nominal, retuned, corrected, placebo] = errors(&d, quantity, statistic);
            let shown = format!("{quantity} {statistic}: {nominal} {retuned} {corrected} {placebo}");
            assert!(corrected < most, "{shown}");
            assert!(2.0 * corrected < nominal && 1.3 * corrected < retuned && corrected < placebo, "{shown}");
        }
    }
    Ok(())
}

fn the_warthogs_forecast_is_better_than_its_simulation() -> Outcome {
    let d = diagnosed("warthog")?;
    assert_eq!(d.verdict, Verdict::Explained);
    for quantity in ["wheel speed", "yaw"] {
        let [nominal, retuned, corrected, _] = errors(&d, quantity, "rms");
        assert!(2.0 * corrected < nominal && 1.3 * corrected < retuned, "{quantity}: {nominal} {retuned} {corrected}");
    }
    Ok(())
}

skipping::tests![the_husky_did_not_drive_what_was_commanded, the_warthogs_forecast_is_better_than_its_simulation,];
