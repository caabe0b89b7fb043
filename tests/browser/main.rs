//! The pages in a browser: nothing fails, nothing is fetched, cursors and zoom work, and everything can be read.
//!
//! Needs Chromium (`chromium` on the path, or the variable CHROME); without it the tests are ignored.

mod chrome;
mod pages;

use chrome::{Chrome, Shown};
use serde_json::Value;
use skipping::Outcome;

/// Width, height of a screen and of a phone, px.
const SCREEN: [u32; 2] = [1400, 900];
const PHONE: [u32; 2] = [400, 800];

/// Contrasts below this are hard to read (WCAG AA for text of any size).
const CONTRAST: f64 = 4.5;

/// Visible texts whose contrast is too low, and elements that reach beyond the window.
const POOR_TEXT: &str = include_str!("contrast.js");

/// What is wrong with a page as it is shown.
fn readable(shown: &Shown, name: &str) {
    let poor = shown.json(&POOR_TEXT.replace("LEAST", &CONTRAST.to_string()));
    assert_eq!(poor, Value::Array(Vec::new()), "{name}: texts of low contrast");
    let wide = shown.json("document.documentElement.scrollWidth - innerWidth");
    assert!(wide.as_f64().is_some_and(|w| w <= 0.0), "{name}: {wide} px too wide");
}

/// Every page opens without error or network and can be read, on a screen and on a phone, light and dark.
fn opened(chrome: &Chrome, pages: Vec<(&str, String)>) {
    for (name, html) in pages {
        for (what, size, dark) in [("1400", SCREEN, false), ("1400-dark", SCREEN, true), ("400", PHONE, false)] {
            let shown = chrome.open(name, &html, size, dark);
            let name = format!("{name}-{what}");
            readable(&shown, &name);
            shown.screenshot(&name);
            assert_eq!(shown.complaints(), Vec::<String>::new(), "{name}");
            assert!(shown.json("plots.length > 0 && plots.some(p => p.drawn)") == Value::Bool(true));
        }
    }
}

fn every_page_opens_without_error_or_network_and_can_be_read() -> Outcome {
    opened(&Chrome::find()?, pages::all());
    Ok(())
}

fn the_page_of_a_real_robot_opens_without_error_or_network_and_can_be_read() -> Outcome {
    let chrome = Chrome::find()?;
    opened(&chrome, vec![("speed", pages::speed()?)]);
    Ok(())
}

fn names_from_files_stay_text() -> Outcome {
    let chrome = Chrome::find()?;
    let shown = chrome.open("hostile", &pages::long(), SCREEN, false);
    assert_eq!(shown.json("document.querySelectorAll('img, script[src], iframe').length"), 0);
    assert_eq!(shown.json("window.harm === undefined"), true);
    assert!(
        shown.json("document.querySelector('h1').textContent").as_str().is_some_and(|t| t.contains(pages::HOSTILE))
    );
    assert_eq!(shown.complaints(), Vec::<String>::new());
    Ok(())
}

fn the_page_of_a_fleet_keeps_names_as_text_and_draws_sizes_with_intervals() -> Outcome {
    let chrome = Chrome::find()?;
    let shown = chrome.open("fleet", &pages::fleet(), SCREEN, false);
    assert_eq!(shown.json("document.querySelectorAll('img, script[src], iframe').length"), 0);
    assert_eq!(shown.json("window.harm === undefined"), true);
    let lines = "plots.filter(p => specOf(p).kind === 'lines')";
    assert_eq!(shown.json(&format!("{lines}.length")), 2, "one chart for each robot with sizes");
    let sized = "(l => l[0].intervals.length === l[0].y.length && l.length === 2)(specOf(p).lines)";
    assert_eq!(shown.json(&format!("{lines}.every(p => {sized})")), true, "sizes with intervals, and a line");
    assert_eq!(shown.complaints(), Vec::<String>::new());
    Ok(())
}

fn the_cursor_shows_all_signals_in_all_plots_of_a_recording() -> Outcome {
    let chrome = Chrome::find()?;
    let shown = chrome.open("cursor", &pages::long(), SCREEN, false);
    shown.json("scrollTo({ top: plots[0].getBoundingClientRect().top + scrollY - 100, behavior: 'instant' })");
    let [x, y] = shown.middle_of("plots[0]");
    for dx in 0..3 {
        shown.point_at(x + f64::from(dx), y);
    }
    shown.wait_for("document.querySelectorAll('.values .at').length === 2");
    let of_all =
        "plots.filter(p => specOf(p).kind === 'time' && p.drawn).map(p => specOf(p).rows.flatMap(r => r.lines).length)";
    let values = "[...document.querySelectorAll('.values')].map(v => v.querySelectorAll('b').length)";
    assert_eq!(shown.json(values), shown.json(of_all));
    assert_eq!(
        shown.json("new Set([...document.querySelectorAll('.values .at')].map(a => a.textContent)).size"),
        1,
        "one instant in both"
    );
    assert_eq!(shown.json("plots.find(p => specOf(p).kind === 'path').data.at(-1).x.length"), 1, "and on the ground");
    assert_eq!(shown.complaints(), Vec::<String>::new());
    Ok(())
}

fn zooming_shows_more_points_in_all_plots_of_a_recording_and_no_peak_is_ever_lost() -> Outcome {
    let chrome = Chrome::find()?;
    let shown = chrome.open("zoom", &pages::long(), SCREEN, false);
    let step = "(p => (p.data[0].x.at(-1) - p.data[0].x[0]) / p.data[0].x.length)(plots[0])";
    let count = shown.json("plots[0].data[0].x.length").as_f64().expect("a count");
    assert!(count < 4.0 * 1400.0, "{count} points in a plot of 1400 px");
    assert_eq!(shown.json("Math.max(...plots[0].data[0].y)"), pages::PEAK);
    let before = shown.json(step).as_f64().expect("a step");
    shown.json("scrollTo({ top: plots[0].getBoundingClientRect().top + scrollY - 100, behavior: 'instant' })");
    let [x, y] = shown.middle_of("plots[0]");
    shown.drag([x, y], [x + 60.0, y]);
    shown.wait_for("plots[0].view != null");
    let after = shown.json(step).as_f64().expect("a step");
    assert!(after < 0.2 * before, "a point every {before} s, then every {after} s");
    let ranges =
        "new Set(plots.filter(p => specOf(p).kind === 'time' && p.drawn).map(p => String(p.layout.xaxis.range))).size";
    assert_eq!(shown.json(ranges), 1, "plots of one recording have one range");
    let breaks = "plots[0].data[1].y.filter(v => v === null).length > 3";
    assert_eq!(shown.json(breaks), true, "free runs are drawn apart");
    let gap = "(p => p.data[0].y.filter(v => v === null).length)(plots[0])";
    shown.json(&format!("show(plots[0], [{}, {}])", pages::GAP[0] - 10.0, pages::GAP[1] + 10.0));
    assert!(shown.json(gap).as_f64().is_some_and(|n| n > 0.0), "gaps are drawn as gaps");
    shown.json("show(plots[0], null)");
    assert_eq!(shown.json("Math.max(...plots[0].data[0].y)"), pages::PEAK);
    assert_eq!(shown.complaints(), Vec::<String>::new());
    Ok(())
}

fn the_keyboard_moves_the_cursor_and_zooms() -> Outcome {
    let chrome = Chrome::find()?;
    let shown = chrome.open("keys", &pages::long(), SCREEN, false);
    shown.press("Tab");
    assert_eq!(shown.json("document.activeElement.className"), "skip", "the first stop skips the header");
    shown.json("plots[0].focus()");
    assert_eq!(shown.json("getComputedStyle(plots[0]).outlineStyle"), "solid", "the focus can be seen");
    for _ in 0..3 {
        shown.press("ArrowRight");
    }
    let said = shown.json("plots[0].parentElement.querySelector('.readout').textContent");
    assert!(said.as_str().is_some_and(|s| s.contains("recorded") && s.contains("corrected")), "{said}");
    shown.press("+");
    shown.wait_for("plots[0].view != null");
    let wide = "plots[0].view[1] - plots[0].view[0]";
    let once = shown.json(wide).as_f64().expect("a width");
    shown.press("+");
    let twice = shown.json(wide).as_f64().expect("a width");
    assert!((twice / once - 0.5).abs() < 0.1, "{once} s, then {twice} s");
    shown.press("0");
    shown.wait_for("plots[0].view == null");
    assert_eq!(shown.complaints(), Vec::<String>::new());
    Ok(())
}

fn the_theme_can_be_chosen_and_paper_is_white() -> Outcome {
    let chrome = Chrome::find()?;
    let shown = chrome.open("print", &pages::long(), SCREEN, true);
    let ink = "getComputedStyle(document.body).color + plots[0].layout.font.color";
    let dark = shown.json(ink);
    shown.json("document.getElementById('theme').click()");
    assert_ne!(shown.json(ink), dark);
    readable(&shown, "chosen light");
    shown.json("document.getElementById('theme').click()");
    assert_eq!(shown.json(ink), dark);
    shown.json(&format!("void addEventListener('beforeprint', () => {{ window.printed = {ink}; }})"));
    shown.print("diagnosis");
    let printed = shown.json("window.printed");
    assert!(printed.is_string() && printed != dark, "{printed}");
    assert_eq!(shown.json(ink), dark, "and dark again afterwards");
    assert_eq!(shown.complaints(), Vec::<String>::new());
    Ok(())
}

skipping::tests![
    every_page_opens_without_error_or_network_and_can_be_read,
    the_page_of_a_real_robot_opens_without_error_or_network_and_can_be_read,
    names_from_files_stay_text,
    the_page_of_a_fleet_keeps_names_as_text_and_draws_sizes_with_intervals,
    the_cursor_shows_all_signals_in_all_plots_of_a_recording,
    zooming_shows_more_points_in_all_plots_of_a_recording_and_no_peak_is_ever_lost,
    the_keyboard_moves_the_cursor_and_zooms,
    the_theme_can_be_chosen_and_paper_is_white,
];
