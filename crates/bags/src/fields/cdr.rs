//! Walking a CDR message (XCDR1, either byte order) by its layout.

use re_cdr::{BigEndian, ByteOrder, CdrReader, LittleEndian};

use super::cell::Cell;
use super::schema::{Layout, Number, Size, Type};

/// A message that does not decode.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Undecodable;

impl From<re_cdr::Error> for Undecodable {
    fn from(_: re_cdr::Error) -> Self {
        Self
    }
}

/// Bytes of encapsulation before a message.
pub(super) const HEAD: usize = 4;
/// Padding that a writer may leave behind a message: up to the next multiple of 4, or of 8.
const PADDING: usize = 7;

/// What a walk does with either byte order.
pub(super) trait Walk {
    fn walk<B: ByteOrder>(&mut self, reader: &mut CdrReader<'_, B>) -> Result<(), Undecodable>;
}

/// Walks a message in its own byte order, and insists that nothing but padding is left.
pub(super) fn walk(message: &[u8], walk: &mut impl Walk) -> Result<(), Undecodable> {
    let (head, body) = message.split_at_checked(HEAD).ok_or(Undecodable)?;
    let left = match head[..2] {
        [0, 0] => run::<BigEndian>(body, walk)?,
        [0, 1] => run::<LittleEndian>(body, walk)?,
        // Parameter lists and XCDR2, which ROS 2 does not write.
        _ => return Err(Undecodable),
    };
    if left > PADDING { Err(Undecodable) } else { Ok(()) }
}

fn run<B: ByteOrder>(body: &[u8], walk: &mut impl Walk) -> Result<usize, Undecodable> {
    let mut reader = CdrReader::<B>::new(body);
    walk.walk(&mut reader)?;
    Ok(reader.remaining())
}

/// A reader of the same message at the same place.
pub(super) fn again<B: ByteOrder>(body: &[u8], position: usize) -> Result<CdrReader<'_, B>, Undecodable> {
    let mut reader = CdrReader::new(body);
    reader.read_bytes(position)?;
    Ok(reader)
}

/// Reads a number.
pub(super) fn number<B: ByteOrder>(reader: &mut CdrReader<'_, B>, number: Number) -> Result<Cell, Undecodable> {
    Ok(match number {
        Number::Bool => Cell::Whole(reader.read_bool()?.into()),
        Number::I8 => Cell::Whole(reader.read_i8()?.into()),
        Number::U8 => Cell::Whole(reader.read_u8()?.into()),
        Number::I16 => Cell::Whole(reader.read_i16()?.into()),
        Number::U16 => Cell::Whole(reader.read_u16()?.into()),
        Number::I32 => Cell::Whole(reader.read_i32()?.into()),
        Number::U32 => Cell::Whole(reader.read_u32()?.into()),
        Number::I64 => Cell::Whole(reader.read_i64()?.into()),
        Number::U64 => Cell::Whole(reader.read_u64()?.into()),
        Number::F32 => Cell::real(reader.read_f32()?.into()),
        Number::F64 => Cell::real(reader.read_f64()?),
    })
}

/// Reads seconds and nanoseconds.
pub(super) fn stamp<B: ByteOrder>(reader: &mut CdrReader<'_, B>) -> Result<(i128, i128), Undecodable> {
    let (seconds, ns) = (i128::from(reader.read_i32()?), i128::from(reader.read_u32()?));
    if ns >= 1_000_000_000 { Err(Undecodable) } else { Ok((seconds, ns)) }
}

/// How many items a list has here; never more than bytes are left for.
pub(super) fn length<B: ByteOrder>(reader: &mut CdrReader<'_, B>, size: Size, of: &Type) -> Result<usize, Undecodable> {
    let count = match size {
        Size::Fixed(count) => count,
        Size::AtMost(_) | Size::Any => reader.read_sequence_length()?,
    };
    let too_many = matches!(size, Size::AtMost(most) if count > most);
    let bytes = count.checked_mul(smallest(of)).ok_or(Undecodable)?;
    if too_many || bytes > reader.remaining() { Err(Undecodable) } else { Ok(count) }
}

/// Fewest bytes of an item; at least one, since no item is empty.
fn smallest(of: &Type) -> usize {
    match of {
        Type::Number(number) => number.size(),
        Type::Text | Type::WideText => 4,
        Type::Message(_) | Type::List { .. } => 1,
    }
}

/// Passes over a field.
pub(super) fn skip<B: ByteOrder>(reader: &mut CdrReader<'_, B>, ty: &Type) -> Result<(), Undecodable> {
    match ty {
        Type::Number(Number::Bool) => {
            reader.read_bool()?;
        }
        Type::Number(number) => skip_numbers(reader, *number, 1)?,
        Type::Text => {
            let length = reader.read_u32()? as usize;
            reader.read_bytes(length)?;
        }
        Type::WideText => return Err(Undecodable),
        Type::Message(layout) => skip_fields(reader, layout)?,
        Type::List { of, size } => {
            let count = length(reader, *size, of)?;
            skip_items(reader, of, count)?;
        }
    }
    Ok(())
}

/// Passes over `count` items of a list.
pub(super) fn skip_items<B: ByteOrder>(
    reader: &mut CdrReader<'_, B>,
    of: &Type,
    count: usize,
) -> Result<(), Undecodable> {
    if let Type::Number(number) = of {
        return skip_numbers(reader, *number, count);
    }
    (0..count).try_for_each(|_| skip(reader, of))
}

fn skip_fields<B: ByteOrder>(reader: &mut CdrReader<'_, B>, layout: &Layout) -> Result<(), Undecodable> {
    layout.fields.iter().try_for_each(|(_, ty)| skip(reader, ty))
}

fn skip_numbers<B: ByteOrder>(reader: &mut CdrReader<'_, B>, number: Number, count: usize) -> Result<(), Undecodable> {
    if count > 0 {
        reader.align(number.size())?;
        reader.read_bytes(count.checked_mul(number.size()).ok_or(Undecodable)?)?;
    }
    Ok(())
}
