//! Pictures of an export, with the original bytes if the form allows it.

use taceva_core::{Frame, PixelFormat};

use super::form::ExportForm;
use crate::error::ImportError;
use taceva_dataset::internal::{ImageKind, encode_png};
use taceva_dataset::{ChannelOrder, Dataset, DatasetError, ReducedFrames};

/// Pictures of a dataset with at least one picture.
pub(super) struct Pictures<'a> {
    dataset: &'a Dataset,
    /// Colour order in the exported files.
    pub(super) order: ChannelOrder,
    /// True if every picture is encoded again; false if only pictures stored as differences are encoded again.
    is_anew: bool,
    /// True if the form stores pixels instead of image files.
    is_pixels: bool,
}

/// Picture as an image file.
pub(super) struct Encoded {
    pub(super) bytes: Vec<u8>,
    pub(super) extension: &'static str,
}

impl<'a> Pictures<'a> {
    pub(super) fn of(dataset: &'a Dataset, form: ExportForm) -> Option<Pictures<'a>> {
        let frames = dataset.header().frames.as_ref();
        // A lone picture without contact belongs to no sample.
        let frames = frames.filter(|frames| frames.count > 0)?;
        // Other programs expect RGB order. Beside CSV, the map states the order.
        let is_turned = frames.channel_order == ChannelOrder::Bgr;
        let mut entries = dataset.table().frames().iter().flatten();
        let is_anew =
            is_turned && (form != ExportForm::Csv || entries.any(|entry| entry.is_difference()));
        Some(Pictures {
            dataset,
            order: match is_anew {
                true => ChannelOrder::Rgb,
                false => frames.channel_order,
            },
            is_anew,
            is_pixels: form == ExportForm::Hdf5,
        })
    }

    /// Name of the view, if samples have several pictures.
    pub(super) fn view(&self) -> Option<String> {
        self.dataset.view()
    }

    /// `name`, followed by the name of the view if there are several.
    pub(super) fn named(&self, name: &str) -> String {
        match self.view() {
            None => name.to_owned(),
            Some(view) => format!("{name}_{view}"),
        }
    }

    /// Reduction of the pictures that was applied before they were recorded.
    pub(super) fn reduced(&self) -> Option<&ReducedFrames> {
        self.dataset.header().frames.as_ref()?.reduced.as_ref()
    }

    /// Number of pictures.
    pub(super) fn count(&self) -> u64 {
        self.dataset.table().frames().iter().flatten().count() as u64
    }

    /// Number of pictures that are encoded again.
    pub(super) fn encoded_anew(&self) -> u64 {
        let entries = self.dataset.table().frames().iter().flatten();
        let anew = entries.filter(|entry| self.is_pixels || self.is_anew || entry.is_difference());
        anew.count() as u64
    }

    /// Picture of a row as an image file; `None` if the row has no picture.
    pub(super) fn encoded(&self, row: usize) -> Result<Option<Encoded>, ImportError> {
        let Some(entry) = &self.dataset.table().frames()[row] else {
            return Ok(None);
        };
        if self.is_anew || entry.is_difference() {
            let frame = self.dataset.frame(row)?;
            return frame.map(|frame| self.png(&frame, &entry.path)).transpose();
        }
        let bytes = self.dataset.frame_bytes(entry)?;
        Ok(Some(Encoded::of(bytes)))
    }

    /// Picture without contact as an image file; `None` if the dataset has none.
    pub(super) fn reference(&self) -> Result<Option<Encoded>, ImportError> {
        let header = self.dataset.header();
        let reference = header
            .frames
            .as_ref()
            .and_then(|frames| frames.reference.as_ref());
        let Some(reference) = reference else {
            return Ok(None);
        };
        if self.is_anew {
            let frame = self.dataset.reference()?;
            return frame
                .map(|frame| self.png(&frame, &reference.path))
                .transpose();
        }
        let bytes = self.dataset.reference_bytes()?;
        Ok(bytes.map(Encoded::of))
    }

    /// Decoded picture of a row, for forms in which each row needs a picture.
    pub(super) fn frame(&self, row: usize) -> Result<Frame, ImportError> {
        let frame = self.dataset.frame(row)?;
        frame.ok_or_else(|| self.none(row))
    }

    /// Error for a row without a picture, in forms in which each row needs a picture.
    pub(super) fn none(&self, row: usize) -> ImportError {
        let problem = "no picture, and this format needs pictures for all samples or none; use `--format huggingface` or `csv`";
        DatasetError::sample(&self.dataset.table().samples()[row], problem).into()
    }

    /// Size and format of each picture.
    pub(super) fn info(&self) -> Option<taceva_core::FrameInfo> {
        self.dataset
            .header()
            .frames
            .as_ref()
            .map(|frames| frames.info)
    }

    /// Number of colour channels per pixel.
    pub(super) fn colours(&self) -> usize {
        self.info()
            .map_or(PixelFormat::Rgb8.samples(), |info| info.format.samples())
    }

    fn png(&self, frame: &Frame, path: &str) -> Result<Encoded, ImportError> {
        let bytes = encode_png(frame)
            .map_err(|problem| ImportError::image(&self.dataset.path().join(path), problem))?;
        Ok(Encoded::of(bytes))
    }
}

impl Encoded {
    fn of(bytes: Vec<u8>) -> Encoded {
        let kind = ImageKind::of(&bytes).unwrap_or(ImageKind::Png);
        Encoded {
            bytes,
            extension: kind.extension(),
        }
    }
}
