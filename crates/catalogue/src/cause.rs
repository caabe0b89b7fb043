//! The specification of a cause that has no law in a plant.

/// What is known about a cause that has no law in a plant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CauseSpec {
    /// Identifier in verdicts.
    pub id: &'static str,
    /// Name for people.
    pub name: &'static str,
    /// For which robots it is named.
    pub robots: &'static str,
    /// What it means.
    pub meaning: &'static str,
    /// What its size in a verdict is; empty where it has none.
    pub size: &'static str,
    /// SI unit of its size, "-" if none.
    pub unit: &'static str,
    /// By what a diagnosis recognises it.
    pub recognised: &'static str,
    /// The drive that reveals it best; empty where no drive does.
    pub revealed_by: &'static str,
    /// What looks alike, and when.
    pub resembles: &'static str,
}
