//! Zip archive of NumPy arrays (`.npz`).

use std::collections::BTreeSet;
use std::ops::Range;
use std::sync::Arc;

use crate::archive::members;
use crate::error::Problem;
use crate::member_bytes::{Budget, PackedBytes};
use crate::npy::NpyArray;
use crate::scalar::shown;
use crate::source::{ByteSource, FileBytes};
use crate::store::{Arrays, Store};
use crate::values::ArrayData;

/// Arrays of an `.npz` archive.
#[derive(Debug)]
pub(crate) struct Npz {
    arrays: Vec<NpyArray>,
    /// For each listed array, the index of the member and of the field.
    listed: Vec<(usize, usize)>,
    refused: Vec<(String, Problem)>,
}

impl Npz {
    pub(crate) fn open(file: FileBytes) -> Result<Npz, Problem> {
        let file = Arc::new(file);
        let mut names = BTreeSet::new();
        let mut budget = Budget::default();
        let (mut arrays, mut refused) = (Vec::new(), Vec::new());
        for member in members(&*file)? {
            // Other members are notes of the writer.
            let Some(name) = member.name.strip_suffix(".npy").map(str::to_owned) else {
                continue;
            };
            if !names.insert(name.clone()) {
                return Err(Problem::damaged(
                    member.at,
                    format!("a second member `{}`", shown(&name)),
                    "unique names",
                ));
            }
            let source = Arc::new(PackedBytes::new(&file, member, &mut budget));
            let array = NpyArray::open(&name, Arc::clone(&source) as Arc<dyn ByteSource>);
            source.end_listing();
            match array {
                Ok(array) => arrays.push(array),
                Err(reason @ (Problem::Unsupported { .. } | Problem::Global { .. })) => {
                    refused.push((name, reason))
                }
                Err(problem) => {
                    return Err(problem.within(&format!("member `{}.npy`", shown(&name))));
                }
            }
        }
        let fields = arrays.iter().enumerate().flat_map(|(array, fields)| {
            let count = fields.arrays().len();
            (0..count).map(move |field| (array, field))
        });
        let listed = fields.collect();
        Ok(Npz {
            arrays,
            listed,
            refused,
        })
    }
}

impl Store for Npz {
    fn arrays(&self) -> Arrays {
        self.arrays.iter().flat_map(Store::arrays).collect()
    }

    fn refused(&self) -> &[(String, Problem)] {
        &self.refused
    }

    fn read(&self, index: usize, rows: Range<u64>) -> Result<ArrayData, Problem> {
        let (array, field) = self.listed[index];
        self.arrays[array].read(field, rows)
    }
}
