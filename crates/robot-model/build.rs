//! Lists `src/effects/*.rs` in file-name order, so that a new effect is one new file.
use std::{env, fs, path::Path};

fn main() {
    let root = env::var("CARGO_MANIFEST_DIR").expect("cargo sets the manifest directory");
    let dir = Path::new(&root).join("src/effects");
    println!("cargo::rerun-if-changed={}", dir.display());
    let mut names: Vec<String> = fs::read_dir(&dir)
        .expect("src/effects is part of the crate")
        .filter_map(|e| e.ok()?.path().file_stem()?.to_str().map(str::to_owned))
        .collect();
    names.sort();
    let mut code = String::new();
    for n in &names {
        code += &format!("#[path = {:?}]\npub mod {n};\n", dir.join(format!("{n}.rs")).display().to_string());
    }
    code += &format!("/// Number of effects in the catalogue.\npub const COUNT: usize = {};\n", names.len());
    code += "/// Every effect, in the order of their file names.\npub const fn catalogue<T: crate::Scalar>() -> [&'static dyn crate::Effect<T>; COUNT] {\n    [";
    for n in &names {
        code += &format!("&{n}::Law, ");
    }
    code += "]\n}\n";
    let out = Path::new(&env::var("OUT_DIR").expect("cargo sets the output directory")).join("effects.rs");
    fs::write(out, code).expect("the output directory is writable");
}
