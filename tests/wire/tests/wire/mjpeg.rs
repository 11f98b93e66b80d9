//! Tests of `camera/mjpeg` over sockets, with the emulated camera and with invalid servers.

use std::io::{Read, Write};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::time::{Duration, Instant};

use image::codecs::jpeg::JpegEncoder;
use image::{ExtendedColorType, ImageEncoder};
use taceva_conformance::{self as conformance, Trial};
use taceva_core::{
    Deadline, DriverError, ErrorKind, Factory, FrameInfo, FrameMut, PixelFormat, Rig, Sensor, Stamp,
};
use taceva_drivers::camera::mjpeg::MjpegFactory;
use taceva_wire::mjpeg::{Emulator, Style};
use taceva_wire::{BenchOptions, Device, Fault, FaultKind, WallBench};

const PATIENCE: Deadline = Deadline::after(Duration::from_secs(2));

/// Opens the camera at `url`. Further driver arguments may follow the URL.
fn opened(url: &str) -> Result<Box<dyn Sensor>, DriverError> {
    let factory = MjpegFactory::new().expect("a factory");
    let args = factory.descriptor().args(&format!("url={url}"));
    factory.open(&args.expect("good"), &mut Rig::new())
}

fn started(url: &str) -> Box<dyn Sensor> {
    let mut sensor = opened(url).expect("a camera");
    sensor.start(PATIENCE).expect("it starts");
    sensor
}

fn frame(sensor: &mut Box<dyn Sensor>) -> Result<(Vec<u8>, Stamp), DriverError> {
    let info = sensor.frame_info();
    let mut pixels = vec![0; info.byte_len().expect("small")];
    let into = FrameMut::new(info, &mut pixels).expect("the buffer fits");
    let stamp = sensor.capture(into, PATIENCE)?;
    Ok((pixels, stamp))
}

fn camera(style: Style) -> (WallBench, Emulator) {
    let bench = WallBench::start(&BenchOptions::quiet(7)).expect("a bench");
    let camera = Emulator::start(&bench, Ipv4Addr::LOCALHOST, 0, style).expect("a camera");
    (bench, camera)
}

#[test]
fn the_suite_passes_however_a_server_writes_its_stream() {
    let factory = MjpegFactory::new().expect("a factory");
    for style in [Style::Usual, Style::Ffmpeg, Style::Lengthless] {
        let (_bench, camera) = camera(style);
        for url in [camera.url(), camera.png_url()] {
            let trial = Trial::with_arguments(format!("url={url}"));
            let report = conformance::sensor(&factory, &trial);
            assert!(report.passed(), "{style:?}: {report}");
        }
    }
}

#[test]
fn a_lossless_stream_and_a_jpeg_show_the_same_gel() {
    let (_bench, camera) = camera(Style::Usual);
    let [mut lossless, mut jpeg] = [camera.png_url(), camera.url()].map(|url| started(&url));
    let [(exact, _), (near, stamp)] =
        [&mut lossless, &mut jpeg].map(|sensor| frame(sensor).expect("a frame"));
    assert_eq!(lossless.frame_info(), jpeg.frame_info());
    assert_eq!(lossless.frame_info().format, PixelFormat::Rgb8);
    let difference: f64 = exact
        .iter()
        .zip(&near)
        .map(|(one, other)| f64::from(one.abs_diff(*other)))
        .sum();
    let samples = u32::try_from(exact.len()).expect("small");
    assert!(difference / f64::from(samples) < 4.0, "{difference}");
    assert!(stamp.received_s >= Some(stamp.valid_s));
}

#[test]
fn stamps_of_a_server_keep_its_drift_and_one_that_writes_none_is_refused() {
    let (_bench, camera) = camera(Style::Usual);
    // A clock that is twice as fast.
    let url = camera.drifting_url(1e6);
    let mut sensor = started(&format!("{url};clock=server"));
    assert!(!sensor.is_stamped_by_host());
    assert!(started(&url).is_stamped_by_host());
    let stamps: Vec<Stamp> = (0..60)
        .map(|_| frame(&mut sensor).expect("a frame").1)
        .collect();
    let [first, last] = [stamps[32], stamps[59]];
    let received_s = |stamp: Stamp| stamp.received_s.expect("it is stamped on arrival too");
    let ratio = (last.valid_s - first.valid_s) / (received_s(last) - received_s(first));
    // 27 frames of 40 ms each, with delays of the link.
    assert!((1.5..2.5).contains(&ratio), "{ratio}");
    let Err(error) = opened(&format!("{};clock=server", camera.url())) else {
        panic!("opened")
    };
    assert_eq!(error.kind(), ErrorKind::Protocol);
    assert!(error.to_string().contains("X-Timestamp"), "{error}");
}

#[test]
fn frames_come_at_the_rate_of_the_camera_and_none_comes_twice() {
    let (_bench, camera) = camera(Style::Usual);
    let mut sensor = started(&camera.url());
    let stamps: Vec<f64> = (0..15)
        .map(|_| frame(&mut sensor).expect("a frame").1.valid_s)
        .collect();
    let mean_s = (stamps[14] - stamps[0]) / 14.0;
    // 25 frames per second; a busy machine may skip some, and never adds one.
    assert!((0.036..0.12).contains(&mean_s), "{mean_s}");
}

#[test]
fn a_camera_that_stalls_is_a_timeout_and_one_that_goes_and_comes_back_is_started_again() {
    let (bench, camera) = camera(Style::Usual);
    let mut sensor = started(&camera.url());
    frame(&mut sensor).expect("a frame");
    bench.inject(Fault {
        device: Device::Camera,
        kind: FaultKind::Silent,
        lasts: Duration::from_secs(3),
    });
    let stalled = (0..3).find_map(|_| frame(&mut sensor).err());
    assert_eq!(stalled.expect("stalled").kind(), ErrorKind::Timeout);
    let port = camera.address().port();
    drop(camera);
    let gone = (0..3).find_map(|_| frame(&mut sensor).err());
    assert_eq!(gone.expect("gone").kind(), ErrorKind::Disconnected);
    sensor.stop().expect("it may be called in every state");
    assert_eq!(
        sensor.start(PATIENCE).expect_err("nobody listens").kind(),
        ErrorKind::NotFound
    );
    // Another program may have taken the port meanwhile.
    let Ok(_camera) = Emulator::start(&bench, Ipv4Addr::LOCALHOST, port, Style::Usual) else {
        return;
    };
    sensor.start(PATIENCE).expect("it is back");
    frame(&mut sensor).expect("a frame");
}

/// Starts a server that answers every client with `answer` and keeps the connection open. Returns its URL.
fn serving(answer: Vec<u8>) -> String {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
    let port = listener.local_addr().expect("bound").port();
    std::thread::spawn(move || {
        let serve = |mut stream: TcpStream| {
            let mut request = [0; 1024];
            let _ = stream.read(&mut request);
            let _ = stream.write_all(&answer);
            let _ = stream.read(&mut request);
        };
        listener.incoming().flatten().for_each(serve);
    });
    format!("http://127.0.0.1:{port}/")
}

const HEAD: &[u8] =
    b"HTTP/1.0 200 OK\r\nContent-Type: multipart/x-mixed-replace; boundary=b\r\n\r\n";

fn jpeg(width: u32, height: u32) -> Vec<u8> {
    let mut bytes = Vec::new();
    let pixels = vec![90; width as usize * height as usize];
    JpegEncoder::new(&mut bytes)
        .write_image(&pixels, width, height, ExtendedColorType::L8)
        .expect("a picture");
    bytes
}

fn part(picture: &[u8]) -> Vec<u8> {
    let head = format!("--b\r\nContent-Length: {}\r\n\r\n", picture.len());
    [head.as_bytes(), picture, b"\r\n"].concat()
}

#[test]
fn a_frame_of_another_size_and_a_damaged_one_are_errors_of_that_frame() {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
    let url = format!("http://{}/", listener.local_addr().expect("bound"));
    let (sender, parts) = std::sync::mpsc::channel::<Vec<u8>>();
    std::thread::spawn(move || {
        let (mut stream, _) = listener.accept().expect("a client");
        let _ = stream.read(&mut [0; 1024]);
        let _ = stream.write_all(HEAD);
        for part in parts {
            let _ = stream.write_all(&part);
        }
    });
    let send = |part: Vec<u8>| sender.send(part).expect("it listens");
    send(part(&jpeg(16, 8)));
    let mut sensor = started(&url);
    let expected = FrameInfo {
        width: 16,
        height: 8,
        format: PixelFormat::Gray8,
    };
    assert_eq!(sensor.frame_info(), expected);
    send(part(&jpeg(8, 16)));
    let error = frame(&mut sensor).expect_err("another size");
    assert_eq!(error.kind(), ErrorKind::Protocol);
    assert!(error.to_string().contains("8×16 gray8"), "{error}");
    let mut damaged = jpeg(16, 8);
    damaged.truncate(200);
    send(part(&damaged));
    let error = frame(&mut sensor).expect_err("damaged");
    assert!(error.to_string().contains("truncated"), "{error}");
    // Some cameras send zeros after the end of a picture.
    send(part(&[jpeg(16, 8), vec![0; 3]].concat()));
    assert_eq!(frame(&mut sensor).expect("a frame").0, vec![90; 128]);
    drop(sender);
    let error = frame(&mut sensor).expect_err("unplugged");
    assert_eq!(error.kind(), ErrorKind::Disconnected);
}

#[test]
fn what_is_no_camera_is_refused_by_what_it_said_and_soon() {
    let with = |body: &[u8]| [HEAD, body].concat();
    for (answer, kind, words) in [
        (
            b"HTTP/1.1 404 Not Found\r\n\r\n".to_vec(),
            ErrorKind::NotFound,
            "404",
        ),
        (
            b"RTSP/1.0 400\r\n\r\n".to_vec(),
            ErrorKind::Protocol,
            "RTSP",
        ),
        (
            with(b"--b\r\nContent-Type: text/html\r\n\r\n<html>"),
            ErrorKind::Protocol,
            "text/html",
        ),
        (
            with(b"--b\r\nContent-Length: 999999999999\r\n\r\n"),
            ErrorKind::Protocol,
            "999999999999",
        ),
        (
            with(&part(b"GIF89a")),
            ErrorKind::Protocol,
            "neither PNG nor JPEG",
        ),
        (with(b""), ErrorKind::Timeout, "no frame within"),
        (Vec::new(), ErrorKind::Timeout, "does not answer"),
    ] {
        let url = serving(answer);
        let began = Instant::now();
        let Err(error) = opened(&url) else {
            panic!("{words}: opened")
        };
        assert_eq!(error.kind(), kind, "{error}");
        assert!(error.to_string().contains(words), "{error}");
        assert!(began.elapsed() < Duration::from_secs(8));
    }
    let Err(error) = opened("https://127.0.0.1/") else {
        panic!("opened")
    };
    assert_eq!(error.kind(), ErrorKind::InvalidArgument);
}
