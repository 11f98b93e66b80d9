//! Sequential reader of a pickle that reads some kilobytes at a time and skips long bytes.

use crate::error::Problem;
use crate::source::{ByteSource, bytes_of};

const WINDOW_BYTES: u64 = 64 << 10;

/// Reader with its position in the source.
#[derive(Debug)]
pub(crate) struct Cursor<'a> {
    source: &'a dyn ByteSource,
    window: Vec<u8>,
    window_at: u64,
    at: u64,
}

impl<'a> Cursor<'a> {
    pub(crate) fn new(source: &'a dyn ByteSource, at: u64) -> Cursor<'a> {
        Cursor {
            source,
            window: Vec::new(),
            window_at: at,
            at,
        }
    }

    /// Offset of the next byte.
    pub(crate) fn at(&self) -> u64 {
        self.at
    }

    fn cut(&self) -> Problem {
        Problem::damaged(self.source.length(), "the end", "the rest of a pickle")
    }

    pub(crate) fn byte(&mut self) -> Result<u8, Problem> {
        let place = usize::try_from(self.at - self.window_at).unwrap_or(usize::MAX);
        let byte = match self.window.get(place) {
            Some(byte) => *byte,
            None => {
                let count = WINDOW_BYTES.min(self.source.length().saturating_sub(self.at));
                self.window = bytes_of(self.source, self.at, count)?;
                self.window_at = self.at;
                *self.window.first().ok_or_else(|| self.cut())?
            }
        };
        self.at += 1;
        Ok(byte)
    }

    pub(crate) fn few<const N: usize>(&mut self) -> Result<[u8; N], Problem> {
        let mut bytes = [0; N];
        for byte in &mut bytes {
            *byte = self.byte()?;
        }
        Ok(bytes)
    }

    /// Reads a little-endian length that has `N` bytes.
    pub(crate) fn length<const N: usize>(&mut self) -> Result<u64, Problem> {
        let bytes = self.few::<N>()?;
        Ok(bytes
            .iter()
            .rev()
            .fold(0, |number, byte| number << 8 | u64::from(*byte)))
    }

    /// Skips `count` bytes. Returns the offset of the first skipped byte.
    pub(crate) fn pass(&mut self, count: u64) -> Result<u64, Problem> {
        let at = self.at;
        let end = at
            .checked_add(count)
            .filter(|end| *end <= self.source.length());
        self.at = end.ok_or_else(|| self.cut())?;
        if self.at - self.window_at > self.window.len() as u64 {
            self.window.clear();
            self.window_at = self.at;
        }
        Ok(at)
    }

    /// Reads a line of at most `most` bytes, without the line end.
    pub(crate) fn line(&mut self, most: usize) -> Result<String, Problem> {
        let start = self.at;
        let mut line = Vec::new();
        loop {
            match self.byte()? {
                b'\n' => {
                    return String::from_utf8(line)
                        .map_err(|_| Problem::damaged(start, "bytes that are not text", "a name"));
                }
                _ if line.len() == most => {
                    return Err(Problem::damaged(start, "a long line", "a name"));
                }
                byte => line.push(byte),
            }
        }
    }
}
