//! Drives the paper's robot around the loop and prints how well it keeps the path.

use controller::{Gains, Loop, LoopPath, PathReference, Tracking, WheelState};
use nn_basis::Constant;
use robot_model::paper::{PaperRobot, Parameters, State};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let robot = PaperRobot::<f64>::new(&Parameters::SET_B)?;
    let path = LoopPath::new(&Loop::default())?;
    let gains = Gains::for_robot(robot.parameters(), 100.0);
    let mut controller = Tracking::<f64, _, 8>::new(&gains, Constant::new([0.5; 8])?, PathReference::new(path))?;
    let (mut state, mut worst) = (State::default(), 0.0_f64);
    for k in 0..32_000 {
        let seen = WheelState { x: state.x, y: state.y, yaw: state.yaw, angle: state.angle, speed: state.speed };
        let action = controller.step(&seen, 1e-3);
        worst = worst.max((action.reference.x - state.x).hypot(action.reference.y - state.y));
        if k % 4000 == 0 {
            println!(
                "t {:4.1} s: ({:6.3}, {:6.3}) m, torques {:.2?} N m",
                f64::from(k) * 1e-3,
                state.x,
                state.y,
                action.torque
            );
        }
        // Slip is stiff: many short steps, see the crate `sim` for a better integrator.
        for _ in 0..50 {
            let (s, r) = (state.to_array(), robot.rate(&state, action.torque).to_array());
            state = State::from_array(std::array::from_fn(|i| s[i] + 2e-5 * r[i]));
        }
    }
    println!("largest distance from the reference: {worst:.3} m");
    Ok(())
}
