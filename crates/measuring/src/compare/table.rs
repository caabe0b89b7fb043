//! What is compared with what, and what is asked: the whole table.

use super::figure::Place;

/// A program with its arguments.
#[derive(Debug, Clone, Copy)]
pub(super) struct Program {
    pub(super) of: Of,
    pub(super) args: &'static [&'static str],
    pub(super) place: Place,
}

/// Where a program comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Of {
    /// An example of a package of this workspace.
    Example { package: &'static str, name: &'static str },
    /// A compiled anchor.
    Anchor(&'static str),
    /// A script of the anchors.
    Script(&'static str),
}

/// What is asked of a row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Goal {
    /// Nothing: the row is there to be known.
    None,
    /// Our time is at most this many times theirs.
    AtMost(f64),
    /// Our time is at least this many times shorter.
    Faster(f64),
    /// Our figure itself is at most this.
    Ours(f64),
}

/// One row of the comparison.
#[derive(Debug, Clone, Copy)]
pub(super) struct Row {
    /// What `--only` calls it.
    pub(super) name: &'static str,
    pub(super) group: &'static str,
    /// What is measured, beside what.
    pub(super) what: &'static str,
    pub(super) ours: Option<Program>,
    pub(super) theirs: Option<Program>,
    pub(super) goal: Goal,
    /// Most rounds: rows that take minutes take fewer.
    pub(super) rounds: u32,
}

const LIMITS: &str = "Limits of one core";
const KERNELS: &str = "Kernels";
const EXPERIMENT: &str = "The paper's experiment";
const WEAK: &str = "Weak form: 13 signals, 104 columns, windows of 49 rows every 12, Gram matrix";
const FIT: &str = "Output-error fit: 6 constants, 4 recordings of 30 s, free run at 1 ms";
const READING: &str = "Reading";

/// As many rounds as were asked for.
const ANY: u32 = u32::MAX;
/// Rounds of a program that takes a minute.
const FEW: u32 = 2;

const fn example(package: &'static str, name: &'static str, args: &'static [&'static str]) -> Program {
    Program { of: Of::Example { package, name }, args, place: Place::First }
}

const fn kernel(args: &'static [&'static str]) -> Program {
    example("measuring", "kernels", args)
}

const fn anchor(name: &'static str, args: &'static [&'static str]) -> Program {
    Program { of: Of::Anchor(name), args, place: Place::First }
}

const fn script(name: &'static str, args: &'static [&'static str]) -> Program {
    Program { of: Of::Script(name), args, place: Place::First }
}

const fn row(group: &'static str, name: &'static str, what: &'static str) -> Row {
    Row { name, group, what, ours: None, theirs: None, goal: Goal::None, rounds: ANY }
}

impl Row {
    const fn ours(mut self, program: Program) -> Self {
        self.ours = Some(program);
        self
    }

    const fn theirs(mut self, program: Program) -> Self {
        self.theirs = Some(program);
        self
    }

    const fn goal(mut self, goal: Goal) -> Self {
        self.goal = goal;
        self
    }

    const fn few(mut self) -> Self {
        self.rounds = FEW;
        self
    }
}

const WEAK_FORM: Program = example("weak-form", "kernel", &["--rows", "12000"]);
const FITTED: Program = example("torque-driven", "output_error", &["fit"]);
/// `stiff` prints all schemes in one line.
const STIFF: Program = Program { of: Of::Anchor("stiff"), args: &["0.02"], place: Place::Behind("ROS2x1") };

/// All rows, in the order of the tables.
pub(super) const ROWS: &[Row] = &[
    row(LIMITS, "peak-fma", "multiply-add, AVX2").theirs(anchor("peak", &["fma"])),
    row(LIMITS, "peak-fma-512", "multiply-add, AVX-512").theirs(anchor("peak512", &["fma"])),
    row(LIMITS, "peak-sqrtdiv", "division and root, four lanes").theirs(anchor("peak", &["sqrtdiv"])),
    row(LIMITS, "peak-read", "reading memory").theirs(anchor("peak", &["read"])),
    row(KERNELS, "ident-scalar", "identifier step, one robot; C scalar")
        .ours(kernel(&["ident", "scalar"]))
        .theirs(anchor("ident", &["scalar"]))
        .goal(Goal::AtMost(1.2)),
    row(KERNELS, "ident-lanes", "identifier step, robots in lanes; C, AVX2")
        .ours(kernel(&["ident", "lanes"]))
        .theirs(anchor("ident", &["batch"])),
    row(KERNELS, "ident-lanes-512", "identifier step, robots in lanes; C, AVX-512")
        .ours(kernel(&["ident", "lanes"]))
        .theirs(anchor("ident512", &["batch"])),
    row(KERNELS, "plant-scalar", "step of the paper's plant, RK4 of 1 ms, one robot; C scalar")
        .ours(kernel(&["plant", "scalar"]))
        .theirs(anchor("plant", &["scalar"]))
        .goal(Goal::AtMost(1.15)),
    row(KERNELS, "plant-lanes", "step of the paper's plant, robots in lanes; C, AVX2")
        .ours(kernel(&["plant", "lanes"]))
        .theirs(anchor("plant", &["batch"]))
        .goal(Goal::AtMost(1.6)),
    row(KERNELS, "plant-lanes-512", "step of the paper's plant, robots in lanes; C, AVX-512")
        .ours(kernel(&["plant", "lanes"]))
        .theirs(anchor("plant512", &["batch"])),
    row(KERNELS, "implicit-scalar", "linearly implicit step of 1 ms, one robot; C")
        .ours(kernel(&["implicit", "scalar"]))
        .theirs(STIFF),
    row(KERNELS, "implicit-lanes", "linearly implicit step of 1 ms, robots in lanes; C, one robot")
        .ours(kernel(&["implicit", "lanes"]))
        .theirs(STIFF),
    row(KERNELS, "controller-scalar", "tracking law, one robot").ours(kernel(&["controller", "scalar"])),
    row(KERNELS, "controller-lanes", "tracking law, robots in lanes").ours(kernel(&["controller", "lanes"])),
    row(KERNELS, "catalogue-scalar", "step of the catalogue's plant, one robot; the C plant of the paper, scalar")
        .ours(example("measuring", "plant", &["scalar"]))
        .theirs(anchor("plant", &["scalar"])),
    row(KERNELS, "catalogue-lanes", "step of the catalogue's plant, robots in lanes; the C plant of the paper, AVX2")
        .ours(example("measuring", "plant", &["lanes"]))
        .theirs(anchor("plant", &["batch"])),
    row(KERNELS, "catalogue-mujoco", "step of the catalogue's plant, one robot; MuJoCo's step of a lean model")
        .ours(example("measuring", "plant", &["scalar"]))
        .theirs(script("mujoco_steps.py", &["lean", "1"])),
    row(EXPERIMENT, "seedloop-1", "32 000 steps, plant once per ms; C")
        .ours(kernel(&["seedloop", "1"]))
        .theirs(anchor("seedloop", &["1"]))
        .goal(Goal::AtMost(1.2)),
    row(EXPERIMENT, "seedloop-20", "32 000 steps, plant 20 times per ms; C")
        .ours(kernel(&["seedloop", "20"]))
        .theirs(anchor("seedloop", &["20"]))
        .goal(Goal::AtMost(1.2)),
    row(EXPERIMENT, "seedloop-numba", "32 000 steps, plant once per ms; numba")
        .ours(kernel(&["seedloop", "1"]))
        .theirs(script("seedloop_py.py", &["numba"])),
    row(EXPERIMENT, "ensemble", "1000 draws of the reproduction, in lanes, s")
        .ours(kernel(&["ensemble", "1000"]))
        .goal(Goal::Ours(5.0)),
    row(WEAK, "weak", "12 000 rows; C, fused")
        .ours(WEAK_FORM)
        .theirs(anchor("weakform", &["12000"]))
        .goal(Goal::AtMost(2.2)),
    row(WEAK, "weak-long", "3 600 000 rows; C, fused")
        .ours(example("weak-form", "kernel", &["--rows", "3600000"]))
        .theirs(anchor("weakform", &["3600000"]))
        .goal(Goal::AtMost(2.2)),
    row(WEAK, "weak-numpy", "12 000 rows; NumPy and SciPy, columns stored")
        .ours(WEAK_FORM)
        .theirs(script("weakform_py.py", &["numpy", "12000"])),
    row(WEAK, "weak-pysindy", "12 000 rows; PySINDy's WeakPDELibrary, and Gram matrix")
        .ours(WEAK_FORM)
        .theirs(script("weakform_py.py", &["pysindy_weak", "12000"]))
        .goal(Goal::Faster(200.0)),
    row(WEAK, "weak-pysindy-fit", "12 000 rows; PySINDy's SINDy.fit, which does more")
        .ours(WEAK_FORM)
        .theirs(script("weakform_py.py", &["pysindy_fit", "12000"]))
        .few(),
    row(FIT, "fit-c", "whole fit; C, shifted robots in lanes")
        .ours(FITTED)
        .theirs(anchor("fit", &["lanes"]))
        .goal(Goal::AtMost(2.0)),
    row(FIT, "fit-scipy", "whole fit; SciPy's Levenberg-Marquardt over a numba plant")
        .ours(FITTED)
        .theirs(script("fit_py.py", &["lm"]))
        .goal(Goal::Faster(2.5)),
    row(FIT, "fit-scipy-trf", "whole fit; SciPy's trust region with bounds over a numba plant")
        .ours(FITTED)
        .theirs(script("fit_py.py", &["trf"])),
    row(FIT, "fit-mujoco", "whole fit; MuJoCo's own toolbox on its lean model, segments of 2 s from exact starts")
        .ours(FITTED)
        .theirs(script("fit_mujoco.py", &["lean", "scipy", "25", "15", "1e-2"]))
        .goal(Goal::Faster(60.0))
        .few(),
    row(FIT, "jacobian", "one Jacobian in lanes over one scalar run")
        .ours(example("torque-driven", "output_error", &["jacobian"]))
        .goal(Goal::Ours(2.5)),
    row(READING, "csv", "CSV of 15 columns to a checked recording in SI; C, digits only")
        .ours(example("recordings", "read_csv", &[]))
        .theirs(anchor("parse", &["csv"])),
];

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn every_row_has_a_name_of_its_own_and_what_its_goal_needs() {
        let names: BTreeSet<&str> = ROWS.iter().map(|r| r.name).collect();
        assert_eq!(names.len(), ROWS.len());
        for row in ROWS {
            let needs_both = matches!(row.goal, Goal::AtMost(_) | Goal::Faster(_));
            assert!(row.ours.is_some() || row.theirs.is_some(), "{}", row.name);
            assert!(!needs_both || (row.ours.is_some() && row.theirs.is_some()), "{}", row.name);
            assert!(!matches!(row.goal, Goal::Ours(_)) || row.ours.is_some(), "{}", row.name);
            assert!(row.ours.is_none_or(|p| matches!(p.of, Of::Example { .. })), "{}", row.name);
            assert!(row.theirs.is_none_or(|p| !matches!(p.of, Of::Example { .. })), "{}", row.name);
        }
    }
}
