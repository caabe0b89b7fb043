//! What a line of a `sh` block asks for.

use skipping::Outcome;

/// A command of the documentation.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Command {
    /// `lacuna`, also as `cargo run -p lacuna --` and `target/release/lacuna`; a file for its output.
    Lacuna(Vec<String>, Option<String>),
    /// `cargo xtask`.
    Xtask(Vec<String>),
    /// `cargo build` and `cargo test`: packages and test targets that must exist.
    Cargo { packages: Vec<String>, tests: Vec<String> },
    /// A program that is no part of this repository, on a script beside it.
    Beside(String),
}

impl Command {
    /// Reads a line of shell, as far as the documentation uses it.
    pub(crate) fn parse(line: &str) -> Result<Self, String> {
        let mut words = shlex::split(line).ok_or_else(|| format!("a quote that does not close: {line}"))?;
        let into = match words.iter().position(|word| word == ">") {
            Some(at) => {
                let file = words.get(at + 1).cloned().ok_or("a `>` without a file")?;
                words.truncate(at);
                Some(file)
            }
            None => None,
        };
        let texts: Vec<&str> = words.iter().map(String::as_str).collect();
        let rest = |from: usize| words[from..].to_vec();
        match texts.as_slice() {
            ["lacuna" | "target/release/lacuna", ..] => Ok(Self::Lacuna(rest(1), into)),
            ["cargo", "run", ..] => {
                let end = texts.iter().position(|word| *word == "--").unwrap_or(texts.len());
                let is_lacuna = texts[..end].windows(2).any(|pair| pair == ["-p", "lacuna"]);
                let args = words.get(end + 1..).unwrap_or_default().to_vec();
                if is_lacuna { Ok(Self::Lacuna(args, into)) } else { Err(format!("runs what is not lacuna: {line}")) }
            }
            ["cargo", "xtask", ..] => Ok(Self::Xtask(rest(2))),
            ["cargo", "build" | "test" | "install", ..] => {
                let after = |option: &str| {
                    texts.windows(2).filter(|pair| pair[0] == option).map(|pair| pair[1].to_owned()).collect()
                };
                Ok(Self::Cargo { packages: after("-p"), tests: after("--test") })
            }
            ["sh" | "python3", script, ..] => Ok(Self::Beside((*script).to_owned())),
            _ => Err(format!("nobody knows how to test this line: {line}")),
        }
    }
}

pub(crate) fn every_way_to_start_lacuna_is_the_same() -> Outcome {
    let expected = Ok(Command::Lacuna(vec!["explain".to_owned(), "a b".to_owned()], None));
    for start in ["lacuna", "target/release/lacuna", "cargo run --release -p lacuna --"] {
        assert_eq!(Command::parse(&format!("{start} explain 'a b'")), expected);
    }
    let into = Command::parse("lacuna man > lacuna.1");
    assert_eq!(into, Ok(Command::Lacuna(vec!["man".to_owned()], Some("lacuna.1".to_owned()))));
    assert!(Command::parse("rm -r x").is_err());
    Ok(())
}
