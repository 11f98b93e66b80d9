//! Variables of a MATLAB file of version 5, including variables within structures and cells.

use std::sync::Arc;

use super::content::{numbers, text};
use super::element::{Place, content, tag};
use super::matrix::{Matrix, matrix as matrix_at, number, product, text_of};
use super::variable::{Variable, cells_of};
use crate::error::Problem;
use crate::limits;
use crate::source::ByteSource;

const CLASS_CELL: u32 = 1;
const CLASS_STRUCTURE: u32 = 2;
const CLASS_TEXT: u32 = 4;

/// Variables found in a MATLAB file of version 5.
#[derive(Debug, Default)]
pub(crate) struct Found {
    pub(crate) variables: Vec<(String, Variable)>,
    pub(crate) refused: Vec<(String, Problem)>,
    /// Number of matrices within cells and structures.
    inner: u64,
}

impl Found {
    pub(crate) fn count(&self) -> u64 {
        (self.variables.len() + self.refused.len()) as u64
    }

    /// Adds the matrix at `place` to the variables. `within` is the name of the structure that contains it, empty at the top level.
    pub(crate) fn matrix(
        &mut self,
        source: &Arc<dyn ByteSource>,
        place: Place,
        within: &str,
        depth: usize,
    ) -> Result<u64, Problem> {
        let matrix = matrix_at(&**source, place)?;
        let name = match (within, matrix.name.as_str()) {
            ("", name) => name.to_owned(),
            (within, "") => within.to_owned(),
            (within, name) => format!("{within}.{name}"),
        };
        if matrix.class == CLASS_STRUCTURE {
            self.structure(source, &matrix, &name, depth)?;
        } else {
            let next = matrix.next;
            let made = self.variable(source, matrix, depth);
            self.add(name, made)?;
            return Ok(next);
        }
        Ok(matrix.next)
    }

    fn add(&mut self, name: String, made: Result<Variable, Problem>) -> Result<(), Problem> {
        match made {
            Ok(variable) => self.variables.push((name, variable)),
            Err(reason @ Problem::Unsupported { .. }) => self.refused.push((name, reason)),
            Err(problem) => return Err(problem),
        }
        Ok(())
    }

    /// Adds the fields of a structure, each as an array. The fields of an array of structures become cells.
    fn structure(
        &mut self,
        source: &Arc<dyn ByteSource>,
        matrix: &Matrix,
        name: &str,
        depth: usize,
    ) -> Result<(), Problem> {
        check_depth(depth)?;
        let big = matrix.content.is_big_endian;
        let length = tag(&**source, matrix.content)?;
        let width = number(&content(&**source, &length)?, big)
            .and_then(|width| usize::try_from(width).ok())
            .filter(|width| *width > 0);
        let width = width.ok_or_else(|| {
            Problem::damaged(matrix.content.at, "no length of field names", "at least 1")
        })?;
        let names = tag(
            &**source,
            Place {
                at: length.next,
                is_big_endian: big,
            },
        )?;
        let fields: Vec<String> = content(&**source, &names)?
            .chunks_exact(width)
            .map(text_of)
            .collect();
        let count = product(&matrix.shape);
        if count == Some(1) {
            let mut at = names.next;
            for field in &fields {
                at = self.matrix(
                    source,
                    Place {
                        at,
                        is_big_endian: big,
                    },
                    format!("{name}.{field}").trim_start_matches('.'),
                    depth + 1,
                )?;
                self.check_inner(1)?;
            }
            return Ok(());
        }
        let count = count
            .filter(|count| count.saturating_mul(fields.len() as u64) <= limits::PICKLED_VALUES);
        let count = count.ok_or_else(|| {
            Problem::too_large("fields of a structure", u64::MAX, limits::PICKLED_VALUES)
        })?;
        let mut columns: Vec<Vec<Result<Variable, Problem>>> =
            fields.iter().map(|_| Vec::new()).collect();
        let mut at = names.next;
        for _ in 0..count {
            for column in &mut columns {
                let matrix = matrix_at(
                    &**source,
                    Place {
                        at,
                        is_big_endian: big,
                    },
                )?;
                at = matrix.next;
                column.push(self.variable(source, matrix, depth + 1));
            }
        }
        for (field, column) in fields.iter().zip(columns) {
            let made = column
                .into_iter()
                .collect::<Result<Vec<Variable>, Problem>>();
            let made = made.and_then(|cells| cells_of(&matrix.shape, cells));
            self.add(format!("{name}.{field}"), made)?;
        }
        Ok(())
    }

    fn variable(
        &mut self,
        source: &Arc<dyn ByteSource>,
        matrix: Matrix,
        depth: usize,
    ) -> Result<Variable, Problem> {
        self.check_inner(1)?;
        match matrix.class {
            CLASS_CELL => self.cells(source, &matrix, depth),
            CLASS_TEXT => text(&**source, &matrix),
            _ => numbers(source, matrix),
        }
    }

    fn cells(
        &mut self,
        source: &Arc<dyn ByteSource>,
        matrix: &Matrix,
        depth: usize,
    ) -> Result<Variable, Problem> {
        check_depth(depth)?;
        let mut cells = Vec::new();
        let mut at = matrix.content.at;
        while at < matrix.end {
            let cell = matrix_at(
                &**source,
                Place {
                    at,
                    ..matrix.content
                },
            )?;
            at = cell.next;
            cells.push(self.variable(source, cell, depth + 1)?);
        }
        cells_of(&matrix.shape, cells)
    }

    fn check_inner(&mut self, more: u64) -> Result<(), Problem> {
        self.inner += more;
        if self.inner > limits::PICKLED_VALUES {
            return Err(Problem::too_large(
                "matrices within cells and structures",
                self.inner,
                limits::PICKLED_VALUES,
            ));
        }
        Ok(())
    }
}

fn check_depth(depth: usize) -> Result<(), Problem> {
    if depth > limits::LITERAL_DEPTH {
        return Err(Problem::too_large(
            "cells within cells",
            depth as u64,
            limits::LITERAL_DEPTH as u64,
        ));
    }
    Ok(())
}
