//! Robots whose files name their columns, as a verdict corrects them: their robot file, and parameters of ROS 2
//! controllers.
//!
//! `edit`: numbers in TOML; `unheld`: what a target cannot hold; `wheels`, `car`, `any_wheels`: robot files; `wheels_ros2`,
//! `car_ros2`: controllers.

mod any_wheels;
mod car;
mod car_ros2;
#[cfg(test)]
mod tests;
mod unheld;
mod wheels;
mod wheels_ros2;

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{Context, Result, bail, ensure};
use model_export::Engine;
use verdict::{Diagnosis, Verdict};

use crate::columns::{ColumnsEnvelope, Kind};
use crate::edit::one_line;
use unheld::Unheld;

/// A robot of a robot file that names its columns, with the verdict that corrects it, if there is one.
#[derive(Debug, Clone)]
pub struct ColumnsRobot {
    /// What kind of robot it is.
    pub kind: Kind,
    /// What messages call its file.
    name: String,
    /// What the file says.
    text: String,
    /// What corrects it.
    diagnosis: Option<Diagnosis>,
    /// Whether it is wanted as stated all the same.
    is_nominal: bool,
}

/// A file that was written, and what it cannot hold.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Written {
    /// The file.
    pub text: String,
    /// What it cannot hold, one sentence each; the file says the same in comments.
    pub not_held: Vec<String>,
}

impl ColumnsRobot {
    /// The robot of a robot file; `None` where it is of another kind.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn of_file(file: &Path) -> Result<Option<Self>> {
        let name = file.display().to_string();
        let text = std::fs::read_to_string(file).with_context(|| format!("cannot read robot file '{name}'"))?;
        let Some(kind) = Kind::of_file(&text) else { return Ok(None) };
        Ok(Some(Self { kind, name, text, diagnosis: None, is_nominal: false }))
    }

    /// A robot that is built in; `None` where none of these kinds has that name.
    pub fn built_in(name: &str) -> Option<Self> {
        Kind::ALL.into_iter().find_map(|kind| {
            let (name, text) = kind.built_in().iter().find(|robot| robot.0 == name)?;
            Some(Self { kind, name: (*name).to_owned(), text: (*text).to_owned(), diagnosis: None, is_nominal: false })
        })
    }

    /// The robot of a verdict; `name` is what messages call the verdict's file.
    ///
    /// # Errors
    /// A verdict that does not hold the robot file.
    pub fn of_verdict(name: &str, envelope: ColumnsEnvelope) -> Result<Self> {
        let ColumnsEnvelope { kind, robot, robot_file, diagnosis, program, .. } = envelope;
        let text = robot_file.with_context(|| {
            format!(
                "'{name}' was written by {} {}, which did not keep the robot file in it: run `lacuna diagnose ... \
                 --json '{name}'` again on the same recordings",
                program.name, program.version
            )
        })?;
        Ok(Self { kind, name: robot, text, diagnosis: Some(diagnosis), is_nominal: false })
    }

    /// The same as its file states it.
    #[must_use]
    pub fn nominal(self) -> Self {
        Self { is_nominal: true, ..self }
    }

    /// The verdict that corrects it, unless it is wanted as stated.
    pub fn correction(&self) -> Option<&Diagnosis> {
        let corrects = |d: &&Diagnosis| !self.is_nominal && d.verdict != Verdict::Withheld;
        self.diagnosis.as_ref().filter(corrects)
    }

    /// What the verdict that corrects it says first.
    fn headline(&self) -> Option<String> {
        self.correction().and_then(|d| d.sentences.first()).map(|sentence| format!("The verdict: {sentence}"))
    }

    /// The values that correct its constants, by their names.
    fn tuning(&self) -> BTreeMap<String, f64> {
        self.correction().map(|d| d.tuning.clone()).unwrap_or_default()
    }

    /// Its robot file: the owner's, with the corrected numbers in it and what it cannot hold in comments on top.
    ///
    /// # Errors
    /// A robot file that is none, or that no such robot can have once it is corrected.
    pub fn robot_file(&self) -> Result<Written> {
        if self.correction().is_none() {
            return Ok(Written { text: self.text.clone(), not_held: Vec::new() });
        }
        let (edited, unheld) = self.edited()?;
        let holder = format!("a robot file of kind {}", self.kind.name());
        let not_held: Vec<String> = unheld.iter().map(|u| u.sentence(&holder)).collect();

        let mut text =
            format!("# Corrected by lacuna {}: see the sources of its numbers.\n", env!("CARGO_PKG_VERSION"));
        text.extend(self.headline().map(|sentence| format!("# {}\n", one_line(&sentence))));
        text.extend(not_held.iter().map(|sentence| format!("# {}\n", one_line(sentence))));
        Ok(Written { text: text + "\n" + &edited, not_held })
    }

    /// The owner's robot file with the corrected numbers in it, and what has no key there.
    fn edited(&self) -> Result<(String, Vec<Unheld>)> {
        let Some(diagnosis) = self.correction() else { return Ok((self.text.clone(), Vec::new())) };
        match self.kind {
            Kind::Odometry => wheels::robot_file(&self.name, &self.text, diagnosis),
            Kind::Car => car::robot_file(&self.name, &self.text, diagnosis),
            Kind::Wheeled => any_wheels::robot_file(&self.name, &self.text, diagnosis),
        }
    }

    /// Its model for a simulator, of robots with masses and forces.
    ///
    /// # Errors
    /// A robot of a kind without masses, a robot file that is none, and what the engine cannot have at all.
    pub fn model(&self, engine: Engine) -> Result<Written> {
        ensure!(
            self.kind == Kind::Wheeled,
            "robots of kind {} have no masses and forces that a model of MuJoCo, ROS or Gazebo is made of; export it with --to toml, \
             or with --to ros2 for parameters of its controller",
            self.kind.name()
        );
        any_wheels::model(self, engine)
    }

    /// Parameters of the ROS 2 controller that its wheels ask for.
    ///
    /// # Errors
    /// A robot file that is none, and wheels that no controller of ros2_controllers has.
    pub fn controllers(&self) -> Result<Written> {
        let mut controllers = match self.kind {
            Kind::Odometry => wheels_ros2::controllers(self)?,
            Kind::Car => car_ros2::controllers(self)?,
            Kind::Wheeled => bail!(
                "robot '{}' is driven by torques, and the controllers of ros2_controllers that have wheels command speeds: write its \
                 corrected robot file instead, with --to toml",
                self.name
            ),
        };
        controllers.told.splice(0..0, self.headline());
        Ok(Written { text: controllers.yaml()?, not_held: controllers.not_held })
    }
}
