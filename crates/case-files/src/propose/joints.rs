//! Which joints drive, and on which side: by their names alone, and none where a name leaves a doubt.

use std::collections::BTreeMap;

/// Words of a wheel that drives.
const WHEELS: [&str; 9] = ["wheel", "wheels", "whl", "motor", "motors", "drive", "tire", "tyre", "track"];
/// Words that say nothing.
const NEUTRAL: [&str; 6] = ["joint", "link", "base", "chassis", "robot", "hub"];
const FRONT: [&str; 3] = ["front", "fore", "fwd"];
const REAR: [&str; 4] = ["rear", "back", "aft", "hind"];
const MIDDLE: [&str; 5] = ["middle", "mid", "center", "centre", "central"];
/// Words of a joint that does not drive, whatever else its name says.
const IDLE: [&str; 31] = [
    "caster",
    "castor",
    "drop",
    "steer",
    "steering",
    "pivot",
    "swivel",
    "passive",
    "free",
    "idle",
    "idler",
    "arm",
    "gripper",
    "finger",
    "pan",
    "tilt",
    "lift",
    "flipper",
    "suspension",
    "rocker",
    "bogie",
    "shock",
    "spring",
    "brush",
    "fan",
    "vacuum",
    "blade",
    "rotor",
    "prop",
    "propeller",
    "thruster",
];

/// Words of what is measured of a wheel, which say nothing of which one it is.
const COUNTED: [&str; 15] = [
    "tick", "ticks", "encoder", "encoders", "enc", "count", "counts", "position", "speed", "velocity", "torque",
    "torques", "effort", "current", "currents",
];

/// Letters of the longest of them.
const LONGEST_WORD: usize = 10;
/// Words that may stand together without a gap, as in `frontleftwheeljoint`.
const MOST_WORDS: usize = 4;

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Side {
    Left,
    Right,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Place {
    Front,
    Middle,
    Rear,
}

/// What a part of a name says.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
enum Word {
    Side(Side),
    /// A side by letters, such as `fl` or `l`, which may mean something else.
    Letters(Side, Option<Place>),
    Place(Place),
    Wheel,
    Neutral,
    Idle(String),
    Other(String),
}

/// The driven joints of each side, the one that stands for it first; the two that do are each other's mirror image where
/// there is such a pair.
#[derive(Debug, Default)]
pub(super) struct Sides<'a> {
    pub(super) left: Vec<&'a str>,
    pub(super) right: Vec<&'a str>,
    /// The names are those that Clearpath gives.
    pub(super) clearpath: bool,
    /// Taken although no word says that it is a wheel.
    assumed: Vec<&'a str>,
    /// Not taken, by reason.
    doubtful: BTreeMap<String, Vec<&'a str>>,
}

impl Sides<'_> {
    /// What was inferred, in sentences.
    pub(super) fn remarks(&self) -> Vec<String> {
        let mut out = Vec::new();
        for (side, joints) in [("left", &self.left), ("right", &self.right)] {
            if joints.len() > 1 {
                out.push(format!("of {} the first stands for the {side} side", joints.join(", ")));
            }
        }
        match (self.left.as_slice(), self.right.as_slice()) {
            ([], []) | ([_, ..], [_, ..]) => {}
            (left, _) => {
                let side = if left.is_empty() { "left" } else { "right" };
                out.push(format!("no joint of the {side} side was found"));
            }
        }
        if !self.assumed.is_empty() {
            out.push(format!("{} taken for driven wheels, which their names do not say", self.assumed.join(", ")));
        }
        out.extend(self.doubtful.iter().map(|(why, names)| format!("{} not mapped: {why}", names.join(", "))));
        out
    }
}

/// A name in its words.
struct Name<'a> {
    text: &'a str,
    words: Vec<Word>,
}

/// The one of these names that means the wheel called `wheel`: the same side, place and number, in other words.
pub(super) fn same_wheel<'a>(wheel: &str, names: &'a [String]) -> Option<&'a str> {
    let wanted = essence(wheel);
    let mut alike = names.iter().filter(|name| essence(name) == wanted);
    alike.next().filter(|_| alike.next().is_none()).map(String::as_str)
}

/// What a name says of which wheel it is, in one order.
fn essence(name: &str) -> Vec<Word> {
    let mut out = Vec::new();
    for word in words(name) {
        match word {
            Word::Letters(side, place) => {
                out.extend([Some(Word::Side(side)), place.map(Word::Place)].into_iter().flatten());
            }
            Word::Wheel | Word::Neutral => {}
            Word::Other(other) if COUNTED.contains(&other.as_str()) => {}
            other => out.push(other),
        }
    }
    out.sort();
    out
}

/// Sorts joints by side.
pub(super) fn sides(names: &[String]) -> Sides<'_> {
    let names: Vec<Name<'_>> = names.iter().map(|text| Name { text, words: words(text) }).collect();
    let mut out = Sides::default();
    let (mut left, mut right) = (Vec::new(), Vec::new());
    // Where some joints are called wheels, those that are not are something else.
    let some_wheel = names.iter().any(|name| name.is_wheel() && matches!(name.judge(&names), Judged::Drives(_)));
    for name in &names {
        match name.judge(&names) {
            Judged::Drives(_) if some_wheel && !name.is_wheel() => {}
            Judged::Drives(side) => {
                if !name.is_wheel() {
                    out.assumed.push(name.text);
                }
                if side == Side::Left { left.push(name) } else { right.push(name) }
            }
            Judged::Doubtful(why) => out.doubtful.entry(why).or_default().push(name.text),
            Judged::SomethingElse => {}
        }
    }
    if let Some(mirror) = left.first().and_then(|first| right.iter().position(|other| first.mirrors(other))) {
        right[..=mirror].rotate_right(1);
    }
    out.clearpath = left.iter().chain(&right).any(|name| name.is_clearpath());
    (out.left, out.right) = [left, right].map(|side| side.into_iter().map(|name| name.text).collect()).into();
    out
}

enum Judged {
    Drives(Side),
    /// It may be a wheel that drives; why it is not taken.
    Doubtful(String),
    SomethingElse,
}

impl Name<'_> {
    fn is_wheel(&self) -> bool {
        self.words.contains(&Word::Wheel)
    }

    /// As in `front_left_wheel` and `rear_right_wheel_joint`.
    fn is_clearpath(&self) -> bool {
        let said = |wanted: fn(&Word) -> bool| self.words.iter().any(wanted);
        said(|w| matches!(w, Word::Place(Place::Front | Place::Rear)))
            && said(|w| matches!(w, Word::Side(_)))
            && self.is_wheel()
    }

    /// The side, when the words agree on one.
    fn side(&self) -> Result<Option<Side>, ()> {
        let mut found = None;
        for word in &self.words {
            if let Word::Side(side) | Word::Letters(side, _) = word {
                if found.is_some_and(|other| other != *side) {
                    return Err(());
                }
                found = Some(*side);
            }
        }
        Ok(found)
    }

    fn judge(&self, all: &[Name<'_>]) -> Judged {
        let is_other = |word: &Word| matches!(word, Word::Other(_));
        let idle = self.words.iter().find_map(|word| if let Word::Idle(word) = word { Some(word) } else { None });
        let may_drive = self.is_wheel() || !(self.words.iter().any(is_other) || idle.is_some());
        if !may_drive {
            return Judged::SomethingElse;
        }
        if let Some(word) = idle {
            return Judged::Doubtful(format!("by `{word}` in the name a joint that does not drive"));
        }
        let side = match self.side() {
            Err(()) => return Judged::Doubtful("the name says left and right".to_owned()),
            Ok(None) if self.is_wheel() => return Judged::Doubtful("the name says no side".to_owned()),
            Ok(None) => return Judged::SomethingElse,
            Ok(Some(side)) => side,
        };
        let by_letters = !self.words.contains(&Word::Side(side));
        if by_letters && !all.iter().any(|other| self.mirrors(other)) {
            let letter = if side == Side::Left { "l" } else { "r" };
            return Judged::Doubtful(format!(
                "`{letter}` in the name may be no side, since no other joint is called like its mirror image"
            ));
        }
        Judged::Drives(side)
    }

    /// Whether the other name differs in the side only.
    fn mirrors(&self, other: &Name<'_>) -> bool {
        let (Ok(Some(side)), Ok(Some(other_side))) = (self.side(), other.side()) else { return false };
        side != other_side
            && self.words.len() == other.words.len()
            && self.words.iter().zip(&other.words).all(|words| match words {
                (Word::Side(_), Word::Side(_)) => true,
                (Word::Letters(_, here), Word::Letters(_, there)) => here == there,
                (here, there) => here == there,
            })
    }
}

/// The words of a name: `base_l_wheel`, `frontLeftWheel`, `wheel_fl` and `leftwheel2` alike.
fn words(name: &str) -> Vec<Word> {
    let mut parts: Vec<String> = Vec::new();
    let mut before = ' ';
    for c in name.chars() {
        let new_word = before.is_lowercase() && c.is_uppercase();
        let new_kind = c.is_alphabetic() != before.is_alphabetic();
        if new_word || new_kind {
            parts.push(String::new());
        }
        if let Some(part) = parts.last_mut() {
            part.extend(c.to_lowercase());
        }
        before = c;
    }
    parts.retain(|part| part.chars().any(char::is_alphanumeric));
    // Letters that stand alone belong together: `wheel_r_l` is the rear left one.
    let mut joined: Vec<String> = Vec::new();
    for part in parts {
        match joined.last_mut() {
            Some(last) if last.len() == 1 && letters(&format!("{last}{part}")).is_some() => *last += &part,
            _ => joined.push(part),
        }
    }
    joined.iter().flat_map(|part| split(part, MOST_WORDS).unwrap_or_else(|| vec![Word::Other(part.clone())])).collect()
}

/// A part that is made of known words without a gap; `most` keeps a name that was made up from taking for ever.
fn split(part: &str, most: usize) -> Option<Vec<Word>> {
    if part.is_empty() {
        return Some(Vec::new());
    }
    let most = most.checked_sub(1)?;
    // The longest first: `wheels` is no `wheel` with a letter behind.
    let ends = (1..=part.len().min(LONGEST_WORD)).rev().filter(|&end| part.is_char_boundary(end));
    ends.into_iter().find_map(|end| {
        let mut words = vec![word(&part[..end])?];
        words.extend(split(&part[end..], most)?);
        Some(words)
    })
}

fn word(text: &str) -> Option<Word> {
    let one_of = |list: &[&str]| list.contains(&text);
    Some(match text {
        "left" => Word::Side(Side::Left),
        "right" => Word::Side(Side::Right),
        _ if one_of(&WHEELS) => Word::Wheel,
        _ if one_of(&NEUTRAL) => Word::Neutral,
        _ if one_of(&FRONT) => Word::Place(Place::Front),
        _ if one_of(&REAR) => Word::Place(Place::Rear),
        _ if one_of(&MIDDLE) => Word::Place(Place::Middle),
        _ if one_of(&IDLE) => Word::Idle(text.to_owned()),
        _ => {
            let (side, place) = letters(text)?;
            Word::Letters(side, place)
        }
    })
}

/// Letters that name a side, with a place or without; of two, an `l` always is the left.
fn letters(text: &str) -> Option<(Side, Option<Place>)> {
    Some(match text {
        "l" => (Side::Left, None),
        "r" => (Side::Right, None),
        "fl" | "lf" => (Side::Left, Some(Place::Front)),
        "fr" | "rf" => (Side::Right, Some(Place::Front)),
        "ml" | "lm" | "cl" | "lc" => (Side::Left, Some(Place::Middle)),
        "mr" | "rm" | "cr" | "rc" => (Side::Right, Some(Place::Middle)),
        "rl" | "lr" | "bl" | "lb" => (Side::Left, Some(Place::Rear)),
        "rr" | "br" | "rb" => (Side::Right, Some(Place::Rear)),
        _ => return None,
    })
}
