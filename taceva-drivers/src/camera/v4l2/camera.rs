//! Sensor whose frames come from a local camera.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use super::kernel::{Camera, FourCc, GivenFormat, PictureFormat, Stream, V4l2Error};
use taceva_core::{
    Deadline, DriverError, ErrorKind, FrameInfo, FrameMut, Interrupt, Sensor, Stamp,
};

use super::KEY;
use super::error::{START, failed, refused};
use super::fixed::Fixed;
use super::frames::Frames;
use super::leds::Leds;
use super::reader::{Picture, Reader};
use crate::camera::CAPTURE;
use crate::camera::crop::Crop;
use crate::camera::jpeg::Pictures;
use crate::link::{Mailbox, Seen};

/// Options for opening a camera.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct V4l2Options {
    pub(super) device: String,
    pub(super) width: u32,
    pub(super) height: u32,
    /// Accepted pixel formats, in order of preference.
    pub(super) pixels: Vec<FourCc>,
    pub(super) rate_hz: Option<f64>,
    pub(super) crop: Crop,
    pub(super) fixed: Fixed,
    pub(super) leds: Leds,
}

/// Local camera that this driver has opened.
#[derive(Debug)]
pub(super) struct LocalCamera {
    options: V4l2Options,
    pictures: Arc<Mailbox<Picture>>,
    /// Camera while it does not stream; `None` during streaming.
    camera: Option<Camera>,
    reader: Option<Reader>,
    frames: Frames,
    settings: BTreeMap<String, String>,
    /// Number that the mailbox gave to the image returned last.
    last: u64,
    /// Number of images that no capture read, because newer images replaced them or the stream lost them.
    missed: u64,
}

const OPEN: &str = "open the camera";
/// Timeout for the first image of a JPEG camera. That image determines the frame format.
const FIRST: Duration = Duration::from_secs(3);

impl LocalCamera {
    /// Opens a camera, sets its image format and fixes its controls. For JPEG, captures one image to determine the frame format.
    pub(super) fn open(options: V4l2Options) -> Result<LocalCamera, DriverError> {
        options.leds.colour()?;
        let (mut camera, given) = options.connect()?;
        let settings = options.fix(&mut camera)?;
        let pictures = Arc::new(Mailbox::default());
        let (camera, frames) = match given.picture.pixels {
            FourCc::MJPG => {
                let (camera, first) = first_picture(camera)?;
                let frames = Pictures::like(&first, options.crop, &KEY)?;
                let sent = frames.sent();
                if (sent.width, sent.height) != (options.width, options.height) {
                    let why = format!(
                        "the camera sends files of {sent}, expected {}×{}",
                        options.width, options.height
                    );
                    return Err(failed(ErrorKind::Protocol, OPEN, why));
                }
                (camera, Frames::Files(frames))
            }
            _ => (camera, Frames::rows(given)),
        };
        Ok(LocalCamera {
            options,
            pictures,
            camera: Some(camera),
            reader: None,
            frames,
            settings,
            last: 0,
            missed: 0,
        })
    }

    fn begin(&mut self) -> Result<(), DriverError> {
        if self.pictures.has_ended() {
            // Reopen a camera that was lost.
            self.reader = None;
            self.camera = None;
            self.pictures.begin_again();
        }
        let mut camera = match self.camera.take() {
            Some(camera) => camera,
            None => {
                let (camera, given) = self.options.connect()?;
                self.frames.check(&given)?;
                camera
            }
        };
        // Another program may have changed the controls.
        self.settings = self.options.fix(&mut camera)?;
        let stream = Stream::start(camera).map_err(refused(START))?;
        (self.last, self.missed) = (self.pictures.posted(), 0);
        let reader = Reader::start(stream, &self.pictures);
        self.reader = Some(reader.map_err(|error| failed(ErrorKind::Internal, START, error))?);
        Ok(())
    }

    fn next(&self, patience: Duration) -> Result<Seen<Picture>, DriverError> {
        self.pictures.next(self.last, patience).map_err(|none| {
            none.while_waiting(&KEY, CAPTURE, || format!("no picture within {patience:?}"))
        })
    }
}

impl V4l2Options {
    /// Sets the controls and LEDs to fixed values. Returns the values read back by name.
    fn fix(&self, camera: &mut Camera) -> Result<BTreeMap<String, String>, DriverError> {
        let mut settings = self.fixed.apply(camera)?;
        self.leds.apply(camera, &mut settings)?;
        Ok(settings)
    }

    /// Opens the camera with the first of the accepted pixel formats that the camera supports, and sets the frame rate.
    fn connect(&self) -> Result<(Camera, GivenFormat), DriverError> {
        let mut camera = Camera::open(&self.device).map_err(refused(OPEN))?;
        let mut unknown = None;
        for pixels in &self.pixels {
            let wanted = PictureFormat {
                width: self.width,
                height: self.height,
                pixels: *pixels,
            };
            match camera.set_format(&wanted) {
                Ok(given) => {
                    if let Some(rate_hz) = self.rate_hz {
                        camera.set_rate(rate_hz).map_err(refused(OPEN))?;
                    }
                    return Ok((camera, given));
                }
                Err(error @ V4l2Error::Format { .. }) => unknown = Some(error),
                Err(error) => return Err(refused(OPEN)(error)),
            }
        }
        match unknown {
            Some(error) => Err(refused(OPEN)(error)),
            None => Err(failed(
                ErrorKind::InvalidArgument,
                OPEN,
                "no pixel format is requested",
            )),
        }
    }
}

/// Captures images until one is undamaged and stops the stream. Returns the camera and that image. Fails if none arrives within [`FIRST`].
fn first_picture(camera: Camera) -> Result<(Camera, Vec<u8>), DriverError> {
    let mut stream = Stream::start(camera).map_err(refused(OPEN))?;
    let began = crate::link::monotonic();
    loop {
        let spent = crate::link::monotonic().saturating_sub(began);
        let Some(left) = FIRST.checked_sub(spent) else {
            let why = format!("no picture within {FIRST:?}");
            return Err(failed(ErrorKind::Timeout, OPEN, why));
        };
        let taken = stream.next(left).map_err(refused(OPEN))?;
        let first = taken.filter(|filled| !filled.is_damaged());
        let first = first.map(|filled| filled.bytes().to_vec());
        if let Some(first) = first {
            return Ok((stream.stop(), first));
        }
    }
}

impl Sensor for LocalCamera {
    fn frame_info(&self) -> FrameInfo {
        self.frames.info(self.options.crop)
    }

    fn start(&mut self, _: Deadline) -> Result<(), DriverError> {
        if self.reader.is_some() && !self.pictures.has_ended() {
            return Ok(());
        }
        self.begin()
    }

    fn capture(&mut self, into: FrameMut<'_>, deadline: Deadline) -> Result<Stamp, DriverError> {
        let info = self.frame_info();
        if into.info() != info {
            let why = format!("a buffer for {}, expected {info}", into.info());
            return Err(failed(ErrorKind::InvalidArgument, CAPTURE, why));
        }
        if self.reader.is_none() {
            let why = "the camera is not started";
            return Err(failed(ErrorKind::InvalidArgument, CAPTURE, why));
        }
        let seen = self.next(deadline.remaining())?;
        self.missed += seen.number - self.last - 1;
        self.last = seen.number;
        let Seen {
            what: picture, at, ..
        } = seen;
        self.frames
            .make(&picture, self.options.crop, self.missed, into)?;
        Ok(Stamp::new(picture.taken.unwrap_or(at), Some(at)))
    }

    fn stop(&mut self) -> Result<(), DriverError> {
        if let Some(reader) = self.reader.take() {
            self.camera = reader.stop();
        }
        Ok(())
    }

    fn is_stamped_by_host(&self) -> bool {
        true
    }

    fn interrupt_handle(&self) -> Option<Arc<dyn Interrupt>> {
        Some(Arc::clone(&self.pictures) as Arc<dyn Interrupt>)
    }

    fn settings(&self) -> BTreeMap<String, String> {
        self.settings.clone()
    }
}
