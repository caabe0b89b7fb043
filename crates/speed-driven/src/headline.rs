//! What leads the sentences: the strongest thing that was found.
//!
//! A body that stands; causes that the loads name; ratios whose intervals exclude no difference; changes inside
//! recordings; nothing.

use catalogue::revealed_by;
use catalogue::speed_driven::{SOFT_GROUND, STANDING};
use inference::gyro_beside_pose;
use inference::words::quantity;
use robot_model::effects::{gyro_scale, wheel_radius_mismatch};
use verdict::{
    Cause, Diagnosis, LoadChange, Loads, OtherGround, Quantity, Ratio, SideDrift, Standstill, Verdict, WrongSpeed,
};

use crate::body_pull;
use crate::compare::{Judgement, judgement, reported, steady_seconds};
use crate::following;
use crate::found::{largest_side_change, longest, measured_slopes, strongest};
use crate::groups::{Disagreement, disagreements};
use crate::pieces::GRADE;
use crate::pulses;
use crate::settings::{NAMING, naming::Answer, naming::Sentences};
use crate::slope_sentences;
use crate::tipping;
use crate::words::{
    any_of, change, compared, group, how_it_stands, other_ground, recordings, side_change, turning_change,
};

const SENTENCES: Sentences = NAMING.sentences;
const ANSWER: Answer = NAMING.answer;
/// How [`quantity`] ends.
const NINETY_PER_CENT: &str = " (90 %)";

/// The first sentences; `of_loads` is the verdict of the loads alone, `theirs` what they are compared with.
pub(crate) fn headline(d: &Diagnosis, of_loads: Verdict, loads: &Loads, theirs: &str) -> Vec<String> {
    let standing = standing(&loads.standstills);
    let slope = slope_sentences::told(loads, theirs);
    let gyro: Vec<String> = loads.gyro.iter().filter(|gyro| gyro.is_off).map(gyro_beside_pose::told).collect();
    let drift: Vec<String> = loads.drift.iter().map(drifts).collect();
    let encoders = [false, true].map(|followed| wrong_encoders(&loads.wrong_speeds, followed)).concat();
    let unfollowed = loads.unfollowed.iter().map(following::told);
    let pulsing = loads.pulsing.iter().map(pulses::told);
    let pull = loads.pull.iter().map(|p| body_pull::told(p, theirs));
    let drives: Vec<String> =
        unfollowed.chain(pulsing).chain(pull).chain(loads.tipped.iter().map(tipping::told)).collect();
    let leads = [&standing, &encoders, &drives, &slope, &gyro, &drift].iter().all(|told| told.is_empty());
    let inside = || slope_sentences::inside(loads);
    let rest = match of_loads {
        Verdict::Explained => [located(disagreeing(loads, theirs, named(d, loads)), loads), inside()].concat(),
        Verdict::Unknown => [disagreeing(loads, theirs, unknown(loads, theirs)), inside()].concat(),
        Verdict::NoMismatch | Verdict::Withheld => {
            let differences = differences(d, loads, theirs);
            // A tilt that was measured is surer than a cause of a difference that none stands out for.
            if differences.is_empty() {
                changes(of_loads, loads, (leads, theirs))
            } else {
                [inside(), differences].concat()
            }
        }
    };
    [standing, encoders, drives, gyro, drift, slope, rest].concat()
}

/// Encoders that show another speed of a side than there is.
fn wrong_encoders(all: &[WrongSpeed], is_followed: bool) -> Vec<String> {
    let one = |w: &WrongSpeed| {
        let [from, until] = w.interval;
        format!(
            "{:.3} ± {:.3} (90 %) of its speed on the {} in {} from {from:.1} s to {until:.1} s",
            w.share,
            w.half,
            w.side,
            recordings(&w.recording)
        )
    };
    let told = all.iter().filter(|w| w.is_followed == is_followed).map(one).collect::<Vec<_>>().join(", ");
    if told.is_empty() {
        return Vec::new();
    }
    let why = if is_followed {
        "while both sides show what is set and the body turns away from that side, straight ahead too: it loses counts that the controller \
         follows as well, or the wheels of the other side slip"
    } else {
        "while the other side follows what is set and the body turns as is set: it loses counts, or its scale changed"
    };
    vec![format!(
        "Wrong wheel speed: an encoder shows {told}, {why}. Nothing else here uses these rows; mend the encoder, and change nothing of the \
         simulation for it."
    )]
}

/// A side whose wheels roll as if they had another radius.
fn drifts(drift: &SideDrift) -> String {
    let SideDrift { difference, half, side } = drift;
    let of = match side.as_deref() {
        Some(side) if side == inference::words::side(0) => format!("left by {:+.3} ± {half:.3} (90 %)", -difference),
        Some(side) => format!("{side} by {difference:+.3} ± {half:.3} (90 %)"),
        None => format!(
            "right by {difference:+.3} ± {half:.3} (90 %), or left by {:+.3}; the loads do not tell which",
            -difference
        ),
    };
    format!(
        "Missing: wheels of one side of another radius, as a share: {of}. While both sides turn alike, the body turns as if they did not: \
         compare the tyres of both sides, then the counts per turn of their encoders, which look the same."
    )
}

/// What is said of the loads, and in what stretches it is so, where other ground covers most of the driving.
fn located(mut told: Vec<String>, loads: &Loads) -> Vec<String> {
    if loads.on_grounds {
        let of = |g: &OtherGround| {
            let [from, until] = g.interval;
            format!("{} from {from:.1} s until {until:.1} s", recordings(&g.recording))
        };
        let stretches: Vec<String> = loads.grounds.iter().map(of).collect();
        let place = format!(
            "This is another ground, in {}; beside it the simulation explains the loads.",
            stretches.join(", in ")
        );
        told.insert(told.len().min(1), place);
    }
    told
}

/// What is said of all recordings together, behind the loads of which they show no one value and the recordings that agree.
fn disagreeing(loads: &Loads, theirs: &str, together: Vec<String>) -> Vec<String> {
    let of = |d: Disagreement<'_>| {
        let [here, there] = [d.least, d.most].map(|r| recordings(&r.recording));
        let (name, low, high) = (d.quantity.name(), d.least.ratio, d.most.ratio);
        format!("the {name} is {low:.2} times {theirs} in {here} and {high:.2} times in {there}")
    };
    let found: Vec<String> = disagreements(loads).into_iter().map(of).collect();
    if found.is_empty() {
        return together;
    }
    if loads.agree_by_cause {
        let seen = format!(
            "Recordings differ from one another, which the cause that is named first explains: {}.",
            found.join("; ")
        );
        return together.into_iter().chain([seen]).collect();
    }
    let first = format!(
        "The recordings disagree: {}, more than it varies from run to run. No one cause need be behind all of them; those that \
         agree, each by itself:",
        found.join("; ")
    );
    let apart = loads.groups.iter().map(|g| group(g, theirs));
    let mut together = together;
    if let Some(leads) = together.first_mut() {
        leads.insert_str(0, "All recordings together: ");
    }
    std::iter::once(first).chain(apart).chain(together).collect()
}

/// Nothing differs over whole recordings, or nothing can be compared; what changes inside them.
fn changes(of_loads: Verdict, loads: &Loads, (leads, theirs): (bool, &str)) -> Vec<String> {
    let warmth = warmth(loads, theirs);
    let whole = match of_loads {
        Verdict::Withheld if leads => too_little(loads),
        Verdict::Withheld => "The other rows hold too little steady driving to compare any load.".to_owned(),
        _ if leads => match &warmth {
            Some(warmth) => format!("No mismatch that asks for a cause. {warmth}"),
            None => {
                "No mismatch: the simulation explains the loads of steady driving; nothing needs to be added to it."
                    .to_owned()
            }
        },
        _ if loads.standstills.is_empty() => warmth.clone().unwrap_or_else(|| {
            "Apart from that the simulation explains the loads of steady driving; nothing else needs to be added to it.".to_owned()
        }),
        _ => warmth
            .clone()
            .unwrap_or_else(|| "The other rows show no mismatch: the simulation explains their loads.".to_owned()),
    };
    let rest = match (of_loads, warmth) {
        (Verdict::Withheld, _) => "No load of a whole recording can be compared: too little steady driving.".to_owned(),
        (_, Some(warmth)) => warmth,
        _ => "Apart from what changes inside recordings the simulation explains the loads; nothing else needs to be added \
              to it.".to_owned(),
    };
    if let Some(largest) = largest_side_change(loads) {
        let more = match loads.side_changes.len() {
            1 => String::new(),
            n => format!(", the largest of {n}"),
        };
        let first = format!("One side changes inside a recording{more}. {}", side_change(largest));
        return [Some(first), apart(&largest.causes), Some(rest)].into_iter().flatten().collect();
    }
    if let Some(longest) = loads.grounds.first() {
        let how_many = match loads.grounds.len() {
            1 => String::new(),
            n => format!(": {n} stretches of other ground, of which this is the longest"),
        };
        let first = format!("The ground changes inside a recording{how_many}. {}", other_ground(longest, theirs));
        return [Some(first), apart(&longest.causes), Some(rest)].into_iter().flatten().collect();
    }
    let (straight, turning) = (&loads.changes.found, &loads.turning_changes);
    let steepest = straight.iter().max_by(|a: &&LoadChange, b| a.slope.abs().total_cmp(&b.slope.abs()));
    let largest = turning.iter().max_by(|a, b| a.ratio.ln().abs().total_cmp(&b.ratio.ln().abs()));
    let Some(clearest) = steepest.map(change).or_else(|| largest.map(turning_change)) else {
        return vec![whole];
    };
    let way_back = steepest.filter(|c| c.causes.len() > 1).map(|_| {
        "To find out which, drive the same stretch the other way: a slope then changes the load the opposite way, the \
         ground the same way."
            .to_owned()
    });
    let count = straight.len() + turning.len();
    let how_many = if count == 1 { String::new() } else { format!(", the clearest of {count}") };
    let first = format!("Change inside a recording{how_many}. {clearest}");
    [Some(first), way_back, Some(rest)].into_iter().flatten().collect()
}

/// A straight load that differs by no more than cold drive trains do, and how to find out.
fn warmth(loads: &Loads, theirs: &str) -> Option<String> {
    let unnamed = reported(loads).filter(|r| judgement(r) == Judgement::Unnamed);
    let most = unnamed.max_by(|a, b| a.ratio.ln().abs().total_cmp(&b.ratio.ln().abs()))?;
    let [from, until] = most.interval;
    Some(format!(
        "In {} the torque of straight driving is {:.2} times {theirs} (90 % interval {from:.2} to {until:.2}), which drive \
         trains that are colder or warmer do, too: drive both again after ten minutes of driving. No other load of whole \
         recordings differs.",
        recordings(&most.recording),
        most.ratio
    ))
}

/// The clearest differences, though none of their causes is likely enough to be named; the class that fits each.
fn differences(d: &Diagnosis, loads: &Loads, theirs: &str) -> Vec<String> {
    let strongest = strongest(loads);
    // What changes inside recordings is told as a change.
    if strongest.is_empty() {
        return Vec::new();
    }
    let mut out: Vec<String> = strongest.iter().map(|r| difference(r, theirs)).collect();
    let all = reported(loads).filter(|r| judgement(r) == Judgement::Differs).count();
    if all > strongest.len() {
        out.push(format!("In all, {all} loads differ from {theirs}; the others are listed below."));
    }
    for r in strongest {
        out.extend(if r.quantity == Quantity::EffectiveTrack {
            vec![slips(r, loads.gyro.is_some())]
        } else {
            fits(d, loads)
        });
    }
    out
}

/// What is missing for an answer, and by how much.
fn too_little(loads: &Loads) -> String {
    let [straight, turning] = steady_seconds(loads);
    let missing = (ANSWER.needed - straight - turning).max(0.0);
    let what = if straight < turning { "straight at one speed" } else { "turns both ways at one speed" };
    let asked = if missing > 0.0 { format!("{missing:.0} s more") } else { "more".to_owned() };
    format!(
        "These recordings permit no answer: too little steady driving. {straight:.0} s of straight driving and {turning:.0} s of \
         turning at constant speed can be compared, {:.0} s in all are needed. Record at least {asked}, \
         {what}.",
        ANSWER.needed
    )
}

fn difference(r: &Ratio, theirs: &str) -> String {
    let tentative = if r.firm { "" } else { " (tentative)" };
    let [load, seconds] = [compared(r, theirs), format!("{:.0} s", r.seconds)];
    let [of, what] = [recordings(&r.recording), r.quantity.name().to_owned()];
    format!("Difference: in {of} the {what} is {load}, measured over {seconds}{tentative}.")
}

/// What another effective track means, and what to do; a gyro may be behind it where no pose tells.
fn slips(r: &Ratio, gyro_is_known: bool) -> String {
    let percent = 100.0 * (1.0 - 1.0 / r.ratio).abs();
    let how = if r.ratio > 1.0 { "less" } else { "more" };
    let (gyro, pose) = if gyro_is_known {
        (String::new(), "")
    } else {
        (format!(", or a gyro that reads {:.0} % of what it read", 100.0 / r.ratio), ", or record a pose,")
    };
    format!(
        "The body turns by {percent:.0} % {how} than the same wheel speeds turned it before: ground that gives way or holds \
         otherwise, or other tyres{gyro}. Spin both ways on both grounds{pose} to be sure; if it is the ground or the tyres, give the \
         simulation this track."
    )
}

/// The class of effects that fit a difference of the loads, and what tells them apart.
fn fits(d: &Diagnosis, loads: &Loads) -> Vec<String> {
    let is_told = |class: &[String]| loads.slope.is_some() && class == [GRADE];
    let of_catalogue = |class: &&Vec<String>| {
        !is_told(class) && class.iter().any(|id| *id == SOFT_GROUND.id || inference::words::revealed_by(id).is_some())
    };
    let Some(class) = d.indistinguishable.iter().find(of_catalogue) else {
        return vec!["No effect of the catalogue makes such a difference of the loads.".to_owned()];
    };
    let names = names(d, class);
    let mut out = vec![format!("The effects that fit the loads best are {}; none of them stands out.", any_of(&names))];
    out.extend(apart(class));
    out
}

/// Loads that no effect explains.
fn unknown(loads: &Loads, theirs: &str) -> Vec<String> {
    let mut out: Vec<String> = strongest(loads).into_iter().map(|r| difference(r, theirs)).collect();
    out.push("The loads differ, but in a way that no effect in the catalogue explains.".to_owned());
    out
}

/// Where the body stands longest, how that is seen, and what to do.
fn standing(all: &[Standstill]) -> Vec<String> {
    let Some(s) = longest(all) else { return Vec::new() };
    let [from, until] = s.interval;
    let more = match all.len() - 1 {
        0 => String::new(),
        1 => ", and once more".to_owned(),
        n => format!(", and {n} times more"),
    };
    // Wheels that find hold take more than a side takes straight ahead.
    let is_light = s.straight.is_some_and(|straight| s.load < ANSWER.light * straight);
    let because = match (s.wheels, s.share) {
        _ if s.is_off => {
            "its motors give no torque: they are switched off (emergency stop, fuse, driver), or their currents are not measured"
        }
        (Some(_), _) => "something holds the wheels: an obstacle, a brake, or too little torque",
        (None, Some(_)) if is_light => {
            "that is little more than straight driving takes, so its wheels turn in the air or find no grip"
        }
        (None, Some(_)) => "it is dug in, or its wheels spin",
        (None, None) => "it pushes against something that does not give way, or is dug in",
    };
    vec![
        format!(
            "{}: in {} from {from:.1} s to {until:.1} s {}{more}.",
            if s.side.is_some() { "Held wheels" } else { "Standing" },
            recordings(&s.recording),
            match (&s.side, s.wheels) {
                (None, _) if s.is_off => "the robot is commanded to drive and stands".to_owned(),
                (Some(side), _) => format!("the wheels of the {side} side are commanded to turn and hardly do"),
                (None, Some(_)) => "the wheels are commanded to turn and hardly do".to_owned(),
                (None, None) => "the wheels turn and the body hardly moves".to_owned(),
            }
        ),
        format!(
            "There {}: {because}. Nothing else here uses these rows; look at the robot and the \
             ground there before you change the simulation.",
            how_it_stands(s)
        ),
    ]
}

/// Whether a cause is one of drives that do not follow, of loads that pulse, or of units that tip.
fn is_of_drives(c: &Cause, loads: &Loads) -> bool {
    let pulsing = loads.pulsing.iter().flat_map(|p| pulses::causes(p, ANSWER.changed));
    pulsing
        .chain(loads.unfollowed.iter().map(|u| following::cause(u, ANSWER.changed)))
        .any(|own| own.effect == c.effect)
}

/// The causes that the loads name, and what tells the members of a class apart.
fn named(d: &Diagnosis, loads: &Loads) -> Vec<String> {
    // What is told by itself.
    let gyro = loads.gyro.filter(|gyro| gyro.is_off).map(|_| gyro_scale::SPEC.id);
    let drift = loads.drift.as_ref().map(|_| wheel_radius_mismatch::SPEC.id);
    let of_drives = d.ranked.iter().filter(|c| is_of_drives(c, loads)).map(|c| c.effect.as_str());
    let apart_from_loads: Vec<&str> = [Some(STANDING.id), gyro, drift].into_iter().flatten().chain(of_drives).collect();
    let is_measured = measured_slopes(loads).next().is_some();
    let of_loads = |class: &&Vec<String>| {
        !(is_measured && **class == [GRADE]) && class.iter().all(|id| !apart_from_loads.contains(&id.as_str()))
    };
    let of = |id: &String| d.ranked.iter().find(|c| c.effect == *id);
    let mut out = Vec::new();
    for class in d.indistinguishable.iter().filter(of_loads) {
        let sizes: Vec<String> = class.iter().map(|id| of(id).map_or_else(String::new, quantity)).collect();
        // Said once, behind the last one.
        let interval = if sizes.iter().any(|size| size.ends_with(NINETY_PER_CENT)) { NINETY_PER_CENT } else { "" };
        let sized = |(name, size): (String, &String)| match size.trim_end_matches(NINETY_PER_CENT) {
            "" => name,
            size => format!("{name} by {size}"),
        };
        let sized: Vec<String> = names(d, class).into_iter().zip(&sizes).map(sized).collect();
        let tail = if sized.len() > 1 { "; these recordings cannot tell which" } else { "" };
        out.push(format!("Missing: {}{interval}{tail}.", any_of(&sized)));
        out.extend(apart(class));
    }
    out
}

fn names(d: &Diagnosis, class: &[String]) -> Vec<String> {
    let name = |id: &String| d.ranked.iter().find(|c| c.effect == *id).map_or(id.clone(), |c| c.name.clone());
    class.iter().map(name).collect()
}

/// The drives that reveal the members of a class split it; the first ones are enough to begin with.
fn apart<S: AsRef<str>>(class: &[S]) -> Option<String> {
    let mut drives: Vec<&str> = Vec::new();
    for drive in class.iter().filter_map(|id| revealed_by(id.as_ref())) {
        if !drives.contains(&drive) && drives.len() < SENTENCES.drives {
            drives.push(drive);
        }
    }
    (class.len() > 1).then(|| format!("To find out which, record: {}.", drives.join("; ")))
}
