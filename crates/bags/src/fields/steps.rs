//! The way through the messages of a topic: their fields are those of the layout, and only what may differ between
//! messages is looked at.

use re_cdr::{ByteOrder, CdrReader};

use super::cdr::{self, Undecodable, Walk};
use super::field::{Field, MOST_TOLD, add};
use super::names::Names;
use super::path::HEADER_STAMP;
use super::run::Run;
use super::schema::{Layout, Size, Type};

/// Most fields of a layout, messages within messages counted each time: more is no message of this world.
const MOST_FIELDS: usize = 1 << 16;

/// The way through a message of one layout.
pub(super) struct Steps {
    walk: Vec<Step>,
    lists_of_names: Vec<Names>,
    /// The header's stamp in the last message, in ns.
    stamp: Option<i128>,
}

/// What comes next in a message.
enum Step {
    Run(Run),
    Bool(Type),
    Stamp {
        is_header: bool,
    },
    Text(Type),
    /// A list of names, by its number among these.
    Names {
        of: Type,
        size: Size,
        list: usize,
    },
    List(List),
}

/// A list, and the fields that are told of it.
struct List {
    of: Type,
    size: Size,
    fields: std::ops::Range<usize>,
    /// The list of names before it in the same message.
    names: Option<usize>,
    /// Items in the last message.
    count: usize,
    /// Names that the fields have been told, by their version.
    told: u64,
}

impl Steps {
    /// The way through messages of a layout, and the fields that are told of them; lists have no length yet.
    pub(super) fn new(layout: &Layout) -> Result<(Self, Vec<Field>), String> {
        let mut making = Making { steps: Vec::new(), lists: 0, fields: Vec::new(), met: 0, items: 0 };
        if !making.message(layout, &mut String::new()) {
            return Err(format!("`{}` has more than {MOST_FIELDS} fields", layout.name));
        }
        let lists_of_names = (0..making.lists).map(|_| Names::default()).collect();
        Ok((Self { walk: making.steps, lists_of_names, stamp: None }, making.fields))
    }

    /// Walks a message and, when it decodes, widens what is known of the fields of its lists; the header's stamp, where
    /// there is one.
    pub(super) fn look(&mut self, message: &[u8], fields: &mut [Field]) -> Result<Option<i128>, Undecodable> {
        struct Walking<'a> {
            of: &'a mut Steps,
            body: &'a [u8],
        }
        impl Walk for Walking<'_> {
            fn walk<B: ByteOrder>(&mut self, reader: &mut CdrReader<'_, B>) -> Result<(), Undecodable> {
                let Steps { walk, lists_of_names, stamp } = &mut *self.of;
                walk.iter_mut().try_for_each(|step| step.walk(self.body, reader, lists_of_names, stamp))
            }
        }
        self.stamp = None;
        let body = message.get(cdr::HEAD..).ok_or(Undecodable)?;
        cdr::walk(message, &mut Walking { of: self, body })?;

        for step in &mut self.walk {
            if let Step::List(list) = step {
                let names = list.names.and_then(|names| self.lists_of_names.get(names));
                list.tell(names, fields);
            }
        }
        Ok(self.stamp)
    }
}

impl Step {
    fn walk<B: ByteOrder>(
        &mut self,
        body: &[u8],
        reader: &mut CdrReader<'_, B>,
        lists_of_names: &mut [Names],
        stamp: &mut Option<i128>,
    ) -> Result<(), Undecodable> {
        match self {
            Self::Run(run) => run.skip(reader),
            Self::Bool(ty) | Self::Text(ty) => cdr::skip(reader, ty),
            Self::Stamp { is_header } => {
                let (seconds, ns) = cdr::stamp(reader)?;
                if *is_header {
                    *stamp = Some(seconds * 1_000_000_000 + ns);
                }
                Ok(())
            }
            Self::Names { of, size, list } => match lists_of_names.get_mut(*list) {
                Some(names) => names.read(body, reader, of, *size).map(|_| ()),
                None => Err(Undecodable),
            },
            Self::List(list) => list.walk(reader),
        }
    }
}

impl List {
    fn walk<B: ByteOrder>(&mut self, reader: &mut CdrReader<'_, B>) -> Result<(), Undecodable> {
        self.count = cdr::length(reader, self.size, &self.of)?;
        cdr::skip_items(reader, &self.of, self.count)
    }

    /// Widens the fields by the list of the last message.
    fn tell(&mut self, names: Option<&Names>, fields: &mut [Field]) {
        let names = names.filter(|names| names.list().len() == self.count && names.version() != self.told);
        for field in fields.get_mut(self.fields.clone()).unwrap_or_default() {
            add(field, Some(self.count), names.map(Names::list).unwrap_or_default());
        }
        self.told = names.map_or(self.told, Names::version);
    }
}

/// Makes the steps, and tells the fields in the order of the wire.
struct Making {
    steps: Vec<Step>,
    lists: usize,
    fields: Vec<Field>,
    /// Fields met, at all and in items of lists: messages within messages may be told without end.
    met: usize,
    items: usize,
}

impl Making {
    /// False when there are too many fields.
    fn message(&mut self, layout: &Layout, path: &mut String) -> bool {
        let names_at = layout.names();
        let mut names = None;
        let outer = path.len();
        for (index, (name, ty)) in layout.fields.iter().enumerate() {
            self.met += 1;
            if self.met > MOST_FIELDS {
                return false;
            }
            if outer > 0 {
                path.push('.');
            }
            path.push_str(name);
            match ty {
                Type::Message(inner) if inner.is_stamp() => {
                    self.tell(path, None);
                    self.steps.push(Step::Stamp { is_header: path == HEADER_STAMP });
                }
                Type::Message(inner) => {
                    if !self.message(inner, path) {
                        return false;
                    }
                }
                Type::Number(_) => {
                    self.tell(path, None);
                    match Run::of(ty) {
                        Some(run) => self.run(run),
                        None => self.steps.push(Step::Bool(ty.clone())),
                    }
                }
                Type::Text | Type::WideText => self.steps.push(Step::Text(ty.clone())),
                Type::List { of, size } if names_at == Some(index) => {
                    names = Some(self.lists);
                    self.lists += 1;
                    self.steps.push(Step::Names { of: (**of).clone(), size: *size, list: self.lists - 1 });
                }
                Type::List { of, size } => {
                    let first = self.fields.len();
                    self.list(of, *size, path);
                    match Run::of(ty).filter(|_| names.is_none()) {
                        // Always of one length, which was told, and without names.
                        Some(run) => self.run(run),
                        None => self.steps.push(Step::List(List {
                            of: (**of).clone(),
                            size: *size,
                            fields: first..self.fields.len(),
                            names,
                            count: 0,
                            told: 0,
                        })),
                    }
                }
            }
            path.truncate(outer);
        }
        true
    }

    fn run(&mut self, run: Run) {
        match self.steps.last_mut() {
            Some(Step::Run(last)) => match last.then(run) {
                Some(both) => *last = both,
                None => self.steps.push(Step::Run(run)),
            },
            _ => self.steps.push(Step::Run(run)),
        }
    }

    /// A list of numbers, or the numeric fields of a list of messages; lists within lists are left out.
    fn list(&mut self, of: &Type, size: Size, path: &mut String) {
        let lengths = if let Size::Fixed(count) = size { (count, count) } else { (usize::MAX, 0) };
        match of {
            Type::Number(_) => self.tell(path, Some(lengths)),
            Type::Message(layout) => {
                let outer = path.len();
                path.push_str("[]");
                self.items(layout, path, lengths);
                path.truncate(outer);
            }
            Type::Text | Type::WideText | Type::List { .. } => {}
        }
    }

    fn items(&mut self, layout: &Layout, path: &mut String, lengths: (usize, usize)) {
        let outer = path.len();
        for (name, ty) in &layout.fields {
            self.items += 1;
            if self.items > MOST_TOLD {
                break;
            }
            path.push('.');
            path.push_str(name);
            match ty {
                Type::Number(_) => self.tell(path, Some(lengths)),
                Type::Message(inner) if inner.is_stamp() => self.tell(path, Some(lengths)),
                Type::Message(inner) => self.items(inner, path, lengths),
                Type::Text | Type::WideText | Type::List { .. } => {}
            }
            path.truncate(outer);
        }
    }

    fn tell(&mut self, path: &str, lengths: Option<(usize, usize)>) {
        if self.fields.len() < MOST_TOLD {
            self.fields.push(Field { path: path.to_owned(), lengths, names: Vec::new() });
        }
    }
}
