//! Every tuned number of this crate, stage by stage.

use ::settings::Setting;

pub(crate) mod decision;
pub(crate) mod fit;
pub(crate) mod law;
pub(crate) mod locate;
pub(crate) mod next;
pub(crate) mod output_error;
pub(crate) mod preparation;
pub(crate) mod redundancy;
pub(crate) mod search;

/// Stage by stage, in the order in which a diagnosis meets them.
const STAGES: [&[Setting]; 9] = [
    preparation::Settings::ALL,
    redundancy::Settings::ALL,
    fit::Settings::ALL,
    search::Settings::ALL,
    decision::Settings::ALL,
    law::Settings::ALL,
    locate::Settings::ALL,
    next::Settings::ALL,
    output_error::Settings::ALL,
];

/// A row for each number of all stages.
pub(crate) fn all() -> impl Iterator<Item = &'static Setting> {
    STAGES.into_iter().flatten()
}
