//! Groups and datasets of a file. Hard links are followed, but not soft and external links. Recursion through links to a parent group ends at a depth of 16.

use hdf5_pure::{Dataset, File, Group};

use super::element::item;
use super::{Listed, problem, product};
use crate::error::Problem;
use crate::limits;

/// Maximum nesting of groups.
const DEPTH: usize = 16;

/// Groups and datasets found in an HDF5 file.
#[derive(Debug, Default)]
pub(crate) struct Found {
    /// Size of a reference to a variable-length value, bytes.
    reference_bytes: usize,
    pub(crate) groups: Vec<String>,
    pub(crate) datasets: Vec<Listed>,
    /// Unreadable datasets, each with the reason.
    pub(crate) refused: Vec<(String, Problem)>,
}

pub(crate) fn walk(file: &File) -> Result<Found, Problem> {
    let mut found = Found {
        reference_bytes: 8 + usize::from(file.superblock().offset_size),
        ..Found::default()
    };
    found.groups.push("/".to_owned());
    found.group(&file.root(), "", 0)?;
    Ok(found)
}

impl Found {
    fn group(&mut self, group: &Group, path: &str, depth: usize) -> Result<(), Problem> {
        for (name, dataset) in group.iter_datasets().map_err(problem)? {
            let path = format!("{path}/{name}");
            match listed(path.clone(), &dataset, self.reference_bytes) {
                Ok(dataset) => self.datasets.push(dataset),
                Err(reason) => self.refused.push((path, reason)),
            }
            self.check_count()?;
        }
        if depth == DEPTH {
            return Ok(());
        }
        for (name, group) in group.iter_groups().map_err(problem)? {
            let path = format!("{path}/{name}");
            self.groups.push(path.clone());
            self.check_count()?;
            self.group(&group, &path, depth + 1)?;
        }
        Ok(())
    }

    fn check_count(&self) -> Result<(), Problem> {
        let count = (self.groups.len() + self.datasets.len() + self.refused.len()) as u64;
        if count > limits::ARRAYS {
            return Err(Problem::too_large(
                "groups and datasets (links that point back count again)",
                count,
                limits::ARRAYS,
            ));
        }
        Ok(())
    }
}

/// Shape and type of a dataset, or the reason why it cannot be read.
fn listed(path: String, dataset: &Dataset, reference_bytes: usize) -> Result<Listed, Problem> {
    let shape = dataset.shape().map_err(problem)?;
    let datatype = dataset.datatype().map_err(problem)?;
    let item = item(&datatype, reference_bytes)?;
    let row_bytes = product(shape.get(1..).unwrap_or(&[]), item.bytes as u64);
    let row_bytes = row_bytes.filter(|bytes| {
        bytes
            .checked_mul(shape.first().copied().unwrap_or(1))
            .is_some()
    });
    let row_bytes = row_bytes
        .ok_or_else(|| Problem::too_large("bytes of the shape", u64::MAX, limits::READ_BYTES))?;
    Ok(Listed {
        path,
        shape,
        item,
        row_bytes,
    })
}
