//! Drives that would tell the remaining answers apart, each as the car of the answer would drive it.

use hierarchical_fit::menu::{Reach, menu};
use hierarchical_fit::{Kind, Solved};
use verdict::{Advice, Manoeuvre};

use crate::drive::{Columns, Drive};
use crate::model::{Laws, STEP, State};
use crate::rows::Shown;
use crate::settings::{NextDrive, SETTINGS};

const RULES: NextDrive = SETTINGS.next_drive;
/// A car that stands at the origin.
const REST: State = State { place: [0.0; 2], yaw: 0.0, speed: 0.0, side: 0.0, rate: 0.0 };

/// What was measured of a car.
#[derive(Debug, Clone, Copy)]
struct Measured {
    pose: bool,
    gyro: bool,
    encoder: bool,
}

/// Advises on the next drive of so many seconds; `encoder_window` as the car has it, s.
pub(crate) fn advise(solved: &Solved<Shown<'_>>, encoder_window: f64, length: f64) -> Advice {
    let laws = Laws::at(&solved.data.model, &solved.fit.theta);
    let made: Vec<&Shown<'_>> = solved.data.drives.iter().collect();
    let did: Vec<[f64; 2]> = made.iter().flat_map(|shown| twists(&laws, shown)).collect();
    let Some(reach) = Reach::of(&did, false) else {
        return Advice::withheld(
            "the car hardly moved in these drives, so that nobody knows how fast it can be driven",
        );
    };

    // However slowly it was seen to turn: a car does not do so on the spot.
    let reach = Reach { spins: false, ..reach };
    let any = |of: &dyn Fn(&Drive) -> bool| made.iter().any(|shown| of(shown.drive));
    let measured = Measured {
        pose: any(&Drive::has_pose),
        gyro: any(&|d| d.messages.iter().any(|m| m.gyro.is_some())),
        encoder: any(&|d| d.messages.iter().any(|m| m.encoder.is_some())),
    };
    let driven = |manoeuvre: Manoeuvre| {
        let commands = commands(&laws, &manoeuvre);
        let table = recorded(&laws, commands, measured)?;
        Drive::new(&manoeuvre.name, &table).ok().map(|drive| (manoeuvre, drive))
    };
    let drives: Vec<(Manoeuvre, Drive)> = menu(reach, length).into_iter().filter_map(driven).collect();
    let shown =
        drives.iter().map(|(manoeuvre, drive)| (manoeuvre.clone(), Shown::new(drive, encoder_window))).collect();
    solved.advise(shown, read)
}

/// What readings of a kind are, with their unit.
pub(crate) fn read(kind: Kind) -> (String, &'static str) {
    let (seconds, lever) = (SETTINGS.windows.length, SETTINGS.windows.lever);
    match kind {
        Kind::Pose => (format!("the place (or the heading, at a lever of {lever} m) {seconds} s ahead"), "m"),
        Kind::Gyro => ("the yaw rate".to_owned(), "rad/s"),
        Kind::Encoder => ("the speed by the encoder".to_owned(), "m/s"),
    }
}

/// Speed and yaw rate at instants of a drive, by the pose where it was measured, else as encoder and gyro show them.
fn twists(laws: &Laws, shown: &Shown<'_>) -> Vec<[f64; 2]> {
    let drive = shown.drive;
    if drive.has_pose() {
        let of = |(pose, rates): (&[f64; 3], &[f64; 3])| {
            let s = laws.state(*pose, *rates);
            [s.speed, s.rate]
        };
        return drive.pose.iter().zip(shown.rates.iter()).map(of).collect();
    }
    let of = |m: &crate::drive::Message| {
        let rate = (m.gyro? - laws.gyro_bias) / laws.gyro_scale;
        Some([laws.speed_of_encoder(m.encoder?, rate), rate])
    };
    drive.messages.iter().filter_map(of).collect()
}

/// Throttle and steering commands by which a car without any lag would drive as wanted.
fn commands(laws: &Laws, m: &Manoeuvre) -> [Vec<f64>; 2] {
    let steps = (m.length() / STEP).round() as usize;
    let mut s = REST;
    let (mut throttle, mut steering) = (Vec::with_capacity(steps), Vec::with_capacity(steps));
    for k in 0..steps {
        let [wanted, turning] = m.wanted(STEP * k as f64);
        let angle = (laws.wheelbase * turning / wanted.abs().max(RULES.stands)).atan();
        let asked = ((angle - laws.centre) / laws.full).clamp(-1.0, 1.0);
        // Towards the speed within a time, beyond what the motor loses at it.
        let lost = laws.friction * wanted.signum() + (laws.viscous + laws.back_emf * RULES.usual_throttle) * wanted;
        let needed = if wanted == 0.0 { 0.0 } else { ((wanted - s.speed) / RULES.follows + lost) / laws.gain };
        let most = (1.0 - laws.dead_zone).max(0.0);
        let effort = needed.clamp(-most, most);
        let pushed = if effort == 0.0 { 0.0 } else { effort + laws.dead_zone * effort.signum() };
        throttle.push(pushed);
        steering.push(asked);
        laws.step(&mut s, laws.map(asked), effort);
    }
    [throttle, steering]
}

/// What would be recorded with these commands; `None` of commands that are no drive.
fn recorded(laws: &Laws, [throttle, steering]: [Vec<f64>; 2], measured: Measured) -> Option<Columns> {
    let time: Vec<f64> = (0..throttle.len()).map(|k| STEP * k as f64).collect();
    let commanded = Columns { time, throttle, steering, ..Columns::default() };
    let drive = Drive::held_out("next", &commanded).ok()?;
    let inputs = laws.inputs(&drive);
    let mut states = vec![REST];
    states.extend(laws.run(REST, &inputs, 0, inputs.steering.len()));
    states.resize(commanded.time.len(), *states.last()?);
    let column = |is: bool, of: &dyn Fn(&State) -> f64| if is { states.iter().map(of).collect() } else { Vec::new() };
    Some(Columns {
        pose: if measured.pose { states.iter().map(|s| laws.tracked(s)).collect() } else { Vec::new() },
        gyro: column(measured.gyro, &|s| laws.gyro_scale * s.rate + laws.gyro_bias),
        encoder: column(measured.encoder, &|s| laws.encoder(s.speed, s.rate)),
        ..commanded
    })
}
