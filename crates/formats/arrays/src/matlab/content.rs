//! Content of a matrix: numbers or characters.

use std::sync::Arc;

use super::element::{TYPE_UTF_8, Tag, content, scalar, tag};
use super::matrix::{Matrix, product};
use super::variable::Variable;
use crate::block::Block;
use crate::element::Element;
use crate::error::Problem;
use crate::fields::Item;
use crate::limits;
use crate::source::ByteSource;

const IS_COMPLEX: u32 = 0x800;
const IS_LOGICAL: u32 = 0x200;

/// Matrix of numbers, whose elements are not read yet.
pub(crate) fn numbers(source: &Arc<dyn ByteSource>, matrix: Matrix) -> Result<Variable, Problem> {
    let element = match matrix.class {
        _ if matrix.flags & IS_COMPLEX != 0 => {
            return Err(Problem::unsupported(
                "complex numbers",
                "save `real(x)` and `imag(x)`",
            ));
        }
        _ if matrix.flags & IS_LOGICAL != 0 => Element::Bool,
        6 => Element::Float(64),
        7 => Element::Float(32),
        8 => Element::Signed(8),
        9 => Element::Unsigned(8),
        10 => Element::Signed(16),
        11 => Element::Unsigned(16),
        12 => Element::Signed(32),
        13 => Element::Unsigned(32),
        14 => Element::Signed(64),
        15 => Element::Unsigned(64),
        class => {
            let kind = match class {
                3 | 17 => "an object, such as a table or a string",
                5 => "a sparse matrix",
                16 => "a function",
                _ => "a variable of an unknown class",
            };
            return Err(Problem::unsupported(
                kind,
                "save a matrix: `full(x)`, `table2array(x)`, `cellstr(x)`",
            ));
        }
    };
    let real = if product(&matrix.shape) == Some(0) {
        // An empty matrix may have no content element.
        Tag {
            kind: 9,
            data_at: matrix.content.at.min(source.length()),
            end: matrix.content.at,
            next: matrix.content.at,
        }
    } else {
        tag(&**source, matrix.content)?
    };
    let stored = scalar(real.kind, matrix.content.is_big_endian);
    let stored = stored.ok_or_else(|| {
        Problem::damaged(
            matrix.content.at,
            format!("an element of type {}", real.kind),
            "numbers",
        )
    })?;
    let item = Item::plain(stored);
    let expected = product(&matrix.shape).and_then(|count| count.checked_mul(item.bytes as u64));
    if expected.is_none_or(|bytes| bytes > real.end.saturating_sub(real.data_at)) {
        return Err(Problem::damaged(
            real.data_at,
            format!(
                "{} bytes for a matrix of {:?}",
                real.end - real.data_at,
                matrix.shape
            ),
            format!("elements of {} bytes", item.bytes),
        ));
    }
    let block = Block::new(Arc::clone(source), real.data_at, matrix.shape, item, true)?;
    Ok(Variable::Numbers { element, block })
}

/// Character matrix, stored column by column. Each row becomes a text.
pub(crate) fn text(source: &dyn ByteSource, matrix: &Matrix) -> Result<Variable, Problem> {
    let lines_count = matrix.shape.first().copied().unwrap_or(0);
    let width = product(matrix.shape.get(1..).unwrap_or(&[])).unwrap_or(u64::MAX);
    let letters = match lines_count.checked_mul(width) {
        Some(0) => Vec::new(),
        _ => letters(source, matrix)?,
    };
    let is_whole = lines_count.checked_mul(width) == Some(letters.len() as u64);
    if !is_whole || lines_count > limits::PICKLED_VALUES {
        return Err(Problem::damaged(
            matrix.content.at,
            format!("{} letters", letters.len()),
            format!("{lines_count} lines of {width}"),
        ));
    }
    let step = usize::try_from(lines_count).unwrap_or(usize::MAX).max(1);
    let lines = (0..step).map(|line| letters.iter().skip(line).step_by(step).collect::<String>());
    let lines: Vec<String> = if lines_count == 0 {
        vec![String::new()]
    } else {
        lines.collect()
    };
    Ok(Variable::Text {
        shape: vec![lines.len() as u64],
        lines,
    })
}

fn letters(source: &dyn ByteSource, matrix: &Matrix) -> Result<Vec<char>, Problem> {
    let tag = tag(source, matrix.content)?;
    let bytes = content(source, &tag)?;
    let wrong = || Problem::unsupported("a string that is not Unicode", "save strings as UTF-8");
    if tag.kind == TYPE_UTF_8 {
        return Ok(std::str::from_utf8(&bytes)
            .map_err(|_| wrong())?
            .chars()
            .collect());
    }
    let stored = scalar(tag.kind, matrix.content.is_big_endian).ok_or_else(wrong)?;
    let count = bytes.len() / stored.bytes();
    let used = bytes[..count * stored.bytes()].to_vec();
    let codes = stored.decode(used, count)?.to_f64().ok_or_else(wrong)?;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "codes of letters; other codes become `None`"
    )]
    let letter = |code: &f64| char::from_u32(*code as u32);
    codes
        .iter()
        .map(letter)
        .collect::<Option<Vec<char>>>()
        .ok_or_else(wrong)
}
