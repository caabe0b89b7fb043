//! Messages of a topic whose fields are known: only what may differ between messages is looked at.

use re_cdr::{ByteOrder, CdrReader};

use super::cdr::{self, Undecodable, Walk};
use super::field::{Field, MOST_TOLD, add};
use super::names::Names;
use super::path::HEADER_STAMP;
use super::run::Run;
use super::schema::{Layout, Size, Type};

/// The way through a message of one layout.
pub(super) struct Known {
    steps: Vec<Step>,
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
    /// Names that the fields have been told, by their version.
    told: u64,
}

impl Known {
    /// The way through messages of a layout, when one was walked field by field, so that it has an end.
    pub(super) fn new(layout: &Layout) -> Self {
        let mut making = Making { steps: Vec::new(), lists: 0, next: 0, items: 0 };
        making.message(layout, &mut String::new());
        let lists_of_names = (0..making.lists).map(|_| Names::default()).collect();
        Self { steps: making.steps, lists_of_names, stamp: None }
    }

    /// Walks a message and updates what is known of its fields; the header's stamp, where there is one.
    pub(super) fn look(&mut self, message: &[u8], fields: &mut [Field]) -> Result<Option<i128>, Undecodable> {
        struct Walking<'a> {
            known: &'a mut Known,
            body: &'a [u8],
            fields: &'a mut [Field],
        }
        impl Walk for Walking<'_> {
            fn walk<B: ByteOrder>(&mut self, reader: &mut CdrReader<'_, B>) -> Result<(), Undecodable> {
                let Known { steps, lists_of_names, stamp } = &mut *self.known;
                steps.iter_mut().try_for_each(|step| step.walk(self.body, reader, lists_of_names, stamp, self.fields))
            }
        }
        self.stamp = None;
        let body = message.get(cdr::HEAD..).ok_or(Undecodable)?;
        cdr::walk(message, &mut Walking { known: self, body, fields })?;
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
        fields: &mut [Field],
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
            Self::List(list) => {
                let names = list.names.and_then(|list| lists_of_names.get(list));
                list.walk(reader, names, fields)
            }
        }
    }
}

impl List {
    fn walk<B: ByteOrder>(
        &mut self,
        reader: &mut CdrReader<'_, B>,
        names: Option<&Names>,
        fields: &mut [Field],
    ) -> Result<(), Undecodable> {
        let count = cdr::length(reader, self.size, &self.of)?;
        cdr::skip_items(reader, &self.of, count)?;
        let names = names.filter(|names| names.list().len() == count && names.version() != self.told);
        for field in fields.get_mut(self.fields.clone()).unwrap_or_default() {
            add(field, Some(count), names.map(Names::list).unwrap_or_default());
        }
        self.told = names.map_or(self.told, Names::version);
        Ok(())
    }
}

/// Makes the steps, and counts the fields in the order in which the walk field by field tells them.
struct Making {
    steps: Vec<Step>,
    lists: usize,
    next: usize,
    items: usize,
}

impl Making {
    fn message(&mut self, layout: &Layout, path: &mut String) {
        let names_at = layout.names();
        let mut names = None;
        let outer = path.len();
        for (index, (name, ty)) in layout.fields.iter().enumerate() {
            if outer > 0 {
                path.push('.');
            }
            path.push_str(name);
            match ty {
                Type::Message(inner) if inner.is_stamp() => {
                    self.next += 1;
                    self.steps.push(Step::Stamp { is_header: path == HEADER_STAMP });
                }
                Type::Message(inner) => self.message(inner, path),
                Type::Number(_) => {
                    self.next += 1;
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
                    let first = self.next;
                    self.next += self.told(of);
                    match Run::of(ty).filter(|_| names.is_none()) {
                        // Always of one length, which was told, and without names.
                        Some(run) => self.run(run),
                        None => self.steps.push(Step::List(List {
                            of: (**of).clone(),
                            size: *size,
                            fields: first.min(MOST_TOLD)..self.next.min(MOST_TOLD),
                            names,
                            told: 0,
                        })),
                    }
                }
            }
            path.truncate(outer);
        }
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

    /// How many fields are told of a list.
    fn told(&mut self, of: &Type) -> usize {
        match of {
            Type::Number(_) => 1,
            Type::Message(layout) => self.items(layout),
            Type::Text | Type::WideText | Type::List { .. } => 0,
        }
    }

    fn items(&mut self, layout: &Layout) -> usize {
        let mut told = 0;
        for (_, ty) in &layout.fields {
            self.items += 1;
            if self.items > MOST_TOLD {
                break;
            }
            told += match ty {
                Type::Number(_) => 1,
                Type::Message(inner) if inner.is_stamp() => 1,
                Type::Message(inner) => self.items(inner),
                Type::Text | Type::WideText | Type::List { .. } => 0,
            };
        }
        told
    }
}
