//! The text of a model as XML, with errors that say where.

use std::str::FromStr;

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use roxmltree::{Document, Node};

use crate::error::ImportError;

/// Position and rotation of one frame in another.
pub(crate) type Place = Isometry3<f64>;

/// Depth and number of elements beyond which a file is no robot's: arms of a hundred links nest a few hundred deep.
const DEEPEST: usize = 1000;
const MOST_ELEMENTS: usize = 100_000;

/// What to do about macros.
pub(crate) const UNEXPANDED: &str =
    "which xacro has to expand first: run `xacro robot.urdf.xacro > robot.urdf` and give that file";

/// A file that is read: its name and its text.
pub(crate) struct Source<'a> {
    /// Name in messages.
    pub(crate) file: &'a str,
    /// The whole document.
    pub(crate) document: &'a Document<'a>,
}

impl Source<'_> {
    /// Refuses what is nested or numerous beyond any robot, before anything follows it down.
    pub(crate) fn ensure_sound(&self) -> Result<(), ImportError> {
        let mut depth: Vec<usize> = Vec::new();
        let mut elements = 0;
        for node in self.document.root().descendants() {
            let above = node.parent().map_or(0, |p| depth[p.id().get_usize()]);
            depth.push(above + 1);
            elements += usize::from(node.is_element());
            if above > DEEPEST {
                return Err(
                    self.wrong(node, format!("elements are nested more than {DEEPEST} deep; no robot is; correct it"))
                );
            }
        }
        if elements > MOST_ELEMENTS {
            return Err(self.whole(format!(
                "{elements} elements are more than the {MOST_ELEMENTS} that are read; leave out what is not the robot"
            )));
        }
        Ok(())
    }

    /// An error at an element.
    pub(crate) fn wrong(&self, at: Node<'_, '_>, what: impl Into<String>) -> ImportError {
        let line = self.document.text_pos_at(at.range().start).row;
        ImportError::At { file: self.file.to_owned(), line, what: what.into() }
    }

    /// An error of the whole model.
    pub(crate) fn whole(&self, what: impl Into<String>) -> ImportError {
        ImportError::Whole { file: self.file.to_owned(), what: what.into() }
    }

    /// An attribute that has to be there.
    pub(crate) fn needed<'n>(&self, node: Node<'n, '_>, name: &str) -> Result<&'n str, ImportError> {
        let missing = || self.wrong(node, format!("<{}> has no {name}; add it", node.tag_name().name()));
        node.attribute(name).ok_or_else(missing)
    }

    /// A number of an attribute; `None` where it is not there.
    pub(crate) fn number(&self, node: Node<'_, '_>, name: &str) -> Result<Option<f64>, ImportError> {
        node.attribute(name).map(|text| self.parsed(node, name, text)).transpose()
    }

    /// As many numbers of an attribute as are asked for; `None` where it is not there.
    pub(crate) fn numbers<const N: usize>(
        &self,
        node: Node<'_, '_>,
        name: &str,
    ) -> Result<Option<[f64; N]>, ImportError> {
        node.attribute(name).map(|text| self.array(node, name, text)).transpose()
    }

    /// Numbers in a text.
    pub(crate) fn array<const N: usize>(
        &self,
        node: Node<'_, '_>,
        name: &str,
        text: &str,
    ) -> Result<[f64; N], ImportError> {
        let list = self.list(node, name, text)?;
        let found = list.len();
        <[f64; N]>::try_from(list)
            .map_err(|_| self.wrong(node, format!("{name} holds {found} numbers, but {N} belong there; correct it")))
    }

    /// All numbers in a text.
    pub(crate) fn list(&self, node: Node<'_, '_>, name: &str, text: &str) -> Result<Vec<f64>, ImportError> {
        text.split_whitespace().map(|word| self.parsed(node, name, word)).collect()
    }

    /// Refuses a mass below zero.
    pub(crate) fn ensure_mass(&self, at: Node<'_, '_>, mass: f64) -> Result<(), ImportError> {
        if mass < 0.0 {
            return Err(self.wrong(at, format!("a mass is {mass} kg; write zero or more")));
        }
        Ok(())
    }

    /// A finite number.
    pub(crate) fn parsed(&self, node: Node<'_, '_>, name: &str, text: &str) -> Result<f64, ImportError> {
        if text.contains("$(") || text.contains("${") {
            return Err(self.wrong(node, format!("{name} holds '{text}', {UNEXPANDED}")));
        }
        // Simulators write "inf" for what has no limit, and for nothing else.
        let may_be_infinite = ["lower", "upper", "effort", "range", "ctrlrange", "forcerange"].contains(&name);
        let value = f64::from_str(text.trim()).ok();
        let value = value.filter(|x| x.is_finite() || (may_be_infinite && !x.is_nan()));
        value.ok_or_else(|| self.wrong(node, format!("{name} is '{}', which is no number; correct it", text.trim())))
    }
}

/// First child element of a name.
pub(crate) fn child<'a, 'i>(node: Node<'a, 'i>, name: &str) -> Option<Node<'a, 'i>> {
    node.children().find(|n| n.has_tag_name(name))
}

/// Child elements of a name.
pub(crate) fn children<'a, 'i: 'a>(
    node: Node<'a, 'i>,
    name: &'static str,
) -> impl Iterator<Item = Node<'a, 'i>> + use<'a, 'i> {
    node.children().filter(move |n| n.has_tag_name(name))
}

/// A frame by its origin, m, and its angles about the fixed axes x, y and z, in that order, rad: `R = Rz Ry Rx`.
pub(crate) fn place([x, y, z]: [f64; 3], [roll, pitch, yaw]: [f64; 3]) -> Place {
    Place::from_parts(Translation3::new(x, y, z), UnitQuaternion::from_euler_angles(roll, pitch, yaw))
}

/// A direction of length one; `None` where all three numbers are zero.
pub(crate) fn unit(of: [f64; 3]) -> Option<Vector3<f64>> {
    Vector3::from(of).try_normalize(0.0)
}
