//! MATLAB files of version 7.3: HDF5 with reversed axes. An attribute states the class of each variable.

use std::ops::Range;
use std::sync::Arc;

use crate::element::{ArrayInfo, Element};
use crate::error::Problem;
use crate::hdf5::Hdf5;
use crate::order::ColumnMajor;
use crate::scalar::Scalar;
use crate::source::{ByteSource, FileBytes};
use crate::store::{Arrays, Store};
use crate::values::{ArrayData, ArrayValues};

/// MATLAB file of version 7.3.
#[derive(Debug)]
pub(crate) struct Matlab73 {
    variables: Vec<Variable>,
    refused: Vec<(String, Problem)>,
}

#[derive(Debug)]
struct Variable {
    name: String,
    shape: Vec<u64>,
    element: Element,
    scalar: Scalar,
    rows: DatasetBytes,
    turned: ColumnMajor,
}

/// Elements of an HDF5 dataset as bytes, row by row.
#[derive(Debug)]
struct DatasetBytes {
    hdf5: Arc<Hdf5>,
    index: usize,
    row_bytes: u64,
    length: u64,
}

/// Groups that MATLAB uses for the content of cells and objects.
const OWN: [&str; 2] = ["/#refs#", "/#subsystem#"];

impl Matlab73 {
    pub(crate) fn open(file: FileBytes) -> Result<Matlab73, Problem> {
        let hdf5 = Arc::new(Hdf5::open(file)?);
        let is_own = |path: &str| {
            OWN.iter().any(|own| {
                path.strip_prefix(own)
                    .is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
            })
        };
        let name_of = |path: &str| path.trim_start_matches('/').replace('/', ".");
        let mut variables = Vec::new();
        let dead = hdf5.nowhere().iter();
        let mut refused: Vec<(String, Problem)> = dead
            .map(|(path, reason)| (name_of(path), reason.again()))
            .collect();
        for (index, dataset) in hdf5
            .datasets()
            .iter()
            .enumerate()
            .filter(|(_, dataset)| !is_own(&dataset.path))
        {
            let name = name_of(&dataset.path);
            let class = hdf5.attribute(&dataset.path, "MATLAB_class");
            let is_empty = hdf5
                .attribute(&dataset.path, "MATLAB_empty")
                .is_some_and(|empty| empty != "0");
            let [field] = dataset.item.fields.as_slice() else {
                refused.push((
                    name,
                    Problem::unsupported(
                        "complex numbers or records",
                        "save `real(x)` and `imag(x)`",
                    ),
                ));
                continue;
            };
            if is_empty || !field.name.is_empty() || field.scalar.heap_text().is_some() {
                refused.push((
                    name,
                    Problem::unsupported(
                        "an empty variable, or a variable that is not a matrix",
                        "save a matrix",
                    ),
                ));
                continue;
            }
            let element = match (class.as_deref(), field.scalar.element()) {
                (Some("logical"), _) => Element::Bool,
                (Some("char"), _) => Element::Text,
                (_, element) => element,
            };
            let shape: Vec<u64> = dataset.shape.iter().rev().copied().collect();
            variables.push(Variable {
                name,
                turned: ColumnMajor::new(&shape, dataset.item.bytes as u64, 0),
                shape: if element == Element::Text {
                    shape.get(..1).unwrap_or(&[]).to_vec()
                } else {
                    shape
                },
                element,
                scalar: field.scalar,
                rows: DatasetBytes {
                    hdf5: Arc::clone(&hdf5),
                    index,
                    row_bytes: dataset.row_bytes,
                    length: dataset
                        .shape
                        .first()
                        .copied()
                        .unwrap_or(1)
                        .saturating_mul(dataset.row_bytes),
                },
            });
        }
        let others = Store::refused(&*hdf5)
            .iter()
            .filter(|(path, _)| !is_own(path));
        refused.extend(others.map(|(path, reason)| {
            let reason = match reason {
                Problem::Unsupported { found, .. } => Problem::unsupported(
                    format!("{found} (a cell or an object)"),
                    "save matrices, or save with `save('x.mat', '-v7')`",
                ),
                other => other.again(),
            };
            (name_of(path), reason)
        }));
        Ok(Matlab73 { variables, refused })
    }
}

impl Store for Matlab73 {
    fn arrays(&self) -> Arrays {
        let each = self.variables.iter();
        each.map(|variable| {
            (
                variable.name.clone(),
                ArrayInfo::new(variable.shape.clone(), variable.element),
            )
        })
        .collect()
    }

    fn refused(&self) -> &[(String, Problem)] {
        &self.refused
    }

    fn read(&self, index: usize, rows: Range<u64>) -> Result<ArrayData, Problem> {
        let variable = &self.variables[index];
        let count = rows.end - rows.start;
        let raw = variable.turned.rows(&variable.rows, rows)?;
        let mut shape = variable.shape.clone();
        if let Some(first) = shape.first_mut() {
            *first = count;
        }
        let elements = raw.len() / variable.scalar.bytes();
        let values = variable.scalar.decode(raw, elements)?;
        let values = if variable.element == Element::Text {
            lines(values, count)?
        } else {
            values.converted(variable.element)?
        };
        Ok(ArrayData { shape, values })
    }
}

/// Converts UTF-16 character codes to `count` lines of equal length.
fn lines(codes: ArrayValues, count: u64) -> Result<ArrayValues, Problem> {
    let wrong = || Problem::unsupported("a string that is not Unicode", "save strings as UTF-8");
    let ArrayValues::U16(codes) = codes else {
        return Err(wrong());
    };
    let width = codes.len() / usize::try_from(count).unwrap_or(usize::MAX).max(1);
    if width == 0 {
        return Ok(ArrayValues::Text(
            (0..count).map(|_| String::new()).collect(),
        ));
    }
    let line = |codes: &[u16]| String::from_utf16(codes).map_err(|_| wrong());
    Ok(ArrayValues::Text(
        codes
            .chunks_exact(width)
            .map(line)
            .collect::<Result<_, _>>()?,
    ))
}

impl ByteSource for DatasetBytes {
    fn length(&self) -> u64 {
        self.length
    }

    fn read_at(&self, at: u64, into: &mut [u8]) -> Result<(), Problem> {
        let end = at + into.len() as u64;
        let (first, last) = (at / self.row_bytes, end.div_ceil(self.row_bytes));
        let raw = self.hdf5.raw_rows(self.index, first..last)?;
        let skipped = usize::try_from(at - first * self.row_bytes).unwrap_or(usize::MAX);
        let wanted = raw.get(skipped..).and_then(|raw| raw.get(..into.len()));
        let wanted =
            wanted.ok_or_else(|| Problem::damaged(at, "the end of a dataset", "more elements"))?;
        into.copy_from_slice(wanted);
        Ok(())
    }
}
