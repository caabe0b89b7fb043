//! What is asked of the evidence, and what was reached.

use inference::robust::{median, quantile, sorted};
use serde_json::Value;

use super::Evidence;
use super::ask::interval;
use super::husky::Examined;
use super::slopes::{Claim, Outcome, SeenTilt};
use super::turns::{Turns, share};
use crate::output::{Asked, Figure};

/// Loads of one kind over the references': value, half of its interval, ratio and its interval, speed.
struct Load {
    value: f64,
    half: f64,
    ratio: f64,
    interval: [f64; 2],
    speed: f64,
    seconds: f64,
}

fn loads(run: &Examined, quantity: &str) -> Vec<Load> {
    let of = |r: &Value| Load {
        value: r["value"].as_f64().unwrap_or(f64::NAN),
        half: r["half"].as_f64().unwrap_or(f64::NAN),
        ratio: r["ratio"].as_f64().unwrap_or(f64::NAN),
        interval: interval(&r["interval"]),
        speed: r["speed"][1].as_f64().unwrap_or(f64::NAN),
        seconds: r["seconds"].as_f64().unwrap_or(0.0),
    };
    run.open.steady("ratios").iter().filter(|r| r["quantity"] == quantity).map(of).collect()
}

/// All figures; those of which the data hold nothing are left out.
pub(super) fn figures(e: &Evidence) -> Vec<Figure> {
    let mut out = Vec::new();
    labels(e, &mut out);
    tracks(e, &mut out);
    witnesses(e, &mut out);
    turning(e, &mut out);
    forecasts(e, &mut out);
    null(e, &mut out);
    drive(e, &mut out);
    out
}

fn add(out: &mut Vec<Figure>, name: &str, value: Option<f64>, unit: &str, asked: Option<Asked>) {
    if let Some(value) = value {
        let figure = Figure::free(name, value, unit);
        out.push(asked.map_or(figure, |a| Figure::free(name, value, unit).asked(a)));
    }
}

fn labelled<'a>(e: &'a Evidence, label: &'a str) -> impl Iterator<Item = &'a Examined> {
    e.husky.iter().filter(move |r| r.label == label)
}

fn labels(e: &Evidence, out: &mut Vec<Figure>) {
    let sand: Vec<Load> = labelled(e, "SANDY_LOAM").flat_map(|r| loads(r, "straight_load")).collect();
    let off = |centre: f64| move |l: &Load| (l.ratio - centre).abs();
    let most = |all: Vec<f64>| all.into_iter().max_by(f64::total_cmp);
    add(out, "sandy loam: straight load, median of the runs", median(sand.iter().map(|l| l.ratio)), "times", None);
    add(
        out,
        "sandy loam: furthest from 2.05",
        most(sand.iter().map(off(2.05)).collect()),
        "",
        Some(Asked::AtMost(0.25)),
    );
    let width = |l: &Load| 0.5 * (l.interval[1] - l.interval[0]) / l.ratio;
    add(
        out,
        "sandy loam: widest half interval of the straight load",
        most(sand.iter().map(width).collect()),
        "",
        Some(Asked::AtMost(0.2)),
    );
    let fast: Vec<Load> =
        labelled(e, "ASPHALT").flat_map(|r| loads(r, "straight_load")).filter(|l| l.speed > 0.7).collect();
    add(
        out,
        "asphalt at 0.79 m/s: straight load, furthest from 1.05",
        most(fast.iter().map(off(1.05)).collect()),
        "",
        Some(Asked::AtMost(0.15)),
    );
    let turning: Vec<Load> =
        labelled(e, "ASPHALT").flat_map(|r| loads(r, "turning_load")).filter(|l| l.seconds >= 10.0).collect();
    add(
        out,
        "asphalt: turning load, furthest from 1.65",
        most(turning.iter().map(off(1.65)).collect()),
        "",
        Some(Asked::AtMost(0.35)),
    );
    let excludes = turning.iter().filter(|l| l.interval[0] > 1.0).count();
    if !turning.is_empty() {
        add(
            out,
            "asphalt: turning loads whose interval excludes 1",
            Some(share(excludes, turning.len())),
            "",
            Some(Asked::AtLeast(1.0)),
        );
    }
    let given = |r: &Examined| {
        let turns = ["turning_load", "arc_sum", "spin_sum"].iter().any(|q| !loads(r, q).is_empty());
        usize::from(!loads(r, "straight_load").is_empty()) + usize::from(turns)
    };
    let answers: usize = e.husky.iter().map(given).sum();
    if !e.husky.is_empty() {
        add(
            out,
            "straight and turning answers given",
            Some(share(answers, 2 * e.husky.len())),
            "",
            Some(Asked::AtLeast(0.5)),
        );
    }
}

fn tracks(e: &Evidence, out: &mut Vec<Figure>) {
    for (label, range, half) in [("FLOORING", [0.752, 0.792], [0.0, 0.03]), ("SANDY_LOAM", [0.88, 1.02], [0.04, 0.10])]
    {
        let all: Vec<Load> = labelled(e, label).flat_map(|r| loads(r, "effective_track")).collect();
        if all.is_empty() {
            continue;
        }
        let inside = |l: &&Load| l.value >= range[0] && l.value <= range[1];
        let name = format!("{label}: effective tracks in {} to {} m", range[0], range[1]);
        add(out, &name, Some(share(all.iter().filter(inside).count(), all.len())), "", Some(Asked::AtLeast(1.0)));
        let name = format!("{label}: widest half interval of the track");
        add(out, &name, all.iter().map(|l| l.half).max_by(f64::total_cmp), "m", Some(Asked::AtMost(half[1])));
    }
}

/// What the witness saw, and what was claimed.
type Slopes = (Vec<SeenTilt>, Vec<Claim>);

fn witnesses(e: &Evidence, out: &mut Vec<Figure>) {
    slopes_of(e, true, out);
    slopes_of(e, false, out);
    let findings: Vec<bool> = e
        .husky
        .iter()
        .flat_map(|r| [&r.by_currents, &r.by_gyro])
        .flatten()
        .flat_map(|(_, claims)| claims)
        .filter_map(Claim::holds)
        .collect();
    if !findings.is_empty() {
        let held = share(findings.iter().filter(|h| **h).count(), findings.len());
        add(
            out,
            "stated intervals and bounds that hold the witness, all ground",
            Some(held),
            "",
            Some(Asked::AtLeast(0.8)),
        );
    }
    let clocks = sorted(e.husky.iter().filter_map(|r| r.witness.as_ref()).flat_map(|w| &w.left_out).map(|c| c.abs()));
    add(out, "clocks on turns left out: median error", quantile(&clocks, 0.5), "s", Some(Asked::AtMost(0.2)));
    add(out, "clocks on turns left out: 90 % below", quantile(&clocks, 0.9), "s", Some(Asked::AtMost(0.5)));
}

/// Slopes on hard ground, of which something is asked, or on all other ground.
fn slopes_of(e: &Evidence, hard: bool, out: &mut Vec<Figure>) {
    let ground = if hard { "hard ground" } else { "other ground" };
    let runs = || e.husky.iter().filter(move |r| r.hard == hard);
    let both = |of: fn(&Examined) -> Option<&Slopes>| -> Slopes {
        let mut all = Slopes::default();
        for (seen, claims) in runs().filter_map(of) {
            all.0.extend(seen.iter().cloned());
            all.1.extend(claims.iter().cloned());
        }
        all
    };
    for (how, times, angle, (seen, claims)) in [
        ("by currents and yaw rate", 2.5, 1.2, both(|r| r.by_currents.as_ref())),
        ("with roll and pitch rate", 2.0, 1.0, both(|r| r.by_gyro.as_ref())),
    ] {
        let name = |what: &str| format!("{ground}, {how}: {what}");
        let asked = |most: f64| hard.then_some(Asked::AtMost(most));
        let count = |o: Outcome| seen.iter().filter(|s| s.outcome == o).count() as f64;
        let most = |of: &dyn Fn(&SeenTilt) -> Option<f64>| seen.iter().filter_map(of).max_by(f64::total_cmp);
        if !seen.is_empty() {
            add(out, &name("tilts found"), Some(count(Outcome::Found)), "", None);
            add(out, &name("tilts told that decide nothing"), Some(count(Outcome::Tentative)), "", None);
            add(out, &name("tilts reported as not observable"), Some(count(Outcome::Hidden)), "", None);
            add(out, &name("tilts missed"), Some(count(Outcome::Missed)), "", asked(0.0));
        }
        let moments = most(&|s| s.onset.into_iter().chain(s.end).max_by(f64::total_cmp));
        add(out, &name("largest error of onset or end"), moments, "s", asked(times));
        add(out, &name("largest error of the angle"), most(&|s| s.angle), "degrees", asked(angle));
        if runs().next().is_some() {
            let contradicted = seen.iter().filter(|s| s.contradicted).count() as f64;
            add(out, &name("bounds that the witness contradicts"), Some(contradicted), "", asked(0.0));
            let wrong = claims.iter().filter(|c| c.is_false()).count() as f64;
            add(out, &name("claims in which the witness is level"), Some(wrong), "", asked(0.0));
        }
    }
}

fn turning(e: &Evidence, out: &mut Vec<Figure>) {
    let mut all = Turns::default();
    for t in e.husky.iter().filter(|r| r.hard).filter_map(|r| r.turns.as_ref()) {
        all.add(t);
    }
    if all.arcs[0] > 0 {
        add(
            out,
            "hard ground, gyro withheld: turning samples with the right side",
            Some(share(all.arcs[1], all.arcs[0])),
            "",
            Some(Asked::AtLeast(0.95)),
        );
        add(
            out,
            "hard ground, gyro withheld: with the wrong side",
            Some(share(all.arcs[2], all.arcs[0])),
            "",
            Some(Asked::AtMost(0.01)),
        );
        add(
            out,
            "hard ground, gyro withheld: straight samples reported as turning",
            Some(share(all.straight[1], all.straight[0])),
            "",
            Some(Asked::AtMost(0.2)),
        );
    }
    if all.spins[0] > 0 {
        add(
            out,
            "hard ground, gyro withheld: spins reported (unsigned currents have no side)",
            Some(share(all.spins[1], all.spins[0])),
            "",
            Some(Asked::AtLeast(0.95)),
        );
    }
    if !e.husky.is_empty() {
        let stuck: usize = e.husky.iter().map(|r| r.open.steady("standstills").len()).sum();
        add(out, "standstills reported", Some(stuck as f64), "", Some(Asked::AtMost(0.0)));
    }
}

fn forecasts(e: &Evidence, out: &mut Vec<Figure>) {
    let of = |quantity: &'static str| {
        e.husky
            .iter()
            .filter(|r| r.hard)
            .flat_map(|r| r.open.steady("forecasts"))
            .filter(move |f| f["quantity"].as_str().is_some_and(|q| q.starts_with(quantity)))
    };
    let number = |f: &Value, what: &str| f[what].as_f64().unwrap_or(f64::NAN);
    let gain = median(of("torque").map(|f| number(f, "retuned") / number(f, "corrected")));
    add(
        out,
        "hard ground, forecast of currents: re-tuned level over corrected, median of the runs",
        gain,
        "times",
        Some(Asked::AtLeast(1.8)),
    );
    let beats = |f: &&Value| {
        let own = number(f, "corrected");
        f["placebos"].as_array().is_some_and(|p| p.iter().all(|x| x[1].as_f64().is_some_and(|x| x > own)))
    };
    let runs = of("torque").count();
    if runs > 0 {
        let won = share(of("torque").filter(beats).count(), runs);
        add(
            out,
            "hard ground, forecast of currents: better than each placebo",
            Some(won),
            "of the runs",
            Some(Asked::AtLeast(0.833)),
        );
    }
    let yaw = median(of("yaw").map(|f| number(f, "corrected")));
    add(out, "hard ground, forecast of the yaw rate: rms, median of the runs", yaw, "rad/s", Some(Asked::AtMost(0.02)));
}

fn null(e: &Evidence, out: &mut Vec<Figure>) {
    let answers: usize = e.null.iter().map(|b| b.answers).sum();
    if answers > 0 {
        let alarms: usize = e.null.iter().map(|b| b.alarms.len()).sum();
        add(out, "no cause: false alarms per answer", Some(share(alarms, answers)), "", Some(Asked::AtMost(0.1)));
    }
    let sand = || e.joined.iter().filter(|j| j.names[1].starts_with("SANDY"));
    if sand().next().is_some() {
        let errors: Vec<f64> = sand().filter_map(super::blocks::Joined::error).collect();
        let name = "floor, then sand: joins at which a change is reported";
        add(out, name, Some(share(errors.len(), sand().count())), "", None);
        let name = "floor, then sand: largest error of the onset where it is reported";
        add(out, name, errors.into_iter().max_by(f64::total_cmp), "s", None);
    }
}

/// Unseen windows of 2 s; the targets were stated for the Husky.
fn drive(e: &Evidence, out: &mut Vec<Figure>) {
    for robot in &e.drive {
        let husky = robot.answer.diagnosis["response"].is_object() && robot.document["robot"] == "husky-drive";
        for (what, [nominal, retuned, corrected, _]) in robot.free_runs() {
            let most = match what.split(',').next() {
                Some("wheel speed (rms)") => Some(0.5),
                Some("position (rms)") => Some(0.32),
                Some("yaw (rms)") => Some(0.25),
                Some("wheel speed (median)" | "position (median)" | "yaw (median)") => None,
                _ => continue,
            };
            let (name, unit) = what.split_once(", ").unwrap_or((what, ""));
            let asked = |a: Asked| husky.then_some(a);
            let of = |rest: &str| format!("{}: {name}{rest}", robot.name);
            add(out, &of(""), Some(corrected), unit, most.and_then(|m| asked(Asked::AtMost(m))));
            add(out, &of(", nominal over corrected"), Some(nominal / corrected), "times", asked(Asked::AtLeast(2.0)));
            // A wheel has no track: re-tuned it is what it was.
            add(out, &of(", re-tuned over corrected"), Some(retuned / corrected), "times", asked(Asked::AtLeast(1.3)));
        }
    }
}
