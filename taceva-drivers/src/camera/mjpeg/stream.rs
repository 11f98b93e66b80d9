//! HTTP connection to a streaming camera. A reader thread posts the newest image.

use std::io::{self, Read, Write};
use std::net::{Shutdown, SocketAddr, TcpStream};
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::Duration;

use taceva_core::ErrorKind;
use thiserror::Error;

use super::body::Body;
use super::head::{Head, HeadError};
use super::parts::Parts;
use super::url::Url;
use crate::link::mailbox::Ending;
use crate::link::{LinkError, Mailbox, connect, monotonic};

/// Image file as the server sent it, with the arrival time of its first bytes on the monotonic clock.
#[derive(Clone, Debug)]
pub(super) struct Picture {
    pub(super) bytes: Arc<[u8]>,
    pub(super) began: Duration,
    /// Server time of the image, s; `None` if the server writes none.
    pub(super) stamped_s: Option<f64>,
    /// Number of image parts with a wrong stated length since the connection was opened.
    pub(super) broken: u64,
}

/// Open HTTP connection that receives a stream of images.
#[derive(Debug)]
pub(super) struct Stream {
    stream: TcpStream,
    reader: Option<JoinHandle<()>>,
}

/// Failure to open the image stream of a camera.
#[derive(Debug, Error)]
pub(super) enum StreamError {
    #[error(transparent)]
    Link(#[from] LinkError),
    #[error("{address} does not return a stream: {source}")]
    Head {
        address: SocketAddr,
        source: HeadError,
    },
    #[error("{address} does not answer within {ANSWER:?}")]
    Silent { address: SocketAddr },
}

impl StreamError {
    /// Kind of the driver error for this failure.
    pub(super) fn kind(&self) -> ErrorKind {
        match self {
            StreamError::Link(error) => error.kind(),
            StreamError::Head { source, .. } => source.kind(),
            StreamError::Silent { .. } => ErrorKind::Timeout,
        }
    }
}

/// Timeout for each read of the HTTP response head.
const ANSWER: Duration = Duration::from_secs(3);

impl Stream {
    /// Requests the stream at `url` and starts a thread that posts the images to `pictures`.
    pub(super) fn open(url: &Url, pictures: &Arc<Mailbox<Picture>>) -> Result<Stream, StreamError> {
        let (mut stream, address) = connect(&url.host, url.port)?;
        let broken = |source: io::Error| LinkError::Broken { address, source };
        stream.set_read_timeout(Some(ANSWER)).map_err(broken)?;
        stream.write_all(url.request().as_bytes()).map_err(broken)?;
        let (head, behind) = read_head(&mut stream, address)?;
        stream.set_read_timeout(None).map_err(broken)?;
        let reading = stream.try_clone().map_err(broken)?;
        let posting = Arc::clone(pictures);
        let reader = std::thread::Builder::new()
            .name("mjpeg".to_owned())
            .spawn(move || {
                let ending = read(reading, address, &head, behind, &posting);
                posting.end(ending);
            })
            .map_err(broken)?;
        Ok(Stream {
            stream,
            reader: Some(reader),
        })
    }
}

impl Drop for Stream {
    fn drop(&mut self) {
        // The shutdown ends the reader thread.
        let _ = self.stream.shutdown(Shutdown::Both);
        if let Some(reader) = self.reader.take() {
            let _ = reader.join();
        }
    }
}

/// Reads the head of the HTTP response. Also returns the bytes of the body that arrived with the head.
fn read_head(stream: &mut TcpStream, address: SocketAddr) -> Result<(Head, Vec<u8>), StreamError> {
    let mut waiting = Vec::new();
    let mut bytes = [0; 4096];
    loop {
        match stream.read(&mut bytes) {
            Ok(0) => return Err(LinkError::Closed { address }.into()),
            Ok(count) => waiting.extend_from_slice(&bytes[..count]),
            Err(error) => match error.kind() {
                io::ErrorKind::Interrupted => continue,
                io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut => {
                    return Err(StreamError::Silent { address });
                }
                _ => {
                    let source = error;
                    return Err(LinkError::Broken { address, source }.into());
                }
            },
        }
        match Head::read(&waiting) {
            Ok(None) => {}
            Ok(Some((head, length))) => return Ok((head, waiting.split_off(length))),
            Err(source) => return Err(StreamError::Head { address, source }),
        }
    }
}

/// Posts the newest image of each read from the connection until the stream ends. Returns the cause of the end.
fn read(
    mut stream: TcpStream,
    address: SocketAddr,
    head: &Head,
    behind: Vec<u8>,
    posting: &Mailbox<Picture>,
) -> Ending {
    let mut body = Body::new(head.is_chunked);
    let mut parts = Parts::new(head.boundary.as_deref());
    let mut began = None;
    let mut last_began = Duration::ZERO;
    let mut bytes = vec![0; 64 << 10];
    let foreign = |why: String| Ending {
        kind: ErrorKind::Protocol,
        why: format!("{address} sent an invalid stream of pictures: {why}"),
    };
    let mut came = behind;
    loop {
        let at = monotonic();
        if let Err(error) = body.push(&came, |bytes| parts.push(bytes)) {
            let _ = stream.shutdown(Shutdown::Both);
            return foreign(error.to_string());
        }
        let (mut count, mut newest) = (0, None);
        loop {
            match parts.next() {
                Ok(Some(bytes)) => {
                    count += 1;
                    newest = Some((bytes, began.take().unwrap_or(at), parts.stamped_s()));
                }
                Ok(None) => break,
                Err(error) => {
                    let _ = stream.shutdown(Shutdown::Both);
                    return foreign(error.to_string());
                }
            }
        }
        if let Some((bytes, first, stamped_s)) = newest {
            // An image whose first bytes came with an earlier image is stamped at its end.
            last_began = if first > last_began { first } else { at };
            let picture = Picture {
                bytes: bytes.into(),
                began: last_began,
                stamped_s,
                broken: parts.broken(),
            };
            posting.post_last(count, picture, at);
        }
        if parts.is_within_part() {
            began.get_or_insert(at);
        }
        if body.has_ended() {
            return Ending {
                kind: ErrorKind::EndOfStream,
                why: format!("{address} ended its stream"),
            };
        }
        match stream.read(&mut bytes) {
            Ok(0) => return LinkError::Closed { address }.into(),
            Ok(count) => came = bytes[..count].to_vec(),
            Err(error) if error.kind() == io::ErrorKind::Interrupted => came = Vec::new(),
            Err(source) => return LinkError::Broken { address, source }.into(),
        }
    }
}
