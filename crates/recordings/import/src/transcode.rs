//! A recording written anew with frames in another format.

use std::fs::File;
use std::path::Path;

use taceva_core::{Frame, Progress};

use taceva_dataset::ChannelOrder;
use taceva_dataset::Dataset;
use taceva_dataset::DatasetError;
use taceva_dataset::Digest;
use taceva_dataset::FrameEntry;
use taceva_dataset::Header;
use taceva_dataset::ReferenceInfo;
use taceva_dataset::internal::Beside;
use taceva_dataset::internal::encode_jpeg;
use taceva_dataset::internal::layout;
use taceva_dataset::internal::staged::Place;
use taceva_dataset::internal::staged::StagedFolder;
use taceva_dataset::internal::write_durable;
use taceva_dataset::internal::write_table_and_header;

/// Writes `dataset` to a new folder at `path` with each frame as a JPEG of `quality`, from 1 to 100: what a camera with a JPEG stream
/// would have sent. Labels stay as they are; detail that the compression discards is lost, and so is what 16-bit pixels hold beyond
/// 8 bits.
///
/// # Errors
/// Those of [`Dataset::frame`]; [`DatasetError::TargetExists`]; [`DatasetError::Io`];
/// [`DatasetError::Cancelled`].
pub fn write_as_jpeg(
    dataset: &Dataset,
    path: &Path,
    quality: u8,
    progress: &dyn Progress,
) -> Result<Header, DatasetError> {
    let staged = StagedFolder::create(path, Place::Free)?;
    let rows = dataset.table().rows();
    let mut folders = vec![layout::FRAMES.to_owned()];
    folders.extend(layout::frame_folders(0..rows));
    for folder in &folders {
        staged.create_folder(folder)?;
    }
    let write = |relative: String, frame: &Frame| -> Result<FrameEntry, DatasetError> {
        let path = staged.path().join(&relative);
        let bytes = encode_jpeg(frame, quality).map_err(|problem| DatasetError::Image {
            place: None,
            path: path.clone(),
            problem,
        })?;
        write_durable(&path, &bytes)?;
        Ok(FrameEntry::at(relative, Digest::of(&bytes)))
    };
    progress.begin("encode as JPEG", Some(rows as u64));
    let mut entries = Vec::with_capacity(rows);
    for row in 0..rows {
        if progress.is_cancelled() {
            return Err(DatasetError::Cancelled);
        }
        let frame = dataset.frame(row)?;
        let entry = frame.map(|frame| write(layout::frame_path(row, "jpg"), &frame));
        entries.push(entry.transpose()?);
        progress.advance(1);
    }
    progress.end();
    let reference = dataset.reference()?;
    let reference = reference.map(|frame| write(layout::reference_path("jpg"), &frame));
    let reference = reference.transpose()?;
    let header = dataset.header();
    let frames = header.frames.clone().map(|mut frames| {
        // Frames are decoded into red, green, blue, whatever order they were stored in.
        if frames.channel_order == ChannelOrder::Bgr {
            frames.channel_order = ChannelOrder::Rgb;
        }
        frames.reference = reference.map(|entry| ReferenceInfo::new(entry.path, entry.digest));
        frames.info.format = frames.info.format.of_eight_bits();
        frames
    });
    let facts = header.recording_facts();
    if header.signals.is_some() {
        let (from, to) = [dataset.path(), staged.path()]
            .map(|folder| folder.join(layout::SIGNALS))
            .into();
        std::fs::copy(&from, &to).map_err(DatasetError::io("copy", &from))?;
        let copied = File::open(&to).and_then(|file| file.sync_all());
        copied.map_err(DatasetError::io("write", &to))?;
    }
    let table = dataset.table().clone().with_frames(entries);
    let written = write_table_and_header(
        &staged.path().join(layout::SAMPLES),
        &staged.path().join(layout::HEADER),
        &facts,
        (&table, frames),
        Beside {
            extended: header.extended.clone(),
            history: Vec::new(),
            presses: header.presses.clone(),
            unmentioned_columns: header.unmentioned_columns.clone(),
            mapping: header.mapping(),
            left_out: header.left_out.clone(),
            stream: header.stream,
            signals: header.signals.clone(),
        },
    )?;
    staged.put_in_place(&folders)?;
    Ok(written)
}
