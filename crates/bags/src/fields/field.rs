//! A numeric field, as a survey of messages finds it.

use super::path::MOST_NAMES;

/// Most fields of a topic that are told.
pub(super) const MOST_TOLD: usize = 4096;

/// A numeric field of a topic's messages, or a list of them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Field {
    /// Its path: `angular_velocity.z`, and for a list `velocity`, whose items are `velocity[0]` and so on.
    pub path: String,
    /// Fewest and most items that a list had; `None` where it is no list.
    pub lengths: Option<(usize, usize)>,
    /// The names of a list's items, where the message gives each one: `velocity[wheel_left_joint]`.
    pub names: Vec<String>,
}

/// Widens what is known of a field by a list of this length with these names.
pub(super) fn add(field: &mut Field, length: Option<usize>, names: &[String]) {
    if let (Some((least, most)), Some(length)) = (&mut field.lengths, length) {
        *least = length.min(*least);
        *most = length.max(*most);
    }
    for name in names {
        if field.names.len() < MOST_NAMES && !field.names.contains(name) {
            field.names.push(name.clone());
        }
    }
}
