//! The layout of a topic's messages, from its definition.

use std::collections::HashMap;
use std::rc::Rc;

use re_ros_msg::MessageSchema;
use re_ros_msg::message_spec::{
    ArraySize, BuiltInType, ComplexType, MessageSpecification, Type as Spec, message_package,
};

use super::definitions;
use crate::topic::Topic;

/// Messages within messages: more is no message of this world.
const DEEPEST: usize = 32;

/// What a field is.
#[derive(Debug, Clone)]
pub(super) enum Type {
    Number(Number),
    Text,
    /// `wstring`: known, not read.
    WideText,
    Message(Rc<Layout>),
    List {
        of: Box<Type>,
        size: Size,
    },
}

/// A number on the wire.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Number {
    Bool,
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F32,
    F64,
}

impl Number {
    /// Bytes on the wire, and its alignment.
    pub(super) const fn size(self) -> usize {
        match self {
            Self::Bool | Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::I64 | Self::U64 | Self::F64 => 8,
        }
    }
}

/// How many items a list has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Size {
    Fixed(usize),
    AtMost(usize),
    Any,
}

/// The fields of a message in the order of the wire.
#[derive(Debug)]
pub(super) struct Layout {
    /// `builtin_interfaces/Time`
    pub(super) name: String,
    /// The first field that is wide text, here or in a message inside.
    pub(super) wide: Option<String>,
    pub(super) fields: Vec<(String, Type)>,
}

impl Layout {
    /// Time and Duration, by shape: seconds and nanoseconds.
    pub(super) fn is_stamp(&self) -> bool {
        use Number::{I32, U32};
        let plain = matches!(&self.fields[..], [(s, Type::Number(I32)), (ns, Type::Number(U32))]
            if s == "sec" && ns == "nanosec");
        plain && self.name.starts_with("builtin_interfaces/")
    }

    /// Where the list of names is that belongs to this message's lists of numbers.
    pub(super) fn names(&self) -> Option<usize> {
        let is_names = |ty: &Type| matches!(ty, Type::List { of, .. } if matches!(**of, Type::Text));
        let named = |wanted: &&str| self.fields.iter().position(|(name, ty)| name == wanted && is_names(ty));
        super::path::NAME_LISTS.iter().find_map(named)
    }
}

/// The layout of a topic's messages; a complaint when the file does not say it and it is not built in.
pub(super) fn of(topic: &Topic) -> Result<Layout, String> {
    let name = short(&topic.message_type);
    if topic.schema.is_empty() {
        let Some(text) = definitions::of(&name) else {
            let message = "the bag does not define this message and it is not built in";
            return Err(format!("{message}; record with ROS 2 Iron or later, or convert the bag to MCAP"));
        };
        return parse(&name, text);
    }
    if topic.schema_encoding != "ros2msg" {
        let given = &topic.schema_encoding;
        return Err(format!("its schema is written as `{given}`; only ros2msg is read"));
    }
    let text = str::from_utf8(&topic.schema).map_err(|_| "its schema is no text".to_owned())?;
    parse(&name, text)
}

/// The layout that a definition with its dependencies gives.
pub(super) fn parse(name: &str, text: &str) -> Result<Layout, String> {
    // The parser indexes into quotes; a definition that it cannot stand is a bad one.
    let schema = std::panic::catch_unwind(|| MessageSchema::parse(name, text))
        .map_err(|_| "its schema does not parse".to_owned())?
        .map_err(|error| format!("its schema does not parse: {error:#}"))?;
    let mut specs: HashMap<String, &MessageSpecification> = HashMap::new();
    for spec in &schema.dependencies {
        specs.insert(short(&spec.name), spec);
    }
    let mut known = HashMap::new();
    layout(&schema.spec, name, &specs, &mut known, 0)
}

fn layout(
    spec: &MessageSpecification,
    name: &str,
    specs: &HashMap<String, &MessageSpecification>,
    known: &mut HashMap<String, Rc<Layout>>,
    depth: usize,
) -> Result<Layout, String> {
    if depth > DEEPEST {
        return Err(format!("`{name}` holds messages within messages without end"));
    }
    let (mut fields, mut wide) = (Vec::new(), None);
    for field in &spec.fields {
        let ty = of_spec(&field.ty, name, specs, known, depth)?;
        wide = wide.or_else(|| wide_in(&ty, &field.name));
        fields.push((field.name.clone(), ty));
    }
    Ok(Layout { name: name.to_owned(), wide, fields })
}

fn wide_in(ty: &Type, name: &str) -> Option<String> {
    match ty {
        Type::WideText => Some(name.to_owned()),
        Type::List { of, .. } => wide_in(of, name),
        Type::Message(layout) => layout.wide.as_ref().map(|inner| format!("{name}.{inner}")),
        Type::Number(_) | Type::Text => None,
    }
}

fn of_spec(
    spec: &Spec,
    scope: &str,
    specs: &HashMap<String, &MessageSpecification>,
    known: &mut HashMap<String, Rc<Layout>>,
    depth: usize,
) -> Result<Type, String> {
    Ok(match spec {
        Spec::BuiltIn(built_in) => of_built_in(built_in),
        Spec::Array { ty, size } => {
            let size = match *size {
                ArraySize::Fixed(count) => Size::Fixed(count),
                ArraySize::Bounded(count) => Size::AtMost(count),
                ArraySize::Unbounded => Size::Any,
            };
            Type::List { of: Box::new(of_spec(ty, scope, specs, known, depth)?), size }
        }
        Spec::Complex(complex) => {
            let name = match complex {
                ComplexType::Absolute { package, name } => short(&format!("{package}/{name}")),
                ComplexType::Relative { name } if name == "Header" => "std_msgs/Header".to_owned(),
                ComplexType::Relative { name } => format!("{}/{name}", message_package(scope).unwrap_or_default()),
            };
            if let Some(layout) = known.get(&name) {
                return Ok(Type::Message(Rc::clone(layout)));
            }
            let found = if let Some(spec) = specs.get(&name) {
                if let Ok(Some(built_in)) = spec.underlying_type_if_enum_like() {
                    return Ok(of_built_in(built_in));
                }
                layout(spec, &name, specs, known, depth + 1)?
            } else {
                let text = definitions::of(&name).filter(|_| depth < DEEPEST);
                parse(&name, text.ok_or_else(|| format!("its schema does not define `{name}`"))?)?
            };
            let found = Rc::new(found);
            known.insert(name, Rc::clone(&found));
            Type::Message(found)
        }
    })
}

fn of_built_in(built_in: &BuiltInType) -> Type {
    Type::Number(match built_in {
        BuiltInType::Bool => Number::Bool,
        // ROS 2's `byte` and `char` are octets.
        BuiltInType::Byte | BuiltInType::Char | BuiltInType::UInt8 => Number::U8,
        BuiltInType::Int8 => Number::I8,
        BuiltInType::Int16 => Number::I16,
        BuiltInType::UInt16 => Number::U16,
        BuiltInType::Int32 => Number::I32,
        BuiltInType::UInt32 => Number::U32,
        BuiltInType::Int64 => Number::I64,
        BuiltInType::UInt64 => Number::U64,
        BuiltInType::Float32 => Number::F32,
        BuiltInType::Float64 => Number::F64,
        BuiltInType::String(_) => return Type::Text,
        BuiltInType::WString(_) => return Type::WideText,
    })
}

/// `sensor_msgs/Imu` for `sensor_msgs/msg/Imu`.
fn short(name: &str) -> String {
    name.replacen("/msg/", "/", 1)
}
