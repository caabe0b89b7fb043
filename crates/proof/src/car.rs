//! `cargo xtask car`: a 1:10 car with motion capture; drives are left out in turn and forecast from throttle and steering by
//! every model.

use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args as ClapArgs;
use single_track::{CORRECTED, FOLLOWING, Findings, LENGTHS, OWN_ROWS, Table, examine};

use crate::document::{Section, number, to_text, toned};
use crate::odometry::word;
use crate::output::{self, Asked, Figure};
use pages::page::{Cell, Tone};

/// The open data beside the project.
const OPEN: &str = "../shared/data/dart-open";
/// The car's robot file in the project.
const ROBOT: &str = "crates/single-track/robots/dart.toml";
/// By how much the answer has to forecast better than the best rival.
const ASKED: f64 = 1.5;
const MARKS: [&str; 2] = ["<!-- figures of cargo xtask car -->\n", "<!-- end of the figures -->\n"];

/// Arguments of `cargo xtask car`.
#[derive(Debug, ClapArgs)]
pub(crate) struct Args {
    /// Folder of the data, with a folder `runs` of tables [default: ../shared/data/dart-open].
    #[arg(long, value_name = "DIR")]
    data: Option<PathBuf>,
    /// Also write the figures into docs/car.md.
    #[arg(long)]
    docs: bool,
}

/// Runs the command; true if all that is asked is met, or the data are not there.
pub(crate) fn run(args: &Args) -> Result<bool> {
    let data = args.data.clone().unwrap_or_else(|| output::beside(OPEN));
    if args.data.is_none() && !data.is_dir() {
        println!("SKIPPED: there is no data in {OPEN}; name a folder with --data");
        return Ok(true);
    }
    let robot = output::beside(ROBOT).display().to_string();
    let read = case_files::car::read(None, Some(&robot), [&[], &[data.join("runs")], &[]])?;
    let mut case = read.with_context(|| format!("'{robot}' is no robot file of kind car"))?.case;
    let all = case.recordings.len();
    case.recordings.retain(single_track::Drive::has_pose);
    let (findings, table) = examine(&case, None, &|_| {})?;

    let note = format!(
        "{} of {all} drives have a pose; each is left out in turn, with naming and fit anew. Medians over forecasts that begin \
         every half second while the car moves.",
        table.drives
    );
    let sections = [forecasts(&table, note), causes(&findings, &table), by_drive(&table)];
    let figures: Vec<Figure> = gain(&table).into_iter().collect();
    let text = to_text(&sections);
    print!("{text}");
    for figure in &figures {
        println!("{}: {:.2} (asked {})", figure.name, figure.value, figure.target.as_deref().unwrap_or("nothing"));
    }
    let folder = output::folder("car")?;
    output::write(&folder, "summary.json", &serde_json::to_string_pretty(&figures)?)?;
    output::write(&folder, "tables.txt", &text)?;
    if args.docs {
        let page = harness::document::to_markdown("Figures", "", &sections);
        output::into_docs("car.md", MARKS, &output::below_title(&page)?)?;
    }
    Ok(figures.iter().all(|f| f.pass != Some(false)))
}

/// Median position error at the longest length of the best rival over that of the answer that follows the drive's past.
fn gain(table: &Table) -> Option<Figure> {
    let position = |row: usize| table.rows.get(row)?.1[LENGTHS.len() - 1].medians().map(|m| m[0]);
    let best = (OWN_ROWS..table.rows.len()).filter_map(position).fold(f64::INFINITY, f64::min);
    let ours = position(FOLLOWING)?;
    let name = "best rival over corrected that follows its past, position after 2 s".to_owned();
    best.is_finite().then(|| Figure::free(name, best / ours, "1").asked(Asked::AtLeast(ASKED)))
}

fn forecasts(table: &Table, note: String) -> Section {
    let lengths = LENGTHS.iter().flat_map(|l| [format!("position {l} s, mm"), format!("heading {l} s, mrad")]);
    let header = std::iter::once("model".to_owned()).chain(lengths).collect();
    let mut section =
        Section { title: "Place from throttle and steering alone".to_owned(), note, header, rows: Vec::new() };
    for (k, (name, errors)) in table.rows.iter().enumerate() {
        let medians = errors.iter().map(single_track::Errors::medians);
        let cells = medians.flat_map(|m| [m.map(|m| 1e3 * m[0]), m.map(|m| 1e3 * m[1])]);
        let tone = if k == FOLLOWING { Tone::Good } else { Tone::Plain };
        section
            .rows
            .push(std::iter::once(toned(name.clone(), tone)).chain(cells.map(|c| Cell::from(number(c)))).collect());
    }
    section
}

fn causes(findings: &Findings, table: &Table) -> Section {
    let note = format!(
        "Answer: {}. Named with all drives, with 90 % intervals; how many folds named it.",
        word(findings.said.answer)
    );
    let header = ["cause", "probability", "constant", "stated", "found", "±", "folds"];
    let mut section = Section::new("What was named", &note, &header);
    for cause in &findings.said.named {
        let folds = table.named.iter().filter(|n| n.contains(&cause.label)).count();
        for e in &cause.estimates {
            let unit = if e.unit == "1" { String::new() } else { format!(", {}", e.unit) };
            let cells = [
                cause.label.clone(),
                format!("{:.2}", cause.probability),
                format!("{}{unit}", e.name),
                format!("{:.4}", e.given),
                format!("{:.4}", e.value),
                format!("{:.4}", e.half_width),
                format!("{folds} of {}", table.drives),
            ];
            section.rows.push(cells.map(Cell::from).to_vec());
        }
    }
    section
}

fn by_drive(table: &Table) -> Section {
    let rivals = table.rows[OWN_ROWS..].iter().map(|(name, _)| name.as_str());
    let header: Vec<String> =
        ["drive", "corrected", "following"].into_iter().chain(rivals).map(str::to_owned).collect();
    let note = "Median position error after 2 s, mm.".to_owned();
    let mut section = Section { title: "Drive by drive".to_owned(), note, header, rows: Vec::new() };
    for (drive, errors) in &table.by_drive {
        let shown = [CORRECTED, FOLLOWING].into_iter().chain(OWN_ROWS..errors.len());
        let cells = shown.map(|row| Cell::from(number(errors[row][LENGTHS.len() - 1].medians().map(|m| 1e3 * m[0]))));
        section.rows.push(std::iter::once(Cell::from(drive.clone())).chain(cells).collect());
    }
    section
}
