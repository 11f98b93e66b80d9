//! A recording written anew with frames in another format.

use std::fs::File;
use std::path::Path;

use taceva_core::{Frame, FrameInfo, Progress};

use crate::dataset::Dataset;
use crate::decode::ChannelOrder;
use crate::digest::Digest;
use crate::encode::encode_jpeg;
use crate::error::DatasetError;
use crate::file::write_durable;
use crate::header::{FramesInfo, Header, ReferenceInfo};
use crate::layout;
use crate::staged::{Place, StagedFolder};
use crate::store::{Beside, RecordingFacts, write_table_and_header};
use crate::table::FrameEntry;

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
        Ok(FrameEntry {
            path: relative,
            span: None,
            digest: Digest::of(&bytes),
        })
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
    let frames = header.frames.as_ref().map(|frames| FramesInfo {
        // Frames are decoded into red, green, blue, whatever order they were stored in.
        channel_order: match frames.channel_order {
            ChannelOrder::Gray => ChannelOrder::Gray,
            ChannelOrder::Rgb | ChannelOrder::Bgr => ChannelOrder::Rgb,
        },
        reference: reference.map(|entry| ReferenceInfo {
            path: entry.path,
            sha256: entry.digest,
        }),
        info: FrameInfo {
            format: frames.info.format.of_eight_bits(),
            ..frames.info
        },
        ..frames.clone()
    });
    let facts = RecordingFacts {
        source: header.source,
        clock: header.clock,
        sensor: header.sensor.clone(),
        footprint: header.footprint,
        settings: header.settings.clone(),
    };
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
