//! One answer against what was hidden, in the program's own words.

use examiner::speed::{Event, Sight, SpeedKind, SpeedTruth};
use serde::Serialize;
use serde_json::Value;

/// A slope that is found: within these degrees, as asked.
pub(super) const ANGLE: f64 = 1.0;
/// Least share of an event that a finding must cover to be of it, and seconds that one may reach beyond.
const COVERS: f64 = 0.3;
const BESIDE: f64 = 5.0;
/// Members of a class that can be acted upon.
const CLASS: usize = 3;

/// What came of a case.
#[derive(Debug, Clone, Serialize)]
#[expect(clippy::struct_excessive_bools, reason = "each is a column of the table of scores")]
pub(in crate::blind) struct Row {
    pub(super) case: String,
    pub(super) kind: SpeedKind,
    pub(super) sight: Sight,
    /// As the verdict says it; "refused" without one.
    pub(super) verdict: String,
    pub(super) headline: String,
    /// Classes of causes, the first one first.
    pub(super) classes: Vec<Vec<String>>,
    /// Whether a cause or "unknown" is told.
    pub(super) answered: bool,
    /// Whether the leading class holds what was hidden.
    pub(super) right: bool,
    /// Whether it does so with at most three members.
    pub(super) right_class: bool,
    /// Whether the headline says that nothing is wrong above a sentence that reports a difference.
    pub(super) contradicts: bool,
    pub(super) events: Vec<EventScore>,
    /// Changes and standstills that belong to no event.
    pub(super) invented: usize,
    /// Ratios of the straight load and of the track whose interval holds the truth, of how many.
    pub(super) held: [usize; 2],
    pub(super) processor_seconds: Option<f64>,
}

/// What is told of an event.
#[derive(Debug, Clone, Serialize)]
pub(super) struct EventScore {
    pub(super) kind: SpeedKind,
    pub(super) is_found: bool,
    /// Told less hidden onset, s.
    pub(super) onset: Option<f64>,
    /// Of a slope whose angle is told, not a bound of it: told less hidden, degrees.
    pub(super) degrees: Option<f64>,
    /// Of a slope: told uphill instead of downhill, or the other way round.
    pub(super) wrong_sign: bool,
    /// Of a stretch of other ground: whether it is a finding of its own, and whether its class holds the cause.
    pub(super) ground: Option<[bool; 2]>,
}

/// Names of causes that are what was hidden.
fn names(kind: SpeedKind) -> &'static [&'static str] {
    match kind {
        SpeedKind::Standing => &["standing"],
        SpeedKind::Slope => &["grade"],
        SpeedKind::SoftGround => &["soft_ground"],
        SpeedKind::SlipperyGround => &["adhesion_patch", "turning_resistance"],
        SpeedKind::Payload => &["payload"],
        SpeedKind::DraggingSide => &["coulomb_side"],
        // A stretch of another ground: which cause it has is not asked.
        SpeedKind::Crossing => &["rolling_resistance", "soft_ground", "turning_resistance"],
        SpeedKind::FaultFree | SpeedKind::Several | SpeedKind::Grounds => &[],
    }
}

fn list<'a>(v: &'a Value, keys: &[&str]) -> &'a [Value] {
    keys.iter().fold(v, |v, key| &v[*key]).as_array().map_or(&[], Vec::as_slice)
}

fn interval(v: &Value) -> [f64; 2] {
    [v[0].as_f64().unwrap_or(f64::NAN), v[1].as_f64().unwrap_or(f64::NAN)]
}

/// Something that the program tells of a stretch.
struct Told {
    interval: [f64; 2],
    /// Degrees, of a slope.
    slope: Option<f64>,
    /// Whether they are the angle, no bound or change of it.
    is_angle: bool,
    standing: bool,
}

fn told(d: &Value) -> Vec<Told> {
    let change = |v: &Value| {
        let is_slope = list(v, &["causes"]).iter().any(|c| c.as_str() == Some("grade"));
        let slope = v["slope"].as_f64().filter(|_| is_slope);
        let is_angle = v["bound"] != true && v["relative"] != true;
        Told { interval: interval(&v["interval"]), slope, is_angle, standing: false }
    };
    let turning =
        |v: &Value| Told { interval: interval(&v["interval"]), slope: None, is_angle: false, standing: false };
    let stands = |v: &Value| Told { interval: interval(&v["interval"]), slope: None, is_angle: false, standing: true };
    let straight = list(d, &["steady", "changes", "found"]).iter().map(change);
    straight
        .chain(list(d, &["steady", "turning_changes"]).iter().map(turning))
        .chain(list(d, &["steady", "standstills"]).iter().map(stands))
        .collect()
}

/// Whether a finding is of an event: it covers some of it, or lies within it and little beside.
fn is_of(told: &Told, event: &Event) -> bool {
    let [a, b] = event.interval;
    let [from, until] = told.interval;
    let common = until.min(b) - from.max(a);
    let beyond = (a - from).max(0.0) + (until - b).max(0.0);
    told.standing == (event.kind == SpeedKind::Standing)
        && common > 0.0
        && (common > COVERS * (b - a) || common > beyond)
}

/// Whether a stretch of other ground is told, and whether its class holds the cause.
fn ground(d: &Value, event: &Event) -> Option<[bool; 2]> {
    matches!(event.kind, SpeedKind::SoftGround | SpeedKind::SlipperyGround).then(|| {
        let all = list(d, &["steady", "grounds"]);
        let stretch =
            |g: &Value| Told { interval: interval(&g["interval"]), slope: None, is_angle: false, standing: false };
        let own: Vec<&Value> = all.iter().filter(|g| is_of(&stretch(g), event)).collect();
        let holds = |g: &&Value| {
            list(g, &["causes"]).iter().any(|id| id.as_str().is_some_and(|id| names(event.kind).contains(&id)))
        };
        [!own.is_empty(), own.iter().any(holds)]
    })
}

fn found(d: &Value, all: &[Told], event: &Event) -> EventScore {
    let nearest = all.iter().filter(|t| is_of(t, event)).min_by(|x, y| {
        let off = |t: &Told| (t.interval[0] - event.interval[0]).abs();
        off(x).total_cmp(&off(y))
    });
    // Of a slope the longest stretch tells the angle: its ends are ramps.
    let longest = all.iter().filter(|t| is_of(t, event) && t.slope.is_some()).max_by(|x, y| {
        let length = |t: &Told| t.interval[1] - t.interval[0];
        length(x).total_cmp(&length(y))
    });
    let degrees = event.degrees.zip(longest.and_then(|t| t.slope)).map(|(truth, told)| [truth, told]);
    EventScore {
        kind: event.kind,
        is_found: if event.degrees.is_some() { longest.is_some() } else { nearest.is_some() },
        onset: nearest.map(|t| t.interval[0] - event.interval[0]),
        degrees: degrees.filter(|_| longest.is_some_and(|t| t.is_angle)).map(|[truth, told]| told - truth),
        wrong_sign: degrees.is_some_and(|[truth, told]| truth * told < 0.0),
        ground: ground(d, event),
    }
}

/// Scores an answer; null is a refusal.
pub(super) fn row(truth: &SpeedTruth, d: &Value, processor_seconds: Option<f64>) -> Row {
    let verdict = d["verdict"].as_str().unwrap_or("refused").to_owned();
    let text = |v: &Value| v.as_str().unwrap_or_default().to_owned();
    let classes: Vec<Vec<String>> = list(d, &["indistinguishable"])
        .iter()
        .map(|class| class.as_array().map_or(&[][..], Vec::as_slice).iter().map(text).collect())
        .collect();
    let sentences: Vec<String> = list(d, &["sentences"]).iter().map(text).collect();
    let headline = sentences.first().cloned().unwrap_or_default();
    let hidden: Vec<&str> = match truth.kind {
        SpeedKind::Several | SpeedKind::Grounds => truth.events.iter().flat_map(|e| names(e.kind)).copied().collect(),
        kind => names(kind).to_vec(),
    };
    let leads = |class: &Vec<String>| class.iter().any(|id| hidden.contains(&id.as_str()));
    let all = told(d);
    let away = |t: &Told| {
        truth.events.iter().all(|e| t.interval[1] < e.interval[0] - BESIDE || t.interval[0] > e.interval[1] + BESIDE)
    };
    let differs = |s: &String| s.contains(": it differs.") || s.contains("Cause: ") || s.contains("times the torque");
    Row {
        case: truth.case.clone(),
        kind: truth.kind,
        sight: truth.sight,
        answered: verdict == "explained" || verdict == "unknown",
        right: classes.first().is_some_and(leads),
        right_class: classes.first().is_some_and(|c| leads(c) && c.len() <= CLASS),
        contradicts: (headline.starts_with("No mismatch") || verdict == "no_mismatch") && sentences.iter().any(differs),
        verdict,
        headline,
        classes,
        events: truth.events.iter().map(|e| found(d, &all, e)).collect(),
        invented: all.iter().filter(|t| away(t)).count(),
        held: held(truth, d),
        processor_seconds,
    }
}

/// Intervals that hold the truth: only where one ground is driven from end to end.
fn held(truth: &SpeedTruth, d: &Value) -> [usize; 2] {
    let mut out = [0, 0];
    if !truth.events.is_empty() {
        return out;
    }
    for ratio in list(d, &["steady", "ratios"]).iter().filter(|r| r["firm"] == true) {
        let speed = interval(&ratio["speed"]);
        let mean = 0.5 * (speed[0] + speed[1]).abs();
        let load = |[rest, per]: [f64; 2]| rest + per * mean;
        let is = match ratio["quantity"].as_str() {
            Some("straight_load") => load(truth.straight[1]) / load(truth.straight[0]),
            Some("effective_track") => truth.track[1] / truth.track[0],
            _ => continue,
        };
        let [a, b] = interval(&ratio["interval"]);
        out[1] += 1;
        out[0] += usize::from(a <= is && is <= b);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn truth(kind: SpeedKind, events: Vec<Event>) -> SpeedTruth {
        let (straight, track) = ([[10.0, 2.0], [20.0, 2.0]], [0.8, 1.0]);
        SpeedTruth { case: "v001".to_owned(), kind, sight: Sight::Accelerometer, events, straight, track }
    }

    #[test]
    fn a_slope_is_found_with_its_angle_and_a_wrong_sign_is_seen() {
        let event = Event { kind: SpeedKind::Slope, interval: [50.0, 70.0], degrees: Some(5.0) };
        let say = |slope: f64, at: [f64; 2]| {
            json!({ "verdict": "explained", "sentences": ["Change"], "indistinguishable": [["grade"]],
                "steady": { "changes": { "found": [{ "interval": at, "causes": ["grade"], "slope": slope }] } } })
        };
        let right = row(&truth(SpeedKind::Slope, vec![event.clone()]), &say(4.6, [52.0, 69.0]), None);
        assert!(right.right && right.events[0].is_found && !right.events[0].wrong_sign && right.invented == 0);
        assert!((right.events[0].degrees.expect("told") + 0.4).abs() < 1e-9);
        let wrong = row(&truth(SpeedKind::Slope, vec![event.clone()]), &say(-4.6, [52.0, 69.0]), None);
        assert!(wrong.events[0].wrong_sign);
        let elsewhere = row(&truth(SpeedKind::Slope, vec![event]), &say(4.6, [10.0, 20.0]), None);
        assert!(!elsewhere.events[0].is_found && elsewhere.invented == 1);
    }

    #[test]
    fn a_stretch_of_other_ground_is_a_finding_with_its_cause_or_with_another() {
        let event = Event { kind: SpeedKind::SoftGround, interval: [50.0, 110.0], degrees: None };
        let say = |cause: &str, at: [f64; 2]| {
            let d = json!({ "verdict": "explained", "sentences": ["The ground changes"], "indistinguishable": [[cause]],
                "steady": { "grounds": [{ "interval": at, "causes": [cause] }] } });
            row(&truth(SpeedKind::Grounds, vec![event.clone()]), &d, None).events[0].ground
        };
        assert_eq!(say("soft_ground", [55.0, 108.0]), Some([true, true]));
        assert_eq!(say("turning_resistance", [55.0, 108.0]), Some([true, false]));
        assert_eq!(say("soft_ground", [150.0, 190.0]), Some([false, false]));
    }

    #[test]
    fn a_class_is_right_with_its_member_in_it_and_a_headline_may_not_contradict() {
        let verdict = |class: &[&str]| {
            json!({ "verdict": "explained", "sentences": ["Missing: x"], "indistinguishable": [class],
                "steady": { "ratios": [
                    { "quantity": "straight_load", "firm": true, "speed": [0.5, 0.5], "interval": [1.8, 2.0] },
                    { "quantity": "effective_track", "firm": true, "speed": [0.1, 0.5], "interval": [1.3, 1.4] }
                ] } })
        };
        let soft = truth(SpeedKind::SoftGround, Vec::new());
        let right = row(&soft, &verdict(&["rolling_resistance", "soft_ground"]), None);
        assert!(right.right && right.right_class && right.held == [1, 2], "{right:?}");
        let wide = row(&soft, &verdict(&["a", "b", "c", "soft_ground"]), None);
        assert!(wide.right && !wide.right_class);
        assert!(!row(&soft, &verdict(&["payload"]), None).right);
        let refused = row(&soft, &Value::Null, None);
        assert!(!refused.answered && refused.verdict == "refused");

        let two = json!({ "verdict": "no_mismatch", "sentences": ["No mismatch: x", "The load: it differs."] });
        assert!(row(&soft, &two, None).contradicts);
    }
}
