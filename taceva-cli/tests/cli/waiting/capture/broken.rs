//! Faults during a capture: the fault is reported, and the recording is complete.

use std::io::{Read, Write};
use std::net::{Ipv4Addr, SocketAddr, TcpListener};
use std::process::Command;
use std::time::Duration;

use image::codecs::jpeg::JpegEncoder;
use image::{ExtendedColorType, ImageEncoder};
use taceva_dataset::Dataset;
use taceva_wire::{Device, Fault, FaultKind};

use crate::support::Bench;
use crate::support::emulated::{Emulated, Running};

fn whole(bench: &Bench, name: &str) -> Dataset {
    let dataset = Dataset::open(&bench.path(name)).expect("whole");
    for row in 0..dataset.table().rows() {
        dataset.frame(row).expect("read").expect("a frame");
    }
    dataset
}

#[test]
fn a_camera_that_is_unplugged_ends_it_with_what_came_before() {
    let emulated = Emulated::new();
    let bench = Bench::new();
    let words = format!("capture out --sensor {} --for 60s", emulated.sensor());
    let running = Running::start(&bench, &words);
    running.until_it_says("press; Ctrl-C");
    std::thread::sleep(Duration::from_millis(500));
    emulated.without_camera();
    let ran = running.ended();
    assert_eq!(ran.code, 4, "{}", ran.err);
    assert!(
        ran.err.contains("camera/mjpeg: cannot capture a frame"),
        "{}",
        ran.err
    );
    assert!(
        ran.err.contains("are a complete recording in out"),
        "{}",
        ran.err
    );
    assert!(whole(&bench, "out").table().rows() > 5);
}

#[test]
fn a_transducer_that_froze_ends_it_and_no_frame_has_its_force() {
    let emulated = Emulated::new();
    let bench = Bench::new();
    bench.write("hand.toml", &emulated.rig());
    let running = Running::start(&bench, "capture out --rig hand.toml --for 60s");
    running.until_it_says("press; Ctrl-C");
    std::thread::sleep(Duration::from_millis(500));
    emulated.bench.inject(Fault {
        device: Device::Force,
        kind: FaultKind::Frozen,
        lasts: Duration::from_secs(30),
    });
    let ran = running.ended();
    assert_eq!(ran.code, 4, "{}", ran.err);
    assert!(ran.err.contains("signal frozen"), "{}", ran.err);
    let dataset = whole(&bench, "out");
    let table = dataset.table();
    let forces = table.truth(0);
    let known = (0..table.rows())
        .filter(|&row| forces.get(row).is_some())
        .count();
    // Detection takes two seconds.
    assert!(
        known > 5 && table.rows() - known > 10,
        "{known} of {}",
        table.rows()
    );
    let last = (0..table.rows()).rev().take(10);
    assert!(last.into_iter().all(|row| forces.get(row).is_none()));
}

#[test]
fn a_transducer_that_says_nothing_ends_it_too() {
    let emulated = Emulated::new();
    let bench = Bench::new();
    bench.write("hand.toml", &emulated.rig());
    let running = Running::start(&bench, "capture out --rig hand.toml --for 60s");
    running.until_it_says("press; Ctrl-C");
    emulated.bench.inject(Fault {
        device: Device::Force,
        kind: FaultKind::Silent,
        lasts: Duration::from_secs(30),
    });
    let ran = running.ended();
    assert_eq!(ran.code, 4, "{}", ran.err);
    assert!(
        ran.err
            .contains("sri/m8128: cannot read the force: no reading"),
        "{}",
        ran.err
    );
    whole(&bench, "out");
}

/// Starts a camera that sends a frame every `period`. `width` returns the width of a frame in pixels, by the number of the frame.
pub(crate) fn camera(
    period: Duration,
    width: impl Fn(usize) -> u32 + Send + 'static,
) -> SocketAddr {
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).expect("a port");
    let address = listener.local_addr().expect("an address");
    std::thread::spawn(move || {
        while let Ok((mut stream, _)) = listener.accept() {
            let head =
                "HTTP/1.0 200 OK\r\nContent-Type: multipart/x-mixed-replace; boundary=b\r\n\r\n";
            let _ = stream.read(&mut [0; 1024]);
            let _ = stream.write_all(head.as_bytes());
            for number in 0.. {
                let width = width(number);
                let pixels = vec![u8::try_from(number % 200).expect("small"); 24 * width as usize];
                let mut jpeg = Vec::new();
                JpegEncoder::new(&mut jpeg)
                    .write_image(&pixels, width, 24, ExtendedColorType::L8)
                    .expect("encoded");
                let part = format!(
                    "--b\r\nContent-Type: image/jpeg\r\nContent-Length: {}\r\n\r\n",
                    jpeg.len()
                );
                let part = [part.as_bytes(), &jpeg, b"\r\n"].concat();
                if stream.write_all(&part).is_err() {
                    break;
                }
                std::thread::sleep(period);
            }
        }
    });
    address
}

/// Starts a camera that sends `first` frames of one size, then frames of another size.
pub(crate) fn changing_camera(first: usize) -> SocketAddr {
    let width = move |number| if number < first { 32 } else { 48 };
    camera(Duration::from_millis(20), width)
}

#[test]
fn a_camera_that_changes_its_size_ends_it_by_name() {
    let address = changing_camera(60);
    let bench = Bench::new();
    let ran = bench.run(&format!(
        "capture out --sensor camera/mjpeg:url=http://{address}/ --for 60s"
    ));
    assert_eq!(ran.code, 4, "{}", ran.err);
    assert!(
        ran.err.contains("the camera changed to frames of 48×24"),
        "{}",
        ran.err
    );
    let dataset = whole(&bench, "out");
    assert!(dataset.table().rows() > 20);
    let stream = dataset.header().stream.expect("a stream");
    assert!(stream.damaged > 10, "{stream:?}");
}

#[test]
fn a_full_disk_ends_it_and_what_is_durable_is_closed_once_there_is_room() {
    let emulated = Emulated::new();
    let bench = Bench::new();
    let command = bench.command(&format!(
        "capture out --sensor {} --for 60s",
        emulated.sensor()
    ));
    // Writing more than 32 kB to one file fails, as on a full disk.
    let mut small = Command::new("sh");
    small
        .args(["-c", "ulimit -f 64; exec \"$@\"", "sh"])
        .arg(command.get_program())
        .args(command.get_args())
        .current_dir(bench.path("."));
    let ran = Running::of(small).ended();
    assert_eq!(ran.code, 3, "{}", ran.err);
    assert!(ran.err.contains("out"), "{}", ran.err);
    if bench.path("out/journal").exists() {
        assert!(
            ran.err.contains("taceva capture out --close"),
            "{}",
            ran.err
        );
        bench.ok("capture out --close -q");
    }
    assert!(whole(&bench, "out").table().rows() > 0);
    bench.refused("capture out --close", 3, "out");
}

#[test]
fn what_cannot_be_opened_is_said_before_anything_is_made() {
    let bench = Bench::new();
    for (words, code, said) in [
        ("capture out", 2, "--sensor"),
        ("capture out --sensor", 2, "--sensor"),
        ("capture out --sensor camera/none", 3, "camera/none"),
        (
            "capture out --sensor camera/mjpeg:url=http://127.0.0.1:9/",
            4,
            "127.0.0.1:9",
        ),
        ("capture out --rig none.toml", 3, "none.toml"),
        ("capture out --sensor sim/gelsight --for 5", 2, "60s"),
        ("capture out --close --frames 3", 2, "--close"),
        ("capture out --close", 3, "out"),
    ] {
        let ran = bench.run(words);
        assert_eq!(ran.code, code, "{words}: {}", ran.err);
        assert!(ran.err.contains(said), "{words}: {}", ran.err);
        assert!(!bench.path("out").exists(), "{words}");
    }
    bench.write("force.toml", "rig_version = 1\n");
    bench.refused("capture out --rig force.toml", 2, "has no [sensor]");
}
