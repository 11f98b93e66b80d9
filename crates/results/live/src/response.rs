//! HTTP responses, with headers that restrict the browser to the features that the page needs.

use std::io::{self, Write};

/// Status of a response.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Status {
    Ok,
    NoContent,
    BadRequest,
    Unauthorized,
    Forbidden,
    NotFound,
    WrongMethod,
    TimedOut,
    Conflict,
    BodyTooLarge,
    Misdirected,
    HeadTooLarge,
    Busy,
}

impl Status {
    pub(crate) const fn line(self) -> &'static str {
        match self {
            Status::Ok => "200 OK",
            Status::NoContent => "204 No Content",
            Status::BadRequest => "400 Bad Request",
            Status::Unauthorized => "401 Unauthorized",
            Status::Forbidden => "403 Forbidden",
            Status::NotFound => "404 Not Found",
            Status::WrongMethod => "405 Method Not Allowed",
            Status::TimedOut => "408 Request Timeout",
            Status::Conflict => "409 Conflict",
            Status::BodyTooLarge => "413 Content Too Large",
            Status::Misdirected => "421 Misdirected Request",
            Status::HeadTooLarge => "431 Request Header Fields Too Large",
            Status::Busy => "503 Service Unavailable",
        }
    }

    /// Advice for the reader of the response.
    const fn hint(self) -> &'static str {
        match self {
            Status::Unauthorized => {
                "the header X-Taceva-Token must hold the part after # of the address that the program printed\n"
            }
            Status::Forbidden => "this page answers only requests of its own origin\n",
            Status::Misdirected => "open the page with the address that the program printed\n",
            Status::Conflict => "this question is already answered\n",
            Status::Busy => "too many connections: close another window of this page\n",
            Status::WrongMethod => "expected GET for pages, and POST for /stop and /answer\n",
            _ => "",
        }
    }
}

/// Headers of every response: no caching, no type guessing, no framing, no content from elsewhere.
const ALWAYS: &str = "Cache-Control: no-store\r\n\
    Content-Security-Policy: default-src 'none'; connect-src 'self'; img-src 'self'; script-src 'self'; style-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'\r\n\
    Cross-Origin-Opener-Policy: same-origin\r\n\
    Cross-Origin-Resource-Policy: same-origin\r\n\
    Referrer-Policy: no-referrer\r\n\
    X-Content-Type-Options: nosniff\r\n\
    X-Frame-Options: DENY\r\n\
    Connection: close\r\n";

/// Writes a complete response with a body.
pub(crate) fn whole(
    out: &mut impl Write,
    status: Status,
    kind: &str,
    body: &[u8],
) -> io::Result<()> {
    let head = format!(
        "HTTP/1.1 {}\r\n{ALWAYS}Content-Type: {kind}\r\nContent-Length: {}\r\n\r\n",
        status.line(),
        body.len()
    );
    out.write_all(&[head.as_bytes(), body].concat())
}

/// Writes a response that contains only the status and its hint.
pub(crate) fn bare(out: &mut impl Write, status: Status) -> io::Result<()> {
    whole(
        out,
        status,
        "text/plain; charset=utf-8",
        status.hint().as_bytes(),
    )
}

/// Writes the head of a response whose body ends when the connection closes.
pub(crate) fn stream(out: &mut impl Write, kind: &str) -> io::Result<()> {
    let head = format!(
        "HTTP/1.1 {}\r\n{ALWAYS}Content-Type: {kind}\r\n\r\n",
        Status::Ok.line()
    );
    out.write_all(head.as_bytes())
}
