//! Helper functions that open a page and send requests.

use std::io::{Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant};

use taceva_core::{Frame, FrameInfo, PixelFormat};
use taceva_live::{Live, Page};

/// Open page, with a count of presses of its stop button.
pub(crate) struct Opened {
    pub(crate) live: Live,
    pub(crate) page: Page,
    pub(crate) stops: Arc<AtomicU32>,
}

impl Opened {
    pub(crate) fn new() -> Opened {
        let live = Live::new("a test");
        let stops = Arc::new(AtomicU32::new(0));
        let counted = Arc::clone(&stops);
        let page = Page::open(&live, 0, move || {
            counted.fetch_add(1, Ordering::SeqCst);
        });
        Opened {
            live,
            page: page.expect("a port"),
            stops,
        }
    }

    pub(crate) fn token(&self) -> String {
        let url = self.page.url();
        let (_, token) = url.split_once('#').expect("a token");
        token.to_owned()
    }

    pub(crate) fn address(&self) -> SocketAddr {
        self.page.address()
    }

    pub(crate) fn connected(&self) -> TcpStream {
        let stream = TcpStream::connect(self.address()).expect("it listens");
        stream
            .set_read_timeout(Some(Duration::from_secs(20)))
            .expect("a socket");
        stream
    }

    /// Response to a request with the first line `first` and the header `lines`. The token is part of `lines` if needed.
    pub(crate) fn asked(&self, first: &str, lines: &str, body: &str) -> String {
        let mut stream = self.connected();
        let request = format!(
            "{first} HTTP/1.1\r\n{lines}Content-Length: {}\r\n\r\n{body}",
            body.len()
        );
        stream.write_all(request.as_bytes()).expect("sent");
        let mut answer = String::new();
        stream.read_to_string(&mut answer).expect("answered");
        answer
    }

    /// Header lines that the page sends with a request: host, origin and token.
    pub(crate) fn own(&self) -> String {
        let (address, token) = (self.address(), self.token());
        format!("Host: {address}\r\nOrigin: http://{address}\r\nX-Taceva-Token: {token}\r\n")
    }

    /// Opens a stream and reads the header of the response.
    pub(crate) fn stream(&self, path: &str) -> TcpStream {
        let mut stream = self.connected();
        let request = format!("GET {path} HTTP/1.1\r\n{}\r\n", self.own());
        stream.write_all(request.as_bytes()).expect("sent");
        let mut head = Vec::new();
        while !head.ends_with(b"\r\n\r\n") {
            let mut byte = [0];
            stream.read_exact(&mut byte).expect("a head");
            head.push(byte[0]);
        }
        let head = String::from_utf8(head).expect("text");
        assert!(head.starts_with("HTTP/1.1 200"), "{head}");
        stream
    }
}

/// Status code of a response, such as `204`.
pub(crate) fn status(answer: &str) -> &str {
    answer.get(9..12).unwrap_or_default()
}

/// Square frame with all pixels at `level`.
pub(crate) fn frame(level: u8, width: u32) -> Frame {
    let info = FrameInfo {
        width,
        height: width,
        format: PixelFormat::Gray8,
    };
    let pixels = vec![level; info.byte_len().expect("small")];
    Frame::new(info, pixels).expect("whole")
}

/// Reads from `stream` until `words` arrive, and returns the text.
pub(crate) fn until(stream: &mut TcpStream, words: &str) -> String {
    let began = Instant::now();
    let mut read = Vec::new();
    while !String::from_utf8_lossy(&read).contains(words) {
        assert!(
            began.elapsed() < Duration::from_secs(20),
            "`{words}` never came"
        );
        let mut bytes = [0; 4096];
        let count = stream.read(&mut bytes).expect("it goes on");
        assert!(count > 0, "it ended before `{words}`");
        read.extend_from_slice(&bytes[..count]);
    }
    String::from_utf8_lossy(&read).into_owned()
}
