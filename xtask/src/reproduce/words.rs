//! The sentences around the tables.

use super::{FULL, Outcome};
use crate::document::fewer_draws;

/// One line on robots, draws and seed.
pub(super) fn setting(o: &Outcome) -> String {
    let r = &o.recipe;
    format!(
        "{} draws of the first layer, seed {}; {} samples of {} s, {} Runge-Kutta steps each; largest path error {:.3} m, \
         smallest wheel load {:.1} N (set B).",
        o.args.draws, o.args.seed, r.samples, r.step, r.substeps, o.run.largest_path_error, o.run.smallest_load
    )
}

/// Whether it is reproduced, in a sentence or two.
pub(super) fn verdict(o: &Outcome) -> String {
    let missed = o.judged().missed().count();
    let text = if missed == 0 {
        "Reproduced in kind: set B meets every rule of the tolerance.".to_owned()
    } else {
        format!("Not reproduced: set B misses {missed} conditions of the tolerance.")
    };
    text + &fewer_draws(FULL, o.args.draws)
}

/// What can be reproduced and what cannot.
pub(super) fn introduction(o: &Outcome) -> Vec<String> {
    let b = o.judged();
    let [max3, max4, rmse3, rmse4] = std::array::from_fn(|i| b.table.get(i).map_or(f64::NAN, |d| d.percentile));
    let constant = b.constant.table1();
    let median = |i: usize| b.table.get(i).map_or(f64::NAN, |d| d.quantiles[2]);
    vec![
        verdict(o),
        format!(
            "Reproduced: the five disturbances at their times, their order and shape, and the size of the four indices \
             within a factor of two. The paper's values lie at the percentiles {max3:.1}, {max4:.1}, {rmse3:.1} and {rmse4:.1} \
             of our draws."
        ),
        "Not reproducible by anybody: the digits of Table 1 and the curves of Figures 5 to 7. The paper gives neither its \
         robot nor the path, the speed profile, the controller's gains, the first layer, the solver or the time step; each of \
         the first five moves the indices by a fifth or more, as the sets, the distributions and the table of variations show."
            .to_owned(),
        format!(
            "Not shown by the paper: that anything is learned. Without a network, with a constant regressor, the RMSE are \
             {:.4} and {:.4} rad/s, against {:.4} and {:.4} with one (medians): Table 1 cannot tell learning from integral \
             action. What keeps what it learns is in learning.md, what is wrong in the paper in errata.md, where each \
             equation lives in equations.md.",
            constant[2],
            constant[3],
            median(2),
            median(3)
        ),
        o.recipe.disclosure.trim().to_owned(),
        setting(o),
    ]
}
