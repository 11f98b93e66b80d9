//! Image stream of a camera, in buffers shared with the kernel.

use std::time::Duration;

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::io::Errno;

use super::camera::Camera;
use super::error::V4l2Error;
use super::frame_memory::Mapped;
use super::ioctls::{self, Buffer, Request};

/// Camera that streams until it is stopped or dropped.
#[derive(Debug)]
pub struct Stream {
    camera: Camera,
    buffers: Vec<Mapped>,
}

/// Number of image buffers. The camera drops images while all buffers wait for the reader, and the image numbers then have gaps.
const BUFFERS: u32 = 4;
const MICROSECOND_NS: u64 = 1000;

impl Stream {
    /// Starts the image stream of `camera`. A failure closes the camera, which can then be opened again.
    ///
    /// # Errors
    /// [`V4l2Error::Busy`] if another program uses the camera, [`V4l2Error::Gone`] if the camera was unplugged.
    pub fn start(camera: Camera) -> Result<Stream, V4l2Error> {
        let mut stream = Stream {
            camera,
            buffers: Vec::new(),
        };
        stream.begin()?;
        Ok(stream)
    }

    fn begin(&mut self) -> Result<(), V4l2Error> {
        let doing = "start streaming";
        let refused = |source| V4l2Error::of(doing, source);
        let mut request = Request {
            count: BUFFERS,
            kind: ioctls::CAPTURE,
            memory: ioctls::SHARED,
            ..Request::default()
        };
        ioctls::request_buffers(self.camera.fd(), &mut request).map_err(refused)?;
        for index in 0..request.count {
            let mut buffer = buffer(index);
            ioctls::query_buffer(self.camera.fd(), &mut buffer).map_err(refused)?;
            let length = usize::try_from(buffer.length).map_err(|_| refused(Errno::NOMEM))?;
            // The offset uses 32 bits of the union with a pointer.
            let offset = buffer.offset & u64::from(u32::MAX);
            let mapped = Mapped::new(self.camera.fd(), offset, length).map_err(refused)?;
            self.buffers.push(mapped);
            self.queue(index)?;
        }
        let mut kind = ioctls::CAPTURE;
        ioctls::stream_on(self.camera.fd(), &mut kind).map_err(refused)
    }

    fn queue(&self, index: u32) -> Result<(), V4l2Error> {
        ioctls::queue(self.camera.fd(), &mut buffer(index))
            .map_err(|source| V4l2Error::of("return a buffer", source))
    }

    /// Waits up to `patience` for the next image; `None` if none arrives in that time, or if a signal interrupts the wait.
    ///
    /// # Errors
    /// [`V4l2Error::Gone`] if the camera was unplugged.
    pub fn next(&mut self, patience: Duration) -> Result<Option<Filled<'_>>, V4l2Error> {
        let doing = "take a picture";
        let timeout = Timespec::try_from(patience).ok();
        let fd = self.camera.fd();
        let mut waiting = [PollFd::from_borrowed_fd(fd, PollFlags::IN)];
        match poll(&mut waiting, timeout.as_ref()) {
            Ok(0) | Err(Errno::INTR) => return Ok(None),
            Ok(_) => {}
            Err(source) => return Err(V4l2Error::of(doing, source)),
        }
        let mut taken = buffer(0);
        match ioctls::take(fd, &mut taken) {
            Ok(()) => {}
            // Spurious wake-up, or the camera stopped. A permanent stop returns an error.
            Err(Errno::AGAIN)
                if !waiting[0]
                    .revents()
                    .intersects(PollFlags::ERR | PollFlags::HUP) =>
            {
                return Ok(None);
            }
            Err(Errno::AGAIN | Errno::INVAL) => return Err(V4l2Error::Gone { doing }),
            Err(source) => return Err(V4l2Error::of(doing, source)),
        }
        Ok(Some(Filled {
            stream: self,
            taken,
        }))
    }

    /// Stops the stream and returns the camera.
    pub fn stop(mut self) -> Camera {
        self.end();
        self.camera
    }

    fn end(&mut self) {
        let mut kind = ioctls::CAPTURE;
        let _ = ioctls::stream_off(self.camera.fd(), &mut kind);
        self.buffers.clear();
        // Requesting 0 buffers frees them.
        let mut none = Request {
            kind: ioctls::CAPTURE,
            memory: ioctls::SHARED,
            ..Request::default()
        };
        let _ = ioctls::request_buffers(self.camera.fd(), &mut none);
    }
}

fn buffer(index: u32) -> Buffer {
    Buffer {
        index,
        kind: ioctls::CAPTURE,
        memory: ioctls::SHARED,
        ..Buffer::default()
    }
}

/// Image in a kernel buffer. Dropping this value returns the buffer to the kernel for a further image.
#[derive(Debug)]
pub struct Filled<'a> {
    stream: &'a mut Stream,
    taken: Buffer,
}

impl Filled<'_> {
    /// Bytes of the image, as the camera sent it.
    pub fn bytes(&self) -> &[u8] {
        let index = usize::try_from(self.taken.index).unwrap_or(usize::MAX);
        let used = usize::try_from(self.taken.used).unwrap_or(usize::MAX);
        match self.stream.buffers.get(index) {
            Some(buffer) => buffer.bytes(used),
            None => &[],
        }
    }

    /// Sequence number of the image. A gap between two numbers means that images were lost.
    pub fn number(&self) -> u32 {
        self.taken.number
    }

    /// True if the camera marks the image as damaged.
    pub fn is_damaged(&self) -> bool {
        self.taken.flags & ioctls::DAMAGED != 0
    }

    /// Kernel time stamp of the image on the monotonic clock; `None` if the kernel's camera driver uses another clock.
    pub fn taken_at(&self) -> Option<Duration> {
        if self.taken.flags & ioctls::CLOCKS != ioctls::MONOTONIC {
            return None;
        }
        let [seconds, microseconds] = self.taken.time.map(u64::try_from);
        let whole = Duration::from_secs(seconds.ok()?);
        Some(whole + Duration::from_nanos(microseconds.ok()?.checked_mul(MICROSECOND_NS)?))
    }
}

impl Drop for Filled<'_> {
    fn drop(&mut self) {
        // A buffer that cannot be queued is lost. A lost camera is reported at the next image.
        let _ = self.stream.queue(self.taken.index);
    }
}
