//! The way to the wanted fields of a CDR message, worked out once for a topic.

use std::cell::RefCell;
use std::rc::Rc;

use re_cdr::{ByteOrder, CdrReader};

use super::cdr::{self, Undecodable, Walk};
use super::cell::Cell;
use super::names::Names;
use super::path::{NAME_LISTS, Part, Path};
use super::run::Run;
use super::schema::{Layout, Number, Size, Type};
use crate::suggest;

/// What to do with a message.
#[derive(Debug)]
pub(super) struct Plan {
    /// Remembers from message to message where named items are.
    root: RefCell<Node>,
}

/// What to do with a field.
#[derive(Debug)]
enum Node {
    Skip(Type),
    /// Numbers that nobody wants.
    Run(Run),
    /// A number into these cells.
    Number(Number, Vec<usize>),
    /// Seconds and nanoseconds, together or one of them, into these cells.
    Stamp(Vec<(usize, Of)>),
    Message {
        fields: Vec<Node>,
        /// The list of names, when a list beside is looked up by name.
        names: Option<NamesAt>,
    },
    List {
        of: Type,
        size: Size,
        items: Vec<(Pick, Node)>,
        /// Places of the picked items in rising order, each with its number among `items`.
        places: Vec<(usize, usize)>,
        /// The version of the names that the places were found by; `None` before the first message.
        found_by: Option<u64>,
    },
}

/// Where a message's list of names is.
#[derive(Debug)]
struct NamesAt {
    layout: Rc<Layout>,
    /// Index of the field.
    index: usize,
    names: Names,
}

/// What is wanted of a stamp.
#[derive(Debug, Clone, Copy)]
enum Of {
    Both,
    Seconds,
    Nanoseconds,
}

/// Which item of a list.
#[derive(Debug, Clone, PartialEq)]
enum Pick {
    At(usize),
    Named(String),
}

/// What is wrong with a path, behind its place among those that were asked for.
#[derive(Debug)]
pub(super) struct Complaint(pub(super) usize, pub(super) String);

/// A path that is still to be followed, and its cell.
type Open<'p> = (usize, &'p [Part]);

impl Plan {
    /// The plan of reading these paths from messages of this layout.
    pub(super) fn new(layout: &Rc<Layout>, paths: &[Path]) -> Result<Self, Complaint> {
        let open: Vec<Open<'_>> = paths.iter().enumerate().map(|(cell, path)| (cell, path.as_slice())).collect();
        Ok(Self { root: RefCell::new(message(layout, &open)?) })
    }

    /// Reads a message into one cell per path.
    pub(super) fn read(&self, message: &[u8], cells: &mut [Cell]) -> Result<(), Undecodable> {
        struct Filling<'a> {
            root: &'a mut Node,
            body: &'a [u8],
            cells: &'a mut [Cell],
        }
        impl Walk for Filling<'_> {
            fn walk<B: ByteOrder>(&mut self, reader: &mut CdrReader<'_, B>) -> Result<(), Undecodable> {
                fill(self.root, self.body, reader, None, self.cells)
            }
        }
        let body = message.get(cdr::HEAD..).ok_or(Undecodable)?;
        // Nobody else holds it: reading calls nothing of the caller's.
        let mut root = self.root.try_borrow_mut().map_err(|_| Undecodable)?;
        cdr::walk(message, &mut Filling { root: &mut root, body, cells })
    }
}

fn node(ty: &Type, name: &str, open: &[Open<'_>]) -> Result<Node, Complaint> {
    let Some(&(first, _)) = open.first() else { return Ok(Node::Skip(ty.clone())) };
    let ended: Vec<usize> = open.iter().filter(|(_, rest)| rest.is_empty()).map(|&(cell, _)| cell).collect();
    let complain = |cell: usize, message: String| Err(Complaint(cell, message));
    match ty {
        Type::Number(_) if ended.len() < open.len() => {
            let beyond = open.iter().find(|(_, rest)| !rest.is_empty()).map_or(first, |&(cell, _)| cell);
            complain(beyond, format!("`{name}` is a number; nothing is inside it"))
        }
        Type::Number(number) => Ok(Node::Number(*number, ended)),
        Type::Text | Type::WideText => complain(first, format!("`{name}` is text, not a number")),
        Type::Message(layout) if layout.is_stamp() => stamp(layout, open),
        Type::Message(layout) => match ended.first() {
            Some(&cell) => complain(cell, format!("`{name}` is a message; its fields are: {}", names_of(layout))),
            None => message(layout, open),
        },
        Type::List { of, size } => list(of, *size, name, open),
    }
}

fn stamp(layout: &Rc<Layout>, open: &[Open<'_>]) -> Result<Node, Complaint> {
    let of = |&(cell, rest): &Open<'_>| match rest {
        [] => Some((cell, Of::Both)),
        [Part::Field(field)] if field == "sec" => Some((cell, Of::Seconds)),
        [Part::Field(field)] if field == "nanosec" => Some((cell, Of::Nanoseconds)),
        _ => None,
    };
    match open.iter().map(of).collect() {
        Some(wanted) => Ok(Node::Stamp(wanted)),
        // Something else is wanted, and the complaint is that of any message.
        None => message(layout, open),
    }
}

fn message<'p>(layout: &Rc<Layout>, open: &[Open<'p>]) -> Result<Node, Complaint> {
    for &(cell, rest) in open {
        let known = matches!(rest.first(), Some(Part::Field(name)) if layout.fields.iter().any(|(f, _)| f == name));
        if known {
            continue;
        }
        let wanted = rest.first().map_or(String::new(), |part| match part {
            Part::Field(name) | Part::Name(name) => name.clone(),
            Part::Index(index) => index.to_string(),
        });
        let fields: Vec<&str> = layout.fields.iter().map(|(name, _)| name.as_str()).collect();
        let hint = suggest::hint(&wanted, &fields).replacen("known are:", "its fields are:", 1);
        return Err(Complaint(cell, format!("{} has no field `{wanted}`; {hint}", layout.name)));
    }
    let (mut fields, mut names) = (Vec::new(), None);
    for (name, ty) in &layout.fields {
        let inside = |&(cell, rest): &Open<'p>| match rest {
            [Part::Field(field), rest @ ..] if *field == *name => Some((cell, rest)),
            _ => None,
        };
        let inner: Vec<Open<'p>> = open.iter().filter_map(inside).collect();
        if let Some(&(cell, _)) = inner.iter().find(|(_, rest)| matches!(rest.first(), Some(Part::Name(_)))) {
            names = layout.names();
            if names.is_none() {
                let message = format!("no list of names ({}) stands beside `{name}`", NAME_LISTS.join(", "));
                return Err(Complaint(cell, message));
            }
        }
        push(&mut fields, node(ty, name, &inner)?);
    }
    let names = names.map(|index| NamesAt { layout: Rc::clone(layout), index, names: Names::default() });
    Ok(Node::Message { fields, names })
}

/// Adds a node; numbers that nobody wants become one run with those before.
fn push(fields: &mut Vec<Node>, node: Node) {
    let run = if let Node::Skip(ty) = &node { Run::of(ty) } else { None };
    let Some(run) = run else { return fields.push(node) };
    if let Some(Node::Run(last)) = fields.last_mut()
        && let Some(both) = last.then(run)
    {
        *last = both;
    } else {
        fields.push(Node::Run(run));
    }
}

fn list(of: &Type, size: Size, name: &str, open: &[Open<'_>]) -> Result<Node, Complaint> {
    let mut picked: Vec<(Pick, Vec<Open<'_>>)> = Vec::new();
    for &(cell, rest) in open {
        let (pick, rest) = match rest {
            [Part::Index(index), rest @ ..] => (Pick::At(*index), rest),
            [Part::Name(name), rest @ ..] => (Pick::Named(name.clone()), rest),
            _ => return Err(Complaint(cell, format!("`{name}` is a list; say which item: {name}[0]"))),
        };
        if let (Pick::At(index), Size::Fixed(count) | Size::AtMost(count)) = (&pick, size)
            && *index >= count
        {
            let message = format!("`{name}` has at most {count} items, counted from 0");
            return Err(Complaint(cell, message));
        }
        match picked.iter_mut().find(|(other, _)| *other == pick) {
            Some((_, open)) => open.push((cell, rest)),
            None => picked.push((pick, vec![(cell, rest)])),
        }
    }
    let mut items = Vec::new();
    for (pick, open) in picked {
        items.push((pick, node(of, name, &open)?));
    }
    Ok(Node::List { of: of.clone(), size, items, places: Vec::new(), found_by: None })
}

fn names_of(layout: &Layout) -> String {
    layout.fields.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>().join(", ")
}

/// Follows a node; `names` are those beside the list that it may be.
fn fill<B: ByteOrder>(
    node: &mut Node,
    body: &[u8],
    reader: &mut CdrReader<'_, B>,
    names: Option<&Names>,
    cells: &mut [Cell],
) -> Result<(), Undecodable> {
    match node {
        Node::Skip(ty) => cdr::skip(reader, ty),
        Node::Run(run) => run.skip(reader),
        Node::Number(number, into) => {
            let value = cdr::number(reader, *number)?;
            for &mut cell in into {
                cells[cell] = value;
            }
            Ok(())
        }
        Node::Stamp(into) => {
            let (seconds, ns) = cdr::stamp(reader)?;
            for &mut (cell, of) in into {
                cells[cell] = Cell::Whole(match of {
                    Of::Both => seconds * 1_000_000_000 + ns,
                    Of::Seconds => seconds,
                    Of::Nanoseconds => ns,
                });
            }
            Ok(())
        }
        Node::Message { fields, names } => {
            if let Some(names) = names {
                names.read::<B>(body, reader.position())?;
            }
            let names = names.as_ref().map(|at| &at.names);
            fields.iter_mut().try_for_each(|field| fill(field, body, reader, names, cells))
        }
        Node::List { of, size, items, places, found_by } => {
            let count = cdr::length(reader, *size, of)?;
            let version = names.map_or(0, Names::version);
            if *found_by != Some(version) {
                *places = find(items, names);
                *found_by = Some(version);
            }
            let (mut next, mut last) = (0, reader.position());
            for &mut (index, item) in places {
                let Some((_, node)) = items.get_mut(item).filter(|_| index < count) else { break };
                if index < next {
                    // The same item again, once by name and once by number.
                    fill(node, body, &mut cdr::again::<B>(body, last)?, None, cells)?;
                    continue;
                }
                cdr::skip_items(reader, of, index - next)?;
                last = reader.position();
                fill(node, body, reader, None, cells)?;
                next = index + 1;
            }
            cdr::skip_items(reader, of, count - next)
        }
    }
}

/// The places of picked items in rising order, each with its number among `items`.
fn find(items: &[(Pick, Node)], names: Option<&Names>) -> Vec<(usize, usize)> {
    let place = |pick: &Pick| match pick {
        Pick::At(index) => Some(*index),
        // A name that stands there twice names nothing.
        Pick::Named(name) => {
            let mut found = names?.list().iter().enumerate().filter(|(_, other)| *other == name);
            let index = found.next()?.0;
            found.next().is_none().then_some(index)
        }
    };
    let numbered = items.iter().enumerate();
    let mut places: Vec<(usize, usize)> = numbered.filter_map(|(item, (pick, _))| Some((place(pick)?, item))).collect();
    places.sort_unstable();
    places
}

impl NamesAt {
    /// Reads the list of names of the message that starts here.
    fn read<B: ByteOrder>(&mut self, body: &[u8], position: usize) -> Result<(), Undecodable> {
        let mut reader = cdr::again::<B>(body, position)?;
        let fields = &self.layout.fields;
        fields[..self.index].iter().try_for_each(|(_, ty)| cdr::skip(&mut reader, ty))?;
        let Some((_, Type::List { of, size })) = fields.get(self.index) else { return Err(Undecodable) };
        if self.names.read(body, &mut reader, of, *size)? { Ok(()) } else { Err(Undecodable) }
    }
}
