//! Tests of accepted clients, and of clients that are rejected before their request is read.

use std::io::{Read, Write};
use std::net::TcpStream;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use super::support::{Opened, status};

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
    // A token in the URL is invalid: browser histories and logs keep URLs.
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
        // The server closes the connection during the write.
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
    // Other clients are served meanwhile and afterwards.
    assert_eq!(
        status(&opened.asked("POST /stop", &opened.own(), "")),
        "204"
    );
}

#[test]
fn a_fifth_stream_is_503_and_the_button_is_answered_beside_it() {
    let opened = Opened::new();
    let streams: Vec<TcpStream> = (0..4).map(|_| opened.stream("/events")).collect();
    let fifth = opened.asked("GET /frames", &opened.own(), "");
    assert_eq!(status(&fifth), "503", "four streams at most");
    assert_eq!(
        status(&opened.asked("POST /stop", &opened.own(), "")),
        "204"
    );
    drop(streams);
    let began = Instant::now();
    while status(&opened.asked("GET /nothing", &opened.own(), "")) != "404" {
        assert!(began.elapsed() < Duration::from_secs(10));
    }
}

#[test]
#[expect(clippy::print_stderr, reason = "the times are the result")]
fn sixty_four_slow_connections_never_keep_the_stop_button_from_answering() {
    const PRESSES: u32 = 100;
    /// Longest acceptable response time of the stop button.
    const IN_TIME: Duration = Duration::from_millis(100);
    let opened = Opened::new();
    let slow = |number: usize| {
        let mut stream = opened.connected();
        // Some clients send nothing, some half a request.
        let said: &[u8] = [&b""[..], b"POST /stop HTTP/1.1\r\nHost: "][number % 2];
        stream.write_all(said).expect("sent");
        stream
    };
    let mut beside: Vec<TcpStream> = (0..64).map(slow).collect();
    let mut took = Vec::new();
    for press in 0..PRESSES {
        let pressed = Instant::now();
        let answer = opened.asked("POST /stop", &opened.own(), "");
        took.push(pressed.elapsed());
        assert_eq!(status(&answer), "204", "press {press}");
    }
    took.sort();
    let in_time = took.iter().filter(|took| **took <= IN_TIME).count();
    eprintln!(
        "/stop beside 64 slow connections: {in_time} of {PRESSES} within {IN_TIME:?}, the middle {:?}, the slowest {:?}",
        took[took.len() / 2],
        took[took.len() - 1]
    );
    assert_eq!(opened.stops.load(Ordering::SeqCst), PRESSES);
    // The oldest connection was closed for a newer one, without a response.
    let mut answer = Vec::new();
    let closed = beside[0].read_to_end(&mut answer);
    assert!(
        closed.is_err() || answer.is_empty() || status(&String::from_utf8_lossy(&answer)) == "400"
    );
}
