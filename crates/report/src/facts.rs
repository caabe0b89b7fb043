//! The figures that stand large at the top of a page.

use pages::escape::escape;

/// A list of figures in the making.
#[derive(Default)]
pub(crate) struct Facts(Vec<String>);

impl Facts {
    /// Adds a value under its name, with more in small letters; `class` is a colour of the page or empty.
    pub(crate) fn add(&mut self, class: &str, name: &str, value: &str, more: &str) {
        let [name, value, more] = [name, value, more].map(escape);
        self.0.push(format!("<div class=\"{class}\"><dt>{name}</dt><dd>{value}<small>{more}</small></dd></div>\n"));
    }

    /// The list as markup.
    pub(crate) fn markup(&self) -> String {
        format!("<dl class=\"facts\">\n{}</dl>\n", self.0.concat())
    }
}
