//! One picture of a diagnosis, as SVG: how probable the causes are, and how much better the corrected model forecasts.

use catalogue::for_people;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;
use verdict::{Cause, Diagnosis, FreeRun};

pub use crate::drawing::PictureError;
use crate::drawing::{Area, BEFORE, CORRECTED, FRAME, INK, PAPER, RETUNED, SOFT, bold, failed, rectangle, text};
use crate::words::{is_no_cause, probability, quantities, quantity_and_unit, verdict};

/// Width, margin and gap between the panels, px.
const WIDTH: i32 = 800;
const MARGIN: i32 = 28;
const GAP: i32 = 48;
/// Left edge and width of the panels, px.
const PANEL: i32 = (WIDTH - 2 * MARGIN - GAP) / 2;
const RIGHT: i32 = MARGIN + PANEL + GAP;
/// Room for the numbers beside the bars, px.
const NUMBERS: i32 = 56;
/// Sizes of letters, px, and the mean width of a letter relative to them, for a wide font.
const TITLE: i32 = 17;
const HEADING: i32 = 15;
const LABEL: i32 = 13;
const BOLD_LETTER: f64 = 0.60;
const LETTER: f64 = 0.58;
/// Height of a line of the title, of a cause, of a bar of an error, px.
const TITLE_LINE: i32 = 24;
const CAUSE: i32 = 44;
const ERROR: i32 = 23;
const GROUP: i32 = 3 * ERROR + 42;
/// Thickness of bars, px.
const BAR: i32 = 13;
/// Causes that are shown, and sentences of the title.
const CAUSES: usize = 6;
const SENTENCES: usize = 3;
/// Causes below this probability are left out, unless nothing else would be shown.
const SHOWN: f64 = 0.005;

const TRACK: RGBColor = RGBColor(236, 239, 242);
/// "None" and "unknown" are answers, but no causes.
const NO_CAUSE: RGBColor = RGBColor(160, 171, 182);

/// Errors of one quantity, mean over the recordings that were left out.
struct Errors {
    quantity: String,
    unit: String,
    nominal: f64,
    retuned: f64,
    corrected: f64,
}

/// Draws a diagnosis: 800 px wide, on white, so that it reads on light and dark pages.
///
/// Left, the probability of each cause to be part of what is missing (of two causes both may be near 1). Right, the
/// error of free runs on recordings that were left out of the fit, relative to the model as it is.
///
/// # Errors
/// When the drawing library fails.
pub fn svg(d: &Diagnosis) -> Result<String, PictureError> {
    let title: Vec<String> =
        verdict(d, SENTENCES).iter().flat_map(|s| wrap(s, width(WIDTH - 2 * MARGIN, TITLE, BOLD_LETTER))).collect();
    let causes = causes(d);
    let errors = errors(&d.free_runs);
    let top = MARGIN + rows(title.len(), TITLE_LINE) + 40;
    let left = rows(causes.len(), CAUSE);
    let right = rows(errors.len(), GROUP);
    let height = top + left.max(right).max(CAUSE) + MARGIN / 2;

    let mut out = String::new();
    {
        let root = SVGBackend::with_string(&mut out, (WIDTH as u32, height as u32)).into_drawing_area();
        root.fill(&PAPER).map_err(failed)?;
        rectangle(&root, [0, 0, WIDTH - 1, height - 1], FRAME.stroke_width(1))?;
        for (i, line) in title.iter().enumerate() {
            bold(&root, line, [MARGIN, MARGIN + rows(i, TITLE_LINE)], TITLE)?;
        }
        bold(&root, "How probable each answer is", [MARGIN, top - 22], HEADING)?;
        for (i, c) in causes.iter().enumerate() {
            cause(&root, c, top + 8 + rows(i, CAUSE))?;
        }
        bold(&root, "Error on drives left out of the fit", [RIGHT, top - 22], HEADING)?;
        if errors.is_empty() {
            text(&root, "no free runs: nothing was corrected", [RIGHT, top + 8], LABEL, SOFT, HPos::Left)?;
        }
        let most = errors.iter().flat_map(Errors::relative).fold(1.0, f64::max);
        for (i, e) in errors.iter().enumerate() {
            error(&root, e, top + 8 + rows(i, GROUP), most)?;
        }
        root.present().map_err(failed)?;
    }
    Ok(out)
}

/// The most probable answers.
fn causes(d: &Diagnosis) -> Vec<&Cause> {
    let worth = |c: &&Cause| c.probability >= SHOWN || is_no_cause(c);
    d.ranked.iter().filter(worth).take(CAUSES).collect()
}

/// Means over the recordings that were left out, quantity by quantity, in the order in which they come.
fn errors(runs: &[FreeRun]) -> Vec<Errors> {
    let of = |quantity: &str| {
        let same: Vec<&FreeRun> = runs.iter().filter(|r| r.quantity == quantity).collect();
        let mean = |f: &dyn Fn(&FreeRun) -> f64| same.iter().map(|r| f(r)).sum::<f64>() / same.len() as f64;
        let (name, unit) = quantity_and_unit(quantity);
        Errors {
            quantity: name,
            unit,
            nominal: mean(&|r| r.nominal),
            retuned: mean(&|r| r.retuned),
            corrected: mean(&|r| r.corrected),
        }
    };
    quantities(runs).into_iter().map(of).filter(|e| e.nominal > 0.0).collect()
}

impl Errors {
    fn relative(&self) -> [f64; 3] {
        [1.0, self.retuned / self.nominal, self.corrected / self.nominal]
    }
}

fn cause(root: &Area<'_>, c: &Cause, y: i32) -> Result<(), PictureError> {
    let name = clip(&for_people(&c.name), width(PANEL - NUMBERS, LABEL, LETTER));
    text(root, &name, [MARGIN, y], LABEL, INK, HPos::Left)?;
    let p = c.probability.clamp(0.0, 1.0);
    let colour = if is_no_cause(c) { NO_CAUSE } else { CORRECTED };
    let whole = PANEL - NUMBERS;
    bar(root, MARGIN, y + 17, whole, whole, TRACK)?;
    bar(root, MARGIN, y + 17, (p * f64::from(whole)).round() as i32, whole, colour)?;
    text(root, &probability(p), [MARGIN + PANEL, y + 17], LABEL, INK, HPos::Right)
}

fn error(root: &Area<'_>, e: &Errors, y: i32, most: f64) -> Result<(), PictureError> {
    let title = format!("{}: rms, mean of the drives", e.quantity);
    text(root, &clip(&title, width(PANEL, LABEL, LETTER)), [RIGHT, y], LABEL, INK, HPos::Left)?;
    let begin = RIGHT + 72;
    let whole = PANEL - 72 - 92;
    let values = [e.nominal, e.retuned, e.corrected];
    let kinds = ["as it is", "re-tuned", "corrected"].into_iter().zip([BEFORE, RETUNED, CORRECTED]);
    for (i, (name, colour)) in kinds.enumerate() {
        let at = y + 23 + rows(i, ERROR);
        text(root, name, [RIGHT, at], LABEL, SOFT, HPos::Left)?;
        bar(root, begin, at + 1, whole, whole, TRACK)?;
        let long = e.relative()[i] / most * f64::from(whole);
        bar(root, begin, at + 1, long.round() as i32, whole, colour)?;
        let value = format!("{} {}", digits(values[i]), e.unit);
        text(root, value.trim(), [RIGHT + PANEL, at], LABEL, INK, HPos::Right)?;
    }
    Ok(())
}

/// Three digits that count.
fn digits(x: f64) -> String {
    let places = if x > 0.0 { (2 - x.log10().floor() as i32).clamp(0, 6) } else { 0 };
    format!("{x:.*}", places as usize)
}

/// A bar of a length between nothing and the whole; at least a hair of it is drawn.
fn bar(root: &Area<'_>, x: i32, y: i32, long: i32, whole: i32, colour: RGBColor) -> Result<(), PictureError> {
    rectangle(root, [x, y, x + long.clamp(1, whole), y + BAR], colour.filled())
}

/// Height of so many rows, px.
fn rows(count: usize, height: i32) -> i32 {
    // A picture has few rows; a hundred are far more than it can hold.
    height * i32::try_from(count.min(100)).unwrap_or(100)
}

/// Letters of a size that fit into a width.
fn width(pixels: i32, size: i32, letter: f64) -> usize {
    (f64::from(pixels) / (letter * f64::from(size))) as usize
}

/// Breaks a sentence into lines of at most so many letters, between words.
fn wrap(sentence: &str, most: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in sentence.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= most => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// At most so many letters, with an ellipsis where some were cut.
fn clip(s: &str, most: usize) -> String {
    if s.chars().count() <= most {
        return s.to_owned();
    }
    s.chars().take(most.saturating_sub(1)).collect::<String>() + "…"
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use verdict::Verdict;

    use super::*;
    use crate::drawing::well_formed;

    fn cause(effect: &str, name: &str, probability: f64) -> Cause {
        Cause {
            effect: effect.to_owned(),
            name: name.to_owned(),
            probability,
            magnitude: None,
            sigma: None,
            unit: "-".into(),
            parameters: BTreeMap::new(),
            side: None,
            place: None,
            intervals: None,
        }
    }

    fn sample() -> Diagnosis {
        let run = |recording: &str, corrected| FreeRun {
            recording: recording.to_owned(),
            quantity: "wheel speed, rad/s".to_owned(),
            nominal: 4.0,
            retuned: 1.5,
            corrected,
            placebo: None,
        };
        Diagnosis {
            verdict: Verdict::Explained,
            sentences: vec!["Missing: extra <mass> & more, 2.5 kg (probability 0.97).".to_owned()],
            ranked: vec![cause("payload", "extra <mass> & more", 0.97), cause("none", "nothing is missing", 0.03)],
            free_runs: vec![run("run_1", 0.1), run("run_2", 0.3)],
            ..Diagnosis::withheld()
        }
    }

    #[test]
    fn is_well_formed_and_names_cause_and_errors() {
        let svg = svg(&sample()).expect("draws");
        well_formed(&svg);
        assert!(svg.starts_with("<svg"));
        assert!(!svg.contains("probability 0.97"), "the bars tell it");
        for text in ["extra &lt;mass&gt; &amp; more", "0.97", "wheel speed", "0.200 rad/s", "corrected"] {
            assert!(svg.contains(text), "lacks {text}");
        }
    }

    #[test]
    fn draws_a_diagnosis_that_says_nothing() {
        let mut d = sample();
        d.sentences.clear();
        d.ranked.clear();
        d.free_runs.clear();
        let svg = svg(&d).expect("draws");
        well_formed(&svg);
        assert!(svg.contains("no free runs"));
    }

    #[test]
    fn wraps_between_words() {
        assert_eq!(wrap("one two three", 7), ["one two", "three"]);
        assert_eq!(clip("abcdef", 4), "abc…");
    }
}
