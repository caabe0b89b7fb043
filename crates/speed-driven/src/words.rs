//! Parts of a speed-driven case in words.

use crate::Alignment;
use crate::compare::{Judgement, judgement, no_difference};
use crate::settings::{MEASURING, NAMING, naming::Sentences};
use robot_model::effect::LoadTerm;
use verdict::{
    ClockError, Hidden, LoadChange, OtherGround, Quantity, Ratio, RecordingGroup, SideChange, Standstill, Turning,
    TurningChange, Way, sentence_case,
};

const SENTENCES: Sentences = NAMING.sentences;

/// How well clocks were aligned; `None` where there was one clock only.
pub(crate) fn clocks(all: &[ClockError]) -> Option<String> {
    let [from, until] = all.iter().fold([f64::MAX, f64::MIN], |[a, b], c| [a.min(c.lag[0]), b.max(c.lag[1])]);
    let left_out: Vec<f64> = all.iter().flat_map(|c| c.left_out.iter().copied()).collect();
    let pooled = Alignment { lag: Vec::new(), left_out };
    let error = pooled.error().map_or_else(
        || "there are too few turns to check how well".to_owned(),
        |[median, most]| {
            let turns = pooled.left_out.len();
            format!(
                "checked on {turns} turns left out one by one, the alignment errs by \
                 {median:.2} s in the median, by less than {most:.2} s in 90 %"
            )
        },
    );
    (!all.is_empty()).then(|| {
        format!(
            "the gyro runs on another clock than the wheels: it was aligned by matching the turns, with a lag of \
             {from:.2} s to {until:.2} s; {error}"
        )
    })
}

/// How a load compares with `theirs`.
pub(crate) fn compared(r: &Ratio, theirs: &str) -> String {
    let [a, b] = r.interval;
    match r.quantity {
        Quantity::EffectiveTrack => format!(
            "{:.3} ± {:.3} m (90 %), {:.2} times {theirs} (90 % interval {a:.2} to {b:.2})",
            r.value, r.half, r.ratio
        ),
        Quantity::Drift => format!(
            "{:.3} {} {theirs} (90 % interval of the difference {a:+.3} to {b:+.3})",
            r.ratio.abs(),
            if r.ratio < 0.0 { "below" } else { "above" }
        ),
        Quantity::Asymmetry | Quantity::SpinAsymmetry => format!(
            "{:.2} {} {theirs} (90 % interval of the difference {a:+.2} to {b:+.2})",
            r.ratio.abs(),
            if r.ratio < 0.0 { "below" } else { "above" }
        ),
        _ => format!("{:.2} times {theirs} (90 % interval {a:.2} to {b:.2})", r.ratio),
    }
}

/// "straight load at 0.52 m/s".
fn named_at(r: &Ratio) -> String {
    let ([slow, fast], name) = (r.range, r.quantity.name());
    let sign = match r.quantity {
        Quantity::Drift => " (right less left speed that would turn the body as much, as a share of the speed)",
        quantity if quantity.is_difference() => " (right less left, as a share of both)",
        _ => "",
    };
    match r.quantity {
        Quantity::StraightLoad | Quantity::Asymmetry if fast - slow > SENTENCES.one_speed => {
            format!("{name}{sign} at {slow:.2} to {fast:.2} m/s")
        }
        Quantity::StraightLoad | Quantity::Asymmetry => format!("{name}{sign} at {:.2} m/s", r.speed[1]),
        _ => format!("{name}{sign}"),
    }
}

/// A load, how it compares with `theirs`, and whether its interval shows a difference.
pub(crate) fn load(r: &Ratio, theirs: &str) -> String {
    let at = named_at(r);
    let compared = compared(r, theirs);
    let judgement = match judgement(r) {
        Judgement::Alike => {
            format!("no difference is shown, since the interval contains {}", no_difference(r.quantity))
        }
        Judgement::Unnamed => {
            "it differs, but a cold drive train varies as much, so this load alone names no cause".to_owned()
        }
        Judgement::Differs => "it differs".to_owned(),
    };
    let firm = if r.firm { String::new() } else { format!(" (tentative: less than {:.0} s)", MEASURING.ratios.firm) };
    format!("{}: the {at} is {compared}, measured over {:.0} s{firm}: {judgement}.", titled(&r.recording), r.seconds)
}

/// "recording 01", "recordings 01, 05".
pub(crate) fn recordings(names: &str) -> String {
    format!("recording{} {names}", if names.contains(", ") { "s" } else { "" })
}

/// The same at the beginning of a sentence.
fn titled(names: &str) -> String {
    recordings(names).replacen('r', "R", 1)
}

pub(crate) fn standstill(s: &Standstill) -> String {
    let [from, until] = s.interval;
    let what = if s.side.is_some() { "wheels are held" } else { "the robot stands" };
    format!("{}, from {from:.1} s to {until:.1} s: {what}: {}.", titled(&s.recording), how_it_stands(s))
}

/// By what a body is seen to stand.
pub(crate) fn how_it_stands(s: &Standstill) -> String {
    if let Some(wheels) = s.wheels {
        let whose = match &s.side {
            Some(side) => {
                format!("the wheels of the {side} side turn at {:.0} % of the speed that is commanded", 100.0 * wheels)
            }
            None => format!("its wheels turn at {:.0} % of the speed that is commanded", 100.0 * wheels),
        };
        let on = if s.side.is_some() { "them" } else { "the more loaded side" };
        return format!("{whose}, with {:.0} N m on {on}", s.load);
    }
    match s.share {
        Some(share) => format!(
            "it turns at {:.0} % of the rate that its wheels ask for, with {:.0} N m on the more loaded side",
            // Never "-0".
            (100.0 * share).round() + 0.0,
            s.load
        ),
        None => format!(
            "straight driving takes {:.0} N m on the more loaded side, more than any ground resists rolling by itself",
            s.load
        ),
    }
}

/// A side that takes another torque from an instant on.
pub(crate) fn side_change(c: &SideChange) -> String {
    let ([before, after], SideChange { side, half, .. }) = (c.torque, c);
    let (more, what) = if after > before {
        ("more", "something drags on that side, or its motor gives less torque than before")
    } else {
        ("less", "something that dragged on that side let go, or its motor gives more torque than before")
    };
    format!(
        "{}, from {} until the end: the {side} side takes {:.1} ± {half:.1} N m {more} in straight driving than before ({after:.1} \
         after {before:.1} N m; 90 %), and the other side hardly changes: {what}. Ground would change both sides.",
        titled(&c.recording),
        moment(c.onset),
        (after - before).abs()
    )
}

/// What a reference that stands does to the answer.
pub(crate) fn standing_reference(s: &Standstill) -> String {
    let [from, until] = s.interval;
    let what = match &s.side {
        Some(side) => format!("the wheels of the {side} side are held although they are commanded to turn"),
        None => "the robot stands although it is commanded to drive".to_owned(),
    };
    format!("reference {}: from {from:.1} s to {until:.1} s {what}; these rows are not used", s.recording)
}

/// "196.6 s", or "between 183.8 s and 200.9 s" where it is hidden.
fn moment([a, b]: [f64; 2]) -> String {
    if b - a < SENTENCES.moment { format!("{:.1} s", 0.5 * (a + b)) } else { format!("between {a:.1} s and {b:.1} s") }
}

/// What a sentence calls the term of the load that an effect stands for.
fn term_name(effect: &str) -> Option<&'static str> {
    let entry = catalogue::find(effect)?;
    entry.effect.and_then(|e| e.load_term).map(LoadTerm::name).or(Some(entry.label()))
}

pub(crate) fn change(c: &LoadChange) -> String {
    let causes: Vec<&str> = c.causes.iter().map(|id| term_name(id).unwrap_or(id)).collect();
    let way = if c.slope > 0.0 { "uphill" } else { "downhill" };
    let size = if c.bound {
        format!("at least {:.1}° {way}", c.slope.abs())
    } else {
        format!("{:.1} ± {:.1}° {way} (90 %)", c.slope.abs(), c.slope_half)
    };
    let what = match c.ratio {
        Some(ratio) if c.bound => format!(
            "the straight load is at most {ratio:.2} times that of \
             the rest; a slope that does this is {size}"
        ),
        Some(ratio) => format!(
            "the straight load is {ratio:.2} times that of the rest; a slope \
             that does this is {size}"
        ),
        None if c.relative => {
            format!("the body tilts nose {} against the rest of the drive", if c.slope > 0.0 { "up" } else { "down" })
        }
        None => format!("the slope is {size}"),
    };
    format!(
        "{}, from {} until {}: {what}. Cause: {} ({}).",
        titled(&c.recording),
        moment(c.onset),
        moment(c.end),
        causes.join(" or "),
        c.reason
    )
}

/// Tilts that decide nothing.
pub(crate) fn tentative(tilts: &[LoadChange]) -> Option<String> {
    let most = tilts.iter().map(|c| c.slope.abs()).max_by(f64::total_cmp)?;
    let mut when: Vec<String> = Vec::new();
    for c in tilts {
        let [from, until] = c.interval;
        when.push(format!("{} {from:.0}-{until:.0} s", recordings(&c.recording)));
    }
    let more = when.len().saturating_sub(SENTENCES.hidden);
    when.truncate(SENTENCES.hidden);
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    Some(format!(
        "In turns the three rates leave a tilt of up to {most:.1}° open ({}{more}): a roll that drifts shows the same. It \
         decides nothing here; drive straight there, or record an accelerometer.",
        when.join(", ")
    ))
}

/// A stretch on other ground, without its recording: how it compares with `theirs`, and what fits.
pub(crate) fn other_ground(g: &OtherGround, theirs: &str) -> String {
    let [from, until] = g.interval;
    let differs = g.ratios.iter().filter(|r| judgement(r) == Judgement::Differs);
    let loads: Vec<String> = differs.map(|r| format!("the {} is {}", named_at(r), compared(r, theirs))).collect();
    format!(
        "{}, from {from:.1} s until {until:.1} s, other ground: {}. {}.",
        titled(&g.recording),
        loads.join(", "),
        sentence_case(&fitting_best(&g.causes))
    )
}

/// "what fits these loads best is soft ground".
fn fitting_best(causes: &[String]) -> String {
    let name = |id: &String| catalogue::find(id).map_or(id.clone(), |entry| entry.label().to_owned());
    let names: Vec<String> = causes.iter().map(name).collect();
    match names.len() {
        0 => "no effect of the catalogue fits these loads".to_owned(),
        1 => format!("what fits these loads best is {}", any_of(&names)),
        _ => format!("what fits these loads best is {}; these loads do not tell which", any_of(&names)),
    }
}

/// What could be behind recordings that agree among each other.
pub(crate) fn group(g: &RecordingGroup, theirs: &str) -> String {
    let who = titled(&g.recordings.join(", "));
    let what = if g.differs { fitting_best(&g.causes) } else { format!("no load differs from {theirs}") };
    format!("{who} alone: {what}.")
}

/// "a", "a or b", "a, b or c".
pub(crate) fn any_of(names: &[String]) -> String {
    match names {
        [rest @ .., last] if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
        _ => names.concat(),
    }
}

pub(crate) fn turning_change(c: &TurningChange) -> String {
    let what = match c.one_way {
        None if c.from_rest => {
            let put = if c.ratio > 1.0 { "put on" } else { "taken off" };
            format!(
                "the ground is another from there on, or a load was {put} while the robot stood, after which it lasts until the \
                 recording ends; weigh the robot, or drive on the old ground again, to tell"
            )
        }
        None => "the ground is another there".to_owned(),
        Some(way) => {
            let way = if way == Way::Left { "left" } else { "right" };
            format!(
                "the robot turned to the {way} only there, so that it may be its side as well as the ground; turn both \
                 ways on the spot to tell"
            )
        }
    };
    format!(
        "{}, from {} until {}: turning takes {:.2} ± {:.2} times the torque of the rest (90 %), \
         measured over {:.0} s: {what}.",
        titled(&c.recording),
        moment(c.onset),
        moment(c.end),
        c.ratio,
        c.half,
        c.seconds
    )
}

/// One sentence per recording: the longest stretches, and how much there is in all.
pub(crate) fn hidden(all: &[Hidden]) -> Vec<String> {
    let named = SENTENCES.hidden;
    let of = |list: &[Hidden]| {
        let seconds = |h: &Hidden| h.interval[1] - h.interval[0];
        let mut longest: Vec<&Hidden> = list.iter().collect();
        longest.sort_by(|a, b| seconds(b).total_cmp(&seconds(a)));
        longest.truncate(named);
        longest.sort_by(|a, b| a.interval[0].total_cmp(&b.interval[0]));
        let spans: Vec<String> =
            longest.iter().map(|h| format!("{:.0}-{:.0} s", h.interval[0], h.interval[1])).collect();
        let more =
            if list.len() > named { format!(" and {} shorter stretches", list.len() - named) } else { String::new() };
        format!(
            "{}: nothing is driven straight in {}{more} ({:.0} s in all), so a change of the ground would not show there.",
            titled(&list[0].recording),
            spans.join(", "),
            list.iter().map(seconds).sum::<f64>()
        )
    };
    all.chunk_by(|a, b| a.recording == b.recording).map(of).collect()
}

/// One sentence per recording.
pub(crate) fn turning(all: &[Turning]) -> Vec<String> {
    let of = |list: &[Turning]| {
        let seconds =
            |way: Way| list.iter().filter(|t| t.way == way).map(|t| t.interval[1] - t.interval[0]).sum::<f64>();
        format!(
            "{}: the loads show that the robot turns to the left for {:.0} s, to the right for \
             {:.0} s, and on the spot or with load on both sides for {:.0} s; neither speeds nor \
             a gyro show it.",
            titled(&list[0].recording),
            seconds(Way::Left),
            seconds(Way::Right),
            seconds(Way::Unknown)
        )
    };
    all.chunk_by(|a, b| a.recording == b.recording).map(of).collect()
}
