//! One battery over all effects of the catalogue, and the law of each.

mod battery;
#[path = "../common/mod.rs"]
mod common;
mod derivatives;
mod energy;
mod finite;
mod laws;
mod mirror;
mod neutral;
mod new_effect;
mod new_laws;
mod proportion;
// What `cargo xtask effect NAME` writes, but for the name.
#[expect(unreachable_pub, reason = "it is written into the library, where it is public")]
mod skeleton;
mod specs;
