//! `cargo xtask effect NAME`: the file of a new effect, to be filled with its law.

use std::fs::OpenOptions;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use clap::Args as ClapArgs;

/// An effect without a law; the tests of `robot-model` compile and check this very file.
const SKELETON: &str = include_str!("../../crates/robot-model/tests/effects/skeleton.rs");
/// Where effects live, from the root of the repository.
const FOLDER: &str = "crates/robot-model/src/effects";

/// Arguments of `cargo xtask effect`.
#[derive(Debug, ClapArgs)]
pub(crate) struct Args {
    /// Id of the effect: lower-case words joined by `_`.
    name: String,
}

/// Writes the skeleton and says what to do next.
pub(crate) fn run(args: &Args) -> Result<bool> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    write(&args.name, &root.join(FOLDER))?;
    println!("{}", next_steps(&args.name));
    Ok(true)
}

fn write(name: &str, folder: &Path) -> Result<PathBuf> {
    check(name)?;
    let path = folder.join(format!("{name}.rs"));
    // A file that is there is never overwritten.
    let mut file = OpenOptions::new()
        .write(true)
        .create_new(true)
        .open(&path)
        .with_context(|| format!("{} could not be created", path.display()))?;
    file.write_all(skeleton(name).as_bytes())?;
    Ok(path)
}

/// The skeleton as a file of `robot-model` itself.
fn skeleton(name: &str) -> String {
    SKELETON
        .replace("use robot_model::", "use crate::")
        .replace("new effect: skeleton", &name.replace('_', " "))
        .replace("\"skeleton\"", &format!("\"{name}\""))
}

fn check(name: &str) -> Result<()> {
    let is_snake = name.starts_with(|c: char| c.is_ascii_lowercase())
        && name.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_');
    if !is_snake || syn::parse_str::<syn::Ident>(name).is_err() {
        bail!("`{name}` cannot be the name of an effect: use lower-case words joined by `_`, such as steady_wind");
    }
    if catalogue::find(name).is_some() {
        bail!("`{name}` is in the catalogue already (`lacuna explain {name}`): choose another name");
    }
    Ok(())
}

fn next_steps(name: &str) -> String {
    format!(
        "Wrote {FOLDER}/{name}.rs. Next:\n\
         1. Write its law in `apply` (or in `robot`, or in `sense`), and its specification: docs/writing-an-effect.md.\n\
         2. Run `cargo test -p robot-model --features std`: one test fails until the law is there.\n\
         3. Add a test of the law against its closed form to crates/robot-model/tests/effects/.\n\
         4. Say in `export` how engines get it, then renew the pages:\n   \
            `LACUNA_WRITE_DOCS=1 cargo test -p model-export --test docs` and `cargo xtask book --docs`."
    )
}

#[cfg(test)]
mod tests {
    use super::{FOLDER, check, next_steps, skeleton, write};

    #[test]
    fn a_skeleton_bears_its_name_and_is_never_overwritten() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = write("steady_wind", folder.path()).expect("written");
        assert_eq!(path.file_name().and_then(|n| n.to_str()), Some("steady_wind.rs"));

        let text = std::fs::read_to_string(&path).expect("the file");
        assert!(text.contains("id: \"steady_wind\"") && text.contains("name: \"steady wind\""), "{text}");
        assert!(!text.contains("skeleton") && !text.contains("robot_model"), "{text}");

        let again = write("steady_wind", folder.path()).expect_err("it is there");
        assert!(again.to_string().contains("could not be created"), "{again}");
        assert_eq!(std::fs::read_to_string(&path).expect("the file"), text);
    }

    #[test]
    fn names_that_exist_or_are_no_identifiers_are_refused() {
        for bad in ["", "Wind", "2wind", "_wind", "steady-wind", "steady wind", "../wind", "loop", "größe"] {
            let error = check(bad).expect_err(bad).to_string();
            assert!(error.contains("cannot be the name"), "{error}");
        }
        for there in ["payload", "effective_track", "none", "unknown"] {
            let error = check(there).expect_err(there).to_string();
            assert!(error.contains("already"), "{error}");
        }
        check("steady_wind").expect("a new name");
    }

    #[test]
    fn what_comes_next_leads_to_files_that_are_there() {
        let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        for path in [
            FOLDER,
            "docs/writing-an-effect.md",
            "crates/robot-model/tests/effects",
            "crates/model-export/tests/docs.rs",
        ] {
            assert!(root.join(path).exists(), "{path}");
        }
        assert!(next_steps("x").contains("docs/writing-an-effect.md") && skeleton("x").contains("fn apply"));
    }
}
