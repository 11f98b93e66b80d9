//! Memory shared by the host and its child. The host allocates the memory. Neither process can change its size.
#![expect(
    unsafe_code,
    reason = "memory is shared by mapping one file in two processes"
)]

use std::os::fd::{AsFd, BorrowedFd, OwnedFd};
use std::ptr::NonNull;

use rustix::fs::{
    MemfdFlags, SealFlags, fcntl_add_seals, fcntl_get_seals, fstat, ftruncate, memfd_create,
};
use rustix::io::Errno;
use rustix::mm::{MapFlags, ProtFlags, mmap, munmap};

/// Seals that fix the size of the memory and forbid changes of the seals.
const SEALS: SealFlags = SealFlags::SHRINK
    .union(SealFlags::GROW)
    .union(SealFlags::SEAL);

/// Memory mapping that another process can map too.
#[derive(Debug)]
pub(crate) struct SharedMemory {
    start: NonNull<u8>,
    length: usize,
    file: OwnedFd,
}

// SAFETY: the mapping belongs to the process, not to a thread; the drop of its only owner unmaps it once.
unsafe impl Send for SharedMemory {}

impl SharedMemory {
    /// Allocates `length` zero bytes. [`file`](SharedMemory::file) gives another process access.
    pub(crate) fn new(length: usize) -> Result<SharedMemory, Errno> {
        let file = memfd_create(
            c"taceva-shared",
            MemfdFlags::CLOEXEC | MemfdFlags::ALLOW_SEALING,
        )?;
        ftruncate(&file, u64::try_from(length).map_err(|_| Errno::FBIG)?)?;
        fcntl_add_seals(&file, SEALS)?;
        SharedMemory::map(file, length)
    }

    /// Maps memory of another process. Fails unless its size is sealed.
    pub(crate) fn attach(file: OwnedFd) -> Result<SharedMemory, Errno> {
        if !fcntl_get_seals(&file)?.contains(SEALS) {
            return Err(Errno::PERM);
        }
        let length = usize::try_from(fstat(&file)?.st_size).map_err(|_| Errno::FBIG)?;
        SharedMemory::map(file, length)
    }

    fn map(file: OwnedFd, length: usize) -> Result<SharedMemory, Errno> {
        // SAFETY: the kernel chooses an address for the new mapping, so it overlaps nothing. Its size is sealed, so no access can fault.
        let start = unsafe {
            mmap(
                std::ptr::null_mut(),
                length,
                ProtFlags::READ | ProtFlags::WRITE,
                MapFlags::SHARED | MapFlags::POPULATE,
                &file,
                0,
            )?
        };
        Ok(SharedMemory {
            start: NonNull::new(start.cast()).ok_or(Errno::NOMEM)?,
            length,
            file,
        })
    }

    /// File with which another process attaches the memory.
    pub(crate) fn file(&self) -> BorrowedFd<'_> {
        self.file.as_fd()
    }

    /// Size, bytes.
    pub(crate) fn length(&self) -> usize {
        self.length
    }

    /// Copies the first `into.len()` bytes. Concurrent writes of the other process change only the copy.
    ///
    /// # Panics
    /// If `into` is longer than the memory.
    pub(crate) fn copy_to(&self, into: &mut [u8]) {
        assert!(
            into.len() <= self.length,
            "a copy of at most the memory's length"
        );
        // SAFETY: both places are valid for `into.len()` bytes, and a borrowed slice cannot overlap a mapping without borrows.
        unsafe { std::ptr::copy_nonoverlapping(self.start.as_ptr(), into.as_mut_ptr(), into.len()) }
    }

    /// Bytes of the memory, for the writing process. The other process reads the bytes after the call has been answered.
    pub(crate) fn bytes_mut(&mut self) -> &mut [u8] {
        // SAFETY: the mapping is valid for `length` bytes while `self` lives. `&mut self` gives exclusive access within this process.
        unsafe { std::slice::from_raw_parts_mut(self.start.as_ptr(), self.length) }
    }
}

impl Drop for SharedMemory {
    fn drop(&mut self) {
        // SAFETY: mapped by `map` with this length, and no reference into it outlives `self`.
        let unmapped = unsafe { munmap(self.start.as_ptr().cast(), self.length) };
        debug_assert!(unmapped.is_ok(), "{unmapped:?}");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rustix::io::fcntl_dupfd_cloexec;

    #[test]
    fn what_one_side_writes_the_other_reads() {
        let ours = SharedMemory::new(10_000).expect("memory");
        let file = fcntl_dupfd_cloexec(ours.file(), 0).expect("a second file");
        let mut theirs = SharedMemory::attach(file).expect("attached");
        assert_eq!(theirs.length(), 10_000);
        theirs.bytes_mut()[9_999] = 7;
        let mut copy = vec![1; 10_000];
        ours.copy_to(&mut copy);
        assert_eq!((copy[0], copy[9_999]), (0, 7));
    }

    #[test]
    fn its_size_cannot_be_changed_and_one_that_can_is_refused() {
        let memory = SharedMemory::new(4096).expect("memory");
        assert_eq!(ftruncate(memory.file(), 0), Err(Errno::PERM));
        assert_eq!(ftruncate(memory.file(), 8192), Err(Errno::PERM));
        let open =
            memfd_create(c"open", MemfdFlags::CLOEXEC | MemfdFlags::ALLOW_SEALING).expect("a file");
        assert_eq!(SharedMemory::attach(open).err(), Some(Errno::PERM));
    }
}
