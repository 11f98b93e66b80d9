//! Tests that the camera driver works with `mjpeg-streamer`, a public server of streams.

use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use taceva_core::{Deadline, Factory, FrameMut, PixelFormat, Rig};
use taceva_drivers::camera::mjpeg::MjpegFactory;

use super::python;

const PATIENCE: Deadline = Deadline::after(Duration::from_secs(5));

/// Process of `mjpeg-streamer`, ended on drop.
struct Server(Child);

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

#[test]
fn frames_of_the_public_server_are_read_and_none_is_damaged() {
    let Some(python) = python::with("mjpeg_streamer") else {
        return;
    };
    let process = Command::new(python)
        .args(["-c", include_str!("mjpeg.py")])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn();
    let mut server = Server(process.expect("the interpreter that was just tried"));
    let output = BufReader::new(server.0.stdout.take().expect("piped"));
    let mut lines = output.lines().map_while(Result::ok);
    let port = lines.find_map(|line| line.strip_prefix("= ").map(str::to_owned));
    let port = port.expect("it serves");
    let factory = MjpegFactory::new().expect("a factory");
    let url = format!("url=http://127.0.0.1:{port}/camera");
    let args = factory.descriptor().args(&url).expect("good");
    let mut sensor = factory.open(&args, &mut Rig::new()).expect("a camera");
    let info = sensor.frame_info();
    assert_eq!((info.width, info.height), (64, 48));
    assert_eq!(info.format, PixelFormat::Rgb8);
    sensor.start(PATIENCE).expect("it starts");
    let mut last: Option<u8> = None;
    let mut changes = 0;
    for _ in 0..40 {
        let mut pixels = vec![0; info.byte_len().expect("small")];
        let into = FrameMut::new(info, &mut pixels).expect("the buffer fits");
        sensor.capture(into, PATIENCE).expect("a whole frame");
        changes += u32::from(last.is_some_and(|last| last != pixels[0]));
        last = Some(pixels[0]);
    }
    assert!(changes >= 10, "{changes}");
}
