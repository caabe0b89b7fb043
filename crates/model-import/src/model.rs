//! A model of any format: rigid links, and the joints between them.

use nalgebra::{Point3, Vector3};

use crate::solid::Solid;
use crate::source::Place;

/// A robot as a simulator has it, with every joint at zero. Lengths in m, angles in rad, x forward, y left, z up.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Model {
    pub(crate) name: String,
    /// The format, for sources.
    pub(crate) form: &'static str,
    pub(crate) links: Vec<Link>,
    pub(crate) joints: Vec<Joint>,
    /// What was there and not read.
    pub(crate) notes: Vec<String>,
    /// The joint above each link, by its place among the joints.
    above: Vec<Option<usize>>,
}

/// A rigid part.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Link {
    pub(crate) name: String,
    /// Its frame in the model.
    pub(crate) place: Place,
    /// Its mass, seen from the model; `None` where the file states none.
    pub(crate) solid: Option<Solid>,
    pub(crate) shapes: Vec<Shape>,
}

/// A shape, seen from the model.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Shape {
    pub(crate) form: Form,
    pub(crate) place: Place,
    /// Whether it touches; otherwise it is only seen.
    pub(crate) touches: bool,
    /// Friction coefficients with the ground, one or two directions.
    pub(crate) friction: Vec<f64>,
}

/// Forms of which a wheel's radius can be read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Form {
    /// Radius.
    Sphere(f64),
    /// Radius of a cylinder or capsule about its z axis.
    Round(f64),
    /// Any other.
    Other,
}

/// What a joint lets move.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Motion {
    /// Nothing.
    Fixed,
    /// A turn about its axis.
    Turn,
    /// Anything else: the model is taken as it stands at zero.
    Other,
}

/// A joint.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Joint {
    pub(crate) name: String,
    pub(crate) motion: Motion,
    /// Links by their place in the model.
    pub(crate) parent: usize,
    pub(crate) child: usize,
    /// Direction and a point of its axis, seen from the model.
    pub(crate) axis: Vector3<f64>,
    pub(crate) at: Point3<f64>,
    /// Angles between which it turns; `None` of one that turns without end.
    pub(crate) range: Option<[f64; 2]>,
    /// Angles that the file states beside it, of a joint that turns without end all the same.
    pub(crate) meant: Option<[f64; 2]>,
    /// Viscous damping, N m s/rad.
    pub(crate) damping: Option<f64>,
    /// Dry friction, N m.
    pub(crate) friction: Option<f64>,
    /// Inertia of the rotor, kg m².
    pub(crate) armature: Option<f64>,
    /// Largest torque, N m.
    pub(crate) effort: Option<f64>,
    /// Whether the file has an actuator for it.
    pub(crate) acts: bool,
    /// Name of the joint that it follows.
    pub(crate) follows: Option<String>,
}

impl Joint {
    /// One that moves nothing.
    pub(crate) fn fixed(name: &str, parent: usize, child: usize) -> Self {
        Self {
            name: name.to_owned(),
            motion: Motion::Fixed,
            parent,
            child,
            axis: Vector3::x(),
            at: Point3::origin(),
            range: None,
            meant: None,
            damping: None,
            friction: None,
            armature: None,
            effort: None,
            acts: false,
            follows: None,
        }
    }

    /// Whether something turns it by itself.
    pub(crate) fn is_driven(&self) -> bool {
        self.follows.is_none() && (self.acts || self.effort.is_some_and(|effort| effort > 0.0))
    }

    /// Whether it turns without end.
    pub(crate) fn is_endless(&self) -> bool {
        self.motion == Motion::Turn
            && self.range.is_none_or(|[lower, upper]| upper - lower >= std::f64::consts::TAU - f64::EPSILON)
    }
}

impl Model {
    /// Links and the joints between them; no link hangs on two.
    pub(crate) fn new(name: &str, form: &'static str, links: Vec<Link>, joints: Vec<Joint>) -> Self {
        let mut above = vec![None; links.len()];
        for (k, joint) in joints.iter().enumerate() {
            above[joint.child] = Some(k);
        }
        Self { name: name.to_owned(), form, links, joints, notes: Vec::new(), above }
    }

    /// The joint above a link.
    pub(crate) fn above(&self, link: usize) -> Option<&Joint> {
        self.above[link].map(|k| &self.joints[k])
    }

    /// Joints from a link up to the root, the nearest first.
    pub(crate) fn ancestors(&self, link: usize) -> impl Iterator<Item = &Joint> {
        std::iter::successors(self.above(link), |joint| self.above(joint.parent))
    }

    /// A link and all that hangs on it through joints that pass `through`.
    pub(crate) fn group(&self, link: usize, through: impl Fn(&Joint) -> bool) -> Vec<usize> {
        let mut out = vec![link];
        let mut next = 0;
        while next < out.len() {
            let parent = out[next];
            let below = self.joints.iter().filter(|j| j.parent == parent && through(j)).map(|j| j.child);
            let new: Vec<usize> = below.filter(|child| !out.contains(child)).collect();
            out.extend(new);
            next += 1;
        }
        out
    }

    /// A link and what is rigidly joined below it.
    pub(crate) fn rigid(&self, link: usize) -> Vec<usize> {
        self.group(link, |joint| joint.motion == Motion::Fixed)
    }

    /// Mass of links as one.
    pub(crate) fn solid(&self, links: &[usize]) -> Option<Solid> {
        let parts: Vec<Solid> = links.iter().filter_map(|&k| self.links[k].solid).collect();
        Solid::sum(&parts)
    }

    /// The link that hangs on no other.
    pub(crate) fn root(&self) -> usize {
        (0..self.links.len()).find(|&k| self.above(k).is_none()).unwrap_or(0)
    }

    /// Links that hang on the root, and it.
    pub(crate) fn of_robot(&self) -> Vec<usize> {
        self.group(self.root(), |_| true)
    }
}
