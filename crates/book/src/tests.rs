//! The book of this repository: it builds, and no page of it points at nothing or at the network.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use super::*;

fn pages(folder: &Path, out: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            pages(&path, out);
        } else if path.extension().is_some_and(|ending| ending == "html") {
            out.push(path);
        }
    }
}

/// The values of an attribute in HTML that mdBook wrote, which always quotes them.
fn values<'h>(html: &'h str, attribute: &str) -> Vec<&'h str> {
    let opening = format!(" {attribute}=\"");
    html.split(&opening).skip(1).filter_map(|rest| rest.split('"').next()).collect()
}

#[test]
fn every_link_of_the_book_leads_somewhere_and_nothing_is_loaded_from_a_network() {
    let folder = tempfile::tempdir().expect("a folder");
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).expect("the workspace");
    build(root, folder.path()).expect("the book");
    let mut all = Vec::new();
    pages(folder.path(), &mut all);
    assert!(all.len() > 15, "{all:?}");
    let mut dead = BTreeSet::new();
    for page in &all {
        let html = std::fs::read_to_string(page).expect("a page");
        for loaded in values(&html, "src") {
            assert!(!loaded.contains("//"), "{}: loads {loaded}", page.display());
        }
        let links = values(&html, "href").into_iter().chain(values(&html, "src"));
        for link in links.filter(|link| !link.contains(':')) {
            let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
            let target = if file.is_empty() { page.clone() } else { page.with_file_name("").join(file) };
            let is_page = target.extension().is_some_and(|ending| ending == "html");
            let there = std::fs::read_to_string(&target).unwrap_or_default();
            if !target.is_file() || (is_page && !anchor.is_empty() && !values(&there, "id").contains(&anchor)) {
                dead.insert(format!("{}: {link}", page.strip_prefix(folder.path()).expect("below it").display()));
            }
        }
    }
    assert!(dead.is_empty(), "{dead:#?}");
}

#[test]
fn every_page_of_the_documentation_is_in_the_book() {
    let docs = output::docs("");
    let summary = std::fs::read_to_string(docs.join("SUMMARY.md")).expect("a summary");
    let mut all = vec![docs.clone()];
    let mut missing = Vec::new();
    while let Some(folder) = all.pop() {
        for entry in std::fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            let name = path.strip_prefix(&docs).expect("below it").to_string_lossy().replace('\\', "/");
            let is_page = path.extension().is_some_and(|ending| ending == "md");
            if path.is_dir() {
                all.push(path);
            } else if is_page && name != "SUMMARY.md" && !summary.contains(&format!("]({name})")) {
                missing.push(name);
            }
        }
    }
    assert!(missing.is_empty(), "not in docs/SUMMARY.md: {missing:?}");
}

#[test]
fn the_command_is_listed_by_xtask_in_the_same_words() {
    let cli = <Cli as clap::CommandFactory>::command();
    let about = |c: &clap::Command| c.get_about().map(ToString::to_string).unwrap_or_default();
    let own: Vec<(String, String)> = cli.get_subcommands().map(|c| (c.get_name().to_owned(), about(c))).collect();
    let listed = harness::commands::of("book");
    assert_eq!(own, listed.iter().map(|(n, a)| ((*n).to_owned(), (*a).to_owned())).collect::<Vec<_>>());
}
