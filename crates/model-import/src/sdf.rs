//! SDF: links and joints by their poses in the model, or in frames that are named.

use std::collections::{HashMap, HashSet};

use nalgebra::Vector3;
use roxmltree::Node;

use crate::error::ImportError;
use crate::model::{Form, Joint, Link, Model, Motion, Shape};
use crate::solid::{Solid, moments};
use crate::source::{Place, Source, child, children, place, unit};

/// A limit beyond which a joint has none: SDF's default is 1e16.
const NO_LIMIT: f64 = 1e6;

/// Reads `<sdf>`: its first model that is not static.
pub(crate) fn read(source: &Source<'_>, root: Node<'_, '_>) -> Result<Model, ImportError> {
    let worlds = children(root, "world").flat_map(|world| children(world, "model"));
    let models: Vec<Node<'_, '_>> = children(root, "model").chain(worlds).collect();
    let is_static = |m: &Node<'_, '_>| child(*m, "static").is_some_and(|s| matches!(text(s), "true" | "1"));
    let Some(node) = models.iter().copied().find(|m| !is_static(m)) else {
        return Err(source.whole("there is no <model> that moves; give the file in which the robot's links stand"));
    };
    let mut model = robot(source, node)?;
    let others = models.iter().filter(|m| **m != node && !is_static(m)).filter_map(|m| m.attribute("name"));
    model.notes.extend(others.map(|name| format!("model '{name}' stands in the same file and was not read")));
    let inside = ["include", "model"].into_iter().flat_map(|name| children(node, name));
    model.notes.extend(inside.map(|n| format!("a nested <{}> was not read", n.tag_name().name())));
    Ok(model)
}

fn text<'a>(node: Node<'a, '_>) -> &'a str {
    node.text().unwrap_or_default().trim()
}

/// Where frames lie in the model, found one by one.
struct Frames<'s, 'a, 'i> {
    source: &'s Source<'s>,
    /// Frames with their elements and what they are seen from when they do not say it.
    nodes: HashMap<&'a str, (Node<'a, 'i>, Option<&'a str>)>,
    found: HashMap<&'a str, Place>,
}

impl<'a, 'i> Frames<'_, 'a, 'i> {
    /// The place of a frame in the model: up to one that is known, then down again. No call in a call, which a long chain
    /// could drive beyond the stack.
    fn of(&mut self, at: Node<'a, 'i>, name: &'a str) -> Result<Place, ImportError> {
        let mut chain: Vec<(&'a str, Node<'a, 'i>)> = Vec::new();
        let mut asked: HashSet<&'a str> = HashSet::new();
        let (mut name, mut at) = (name, at);
        let mut place = loop {
            if name.is_empty() || name == "__model__" {
                break Place::identity();
            }
            if let Some(place) = self.found.get(name) {
                break *place;
            }
            let Some(&(node, usual)) = self.nodes.get(name) else {
                return Err(self
                    .source
                    .wrong(at, format!("there is no link, joint or frame '{name}'; correct the name")));
            };
            if !asked.insert(name) {
                return Err(self
                    .source
                    .wrong(node, format!("the pose of '{name}' is told relative to itself; break the ring")));
            }
            chain.push((name, node));
            (name, at) = (base_of(node, usual), node);
        };
        for (name, node) in chain.into_iter().rev() {
            place *= pose_of(self.source, child(node, "pose"))?;
            self.found.insert(name, place);
        }
        Ok(place)
    }

    /// The place of an element by its pose, seen from `usual` where it does not say from what.
    fn pose(&mut self, node: Node<'a, 'i>, usual: Option<&'a str>) -> Result<Place, ImportError> {
        Ok(self.of(node, base_of(node, usual))? * pose_of(self.source, child(node, "pose"))?)
    }
}

/// The frame from which an element's pose is seen.
fn base_of<'a>(node: Node<'a, '_>, usual: Option<&'a str>) -> &'a str {
    child(node, "pose").and_then(|p| p.attribute("relative_to")).or(usual).unwrap_or_default()
}

/// `<pose>`: position and angles, or a quaternion.
fn pose_of(source: &Source<'_>, node: Option<Node<'_, '_>>) -> Result<Place, ImportError> {
    let Some(node) = node.filter(|n| !text(*n).is_empty()) else { return Ok(Place::identity()) };
    if node.attribute("rotation_format") == Some("quat_xyzw") {
        let [x, y, z, i, j, k, w] = source.array(node, "pose", text(node))?;
        let turn = nalgebra::UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(w, i, j, k));
        return Ok(Place::from_parts(nalgebra::Translation3::new(x, y, z), turn));
    }
    let [x, y, z, a, b, c] = source.array(node, "pose", text(node))?;
    let unit = if node.attribute("degrees") == Some("true") { 1.0_f64.to_radians() } else { 1.0 };
    Ok(place([x, y, z], [a, b, c].map(|angle| unit * angle)))
}

fn robot(source: &Source<'_>, model: Node<'_, '_>) -> Result<Model, ImportError> {
    let mut frames = Frames { source, nodes: HashMap::new(), found: HashMap::new() };
    for node in children(model, "link").chain(children(model, "frame")) {
        let attached = node.attribute("attached_to");
        frames.nodes.insert(source.needed(node, "name")?, (node, attached));
    }
    for node in children(model, "joint") {
        // A joint may have the name of its link; the frame is the link's then.
        frames.nodes.entry(source.needed(node, "name")?).or_insert((node, child(node, "child").map(text)));
    }

    let mut links = Vec::new();
    for node in children(model, "link") {
        let name = source.needed(node, "name")?;
        let at = frames.of(node, name)?;
        links.push(link(source, node, name, at)?);
    }
    let mut joints: Vec<Joint> = Vec::new();
    for node in children(model, "joint") {
        let at = frames.pose(node, child(node, "child").map(text))?;
        let end = |which: &str| {
            let node =
                child(node, which).ok_or_else(|| source.wrong(node, format!("<joint> has no <{which}>; add it")))?;
            let is_world = text(node) == "world";
            let found = links.iter().position(|l| l.name == text(node));
            match found {
                None if !is_world => {
                    Err(source.wrong(node, format!("there is no link '{}'; correct the name", text(node))))
                }
                found => Ok(found),
            }
        };
        let (Some(parent), Some(below)) = (end("parent")?, end("child")?) else { continue };
        if joints.iter().any(|j| j.child == below) {
            let link = &links[below].name;
            return Err(source.wrong(node, format!("link '{link}' hangs on two joints; take one of them out")));
        }
        let mut read = joint(source, node, parent, below)?;
        let expressed = child(node, "axis").and_then(|a| child(a, "xyz")).and_then(|x| x.attribute("expressed_in"));
        let seen = match expressed {
            Some(frame) => frames.of(node, frame)?,
            None => at,
        };
        read.axis = seen.rotation * read.axis;
        read.at = at.translation.vector.into();
        joints.push(read);
    }
    Ok(Model::new(model.attribute("name").unwrap_or("robot"), "SDF", links, joints))
}

fn link(source: &Source<'_>, node: Node<'_, '_>, name: &str, at: Place) -> Result<Link, ImportError> {
    let mut solid = None;
    if let Some(inertial) = child(node, "inertial")
        && let Some(mass) = child(inertial, "mass")
    {
        let value = source.parsed(mass, "mass", text(mass))?;
        source.ensure_mass(mass, value)?;
        let of = child(inertial, "inertia");
        let moment = |name: &str, usual: f64| match of.and_then(|i| child(i, name)) {
            Some(n) => source.parsed(n, name, text(n)),
            None => Ok(usual),
        };
        // Without <inertia> SDF takes 1 kg m² for each axis.
        let about = [moment("ixx", 1.0)?, moment("iyy", 1.0)?, moment("izz", 1.0)?];
        let inertia = moments(about, [moment("ixy", 0.0)?, moment("ixz", 0.0)?, moment("iyz", 0.0)?]);
        solid = Some(Solid::at(&(at * pose_of(source, child(inertial, "pose"))?), value, inertia));
    }
    let mut shapes = Vec::new();
    for (kind, touches) in [("collision", true), ("visual", false)] {
        for shape in children(node, kind) {
            let Some(geometry) = child(shape, "geometry") else { continue };
            shapes.push(Shape {
                form: form(source, geometry)?,
                place: at * pose_of(source, child(shape, "pose"))?,
                touches,
                friction: friction(source, shape)?,
            });
        }
    }
    Ok(Link { name: name.to_owned(), place: at, solid, shapes })
}

fn form(source: &Source<'_>, geometry: Node<'_, '_>) -> Result<Form, ImportError> {
    let radius = |node: Node<'_, '_>| {
        let at = child(node, "radius").ok_or_else(|| source.wrong(node, "there is no <radius>; add it"))?;
        source.parsed(at, "radius", text(at))
    };
    if let Some(sphere) = child(geometry, "sphere") {
        return Ok(Form::Sphere(radius(sphere)?));
    }
    let round = ["cylinder", "capsule"].iter().find_map(|name| child(geometry, name));
    Ok(match round {
        Some(node) => Form::Round(radius(node)?),
        None => Form::Other,
    })
}

/// `<surface><friction><ode><mu><mu2>` of a collision.
fn friction(source: &Source<'_>, shape: Node<'_, '_>) -> Result<Vec<f64>, ImportError> {
    let surface = child(shape, "surface").and_then(|s| child(s, "friction"));
    let Some(ode) = surface.and_then(|f| child(f, "ode")) else { return Ok(Vec::new()) };
    let numbers = ["mu", "mu2"].into_iter().filter_map(|name| child(ode, name));
    numbers.map(|n| source.parsed(n, n.tag_name().name(), text(n))).collect()
}

fn joint(source: &Source<'_>, node: Node<'_, '_>, parent: usize, below: usize) -> Result<Joint, ImportError> {
    let name = source.needed(node, "name")?;
    let motion = match source.needed(node, "type")? {
        "fixed" => Motion::Fixed,
        "continuous" | "revolute" => Motion::Turn,
        _ => Motion::Other,
    };
    let axis = child(node, "axis");
    let part = |group: &str, name: &str| {
        let at = axis.and_then(|a| child(a, group)).and_then(|g| child(g, name));
        at.map(|n| source.parsed(n, name, text(n))).transpose()
    };
    let xyz = match axis.and_then(|a| child(a, "xyz")) {
        Some(n) => source.array(n, "xyz", text(n))?,
        None => [0.0, 0.0, 1.0],
    };
    let limit = |name: &str| Ok::<_, ImportError>(part("limit", name)?.filter(|x| x.abs() < NO_LIMIT));
    Ok(Joint {
        motion,
        axis: unit(xyz).unwrap_or_else(Vector3::z),
        range: limit("lower")?.zip(limit("upper")?).map(|(lower, upper)| [lower, upper]),
        damping: part("dynamics", "damping")?,
        friction: part("dynamics", "friction")?,
        // A negative effort is none, too.
        effort: limit("effort")?.filter(|e| *e > 0.0),
        follows: axis.and_then(|a| child(a, "mimic")).and_then(|m| m.attribute("joint")).map(str::to_owned),
        ..Joint::fixed(name, parent, below)
    })
}
