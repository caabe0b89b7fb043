//! What the paper leaves out or gets wrong, shown by computation: one test per claim of `docs/paper/errata.md`.

mod experiment;
mod model;
mod page;
mod representation;
mod run;
mod stability;
