//! Takes plotly.js out of the crate that carries it and compresses it: programs that write pages become 5 MB smaller, and
//! that crate is needed by this script only. Its second script, MathJax, stays out: no chart here uses it.

use std::error::Error;
use std::fs::File;
use std::io::Write;
use std::path::PathBuf;

use flate2::Compression;
use flate2::write::DeflateEncoder;

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed=build.rs");

    let sources = plotly::Plot::offline_js_sources();
    let code = sources
        .split_once("<script")
        .and_then(|(_, rest)| rest.split_once('>'))
        .and_then(|(_, rest)| rest.split_once("</script>"))
        .map(|(code, _)| code)
        .ok_or("the first script of the crate plotly is no longer plotly.js")?;

    let target = PathBuf::from(std::env::var("OUT_DIR")?).join("plotly.js.deflate");
    let mut encoder = DeflateEncoder::new(File::create(target)?, Compression::best());
    encoder.write_all(code.as_bytes())?;
    encoder.finish()?;
    Ok(())
}
