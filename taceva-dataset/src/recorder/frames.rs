//! The frames of a recording: each file and its name are durable before the journal names it.

use std::fs;

use taceva_core::Frame;

use super::Recorder;
use crate::decode::ChannelOrder;
use crate::digest::Digest;
use crate::encode::encode_png;
use crate::error::DatasetError;
use crate::file::{parent_of, sync_folder, write_durable};
use crate::header::FramesInfo;
use crate::layout;
use crate::table::FrameEntry;

impl Recorder {
    /// Writes the frame of the sample in row `number`.
    pub(super) fn write_frame(
        &mut self,
        number: usize,
        frame: &Frame,
    ) -> Result<FrameEntry, DatasetError> {
        let folder = self.path.join(layout::frame_folder(number));
        if self.synced_folder.as_ref() != Some(&folder) {
            // Even where it is there: a killed process leaves names that nobody made durable.
            fs::create_dir_all(&folder).map_err(DatasetError::io("create", &folder))?;
            sync_folder(parent_of(&folder))?;
            sync_folder(&self.path)?;
            self.synced_folder = Some(folder);
        }
        let path = layout::frame_path(number, "png");
        let digest = self.write_image(&path, frame)?;
        Ok(FrameEntry { path, digest })
    }

    /// Writes a frame; its bytes and its name are durable.
    pub(super) fn write_image(
        &self,
        relative: &str,
        frame: &Frame,
    ) -> Result<Digest, DatasetError> {
        let path = self.path.join(relative);
        let bytes = encode_png(frame).map_err(|problem| DatasetError::Image {
            place: None,
            path: path.clone(),
            problem,
        })?;
        write_durable(&path, &bytes)?;
        sync_folder(parent_of(&path))?;
        Ok(Digest::of(&bytes))
    }

    /// What all frames recorded so far share.
    pub(super) fn frames_info(&self) -> Option<FramesInfo> {
        let info = self.frame_info?;
        let is_gray = info.format.samples() == 1;
        Some(FramesInfo {
            count: self.table.frames().iter().flatten().count() as u64,
            info,
            channel_order: if is_gray {
                ChannelOrder::Gray
            } else {
                ChannelOrder::Rgb
            },
            reference: self.reference.clone(),
        })
    }
}
