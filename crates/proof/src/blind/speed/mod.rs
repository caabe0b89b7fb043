//! `cargo xtask blind --kind speed`: speed-driven cases with something hidden, sealed, diagnosed, scored.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result};
use examiner::sha256;
use examiner::speed::{SpeedPlan, SpeedTruth};
use rayon::prelude::*;
use serde_json::{Value, json};

use crate::binary::{self, Binary};
use crate::child;
use crate::document::{to_markdown, to_text};
use crate::output::{self, write};

mod figures;
mod score;

/// What is asked for.
pub(super) struct Set {
    pub(super) seed: u64,
    pub(super) count: usize,
    pub(super) out: PathBuf,
    /// Draw and seal only.
    pub(super) draw_only: bool,
    /// Fail when a target is missed.
    pub(super) judge: bool,
    /// Also write docs/blind-speed.md.
    pub(super) docs: bool,
}

/// Draws, seals, asks and scores; true if, when judged, no target was missed.
pub(super) fn run(set: &Set) -> Result<bool> {
    let plans = SpeedPlan::set(set.seed, set.count);
    let seals = plans.par_iter().map(|plan| draw(plan, &set.out)).collect::<Result<Vec<(String, String)>>>()?;
    let sealed: serde_json::Map<String, Value> = seals.into_iter().map(|(name, hash)| (name, json!(hash))).collect();
    write(&set.out, "seals.json", &serde_json::to_string_pretty(&sealed)?)?;
    println!("Cases sealed: {}, in {}", plans.len(), set.out.join("seals.json").display());
    if set.draw_only {
        return Ok(true);
    }

    let binary = binary::find()?;
    let bar = output::progress(plans.len() as u64, "cases diagnosed")?;
    let rows = plans
        .par_iter()
        .map(|plan| {
            let asked = ask(&binary, &set.out, &plan.name);
            bar.inc(1);
            let (diagnosis, seconds) = asked?;
            // The truth is opened after the verdict is on disk, and only under its seal.
            Ok(score::row(&opened(&set.out, &plan.name, &sealed)?, &diagnosis, seconds))
        })
        .collect::<Result<Vec<_>>>()?;
    bar.finish_and_clear();

    let figures = figures::figures(&rows);
    let sections = figures::sections(&rows, &figures);
    let missed = figures.iter().filter(|f| f.pass == Some(false)).count();
    let judged = figures.iter().filter(|f| f.pass.is_some()).count();
    let intro = format!(
        "{} cases of seed {}, drawn by a law of steady torques that shares nothing with the diagnosis. {} of {judged} targets \
         are met.",
        rows.len(),
        set.seed,
        judged - missed
    );
    write(&set.out, "summary.json", &serde_json::to_string_pretty(&figures)?)?;
    write(&set.out, "scores.json", &serde_json::to_string_pretty(&rows)?)?;
    let page = to_markdown("Blind cases, speed-driven", &intro, &sections);
    write(&set.out, "blind-speed.md", &page)?;
    if set.docs {
        output::into_docs("blind-speed.md", super::MARKS, &output::below_title(&page)?)?;
    }
    print!("{intro}\n{}", to_text(&sections));
    println!("\nAll of it: {}/blind-speed.md, summary.json, scores.json", set.out.display());
    Ok(!(set.judge && missed > 0))
}

/// Writes a case and its truth; its name, and the SHA-256 of the truth.
fn draw(plan: &SpeedPlan, out: &Path) -> Result<(String, String)> {
    let case = plan.draw();
    let folder = out.join("cases").join(&plan.name);
    for (path, bytes) in &case.files {
        let path = folder.join(path);
        let parent = path.parent().unwrap_or(&folder);
        fs::create_dir_all(parent).with_context(|| format!("cannot create '{}'", parent.display()))?;
        fs::write(&path, bytes).with_context(|| format!("cannot write '{}'", path.display()))?;
    }
    let truths = out.join("truth");
    fs::create_dir_all(&truths).with_context(|| format!("cannot create '{}'", truths.display()))?;
    let text = serde_json::to_string_pretty(&case.truth)?;
    write(&truths, &format!("{}.json", plan.name), &text)?;
    Ok((plan.name.clone(), sha256(text.as_bytes())))
}

/// What the program says of a case, and its processor time, s. A refusal is an answer, too: null.
fn ask(binary: &Binary, out: &Path, name: &str) -> Result<(Value, Option<f64>)> {
    let folder = out.join("cases").join(name);
    let answers = out.join("answers");
    fs::create_dir_all(&answers).with_context(|| format!("cannot create '{}'", answers.display()))?;
    let verdict = answers.join(format!("{name}.json"));
    if verdict.is_file() {
        fs::remove_file(&verdict).with_context(|| format!("cannot remove '{}'", verdict.display()))?;
    }
    let ended = child::run(
        Command::new(&binary.path)
            .arg("diagnose")
            .arg(&folder)
            .arg("--json")
            .arg(&verdict)
            .env("RAYON_NUM_THREADS", "1")
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null()),
    )?;
    if !verdict.is_file() {
        return Ok((Value::Null, ended.processor));
    }
    let text = fs::read_to_string(&verdict).with_context(|| format!("cannot read '{}'", verdict.display()))?;
    let all: Value = serde_json::from_str(&text).with_context(|| format!("'{}'", verdict.display()))?;
    Ok((all["diagnosis"].clone(), ended.processor))
}

/// What was hidden, if its seal holds.
fn opened(out: &Path, name: &str, seals: &serde_json::Map<String, Value>) -> Result<SpeedTruth> {
    let path = out.join("truth").join(format!("{name}.json"));
    let text = fs::read_to_string(&path).with_context(|| format!("cannot read '{}'", path.display()))?;
    let holds = seals.get(name).and_then(Value::as_str) == Some(sha256(text.as_bytes()).as_str());
    anyhow::ensure!(holds, "the truth of case {name} is not what was sealed; delete its folder to have it drawn again");
    serde_json::from_str(&text).with_context(|| format!("'{}'", path.display()))
}
