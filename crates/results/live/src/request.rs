//! Reads HTTP requests from a socket, and limits their size, number of headers and time.

use std::io::{self, Read};
use std::net::{Shutdown, TcpStream};
use std::time::{Duration, Instant};

use crate::response::Status;

/// Maximum size of a request head, bytes.
const HEAD_MAX: usize = 8192;
/// Maximum number of header lines.
const HEADERS_MAX: usize = 32;
/// Maximum size of a request body, bytes. Answers to questions are shorter.
const BODY_MAX: usize = 1024;
/// Timeout for a whole request.
const WHOLE: Duration = Duration::from_secs(5);
/// Timeout for one read from the socket.
const READING: Duration = Duration::from_millis(250);

/// Complete HTTP request.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Request {
    pub(crate) method: String,
    pub(crate) path: String,
    pub(crate) host: Option<Vec<u8>>,
    pub(crate) origin: Option<Vec<u8>>,
    pub(crate) token: Option<Vec<u8>>,
    pub(crate) body: Vec<u8>,
}

/// Reads one request. An error is the status for the response.
pub(crate) fn read(stream: &mut TcpStream) -> Result<Request, Status> {
    let began = Instant::now();
    stream
        .set_read_timeout(Some(READING))
        .map_err(|_| Status::BadRequest)?;
    let mut bytes = Vec::new();
    loop {
        if let Some(head) = Head::parse(&bytes)? {
            let Head {
                mut request,
                length,
                body,
            } = head;
            let whole = length + body;
            while bytes.len() < whole {
                more(stream, &mut bytes, began)?;
            }
            request.body = bytes[length..whole].to_vec();
            return Ok(request);
        }
        if bytes.len() > HEAD_MAX {
            return Err(Status::HeadTooLarge);
        }
        more(stream, &mut bytes, began)?;
    }
}

/// Reads and discards further bytes of a rejected client for a moment. Closing a connection with unread bytes would discard the response.
pub(crate) fn drain(mut stream: TcpStream) -> io::Result<()> {
    const MOMENT: Duration = Duration::from_millis(500);
    stream.shutdown(Shutdown::Write)?;
    let began = Instant::now();
    let mut read = [0; 2048];
    while began.elapsed() < MOMENT && stream.read(&mut read)? > 0 {}
    Ok(())
}

/// Appends the next bytes of the socket to `bytes`, or fails after the timeout since `began`.
fn more(stream: &mut TcpStream, bytes: &mut Vec<u8>, began: Instant) -> Result<(), Status> {
    let mut read = [0; 2048];
    loop {
        if began.elapsed() > WHOLE {
            return Err(Status::TimedOut);
        }
        match stream.read(&mut read) {
            Ok(0) => return Err(Status::BadRequest),
            Ok(count) => {
                bytes.extend_from_slice(&read[..count]);
                return Ok(());
            }
            Err(error) => match error.kind() {
                io::ErrorKind::WouldBlock
                | io::ErrorKind::TimedOut
                | io::ErrorKind::Interrupted => {}
                _ => return Err(Status::BadRequest),
            },
        }
    }
}

/// Parsed head of a request.
struct Head {
    request: Request,
    /// Size of the head, bytes.
    length: usize,
    /// Size of the body, bytes.
    body: usize,
}

impl Head {
    /// Parses the head at the start of `bytes`; `None` if `bytes` end before the end of the head.
    fn parse(bytes: &[u8]) -> Result<Option<Head>, Status> {
        let mut headers = [httparse::EMPTY_HEADER; HEADERS_MAX];
        let mut parsed = httparse::Request::new(&mut headers);
        let length = match parsed.parse(bytes) {
            Ok(httparse::Status::Complete(length)) => length,
            Ok(httparse::Status::Partial) => return Ok(None),
            Err(httparse::Error::TooManyHeaders) => return Err(Status::HeadTooLarge),
            Err(_) => return Err(Status::BadRequest),
        };
        if length > HEAD_MAX {
            return Err(Status::HeadTooLarge);
        }
        let (method, path) = (parsed.method.unwrap_or(""), parsed.path.unwrap_or(""));
        let all = |name: &str| {
            let named = parsed
                .headers
                .iter()
                .filter(|header| header.name.eq_ignore_ascii_case(name));
            named.map(|header| header.value).collect::<Vec<_>>()
        };
        // Two headers of one of these names are ambiguous.
        let one = |name: &str| match all(name).as_slice() {
            [] => Ok(None),
            [value] => Ok(Some(value.to_vec())),
            _ => Err(Status::BadRequest),
        };
        if !all("Transfer-Encoding").is_empty() {
            return Err(Status::BadRequest);
        }
        let body = match one("Content-Length")? {
            None => 0,
            Some(digits) => std::str::from_utf8(&digits)
                .ok()
                .filter(|text| text.bytes().all(|byte| byte.is_ascii_digit()))
                .and_then(|text| text.parse::<usize>().ok())
                .ok_or(Status::BadRequest)?,
        };
        if body > BODY_MAX {
            return Err(Status::BodyTooLarge);
        }
        let request = Request {
            method: method.to_owned(),
            path: path.to_owned(),
            host: one("Host")?,
            origin: one("Origin")?,
            token: one("X-Taceva-Token")?,
            body: Vec::new(),
        };
        Ok(Some(Head {
            request,
            length,
            body,
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(text: &str) -> Status {
        match Head::parse(text.as_bytes()) {
            Err(status) => status,
            Ok(_) => panic!("accepted: {text}"),
        }
    }

    #[test]
    fn a_head_is_read_once_it_is_whole_and_says_how_long_its_body_is() {
        let text = "POST /stop HTTP/1.1\r\nhost: 127.0.0.1:80\r\nx-taceva-token: abc\r\ncontent-length: 3\r\n\r\n";
        assert!(matches!(
            Head::parse(&text.as_bytes()[..text.len() - 1]),
            Ok(None)
        ));
        let head = Head::parse(text.as_bytes());
        let Ok(Some(Head {
            request,
            length,
            body,
        })) = head
        else {
            panic!("a whole head");
        };
        assert_eq!((length, body), (text.len(), 3));
        assert_eq!(
            (request.method.as_str(), request.path.as_str()),
            ("POST", "/stop")
        );
        assert_eq!(request.token.as_deref(), Some(&b"abc"[..]));
        assert_eq!(request.origin, None);
    }

    #[test]
    fn what_two_readers_could_read_in_two_ways_is_refused() {
        for lines in [
            "Host: a\r\nHost: b",
            "Content-Length: 1\r\nContent-Length: 2",
            "Content-Length: +1",
            "Content-Length: 1x",
            "Transfer-Encoding: chunked",
        ] {
            let text = format!("POST / HTTP/1.1\r\n{lines}\r\n\r\n");
            assert_eq!(refused(&text), Status::BadRequest, "{lines}");
        }
        assert_eq!(refused("hello\0there\r\n\r\n"), Status::BadRequest);
        assert_eq!(
            refused("POST / HTTP/1.1\r\nContent-Length: 1025\r\n\r\n"),
            Status::BodyTooLarge
        );
        let lines = "A: b\r\n".repeat(HEADERS_MAX + 1);
        let many = format!("GET / HTTP/1.1\r\n{lines}\r\n");
        assert_eq!(refused(&many), Status::HeadTooLarge);
    }
}
