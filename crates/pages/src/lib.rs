//! Pages that are one file and open offline, with charts and tables; tables of plain text for a terminal.

pub mod chart;
pub mod escape;
pub mod figure;
pub mod page;
pub mod reproduction;
mod role;
mod shell;
mod table;
pub mod text_table;
pub mod thin;
