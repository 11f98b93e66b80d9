//! Decoder of an HTTP body, plain or chunked. No I/O.

use thiserror::Error;

/// Decoder that extracts the HTTP body from the bytes of a connection.
#[derive(Debug)]
pub(super) enum Body {
    /// Body without transfer encoding.
    Plain,
    /// Body with chunked transfer encoding.
    Chunked(Chunks),
}

/// Decoder state within a chunked HTTP body.
#[derive(Debug, Default)]
pub(super) struct Chunks {
    /// Bytes received of an incomplete chunk-size line.
    line: Vec<u8>,
    /// Number of bytes of the current chunk that have not arrived.
    left: usize,
    /// True if the line end after the data of a chunk is expected next.
    is_behind: bool,
    has_ended: bool,
}

/// Error: the HTTP body violates the chunked encoding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("its answer announces chunked encoding but is not chunked")]
pub(super) struct ChunkError;

/// Maximum length of a chunk-size line, bytes.
const LINE_MAX: usize = 256;

impl Body {
    pub(super) fn new(is_chunked: bool) -> Body {
        if is_chunked {
            Body::Chunked(Chunks::default())
        } else {
            Body::Plain
        }
    }

    /// Decodes `bytes` and passes the bytes of the body to `take`. Bytes after the last chunk are ignored.
    ///
    /// # Errors
    /// [`ChunkError`] if a chunk-size line is invalid or too long, or if a chunk does not end with a line end.
    pub(super) fn push(
        &mut self,
        bytes: &[u8],
        mut take: impl FnMut(&[u8]),
    ) -> Result<(), ChunkError> {
        match self {
            Body::Plain => {
                take(bytes);
                Ok(())
            }
            Body::Chunked(chunks) => chunks.push(bytes, take),
        }
    }

    /// True once the last chunk has arrived; always false for a body without chunks.
    pub(super) fn has_ended(&self) -> bool {
        matches!(self, Body::Chunked(chunks) if chunks.has_ended)
    }
}

impl Chunks {
    fn push(&mut self, mut bytes: &[u8], mut take: impl FnMut(&[u8])) -> Result<(), ChunkError> {
        while !bytes.is_empty() && !self.has_ended {
            if self.left > 0 {
                let (of_chunk, rest) = bytes.split_at(bytes.len().min(self.left));
                take(of_chunk);
                self.left -= of_chunk.len();
                self.is_behind = self.left == 0;
                bytes = rest;
                continue;
            }
            let end = bytes.iter().position(|byte| *byte == b'\n');
            let (of_line, rest) = bytes.split_at(end.map_or(bytes.len(), |at| at + 1));
            self.line.extend_from_slice(of_line);
            bytes = rest;
            if self.line.len() > LINE_MAX {
                return Err(ChunkError);
            }
            if end.is_some() {
                self.end_line()?;
            }
        }
        Ok(())
    }

    fn end_line(&mut self) -> Result<(), ChunkError> {
        let line = String::from_utf8_lossy(&self.line).trim().to_owned();
        self.line.clear();
        if std::mem::take(&mut self.is_behind) {
            return if line.is_empty() {
                Ok(())
            } else {
                Err(ChunkError)
            };
        }
        let length = line.split(';').next().unwrap_or_default().trim();
        // `from_str_radix` accepts a sign, which is invalid here.
        if !length.chars().all(|digit| digit.is_ascii_hexdigit()) {
            return Err(ChunkError);
        }
        self.left = usize::from_str_radix(length, 16).map_err(|_| ChunkError)?;
        self.has_ended = self.left == 0;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn whole(stream: &[u8], piece: usize) -> Result<Vec<u8>, ChunkError> {
        let mut body = Body::new(true);
        let mut found = Vec::new();
        for part in stream.chunks(piece) {
            body.push(part, |bytes| found.extend_from_slice(bytes))?;
        }
        Ok(found)
    }

    #[test]
    fn chunks_are_joined_however_they_are_split() {
        let stream = b"5;x=1\r\nhello\r\n3\r\n\r\n!\r\nA\r\n0123456789\r\n0\r\n\r\nbehind";
        for piece in 1..stream.len() {
            let found = whole(stream, piece).expect("good chunks");
            assert_eq!(found, b"hello\r\n!0123456789", "in pieces of {piece}");
        }
    }

    #[test]
    fn what_is_no_length_is_an_error() {
        for stream in [
            &b"xyz\r\n"[..],
            b"-1\r\n",
            b"+5\r\nhello",
            b"\r\n",
            b"5\r\nhelloworld\r\n",
            b"ffffffffffffffffff\r\n",
            &[b'1'; 300],
        ] {
            assert_eq!(whole(stream, 7), Err(ChunkError));
        }
    }
}
