//! Compares the unpacked size of chunks with their size in the file.

use crate::limits;

/// Numbers of packed and unpacked bytes of the chunks read in one pass over a file.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Growth {
    packed: u64,
    unpacked: u64,
}

impl Growth {
    /// Counts a chunk before it is unpacked.
    ///
    /// # Errors
    /// Error message if the chunks expand more than those of any real recording, because reading would take hours.
    pub(crate) fn take(&mut self, packed: u64, unpacked: u64) -> Result<(), String> {
        self.packed = self.packed.saturating_add(packed);
        self.unpacked = self.unpacked.saturating_add(unpacked);
        let most = limits::unpacked_bytes(self.packed);
        match self.unpacked <= most {
            true => Ok(()),
            false => Err(format!(
                "{} bytes decompressed so far, {} times the size in the file, at most {most} are accepted: write it with less compression",
                self.unpacked,
                self.unpacked / self.packed.max(1)
            )),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chunks_that_become_far_more_than_they_are_end_a_pass_and_others_do_not() {
        let mut bomb = Growth::default();
        let chunks = (0..100).map(|_| bomb.take(4_000, 64 << 20));
        let accepted = chunks.take_while(Result::is_ok).count();
        assert_eq!(accepted, 2);
        let mut recording = Growth::default();
        for _ in 0..10_000 {
            recording.take(1 << 20, 100 << 20).expect("usual");
        }
    }
}
