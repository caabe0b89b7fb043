//! The kernels whose instructions are counted: the whole table.

/// A kernel: an example, and the option that says how often its step is done.
#[derive(Debug, Clone, Copy)]
pub(super) struct Kernel {
    pub(super) name: &'static str,
    pub(super) package: &'static str,
    pub(super) example: &'static str,
    pub(super) args: &'static [&'static str],
    pub(super) option: &'static str,
    /// The option's values in the short run and in the long one.
    pub(super) lengths: [u32; 2],
    /// Steps in one unit of the option.
    pub(super) steps: u32,
}

const fn kernel(name: &'static str, args: &'static [&'static str]) -> Kernel {
    let lengths = [1_000, 5_000];
    Kernel { name, package: "measuring", example: "kernels", args, option: "--steps", lengths, steps: 1 }
}

const fn catalogue(name: &'static str, args: &'static [&'static str]) -> Kernel {
    Kernel { example: "plant", ..kernel(name, args) }
}

/// Rows of the weak form in one round.
const ROWS: u32 = 12_000;

/// All kernels.
pub(super) const KERNELS: &[Kernel] = &[
    kernel("plant.scalar", &["plant", "scalar"]),
    kernel("plant.lanes", &["plant", "lanes"]),
    kernel("ident.scalar", &["ident", "scalar"]),
    kernel("ident.lanes", &["ident", "lanes"]),
    kernel("controller.scalar", &["controller", "scalar"]),
    kernel("controller.lanes", &["controller", "lanes"]),
    kernel("implicit.scalar", &["implicit", "scalar"]),
    kernel("implicit.lanes", &["implicit", "lanes"]),
    catalogue("catalogue.scalar", &["scalar", "--rounds", "1"]),
    catalogue("catalogue.lanes", &["lanes", "--rounds", "1"]),
    // Its signals are made before: by rounds, not by rows, only the weak form itself is counted.
    Kernel {
        package: "weak-form",
        example: "kernel",
        option: "--rounds",
        lengths: [1, 3],
        steps: ROWS,
        ..kernel("weakform", &["--rows", "12000"])
    },
];
