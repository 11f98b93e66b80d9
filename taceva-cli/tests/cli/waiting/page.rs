//! The page of a run and of a preview, on emulated devices: it shows the devices, and its button stops the arm.
//!
//! `TACEVA_STOPS=100` sets the number of stops, and prints the stopping times.

use std::io::{Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::time::{Duration, Instant};

use crate::support::Bench;
use crate::support::emulated::{Emulated, Running};

/// Address and token of the page of a running program.
#[derive(Clone)]
pub(crate) struct Page {
    address: String,
    token: String,
}

impl Page {
    pub(crate) fn of(running: &Running) -> Page {
        running.until_it_says("page: http://");
        running.until_it_says("\n");
        let said = running.said();
        let (_, url) = said.split_once("page: http://").expect("just heard");
        let url = url.split_whitespace().next().expect("an address");
        let (address, token) = url.split_once("/#").expect("a token");
        Page {
            address: address.to_owned(),
            token: token.to_owned(),
        }
    }

    fn asked(&self, first: &str, body: &str) -> TcpStream {
        let mut stream = TcpStream::connect(&self.address).expect("it listens");
        stream
            .set_read_timeout(Some(Duration::from_secs(20)))
            .expect("a socket");
        let Page { address, token } = self;
        let request = format!(
            "{first} HTTP/1.1\r\nHost: {address}\r\nOrigin: http://{address}\r\nX-Taceva-Token: {token}\r\nContent-Length: {}\r\n\r\n{body}",
            body.len()
        );
        stream.write_all(request.as_bytes()).expect("sent");
        stream
    }

    fn post(&self, path: &str, body: &str) {
        let mut answer = [0; 12];
        self.asked(&format!("POST {path}"), body)
            .read_exact(&mut answer)
            .expect("answered");
        assert_eq!(&answer, b"HTTP/1.1 204");
    }

    pub(crate) fn stop(&self) {
        self.post("/stop", "");
    }

    /// Starts a thread that answers every question on the page until the page closes.
    fn answer_everything(&self) {
        let page = self.clone();
        let mut events = page.asked("GET /events", "");
        std::thread::spawn(move || {
            let (mut read, mut answered) = (String::new(), 0);
            let mut bytes = [0; 8192];
            while let Ok(count @ 1..) = events.read(&mut bytes) {
                read.push_str(&String::from_utf8_lossy(&bytes[..count]));
                let asked = read.rsplit_once("\"question\":{\"number\":");
                let number = asked.and_then(|(_, rest)| rest.split_once(',')?.0.parse().ok());
                if let Some(number) = number.filter(|number: &u64| *number > answered) {
                    answered = number;
                    let body = format!("{{\"question\": {number}, \"answer\": \"done\"}}");
                    page.post("/answer", &body);
                }
                let kept = read.len().saturating_sub(64);
                let kept = (kept..=read.len()).find(|at| read.is_char_boundary(*at));
                read = read.split_off(kept.unwrap_or(0));
            }
        });
    }

    /// Reads the stream at `path` until it contains `words`.
    pub(crate) fn until(&self, path: &str, words: &[u8]) -> Vec<u8> {
        let mut stream = self.asked(&format!("GET {path}"), "");
        let began = Instant::now();
        let mut read = Vec::new();
        while !read.windows(words.len()).any(|part| part == words) {
            assert!(
                began.elapsed() < Duration::from_secs(120),
                "{path}: {} never came",
                words.escape_ascii()
            );
            let mut bytes = [0; 4096];
            let count = stream.read(&mut bytes).expect("it goes on");
            assert!(count > 0, "{path} ended");
            read.extend_from_slice(&bytes[..count]);
        }
        read
    }
}

#[test]
fn a_preview_shows_frames_and_forces_and_its_button_ends_it() {
    let emulated = Emulated::new();
    let bench = Bench::new();
    bench.write("hand.toml", &emulated.rig());
    let running = Running::start(&bench, "preview --rig hand.toml -q");
    let page = Page::of(&running);
    page.until("/frames", b"\xff\xd8\xff");
    page.until("/events", b"\"Fz_N\":");
    page.stop();
    let ran = running.ended();
    assert_eq!(ran.code, 0, "{}", ran.err);
}

#[test]
fn a_preview_of_a_camera_that_is_gone_says_so() {
    let emulated = Emulated::new();
    let bench = Bench::new();
    let words = format!("preview --sensor {}", emulated.sensor());
    let running = Running::start(&bench, &words);
    let page = Page::of(&running);
    page.until("/frames", b"\xff\xd8\xff");
    emulated.without_camera();
    let ran = running.ended();
    assert_eq!(ran.code, 4, "{}", ran.err);
    assert!(ran.err.contains("camera/mjpeg"), "{}", ran.err);
}

/// Limit of the stopping time of the arm, ms, on a machine that is not overloaded.
const STOPPED_MS: f64 = 100.0;

#[test]
fn the_button_of_a_run_stops_the_arm_and_the_run_goes_on_from_there() {
    let stops = std::env::var("TACEVA_STOPS").map_or(3, |text| text.parse().expect("a number"));
    let emulated = Emulated::new();
    let bench = Bench::new();
    bench.write("lab.toml", &emulated.rig_with_robot());
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/scenes/wire.toml");
    let run = format!("run {} --rig lab.toml --out r --page", scene.display());
    let mut took_ms: Vec<f64> = Vec::new();
    let mut sittings = 0;
    while took_ms.len() < stops {
        sittings += 1;
        assert!(sittings <= 2 * stops + 3, "{took_ms:?}");
        let resume = match bench.path("r").exists() {
            true => " --resume",
            false => "",
        };
        let mut running = Running::start(&bench, &format!("{run}{resume}"));
        let page = Page::of(&running);
        page.answer_everything();
        if sittings == 1 {
            page.until("/events", b"event: places");
            page.until("/events", b"\"Fz_N\":");
            page.until("/frames", b"\xff\xd8\xff");
        }
        if !in_a_long_motion(&emulated, &mut running) {
            // On a busy machine the guard ends a run by itself.
            continue;
        }
        let pressed = Instant::now();
        page.stop();
        while emulated.bench.truth().is_moving {
            assert!(pressed.elapsed() < Duration::from_secs(5), "it moves on");
        }
        took_ms.push(pressed.elapsed().as_secs_f64() * 1e3);
        let ran = running.ended();
        assert_eq!(ran.code, 5, "{}", ran.err);
        assert!(ran.err.contains("--resume"), "{}", ran.err);
        assert!(!emulated.bench.truth().is_moving, "the program has ended");
    }
    took_ms.sort_by(f64::total_cmp);
    let last = took_ms.len() - 1;
    let within = took_ms.iter().filter(|took| **took <= STOPPED_MS).count();
    print(&format!(
        "{stops} stops in {sittings} sittings: pressed to arm stopped, median {:.1} ms, 90 % {:.1} ms, most {:.1} ms; {within} within {STOPPED_MS} ms",
        took_ms[last / 2],
        took_ms[last * 9 / 10],
        took_ms[last]
    ));
    // Tolerance for a busy test machine; the limit is that of a quiet one.
    assert!(took_ms[last / 2] < 5.0 * STOPPED_MS, "{took_ms:?}");
}

#[expect(clippy::print_stderr, reason = "a test says what it measures")]
fn print(words: &str) {
    eprintln!("{words}");
}

/// Waits until the arm has moved for 80 ms, because short motions end by themselves. Returns true if the run lasts that long.
fn in_a_long_motion(emulated: &Emulated, running: &mut Running) -> bool {
    const LONG: Duration = Duration::from_millis(80);
    let began = Instant::now();
    let mut moving = None;
    loop {
        match emulated.bench.truth().is_moving {
            true => {
                let since: Instant = *moving.get_or_insert_with(Instant::now);
                if since.elapsed() > LONG {
                    return true;
                }
            }
            false => moving = None,
        }
        if running.has_ended() {
            return false;
        }
        assert!(
            began.elapsed() < Duration::from_secs(120),
            "it never moved: {}",
            running.said()
        );
        std::thread::sleep(Duration::from_millis(1));
    }
}
