//! The paper's experiment with twenty random first layers: medians against Table 1.

use sim::{Experiment, Recipe, RobotSet, table1};

fn main() -> Result<(), sim::SimError> {
    let experiment = Experiment::new(&Recipe::default(), RobotSet::B)?;
    println!("largest path error {:.3} m", experiment.trajectory().largest_path_error);
    let draws = experiment.ensemble(1, 20, || {})?;
    for d in table1::distributions(&draws) {
        println!("{:6} median {:.4} rad/s, paper {:.4} rad/s", d.name, d.quantiles[2], d.paper);
    }
    let constant = experiment.constant_regressor()?;
    println!("without a network: {:.4?} rad/s", constant.table1());
    Ok(())
}
