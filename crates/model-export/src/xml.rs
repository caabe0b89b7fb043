//! A tree of XML.

use std::io;

use quick_xml::Writer;
use quick_xml::events::{BytesEnd, BytesStart, BytesText, Event};

use crate::number::{number, numbers};

/// An element with all that is in it.
#[derive(Debug, Clone)]
pub(crate) struct Element {
    name: &'static str,
    attributes: Vec<(&'static str, String)>,
    children: Vec<Node>,
}

#[derive(Debug, Clone)]
enum Node {
    Element(Element),
    Comment(String),
    Text(String),
}

/// An element without anything in it.
pub(crate) fn element(name: &'static str) -> Element {
    Element { name, attributes: Vec::new(), children: Vec::new() }
}

impl Element {
    /// With an attribute.
    pub(crate) fn with(mut self, name: &'static str, value: impl Into<String>) -> Self {
        self.attributes.push((name, value.into()));
        self
    }

    /// With a number as an attribute.
    pub(crate) fn num(self, name: &'static str, value: f64) -> Self {
        self.with(name, number(value))
    }

    /// With numbers as an attribute.
    pub(crate) fn nums(self, name: &'static str, values: &[f64]) -> Self {
        self.with(name, numbers(values))
    }

    /// With an element inside.
    pub(crate) fn child(mut self, child: Self) -> Self {
        self.children.push(Node::Element(child));
        self
    }

    /// With elements inside.
    pub(crate) fn children(mut self, children: impl IntoIterator<Item = Self>) -> Self {
        self.children.extend(children.into_iter().map(Node::Element));
        self
    }

    /// With a text inside.
    pub(crate) fn text(mut self, text: impl Into<String>) -> Self {
        self.children.push(Node::Text(text.into()));
        self
    }

    /// With an element inside that holds a text.
    pub(crate) fn leaf(self, name: &'static str, text: impl Into<String>) -> Self {
        self.child(element(name).text(text))
    }

    /// With an element inside that holds numbers.
    pub(crate) fn value(self, name: &'static str, values: &[f64]) -> Self {
        self.leaf(name, numbers(values))
    }

    /// With comments inside.
    pub(crate) fn comments(mut self, comments: impl IntoIterator<Item = String>) -> Self {
        self.children.extend(comments.into_iter().map(Node::Comment));
        self
    }

    /// As a document, with comments before the root.
    pub(crate) fn document(self, comments: Vec<String>) -> io::Result<String> {
        let mut writer = Writer::new_with_indent(Vec::new(), b' ', 2);
        for text in comments {
            comment(&mut writer, &text)?;
        }
        self.write(&mut writer)?;
        let mut bytes = writer.into_inner();
        bytes.push(b'\n');
        String::from_utf8(bytes).map_err(io::Error::other)
    }

    fn write(&self, writer: &mut Writer<Vec<u8>>) -> io::Result<()> {
        let mut start = BytesStart::new(self.name);
        for (name, value) in &self.attributes {
            start.push_attribute((*name, value.as_str()));
        }
        if self.children.is_empty() {
            return writer.write_event(Event::Empty(start));
        }
        writer.write_event(Event::Start(start))?;
        for child in &self.children {
            match child {
                Node::Element(e) => e.write(writer)?,
                Node::Comment(text) => comment(writer, text)?,
                Node::Text(text) => writer.write_event(Event::Text(BytesText::new(text)))?,
            }
        }
        writer.write_event(Event::End(BytesEnd::new(self.name)))
    }
}

fn comment(writer: &mut Writer<Vec<u8>>, text: &str) -> io::Result<()> {
    // Two hyphens would end it, and nothing else is special inside.
    let mut text = text.to_owned();
    while text.contains("--") {
        text = text.replace("--", "- -");
    }
    writer.write_event(Event::Comment(BytesText::from_escaped(format!(" {text} "))))
}
