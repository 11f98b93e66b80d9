//! Conversion of numbers between types.

use super::ArrayValues;
use crate::element::Element;
use crate::error::Problem;

impl ArrayValues {
    /// Empty list of values of the type `element`, with capacity for `count` values.
    pub(crate) fn with_capacity(element: Element, count: usize) -> ArrayValues {
        match element {
            Element::Bool => ArrayValues::Bool(Vec::with_capacity(count)),
            Element::Unsigned(8) => ArrayValues::U8(Vec::with_capacity(count)),
            Element::Unsigned(16) => ArrayValues::U16(Vec::with_capacity(count)),
            Element::Unsigned(32) => ArrayValues::U32(Vec::with_capacity(count)),
            Element::Unsigned(_) => ArrayValues::U64(Vec::with_capacity(count)),
            Element::Signed(8) => ArrayValues::I8(Vec::with_capacity(count)),
            Element::Signed(16) => ArrayValues::I16(Vec::with_capacity(count)),
            Element::Signed(32) => ArrayValues::I32(Vec::with_capacity(count)),
            Element::Signed(_) => ArrayValues::I64(Vec::with_capacity(count)),
            Element::Float(64) => ArrayValues::F64(Vec::with_capacity(count)),
            Element::Float(_) => ArrayValues::F32(Vec::with_capacity(count)),
            Element::Text => ArrayValues::Text(Vec::with_capacity(count)),
            Element::Bytes => ArrayValues::Bytes(Vec::with_capacity(count)),
        }
    }

    /// Appends elements of the same type. Elements of other types are ignored.
    pub(crate) fn append(&mut self, more: ArrayValues) {
        match (self, more) {
            (ArrayValues::Bool(all), ArrayValues::Bool(more)) => all.extend(more),
            (ArrayValues::U8(all), ArrayValues::U8(more)) => all.extend(more),
            (ArrayValues::U16(all), ArrayValues::U16(more)) => all.extend(more),
            (ArrayValues::U32(all), ArrayValues::U32(more)) => all.extend(more),
            (ArrayValues::U64(all), ArrayValues::U64(more)) => all.extend(more),
            (ArrayValues::I8(all), ArrayValues::I8(more)) => all.extend(more),
            (ArrayValues::I16(all), ArrayValues::I16(more)) => all.extend(more),
            (ArrayValues::I32(all), ArrayValues::I32(more)) => all.extend(more),
            (ArrayValues::I64(all), ArrayValues::I64(more)) => all.extend(more),
            (ArrayValues::F32(all), ArrayValues::F32(more)) => all.extend(more),
            (ArrayValues::F64(all), ArrayValues::F64(more)) => all.extend(more),
            (ArrayValues::Text(all), ArrayValues::Text(more)) => all.extend(more),
            (ArrayValues::Bytes(all), ArrayValues::Bytes(more)) => all.extend(more),
            (_, _) => {}
        }
    }

    /// The same numbers as elements of another type, which must be able to represent them.
    pub(crate) fn converted(self, element: Element) -> Result<ArrayValues, Problem> {
        let wrong =
            || Problem::unsupported(format!("numbers that are not {element}"), "save them again");
        if self.element() == element {
            return Ok(self);
        }
        Ok(match (element, self) {
            (Element::Float(64), other) => ArrayValues::F64(other.to_f64().ok_or_else(wrong)?),
            #[expect(
                clippy::cast_possible_truncation,
                reason = "MATLAB stores a single as whole numbers only if they are exact"
            )]
            (Element::Float(_), other) => {
                let numbers = other.to_f64().ok_or_else(wrong)?;
                ArrayValues::F32(numbers.into_iter().map(|number| number as f32).collect())
            }
            (Element::Bool, other) => {
                let numbers = other.to_f64().ok_or_else(wrong)?;
                ArrayValues::Bool(numbers.into_iter().map(|number| number != 0.0).collect())
            }
            (element, other) => {
                let whole = other.whole().ok_or_else(wrong)?;
                whole_as(element, &whole).ok_or_else(wrong)?
            }
        })
    }

    /// Type of the elements. Floating-point numbers of 16 bits were already converted to 32 bits.
    fn element(&self) -> Element {
        match self {
            ArrayValues::Bool(_) => Element::Bool,
            ArrayValues::U8(_) => Element::Unsigned(8),
            ArrayValues::U16(_) => Element::Unsigned(16),
            ArrayValues::U32(_) => Element::Unsigned(32),
            ArrayValues::U64(_) => Element::Unsigned(64),
            ArrayValues::I8(_) => Element::Signed(8),
            ArrayValues::I16(_) => Element::Signed(16),
            ArrayValues::I32(_) => Element::Signed(32),
            ArrayValues::I64(_) => Element::Signed(64),
            ArrayValues::F32(_) => Element::Float(32),
            ArrayValues::F64(_) => Element::Float(64),
            ArrayValues::Text(_) => Element::Text,
            ArrayValues::Bytes(_) => Element::Bytes,
        }
    }

    fn whole(&self) -> Option<Vec<i128>> {
        fn all<T: Copy + Into<i128>>(values: &[T]) -> Option<Vec<i128>> {
            Some(values.iter().map(|value| (*value).into()).collect())
        }
        match self {
            ArrayValues::U8(values) => all(values),
            ArrayValues::U16(values) => all(values),
            ArrayValues::U32(values) => all(values),
            ArrayValues::U64(values) => all(values),
            ArrayValues::I8(values) => all(values),
            ArrayValues::I16(values) => all(values),
            ArrayValues::I32(values) => all(values),
            ArrayValues::I64(values) => all(values),
            _ => None,
        }
    }
}

fn whole_as(element: Element, whole: &[i128]) -> Option<ArrayValues> {
    fn all<T: TryFrom<i128>>(whole: &[i128]) -> Option<Vec<T>> {
        whole
            .iter()
            .map(|number| T::try_from(*number).ok())
            .collect()
    }
    Some(match element {
        Element::Unsigned(8) => ArrayValues::U8(all(whole)?),
        Element::Unsigned(16) => ArrayValues::U16(all(whole)?),
        Element::Unsigned(32) => ArrayValues::U32(all(whole)?),
        Element::Unsigned(64) => ArrayValues::U64(all(whole)?),
        Element::Signed(8) => ArrayValues::I8(all(whole)?),
        Element::Signed(16) => ArrayValues::I16(all(whole)?),
        Element::Signed(32) => ArrayValues::I32(all(whole)?),
        Element::Signed(64) => ArrayValues::I64(all(whole)?),
        _ => return None,
    })
}
