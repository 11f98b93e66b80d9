//! Camera with any frame rate, to measure the limit of a capture: `cargo run -p taceva-wire --example camera -- 60 640 480`.
//!
//! Prints the address of its stream, and serves the stream until its standard input ends. The pictures are drawn before the start, as JPEG of quality
//! 90. They show noise, a slowly changing light, and a moving dark disc like a pressed gel.

use std::error::Error;
use std::io::{Read, Write};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::sync::Arc;
use std::time::{Duration, Instant};

use image::codecs::jpeg::JpegEncoder;
use image::{ExtendedColorType, ImageEncoder};

/// Number of pictures, shown in turn.
const PICTURES: u32 = 60;
const QUALITY: u8 = 90;

#[expect(clippy::print_stdout, reason = "an example that says where it listens")]
fn main() -> Result<(), Box<dyn Error>> {
    let mut numbers = std::env::args().skip(1).map(|word| word.parse::<u32>());
    let mut next = |usual: u32| numbers.next().unwrap_or(Ok(usual));
    let (rate_hz, width, height) = (next(60)?, next(640)?, next(480)?);
    let pictures: Result<Vec<Vec<u8>>, _> = (0..PICTURES)
        .map(|number| picture(number, width, height))
        .collect();
    let pictures = Arc::new(pictures?);
    let bytes: usize = pictures.iter().map(Vec::len).sum();
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0))?;
    println!(
        "camera/mjpeg:url=http://{}/ {width} x {height} at {rate_hz} Hz, {} kB per picture",
        listener.local_addr()?,
        bytes / pictures.len() / 1000
    );
    std::thread::spawn(move || {
        while let Ok((stream, _)) = listener.accept() {
            let pictures = Arc::clone(&pictures);
            std::thread::spawn(move || {
                // A closed client ends its stream.
                let _ = serve(stream, rate_hz, &pictures);
            });
        }
    });
    std::io::stdin().read_to_end(&mut Vec::new())?;
    Ok(())
}

fn serve(mut stream: TcpStream, rate_hz: u32, pictures: &[Vec<u8>]) -> std::io::Result<()> {
    stream.set_nodelay(true)?;
    let _ = stream.read(&mut [0; 2048])?;
    stream.write_all(
        b"HTTP/1.0 200 OK\r\nContent-Type: multipart/x-mixed-replace; boundary=b\r\n\r\n",
    )?;
    let began = Instant::now();
    for number in 0_u32.. {
        let due = Duration::from_secs(1) * number / rate_hz;
        std::thread::sleep(due.saturating_sub(began.elapsed()));
        let picture = &pictures[(number % PICTURES) as usize];
        let head = format!(
            "--b\r\nContent-Type: image/jpeg\r\nContent-Length: {}\r\n\r\n",
            picture.len()
        );
        stream.write_all(&[head.as_bytes(), picture, b"\r\n"].concat())?;
    }
    Ok(())
}

fn picture(number: u32, width: u32, height: u32) -> Result<Vec<u8>, image::ImageError> {
    let mut state = number.wrapping_add(1);
    let (middle_x, middle_y) = (width * (number + 10) / (PICTURES + 20), height / 2);
    let radius = height / 8;
    let mut pixels = Vec::with_capacity(3 * (width * height) as usize);
    for y in 0..height {
        for x in 0..width {
            let is_touched =
                x.abs_diff(middle_x).pow(2) + y.abs_diff(middle_y).pow(2) < radius.pow(2);
            for colour in 1..4 {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                let noise = state >> 29;
                let light = 60 * colour + 40 * x / width - if is_touched { 40 } else { 0 };
                pixels.push(u8::try_from(light + noise).unwrap_or(u8::MAX));
            }
        }
    }
    let mut jpeg = Vec::new();
    JpegEncoder::new_with_quality(&mut jpeg, QUALITY).write_image(
        &pixels,
        width,
        height,
        ExtendedColorType::Rgb8,
    )?;
    Ok(jpeg)
}
