//! Lists `src/effects/*.rs` in file-name order, so that a new effect is one new file.
use std::fmt::Write as _;
use std::{env, fs, path::Path};

fn main() {
    let root = env::var("CARGO_MANIFEST_DIR").expect("cargo sets the manifest directory");
    let dir = Path::new(&root).join("src/effects");
    println!("cargo::rerun-if-changed={}", dir.display());
    let mut names: Vec<String> = fs::read_dir(&dir)
        .expect("src/effects is part of the crate")
        .filter_map(|entry| {
            let path = entry.ok()?.path();
            // Editors leave other files beside.
            path.extension().filter(|e| *e == "rs")?;
            path.file_stem()?.to_str().map(str::to_owned)
        })
        .collect();
    names.sort();
    let code = catalogue(&dir, &names).expect("text is always writable");
    let out = Path::new(&env::var("OUT_DIR").expect("cargo sets the output directory")).join("effects.rs");
    fs::write(out, code).expect("the output directory is writable");
}

fn catalogue(dir: &Path, names: &[String]) -> Result<String, std::fmt::Error> {
    let mut code = String::new();
    for n in names {
        let file = dir.join(format!("{n}.rs"));
        writeln!(code, "#[path = {:?}]\npub mod {n};", file.display().to_string())?;
    }
    writeln!(code, "/// Number of effects in the catalogue.\npub const COUNT: usize = {};", names.len())?;
    code += "/// Every effect, in the order of their file names.\n";
    code += "pub const fn catalogue<T: crate::Scalar>() -> [&'static dyn crate::Effect<T>; COUNT] {\n    [";
    for n in names {
        write!(code, "&{n}::Law, ")?;
    }
    code += "]\n}\n";
    Ok(code)
}
