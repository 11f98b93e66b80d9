//! Parser for the status line and the header fields of an HTTP response. No I/O.

use taceva_core::ErrorKind;
use thiserror::Error;

use crate::text::shown;

/// Fields of an HTTP response head that determine the decoding of the body.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Head {
    /// Multipart boundary without leading hyphens; `None` if the response head has none.
    pub(super) boundary: Option<String>,
    /// True if the body has chunked transfer encoding.
    pub(super) is_chunked: bool,
}

/// Error: the HTTP response is not a stream of images.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub(super) enum HeadError {
    #[error("its answer is not HTTP: `{}`", shown(.line))]
    NotHttp { line: String },
    #[error("it answers {code}, expected 200: `{}`", shown(.line))]
    Refused { code: u16, line: String },
    #[error("the head of its answer is longer than {HEAD_MAX} bytes")]
    Long,
}

impl HeadError {
    /// Kind of the driver error for this failure.
    pub(super) fn kind(&self) -> ErrorKind {
        match self {
            HeadError::Refused { code: 404, .. } => ErrorKind::NotFound,
            HeadError::Refused {
                code: 401 | 403, ..
            } => ErrorKind::PermissionDenied,
            HeadError::Refused { code: 503, .. } => ErrorKind::Busy,
            _ => ErrorKind::Protocol,
        }
    }
}

/// Maximum length of an HTTP response head, bytes.
pub(super) const HEAD_MAX: usize = 16 << 10;
/// Maximum length of a response line that an error message quotes, bytes.
const SHOWN: usize = 80;

impl Head {
    /// Parses the HTTP response head at the start of `bytes`. Returns the fields and the length of the head; `None` while the head is incomplete.
    pub(super) fn read(bytes: &[u8]) -> Result<Option<(Head, usize)>, HeadError> {
        let is_http = |bytes: &[u8]| {
            let length = bytes.len().min(5);
            bytes[..length] == b"HTTP/"[..length]
        };
        if !is_http(bytes) {
            return Err(HeadError::NotHttp {
                line: first_line(bytes),
            });
        }
        let Some(length) = end_of_head(bytes) else {
            return match bytes.len() > HEAD_MAX {
                true => Err(HeadError::Long),
                false => Ok(None),
            };
        };
        let text = String::from_utf8_lossy(&bytes[..length]);
        let mut lines = text.lines();
        let status = lines.next().unwrap_or_default();
        let code = status.split(' ').nth(1).and_then(|code| code.parse().ok());
        match code {
            Some(200) => {}
            Some(code) => {
                return Err(HeadError::Refused {
                    code,
                    line: first_line(bytes),
                });
            }
            None => {
                return Err(HeadError::NotHttp {
                    line: first_line(bytes),
                });
            }
        }
        let mut head = Head {
            boundary: None,
            is_chunked: false,
        };
        for (name, value) in lines.filter_map(|line| line.split_once(':')) {
            match name.trim().to_ascii_lowercase().as_str() {
                "content-type" => head.boundary = boundary(value),
                "transfer-encoding" => {
                    head.is_chunked = value.to_ascii_lowercase().contains("chunked");
                }
                _ => {}
            }
        }
        Ok(Some((head, length)))
    }
}

/// Length of an HTTP head, bytes, with the empty line at its end. Lines end with CRLF or LF. `None` while the head is incomplete.
pub(super) fn end_of_head(bytes: &[u8]) -> Option<usize> {
    let ends = |mark: &[u8]| {
        let found = bytes.windows(mark.len()).position(|window| window == mark);
        found.map(|at| at + mark.len())
    };
    [ends(b"\r\n\r\n"), ends(b"\n\n")]
        .into_iter()
        .flatten()
        .min()
}

/// Boundary in a content type such as `multipart/x-mixed-replace; boundary="--frame"`. Leading hyphens, which some servers add, are removed.
fn boundary(content_type: &str) -> Option<String> {
    let mut parameters = content_type.split(';').skip(1);
    let found = parameters.find_map(|parameter| {
        let (name, value) = parameter.split_once('=')?;
        name.trim()
            .eq_ignore_ascii_case("boundary")
            .then_some(value)
    })?;
    let bare = found.trim().trim_matches('"').trim_start_matches('-');
    (!bare.is_empty()).then(|| bare.to_owned())
}

fn first_line(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(&bytes[..bytes.len().min(SHOWN)]);
    text.lines().next().unwrap_or_default().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Option<(Head, usize)>, HeadError> {
        Head::read(text.as_bytes())
    }

    #[test]
    fn heads_of_servers_are_read_and_no_more_of_them_than_there_is() {
        let ustreamer = "HTTP/1.0 200 OK\r\nContent-Type: multipart/x-mixed-replace;boundary=boundarydonotcross\r\n\r\n--b";
        let (head, length) = read(ustreamer).expect("good").expect("whole");
        assert_eq!(head.boundary.as_deref(), Some("boundarydonotcross"));
        assert!(!head.is_chunked && ustreamer.len() - length == 3);
        let ffmpeg = "HTTP/1.1 200 OK\r\nContent-Type: application/octet-stream\r\nTransfer-Encoding: Chunked\r\n\r\n";
        let (head, _) = read(ffmpeg).expect("good").expect("whole");
        assert_eq!((head.boundary, head.is_chunked), (None, true));
        let quoted = "HTTP/1.0 200 OK\nContent-type: multipart/x-mixed-replace; x=1; Boundary=\"--my frame\"\n\n";
        let (head, _) = read(quoted).expect("good").expect("whole");
        assert_eq!(head.boundary.as_deref(), Some("my frame"));
        for end in 0..ffmpeg.len() {
            assert_eq!(read(&ffmpeg[..end]), Ok(None), "{end}");
        }
    }

    #[test]
    fn what_is_no_stream_is_refused_by_what_it_said() {
        for (text, kind) in [
            ("SSH-2.0-OpenSSH\r\n", ErrorKind::Protocol),
            ("HTTP/1.1 404 Not Found\r\n\r\n", ErrorKind::NotFound),
            (
                "HTTP/1.1 401 Unauthorized\r\n\r\n",
                ErrorKind::PermissionDenied,
            ),
            (
                "HTTP/1.1 302 Found\r\nLocation: http://x/\r\n\r\n",
                ErrorKind::Protocol,
            ),
            ("HTTP/1.1\r\n\r\n", ErrorKind::Protocol),
        ] {
            assert_eq!(read(text).expect_err(text).kind(), kind, "{text}");
        }
        let endless = format!("HTTP/1.1 200 OK\r\nX: {}", "x".repeat(HEAD_MAX));
        assert_eq!(read(&endless), Err(HeadError::Long));
        let shown = read("\u{1b}[2J").expect_err("no HTTP").to_string();
        assert!(shown.contains("\\u{1b}[2J"), "{shown}");
    }
}
