//! Exports the depth maps of tasks: one file for each map, and a column that names the files.

use crate::error::ImportError;
use taceva_dataset::Dataset;
use taceva_dataset::internal::{
    MapForm, layout, parts_of_map, staging::StagedFolder, write_durable,
};
use taceva_dataset::{DatasetError, TaskKind};

/// Files of the depth maps of one task.
pub(super) struct MapFiles {
    /// Name of the column of the task.
    pub(super) column: String,
    /// Folder of the files.
    pub(super) folder: String,
    /// File of each row, relative to the exported folder; `None` for a row without a map.
    pub(super) files: Vec<Option<String>>,
}

/// Writes every depth map of `dataset`: a picture as PNG, other numbers as `.npy` of 32-bit floating point, with NaN for invalid pixels.
pub(super) fn write(
    dataset: &Dataset,
    staged: &StagedFolder,
) -> Result<Vec<MapFiles>, ImportError> {
    let mut written = Vec::new();
    for own in dataset.tasks() {
        let task = own.task();
        let column = task.columns().into_iter().next();
        let Some(column) = column.filter(|_| task.kind == TaskKind::Depth) else {
            continue;
        };
        let folder = format!("{}/{}", layout::MAPS, task.name);
        staged.ensure_folder(layout::MAPS)?;
        staged.ensure_folder(&folder)?;
        let mut files = Vec::new();
        for row in 0..dataset.table().rows() {
            let bytes = dataset.depth_map_bytes(&task.name, row)?;
            let file = bytes.map(|bytes| {
                let damaged = |problem: String| DatasetError::damaged(dataset.path(), problem);
                let (extension, content) = file_of(&bytes).map_err(damaged)?;
                let file = format!("{folder}/{row:06}.{extension}");
                write_durable(&staged.path().join(&file), &content)?;
                Ok::<String, ImportError>(file)
            });
            files.push(file.transpose()?);
        }
        written.push(MapFiles {
            column,
            folder,
            files,
        });
    }
    Ok(written)
}

/// File extension and file content of the depth map that the dataset stores as `bytes`.
fn file_of(bytes: &[u8]) -> Result<(&'static str, Vec<u8>), String> {
    let parts = parts_of_map(bytes)?;
    if parts.form == MapForm::Png {
        return Ok(("png", parts.data.to_vec()));
    }
    let shape = format!("({}, {})", parts.rows, parts.columns);
    let header = format!("{{'descr': '<f4', 'fortran_order': False, 'shape': {shape}, }}");
    // Magic, version and length take 10 bytes; numbers begin at a multiple of 64.
    let length = (header.len() + 11).next_multiple_of(64) - 10;
    let header = format!("{header:<width$}\n", width = length - 1);
    let length = u16::try_from(length).map_err(|_| "a header of a .npy that is too long")?;
    let mut content = [b"\x93NUMPY\x01\x00", &length.to_le_bytes()[..]].concat();
    content.extend(header.into_bytes());
    for (pixel, number) in parts.data.chunks_exact(4).enumerate() {
        match parts.is_invalid(pixel) {
            true => content.extend(f32::NAN.to_le_bytes()),
            false => content.extend(number),
        }
    }
    Ok(("npy", content))
}
