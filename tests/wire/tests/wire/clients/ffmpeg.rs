//! Tests that the camera driver works with ffmpeg as the server of a stream.

use std::net::TcpListener;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use taceva_core::{Deadline, ErrorKind, Factory, FrameMut, PixelFormat, Rig, Sensor};
use taceva_drivers::camera::mjpeg::MjpegFactory;
use taceva_needs::{Need, skip};

/// ffmpeg serving one client, ended on drop.
struct Served(Child);

impl Drop for Served {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Starts ffmpeg as the server of a moving picture, 64×48 pixels at 30 frames per second; `None` without ffmpeg.
fn served(port: u16) -> Option<Served> {
    let program = std::env::var_os("TACEVA_FFMPEG").unwrap_or_else(|| "ffmpeg".into());
    let url = format!("http://127.0.0.1:{port}/");
    let input = "testsrc=size=64x48:rate=30";
    let server = Command::new(program)
        .args(["-loglevel", "quiet", "-re", "-f", "lavfi", "-i", input])
        .args(["-f", "mpjpeg", "-listen", "1", &url])
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn();
    match server {
        Ok(child) => Some(Served(child)),
        Err(error) => {
            skip(Need::Ffmpeg, error);
            None
        }
    }
}

fn opened(url: &str) -> Box<dyn Sensor> {
    let factory = MjpegFactory::new().expect("a factory");
    let args = factory.descriptor().args(&format!("url={url}"));
    let args = args.expect("good");
    let began = Instant::now();
    loop {
        match factory.open(&args, &mut Rig::new()) {
            Ok(sensor) => return sensor,
            // ffmpeg does not listen yet.
            Err(error) if error.kind() == ErrorKind::NotFound => {
                assert!(began.elapsed() < Duration::from_secs(20), "{error}");
                std::thread::sleep(Duration::from_millis(50));
            }
            Err(error) => panic!("{error}"),
        }
    }
}

#[test]
fn frames_of_ffmpeg_are_read_at_their_rate() {
    let free = TcpListener::bind("127.0.0.1:0").expect("a port");
    let port = free.local_addr().expect("bound").port();
    drop(free);
    let Some(server) = served(port) else {
        return;
    };
    let mut sensor = opened(&format!("http://127.0.0.1:{port}/"));
    let info = sensor.frame_info();
    assert_eq!((info.width, info.height), (64, 48));
    assert_eq!(info.format, PixelFormat::Rgb8);
    let patience = Deadline::after(Duration::from_secs(3));
    sensor.start(patience).expect("it starts");
    let mut stamps: Vec<f64> = Vec::new();
    // The server first sends the frames that it made while it waited for a client.
    while stamps.len() < 2 || stamps[stamps.len() - 1] - stamps[0] < 2.0 {
        let mut pixels = vec![0; info.byte_len().expect("small")];
        let into = FrameMut::new(info, &mut pixels).expect("the buffer fits");
        let stamp = sensor.capture(into, patience).expect("a frame");
        stamps.push(stamp.valid_s);
    }
    assert!(stamps.windows(2).all(|pair| pair[0] < pair[1]));
    let last = &stamps[stamps.len() - 15..];
    let mean_s = (last[14] - last[0]) / 14.0;
    assert!((0.02..0.2).contains(&mean_s), "{mean_s} s a frame");
    drop(server);
    let gone = (0..100).find_map(|_| {
        let mut pixels = vec![0; info.byte_len().expect("small")];
        let into = FrameMut::new(info, &mut pixels).expect("the buffer fits");
        sensor.capture(into, patience).err()
    });
    let kind = gone.expect("it was ended").kind();
    assert!(
        [ErrorKind::Disconnected, ErrorKind::EndOfStream].contains(&kind),
        "{kind}"
    );
}
