//! Converts stored HDF5 types to layouts of elements.

use hdf5_pure::{Datatype, DatatypeByteOrder, FloatingPointLayout, StringPadding};

use crate::error::Problem;
use crate::fields::{Field, Item};
use crate::limits;
use crate::scalar::{Filler, Kind, Scalar, shown};

/// Layout of an element of a dataset. `reference_bytes` is the size of a reference to a variable-length value.
pub(crate) fn item(datatype: &Datatype, reference_bytes: usize) -> Result<Item, Problem> {
    let mut item = Item {
        bytes: size(datatype, reference_bytes)?,
        fields: Vec::new(),
    };
    add(&mut item, datatype, &Place::default(), reference_bytes, 0)?;
    let bytes = item.bytes;
    let is_inside = |field: &Field| {
        let count = field
            .extent
            .iter()
            .try_fold(1_u64, |count, side| count.checked_mul(*side));
        let width = count.and_then(|count| count.checked_mul(field.scalar.bytes() as u64));
        width
            .and_then(|width| width.checked_add(field.at as u64))
            .is_some_and(|end| end <= bytes as u64)
    };
    match item.fields.iter().find(|field| !is_inside(field)) {
        Some(field) => Err(Problem::damaged(
            field.at as u64,
            format!(
                "field `{}` beyond the end of its record",
                shown(&field.name)
            ),
            format!("the field within {bytes} bytes"),
        )),
        None => Ok(item),
    }
}

/// Position of a type within the element of a dataset.
#[derive(Clone, Debug, Default)]
struct Place {
    name: String,
    at: usize,
    extent: Vec<u64>,
}

fn add(
    item: &mut Item,
    datatype: &Datatype,
    place: &Place,
    reference_bytes: usize,
    depth: usize,
) -> Result<(), Problem> {
    if depth > limits::LITERAL_DEPTH {
        return Err(refused("a type that is nested too deeply"));
    }
    match datatype {
        Datatype::Compound { members, .. } if place.extent.is_empty() => {
            for member in members {
                let at = usize::try_from(member.byte_offset)
                    .ok()
                    .and_then(|at| at.checked_add(place.at));
                let name = if place.name.is_empty() {
                    member.name.clone()
                } else {
                    format!("{}.{}", place.name, member.name)
                };
                let place = Place {
                    name,
                    at: at.ok_or_else(|| refused("a field beyond the record"))?,
                    extent: Vec::new(),
                };
                add(item, &member.datatype, &place, reference_bytes, depth + 1)?;
            }
            Ok(())
        }
        Datatype::Array {
            base_type,
            dimensions,
        } => {
            let mut place = place.clone();
            place
                .extent
                .extend(dimensions.iter().map(|side| u64::from(*side)));
            add(item, base_type, &place, reference_bytes, depth + 1)
        }
        scalar => {
            item.fields.push(Field {
                name: place.name.clone(),
                at: place.at,
                extent: place.extent.clone(),
                scalar: self::scalar(scalar, reference_bytes)?,
            });
            Ok(())
        }
    }
}

fn size(datatype: &Datatype, reference_bytes: usize) -> Result<usize, Problem> {
    let bytes = match datatype {
        Datatype::VariableLength { .. } => reference_bytes as u64,
        other => u64::from(other.type_size()),
    };
    if bytes > limits::ELEMENT_BYTES {
        return Err(Problem::too_large(
            "bytes of one element",
            bytes,
            limits::ELEMENT_BYTES,
        ));
    }
    usize::try_from(bytes).map_err(|_| refused("an element that does not fit in memory"))
}

fn scalar(datatype: &Datatype, reference_bytes: usize) -> Result<Scalar, Problem> {
    let of = |kind: Kind, size: u32, order: &DatatypeByteOrder| {
        let is_big_endian = match order {
            DatatypeByteOrder::LittleEndian => false,
            DatatypeByteOrder::BigEndian => true,
            DatatypeByteOrder::Vax => return None,
        };
        Scalar::new(kind, usize::try_from(size).ok()?, is_big_endian)
    };
    let plain = match datatype {
        Datatype::FixedPoint {
            size,
            byte_order,
            layout,
        } if layout.bit_offset == 0
            && u32::from(layout.bit_precision) == size.saturating_mul(8) =>
        {
            let kind = if layout.signed {
                Kind::Signed
            } else {
                Kind::Unsigned
            };
            of(kind, *size, byte_order)
        }
        Datatype::FloatingPoint {
            size,
            byte_order,
            layout,
        } if is_ieee(*size, *layout) => of(Kind::Float, *size, byte_order),
        Datatype::BitField {
            size,
            byte_order,
            bit_offset: 0,
            ..
        } => of(Kind::Unsigned, *size, byte_order),
        Datatype::String { size, padding, .. } => {
            let filler = match padding {
                StringPadding::NullPad => Filler::Zeros,
                StringPadding::NullTerminate => Filler::FirstZero,
                StringPadding::SpacePad => Filler::Spaces,
            };
            of(Kind::Text(filler), *size, &DatatypeByteOrder::LittleEndian)
        }
        Datatype::Enumeration {
            base_type, members, ..
        } => {
            let mut names: Vec<&str> = members.iter().map(|member| member.name.as_str()).collect();
            names.sort_unstable();
            if names == ["FALSE", "TRUE"] && base_type.type_size() == 1 {
                Scalar::new(Kind::Bool, 1, false)
            } else {
                return scalar(base_type, reference_bytes);
            }
        }
        Datatype::VariableLength {
            is_string: true, ..
        } => Scalar::new(Kind::HeapText, reference_bytes, false),
        Datatype::VariableLength { base_type, .. } if base_type.type_size() == 1 => {
            Scalar::new(Kind::HeapBytes, reference_bytes, false)
        }
        _ => None,
    };
    plain.ok_or_else(|| refused(&format!("elements of {}", kind_name(datatype))))
}

fn is_ieee(size: u32, layout: FloatingPointLayout) -> bool {
    let half = FloatingPointLayout {
        bit_offset: 0,
        bit_precision: 16,
        exponent_location: 10,
        exponent_size: 5,
        mantissa_location: 0,
        mantissa_size: 10,
        exponent_bias: 15,
    };
    match size {
        2 => layout == half,
        4 => layout == FloatingPointLayout::IEEE754_BINARY32,
        8 => layout == FloatingPointLayout::IEEE754_BINARY64,
        _ => false,
    }
}

fn kind_name(datatype: &Datatype) -> &'static str {
    match datatype {
        Datatype::FixedPoint { .. } => "integers of an unsupported width",
        Datatype::FloatingPoint { .. } => {
            "floating-point numbers other than IEEE 754 with 16, 32 or 64 bits"
        }
        Datatype::Time { .. } => "times",
        Datatype::Opaque { .. } => "opaque bytes",
        Datatype::Compound { .. } => "arrays of records within records",
        Datatype::Reference { .. } => "references",
        Datatype::VariableLength { .. } => "lists of variable length",
        _ => "an unsupported type",
    }
}

fn refused(what: &str) -> Problem {
    Problem::unsupported(
        what,
        "write numbers of 8 to 64 bits, strings, records of both, or bytes of variable length (`h5py.vlen_dtype(np.uint8)`)",
    )
}
