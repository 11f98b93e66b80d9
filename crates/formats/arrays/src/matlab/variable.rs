//! Readable variables of a MATLAB file of version 5: matrices of numbers, texts, cells.

use std::ops::Range;

use super::matrix::product;
use crate::block::Block;
use crate::element::Element;
use crate::error::Problem;
use crate::order::c_places;
use crate::values::{ArrayData, ArrayValues};

/// Readable variable.
#[derive(Debug)]
pub(crate) enum Variable {
    /// Numbers, in the narrowest type that can represent the values of the matrix.
    Numbers { element: Element, block: Block },
    /// Rows of a character matrix, each as a text.
    Text { shape: Vec<u64>, lines: Vec<String> },
    /// One variable for each cell, row by row. All have the same shape and type.
    Cells {
        shape: Vec<u64>,
        element: Element,
        cells: Vec<Variable>,
    },
}

impl Variable {
    pub(crate) fn shape(&self) -> &[u64] {
        match self {
            Variable::Numbers { block, .. } => block.shape(),
            Variable::Text { shape, .. } | Variable::Cells { shape, .. } => shape,
        }
    }

    pub(crate) fn element(&self) -> Element {
        match self {
            Variable::Numbers { element, .. } | Variable::Cells { element, .. } => *element,
            Variable::Text { .. } => Element::Text,
        }
    }

    pub(crate) fn read(&self, rows: Range<u64>) -> Result<ArrayData, Problem> {
        let mut shape = self.shape().to_vec();
        if let Some(first) = shape.first_mut() {
            *first = rows.end - rows.start;
        }
        let place = |row: u64| usize::try_from(row).unwrap_or(usize::MAX);
        let values = match self {
            Variable::Numbers { element, block } => {
                block.read(0, rows)?.values.converted(*element)?
            }
            Variable::Text { lines, .. } => {
                ArrayValues::Text(lines[place(rows.start)..place(rows.end)].to_vec())
            }
            Variable::Cells {
                element,
                cells,
                shape,
            } => {
                let each = cells.len() as u64 / shape.first().copied().unwrap_or(1).max(1);
                let mut all: Option<ArrayValues> = None;
                for cell in &cells[place(rows.start * each)..place(rows.end * each)] {
                    let whole = 0..cell.shape().first().copied().unwrap_or(1);
                    let values = cell.read(whole)?.values;
                    match &mut all {
                        None => all = Some(values),
                        Some(all) => all.append(values),
                    }
                }
                all.unwrap_or_else(|| ArrayValues::with_capacity(*element, 0))
            }
        };
        Ok(ArrayData { shape, values })
    }
}

/// Joins cells of the same shape and type to one array. Its first axes are those of the cell matrix. Cells of a single number or text add no further
/// axes.
pub(crate) fn cells_of(shape: &[u64], cells: Vec<Variable>) -> Result<Variable, Problem> {
    let Some(first) = cells.first() else {
        return Err(Problem::unsupported(
            "a matrix without cells",
            "save numbers",
        ));
    };
    let element = first.element();
    let inner = first.shape().to_vec();
    if cells
        .iter()
        .any(|cell| cell.shape() != inner || cell.element() != element)
    {
        return Err(Problem::unsupported(
            "cells of different sizes or classes",
            "save a matrix, or each cell as a separate variable",
        ));
    }
    if product(shape) != Some(cells.len() as u64) {
        return Err(Problem::damaged(
            0,
            format!("{} cells", cells.len()),
            format!("{shape:?}"),
        ));
    }
    let is_single = product(&inner) == Some(1);
    let shape_of_all = if is_single {
        shape.to_vec()
    } else {
        [shape, &inner].concat()
    };
    // Cells are stored column by column.
    let mut placed: Vec<Option<Variable>> = cells.iter().map(|_| None).collect();
    for (cell, place) in cells.into_iter().zip(c_places(shape)) {
        placed[place] = Some(cell);
    }
    Ok(Variable::Cells {
        shape: shape_of_all,
        element,
        cells: placed.into_iter().flatten().collect(),
    })
}
