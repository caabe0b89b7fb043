//! Default classes of MJCF: attributes that elements inherit.

use std::collections::HashMap;

use roxmltree::Node;

use crate::source::children;

/// Attributes of a kind of element, by their names.
type Attributes<'a> = HashMap<&'a str, &'a str>;

/// What elements of a class have that they do not say.
#[derive(Debug, Default)]
pub(super) struct Defaults<'a> {
    /// By class, then by the element's kind.
    classes: HashMap<&'a str, HashMap<&'a str, Attributes<'a>>>,
}

/// The class of all that name none.
const MAIN: &str = "main";

impl<'a> Defaults<'a> {
    /// Of the whole model: a class begins with what the one around it has.
    pub(super) fn new(root: Node<'a, '_>) -> Self {
        let mut out = Self::default();
        let outer =
            children(root, "default").map(|node| (node, node.attribute("class").unwrap_or(MAIN), HashMap::new()));
        // Taken from the end, so in the order of the file: what comes later under the same name replaces it.
        let mut waiting: Vec<(Node<'a, '_>, &'a str, HashMap<&'a str, Attributes<'a>>)> = outer.collect();
        waiting.reverse();
        while let Some((node, class, mut all)) = waiting.pop() {
            for kind in node.children().filter(|n| n.is_element() && !n.has_tag_name("default")) {
                let of = all.entry(kind.tag_name().name()).or_default();
                of.extend(kind.attributes().map(|a| (a.name(), a.value())));
            }
            let inside = children(node, "default").filter_map(|n| Some((n, n.attribute("class")?)));
            waiting.extend(inside.map(|(node, class)| (node, class, all.clone())));
            out.classes.insert(class, all);
        }
        out
    }

    /// An attribute of an element, its own or that of its class.
    pub(super) fn attribute(&self, node: Node<'a, '_>, name: &str) -> Option<&'a str> {
        let inherited = || node.ancestors().skip(1).find_map(|n| n.attribute("childclass"));
        let class = || node.attribute("class").or_else(inherited).unwrap_or(MAIN);
        let of_class = || self.classes.get(class())?.get(node.tag_name().name())?.get(name).copied();
        node.attribute(name).or_else(of_class)
    }
}
