//! Several robots in one bag, told apart by the first part of their topics' names.

use std::collections::{BTreeMap, BTreeSet};

use recordings::TopicContents;

use super::draft::fields;
use super::joints;

/// Leaves the topics of the first robot where several drive in one bag; what was left out, in a sentence.
pub(super) fn first(topics: &mut Vec<&TopicContents>) -> Option<String> {
    // Topics of driven joints that differ in the first part of their names only.
    let mut alike: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for topic in topics.iter().filter(|topic| drives(topic)) {
        if let Some((robot, rest)) = parts(topic) {
            alike.entry(rest).or_default().push(robot);
        }
    }
    let robots = alike.into_values().find(|robots| robots.len() > 1)?;
    let (first, others) = robots.split_first()?;
    let others: BTreeSet<&str> = others.iter().copied().collect();
    topics.retain(|topic| parts(topic).is_none_or(|(robot, _)| !others.contains(robot)));
    let others: Vec<String> = others.iter().map(|robot| format!("/{robot}")).collect();
    Some(format!("several robots are in this bag: proposed for /{first}, not for {}", others.join(", ")))
}

/// The first part of a topic's name, and the rest.
fn parts(topic: &TopicContents) -> Option<(&str, &str)> {
    topic.name.trim_start_matches('/').split_once('/')
}

fn drives(topic: &TopicContents) -> bool {
    topic.message_type.ends_with("/JointState")
        && fields(topic).iter().any(|field| {
            let sides = joints::sides(&field.names);
            !sides.left.is_empty() && !sides.right.is_empty()
        })
}
