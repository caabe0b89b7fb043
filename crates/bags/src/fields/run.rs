//! Numbers one after the other, passed over at once.

use re_cdr::{ByteOrder, CdrReader};

use super::cdr::Undecodable;
use super::schema::{Number, Size, Type};

/// A stretch of numbers without a choice in it: how it is aligned and how long it is from there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Run {
    align: usize,
    bytes: usize,
}

impl Run {
    /// Of a field; `None` where its length is not fixed, where it has to be looked at, or where its padding depends on
    /// its place.
    pub(super) fn of(ty: &Type) -> Option<Self> {
        match ty {
            // One that is neither true nor false does not decode.
            Type::Number(Number::Bool) | Type::Text | Type::WideText => None,
            Type::Number(number) => Some(Self { align: number.size(), bytes: number.size() }),
            Type::Message(layout) => {
                let mut fields = layout.fields.iter().map(|(_, ty)| Self::of(ty));
                let first = fields.next()??;
                fields.try_fold(first, |run, next| run.then(next?))
            }
            Type::List { of, size: Size::Fixed(count @ 1..) } => match **of {
                Type::Number(number) => Some(Self { align: number.size(), bytes: count.checked_mul(number.size())? }),
                _ => None,
            },
            Type::List { .. } => None,
        }
    }

    /// Both together; `None` where the padding between them depends on their place.
    pub(super) fn then(self, next: Self) -> Option<Self> {
        if next.align > self.align {
            return None;
        }
        // Alignments are powers of two, so that where this one is aligned the next one would be.
        let bytes = self.bytes.checked_next_multiple_of(next.align)?.checked_add(next.bytes)?;
        Some(Self { align: self.align, bytes })
    }

    /// Passes over it.
    pub(super) fn skip<B: ByteOrder>(self, reader: &mut CdrReader<'_, B>) -> Result<(), Undecodable> {
        reader.align(self.align)?;
        reader.read_bytes(self.bytes)?;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use re_cdr::LittleEndian;

    use super::super::cdr;
    use super::super::schema::parse;
    use super::*;

    #[test]
    fn a_run_ends_where_its_fields_do_one_by_one() {
        let text = "float64 a\nuint8 b\nint16[3] c\nuint8 d\nfloat32 e\nint64 f";
        let layout = parse("p/T", text).unwrap();
        let run = Run::of(&Type::Message(layout.into())).unwrap();
        let body = [0; 64];
        for start in 0..8 {
            let mut reader = CdrReader::<LittleEndian>::new(&body);
            reader.read_bytes(start).unwrap();
            let mut one_by_one = reader_at(&body, start);
            let layout = parse("p/T", text).unwrap();
            layout.fields.iter().for_each(|(_, ty)| cdr::skip(&mut one_by_one, ty).ok().unwrap());
            run.skip(&mut reader).ok().unwrap();
            assert_eq!(reader.position(), one_by_one.position(), "{start}");
        }
        assert!(run.skip(&mut CdrReader::<LittleEndian>::new(&body[..31])).is_err());
    }

    #[test]
    fn what_depends_on_its_place_is_no_run() {
        for text in ["uint8 a\nfloat64 b", "bool a", "string a", "float64[] a", "float64 a\nbool b"] {
            assert_eq!(Run::of(&Type::Message(parse("p/T", text).unwrap().into())), None, "{text}");
        }
    }

    fn reader_at(body: &[u8], start: usize) -> CdrReader<'_, LittleEndian> {
        cdr::again(body, start).ok().unwrap()
    }
}
