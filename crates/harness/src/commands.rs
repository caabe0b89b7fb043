//! Which package a command of `cargo xtask` lives in.

/// A command that is not part of the light program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Elsewhere {
    /// Its name: `cargo xtask NAME`.
    pub name: &'static str,
    /// What it does, in a sentence.
    pub about: &'static str,
    /// The package whose program knows it.
    pub package: &'static str,
    /// The features which that package is built with.
    pub features: Option<&'static str>,
}

/// All of them. The programs themselves say the same sentences; their tests compare.
pub const ELSEWHERE: [Elsewhere; 14] = [
    measuring("learn", "Compare adaptive laws on laps they have not seen: which keep what they learn"),
    measuring("compare", "Measure our kernels beside C, SciPy, numba, PySINDy and MuJoCo"),
    measuring("growth", "Measure what `lacuna` costs as recordings become longer and more, and with how many cores"),
    measuring("instructions", "Count instructions of the hot kernels and compare them with those on record"),
    measuring("cold", "Measure what a fresh clone costs: the first command, the program, the tests"),
    proof(
        "blind",
        "Draw blind cases, seal their truth, diagnose and score them; or write answers for given case folders",
    ),
    proof("evidence", "Diagnose real recordings with the effect concealed, then open the witness"),
    proof("mujoco", "Run exported models in MuJoCo on held-out inputs and compare with the truth"),
    proof("next", "Ask whether it pays to follow the advice on the next drive"),
    proof("odometry", "Calibrate open recordings of wheel counts and poses, and forecast sessions left out"),
    proof("car", "Forecast left-out drives of an open 1:10 car from throttle and steering, beside classical models"),
    proof("law", "Leave a name of the catalogue out, and ask what law is found in its place"),
    proof("bag", "Measure time and memory of `lacuna check` on a large bag"),
    Elsewhere {
        name: "book",
        about: "Build the documentation as a book that opens offline",
        package: "book",
        features: Some("generator"),
    },
];

const fn measuring(name: &'static str, about: &'static str) -> Elsewhere {
    Elsewhere { name, about, package: "measuring", features: None }
}

const fn proof(name: &'static str, about: &'static str) -> Elsewhere {
    Elsewhere { name, about, package: "proof", features: None }
}

/// Names and sentences of the commands of one package, in their order.
pub fn of(package: &str) -> Vec<(&'static str, &'static str)> {
    ELSEWHERE.iter().filter(|command| command.package == package).map(|command| (command.name, command.about)).collect()
}
