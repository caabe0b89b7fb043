//! Drives a straight and a circle, without and with a dragging brake, and prints pose and wheel speeds.

use robot_model::paper::Parameters;
use robot_model::{Active, Plant, Presence, Robot, State, effects};

fn main() -> Result<(), robot_model::ModelError> {
    let robot = Robot::<f64>::from(&Parameters::SET_B).checked()?;
    println!("as modelled");
    drive(&robot, &[]);
    println!("with a brake that drags with 0.5 N m on the left");
    let left = Presence { side: Some(0), ..Presence::default() };
    drive(&robot, &[Active::new(&effects::coulomb_side::Law, &[0.5], left)]);
    Ok(())
}

/// Two seconds straight, then a left turn; each wheel side holds its speed by feedback of 20 N m s/rad.
fn drive(robot: &Robot<f64>, active: &[Active<f64>]) {
    let plant = Plant::new(robot, active, 1e-3);
    let mut state = State::<f64>::default();
    println!("  time    x       y       yaw     left    right   torques");
    println!("  s       m       m       rad     rad/s   rad/s   N m");
    for k in 0..8000 {
        let wanted = if k < 2000 { [5.0, 5.0] } else { [3.0, 7.0] };
        let torque = [0, 1].map(|j: usize| (20.0 * (wanted[j] - state.wheel_speed[j])).clamp(-30.0, 30.0));
        plant.step(&mut state, torque);
        if (k + 1) % 1000 == 0 {
            let ([x, y], [c, s], [left, right]) = (state.position, state.heading, state.wheel_speed);
            let yaw = s.atan2(c);
            let [tl, tr] = torque;
            println!("{:6.2}{x:8.3}{y:8.3}{yaw:8.3}{left:8.3}{right:8.3}{tl:8.2}{tr:7.2}", state.time);
        }
    }
}
