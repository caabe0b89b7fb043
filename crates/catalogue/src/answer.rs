//! The answers that name no cause: every verdict weighs them against the causes.

use crate::CauseSpec;

/// The simulation lacks nothing that the recordings show.
pub const NONE: CauseSpec = CauseSpec {
    id: "none",
    name: "nothing is missing",
    robots: "all",
    meaning: "The simulation, its constants re-tuned within what is known of them, explains the recordings.",
    size: "",
    unit: "-",
    recognised: "What re-tuning leaves is no larger than what reference drives leave anyway, so that no effect is worth \
        its additional numbers.",
    revealed_by: "",
    resembles: "every effect that the drives hardly excite: `lacuna next` proposes a drive that would show it",
};

/// The recordings differ from the simulation, and nothing in the catalogue explains how.
pub const UNKNOWN: CauseSpec = CauseSpec {
    id: "unknown",
    name: "something that is not in the catalogue",
    robots: "all",
    meaning: "The recordings differ from the simulation, and no effect of the catalogue, alone or in a pair, explains how.",
    size: "",
    unit: "-",
    recognised: "What the best effects leave is larger than what reference drives leave anyway. Of command-driven robots \
        it is listed with probability 0: their elements are descriptions, and what none describes stays in the forecast \
        errors.",
    revealed_by: "",
    resembles: "an effect whose law differs somewhat from that of the catalogue; two or more effects at once",
};

/// All of them.
pub const ALL: [&CauseSpec; 2] = [&NONE, &UNKNOWN];
