//! Boxes of MP4 and QuickTime files: a size, four letters, and content.

use crate::error::VideoError;
use crate::limits;
use crate::source::Source;

/// Location of a box.
#[derive(Clone, Copy, Debug)]
pub(super) struct BoxAt {
    pub(super) kind: [u8; 4],
    /// Offset of the first byte.
    pub(super) at: u64,
    /// Offset of the content.
    pub(super) body: u64,
    /// Offset after the content.
    pub(super) end: u64,
}

impl BoxAt {
    pub(super) fn size(&self) -> u64 {
        self.end - self.body
    }

    /// Child boxes, which begin after the first `skipped` bytes of the content.
    pub(super) fn boxes<'a>(&self, source: &'a Source, skipped: u64) -> Boxes<'a> {
        Boxes {
            source,
            at: self.body.saturating_add(skipped),
            end: self.end,
            left: limits::INNER_BOXES,
        }
    }

    /// First child box of `kind`.
    pub(super) fn find(
        &self,
        source: &Source,
        kind: &[u8; 4],
    ) -> Result<Option<BoxAt>, VideoError> {
        let mut boxes = self.boxes(source, 0);
        while let Some(inner) = boxes.next()? {
            if &inner.kind == kind {
                return Ok(Some(inner));
            }
        }
        Ok(None)
    }

    /// First child box of `kind`, which is required.
    pub(super) fn need(&self, source: &Source, kind: &[u8; 4]) -> Result<BoxAt, VideoError> {
        self.find(source, kind)?.ok_or_else(|| {
            let (outer, inner) = (self.kind.escape_ascii(), kind.escape_ascii());
            source.damaged(self.at, format!("the box `{outer}` has no `{inner}`"))
        })
    }

    /// Reads the content, at most `limit` bytes.
    pub(super) fn fields(
        &self,
        source: &Source,
        what: &'static str,
        limit: u64,
    ) -> Result<Fields, VideoError> {
        Ok(Fields {
            bytes: source.read(self.body, self.size(), what, limit)?,
            at: 0,
            from: self.body,
        })
    }
}

/// Consecutive boxes in a part of a file.
pub(super) struct Boxes<'a> {
    source: &'a Source,
    at: u64,
    end: u64,
    /// Number of further boxes allowed.
    left: u32,
}

impl<'a> Boxes<'a> {
    /// Boxes of a whole file.
    pub(super) fn of_file(source: &'a Source) -> Boxes<'a> {
        Boxes {
            source,
            at: 0,
            end: source.length(),
            left: limits::OUTER_BOXES,
        }
    }

    /// Next box; `None` if fewer than eight bytes are left.
    pub(super) fn next(&mut self) -> Result<Option<BoxAt>, VideoError> {
        let left = self.end.saturating_sub(self.at);
        if left < 8 {
            return Ok(None);
        }
        self.left = self.left.checked_sub(1).ok_or_else(|| {
            let problem = "too many boxes at one level";
            self.source.damaged(self.at, problem)
        })?;
        let mut head = [0; 8];
        self.source.read_into(self.at, &mut head)?;
        let [s0, s1, s2, s3, kind @ ..] = head;
        let (size, head) = match u32::from_be_bytes([s0, s1, s2, s3]) {
            // To the end of its parent.
            0 => (left, 8),
            1 if left >= 16 => {
                let mut long = [0; 8];
                self.source.read_into(self.at + 8, &mut long)?;
                (u64::from_be_bytes(long), 16)
            }
            size => (u64::from(size), 8),
        };
        if size < head || size > left {
            let problem = format!(
                "the box `{}` states {size} bytes, expected {head} to {left}",
                kind.escape_ascii()
            );
            return Err(self.source.damaged(self.at, problem));
        }
        let found = BoxAt {
            kind,
            at: self.at,
            body: self.at + head,
            end: self.at + size,
        };
        self.at = found.end;
        Ok(Some(found))
    }
}

/// Reader of the content of a box, big-endian.
#[derive(Debug)]
pub(super) struct Fields {
    bytes: Vec<u8>,
    at: usize,
    from: u64,
}

impl Fields {
    /// Offset in the file of the next value.
    pub(super) fn offset(&self) -> u64 {
        self.from + self.at as u64
    }

    /// Number of bytes left.
    pub(super) fn left(&self) -> usize {
        self.bytes.len() - self.at
    }

    /// Next `N` bytes.
    pub(super) fn take<const N: usize>(&mut self, source: &Source) -> Result<[u8; N], VideoError> {
        let taken = self
            .bytes
            .get(self.at..)
            .and_then(|rest| rest.first_chunk::<N>());
        let Some(taken) = taken else {
            return Err(source.damaged(
                self.offset(),
                format!(
                    "the box has {} bytes left, expected {N} or more",
                    self.left()
                ),
            ));
        };
        self.at += N;
        Ok(*taken)
    }

    pub(super) fn byte(&mut self, source: &Source) -> Result<u8, VideoError> {
        Ok(self.take::<1>(source)?[0])
    }

    pub(super) fn u16(&mut self, source: &Source) -> Result<u16, VideoError> {
        Ok(u16::from_be_bytes(self.take(source)?))
    }

    pub(super) fn u32(&mut self, source: &Source) -> Result<u32, VideoError> {
        Ok(u32::from_be_bytes(self.take(source)?))
    }

    pub(super) fn u64(&mut self, source: &Source) -> Result<u64, VideoError> {
        Ok(u64::from_be_bytes(self.take(source)?))
    }

    /// Version of a box that has a version. Skips the flags.
    pub(super) fn version(&mut self, source: &Source) -> Result<u8, VideoError> {
        Ok(self.take::<4>(source)?[0])
    }

    /// Skips `count` bytes.
    pub(super) fn skip(&mut self, source: &Source, count: usize) -> Result<(), VideoError> {
        if count > self.left() {
            return Err(source.damaged(
                self.offset(),
                format!(
                    "the box has {} bytes left, expected {count} or more",
                    self.left()
                ),
            ));
        }
        self.at += count;
        Ok(())
    }

    /// Reads a count of entries of `entry` bytes each. Checks that the entries fit into the box.
    pub(super) fn count(&mut self, source: &Source, entry: usize) -> Result<usize, VideoError> {
        let at = self.offset();
        let count = self.u32(source)?;
        let room = self.left() / entry;
        match usize::try_from(count) {
            Ok(count) if count <= room => Ok(count),
            _ => Err(source.damaged(
                at,
                format!("a table of {count} entries has room for {room}"),
            )),
        }
    }
}
