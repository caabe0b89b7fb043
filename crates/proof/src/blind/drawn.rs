//! Cases that the examiner draws for one kind of robot: drawn, sealed, asked, scored.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result};
use examiner::sha256;
use rayon::prelude::*;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value, json};

use crate::binary::{self, Binary};
use crate::child;
use crate::document::{Section, number, to_markdown, to_text};
use crate::output::{self, Asked, Figure, write};

use super::score::statistics::{Rate, median};

/// What is asked for.
pub(super) struct Set {
    pub(super) seed: u64,
    pub(super) count: usize,
    /// Drives of each case before anything is hidden.
    pub(super) references: usize,
    pub(super) out: PathBuf,
    /// Draw and seal only.
    pub(super) draw_only: bool,
    /// Fail when a target is missed.
    pub(super) judge: bool,
    /// Also write the page of this kind.
    pub(super) docs: bool,
}

/// A kind of robot with cases of its own.
pub(super) trait Subject {
    /// A case that can be drawn.
    type Plan: Sync;
    /// What was hidden in it.
    type Truth: Serialize + DeserializeOwned;
    /// What came of it.
    type Row: Serialize + Send;
    /// The page in `docs/` and its title.
    const PAGE: [&'static str; 2];
    /// What draws the cases.
    const LAW: &'static str;

    fn plans(seed: u64, count: usize, references: usize) -> Vec<Self::Plan>;
    fn name(plan: &Self::Plan) -> &str;
    /// Files of the case by their path in it, and what was hidden.
    fn draw(plan: &Self::Plan) -> (Vec<(PathBuf, Vec<u8>)>, Self::Truth);
    /// Scores an answer; null is a refusal.
    fn row(truth: &Self::Truth, diagnosis: &Value, processor_seconds: Option<f64>) -> Self::Row;
    fn figures(rows: &[Self::Row]) -> Vec<Figure>;
    /// Tables beside the figures.
    fn tables(rows: &[Self::Row]) -> Vec<Section>;
}

/// Draws, seals, asks and scores; true if, when judged, no target was missed.
pub(super) fn run<S: Subject>(set: &Set) -> Result<bool> {
    let plans = S::plans(set.seed, set.count, set.references);
    let seals = plans.par_iter().map(|plan| draw::<S>(plan, &set.out)).collect::<Result<Vec<(String, String)>>>()?;
    let sealed: Map<String, Value> = seals.into_iter().map(|(name, hash)| (name, json!(hash))).collect();
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
            let asked = ask(&binary, &set.out, S::name(plan));
            bar.inc(1);
            let (diagnosis, seconds) = asked?;
            // The truth is opened after the verdict is on disk, and only under its seal.
            Ok(S::row(&opened::<S>(&set.out, S::name(plan), &sealed)?, &diagnosis, seconds))
        })
        .collect::<Result<Vec<_>>>()?;
    bar.finish_and_clear();

    let figures = S::figures(&rows);
    let mut sections = vec![table(&figures)];
    sections.extend(S::tables(&rows));
    let missed = figures.iter().filter(|f| f.pass == Some(false)).count();
    let judged = figures.iter().filter(|f| f.pass.is_some()).count();
    let intro = format!(
        "{} cases of seed {}{}, drawn by {} that shares nothing with the diagnosis. {} of {judged} targets are met.",
        rows.len(),
        set.seed,
        match set.references {
            0 => String::new(),
            1 => " with a reference".to_owned(),
            n => format!(" with {n} references"),
        },
        S::LAW,
        judged - missed
    );
    write(&set.out, "summary.json", &serde_json::to_string_pretty(&figures)?)?;
    write(&set.out, "scores.json", &serde_json::to_string_pretty(&rows)?)?;
    let [file, title] = S::PAGE;
    let page = to_markdown(title, &intro, &sections);
    write(&set.out, file, &page)?;
    if set.docs {
        output::into_docs(file, super::MARKS, &output::below_title(&page)?)?;
    }
    print!("{intro}\n{}", to_text(&sections));
    println!("\nAll of it: {}/{file}, summary.json, scores.json", set.out.display());
    Ok(!(set.judge && missed > 0))
}

fn table(figures: &[Figure]) -> Section {
    let mut table = Section::new("Figures", "", &["figure", "found", "", "asked", ""]);
    for f in figures {
        let met = f.pass.map_or("", |pass| if pass { "yes" } else { "NO" });
        let cells = [
            f.name.clone(),
            number(Some(f.value)),
            f.unit.clone(),
            f.target.clone().unwrap_or_default(),
            met.to_owned(),
        ];
        table.rows.push(cells.map(Into::into).to_vec());
    }
    table
}

/// A table of hidden numbers that are told: how many, how many 90 % intervals hold, and the median error over half of one.
pub(super) fn intervals<'a>(errors: impl Iterator<Item = &'a (String, f64)>) -> Section {
    let mut by_name: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
    for (name, error) in errors {
        by_name.entry(name).or_default().push(*error);
    }
    let head = ["number", "told", "held", "median error"];
    let mut out = Section::new("Intervals", "Error over half of the 90 % interval.", &head);
    for (name, own) in by_name {
        let held = own.iter().filter(|e| e.abs() <= 1.0).count();
        let middle = median(&own).map_or(String::new(), |m| format!("{m:+.2}"));
        out.rows.push([name.to_owned(), own.len().to_string(), held.to_string(), middle].map(Into::into).to_vec());
    }
    out
}

/// Figures as they are gathered.
#[derive(Default)]
pub(super) struct List(pub(super) Vec<Figure>);

impl List {
    /// A share, where there is anything to count.
    pub(super) fn share(&mut self, name: &str, asked: Option<Asked>, cases: impl Iterator<Item = bool>) {
        let rate: Rate = cases.collect();
        if let Some(share) = rate.share() {
            let figure = Figure::free(format!("{name} (of {})", rate.count), share, "");
            self.0.push(match asked {
                Some(asked) => figure.asked(asked),
                None => figure,
            });
        }
    }

    pub(super) fn value(&mut self, name: &str, value: Option<f64>, unit: &str, asked: Asked) {
        self.0.extend(value.map(|value| Figure::free(name, value, unit).asked(asked)));
    }
}

/// Writes a case and its truth; its name, and the SHA-256 of the truth.
fn draw<S: Subject>(plan: &S::Plan, out: &Path) -> Result<(String, String)> {
    let (files, truth) = S::draw(plan);
    let name = S::name(plan);
    let folder = out.join("cases").join(name);
    for (path, bytes) in &files {
        let path = folder.join(path);
        let parent = path.parent().unwrap_or(&folder);
        fs::create_dir_all(parent).with_context(|| format!("cannot create '{}'", parent.display()))?;
        fs::write(&path, bytes).with_context(|| format!("cannot write '{}'", path.display()))?;
    }
    let truths = out.join("truth");
    fs::create_dir_all(&truths).with_context(|| format!("cannot create '{}'", truths.display()))?;
    let text = serde_json::to_string_pretty(&truth)?;
    write(&truths, &format!("{name}.json"), &text)?;
    Ok((name.to_owned(), sha256(text.as_bytes())))
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
fn opened<S: Subject>(out: &Path, name: &str, seals: &Map<String, Value>) -> Result<S::Truth> {
    let path = out.join("truth").join(format!("{name}.json"));
    let text = fs::read_to_string(&path).with_context(|| format!("cannot read '{}'", path.display()))?;
    let holds = seals.get(name).and_then(Value::as_str) == Some(sha256(text.as_bytes()).as_str());
    anyhow::ensure!(holds, "the truth of case {name} is not what was sealed; delete its folder to have it drawn again");
    serde_json::from_str(&text).with_context(|| format!("'{}'", path.display()))
}
