//! Sensor whose frames come from an MJPEG stream over HTTP.

use std::sync::Arc;
use std::time::Duration;

use taceva_core::{
    Deadline, DriverError, ErrorKind, FrameInfo, FrameMut, Interrupt, Sensor, Stamp, by_count,
    counted,
};

use super::KEY;
use super::camera_clock::CameraClock;
use super::stream::{Picture, Stream};
use super::url::Url;
use crate::camera::CAPTURE;
use crate::camera::crop::Crop;
use crate::camera::jpeg::Pictures;
use crate::camera::preset::Preset;
use crate::link::mailbox::Ending;
use crate::link::{Mailbox, Seen};

/// Camera with an open MJPEG stream over HTTP.
#[derive(Debug)]
pub(super) struct Camera {
    url: Url,
    /// Mailbox of received images. A reconnection keeps the mailbox.
    pictures: Arc<Mailbox<Picture>>,
    /// Current connection to the camera. Dropping the sensor closes the connection.
    stream: Stream,
    frames: Pictures,
    is_running: bool,
    /// Number that the mailbox gave to the image returned last.
    last: u64,
    /// Image file of the last capture; `None` before the first capture and after a failed capture.
    given: Option<Arc<[u8]>>,
    /// Number of images that newer images replaced before a capture read them.
    missed: u64,
    /// Clock of the server, if the server stamps the frames; `None` if a frame is stamped on arrival.
    clock: Option<CameraClock>,
}

/// Timeout for the first image, which determines the size of every frame.
const FIRST: Duration = Duration::from_secs(3);

fn failed(
    kind: ErrorKind,
    doing: &'static str,
    why: impl Into<Box<dyn std::error::Error + Send + Sync>>,
) -> DriverError {
    DriverError::new(kind, &KEY, doing).because(why)
}

fn connected(url: &Url, pictures: &Arc<Mailbox<Picture>>) -> Result<Stream, DriverError> {
    Stream::open(url, pictures)
        .map_err(|error| failed(error.kind(), "connect to the camera", error))
}

impl Camera {
    /// Connects to a camera and waits for its first image. If `is_stamping`, frames have the time stamps of the server.
    pub(super) fn open(
        url: Url,
        preset: Option<&Preset>,
        is_stamping: bool,
    ) -> Result<Camera, DriverError> {
        let pictures = Arc::new(Mailbox::default());
        let stream = connected(&url, &pictures)?;
        let first = next(&pictures, 0, FIRST)?;
        if is_stamping {
            stamped_s(&first.what)?;
        }
        let crop = preset.map_or(Crop::NONE, |preset| {
            preset.crop(preset.width, preset.height)
        });
        let frames = Pictures::like(&first.what.bytes, crop, &KEY)?;
        let sent = frames.sent();
        if let Some(preset) =
            preset.filter(|preset| [preset.width, preset.height] != [sent.width, sent.height])
        {
            let why = format!(
                "the camera sends {sent}, expected {}×{} of {}",
                preset.width, preset.height, preset.title
            );
            return Err(failed(ErrorKind::Protocol, "read its first picture", why));
        }
        Ok(Camera {
            url,
            pictures,
            stream,
            frames,
            is_running: false,
            last: first.number,
            given: None,
            missed: 0,
            clock: is_stamping.then(CameraClock::default),
        })
    }
}

/// Server time of an image, s. Fails if the server did not stamp the image.
fn stamped_s(picture: &Picture) -> Result<f64, DriverError> {
    picture.stamped_s.ok_or_else(|| {
        let why = "the picture has no `X-Timestamp` in seconds, expected by `clock=server`: omit `clock`, or make the server write this header";
        failed(ErrorKind::Protocol, CAPTURE, why)
    })
}

/// Waits for the next image, for at most `patience`.
fn next(
    pictures: &Mailbox<Picture>,
    after: u64,
    patience: Duration,
) -> Result<Seen<Picture>, DriverError> {
    let found = pictures.next(after, patience);
    found.map_err(|none| {
        none.while_waiting(&KEY, CAPTURE, || format!("no frame within {patience:?}"))
    })
}

impl Sensor for Camera {
    fn frame_info(&self) -> FrameInfo {
        self.frames.info()
    }

    fn start(&mut self, _: Deadline) -> Result<(), DriverError> {
        if self.is_running {
            return Ok(());
        }
        if self.pictures.has_ended() {
            // Reconnect to a camera that was lost.
            self.pictures.begin_again();
            match connected(&self.url, &self.pictures) {
                Ok(stream) => self.stream = stream,
                Err(error) => {
                    self.pictures.end(Ending {
                        kind: error.kind(),
                        why: error.to_string(),
                    });
                    return Err(error);
                }
            }
        }
        self.last = self.pictures.posted();
        self.missed = 0;
        self.is_running = true;
        Ok(())
    }

    fn capture(&mut self, into: FrameMut<'_>, deadline: Deadline) -> Result<Stamp, DriverError> {
        let info = self.frame_info();
        if into.info() != info {
            let why = format!("a buffer for {}, expected {info}", into.info());
            return Err(failed(ErrorKind::InvalidArgument, CAPTURE, why));
        }
        if !self.is_running {
            let why = "the camera is not started";
            return Err(failed(ErrorKind::InvalidArgument, CAPTURE, why));
        }
        let seen = next(&self.pictures, self.last, deadline.remaining())?;
        self.missed += seen.number - self.last - 1;
        self.last = seen.number;
        self.given = None;
        let (missed, broken) = (self.missed, seen.what.broken);
        self.frames.decode(&seen.what.bytes, into, || {
            format!(
                "{} {} missed and {broken} {} broken",
                counted(missed, "frame"),
                by_count(missed, "was", "were"),
                by_count(broken, "was", "were")
            )
        })?;
        let began = match &mut self.clock {
            Some(clock) => {
                let placed = clock.place(stamped_s(&seen.what)?, seen.what.began);
                placed.ok_or_else(|| {
                    let why = "the clock of the server stepped by more than 10 s, expected a steady clock: start this command again";
                    failed(ErrorKind::DeviceFault, CAPTURE, why)
                })?
            }
            None => seen.what.began,
        };
        self.given = Some(seen.what.bytes);
        Ok(Stamp::new(began, Some(seen.at)))
    }

    fn sequence(&self) -> Option<u64> {
        Some(self.last)
    }

    fn sent(&self) -> Option<&[u8]> {
        self.frames.as_sent(self.given.as_deref()?)
    }

    fn stop(&mut self) -> Result<(), DriverError> {
        self.is_running = false;
        Ok(())
    }

    fn is_stamped_by_host(&self) -> bool {
        self.clock.is_none()
    }

    fn interrupt_handle(&self) -> Option<Arc<dyn Interrupt>> {
        Some(Arc::clone(&self.pictures) as Arc<dyn Interrupt>)
    }
}
