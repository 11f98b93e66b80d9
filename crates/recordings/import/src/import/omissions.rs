//! Counts unused frames and unwritten chunks of the files that an import reads.

use std::collections::BTreeMap;
use std::path::Path;

use taceva_arrays::ArrayFormat;

use super::frame_plan::{PlannedFrames, within};
use super::map::{FrameMap, FrameNames};
use super::summary::ImportSummary;
use crate::error::ImportError;
use crate::source_folder::SourceFolder;
use taceva_dataset::internal::add_left_out;

/// Counts frames of arrays and clips that no row uses, and unwritten chunks of arrays. `absent_chunks` contains the counts of arrays other than frames.
pub(super) fn count(
    folder: &SourceFolder,
    maps: &[FrameMap],
    frames: &[PlannedFrames],
    mut absent_chunks: BTreeMap<String, u64>,
    is_filled: bool,
    summary: &mut ImportSummary,
) -> Result<(), ImportError> {
    for (map, planned) in maps.iter().zip(frames) {
        for (pictures, mut rows) in within(planned) {
            rows.dedup_by_key(|(index, _)| *index);
            let mut used: BTreeMap<&Path, u64> = BTreeMap::new();
            for (index, _) in &rows {
                *used.entry(pictures.origin(*index).0).or_default() += 1;
            }
            // A picture in a cell of the table is left out with its row.
            if !matches!(map.names, FrameNames::Bytes(_)) {
                for (path, count) in pictures.files() {
                    let used = used.get(path).copied().unwrap_or_default();
                    let file = folder.inside(path, "");
                    add_left_out(
                        &mut summary.unused_frames,
                        &file,
                        count.saturating_sub(used),
                    );
                }
            }
            for (array, absent) in pictures.absent_chunks()? {
                absent_chunks.insert(folder.inside(pictures.path(), &array), absent);
            }
        }
    }
    let mut unwritten = absent_chunks.iter();
    if let Some((array, count)) = unwritten.find(|(array, _)| !is_filled && is_of_hdf5(array)) {
        return Err(ImportError::request(
            &folder.path().join(array),
            format!(
                "{count} of its chunks were never written, or are lost with a damaged index: write `fill = true` below `map_version` to read their elements as the fill value, usually 0. To find them, run `h5dump -H -p` or read the array by h5py"
            ),
        ));
    }
    for (array, absent) in absent_chunks {
        add_left_out(&mut summary.absent_chunks, &array, absent);
    }
    Ok(())
}

/// True if the array is in an HDF5 file. Writers of zarr, unlike writers of HDF5, omit chunks that contain only the fill value.
fn is_of_hdf5(array: &str) -> bool {
    let ends = array.match_indices('/').map(|(at, _)| at);
    let mut files = ends.filter_map(|end| ArrayFormat::of(Path::new(&array[..end])));
    files.next() == Some(ArrayFormat::Hdf5)
}
