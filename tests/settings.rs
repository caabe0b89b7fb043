//! No tuned number stands bare in a function: it is a setting, with unit, meaning and source.
//!
//! What the sources are searched for are float literals. Integers are not judged: most of them are sizes and places.

use std::path::{Path, PathBuf};

use syn::buffer::{Cursor, TokenBuffer};
use syn::visit::{self, Visit};

/// Crates whose numbers decide what a verdict says.
const CRATES: [&str; 11] = [
    "inference",
    "torque-driven",
    "speed-driven",
    "command-driven",
    "hierarchical-fit",
    "odometry",
    "single-track",
    "wheeled",
    "diagnosis",
    "weak-form",
    "rehearsal",
];

/// Numbers of formulas, and of units: s in a minute, degrees in half a turn, %, kilo, nano.
const FORMULAS: [f64; 12] = [0.0, 1.0, 2.0, 3.0, 4.0, 0.5, 0.25, 60.0, 180.0, 100.0, 1e3, 1e9];
/// What keeps a division or a logarithm finite is at most this.
const GUARD: f64 = 1e-6;

/// File, literal, and why it is no setting.
const NO_SETTINGS: [(&str, &str, &str); 18] = [
    ("inference/src/robust.rs", "1.282", "mathematics: a quantile of the normal distribution"),
    ("inference/src/robust.rs", "1.645", "mathematics: a quantile of the normal distribution"),
    ("inference/src/robust.rs", "1.96", "mathematics: a quantile of the normal distribution"),
    ("inference/src/robust.rs", "1.353", "mathematics: half a quantile of chi-squared"),
    ("inference/src/robust.rs", "1.4826", "mathematics: from the median absolute deviation to sigma"),
    ("inference/src/words.rs", "0.01", "rounding: the least that two decimals show"),
    ("inference/src/words.rs", "0.99", "rounding: the most below one that two decimals show"),
    ("diagnosis/src/possible.rs", "9.806_65", "unit: the standard acceleration of free fall"),
    ("torque-driven/src/redundancy/pool.rs", "1.25", "mathematics: from the sigma of a mean to that of a median"),
    ("torque-driven/src/locate/change.rs", "6.0", "mathematics: the mean of a sum of twelve uniform numbers"),
    ("torque-driven/src/unnamed/shared.rs", "12.0", "mathematics: the variance of Mann and Whitney's statistic"),
    (
        "command-driven/src/name.rs",
        "12.0_f64",
        "mathematics: the variance of a uniform distribution over its width squared, inverted",
    ),
    ("wheeled/src/noise.rs", "20.0", "mathematics: 1 + 9 + 9 + 1, the variance of third differences"),
    ("odometry/src/file/robot.rs", "1e-3", "unit: seconds in a millisecond"),
    ("torque-driven/src/fit.rs", "1e300", "structure: the cost of a run that is not finite, which can be added"),
    ("speed-driven/src/clock.rs", "0.9", "the quantile that its page names"),
    ("command-driven/src/run.rs", "1e-9", "unit: seconds in a nanosecond"),
    ("diagnosis/src/long/mod.rs", "0.75", "the upper quartile"),
];

/// A float literal that is none of a formula.
#[derive(Debug, PartialEq, Eq)]
struct Bare {
    /// The function or constant that it stands in.
    item: String,
    literal: String,
}

/// The bare literals of a source, tests left out.
#[derive(Default)]
struct Search {
    /// Names of the items that are being read, the innermost last, and whether each is a constant.
    within: Vec<(String, bool)>,
    found: Vec<Bare>,
}

impl Search {
    fn of(source: &str) -> Vec<Bare> {
        let mut search = Self::default();
        search.visit_file(&syn::parse_file(source).expect("Rust"));
        search.found
    }

    fn within(&mut self, name: &syn::Ident, constant: bool, read: impl FnOnce(&mut Self)) {
        self.within.push((name.to_string(), constant));
        read(self);
        self.within.pop();
    }

    fn judge(&mut self, literal: &syn::LitFloat) {
        let value: f64 = literal.base10_parse().expect("digits of a float");
        // A constant has a name because it was chosen: only 0 and 1, which make patterns, are none there.
        let constant = self.within.iter().any(|(_, constant)| *constant);
        let formula = if constant { value == 0.0 || value == 1.0 } else { FORMULAS.contains(&value) || value <= GUARD };
        if !formula {
            let item = self.within.last().map_or_else(String::new, |(name, _)| name.clone());
            self.found.push(Bare { item, literal: literal.to_string() });
        }
    }

    /// What stands between the brackets of a macro.
    fn tokens(&mut self, mut at: Cursor<'_>) {
        loop {
            if let Some((literal, next)) = at.literal() {
                if let syn::Lit::Float(float) = syn::Lit::new(literal) {
                    self.judge(&float);
                }
                at = next;
            } else if let Some((inside, _, _, next)) = at.any_group() {
                self.tokens(inside);
                at = next;
            } else if let Some((_, next)) = at.token_tree() {
                at = next;
            } else {
                return;
            }
        }
    }
}

fn is_test(attributes: &[syn::Attribute]) -> bool {
    attributes.iter().any(|a| match &a.meta {
        syn::Meta::Path(path) => path.is_ident("test"),
        syn::Meta::List(list) => list.path.is_ident("cfg") && list.tokens.to_string() == "test",
        syn::Meta::NameValue(_) => false,
    })
}

impl<'a> Visit<'a> for Search {
    fn visit_item(&mut self, item: &'a syn::Item) {
        match item {
            syn::Item::Mod(i) if is_test(&i.attrs) => {}
            syn::Item::Impl(i) if is_test(&i.attrs) => {}
            syn::Item::Fn(i) if is_test(&i.attrs) => {}
            syn::Item::Const(i) if is_test(&i.attrs) => {}
            syn::Item::Fn(i) => self.within(&i.sig.ident, false, |s| visit::visit_item(s, item)),
            syn::Item::Const(i) => self.within(&i.ident, true, |s| visit::visit_item(s, item)),
            syn::Item::Static(i) => self.within(&i.ident, true, |s| visit::visit_item(s, item)),
            _ => visit::visit_item(self, item),
        }
    }

    fn visit_impl_item(&mut self, item: &'a syn::ImplItem) {
        match item {
            syn::ImplItem::Fn(i) if is_test(&i.attrs) => {}
            syn::ImplItem::Fn(i) => self.within(&i.sig.ident, false, |s| visit::visit_impl_item(s, item)),
            syn::ImplItem::Const(i) => self.within(&i.ident, true, |s| visit::visit_impl_item(s, item)),
            _ => visit::visit_impl_item(self, item),
        }
    }

    fn visit_lit_float(&mut self, literal: &'a syn::LitFloat) {
        self.judge(literal);
    }

    fn visit_macro(&mut self, called: &'a syn::Macro) {
        self.tokens(TokenBuffer::new2(called.tokens.clone()).begin());
    }

    fn visit_attribute(&mut self, _: &'a syn::Attribute) {}
}

/// The sources in a folder that are neither settings nor tests.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut out = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display())) {
        let path = entry.expect("an entry of a folder").path();
        let stem = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default();
        if ["settings", "tests", "testing"].contains(&stem) {
            continue;
        }
        if path.is_dir() {
            out.extend(sources(&path));
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            out.push(path);
        }
    }
    out.sort();
    out
}

#[test]
fn no_tuned_number_stands_bare() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("crates");
    let mut bare = Vec::new();
    let mut used = [false; NO_SETTINGS.len()];
    for path in CRATES.iter().flat_map(|name| sources(&crates.join(name).join("src"))) {
        let file = path.strip_prefix(&crates).expect("below crates").to_string_lossy().replace('\\', "/");
        for found in Search::of(&std::fs::read_to_string(&path).expect("a source")) {
            match NO_SETTINGS.iter().position(|(f, literal, _)| *f == file && *literal == found.literal) {
                Some(row) => used[row] = true,
                None => bare.push(format!("crates/{file}, `{}`: {}", found.item, found.literal)),
            }
        }
    }
    assert!(
        bare.is_empty(),
        "bare numbers; move each into the settings of its crate, with unit, meaning and source (CONTRIBUTING.md, \"A tuned \
         number\"), or, if it follows from mathematics or a unit, add a row with the reason to NO_SETTINGS in {}:\n{}",
        file!(),
        bare.join("\n")
    );
    let idle: Vec<_> = NO_SETTINGS.iter().zip(used).filter(|(_, used)| !used).map(|(row, _)| row).collect();
    assert!(idle.is_empty(), "no longer in the sources; delete these rows of NO_SETTINGS: {idle:?}");
}

#[test]
fn the_search_sees_constants_functions_and_macros_and_leaves_formulas_and_tests_out() {
    let source = r"
        /// Not 0.7 of a comment.
        const LENGTH: f64 = 2.0;
        const MOVES: [[f64; 2]; 2] = [[1.0, 0.0], [0.0, -1.0]];
        const ALIAS: f64 = SETTINGS.length.least;
        struct Plant;
        impl Plant {
            const GAIN: [f64; 2] = [0.0, 0.1];
            fn step(&self, v: f64) -> f64 { 0.5 * self.mass * v * v / v.max(1e-12) + 0.3 * v }
        }
        fn sure(z: f64) -> bool { assert!(z < vec![4.5; 2][0]); z > 3.0 }
        #[test]
        fn is_sure() { assert!(sure(8.5)) }
        #[cfg(test)]
        mod tests { const FAR: f64 = 70.0; }
    ";
    let bare = |item: &str, literal: &str| Bare { item: item.into(), literal: literal.into() };
    assert_eq!(
        Search::of(source),
        [bare("LENGTH", "2.0"), bare("GAIN", "0.1"), bare("step", "0.3"), bare("sure", "4.5")]
    );
}
