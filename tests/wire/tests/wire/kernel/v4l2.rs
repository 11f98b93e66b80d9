//! Tests of `camera/v4l2` with the camera that a kernel emulates.

use std::time::Duration;

use taceva_conformance::{self as conformance, Trial};
use taceva_core::{
    Deadline, DriverError, ErrorKind, Factory, FrameInfo, FrameMut, PixelFormat, Rig, Sensor,
};
use taceva_drivers::camera::v4l2::V4l2Factory;
use taceva_drivers::camera::v4l2::kernel::{Camera, ControlKind};

use super::machine::carry_out;

const PATIENCE: Deadline = Deadline::after(Duration::from_secs(60));
/// Driver arguments for the camera that the kernel module `vivid` emulates.
const ARGUMENTS: &str = "device=/dev/video0;pixels=yuyv";
const SIZE: FrameInfo = FrameInfo {
    width: 640,
    height: 480,
    format: PixelFormat::Rgb8,
};

#[test]
fn a_camera_of_the_kernel_gives_its_bars_and_says_when_it_is_gone() {
    carry_out("kernel::v4l2::in_the_machine", &["vivid"]);
}

#[test]
#[ignore = "carried out in a virtual machine"]
fn in_the_machine() {
    let factory = V4l2Factory::new().expect("a factory");
    let found = factory.discover().expect("a list");
    let first = found.first().expect("a camera");
    assert_eq!(first.arguments, "device=/dev/video0", "{found:?}");
    assert!(first.title.starts_with("vivid"), "{found:?}");
    what_it_does_not_give_is_refused_with_what_it_does();
    its_bars_have_the_colours_of_the_standard();
    its_gain_is_fixed_and_read_back();
    let mut trial = Trial::with_arguments(ARGUMENTS);
    let slow = Duration::from_secs(10);
    (trial.deadline, trial.at_once, trial.overrun) = (PATIENCE, slow, slow);
    let report = conformance::sensor(&factory, &trial);
    assert!(report.passed(), "{report}");
    a_second_program_is_told_that_it_is_in_use();
    a_camera_that_is_unplugged_is_gone();
}

fn opened(arguments: &str) -> Result<Box<dyn Sensor>, DriverError> {
    let factory = V4l2Factory::new().expect("a factory");
    let args = factory.descriptor().args(arguments).expect("good");
    factory.open(&args, &mut Rig::new())
}

fn captured(sensor: &mut dyn Sensor) -> Result<Vec<u8>, DriverError> {
    let info = sensor.frame_info();
    let mut pixels = vec![0; info.byte_len().expect("a size")];
    let frame = FrameMut::new(info, &mut pixels).expect("made for it");
    sensor.capture(frame, PATIENCE)?;
    Ok(pixels)
}

fn what_it_does_not_give_is_refused_with_what_it_does() {
    let refused = |arguments: &str| opened(arguments).map(drop).expect_err("refused");
    let size = refused("device=/dev/video0;width=642;height=482;pixels=yuyv");
    assert_eq!(size.kind(), ErrorKind::Unsupported, "{size}");
    assert!(
        size.to_string().contains("YUYV of 320×180, 640×360"),
        "{size}"
    );
    let files = refused("device=/dev/video0;width=640;height=360;pixels=mjpeg");
    assert_eq!(files.kind(), ErrorKind::Unsupported, "{files}");
    let rate = refused(&format!("{ARGUMENTS};rate=333"));
    assert_eq!(rate.kind(), ErrorKind::Unsupported, "{rate}");
    for setting in ["exposure_ms=15", "white_balance_k=5000", "focus=10"] {
        let absent = refused(&format!("{ARGUMENTS};{setting}"));
        assert_eq!(absent.kind(), ErrorKind::Unsupported, "{absent}");
    }
    let light = refused(&format!("{ARGUMENTS};led=15"));
    assert_eq!(light.kind(), ErrorKind::InvalidArgument, "{light}");
    // The second device file is a video output.
    let output = refused("device=/dev/video1;pixels=yuyv");
    assert_eq!(output.kind(), ErrorKind::InvalidArgument, "{output}");
    let absent = refused("device=/dev/video99");
    assert_eq!(absent.kind(), ErrorKind::NotFound, "{absent}");
}

fn its_bars_have_the_colours_of_the_standard() {
    // Nothing is changed except the fixed controls: the texts stay at the left of the picture.
    let mut sensor = opened(ARGUMENTS).expect("a camera");
    assert_eq!(sensor.frame_info(), SIZE);
    sensor.start(PATIENCE).expect("it begins");
    let frame = captured(sensor.as_mut()).expect("a picture");
    // White, yellow, cyan, green, magenta, red, blue and black at three quarters, from the left.
    let quarters =
        |[red, green, blue]: [bool; 3]| [red, green, blue].map(|on| if on { 191_i32 } else { 0 });
    let bars = [
        [true, true, true],
        [true, true, false],
        [false, true, true],
        [false, true, false],
        [true, false, true],
        [true, false, false],
        [false, false, true],
        [false, false, false],
    ]
    .map(quarters);
    let row = 470;
    for (bar, expected) in bars.into_iter().enumerate() {
        let at = 3 * (640 * row + 80 * bar + 40);
        let found = [frame[at], frame[at + 1], frame[at + 2]].map(i32::from);
        let is_near = found
            .iter()
            .zip(expected)
            .all(|(found, expected)| (found - expected).abs() <= 6);
        assert!(is_near, "bar {bar}: {found:?}, expected {expected:?}");
    }
}

fn its_gain_is_fixed_and_read_back() {
    let mut sensor = opened(&format!("{ARGUMENTS};gain=77")).expect("a camera");
    assert_eq!(
        sensor.settings().get("gain").map(String::as_str),
        Some("77")
    );
    sensor.start(PATIENCE).expect("it begins");
    captured(sensor.as_mut()).expect("a picture");
    sensor.stop().expect("it ends");
    // Another program changes gain and automatic gain meanwhile.
    let mut camera = Camera::open("/dev/video0").expect("a camera");
    let find = |camera: &Camera, name: &str| {
        let controls = camera.controls().expect("a list");
        controls
            .into_iter()
            .find(|control| control.name == name)
            .expect("it has one")
            .id
    };
    let (gain, automatic) = (find(&camera, "Gain"), find(&camera, "Gain, Automatic"));
    assert_eq!(camera.set(gain, 12).expect("free"), 12);
    assert_eq!(camera.set(automatic, 1).expect("free"), 1);
    sensor.start(PATIENCE).expect("it begins");
    assert_eq!(camera.value(automatic).expect("there"), 0);
    assert_eq!(camera.value(gain).expect("there"), 77);
    drop(sensor);
    camera.set(automatic, 1).expect("free");
    let flagged = opened(&format!("{ARGUMENTS};automatic=keep")).expect("a camera");
    assert_eq!(
        flagged.settings().get("gain_automatic").map(String::as_str),
        Some("true")
    );
    assert_eq!(flagged.settings().get("gain"), None);
    let both = opened(&format!("{ARGUMENTS};automatic=keep;gain=3")).map(drop);
    assert_eq!(both.expect_err("both").kind(), ErrorKind::InvalidArgument);
    let beyond = opened(&format!("{ARGUMENTS};gain=100000")).map(drop);
    assert_eq!(beyond.expect_err("beyond").kind(), ErrorKind::OutOfRange);
}

fn a_second_program_is_told_that_it_is_in_use() {
    let mut first = opened(ARGUMENTS).expect("a camera");
    first.start(PATIENCE).expect("it begins");
    let second = opened(ARGUMENTS).and_then(|mut second| second.start(PATIENCE));
    assert_eq!(second.expect_err("in use").kind(), ErrorKind::Busy);
    captured(first.as_mut()).expect("the first goes on");
}

fn a_camera_that_is_unplugged_is_gone() {
    let mut sensor = opened(ARGUMENTS).expect("a camera");
    sensor.start(PATIENCE).expect("it begins");
    captured(sensor.as_mut()).expect("a picture");
    let mut camera = Camera::open("/dev/video0").expect("a camera");
    let controls = camera.controls().expect("a list");
    let unplug = controls.iter().find(|control| control.name == "Disconnect");
    let unplug = unplug.expect("vivid has a button for it");
    assert_eq!(unplug.kind, ControlKind::Button);
    camera.press(unplug.id).expect("it is pressed");
    let gone = std::iter::repeat_with(|| captured(sensor.as_mut())).find_map(Result::err);
    let gone = gone.expect("an end");
    assert_eq!(gone.kind(), ErrorKind::Disconnected, "{gone}");
    let again = sensor.start(PATIENCE).expect_err("it is not back");
    assert!(
        matches!(again.kind(), ErrorKind::NotFound | ErrorKind::Disconnected),
        "{again}"
    );
}
