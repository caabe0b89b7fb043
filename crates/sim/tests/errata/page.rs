//! The pages name the tests that exist, and the tests are on the page.

use std::fs;
use std::path::Path;

/// The cells of every numbered row of a table of a page, with its number.
fn rows(page: &str) -> Vec<(u32, Vec<String>)> {
    page.lines()
        .filter_map(|line| {
            let cells: Vec<String> = line.strip_prefix("| ")?.split(" |").map(|c| c.trim().to_string()).collect();
            Some((cells[0].parse().ok()?, cells))
        })
        .collect()
}

fn page(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/paper").join(name);
    fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// Each test of this folder: its file, its name and the text before it, back to the test before.
fn tests() -> Vec<(String, String, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/errata");
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("readable").path();
        let file = path.file_name().expect("a file").to_string_lossy().into_owned();
        if file == "page.rs" {
            continue;
        }
        let source = fs::read_to_string(&path).expect("text");
        let mut parts = source.split("#[test]\nfn ");
        let mut before = parts.next().unwrap_or_default();
        for part in parts {
            let name = part.split('(').next().unwrap_or_default();
            let comment = before.rsplit("\n\n").next().unwrap_or_default();
            found.push((file.clone(), name.to_string(), comment.to_string()));
            before = part;
        }
    }
    found
}

/// The numbers that a comment gives after "Erratum" or "Errata".
fn errata(comment: &str) -> Vec<u32> {
    let head = comment.split(':').next().unwrap_or_default();
    if !head.contains("Errat") {
        return Vec::new();
    }
    head.split(|c: char| !c.is_ascii_digit()).filter_map(|n| n.parse().ok()).collect()
}

#[test]
fn every_erratum_has_its_row_and_names_tests_that_exist() {
    let (page, tests) = (page("errata.md"), tests());
    let rows = rows(&page);
    assert_eq!(rows.iter().map(|(n, _)| *n).collect::<Vec<_>>(), (1..=25).collect::<Vec<_>>());
    for (number, cells) in &rows {
        let shown = &cells[4];
        let mut named: Vec<&str> = shown.split('`').skip(1).step_by(2).collect();
        let mut existing: Vec<&str> =
            tests.iter().filter(|(_, _, comment)| errata(comment).contains(number)).map(|t| t.1.as_str()).collect();
        named.sort_unstable();
        existing.sort_unstable();
        assert_eq!(named, existing, "erratum {number}");
        assert_eq!(named.is_empty(), shown == "misprint, nothing to compute", "erratum {number}");
        for (file, name, _) in tests.iter().filter(|t| named.contains(&t.1.as_str())) {
            assert!(shown.contains(&format!("tests/errata/{file})")), "erratum {number}: {name} is in {file}");
        }
    }
}

#[test]
fn every_test_belongs_to_an_erratum() {
    for (file, name, comment) in tests() {
        assert!(!errata(&comment).is_empty(), "{file}: {name}");
    }
}

#[test]
fn every_equation_figure_and_table_has_its_row() {
    let page = page("equations.md");
    let has = |item: String| page.lines().any(|line| line.starts_with(&format!("| {item} |")));
    let items = (1..=25).map(|n| format!("Eq. {n}")).chain((1..=7).map(|n| format!("Fig. {n}")));
    for item in items.chain(["Table 1".to_string()]) {
        assert!(has(item.clone()), "{item} has no row");
    }
}
