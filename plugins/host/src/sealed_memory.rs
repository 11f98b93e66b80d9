//! In-memory files that are sealed against changes.

use std::os::fd::AsFd;
use std::thread::sleep;
use std::time::{Duration, Instant};

use rustix::fs::{SealFlags, fcntl_add_seals};
use rustix::io::Errno;

/// Seals that fix contents and size, and forbid changes of the seals.
const ALL: SealFlags = SealFlags::WRITE
    .union(SealFlags::GROW)
    .union(SealFlags::SHRINK)
    .union(SealFlags::SEAL);
/// Retry period for sealing. The kernel fails with `EBUSY` after 0.15 s while it uses a page itself: it moves the page, or a pipe holds it. This
/// happens if memory is short.
const PATIENCE: Duration = Duration::from_secs(5);
const PAUSE: Duration = Duration::from_millis(2);

/// Seals `memory` against every change. Retries while the kernel uses one of its pages.
///
/// # Errors
/// Error of the kernel; `EBUSY` after five seconds or if a writable mapping exists.
pub(crate) fn seal_all(memory: impl AsFd) -> Result<(), Errno> {
    let start = Instant::now();
    loop {
        match fcntl_add_seals(&memory, ALL) {
            Err(Errno::BUSY) if start.elapsed() < PATIENCE => sleep(PAUSE),
            sealed => return sealed,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs::File;
    use std::io::{Read, Write};

    use rustix::fs::{MemfdFlags, memfd_create};
    use rustix::pipe::{SpliceFlags, pipe, splice};

    const BYTES: &[u8] = b"what is sealed";

    fn memory() -> File {
        let flags = MemfdFlags::CLOEXEC | MemfdFlags::ALLOW_SEALING;
        let mut memory = File::from(memfd_create(c"taceva-test", flags).expect("memory"));
        memory.write_all(BYTES).expect("room");
        memory
    }

    #[test]
    fn what_is_sealed_cannot_be_written() {
        let mut memory = memory();
        seal_all(&memory).expect("sealed");
        let refused = memory.write_all(b"more").expect_err("sealed");
        assert_eq!(refused.kind(), std::io::ErrorKind::PermissionDenied);
    }

    #[test]
    fn a_page_that_the_kernel_still_uses_is_waited_for() {
        let memory = memory();
        let (read, write) = pipe().expect("a pipe");
        // The pipe carries the page itself, not a copy.
        let mut from = 0;
        let carried = splice(
            &memory,
            Some(&mut from),
            &write,
            None,
            BYTES.len(),
            SpliceFlags::empty(),
        );
        assert_eq!(carried, Ok(BYTES.len()));
        assert_eq!(fcntl_add_seals(&memory, ALL), Err(Errno::BUSY));
        let emptied = std::thread::spawn(move || {
            sleep(Duration::from_millis(400));
            let mut text = vec![0; BYTES.len()];
            File::from(read).read_exact(&mut text).expect("carried");
            text
        });
        assert_eq!(seal_all(&memory), Ok(()));
        assert_eq!(emptied.join().expect("no panic"), BYTES);
    }
}
