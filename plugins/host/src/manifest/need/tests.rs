use std::collections::BTreeSet;

use taceva_core::{ArgSpec, Args};

use super::*;

fn need(text: &str) -> Need {
    text.parse().expect(text)
}

#[test]
fn a_need_reads_back_as_it_is_written() {
    for text in [
        "usb",
        "camera",
        "hid",
        "serial:/dev/ttyUSB*",
        "device:/dev/spidev0.*",
        "tcp:sensor.local:4008",
        "tcp:10.0.0.*:502",
        "udp:[fe80::1]:49152",
        "listen:5025",
        "read:/run/scale",
    ] {
        assert_eq!(need(text).to_string(), text);
    }
}

#[test]
fn what_could_reach_further_than_it_says_is_refused() {
    for (text, expected) in [
        ("usbs", "did you mean `usb`?"),
        ("usb:1", "did you mean `usb`?"),
        ("camera:0", "did you mean `camera`?"),
        ("serial:/etc/passwd", "below /dev"),
        ("serial:/dev/../etc/passwd", "below /dev"),
        ("serial:/dev/", "below /dev"),
        ("serial:/dev/tty{n}", "below /dev"),
        ("device:/dev/*", "`*` alone"),
        ("device:/dev/**", "`*` alone"),
        ("device:/dev/bus/*", "`*` alone"),
        ("device:/etc/shadow", "below /dev"),
        ("read:relative", "absolute"),
        ("read:/", "absolute"),
        ("read:/*", "`*` alone"),
        ("read:/srv/*/keys", "`*` alone"),
        ("read:/srv/../etc", "without `..`"),
        ("read:/proc/1/environ", "/proc"),
        ("read:/pro*/1/environ", "/proc"),
        ("read:/sys", "/sys"),
        ("listen:0", "1 to 65535"),
        ("listen:*", "1 to 65535"),
        ("listen:+80", "1 to 65535"),
        ("tcp:10.0.0.1", "ADDRESS:PORT"),
        ("tcp:10.0.0.1:0", "ADDRESS:PORT"),
        ("tcp:10.0.0.1:65536", "ADDRESS:PORT"),
        ("tcp:10.0.0.1:*", "ADDRESS:PORT"),
        ("tcp:*:502", "ADDRESS:PORT"),
        ("tcp:*.*.*.*:502", "ADDRESS:PORT"),
        ("udp::5", "ADDRESS:PORT"),
        ("everything", "expected one of"),
    ] {
        let error = text.parse::<Need>().expect_err(text).to_string();
        assert!(error.contains(expected), "{error}");
    }
}

#[test]
fn a_star_covers_what_it_says_and_nothing_beyond_a_part() {
    for (wide, narrow) in [
        ("serial:/dev/ttyUSB*", "serial:/dev/ttyUSB0"),
        ("serial:/dev/tty*", "serial:/dev/ttyUSB*"),
        ("device:/dev/spidev*.0", "device:/dev/spidev1.0"),
        ("tcp:10.0.0.*:502", "tcp:10.0.0.5:502"),
        ("tcp:Robot.local:502", "tcp:robot.local:502"),
        ("tcp:*.lab.example:502", "tcp:arm.lab.example:502"),
        ("read:/run/scale", "read:/run/scale"),
        ("read:/run/scale", "read:/run/scale/left"),
        ("read:/run/scale*", "read:/run/scale7/left"),
    ] {
        assert!(need(wide).covers(&need(narrow)), "{wide} {narrow}");
        assert_eq!(
            need(narrow).covers(&need(wide)),
            wide.eq_ignore_ascii_case(narrow)
        );
    }
    for (one, other) in [
        ("serial:/dev/ttyUSB*", "serial:/dev/ttyUSB0/mem"),
        ("serial:/dev/ttyUSB*", "device:/dev/ttyUSB0"),
        ("device:/dev/ttyUSB*", "serial:/dev/ttyUSB0"),
        ("serial:/dev/ttyUSB0", "serial:/dev/ttyUSB00"),
        ("tcp:10.0.0.*:502", "tcp:10.0.0.5:503"),
        ("tcp:10.0.0.*:502", "udp:10.0.0.5:502"),
        ("tcp:10.0.0.*:502", "tcp:10.0.0.5.example:502"),
        ("tcp:10.0.0.*:502", "tcp:10.0.0.example:502"),
        ("tcp:10.0.0.*:502", "tcp:10.0.1.5:502"),
        ("tcp:*.lab.example:502", "tcp:a.b.lab.example:502"),
        ("tcp:*.lab.example:502", "tcp:lab.example:502"),
        ("read:/run/scale", "read:/run/scales"),
        ("read:/run/scale/left", "read:/run/scale"),
        ("listen:5025", "listen:5026"),
        ("usb", "hid"),
    ] {
        assert!(!need(one).covers(&need(other)), "{one} {other}");
    }
}

#[test]
fn stars_cost_no_time_beyond_reason() {
    let pattern = format!("{}b", "a*".repeat(100));
    assert!(!matches(&pattern, &"a".repeat(2000)));
    assert!(matches("*a*b*", "xxaxxbxx") && matches("**", "") && !matches("a*", "ba"));
}

#[test]
fn less_than_what_is_needed_may_be_given_and_never_more() {
    let given = |asked: &str, allowed: &[&str]| {
        let allowed: BTreeSet<Need> = allowed.iter().map(|text| need(text)).collect();
        let given = need(asked).given_by(&allowed);
        given.iter().map(ToString::to_string).collect::<Vec<_>>()
    };
    assert_eq!(
        given("serial:/dev/ttyUSB0", &["serial:/dev/tty*"]),
        ["serial:/dev/ttyUSB0"]
    );
    assert_eq!(
        given(
            "serial:/dev/ttyUSB*",
            &["serial:/dev/ttyUSB1", "serial:/dev/ttyS0", "usb"]
        ),
        ["serial:/dev/ttyUSB1"]
    );
    assert!(given("usb", &["hid", "camera"]).is_empty());
}

#[test]
fn arguments_decide_one_thing_and_no_more() {
    let declared: DeclaredNeed = "tcp:{host}:{port}".parse().expect("declared");
    assert_eq!(declared.arguments().collect::<Vec<_>>(), ["host", "port"]);
    assert_eq!(declared.fixed(), None);
    let specs = [
        ArgSpec::text("host").optional(),
        ArgSpec::text("port").optional(),
    ];
    let bound = |text: &str| {
        let args = Args::parse(&specs, text).expect(text);
        let need = declared.bound_to(&args);
        need.map(|need| need.map(|need| need.to_string()))
    };
    assert_eq!(bound("host=10.0.0.5"), Ok(None));
    assert_eq!(
        bound("host=10.0.0.5;port=502"),
        Ok(Some("tcp:10.0.0.5:502".to_owned()))
    );
    assert_eq!(
        bound("host=fe80::1;port=502"),
        Ok(Some("tcp:[fe80::1]:502".to_owned()))
    );
    for hostile in [
        "host=10.0.0.*;port=502",
        "host=a:1;port=x",
        "host={port};port=1",
    ] {
        assert!(bound(hostile).is_err(), "{hostile}");
    }
    let serial: DeclaredNeed = "serial:{path}".parse().expect("declared");
    let args = Args::parse(&[ArgSpec::path("path")], "path=/etc/shadow").expect("a path");
    let error = serial.bound_to(&args).expect_err("no device").to_string();
    assert!(error.contains("below /dev"), "{error}");
    for wrong in [
        "tcp:{host}",
        "serial:/dev/{name}",
        "tcp:{Host}:1",
        "tcp:{}:1",
        "{usb}",
        "usb:{x}",
    ] {
        assert!(wrong.parse::<DeclaredNeed>().is_err(), "{wrong}");
    }
}

#[test]
fn a_user_may_allow_what_a_declared_need_can_become() {
    let declared: DeclaredNeed = "tcp:{host}:502".parse().expect("declared");
    for (text, is_asked) in [
        ("tcp:10.0.0.5:502", true),
        ("tcp:10.0.0.*:502", true),
        ("tcp:10.0.0.5:503", false),
        ("udp:10.0.0.5:502", false),
        ("usb", false),
    ] {
        assert_eq!(declared.asks_for(&need(text)), is_asked, "{text}");
    }
    let ports: DeclaredNeed = "serial:/dev/ttyUSB*".parse().expect("declared");
    assert!(ports.asks_for(&need("serial:/dev/ttyUSB0")));
    assert!(ports.asks_for(&need("serial:/dev/tty*")));
    assert!(!ports.asks_for(&need("serial:/dev/ttyS0")));
}
