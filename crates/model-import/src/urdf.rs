//! URDF: a tree of links and joints, each joint placed in its parent.

use std::collections::HashMap;

use nalgebra::Vector3;
use roxmltree::Node;

use crate::error::ImportError;
use crate::model::{Form, Joint, Link, Model, Motion, Shape};
use crate::solid::{Solid, moments};
use crate::source::{Place, Source, UNEXPANDED, child, children, place, unit};

/// Reads `<robot>`.
pub(crate) fn read(source: &Source<'_>, root: Node<'_, '_>) -> Result<Model, ImportError> {
    let is_xacro = |n: &Node<'_, '_>| n.tag_name().namespace().is_some_and(|space| space.contains("xacro"));
    if let Some(macros) = root.descendants().find(is_xacro) {
        return Err(source.wrong(macros, format!("<{}> is a macro, {UNEXPANDED}", macros.tag_name().name())));
    }

    let mut links = Vec::new();
    let mut places: HashMap<&str, usize> = HashMap::new();
    for node in children(root, "link") {
        let name = source.needed(node, "name")?;
        if places.insert(name, links.len()).is_some() {
            return Err(source.wrong(node, format!("there are two links '{name}'; give each its own name")));
        }
        links.push(link(source, root, node, name)?);
    }
    let of = |node: Node<'_, '_>, end: &str| {
        let at = child(node, end).ok_or_else(|| source.wrong(node, format!("<joint> has no <{end}>; add it")))?;
        let name = source.needed(at, "link")?;
        places.get(name).copied().ok_or_else(|| {
            source.wrong(at, format!("there is no link '{name}'; correct the name, or add <link name=\"{name}\"/>"))
        })
    };

    // Axes as in the joint's own frame; they are turned into the model below.
    let mut joints: Vec<(Joint, Place)> = Vec::new();
    for node in children(root, "joint") {
        let (parent, below) = (of(node, "parent")?, of(node, "child")?);
        if joints.iter().any(|(j, _)| j.child == below) {
            let name = &links[below].name;
            return Err(source.wrong(node, format!("link '{name}' hangs on two joints; take one of them out")));
        }
        joints.push((joint(source, node, parent, below)?, origin(source, child(node, "origin"))?));
    }

    let name = root.attribute("name").unwrap_or("robot");
    let mut model = Model::new(name, "URDF", links, joints.iter().map(|(j, _)| j.clone()).collect());
    // From the root down, so that a parent's frame is known before its children's.
    let order = model.of_robot();
    if order.len() < model.links.len() {
        let lost = (0..model.links.len()).find(|k| !order.contains(k)).map_or("", |k| &model.links[k].name);
        return Err(source.whole(format!(
            "link '{lost}' does not hang on the root '{}'; a robot is one tree: join it by a joint, or take it out",
            model.links[model.root()].name
        )));
    }
    for link in order {
        let Some(k) = model.joints.iter().position(|j| j.child == link) else { continue };
        let at = model.links[model.joints[k].parent].place * joints[k].1;
        model.joints[k].axis = at.rotation * model.joints[k].axis;
        model.joints[k].at = at.translation.vector.into();
        let below = &mut model.links[link];
        below.place = at;
        below.solid = below.solid.map(|s| s.seen_from(&at));
        below.shapes.iter_mut().for_each(|shape| shape.place = at * shape.place);
    }
    Ok(model)
}

/// `<origin xyz rpy>`, both zero where they are not given.
fn origin(source: &Source<'_>, node: Option<Node<'_, '_>>) -> Result<Place, ImportError> {
    let Some(node) = node else { return Ok(Place::identity()) };
    let xyz = source.numbers(node, "xyz")?.unwrap_or_default();
    Ok(place(xyz, source.numbers(node, "rpy")?.unwrap_or_default()))
}

/// A link in its own frame.
fn link(source: &Source<'_>, root: Node<'_, '_>, node: Node<'_, '_>, name: &str) -> Result<Link, ImportError> {
    let solid = child(node, "inertial").map(|inertial| solid(source, inertial)).transpose()?;
    let friction = friction(source, root, node, name)?;
    let mut shapes = Vec::new();
    for (kind, touches) in [("collision", true), ("visual", false)] {
        for shape in children(node, kind) {
            let Some(geometry) = child(shape, "geometry") else { continue };
            shapes.push(Shape {
                form: form(source, geometry)?,
                place: origin(source, child(shape, "origin"))?,
                touches,
                friction: friction.clone(),
            });
        }
    }
    Ok(Link { name: name.to_owned(), place: Place::identity(), solid, shapes })
}

fn solid(source: &Source<'_>, node: Node<'_, '_>) -> Result<Solid, ImportError> {
    let lacks = |what: &str| source.wrong(node, format!("<inertial> has no <{what}>; add it"));
    let mass = child(node, "mass").ok_or_else(|| lacks("mass"))?;
    let value = source.parsed(mass, "mass", source.needed(mass, "value")?)?;
    source.ensure_mass(mass, value)?;
    let of = child(node, "inertia").ok_or_else(|| lacks("inertia"))?;
    let moment = |name: &str| Ok(source.number(of, name)?.unwrap_or_default());
    let about = [moment("ixx")?, moment("iyy")?, moment("izz")?];
    let inertia = moments(about, [moment("ixy")?, moment("ixz")?, moment("iyz")?]);
    Ok(Solid::at(&origin(source, child(node, "origin"))?, value, inertia))
}

fn form(source: &Source<'_>, geometry: Node<'_, '_>) -> Result<Form, ImportError> {
    let radius = |node: Node<'_, '_>| source.parsed(node, "radius", source.needed(node, "radius")?);
    if let Some(sphere) = child(geometry, "sphere") {
        return Ok(Form::Sphere(radius(sphere)?));
    }
    let round = ["cylinder", "capsule"].iter().find_map(|name| child(geometry, name));
    Ok(match round {
        Some(node) => Form::Round(radius(node)?),
        None => Form::Other,
    })
}

/// Friction of a link: Gazebo's `<gazebo reference><mu1><mu2>`, or Bullet's `<contact><lateral_friction>`.
fn friction(source: &Source<'_>, root: Node<'_, '_>, link: Node<'_, '_>, name: &str) -> Result<Vec<f64>, ImportError> {
    let tags = children(root, "gazebo").filter(|g| g.attribute("reference") == Some(name));
    let mut out = Vec::new();
    for node in tags.flat_map(|g| g.children()).filter(|n| n.has_tag_name("mu1") || n.has_tag_name("mu2")) {
        // As text, or as an attribute in older files.
        let text = node.attribute("value").or(node.text()).unwrap_or_default();
        out.push(source.parsed(node, node.tag_name().name(), text)?);
    }
    let bullet = child(link, "contact").and_then(|c| child(c, "lateral_friction"));
    if let (true, Some(node)) = (out.is_empty(), bullet) {
        out.extend(source.number(node, "value")?);
    }
    Ok(out)
}

fn joint(source: &Source<'_>, node: Node<'_, '_>, parent: usize, child_link: usize) -> Result<Joint, ImportError> {
    let name = source.needed(node, "name")?;
    let kind = source.needed(node, "type")?;
    let axis = match child(node, "axis") {
        Some(axis) => source.numbers(axis, "xyz")?.unwrap_or([1.0, 0.0, 0.0]),
        None => [1.0, 0.0, 0.0],
    };
    let motion = match kind {
        "fixed" => Motion::Fixed,
        "continuous" | "revolute" => Motion::Turn,
        "prismatic" | "planar" | "floating" | "spherical" => Motion::Other,
        other => {
            return Err(source.wrong(
                node,
                format!("joint type '{other}'; write fixed, continuous, revolute, prismatic, planar or floating"),
            ));
        }
    };
    let limit = child(node, "limit");
    let of = |name: &str| limit.map_or(Ok(None), |l| source.number(l, name));
    // A revolute joint stays where it is without limits; a continuous one has none, whatever its element says.
    let ends = [of("lower")?, of("upper")?];
    let range = (kind == "revolute").then_some(ends.map(Option::unwrap_or_default));
    let [lower, upper] = ends;
    let meant = lower.zip(upper).filter(|(lower, upper)| lower < upper).map(|(lower, upper)| [lower, upper]);
    let dynamics = child(node, "dynamics");
    let number = |name: &str| dynamics.map_or(Ok(None), |d| source.number(d, name));
    Ok(Joint {
        motion,
        axis: unit(axis).unwrap_or_else(Vector3::x),
        range,
        meant,
        damping: number("damping")?,
        friction: number("friction")?,
        effort: of("effort")?,
        follows: child(node, "mimic").and_then(|m| m.attribute("joint")).map(str::to_owned),
        ..Joint::fixed(name, parent, child_link)
    })
}
