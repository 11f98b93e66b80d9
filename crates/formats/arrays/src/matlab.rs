//! MATLAB files of version 5 (`save`, `save -v7`), parsed by this module, and of version 7.3, which are HDF5.
//!
//! Lengths of axes are in MATLAB order. A variable of 480×640×20 becomes an array of the same shape, with rows along the first axis.

mod content;
mod element;
mod matrix;
mod variable;
mod variables;
#[cfg(feature = "hdf5")]
mod version_7_3;

use std::ops::Range;
use std::sync::Arc;

use crate::element::ArrayInfo;
use crate::error::Problem;
use crate::inflate::{Inflater, Wrapping};
use crate::limits;
use crate::member_bytes::{Budget, Packed, PackedBytes};
use crate::source::{ByteSource, FileBytes, bytes_of};
use crate::store::{Arrays, Store};
use crate::values::ArrayData;

use element::{Place, TYPE_COMPRESSED, TYPE_MATRIX};
use variable::Variable;
use variables::Found;

/// Size of the header of version 5, bytes: 116 of text, 8 of an offset, 2 of the version, and 2 of the byte order.
const HEADER_BYTES: u64 = 128;

/// Opens a MATLAB file of version 5 or 7.3.
pub(crate) fn open(file: FileBytes) -> Result<Box<dyn Store>, Problem> {
    let header = bytes_of(&file, 0, file.length().min(HEADER_BYTES))?;
    let is_hdf5 = header.starts_with(b"MATLAB 7.3") || header.starts_with(b"\x89HDF");
    if is_hdf5 {
        #[cfg(feature = "hdf5")]
        return Ok(Box::new(version_7_3::Matlab73::open(file)?));
        #[cfg(not(feature = "hdf5"))]
        return Err(Problem::unsupported(
            "a MATLAB file of version 7.3, which is HDF5, but this program was built without HDF5",
            "build the program with the feature `hdf5`, or save the file with `save('x.mat', '-v7')`",
        ));
    }
    let is_big_endian = match header.get(124..128) {
        Some([_, 1, b'I', b'M']) => false,
        Some([1, _, b'M', b'I']) => true,
        _ => {
            return Err(Problem::damaged(
                124,
                "no version and byte order of a MATLAB file",
                "version 5 or 7.3: save it with `save('x.mat', '-v7')`",
            ));
        }
    };
    Ok(Box::new(Matlab5::open(Arc::new(file), is_big_endian)?))
}

/// MATLAB file of version 5.
#[derive(Debug)]
struct Matlab5 {
    variables: Vec<(String, Variable)>,
    refused: Vec<(String, Problem)>,
}

impl Matlab5 {
    fn open(file: Arc<FileBytes>, is_big_endian: bool) -> Result<Matlab5, Problem> {
        let mut found = Found::default();
        let mut budget = Budget::default();
        let mut at = HEADER_BYTES;
        while at + 8 <= file.length() {
            let tag = element::tag(&*file, Place { at, is_big_endian })?;
            match tag.kind {
                TYPE_MATRIX => {
                    let source: Arc<dyn ByteSource> = Arc::clone(&file) as Arc<dyn ByteSource>;
                    found.matrix(&source, Place { at, is_big_endian }, "", 0)?;
                }
                TYPE_COMPRESSED => {
                    let source: Arc<dyn ByteSource> =
                        Arc::new(inflated(&file, &tag, is_big_endian, &mut budget)?);
                    found.matrix(
                        &source,
                        Place {
                            at: 0,
                            is_big_endian,
                        },
                        "",
                        0,
                    )?;
                }
                // An internal element of MATLAB.
                _ => {}
            }
            if found.count() > limits::ARRAYS {
                return Err(Problem::too_large(
                    "variables",
                    found.count(),
                    limits::ARRAYS,
                ));
            }
            // Compressed elements are not padded to 8 bytes.
            at = if tag.kind == TYPE_COMPRESSED {
                tag.end
            } else {
                tag.end.next_multiple_of(8)
            };
        }
        Ok(Matlab5 {
            variables: found.variables,
            refused: found.refused,
        })
    }
}

/// Opens a deflated variable. Its tag states the inflated length.
fn inflated(
    file: &Arc<FileBytes>,
    tag: &element::Tag,
    is_big_endian: bool,
    budget: &mut Budget,
) -> Result<PackedBytes, Problem> {
    let mut inner = [0; 8];
    Inflater::new(tag.data_at..tag.end, Wrapping::Zlib).read(&**file, &mut inner)?;
    let (kind, length) = element::words(inner, is_big_endian);
    if kind != TYPE_MATRIX {
        return Err(Problem::damaged(
            tag.data_at,
            format!("an element of type {kind} in the deflated data"),
            "a matrix, type 14",
        ));
    }
    let member = Packed {
        name: format!("the variable at byte {}", tag.data_at),
        wrapping: Some(Wrapping::Zlib),
        crc32: None,
        at: tag.data_at,
        packed_bytes: tag.end - tag.data_at,
        bytes: 8 + u64::from(length),
    };
    member.check_size()?;
    Ok(PackedBytes::new(file, member, budget))
}

impl Store for Matlab5 {
    fn arrays(&self) -> Arrays {
        let each = self.variables.iter();
        each.map(|(name, variable)| {
            (
                name.clone(),
                ArrayInfo::new(variable.shape().to_vec(), variable.element()),
            )
        })
        .collect()
    }

    fn refused(&self) -> &[(String, Problem)] {
        &self.refused
    }

    fn read(&self, index: usize, rows: Range<u64>) -> Result<ArrayData, Problem> {
        self.variables[index].1.read(rows)
    }
}
