//! At which commit a page was printed.

use std::process::{Command, Stdio};

use crate::output;

/// The sentence that a page carries: by which command, that of this process, and at which commit it was printed.
pub fn printed() -> String {
    let command: Vec<String> = std::env::args().skip(1).collect();
    format!("Printed by `cargo xtask {}` {}.", recipe(&command).join(" "), at(hash().as_deref(), has_changes()))
}

/// Options that name a folder of this machine, which is nothing that a page's figures depend on.
const FOLDERS: [&str; 2] = ["--out", "--data"];

/// The arguments without those folders.
fn recipe(arguments: &[String]) -> Vec<&str> {
    let is_folder = |argument: &str| FOLDERS.contains(&argument.split('=').next().unwrap_or(argument));
    let mut out = Vec::new();
    let mut rest = arguments.iter().map(String::as_str);
    while let Some(argument) = rest.next() {
        if !is_folder(argument) {
            out.push(argument);
        } else if !argument.contains('=') {
            rest.next();
        }
    }
    out
}

/// The commit in words.
fn at(hash: Option<&str>, changes: bool) -> String {
    match hash {
        Some(hash) => format!("at commit {hash}{}", if changes { ", with changes" } else { "" }),
        None => "outside of a repository".to_owned(),
    }
}

fn hash() -> Option<String> {
    git(&["rev-parse", "--short=10", "HEAD"]).map(|text| text.trim().to_owned()).filter(|hash| !hash.is_empty())
}

/// Whether files differ from that commit. Pages do not count: the command that asks writes some.
fn has_changes() -> bool {
    git(&["status", "--porcelain", "--untracked-files=no", "--", ".", ":(exclude)docs", ":(exclude)*.md"])
        .is_some_and(|text| !text.trim().is_empty())
}

/// What git prints in the workspace's folder; `None` where there is no git or no repository.
fn git(args: &[&str]) -> Option<String> {
    let told = Command::new("git")
        .args(args)
        .current_dir(output::beside("."))
        .stdin(Stdio::null())
        .stderr(Stdio::null())
        .output();
    told.ok().filter(|told| told.status.success()).and_then(|told| String::from_utf8(told.stdout).ok())
}

#[cfg(test)]
mod tests {
    use super::{at, recipe};

    #[test]
    fn a_page_names_no_folder_of_the_machine_that_printed_it() {
        let of = |line: &str| recipe(&line.split(' ').map(str::to_owned).collect::<Vec<_>>()).join(" ");
        assert_eq!(of("blind --wide --out /somewhere/w4 --seed 4 --docs"), "blind --wide --seed 4 --docs");
        assert_eq!(of("odometry --data=/somewhere --docs"), "odometry --docs");
    }

    #[test]
    fn a_page_tells_its_commit_and_whether_more_was_changed() {
        assert_eq!(at(Some("0123456789"), false), "at commit 0123456789");
        assert_eq!(at(Some("0123456789"), true), "at commit 0123456789, with changes");
        assert_eq!(at(None, false), "outside of a repository");
    }
}
