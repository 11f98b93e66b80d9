//! Emulated camera that streams over HTTP: `multipart/x-mixed-replace` with a JPEG or, for comparisons, a PNG in each part.
//!
//! A path that ends in `.png` streams PNG, any other path JPEG. The query `drift_ppm=200` stamps each part by a clock that is 200 ppm too fast. A connection
//! carries one stream; a second request on it is ignored.

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

/// Emulated camera that listens until drop.
#[derive(Debug)]
pub struct Emulator {
    server: Server,
}

/// Delimiters and lengths of the parts of a stream, which differ between servers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// The header states the boundary, and each part its length.
    Usual,
    /// Like `ffmpeg -f mpjpeg`: another content type, no boundary in the header, and chunks of HTTP/1.1.
    Ffmpeg,
    /// The header states the boundary, and no part states its length.
    Lengthless,
}

/// Delimiter between two parts of the stream.
const BOUNDARY: &str = "taceva-frame";
/// Head of a part with a length beyond any memory.
const HOSTILE: &[u8] =
    b"--taceva-frame\r\nContent-type: image/jpeg\r\nContent-length: 18446744073709551615\r\n\r\n";
/// JPEG quality, with little loss.
const QUALITY: u8 = 95;
/// Time of the camera's clock at the start of the bench, s.
const CLOCK_S: f64 = 1_700_000_000.0;
/// Maximum length of a request, bytes.
const REQUEST_MAX: usize = 8192;

impl Emulator {
    /// Starts a camera behind the gel of `bench`; port 0 selects any free port.
    ///
    /// # Errors
    /// [`WireError`] if the server cannot listen on the port.
    pub fn start(
        bench: &WallBench,
        host: Ipv4Addr,
        port: u16,
        style: Style,
    ) -> Result<Emulator, WireError> {
        let end = End::default();
        let serving = (bench.clone(), end.clone());
        let server = Server::start(host, port, &end, move |stream| {
            // A closed client ends its stream.
            let _ = serve(stream, &serving.0, style, &serving.1);
        })?;
        Ok(Emulator { server })
    }

    /// Address of the server.
    pub fn address(&self) -> SocketAddr {
        self.server.address()
    }

    /// URL of the JPEG stream.
    pub fn url(&self) -> String {
        format!("http://{}/stream.mjpeg", self.address())
    }

    /// URL of the JPEG stream with the stamps of a clock that drifts by `ppm`.
    pub fn drifting_url(&self, ppm: f64) -> String {
        format!("{}?drift_ppm={ppm}", self.url())
    }

    /// URL of the PNG stream, which is lossless.
    pub fn png_url(&self) -> String {
        format!("http://{}/stream.png", self.address())
    }
}

fn serve(mut stream: TcpStream, bench: &WallBench, style: Style, end: &End) -> io::Result<()> {
    let Some(path) = requested(&mut stream, end) else {
        return stream.write_all(b"HTTP/1.1 400 Bad Request\r\nContent-Length: 0\r\n\r\n");
    };
    let (path, query) = path.split_once('?').unwrap_or((path.as_str(), ""));
    let drift_ppm: Option<f64> = query
        .strip_prefix("drift_ppm=")
        .and_then(|ppm| ppm.parse().ok());
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
        // A late camera skips frames.
        due = (due + period).max(now);
        let stamp = drift_ppm.map_or_else(String::new, |ppm| {
            let clock_s = CLOCK_S + now.as_secs_f64() * (1.0 + 1e-6 * ppm);
            format!("X-Timestamp: {clock_s:.6}\r\n")
        });
        if shown.is_empty() || !bench.is_faulty(Device::Camera, FaultKind::Frozen) {
            let pixels = bench.picture().map_err(io::Error::other)?;
            shown = encode(&pixels, info, is_png).map_err(io::Error::other)?;
        }
        let part = part(&shown, &format!("Content-type: {kind}\r\n{stamp}"), style);
        link.send(bench, &part, |bytes| stream.write_all(bytes))?;
    }
    Ok(())
}

/// Path in a client's request; `None` if the client sent no complete request.
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

/// Part of a stream: the delimiter, the header lines `lines`, the length if `style` has it, and the picture.
fn part(picture: &[u8], lines: &str, style: Style) -> Vec<u8> {
    let length = match style {
        Style::Usual | Style::Ffmpeg => format!("Content-length: {}\r\n", picture.len()),
        Style::Lengthless => String::new(),
    };
    let boundary = match style {
        Style::Ffmpeg => "ffmpeg",
        Style::Usual | Style::Lengthless => BOUNDARY,
    };
    let head = format!("--{boundary}\r\n{lines}{length}\r\n");
    let part = [head.as_bytes(), picture, b"\r\n"].concat();
    match style {
        Style::Ffmpeg => {
            let size = format!("{:x}\r\n", part.len());
            [size.as_bytes(), &part, b"\r\n"].concat()
        }
        Style::Usual | Style::Lengthless => part,
    }
}

/// Encodes a picture as PNG or JPEG.
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
