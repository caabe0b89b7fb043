//! One YAML file: controller, its manager and a filter.

use std::collections::BTreeMap;

use serde::Serialize;
use serde_yaml_ng::{Mapping, Value, to_value};

use crate::number::number;
use crate::ros2::covariance::Scatter;
use crate::ros2::geometry::Geometry;
use crate::ros2::parameters::{Filter, Parameters};

/// What a file of controller parameters is written from.
#[derive(Debug, Clone, PartialEq)]
pub struct Controllers {
    /// Name of the robot.
    pub robot: String,
    /// Its wheels.
    pub geometry: Geometry,
    /// Errors of forecasts from wheels alone; `None` leaves covariances out.
    pub scatter: Option<Scatter>,
    /// What is right only under a condition, one sentence each: becomes comments.
    pub told: Vec<String>,
    /// What the controller cannot hold, one sentence each: becomes comments, and should be a warning too.
    pub not_held: Vec<String>,
}

/// Why parameters could not be written.
#[derive(Debug, thiserror::Error)]
#[error("the parameters could not be written as YAML: {0}")]
pub struct NoYaml(#[from] serde_yaml_ng::Error);

#[derive(Serialize)]
struct Node<T> {
    #[serde(rename = "ros__parameters")]
    parameters: T,
}

impl Controllers {
    /// The file's text: YAML with comments on top. Lengths in m, angles in rad.
    ///
    /// # Errors
    /// Values that YAML cannot hold.
    pub fn yaml(&self) -> Result<String, NoYaml> {
        let geometry = &self.geometry;
        let controller = geometry.controller();
        let plugin = BTreeMap::from([(controller, BTreeMap::from([("type", geometry.plugin())]))]);
        let parameters = Parameters::new(geometry, self.scatter.as_ref());

        let mut file = Mapping::new();
        let mut add = |name: &str, node: Value| file.insert(name.into(), node);
        add("controller_manager", to_value(Node { parameters: plugin })?);
        add(controller, to_value(Node { parameters })?);
        add("ekf_filter_node", to_value(Node { parameters: Filter::new(geometry) })?);

        let comments = self.comments().into_iter().map(|line| format!("# {}\n", line.replace(['\n', '\r'], " ")));
        Ok(comments.collect::<String>() + &serde_yaml_ng::to_string(&file)?)
    }

    fn comments(&self) -> Vec<String> {
        let controller = self.geometry.controller();
        let mut out = vec![
            format!(
                "Robot '{}' for {controller} of ros2_controllers 4.x (ROS 2 Jazzy); lengths in m, angles in rad.",
                self.robot
            ),
            "It names what is known of the robot; limits, frames and rates are yours, or the controller's defaults."
                .to_owned(),
        ];
        let corrected = self.geometry.lengths().into_iter().filter(|(_, length)| length.is_corrected());
        out.extend(corrected.map(|(parameter, length)| {
            format!("{parameter}: re-tuned by lacuna from {} to {} m.", number(length.stated), number(length.corrected))
        }));
        if matches!(self.geometry, Geometry::Differential { .. }) {
            out.push("wheel_separation and wheel_radius are as stated; corrections are in the multipliers.".to_owned());
        }
        if matches!(self.geometry, Geometry::Tricycle { .. } | Geometry::Bicycle { .. }) {
            out.push(
                "Releases that know traction_joints_names and steering_joints_names want these in place of \
                 rear_wheels_names and front_wheels_names."
                    .to_owned(),
            );
        }
        match &self.scatter {
            Some(scatter) => out.extend(scatter.told()),
            None => out.push(
                "Covariances are left out, for nothing here says how far poses from wheels alone err: set them before \
                 a filter reads this odometry."
                    .to_owned(),
            ),
        }
        out.extend(self.told.iter().cloned());
        if !self.not_held.is_empty() {
            out.push(format!("Not held by {controller}:"));
            out.extend(self.not_held.iter().map(|note| format!("- {note}")));
        }
        out
    }
}
