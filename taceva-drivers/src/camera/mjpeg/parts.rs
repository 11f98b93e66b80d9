//! Splitter of a multipart HTTP body into images. No I/O.

use thiserror::Error;

use super::head::end_of_head;
use crate::text::shown;

/// Splitter of a multipart HTTP body into images. The body may arrive in pieces of any size.
#[derive(Debug)]
pub(super) struct Parts {
    waiting: Vec<u8>,
    /// Two hyphens and the boundary; `None` until the body shows the boundary.
    delimiter: Option<Vec<u8>>,
    within: Within,
    /// Offset in `waiting` up to which the end of the current part was searched.
    searched: usize,
    /// Number of image parts that were dropped because their stated length was wrong.
    broken: u64,
    /// Server time in the head of the current part, s; `None` if the head has none.
    stamped_s: Option<f64>,
}

/// Position of the splitter within a multipart body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Within {
    /// Before the delimiter of the next part.
    Between,
    /// Within the header fields of a part.
    Head,
    /// Within an image. The value is the image length that the head of the part states, bytes; `None` if the head states none.
    Picture(Option<usize>),
}

/// Error: the multipart body is not a stream of images.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub(super) enum PartError {
    #[error("a picture of {found} bytes, expected at most {PICTURE_MAX}")]
    Long { found: usize },
    #[error("the header of a picture is longer than {PART_HEAD_MAX} bytes")]
    Head,
    #[error(
        "no boundary within {SEARCHED_MAX} bytes, expected a line that begins with `--` before every picture"
    )]
    NoBoundary,
    #[error("a part of type `{}`, expected image/jpeg or image/png", shown(.found))]
    Type { found: String },
}

/// Maximum size of an image, bytes.
const PICTURE_MAX: usize = 64 << 20;
const PART_HEAD_MAX: usize = 8 << 10;
/// Number of bytes in which the first boundary line must end if the response head states no boundary. Servers may send text before that line.
const SEARCHED_MAX: usize = 8 << 10;

impl Parts {
    /// Creates a splitter for `boundary`. If `boundary` is `None`, the first line that begins with two hyphens sets the delimiter.
    pub(super) fn new(boundary: Option<&str>) -> Parts {
        Parts {
            waiting: Vec::new(),
            delimiter: boundary.map(|boundary| format!("--{boundary}").into_bytes()),
            within: Within::Between,
            searched: 0,
            broken: 0,
            stamped_s: None,
        }
    }

    /// Appends received bytes of the body to the bytes that wait for the splitter.
    pub(super) fn push(&mut self, bytes: &[u8]) {
        self.waiting.extend_from_slice(bytes);
    }

    /// True if the head or the image of a part has begun and is incomplete.
    pub(super) fn is_within_part(&self) -> bool {
        self.within != Within::Between
    }

    /// Number of image parts that were dropped because their stated length was wrong.
    pub(super) fn broken(&self) -> u64 {
        self.broken
    }

    /// Server time of the image returned last, s; `None` if the server writes none. Valid until the next call of [`next`](Parts::next).
    pub(super) fn stamped_s(&self) -> Option<f64> {
        self.stamped_s
    }

    /// Returns the next complete image; `None` until all its bytes have arrived.
    ///
    /// # Errors
    /// [`PartError`] if the body is not a stream of images. The caller must then close the connection.
    pub(super) fn next(&mut self) -> Result<Option<Vec<u8>>, PartError> {
        loop {
            match self.within {
                Within::Between => {
                    if !self.find_delimiter()? {
                        return Ok(None);
                    }
                    self.within = Within::Head;
                }
                Within::Head => match end_of_head(&self.waiting) {
                    Some(length) => {
                        let lines = String::from_utf8_lossy(&self.waiting[..length]).into_owned();
                        self.waiting.drain(..length);
                        self.within = Within::Picture(announced(&lines)?);
                        self.stamped_s = stamped_s(&lines);
                        self.searched = 0;
                    }
                    None if self.waiting.len() > PART_HEAD_MAX => return Err(PartError::Head),
                    None => return Ok(None),
                },
                Within::Picture(Some(length)) => {
                    let is_whole = self.waiting.len() >= length + ENDING
                        || self.waiting.get(..length).is_some_and(ends_as_pictures_do);
                    if !is_whole {
                        return Ok(None);
                    }
                    let picture: Vec<u8> = self.waiting.drain(..length).collect();
                    self.within = Within::Between;
                    if self.is_at_delimiter() {
                        return Ok(Some(picture));
                    }
                    // The announced length is wrong. Search this part for the next delimiter too, so that only one part is lost.
                    self.broken += 1;
                    self.waiting.splice(..0, picture);
                }
                Within::Picture(None) => {
                    let delimiter = self.delimiter.clone().unwrap_or_default();
                    let Some(at) = self.search(&delimiter) else {
                        if self.waiting.len() > PICTURE_MAX {
                            let found = self.waiting.len();
                            return Err(PartError::Long { found });
                        }
                        return Ok(None);
                    };
                    let picture = without_ending(&self.waiting[..at]).to_vec();
                    self.waiting.drain(..at);
                    self.within = Within::Between;
                    return Ok(Some(picture));
                }
            }
        }
    }

    /// Removes all bytes up to the end of the next delimiter. Returns `false` if no complete delimiter has arrived.
    fn find_delimiter(&mut self) -> Result<bool, PartError> {
        if self.delimiter.is_none() {
            self.delimiter = self.first_delimiter()?;
        }
        let Some(delimiter) = self.delimiter.clone() else {
            return Ok(false);
        };
        self.searched = 0;
        match self.search(&delimiter) {
            Some(at) => {
                self.waiting.drain(..at + delimiter.len());
                Ok(true)
            }
            None => {
                // Keep only bytes that may be the start of a delimiter.
                let kept = self.waiting.len().min(delimiter.len());
                self.waiting.drain(..self.waiting.len() - kept);
                Ok(false)
            }
        }
    }

    /// Delimiter in the first line that begins with two hyphens; `None` until that line has arrived.
    fn first_delimiter(&self) -> Result<Option<Vec<u8>>, PartError> {
        let searched = &self.waiting[..self.waiting.len().min(SEARCHED_MAX)];
        let mut lines = searched.split_inclusive(|byte| *byte == b'\n');
        let found = lines.find(|line| line.starts_with(b"--") && line.ends_with(b"\n"));
        match found {
            Some(line) => {
                let bare = line.trim_ascii_end();
                let hyphens = bare.iter().take_while(|byte| **byte == b'-').count();
                Ok((hyphens < bare.len()).then(|| bare[hyphens - 2..].to_vec()))
            }
            None if self.waiting.len() > SEARCHED_MAX => Err(PartError::NoBoundary),
            None => Ok(None),
        }
    }

    /// Offset of `delimiter` in the waiting bytes. Remembers the search position, so bytes are scanned once.
    fn search(&mut self, delimiter: &[u8]) -> Option<usize> {
        let from = self.searched.min(self.waiting.len());
        let found = self.waiting[from..]
            .windows(delimiter.len().max(1))
            .position(|window| window == delimiter);
        if found.is_none() {
            self.searched = (self.waiting.len() + 1).saturating_sub(delimiter.len());
        }
        found.map(|at| from + at)
    }

    /// True if the waiting bytes, after white space and hyphens, begin with the boundary or with a part of it that has arrived.
    fn is_at_delimiter(&self) -> bool {
        let delimiter = self.delimiter.as_deref().unwrap_or_default();
        let rest = self.waiting.trim_ascii_start();
        let rest = &rest[rest.iter().take_while(|byte| **byte == b'-').count()..];
        let name = delimiter.strip_prefix(b"--").unwrap_or(delimiter);
        let length = rest.len().min(name.len());
        rest[..length] == name[..length]
    }
}

/// Bytes after an image, its line end, that must arrive before the stated length is trusted. An image that ends with the end marker of its
/// format needs none, because some servers delay these bytes until the next image.
const ENDING: usize = 2;

/// True if the image ends with the end marker of JPEG or PNG.
fn ends_as_pictures_do(picture: &[u8]) -> bool {
    picture.ends_with(b"\xff\xd9") || picture.ends_with(b"IEND\xaeB`\x82")
}

/// Image length in the header fields `lines` of a part, bytes; `None` if there is none. Fails for a part that is not an image.
fn announced(lines: &str) -> Result<Option<usize>, PartError> {
    let mut length = None;
    for (name, value) in lines.lines().filter_map(|line| line.split_once(':')) {
        let value = value.trim();
        match name.trim().to_ascii_lowercase().as_str() {
            "content-length" => length = value.parse().ok(),
            "content-type" if !value.to_ascii_lowercase().starts_with("image/") => {
                return Err(PartError::Type {
                    found: value.to_owned(),
                });
            }
            _ => {}
        }
    }
    match length {
        Some(found) if found > PICTURE_MAX => Err(PartError::Long { found }),
        length => Ok(length),
    }
}

/// Server time in the header fields `lines` of a part, such as `X-Timestamp: 1234.567890`, s; `None` if there is none.
fn stamped_s(lines: &str) -> Option<f64> {
    let mut fields = lines.lines().filter_map(|line| line.split_once(':'));
    let (_, value) = fields.find(|(name, _)| name.trim().eq_ignore_ascii_case("x-timestamp"))?;
    let stamped_s: f64 = value.trim().parse().ok()?;
    stamped_s.is_finite().then_some(stamped_s)
}

/// Image without the line end and the hyphens at its end, which belong to the next delimiter.
fn without_ending(picture: &[u8]) -> &[u8] {
    let hyphens = picture
        .iter()
        .rev()
        .take_while(|byte| **byte == b'-')
        .count();
    let picture = &picture[..picture.len() - hyphens];
    picture
        .strip_suffix(b"\r\n")
        .or(picture.strip_suffix(b"\n"))
        .unwrap_or(picture)
}

#[cfg(test)]
mod tests {
    use super::*;

    const PICTURES: [&[u8]; 3] = [
        b"\xff\xd8one\xff\xd9",
        b"\xff\xd8--two\r\n--tw\xff\xd9",
        b"\xff\xd8\xff\xd9",
    ];

    fn stream(boundary: &str, has_lengths: bool) -> Vec<u8> {
        let mut stream = Vec::new();
        for picture in PICTURES {
            let length = match has_lengths {
                true => format!("Content-Length: {}\r\n", picture.len()),
                false => String::new(),
            };
            let head = format!("--{boundary}\r\nContent-Type: image/jpeg\r\n{length}\r\n");
            stream.extend_from_slice(head.as_bytes());
            stream.extend_from_slice(picture);
            stream.extend_from_slice(b"\r\n");
        }
        stream.extend_from_slice(format!("--{boundary}\r\n").as_bytes());
        stream
    }

    fn all(parts: &mut Parts) -> Vec<Vec<u8>> {
        std::iter::from_fn(|| parts.next().expect("good parts")).collect()
    }

    #[test]
    fn pictures_are_the_same_however_the_body_is_split_and_written() {
        for has_lengths in [true, false] {
            for (said, written) in [
                (Some("frame"), "frame"),
                (None, "frame"),
                (Some("frame"), "--frame"),
            ] {
                let stream = stream(written, has_lengths);
                for piece in 1..stream.len() {
                    let mut parts = Parts::new(said);
                    let mut found = Vec::new();
                    for part in stream.chunks(piece) {
                        parts.push(part);
                        found.extend(all(&mut parts));
                    }
                    assert_eq!(found, PICTURES, "pieces of {piece}, {said:?}, {written}");
                    assert_eq!(parts.broken(), 0);
                }
            }
        }
    }

    #[test]
    fn a_picture_that_is_whole_does_not_wait_for_the_next() {
        let mut parts = Parts::new(Some("f"));
        parts.push(b"--f\r\nContent-Length: 4\r\n\r\n\xff\xd8\xff\xd9");
        assert_eq!(all(&mut parts), [PICTURES[2]]);
        parts.push(b"--f\r\nContent-Length: 4\r\n\r\n\xff\xd8\xff\xd9");
        assert_eq!(all(&mut parts), [PICTURES[2]]);
    }

    #[test]
    fn a_picture_has_the_stamp_of_its_own_head() {
        let mut parts = Parts::new(Some("f"));
        for (head, stamped_s) in [
            ("X-Timestamp: 12.5\r\n", Some(12.5)),
            ("", None),
            ("x-timestamp: soon\r\n", None),
        ] {
            let part = format!("--f\r\n{head}Content-Length: 2\r\n\r\nok\r\n");
            parts.push(part.as_bytes());
            assert_eq!(parts.next(), Ok(Some(b"ok".to_vec())));
            assert_eq!(parts.stamped_s(), stamped_s, "{head}");
        }
    }

    #[test]
    fn a_part_that_lies_about_its_length_is_lost_alone() {
        let mut stream = b"--f\r\nContent-Length: 3\r\n\r\nabcdef\r\n".to_vec();
        stream.extend_from_slice(b"--f\r\nContent-Length: 60\r\n\r\nabc\r\n--f\r\n\r\nxyz\r\n");
        stream.extend_from_slice(
            b"--f\r\nContent-Length: 2\r\n\r\nok\r\n--f\r\nContent-Length: 2\r\n\r\nok\r\n--f",
        );
        let mut parts = Parts::new(Some("f"));
        parts.push(&stream);
        let found = all(&mut parts);
        assert!(parts.broken() >= 1);
        assert_eq!(found.last().map(Vec::as_slice), Some(&b"ok"[..]));
    }

    #[test]
    fn what_is_no_stream_of_pictures_ends_it() {
        let ends = |boundary: Option<&str>, bytes: &[u8]| {
            let mut parts = Parts::new(boundary);
            parts.push(bytes);
            parts.next().expect_err("no picture")
        };
        assert_eq!(
            ends(Some("f"), b"--f\r\nContent-Length: 99999999999\r\n\r\n"),
            PartError::Long {
                found: 99_999_999_999
            }
        );
        assert!(matches!(
            ends(Some("f"), b"--f\r\nContent-Type: text/html\r\n\r\n"),
            PartError::Type { .. }
        ));
        let endless = [&b"--f\r\nX: "[..], &[b'x'; PART_HEAD_MAX]].concat();
        assert_eq!(ends(Some("f"), &endless), PartError::Head);
        assert_eq!(ends(None, &[b'x'; SEARCHED_MAX + 1]), PartError::NoBoundary);
    }

    #[test]
    fn text_without_a_boundary_keeps_nothing_waiting() {
        let mut parts = Parts::new(Some("frame"));
        for _ in 0..1000 {
            parts.push(&[b'x'; 1000]);
            assert_eq!(parts.next(), Ok(None));
        }
        assert!(parts.waiting.len() < 100);
    }
}
