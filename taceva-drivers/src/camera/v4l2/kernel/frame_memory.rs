//! Kernel buffers for images, mapped into this process.
#![expect(
    unsafe_code,
    reason = "the kernel returns the address of its mapped memory"
)]

use std::os::fd::BorrowedFd;
use std::ptr::NonNull;

use rustix::io::Errno;
use rustix::mm::{MapFlags, ProtFlags, mmap, munmap};

/// Read-only mapping of one kernel buffer. Dropping this value removes the mapping.
#[derive(Debug)]
pub(crate) struct Mapped {
    start: NonNull<u8>,
    length: usize,
}

// SAFETY: the value owns its memory, and nothing of it is bound to a thread.
unsafe impl Send for Mapped {}

impl Mapped {
    /// Maps `length` bytes of a kernel buffer, read-only. `offset` identifies the buffer within the device file `camera`.
    pub(crate) fn new(camera: BorrowedFd<'_>, offset: u64, length: usize) -> Result<Mapped, Errno> {
        // SAFETY: the kernel chooses an unused address. The kernel gave the offset and the length for a buffer, and rejects others.
        let start = unsafe {
            mmap(
                std::ptr::null_mut(),
                length,
                ProtFlags::READ,
                MapFlags::SHARED,
                camera,
                offset,
            )
        }?;
        let start = NonNull::new(start.cast()).ok_or(Errno::NOMEM)?;
        Ok(Mapped { start, length })
    }

    /// First `used` bytes of the buffer, or all if it is shorter. The caller has dequeued the buffer, so the kernel does not write to it. The
    /// bytes may be read until the stream queues the buffer again.
    pub(crate) fn bytes(&self, used: usize) -> &[u8] {
        // SAFETY: the mapping is readable until `self` is dropped and at least this long; every byte is a valid `u8`. The caller ensures that the
        // kernel does not write meanwhile.
        unsafe { std::slice::from_raw_parts(self.start.as_ptr(), used.min(self.length)) }
    }
}

impl Drop for Mapped {
    fn drop(&mut self) {
        // SAFETY: this address and length were mapped once, and no slice outlives `self`. An error is impossible for a mapped address.
        let _ = unsafe { munmap(self.start.as_ptr().cast(), self.length) };
    }
}
