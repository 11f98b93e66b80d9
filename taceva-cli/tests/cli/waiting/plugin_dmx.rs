//! Lighting plugin `examples/plugins/dmx-light`: refused, allowed, and set through a port that the test reads.

#![cfg(target_os = "linux")]

use std::fs::{self, File};
use std::io::Read;
use std::os::unix::fs::PermissionsExt;
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant};

use crate::support::Bench;
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};

const KEY: &str = "org.example.dmx-light/dmx-light";

/// Opens a pseudo-terminal. Returns its path, and the bytes that it receives.
fn port() -> (String, Arc<Mutex<Vec<u8>>>) {
    let master = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY).expect("a terminal");
    grantpt(&master).expect("ours");
    unlockpt(&master).expect("ours");
    let name = ptsname(&master, Vec::new()).expect("it has a name");
    let name = name.to_str().expect("plain").to_owned();
    fs::set_permissions(&name, fs::Permissions::from_mode(0o666)).expect("ours");
    // Held open, so that the port does not close with its first user.
    let held = File::options().write(true).open(&name).expect("a port");
    let came = Arc::new(Mutex::new(Vec::new()));
    let heard = Arc::clone(&came);
    thread::spawn(move || {
        let _held = held;
        let mut master = File::from(master);
        let mut block = [0; 4096];
        while let Ok(length) = master.read(&mut block) {
            heard.lock().expect("whole").extend(&block[..length]);
        }
    });
    (name, came)
}

#[test]
fn the_light_is_allowed_and_every_byte_that_sets_it_comes_through_its_port() {
    let bench = Bench::new();
    bench.make_example("lighting", "dmx-light");
    let folder = "--plugin-dir dmx-light";
    assert_eq!(bench.run("plugin manifest dmx-light").code, 0);
    let (port, came) = port();
    let check = format!(
        "plugin check org.example.dmx-light {folder} --only driver/opens,lighting/ --with {KEY}:port={port};channel=3;settle=1"
    );
    let refused = bench.run(&check);
    assert_eq!(refused.code, 1, "{}", refused.out);
    assert!(
        came.lock().expect("whole").is_empty(),
        "nothing reached the port"
    );
    assert_eq!(bench.paste(&refused.out).code, 0);
    let checked = bench.ok(&check);
    assert!(checked.contains("lighting/sets-each-scene"), "{checked}");

    // Each scene twice: packets of 518 bytes, with the level of channel 3.
    let begun = Instant::now();
    let came = loop {
        let came = came.lock().expect("whole").clone();
        // The last packet may still be in the buffer of the terminal.
        if came.len() >= 8 * 518 && came.len() % 518 == 0 {
            break came;
        }
        assert!(
            begun.elapsed() < Duration::from_secs(20),
            "{} bytes",
            came.len()
        );
        thread::yield_now();
    };
    let packets: Vec<&[u8]> = came.chunks(518).collect();
    let levels: Vec<u8> = packets.iter().map(|packet| packet[4 + 3]).collect();
    assert_eq!(levels[..8], [0, 85, 170, 255, 0, 85, 170, 255]);
    for packet in packets {
        assert_eq!(packet[..5], [0x7e, 6, 0x01, 0x02, 0]);
        assert_eq!((packet.len(), packet[517]), (518, 0xe7));
        let lit = packet[5..517].iter().filter(|level| **level != 0).count();
        assert!(lit <= 1, "{packet:?}");
    }

    // An invalid port is refused before the plugin starts.
    bench.ok(&format!(
        "plugin allow org.example.dmx-light serial:/dev/null {folder}"
    ));
    let other = check.replace(&port, "/dev/null");
    let refused = bench.run(&other);
    assert_eq!(refused.code, 1, "{}", refused.out);
}
