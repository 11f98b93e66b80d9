//! Tests that a folder of frames is replayed as a live sensor, and that errors name the fault.

use std::fs;
use std::io::Cursor;
use std::time::Duration;

use crate::support::{PATIENCE, capture, folder, gray, replay};
use image::{ImageFormat, Rgb, RgbImage};
use taceva_core::{Deadline, DriverError, ErrorKind, FrameInfo, FrameMut, PixelFormat, Sensor};

#[test]
fn frames_come_in_the_order_of_their_numbers_at_the_rate_asked_for() {
    let folder = folder(11);
    let mut sensor = replay(folder.path(), ";rate=4 Hz");
    let frames: Vec<(f64, u8)> = (0..11)
        .map(|_| capture(sensor.as_mut(), PATIENCE).expect("a frame"))
        .map(|(stamp, shade)| (stamp.valid_s, shade))
        .collect();
    let expected: Vec<(f64, u8)> = (0..11).map(|at| (f64::from(at) * 0.25, at + 1)).collect();
    assert_eq!(frames, expected);
    let error = capture(sensor.as_mut(), PATIENCE).expect_err("no twelfth");
    assert_eq!(error.kind(), ErrorKind::EndOfStream);
    assert_eq!(
        error.to_string(),
        "sensor/replay: cannot capture a frame: the recording has ended"
    );
}

#[test]
fn a_table_of_times_decides_the_order_and_the_stamps() {
    let folder = folder(3);
    let table = folder.path().join("times.csv");
    fs::write(
        &table,
        "file,t_s\nframe 2.png,1700000000.5\nframe 3.png,1700000000.75\nframe 1.png,1700000009\n",
    )
    .expect("written");
    let mut sensor = replay(folder.path(), &format!(";times={}", table.display()));
    let next = |sensor: &mut dyn Sensor| {
        let (stamp, shade) =
            capture(sensor, Deadline::after(Duration::from_secs(60))).expect("a frame");
        (stamp.valid_s, stamp.received_s, shade)
    };
    assert_eq!(next(sensor.as_mut()), (1_700_000_000.5, None, 2));
    assert_eq!(next(sensor.as_mut()), (1_700_000_000.75, None, 3));
    assert_eq!(next(sensor.as_mut()), (1_700_000_009.0, None, 1));
}

#[test]
fn a_frame_that_comes_after_the_deadline_is_a_timeout_and_then_comes() {
    let folder = folder(2);
    let mut sensor = replay(folder.path(), ";rate=1");
    capture(sensor.as_mut(), Deadline::PASSED).expect("the first is there at once");
    let brief = Deadline::after(Duration::from_millis(400));
    for _ in 0..2 {
        let error = capture(sensor.as_mut(), brief).expect_err("not yet");
        assert_eq!(error.kind(), ErrorKind::Timeout);
        assert_eq!(
            error.to_string(),
            "sensor/replay: cannot capture a frame: no frame within 400ms"
        );
    }
    // Waiting took 0.8 s of virtual time.
    let (stamp, shade) = capture(sensor.as_mut(), brief).expect("now");
    assert_eq!((stamp.valid_s, shade), (1.0, 2));
}

#[test]
fn in_real_time_a_late_caller_misses_frames_and_gets_the_newest() {
    let folder = folder(200);
    let mut sensor = replay(folder.path(), ";rate=100;pace=real");
    let (first, _) = capture(sensor.as_mut(), PATIENCE).expect("a frame");
    std::thread::sleep(Duration::from_millis(60));
    let (second, shade) = capture(sensor.as_mut(), PATIENCE).expect("a frame");
    assert!(shade > 6, "frame {shade} after 60 ms at 100 Hz");
    assert!(second.valid_s - first.valid_s >= 0.05);
    assert!(second.received_s.expect("real time") >= second.valid_s);
}

#[test]
fn a_recording_that_repeats_goes_on_in_time() {
    let folder = folder(2);
    let mut sensor = replay(folder.path(), ";rate=2;repeat=true");
    let frames: Vec<(f64, u8)> = (0..5)
        .map(|_| capture(sensor.as_mut(), PATIENCE).expect("a frame"))
        .map(|(stamp, shade)| (stamp.valid_s, shade))
        .collect();
    assert_eq!(frames, [(0.0, 1), (0.5, 2), (1.0, 1), (1.5, 2), (2.0, 1)]);
}

#[test]
fn a_stopped_replay_refuses_and_goes_on_where_it_was() {
    let folder = folder(3);
    let mut sensor = replay(folder.path(), "");
    assert_eq!(capture(sensor.as_mut(), PATIENCE).expect("a frame").1, 1);
    sensor.stop().expect("stops");
    sensor.stop().expect("twice is once");
    let error = capture(sensor.as_mut(), PATIENCE).expect_err("stopped");
    assert_eq!(error.kind(), ErrorKind::InvalidArgument);
    sensor.start(PATIENCE).expect("starts again");
    sensor.start(PATIENCE).expect("twice is once");
    assert_eq!(capture(sensor.as_mut(), PATIENCE).expect("a frame").1, 2);
}

#[test]
fn a_buffer_of_another_size_is_refused_and_no_frame_is_lost() {
    let folder = folder(1);
    let mut sensor = replay(folder.path(), "");
    let info = FrameInfo {
        width: 6,
        height: 8,
        format: PixelFormat::Gray8,
    };
    let mut pixels = [9; 48];
    let frame = FrameMut::new(info, &mut pixels).expect("48 bytes");
    let error = sensor.capture(frame, PATIENCE).expect_err("turned");
    assert_eq!(error.kind(), ErrorKind::InvalidArgument);
    assert_eq!(
        error.to_string(),
        "sensor/replay: cannot capture a frame: a buffer for 6×8 gray8, expected 8×6 gray8"
    );
    assert_eq!(pixels, [9; 48]);
    assert_eq!(capture(sensor.as_mut(), PATIENCE).expect("a frame").1, 1);
}

#[test]
fn every_pixel_format_comes_through_and_jpeg_too() {
    let folder = tempfile::tempdir().expect("a folder");
    let colour = Rgb([700_u16, 255, 65_535]);
    image::ImageBuffer::from_pixel(3, 2, colour)
        .save(folder.path().join("a.png"))
        .expect("written");
    let mut sensor = replay(folder.path(), "");
    let info = sensor.frame_info();
    assert_eq!(info.to_string(), "3×2 rgb16");
    let mut pixels = vec![0; info.byte_len().expect("small")];
    let frame = FrameMut::new(info, &mut pixels).expect("of that size");
    sensor.capture(frame, PATIENCE).expect("a frame");
    assert_eq!(pixels, [0xbc, 2, 255, 0, 255, 255].repeat(6));

    let folder = tempfile::tempdir().expect("a folder");
    RgbImage::from_pixel(16, 16, Rgb([200; 3]))
        .save(folder.path().join("a.JPG"))
        .expect("written");
    let mut sensor = replay(folder.path(), "");
    assert_eq!(sensor.frame_info().to_string(), "16×16 rgb8");
    let (_, shade) = capture(sensor.as_mut(), PATIENCE).expect("a frame");
    assert!(shade.abs_diff(200) <= 1, "{shade}");
}

#[test]
fn a_frame_of_another_size_is_refused_and_the_next_one_comes() {
    let folder = folder(3);
    gray(2, 6, 8, &folder.path().join("frame 2.png"));
    let mut sensor = replay(folder.path(), "");
    capture(sensor.as_mut(), PATIENCE).expect("the first");
    let error = capture(sensor.as_mut(), PATIENCE).expect_err("turned");
    assert_eq!(error.kind(), ErrorKind::Protocol);
    assert!(
        error.to_string().ends_with(
            "frame 2.png: a frame of 6×8 gray8, expected 8×6 gray8 like the first frame"
        ),
        "{error}"
    );
    assert_eq!(capture(sensor.as_mut(), PATIENCE).expect("a frame").1, 3);
}

#[test]
fn a_truncated_frame_is_refused_wherever_it_is_cut_and_the_next_one_comes() {
    let mut jpeg = Cursor::new(Vec::new());
    let noise = RgbImage::from_fn(32, 32, |x, y| {
        Rgb([((x * 37) ^ (y * 91)).to_le_bytes()[0]; 3])
    });
    noise
        .write_to(&mut jpeg, ImageFormat::Jpeg)
        .expect("encodes");
    let mut png = Cursor::new(Vec::new());
    noise.write_to(&mut png, ImageFormat::Png).expect("encodes");
    for (name, whole) in [("2.jpg", jpeg.into_inner()), ("2.png", png.into_inner())] {
        let folder = tempfile::tempdir().expect("a folder");
        for neighbour in ["1.png", "3.png"] {
            noise.save(folder.path().join(neighbour)).expect("written");
        }
        for cut in (0..whole.len()).step_by(7) {
            fs::write(folder.path().join(name), &whole[..cut]).expect("written");
            let mut sensor = replay(folder.path(), "");
            capture(sensor.as_mut(), PATIENCE).expect("the first");
            let error = capture(sensor.as_mut(), PATIENCE).expect_err("cut short");
            assert_eq!(error.kind(), ErrorKind::Protocol, "{error}");
            assert!(error.to_string().contains(name), "{error}");
            capture(sensor.as_mut(), PATIENCE).expect("the third");
        }
    }
}

#[test]
fn a_png_with_a_flipped_bit_is_refused_or_unharmed_and_a_jpeg_never_stops_the_replay() {
    let picture = RgbImage::from_fn(24, 24, |x, y| {
        Rgb([((x * 37) ^ (y * 91)).to_le_bytes()[0]; 3])
    });
    let folder = tempfile::tempdir().expect("a folder");
    picture.save(folder.path().join("1.png")).expect("written");
    for format in [ImageFormat::Png, ImageFormat::Jpeg] {
        let mut file = Cursor::new(Vec::new());
        picture.write_to(&mut file, format).expect("encodes");
        let whole = file.into_inner();
        for at in (0..whole.len()).step_by(3) {
            let mut damaged = whole.clone();
            damaged[at] ^= 1 << (at % 8);
            fs::write(folder.path().join("2.png"), damaged).expect("written");
            let mut sensor = replay(folder.path(), "");
            pixels(sensor.as_mut()).expect("the first");
            match pixels(sensor.as_mut()) {
                Err(error) => assert_eq!(error.kind(), ErrorKind::Protocol, "byte {at}: {error}"),
                // A JPEG has no checksum, so damage can go undetected.
                Ok(_) if format == ImageFormat::Jpeg => {}
                Ok(pixels) => assert_eq!(&pixels, picture.as_raw(), "byte {at}"),
            }
            let end = pixels(sensor.as_mut()).expect_err("no third");
            assert_eq!(end.kind(), ErrorKind::EndOfStream);
        }
    }
}

fn pixels(sensor: &mut dyn Sensor) -> Result<Vec<u8>, DriverError> {
    let info = sensor.frame_info();
    let mut pixels = vec![0; info.byte_len().expect("small")];
    let frame = FrameMut::new(info, &mut pixels).expect("of that size");
    sensor.capture(frame, PATIENCE).map(|_| pixels)
}
