//! MJCF: nested bodies, their joints inside, with default classes.

mod defaults;
mod frame;
mod geom;

use nalgebra::{Matrix3, Vector3};
use roxmltree::Node;

use crate::error::ImportError;
use crate::model::{Joint, Link, Model, Motion};
use crate::solid::{Solid, moments};
use crate::source::{Place, Source, child, children, unit};
use defaults::Defaults;
use frame::Reading;

/// Reads `<mujoco>`: the first body of its world that moves.
pub(crate) fn read(source: &Source<'_>, root: Node<'_, '_>) -> Result<Model, ImportError> {
    if let Some(include) = root.descendants().find(|n| n.has_tag_name("include")) {
        return Err(source.wrong(
            include,
            "parts of the model stand in another file; save it as one, in Python with \
             `mujoco.mj_saveLastXML(\"whole.xml\", mujoco.MjModel.from_xml_path(...))`, and give that",
        ));
    }
    let compiler = |name: &str| children(root, "compiler").filter_map(|c| c.attribute(name)).last();
    let reading = Reading {
        source,
        defaults: Defaults::new(root),
        angle: if compiler("angle") == Some("radian") { 1.0 } else { 1.0_f64.to_radians() },
        order: compiler("eulerseq").unwrap_or("xyz"),
    };
    let bodies: Vec<Node<'_, '_>> = children(root, "worldbody").flat_map(|w| children(w, "body")).collect();
    let moves =
        |body: &&Node<'_, '_>| body.descendants().any(|n| n.has_tag_name("joint") || n.has_tag_name("freejoint"));
    let Some(robot) = bodies.iter().find(moves) else {
        return Err(
            source.whole("there is no <body> with joints in <worldbody>; give the file in which the robot stands")
        );
    };

    let from_geoms = compiler("inertiafromgeom");
    let mut reader = Reader { reading, links: Vec::new(), joints: Vec::new(), pairs: pairs(root), from_geoms };
    reader.bodies(*robot)?;
    reader.motors(root)?;
    reader.couplings(root);
    let mut model = Model::new(root.attribute("model").unwrap_or("robot"), "MJCF", reader.links, reader.joints);
    let others = bodies.iter().filter(moves).filter(|b| *b != robot).filter_map(|b| b.attribute("name"));
    model.notes.extend(others.map(|name| format!("body '{name}' stands in the same world and was not read")));
    Ok(model)
}

/// `<contact><pair>`: contacts that are told one by one.
fn pairs<'a, 'i>(root: Node<'a, 'i>) -> Vec<Node<'a, 'i>> {
    children(root, "contact").flat_map(|c| children(c, "pair")).collect()
}

struct Reader<'s, 'a, 'i> {
    reading: Reading<'s, 'a>,
    links: Vec<Link>,
    joints: Vec<Joint>,
    pairs: Vec<Node<'a, 'i>>,
    from_geoms: Option<&'a str>,
}

impl<'a, 'i: 'a> Reader<'_, 'a, 'i> {
    /// The robot's body and all inside, each before those in it and in the order of the file: a list of what is still to be
    /// read instead of a call in a call, which a deep file could drive beyond the stack.
    fn bodies(&mut self, robot: Node<'a, 'i>) -> Result<(), ImportError> {
        let mut waiting = vec![(robot, None, Place::identity())];
        while let Some((node, parent, base)) = waiting.pop() {
            let (index, at) = self.body(node, parent, base)?;
            let inside: Vec<Node<'a, 'i>> = children(node, "body").collect();
            waiting.extend(inside.into_iter().rev().map(|body| (body, Some(index), at)));
        }
        Ok(())
    }

    /// One body with its joints: the number of its link, and its place in the model.
    fn body(&mut self, node: Node<'a, 'i>, parent: Option<usize>, base: Place) -> Result<(usize, Place), ImportError> {
        let name = node.attribute("name").map_or_else(|| format!("body {}", self.links.len()), str::to_owned);
        // The root's own place in the world is no part of the robot.
        let at = if parent.is_some() { base * self.reading.place(node)? } else { base };

        // Each joint but the last holds a link without mass: a body may have several.
        if let Some(first) = parent {
            let joints: Vec<Node<'a, 'i>> = children(node, "joint").collect();
            let mut carrier = first;
            for (k, joint) in joints.iter().enumerate() {
                let child = self.links.len();
                let read = self.joint(*joint, &name, carrier, child, &at)?;
                self.joints.push(read);
                if k + 1 < joints.len() {
                    let between = format!("{name} below {}", self.joints.last().map_or("", |j| &j.name));
                    self.links.push(Link { name: between, place: at, solid: None, shapes: Vec::new() });
                    carrier = child;
                }
            }
            if joints.is_empty() {
                let child = self.links.len();
                self.joints.push(Joint::fixed(&name, carrier, child));
            }
        }

        let link = self.link(node, &name, at)?;
        let index = self.links.len();
        self.links.push(link);
        Ok((index, at))
    }

    fn link(&self, node: Node<'a, 'i>, name: &str, at: Place) -> Result<Link, ImportError> {
        let geoms = children(node, "geom").map(|g| geom::read(&self.reading, g, &at)).collect::<Result<Vec<_>, _>>()?;
        let inertial = child(node, "inertial").filter(|_| self.from_geoms != Some("true"));
        let solid = match inertial {
            Some(inertial) => Some(self.inertial(inertial, &at)?),
            None if self.from_geoms == Some("false") => None,
            None => {
                let parts: Vec<Solid> = geoms.iter().filter_map(|g| g.solid).collect();
                Solid::sum(&parts)
            }
        };
        let mut shapes = Vec::new();
        for mut read in geoms {
            let named = |pair: &&Node<'_, '_>| {
                read.name.is_some() && ["geom1", "geom2"].iter().any(|end| pair.attribute(*end) == read.name)
            };
            if let Some(pair) = self.pairs.iter().find(named)
                && let Some(friction) = self.reading.list(*pair, "friction")?
            {
                // Along and across, then what turns and rolls.
                read.shape.friction = friction.into_iter().take(2).collect();
                read.shape.touches = true;
            }
            shapes.push(read.shape);
        }
        Ok(Link { name: name.to_owned(), place: at, solid, shapes })
    }

    fn inertial(&self, node: Node<'a, 'i>, at: &Place) -> Result<Solid, ImportError> {
        let mass = self.reading.source.parsed(node, "mass", self.reading.source.needed(node, "mass")?)?;
        self.reading.source.ensure_mass(node, mass)?;
        let inertia = if let Some([xx, yy, zz, xy, xz, yz]) = self.reading.array(node, "fullinertia")? {
            moments([xx, yy, zz], [xy, xz, yz])
        } else {
            let of = self.reading.array(node, "diaginertia")?.unwrap_or_default();
            Matrix3::from_diagonal(&Vector3::from(of))
        };
        Ok(Solid::at(&(at * self.reading.place(node)?), mass, inertia))
    }

    fn joint(
        &self,
        node: Node<'a, 'i>,
        body: &str,
        parent: usize,
        child: usize,
        at: &Place,
    ) -> Result<Joint, ImportError> {
        let reading = &self.reading;
        let kind = reading.defaults.attribute(node, "type").unwrap_or("hinge");
        let name = node.attribute("name").unwrap_or(body);
        let axis = reading.array(node, "axis")?.unwrap_or([0.0, 0.0, 1.0]);
        let range = reading.array::<2>(node, "range")?.map(|ends| ends.map(|x| reading.angle * x));
        let is_free = reading.defaults.attribute(node, "limited") == Some("false");
        let [x, y, z] = reading.array(node, "pos")?.unwrap_or_default();
        Ok(Joint {
            motion: if kind == "hinge" { Motion::Turn } else { Motion::Other },
            axis: at.rotation * unit(axis).unwrap_or_else(Vector3::z),
            at: at * nalgebra::Point3::new(x, y, z),
            range: range.filter(|[lower, upper]| !is_free && upper > lower),
            damping: reading.list(node, "damping")?.and_then(|d| d.first().copied()),
            friction: reading.number(node, "frictionloss")?,
            armature: reading.number(node, "armature")?,
            ..Joint::fixed(name, parent, child)
        })
    }

    /// Largest torques: of commands times gain and gear, or of forces.
    fn motors(&mut self, root: Node<'a, 'i>) -> Result<(), ImportError> {
        for motor in children(root, "actuator").flat_map(|a| a.children()).filter(Node::is_element) {
            let Some(name) = motor.attribute("joint") else { continue };
            let Some(k) = self.joints.iter().position(|j| j.name == name) else { continue };
            let gear = self.reading.list(motor, "gear")?.and_then(|g| g.first().copied()).unwrap_or(1.0);
            let gain = match motor.tag_name().name() {
                "motor" => Some(1.0),
                "general" => Some(self.reading.list(motor, "gainprm")?.and_then(|g| g.first().copied()).unwrap_or(1.0)),
                // What they are commanded is no torque.
                _ => None,
            };
            let command = self.reading.array::<2>(motor, "ctrlrange")?.zip(gain).map(|([_, most], gain)| most * gain);
            let force = self.reading.array::<2>(motor, "forcerange")?.map(|[_, most]| most);
            let most = [command, force].into_iter().flatten().map(|most| (most * gear).abs()).reduce(f64::min);
            self.joints[k].effort = most.filter(|m| m.is_finite() && *m > 0.0);
            self.joints[k].acts = true;
        }
        Ok(())
    }

    /// Joints that are held equal: the one without an actuator follows the other.
    fn couplings(&mut self, root: Node<'a, 'i>) {
        let pairs = children(root, "equality").flat_map(|e| children(e, "joint"));
        for pair in pairs {
            let place =
                |name: &str| pair.attribute(name).and_then(|joint| self.joints.iter().position(|j| j.name == joint));
            let (Some(first), Some(second)) = (place("joint1"), place("joint2")) else { continue };
            let leads = self.joints[first].acts && !self.joints[second].acts;
            let (leader, follower) = if leads { (first, second) } else { (second, first) };
            self.joints[follower].follows = Some(self.joints[leader].name.clone());
        }
    }
}
