//! The page over its socket: who is let in, who is refused, and that nobody is waited for.

use std::io::{Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant};

use taceva_core::{Frame, FrameInfo, Newton, PixelFormat, Wrench};
use taceva_live::{Limits, Live, Page, PageOperator};
use taceva_protocol::{Answer, Cancel, Operator, Question};

/// A page, and how often somebody pressed stop.
struct Opened {
    live: Live,
    page: Page,
    stops: Arc<AtomicU32>,
}

impl Opened {
    fn new() -> Opened {
        let live = Live::new("a test");
        let stops = Arc::new(AtomicU32::new(0));
        let counted = Arc::clone(&stops);
        let page = Page::open(&live, 0, move || {
            counted.fetch_add(1, Ordering::SeqCst);
        });
        Opened {
            live,
            page: page.expect("a port"),
            stops,
        }
    }

    fn token(&self) -> String {
        let url = self.page.url();
        let (_, token) = url.split_once('#').expect("a token");
        token.to_owned()
    }

    fn address(&self) -> SocketAddr {
        self.page.address()
    }

    fn connected(&self) -> TcpStream {
        let stream = TcpStream::connect(self.address()).expect("it listens");
        stream
            .set_read_timeout(Some(Duration::from_secs(20)))
            .expect("a socket");
        stream
    }

    /// The answer to a request with these header lines; the token is among them if `lines` says so.
    fn asked(&self, first: &str, lines: &str, body: &str) -> String {
        let mut stream = self.connected();
        let request = format!(
            "{first} HTTP/1.1\r\n{lines}Content-Length: {}\r\n\r\n{body}",
            body.len()
        );
        stream.write_all(request.as_bytes()).expect("sent");
        let mut answer = String::new();
        stream.read_to_string(&mut answer).expect("answered");
        answer
    }

    /// The header lines of the page itself.
    fn own(&self) -> String {
        let (address, token) = (self.address(), self.token());
        format!("Host: {address}\r\nOrigin: http://{address}\r\nX-Taceva-Token: {token}\r\n")
    }

    /// A stream, read until its head has come.
    fn stream(&self, path: &str) -> TcpStream {
        let mut stream = self.connected();
        let request = format!("GET {path} HTTP/1.1\r\n{}\r\n", self.own());
        stream.write_all(request.as_bytes()).expect("sent");
        let mut head = Vec::new();
        while !head.ends_with(b"\r\n\r\n") {
            let mut byte = [0];
            stream.read_exact(&mut byte).expect("a head");
            head.push(byte[0]);
        }
        let head = String::from_utf8(head).expect("text");
        assert!(head.starts_with("HTTP/1.1 200"), "{head}");
        stream
    }
}

fn status(answer: &str) -> &str {
    answer.get(9..12).unwrap_or_default()
}

fn frame(level: u8, width: u32) -> Frame {
    let info = FrameInfo {
        width,
        height: width,
        format: PixelFormat::Gray8,
    };
    let pixels = vec![level; info.byte_len().expect("small")];
    Frame::new(info, pixels).expect("whole")
}

/// Reads until `words` came.
fn until(stream: &mut TcpStream, words: &str) -> String {
    let began = Instant::now();
    let mut read = Vec::new();
    while !String::from_utf8_lossy(&read).contains(words) {
        assert!(
            began.elapsed() < Duration::from_secs(20),
            "`{words}` never came"
        );
        let mut bytes = [0; 4096];
        let count = stream.read(&mut bytes).expect("it goes on");
        assert!(count > 0, "it ended before `{words}`");
        read.extend_from_slice(&bytes[..count]);
    }
    String::from_utf8_lossy(&read).into_owned()
}

#[test]
fn the_page_is_given_to_anybody_on_this_machine_and_holds_no_secret() {
    let opened = Opened::new();
    let host = format!("Host: {}\r\n", opened.address());
    for (path, kind) in [
        ("/", "text/html"),
        ("/page.css", "text/css"),
        ("/page.js", "text/javascript"),
    ] {
        let answer = opened.asked(&format!("GET {path}"), &host, "");
        assert_eq!(status(&answer), "200", "{path}");
        for word in [
            kind,
            "default-src 'none'",
            "script-src 'self'",
            "frame-ancestors 'none'",
            "no-store",
            "nosniff",
        ] {
            assert!(answer.contains(word), "{path} without {word}");
        }
        assert!(!answer.contains(&opened.token()), "{path}");
    }
    assert_eq!(opened.address().ip().to_string(), "127.0.0.1");
}

#[test]
fn a_wrong_token_is_401_and_nothing_stops() {
    let opened = Opened::new();
    let host = format!("Host: {}\r\n", opened.address());
    let other = "0".repeat(32);
    for line in [
        String::new(),
        "X-Taceva-Token: \r\n".to_owned(),
        format!("X-Taceva-Token: {other}\r\n"),
        format!("X-Taceva-Token: {}0\r\n", opened.token()),
    ] {
        for first in ["POST /stop", "POST /answer", "GET /events", "GET /frames"] {
            let answer = opened.asked(first, &format!("{host}{line}"), "");
            assert_eq!(status(&answer), "401", "{first} with {line:?}");
        }
    }
    // In the address it is none: addresses are kept in histories and logs.
    let first = format!("POST /stop?token={}", opened.token());
    assert_eq!(status(&opened.asked(&first, &host, "")), "401");
    assert_eq!(opened.stops.load(Ordering::SeqCst), 0);
}

#[test]
fn a_foreign_host_is_421_and_a_foreign_origin_403() {
    let opened = Opened::new();
    let (address, token) = (opened.address(), opened.token());
    let token = format!("X-Taceva-Token: {token}\r\n");
    for host in [
        "",
        "Host: rig.example\r\n",
        "Host: 127.0.0.1\r\n",
        "Host: 127.0.0.1:1\r\n",
    ] {
        for first in ["GET /", "POST /stop"] {
            let answer = opened.asked(first, &format!("{host}{token}"), "");
            assert_eq!(status(&answer), "421", "{first} {host:?}");
        }
    }
    for origin in [
        "http://rig.example".to_owned(),
        "null".to_owned(),
        format!("https://{address}"),
        format!("http://localhost:{}", address.port()),
    ] {
        let lines = format!("Host: {address}\r\nOrigin: {origin}\r\n{token}");
        let answer = opened.asked("POST /stop", &lines, "");
        assert_eq!(status(&answer), "403", "{origin}");
    }
    let by_name = format!("localhost:{}", address.port());
    let lines = format!("Host: {by_name}\r\nOrigin: http://{by_name}\r\n{token}");
    assert_eq!(opened.stops.load(Ordering::SeqCst), 0);
    assert_eq!(status(&opened.asked("POST /stop", &lines, "")), "204");
    assert_eq!(opened.stops.load(Ordering::SeqCst), 1);
}

#[test]
fn paths_and_methods_that_are_none_are_404_and_405() {
    let opened = Opened::new();
    let own = opened.own();
    assert_eq!(status(&opened.asked("GET /etc/passwd", &own, "")), "404");
    for first in [
        "GET /stop",
        "GET /answer",
        "POST /",
        "POST /events",
        "DELETE /stop",
    ] {
        assert_eq!(status(&opened.asked(first, &own, "")), "405", "{first}");
    }
    for body in ["", "{}", "[1]", "{\"question\": 1, \"answer\": \"yes\"}"] {
        assert_eq!(status(&opened.asked("POST /answer", &own, body)), "400");
    }
    let unasked = "{\"question\": 1, \"answer\": \"done\"}";
    assert_eq!(status(&opened.asked("POST /answer", &own, unasked)), "409");
}

#[test]
fn an_oversized_request_is_refused_before_it_is_read() {
    let opened = Opened::new();
    let own = opened.own();
    let answer = opened.asked("POST /answer", &own, &"x".repeat(1025));
    assert_eq!(status(&answer), "413");
    let long = format!("GET /{}", "a".repeat(10_000));
    assert_eq!(status(&opened.asked(&long, &own, "")), "431");
    let many = "A: b\r\n".repeat(40);
    assert_eq!(status(&opened.asked("GET /", &many, "")), "431");
}

#[test]
fn header_lines_without_an_end_are_cut_off_by_length_and_by_time() {
    let opened = Opened::new();
    let mut endless = opened.connected();
    endless.write_all(b"GET / HTTP/1.1\r\n").expect("sent");
    let mut is_refused = false;
    for _ in 0..2000 {
        // The server closes while this still writes.
        if endless
            .write_all(b"X-Line: and so on, and so on\r\n")
            .is_err()
        {
            is_refused = true;
            break;
        }
    }
    let mut answer = Vec::new();
    let _ = endless.read_to_end(&mut answer);
    let answer = String::from_utf8_lossy(&answer);
    assert!(is_refused || status(&answer) == "431", "{answer}");

    let began = Instant::now();
    let mut slow = opened.connected();
    slow.write_all(b"GET / HTTP/1.1\r\nHost: ").expect("sent");
    let mut answer = String::new();
    slow.read_to_string(&mut answer).expect("answered");
    assert_eq!(status(&answer), "408");
    assert!(began.elapsed() < Duration::from_secs(15));
    // Others are served meanwhile and after it.
    assert_eq!(
        status(&opened.asked("POST /stop", &opened.own(), "")),
        "204"
    );
}

#[test]
fn a_ninth_connection_is_503_and_streams_leave_room_for_the_button() {
    let opened = Opened::new();
    let streams: Vec<TcpStream> = (0..4).map(|_| opened.stream("/events")).collect();
    let fifth = opened.asked("GET /frames", &opened.own(), "");
    assert_eq!(status(&fifth), "503", "four streams at most");
    assert_eq!(
        status(&opened.asked("POST /stop", &opened.own(), "")),
        "204"
    );
    let idle: Vec<TcpStream> = (0..4).map(|_| opened.connected()).collect();
    // They have been accepted once the one behind them is answered.
    let mut ninth = opened.connected();
    let mut answer = String::new();
    ninth.read_to_string(&mut answer).expect("answered unasked");
    assert_eq!(status(&answer), "503");
    drop((streams, idle));
    let began = Instant::now();
    loop {
        let mut again = opened.connected();
        let request = format!("POST /stop HTTP/1.1\r\n{}\r\n", opened.own());
        let mut answer = String::new();
        let asked = again.write_all(request.as_bytes());
        if asked.is_ok() && again.read_to_string(&mut answer).is_ok() && status(&answer) == "204" {
            break;
        }
        assert!(began.elapsed() < Duration::from_secs(10), "{answer}");
        std::thread::sleep(Duration::from_millis(50));
    }
}

#[test]
fn events_say_what_is_known_ten_times_a_second() {
    let opened = Opened::new();
    let mut events = opened.stream("/events");
    opened.live.limits(Limits::none().with_forces(2.0, 1.0));
    let wrench = Wrench {
        force: [Newton(0.3), Newton(0.4), Newton(1.25)],
        ..Wrench::default()
    };
    opened.live.force(&wrench);
    opened.live.lost(3, 1, true);
    let said = until(&mut events, "\"Fz_N\":1.25");
    let said = said + &until(&mut events, "\"dropped\":3");
    assert!(said.contains("\"Fxy_N\":0.5"), "{said}");
    assert!(said.contains("\"Fz_max_N\":2.0"), "{said}");
    let began = Instant::now();
    let mut count = 0;
    while began.elapsed() < Duration::from_secs(2) {
        until(&mut events, "event: state");
        count += 1;
    }
    assert!((5..=25).contains(&count), "{count} in two seconds");
    opened.live.ended("the run is finished");
    drop(opened.page);
    until(&mut events, "the run is finished");
}

#[test]
fn pictures_come_as_jpeg_and_the_newest_first() {
    let opened = Opened::new();
    let mut frames = opened.stream("/frames");
    let live = opened.live.clone();
    std::thread::spawn(move || {
        for level in 0..200 {
            live.frame(&frame(level, 32));
            std::thread::sleep(Duration::from_millis(10));
        }
    });
    let said = until(&mut frames, "image/jpeg");
    assert!(said.contains("--taceva-picture"), "{said}");
    let answer = opened.asked("POST /stop", &opened.own(), "");
    assert_eq!(status(&answer), "204", "a stream is in nobody's way");
}

#[test]
fn who_comes_late_sees_the_last_frame() {
    let opened = Opened::new();
    opened.live.frame(&frame(90, 16));
    let mut frames = opened.stream("/frames");
    until(&mut frames, "image/jpeg");
}

#[test]
fn a_slow_browser_and_one_that_vanished_delay_nobody() {
    let opened = Opened::new();
    // One that takes nothing at all, and one that is gone.
    let slow = opened.stream("/frames");
    drop(opened.stream("/frames"));
    let noisy = {
        let mut state = 1_u32;
        let pixels = (0..640 * 480).map(|_| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            state.to_le_bytes()[3]
        });
        let info = FrameInfo {
            width: 640,
            height: 480,
            format: PixelFormat::Gray8,
        };
        Frame::new(info, pixels.collect()).expect("whole")
    };
    let mut longest = Duration::ZERO;
    let began = Instant::now();
    while began.elapsed() < Duration::from_secs(4) {
        let at = Instant::now();
        opened.live.frame(&noisy);
        longest = longest.max(at.elapsed());
        std::thread::sleep(Duration::from_millis(10));
    }
    // A copy of a frame, and what a busy machine adds to it.
    assert!(longest < Duration::from_millis(500), "{longest:?}");
    let answer = opened.asked("POST /stop", &opened.own(), "");
    assert_eq!(status(&answer), "204");
    drop(slow);
}

#[test]
fn the_page_answers_whoever_asks_and_stop_answers_for_it() {
    let opened = Opened::new();
    let mut operator = PageOperator::new(opened.live.clone());
    let mut events = opened.stream("/events");
    let cancel = Cancel::new();
    let answers = std::thread::scope(|scope| {
        let asking = scope.spawn(|| {
            [1, 2].map(|number| operator.ask(&Question::Unit(number.to_string()), &cancel))
        });
        until(&mut events, "put unit 1 in place");
        let body = "{\"question\": 1, \"answer\": \"skip\"}";
        assert_eq!(
            status(&opened.asked("POST /answer", &opened.own(), body)),
            "204"
        );
        until(&mut events, "put unit 2 in place");
        // Pressed twice: the second is none to the question after it.
        assert_eq!(
            status(&opened.asked("POST /answer", &opened.own(), body)),
            "409"
        );
        assert_eq!(
            status(&opened.asked("POST /stop", &opened.own(), "")),
            "204"
        );
        asking.join().expect("no panic")
    });
    assert_eq!(answers, [Answer::Skip, Answer::Stop]);
}
