//! Replays that fail to open: invalid folders, tables and arguments, and their messages.

use std::fs;

use crate::support::{PATIENCE, capture, folder, gray, replay, sensor};
use image::RgbImage;
use taceva_core::{ErrorKind, Rig};
use taceva_drivers::Drivers;

fn refused(selector: &str) -> (ErrorKind, String) {
    let error = sensor(selector).map(|_| ()).expect_err(selector);
    (error.kind(), error.to_string())
}

#[test]
fn a_picture_beyond_the_caps_is_refused_before_it_is_decoded() {
    let folder = tempfile::tempdir().expect("a folder");
    gray(1, 16_385, 1, &folder.path().join("1.png"));
    let (kind, message) = refused(&format!("sensor/replay:folder={}", folder.path().display()));
    assert_eq!(kind, ErrorKind::Protocol, "{message}");
    assert!(message.contains("1.png: "), "{message}");

    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("1.jpg");
    RgbImage::new(16, 16).save(&path).expect("written");
    let mut bytes = fs::read(&path).expect("there");
    let header = bytes
        .windows(2)
        .position(|pair| pair == [0xff, 0xc0])
        .expect("a size");
    bytes[header + 5..header + 9].copy_from_slice(&[0x40, 0, 0x40, 0]);
    fs::write(&path, bytes).expect("written");
    let (kind, message) = refused(&format!("sensor/replay:folder={}", folder.path().display()));
    assert_eq!(kind, ErrorKind::Protocol);
    assert!(
        message.ends_with("a frame of 16384×16384 rgb8, expected at most 268435456 bytes"),
        "{message}"
    );
}

#[cfg(target_os = "linux")]
#[test]
fn a_name_that_is_no_text_is_refused_rather_than_left_out() {
    use std::os::unix::ffi::OsStrExt;
    let folder = folder(1);
    let name = std::ffi::OsStr::from_bytes(b"frame \xff.png");
    gray(1, 8, 6, &folder.path().join(name));
    let (kind, message) = refused(&format!("sensor/replay:folder={}", folder.path().display()));
    assert_eq!(kind, ErrorKind::Protocol);
    assert!(
        message.ends_with("its name is not UTF-8: rename the file"),
        "{message}"
    );
}

#[test]
fn a_frame_that_vanishes_after_opening_is_not_found() {
    let folder = folder(2);
    let mut sensor = replay(folder.path(), "");
    fs::remove_file(folder.path().join("frame 1.png")).expect("there");
    let error = capture(sensor.as_mut(), PATIENCE).expect_err("gone");
    assert_eq!(error.kind(), ErrorKind::NotFound);
    assert_eq!(capture(sensor.as_mut(), PATIENCE).expect("a frame").1, 2);
}

#[test]
fn a_missing_folder_and_an_empty_one_are_not_found() {
    let folder = tempfile::tempdir().expect("a folder");
    let missing = folder.path().join("nowhere");
    let (kind, message) = refused(&format!("sensor/replay:folder={}", missing.display()));
    assert_eq!(kind, ErrorKind::NotFound);
    assert!(message.contains("cannot read the folder"), "{message}");
    fs::write(folder.path().join("notes.txt"), "no frame").expect("written");
    let (kind, message) = refused(&format!("sensor/replay:folder={}", folder.path().display()));
    assert_eq!(kind, ErrorKind::NotFound);
    assert!(
        message.contains("holds no frame, expected files that end in .png"),
        "{message}"
    );
}

#[test]
fn a_first_frame_that_is_no_picture_does_not_open() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("a.png"), "P5 1 1 255 x").expect("written");
    let (kind, message) = refused(&format!("sensor/replay:folder={}", folder.path().display()));
    assert_eq!(kind, ErrorKind::Protocol);
    assert!(
        message.ends_with("a.png: its content is neither PNG nor JPEG"),
        "{message}"
    );
}

#[cfg(unix)]
#[test]
fn a_link_among_the_frames_is_refused_rather_than_followed() {
    let folder = folder(1);
    std::os::unix::fs::symlink("/dev/zero", folder.path().join("endless.png")).expect("linked");
    let (kind, message) = refused(&format!("sensor/replay:folder={}", folder.path().display()));
    assert_eq!(kind, ErrorKind::Protocol);
    assert!(
        message.ends_with("endless.png: a link or a device, expected a regular file"),
        "{message}"
    );
}

#[test]
fn a_table_that_does_not_fit_its_folder_is_refused_by_line() {
    let folder = folder(2);
    let table = folder.path().join("times.csv");
    let cases = [
        ("", "line 1: no column `file`"),
        ("file,time\n", "line 1: no column `t_s`"),
        (
            "file,t_s\nframe 1.png,0\n",
            "times.csv: no row for `frame 2.png`",
        ),
        (
            "file,t_s\nframe 1.png,0\nframe 1.png,1\n",
            "line 3: `frame 1.png` occurs twice",
        ),
        (
            "file,t_s\n../frame 1.png,0\n",
            "line 2: `../frame 1.png` is not a frame in the folder",
        ),
        (
            "file,t_s\nframe 1.png,1\nframe 2.png,1\n",
            "line 3: 1 s follows 1 s, expected increasing times",
        ),
        (
            "file,t_s\nframe 1.png,NaN\n",
            "line 2: `NaN` is not a time, expected seconds",
        ),
        (
            "file,t_s\nframe 1.png,soon\u{1b}\n",
            "line 2: `soon\\u{1b}` is not a time",
        ),
        ("file,t_s\nframe 1.png\n", "line 2"),
    ];
    for (text, expected) in cases {
        fs::write(&table, text).expect("written");
        let selector = format!(
            "sensor/replay:folder={};times={}",
            folder.path().display(),
            table.display()
        );
        let (kind, message) = refused(&selector);
        assert_eq!(kind, ErrorKind::Protocol, "{text}");
        assert!(message.contains(expected), "{text}: {message}");
    }
    let selector = format!(
        "sensor/replay:folder={};times=nowhere.csv",
        folder.path().display()
    );
    assert_eq!(refused(&selector).0, ErrorKind::NotFound);
}

#[test]
fn an_unknown_driver_and_a_bad_argument_are_answered_with_what_is_accepted() {
    assert_eq!(
        refused("sensor/repaly:folder=x"),
        (
            ErrorKind::NotFound,
            "`sensor/repaly`: unknown sensor driver, did you mean `sensor/replay`?".to_owned()
        )
    );
    assert_eq!(
        refused("sensor/replay:foldr=x"),
        (
            ErrorKind::InvalidArgument,
            "sensor/replay:foldr=x: `foldr`: unknown argument, did you mean `folder`?".to_owned()
        )
    );
    let (_, message) = refused("sensor/replay:folder=x;rate=0");
    assert!(
        message.ends_with("`rate`: `0`, expected a number from 0.001 to 100000 Hz"),
        "{message}"
    );
    let (_, message) = refused("sensor/replay");
    assert!(
        message.contains("`folder`: missing, expected a path"),
        "{message}"
    );
}

#[test]
fn what_the_arguments_decide_is_known_before_anything_is_opened() {
    let drivers = Drivers::builtin().expect("no contradiction");
    let factory = drivers.sensors.get("sensor/replay").expect("linked in");
    let args = factory
        .descriptor()
        .args("folder=nowhere;rate=25")
        .expect("good");
    let described = factory.describe(&args).expect("no contradiction");
    let rate = described
        .sensor()
        .and_then(|facts| facts.rate)
        .expect("given");
    assert_eq!(rate.to_string(), "25 Hz");
    assert!(factory.open(&args, &mut Rig::new()).is_err());
}
