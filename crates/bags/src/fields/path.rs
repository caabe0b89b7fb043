//! The path of a field in text.

/// The column of a message's log time.
pub const LOG_TIME: &str = "log_time";

/// The stamp in a message's header, by its driver.
pub const HEADER_STAMP: &str = "header.stamp";

/// A path in parts.
pub(super) type Path = Vec<Part>;

/// One step of a path.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Part {
    /// `.name`
    Field(String),
    /// `[3]`
    Index(usize),
    /// `[wheel_left_joint]`: the place of this name in the list of names beside.
    Name(String),
}

/// Most names in such a list; with more, a message does not decode.
pub(super) const MOST_NAMES: usize = 4096;

/// Lists of names that may stand beside a list of numbers, the first that is there counts.
pub(super) const NAME_LISTS: [&str; 3] = ["name", "names", "joint_names"];

/// Reads a path; a complaint when it is none.
pub(super) fn parse(text: &str) -> Result<Path, String> {
    let complaint = || "is no path of a field; write it like velocity[0] or twist.linear.x".to_owned();
    let mut parts = Vec::new();
    let mut rest = text.trim().strip_prefix('.').unwrap_or(text.trim());
    loop {
        let end = rest.find(['.', '[']).unwrap_or(rest.len());
        if end == 0 {
            return Err(complaint());
        }
        parts.push(Part::Field(rest[..end].to_owned()));
        rest = &rest[end..];
        while let Some(inside) = rest.strip_prefix('[') {
            let (index, after) = inside.split_once(']').ok_or_else(complaint)?;
            let index = index.trim();
            if index.is_empty() {
                return Err(complaint());
            }
            parts.push(index.parse().map_or_else(|_| Part::Name(index.to_owned()), Part::Index));
            rest = after;
        }
        match rest.strip_prefix('.') {
            _ if rest.is_empty() => return Ok(parts),
            Some(after) => rest = after,
            None => return Err(complaint()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_and_what_is_none() {
        let field = |name: &str| Part::Field(name.to_owned());
        assert_eq!(parse("twist.linear.x").unwrap(), [field("twist"), field("linear"), field("x")]);
        assert_eq!(parse("a[2].b[left_wheel]").unwrap().len(), 4);
        assert_eq!(parse("v[left.wheel]").unwrap()[1], Part::Name("left.wheel".to_owned()));
        for bad in ["", ".", "a.", "a..b", "a[", "a[]", "a[1]b", "[0]"] {
            assert!(parse(bad).is_err(), "{bad}");
        }
    }
}
