//! Effects that begin inside a recording: another response from an instant on.
//!
//! Two responses are fitted, one to the windows before and one to those since, and each recording's instant is moved to
//! where both together leave least, in turn, from several starts. Both are then identified in full, the later one beyond
//! the earlier, and weighed against one response throughout by forecasts of windows that were left out. Of a command step
//! that is left out the others of its recording tell whether it lies before; half of it does where the instant falls into it.

use inference::robust::NINETY_FALL;
use verdict::Element;

use crate::identify::{Found, Identify};
use crate::known::sigmas;
use crate::run::{STEP, WINDOW};
use crate::search::{Began, Instant, Model, Part, Trial, evidence, fit, losses};
use crate::settings::{Onset, SETTINGS};
use crate::windows::{FOLDS, Windows};

const ONSET: Onset = SETTINGS.onset;

/// What one response throughout, or another from an instant on, explains best.
pub(crate) fn found<I: Identify>(of: &I, windows: &Windows, base: &Model<I::Law>) -> Found<I::Law> {
    let throughout = of.identify(windows, base);
    let begun = search(of, windows, &throughout.trial).and_then(|early| begun(of, windows, base, &throughout, &early));
    begun.unwrap_or(throughout)
}

/// Indices of each recording's windows.
fn runs(windows: &Windows) -> Vec<Vec<usize>> {
    let mut out: Vec<Vec<usize>> = Vec::new();
    for (w, window) in windows.list.iter().enumerate() {
        if out.len() <= window.run {
            out.resize(window.run + 1, Vec::new());
        }
        out[window.run].push(w);
    }
    out
}

/// Command steps of some windows.
fn steps(windows: &Windows, of: impl Iterator<Item = usize>) -> usize {
    let mut blocks: Vec<usize> = of.map(|w| windows.list[w].block).collect();
    blocks.dedup();
    blocks.len()
}

/// Whether an instant inside a recording leaves enough steps on both sides of it.
fn is_inside(windows: &Windows, early: &[bool]) -> bool {
    runs(windows).iter().any(|run| {
        let side = |is: bool| steps(windows, run.iter().copied().filter(move |w| early[*w] == is));
        side(true).min(side(false)) >= ONSET.steps
    })
}

/// Cost of each number of early windows in a recording, of windows that count.
fn costs(run: &[usize], losses: [&[f64]; 2], counts: impl Fn(usize) -> bool) -> Vec<f64> {
    let [before, since] = losses;
    let all: f64 = run.iter().filter(|w| counts(**w)).map(|w| since[*w]).sum();
    let mut out = vec![all];
    for &w in run {
        let moved = if counts(w) { before[w] - since[w] } else { 0.0 };
        out.push(out[out.len() - 1] + moved);
    }
    out
}

/// Which windows lie before, so that both responses leave least. Windows that do not count follow their neighbours: where
/// it began among them half of them lie before, and it begins nowhere in a recording of which none counts.
fn assigned(windows: &Windows, losses: [&[f64]; 2], counts: impl Fn(usize) -> bool + Copy) -> Vec<bool> {
    let mut early = vec![false; windows.list.len()];
    for run in runs(windows) {
        let cost = costs(&run, losses, counts);
        let least = cost.iter().copied().fold(f64::INFINITY, f64::min);
        let Some(first) = cost.iter().position(|c| *c <= least) else { continue };
        let gap = run[first..].iter().take_while(|w| !counts(**w)).count();
        let told_before = run[..first].iter().any(|w| counts(*w));
        let told_since = first + gap < run.len();
        let before = match (told_before, told_since) {
            (true, true) => first + gap / 2,
            (false, true) => 0,
            (_, false) => run.len(),
        };
        run[..before].iter().for_each(|w| early[*w] = true);
    }
    early
}

/// Which windows of a fold lie before, each told by the other command steps: its own says nothing.
fn told_by_others(windows: &Windows, losses: [&[f64]; 2], fold: usize) -> Vec<bool> {
    let mut out = assigned(windows, losses, |_| true);
    let own: Vec<usize> = (0..out.len()).filter(|w| windows.fold(*w) == fold).collect();
    for step in own.chunk_by(|a, b| windows.list[*a].block == windows.list[*b].block) {
        let block = windows.list[step[0]].block;
        let early = assigned(windows, losses, |w| windows.list[w].block != block);
        for &w in step {
            out[w] = early[w];
        }
    }
    out
}

/// Where an onset seems to lie: which windows are before it.
fn search<I: Identify>(of: &I, windows: &Windows, throughout: &Trial<I::Law>) -> Option<Vec<bool>> {
    let part = of.part(windows);
    let mut start = throughout.model.clone();
    let mut free: Vec<usize> = of.may_begin(windows).iter().flat_map(|e| part.free(start.law, *e)).collect();
    free.sort_unstable();
    for &k in free.iter().filter(|k| start.x[**k].is_infinite()).collect::<Vec<_>>() {
        start.x[k] = part.guess(k);
    }
    let mut best: Option<(f64, Vec<bool>)> = None;
    for share in ONSET.starts {
        let mut early = vec![false; windows.list.len()];
        for run in runs(windows) {
            run[..(share * run.len() as f64) as usize].iter().for_each(|w| early[*w] = true);
        }
        if !is_inside(windows, &early) {
            continue;
        }
        let mut models = [start.clone(), start.clone()];
        for _ in 0..ONSET.rounds {
            let late: Vec<bool> = early.iter().map(|e| !e).collect();
            for (model, used) in models.iter_mut().zip([&early, &late]) {
                *model = fit(&part, model, &free, used, SETTINGS.fit.iterations_beside).0;
            }
            let [before, since] = [losses(&part, &models[0]), losses(&part, &models[1])];
            let moved = assigned(windows, [&before, &since], |_| true);
            if !is_inside(windows, &moved) {
                break;
            }
            let cost = early_or_late(&moved, &before, &since).iter().sum::<f64>() / moved.len() as f64;
            if best.as_ref().is_none_or(|(least, _)| cost < *least) {
                best = Some((cost, moved.clone()));
            }
            if moved == early {
                break;
            }
            early = moved;
        }
    }
    // What hardly falls in the windows that were fitted does not fall in those that were left out.
    best.filter(|(cost, _)| throughout.level() > (1.0 + ONSET.relevant) * cost).map(|(_, early)| early)
}

fn early_or_late(early: &[bool], before: &[f64], since: &[f64]) -> Vec<f64> {
    early.iter().zip(before.iter().zip(since)).map(|(early, (b, s))| if *early { *b } else { *s }).collect()
}

/// Both responses in full, where they forecast left-out windows better than one throughout.
fn begun<I: Identify>(
    of: &I,
    windows: &Windows,
    base: &Model<I::Law>,
    throughout: &Found<I::Law>,
    early: &[bool],
) -> Option<Found<I::Law>> {
    let parts = [windows.only(|w| early[w]), windows.only(|w| !early[w])];
    let folds = |part: &Windows| (0..FOLDS).filter(|f| part.list.iter().any(|w| w.fold == *f)).count();
    if parts.iter().any(|part| folds(part) < 2) {
        return None;
    }
    let before = of.identify(&parts[0], base);
    let since = of.identify(&parts[1], &before.trial.model);
    let changed = changed(of, &parts, &before.trial, &since.trial);
    if changed.is_empty() {
        return None;
    }

    let part = of.part(windows);
    let mut early_without = Vec::with_capacity(FOLDS);
    let mut loss = vec![0.0; windows.list.len()];
    for fold in 0..FOLDS {
        let [b, s] = [&before.trial, &since.trial].map(|t| losses(&part, &t.folds[fold]));
        let early = told_by_others(windows, [&b, &s], fold);
        let of_window = early_or_late(&early, &b, &s);
        (0..loss.len()).filter(|w| windows.fold(*w) == fold).for_each(|w| loss[w] = of_window[w]);
        early_without.push(early);
    }
    let gained = evidence(windows, &throughout.trial.loss, &loss);
    if gained.rise < ONSET.relevant || gained.score + SETTINGS.evidence.prior < ONSET.prior {
        return None;
    }

    let [b, s] = [&before.trial, &since.trial].map(|t| losses(&part, &t.model));
    let instants = instants(windows, [&b, &s]);
    if !instants.iter().any(|i| i.range.is_some()) {
        return None;
    }
    let mut known = since.evidence;
    for (element, e) in before.evidence {
        match known.iter_mut().find(|(other, _)| *other == element) {
            Some((_, k)) if e.score > k.score => *k = e,
            Some(_) => {}
            None => known.push((element, e)),
        }
    }
    let began = Began { before: before.trial, windows: parts, early_without, changed, instants };
    let trial = Trial { began: Some(Box::new(began)), ..since.trial };
    let scaling_is_told = before.scaling_is_told && since.scaling_is_told;
    Some(Found { trial, evidence: known, alternatives: since.alternatives, scaling_is_told })
}

/// Elements whose constants differ by more than both fits leave open, and which the windows before will not have: a limit
/// that was not reached there may have been there all the same.
fn changed<I: Identify>(of: &I, windows: &[Windows; 2], before: &Trial<I::Law>, since: &Trial<I::Law>) -> Vec<Element> {
    let [then, now] = [of.part(&windows[0]), of.part(&windows[1])];
    let [of_then, of_now] = [sigmas(&then, before), sigmas(&now, since)];
    let sigma = |t: &Trial<I::Law>, all: &[Option<f64>], k: usize| {
        t.free.iter().position(|f| *f == k).map_or(Some(0.0), |i| all[i])
    };
    let differs = |&k: &usize| {
        let both = sigma(before, &of_then, k).zip(sigma(since, &of_now, k));
        let off = (since.model.x[k] - before.model.x[k]).abs();
        both.is_some_and(|(a, b)| off > ONSET.changed * a.hypot(b))
    };
    let usual = losses(&then, &before.model);
    let is_refused = |e: Element| {
        let held: Vec<Element> = before.elements.iter().copied().chain([e]).collect();
        let law = then.restrict(since.model.law, before.model.law, &held);
        let mut with = Model { law, ..before.model.clone() };
        now.free(since.model.law, e).iter().for_each(|&k| with.x[k] = since.model.x[k]);
        evidence(&windows[0], &losses(&then, &with), &usual).score > 0.0
    };
    let elements = since.elements.iter().copied();
    elements.filter(|e| now.free(since.model.law, *e).iter().any(differs) && is_refused(*e)).collect()
}

/// When it began in each recording that has it, with 90 % intervals by the profile of the cost: a window counts as one
/// number, and says no better than to its own length when.
fn instants(windows: &Windows, losses: [&[f64]; 2]) -> Vec<Instant> {
    let early = assigned(windows, losses, |_| true);
    let all = early_or_late(&early, losses[0], losses[1]);
    let level = all.iter().sum::<f64>() / all.len().max(1) as f64;
    let length = WINDOW as f64 * STEP;
    let mut out = Vec::new();
    for (run, list) in runs(windows).into_iter().enumerate() {
        let cost = costs(&list, losses, |_| true);
        let first = list.iter().filter(|w| early[**w]).count();
        let Some(&at) = list.get(first) else { continue };
        let end = windows.end(at);
        let gain = (cost[list.len()] - cost[first]) / (2.0 * level.max(f64::MIN_POSITIVE));
        if first == 0 {
            out.push(Instant { run, interval: [0.0, end], range: None, gain });
            continue;
        }
        let open = |k: &usize| cost[*k] - cost[first] <= 2.0 * level * NINETY_FALL;
        let earliest = (0..=first).rev().take_while(open).last().unwrap_or(first);
        let latest = (first..list.len()).take_while(open).last().unwrap_or(first);
        let range = [windows.time(list[earliest]) - length, windows.time(list[latest]) + length];
        out.push(Instant {
            run,
            interval: [windows.time(at), end],
            range: Some([range[0].max(0.0), range[1].min(end)]),
            gain,
        });
    }
    out
}

#[cfg(test)]
mod tests {
    use verdict::{Cause, Diagnosis, Verdict};

    use super::*;
    use crate::controller::{DEAD_TIME, TURN_LIMIT};
    use crate::ground::TRACK;
    use crate::testing::{Truth, alone, diagnosed, robot};
    use crate::{ResponseCase, ResponseRun, diagnose_response};
    use inference::Options;

    /// The same robot, another one from `at` on.
    fn begins(at: f64, truth: Truth, change: impl Fn(&mut Truth), of: fn() -> Truth) -> Truth {
        let mut later = of();
        change(&mut later);
        Truth { later: Some((at, Box::new(later))), ..truth }
    }

    fn cause<'a>(d: &'a Diagnosis, id: &str) -> &'a Cause {
        d.ranked.iter().find(|c| c.effect == id).unwrap_or_else(|| panic!("no {id} in {:?}", d.ranked))
    }

    fn began(d: &Diagnosis, id: &str, recording: &str, at: f64) {
        let intervals = cause(d, id).intervals.as_ref().unwrap_or_else(|| panic!("{id} has no onset"));
        let [from, _] = intervals[recording][0];
        assert!((from - at).abs() < 6.0, "{id}: {from}, not {at}");
        let span = d.located.spans.iter().find(|s| s.recording == recording).expect("a span");
        let [early, late] = span.onset.expect("an onset");
        assert!(early <= at && at <= late && late - early < 20.0, "{span:?}");
    }

    fn value(d: &Diagnosis, id: &str) -> f64 {
        d.response.as_ref().expect("a response").parameters.iter().find(|p| p.id == id).map_or(f64::NAN, |p| p.value)
    }

    #[test]
    fn a_dead_time_that_begins_is_found_with_its_instant_and_size() {
        let truth = begins(70.0, Truth::stock(), |t| t.drive[DEAD_TIME] = 0.6, Truth::stock);
        let reference = Truth::stock();
        let d = diagnosed(&truth, Some(&reference));
        assert_eq!((d.verdict, &*d.ranked[0].effect), (Verdict::Explained, "transport_delay"), "{:?}", d.ranked);
        began(&d, "transport_delay", "a", 70.0);
        began(&d, "transport_delay", "b", 70.0);
        assert!((value(&d, "dead_time") - 0.6).abs() < 0.03, "{}", value(&d, "dead_time"));
        assert!(d.sentences[1].contains("It begins inside a recording") && d.sentences[1].contains("dead time 0.6"));
    }

    #[test]
    fn a_limit_that_begins_beside_a_response_that_stays_is_told_apart_from_it() {
        let free = || {
            let mut truth = Truth::stock();
            truth.drive[TURN_LIMIT] = f64::INFINITY;
            truth
        };
        let truth = begins(80.0, free(), |t| t.drive[TURN_LIMIT] = 1.0, free);
        let d = diagnosed(&truth, None);
        assert_eq!(d.verdict, Verdict::Explained, "{:?}", d.ranked);
        assert!((value(&d, "turn_limit") - 1.0).abs() < 0.1 && (value(&d, "dead_time") - 0.22).abs() < 0.03);
        assert_eq!(cause(&d, "transport_delay").intervals, None);
        assert!(
            d.sentences.iter().any(|s| s.contains("turn limit 1.0") && s.contains("no limit")),
            "{:?}",
            d.sentences
        );
    }

    #[test]
    fn a_track_that_widens_in_one_recording_only_is_absent_in_the_other() {
        let truth = begins(90.0, Truth::perfect(), |t| t.ground[TRACK] = 1.5, Truth::perfect);
        let recordings = vec![truth.run("a", 30, 4), Truth::perfect().run("b", 20, 5)];
        let case = alone(recordings);
        let d = diagnose_response(&case, &Options::default(), &|_| {}).expect("a diagnosis");
        assert_eq!(d.ranked[0].effect, "effective_track", "{:?}", d.ranked);
        began(&d, "effective_track", "a", 90.0);
        assert!(!d.ranked[0].intervals.as_ref().expect("when").contains_key("b"), "{:?}", d.ranked[0]);
        assert!((value(&d, "track_factor") - 1.5).abs() < 0.05);
        // What was forecast without a fold knew the instant from the others.
        let row = d.free_runs.iter().find(|r| r.quantity.starts_with("yaw (rms)")).expect("a row");
        assert!(2.0 * row.corrected < row.retuned, "{row:?}");
    }

    #[test]
    fn what_is_there_all_the_time_or_never_does_not_begin() {
        for truth in [Truth::perfect(), Truth::stock()] {
            let recordings = vec![truth.run("a", 30, 31), truth.run("b", 30, 32)];
            let case = ResponseCase {
                robot: robot(),
                geometry_sigma: [0.01; 2],
                references: vec![],
                recordings,
                held_out: vec![],
            };
            let d = diagnose_response(&case, &Options::default(), &|_| {}).expect("a diagnosis");
            assert!(d.ranked.iter().all(|c| c.intervals.is_none()) && d.located.spans.is_empty(), "{:?}", d.ranked);
        }
    }

    #[test]
    fn an_instant_in_a_left_out_part_is_told_by_the_rest() {
        let run: ResponseRun = Truth::perfect().run("a", 10, 6);
        let windows = Windows::new(&[run]);
        let n = windows.list.len();
        let (before, since): (Vec<f64>, Vec<f64>) =
            (0..n).map(|w| if w < 12 { (0.0, 1.0) } else { (1.0, 0.0) }).unzip();
        let count = |early: Vec<bool>| early.iter().filter(|e| **e).count();
        assert_eq!(count(assigned(&windows, [&before, &since], |_| true)), 12);
        // Windows 10 to 17 are left out: the instant lies somewhere among them.
        assert_eq!(count(assigned(&windows, [&before, &since], |w| !(10..18).contains(&w))), 14);
    }
}
