//! The pictures of a camera, in memory that is shared with the kernel.

use std::time::Duration;

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::io::Errno;

use super::camera::Camera;
use super::error::V4l2Error;
use super::frame_memory::Mapped;
use super::ioctls::{self, Buffer, Request};

/// A camera that streams, until it is stopped or dropped.
#[derive(Debug)]
pub struct Stream {
    camera: Camera,
    buffers: Vec<Mapped>,
}

/// How many pictures may wait: whoever is late by more misses some, which their numbers tell.
const BUFFERS: u32 = 4;
const MICROSECOND_NS: u64 = 1000;

impl Stream {
    /// Begins to stream. A camera that does not is closed, and can be opened again.
    ///
    /// # Errors
    /// [`V4l2Error::Busy`] where another program has it, [`V4l2Error::Gone`] where it was unplugged.
    pub fn start(camera: Camera) -> Result<Stream, V4l2Error> {
        let mut stream = Stream {
            camera,
            buffers: Vec::new(),
        };
        stream.begin()?;
        Ok(stream)
    }

    fn begin(&mut self) -> Result<(), V4l2Error> {
        let doing = "begin to give pictures";
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
            // The field is a number of 32 bits, in the place of an address.
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
            .map_err(|source| V4l2Error::of("give a buffer back", source))
    }

    /// The next picture, waited for as long as `patience`; `None` if none came.
    ///
    /// # Errors
    /// [`V4l2Error::Gone`] where the camera was unplugged.
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
            // Nothing was there after all, or the camera stopped: the first of them that stays is an error.
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

    /// Stops the stream, and gives the camera back.
    pub fn stop(mut self) -> Camera {
        self.end();
        self.camera
    }

    fn end(&mut self) {
        let mut kind = ioctls::CAPTURE;
        let _ = ioctls::stream_off(self.camera.fd(), &mut kind);
        self.buffers.clear();
        // None, which frees them.
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

/// A picture, whose buffer is given back once this is dropped.
#[derive(Debug)]
pub struct Filled<'a> {
    stream: &'a mut Stream,
    taken: Buffer,
}

impl Filled<'_> {
    /// The picture as the camera sent it.
    pub fn bytes(&self) -> &[u8] {
        let index = usize::try_from(self.taken.index).unwrap_or(usize::MAX);
        let used = usize::try_from(self.taken.used).unwrap_or(usize::MAX);
        match self.stream.buffers.get(index) {
            Some(buffer) => buffer.bytes(used),
            None => &[],
        }
    }

    /// The camera's number of the picture, one higher for each that it took: a gap between two is what was missed.
    pub fn number(&self) -> u32 {
        self.taken.number
    }

    /// Whether the camera says that it is damaged.
    pub fn is_damaged(&self) -> bool {
        self.taken.flags & ioctls::DAMAGED != 0
    }

    /// When the picture was taken, by the kernel's stamp on the monotonic clock; `None` where the driver stamps by another clock.
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
        // One that cannot be given back is missing from then on; a camera that is gone says so at the next picture.
        let _ = self.stream.queue(self.taken.index);
    }
}
