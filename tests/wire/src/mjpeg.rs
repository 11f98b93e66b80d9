//! An emulated camera that streams over HTTP: `multipart/x-mixed-replace` with a JPEG or, for comparisons, a PNG in each part.
//!
//! A path that ends in `.png` streams PNG, every other one JPEG. A connection is one stream; another request on it is not answered.

use std::io::{self, Write};
use std::net::{Ipv4Addr, SocketAddr, TcpStream};
use std::time::Duration;

use image::codecs::jpeg::JpegEncoder;
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder, ImageError};
use taceva_core::{FrameInfo, PixelFormat};

use crate::bench::WallBench;
use crate::error::WireError;
use crate::fault::{Device, FaultKind};
use crate::link::Link;
use crate::server::{End, Server, read};

/// An emulated camera that listens until this is dropped.
#[derive(Debug)]
pub struct Emulator {
    server: Server,
}

/// How the parts of a stream are told apart and measured: servers differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// With the boundary in the header, and the length of each part.
    Usual,
    /// As `ffmpeg -f mpjpeg` serves: another type in the header, no boundary there, lengths in chunks of HTTP/1.1.
    Ffmpeg,
    /// With the boundary in the header and no lengths.
    Lengthless,
}

/// What stands between two parts.
const BOUNDARY: &str = "taceva-frame";
/// The head of a part whose stated length is beyond any memory.
const HOSTILE: &[u8] =
    b"--taceva-frame\r\nContent-type: image/jpeg\r\nContent-length: 18446744073709551615\r\n\r\n";
/// What the JPEG loses: little.
const QUALITY: u8 = 95;
/// A longer request is none.
const REQUEST_MAX: usize = 8192;

impl Emulator {
    /// Starts a camera behind the gel of `bench`; 0 for any free port.
    ///
    /// # Errors
    /// [`WireError`] if the port cannot be listened on.
    pub fn start(
        bench: &WallBench,
        host: Ipv4Addr,
        port: u16,
        style: Style,
    ) -> Result<Emulator, WireError> {
        let end = End::default();
        let serving = (bench.clone(), end.clone());
        let server = Server::start(host, port, &end, move |stream| {
            // A client that goes ends its stream.
            let _ = serve(stream, &serving.0, style, &serving.1);
        })?;
        Ok(Emulator { server })
    }

    /// Where it listens.
    pub fn address(&self) -> SocketAddr {
        self.server.address()
    }

    /// The address of its stream of JPEG.
    pub fn url(&self) -> String {
        format!("http://{}/stream.mjpeg", self.address())
    }

    /// The address of its stream of PNG, which loses nothing.
    pub fn png_url(&self) -> String {
        format!("http://{}/stream.png", self.address())
    }
}

fn serve(mut stream: TcpStream, bench: &WallBench, style: Style, end: &End) -> io::Result<()> {
    let Some(path) = requested(&mut stream, end) else {
        return stream.write_all(b"HTTP/1.1 400 Bad Request\r\nContent-Length: 0\r\n\r\n");
    };
    let is_png = path.ends_with(".png");
    let kind = if is_png { "image/png" } else { "image/jpeg" };
    let head = match style {
        Style::Usual | Style::Lengthless => format!(
            "HTTP/1.0 200 OK\r\nContent-Type: multipart/x-mixed-replace; boundary={BOUNDARY}\r\nCache-Control: no-store\r\n\r\n"
        ),
        Style::Ffmpeg => "HTTP/1.1 200 OK\r\nContent-Type: application/octet-stream\r\nTransfer-Encoding: chunked\r\n\r\n".to_owned(),
    };
    stream.write_all(head.as_bytes())?;
    let period = Duration::from_secs_f64(1.0 / bench.frame_rate_hz());
    let info = bench.frame_info();
    let mut due = bench.now();
    let mut shown = Vec::new();
    let mut link = Link::new(Device::Camera, HOSTILE);
    while !end.has_come() {
        let now = bench.now();
        if due > now {
            let until = due.min(now + Duration::from_millis(50));
            link.rest_until(bench, until, |bytes| stream.write_all(bytes))?;
            continue;
        }
        // A camera that could not be served in time leaves frames out.
        due = (due + period).max(now);
        if shown.is_empty() || !bench.is_faulty(Device::Camera, FaultKind::Frozen) {
            let pixels = bench.picture().map_err(io::Error::other)?;
            shown = encode(&pixels, info, is_png).map_err(io::Error::other)?;
        }
        let part = part(&shown, kind, style);
        link.send(bench, &part, |bytes| stream.write_all(bytes))?;
    }
    Ok(())
}

/// The path of the request that a client makes.
fn requested(stream: &mut TcpStream, end: &End) -> Option<String> {
    let mut request = Vec::new();
    let mut bytes = [0; 1024];
    while !request.windows(4).any(|ending| ending == b"\r\n\r\n") {
        match read(stream, &mut bytes, end) {
            None => continue,
            Some(0) => return None,
            Some(count) => request.extend_from_slice(&bytes[..count]),
        }
        if request.len() > REQUEST_MAX {
            return None;
        }
    }
    let text = String::from_utf8_lossy(&request);
    let mut words = text.lines().next()?.split(' ');
    (words.next() == Some("GET")).then(|| words.next().map(str::to_owned))?
}

fn part(picture: &[u8], kind: &str, style: Style) -> Vec<u8> {
    let length = match style {
        Style::Usual | Style::Ffmpeg => format!("Content-length: {}\r\n", picture.len()),
        Style::Lengthless => String::new(),
    };
    let boundary = match style {
        Style::Ffmpeg => "ffmpeg",
        Style::Usual | Style::Lengthless => BOUNDARY,
    };
    let head = format!("--{boundary}\r\nContent-type: {kind}\r\n{length}\r\n");
    let part = [head.as_bytes(), picture, b"\r\n"].concat();
    match style {
        Style::Ffmpeg => {
            let size = format!("{:x}\r\n", part.len());
            [size.as_bytes(), &part, b"\r\n"].concat()
        }
        Style::Usual | Style::Lengthless => part,
    }
}

/// The picture as a file of its format.
fn encode(pixels: &[u8], info: FrameInfo, is_png: bool) -> Result<Vec<u8>, ImageError> {
    let colour = match info.format {
        PixelFormat::Gray8 => ExtendedColorType::L8,
        _ => ExtendedColorType::Rgb8,
    };
    let mut bytes = Vec::new();
    let FrameInfo { width, height, .. } = info;
    if is_png {
        PngEncoder::new(&mut bytes).write_image(pixels, width, height, colour)?;
    } else {
        JpegEncoder::new_with_quality(&mut bytes, QUALITY)
            .write_image(pixels, width, height, colour)?;
    }
    Ok(bytes)
}
