//! Attempts to leave the sandbox. The attempts succeed in an unconfined program, and fail in a plugin of any user.

use std::net::{TcpListener, UdpSocket};
use std::os::unix::process::CommandExt;
use std::path::{Path, PathBuf};
use std::process::Command;

use taceva_host::Patience;

use crate::plugin::{Plugin, capture, sensor};

/// Attempts to leave the sandbox, in the order of `escapes.h`.
const ESCAPES: [&str; 18] = [
    "read a foreign file",
    "write outside",
    "connect by TCP",
    "send by UDP",
    "bind a port",
    "fork",
    "start a program",
    "signal the parent",
    "trace the parent",
    "open the memory of the parent",
    "read the memory of the parent",
    "mount",
    "make memory executable",
    "make a file to execute",
    "make a namespace",
    "outlive its parent",
    "show its memory",
    "take files of the parent",
];

/// Files and servers that the attempts to leave the sandbox try to reach.
struct Targets {
    folder: tempfile::TempDir,
    tcp: TcpListener,
    _udp: UdpSocket,
}

impl Targets {
    fn new() -> Targets {
        let tcp = TcpListener::bind("127.0.0.1:0").expect("a port");
        let address = tcp.local_addr().expect("bound");
        let targets = Targets {
            folder: tempfile::tempdir().expect("a folder"),
            _udp: UdpSocket::bind(address).expect("the same port"),
            tcp,
        };
        std::fs::write(targets.secret(), "secret").expect("written");
        targets
    }

    fn secret(&self) -> PathBuf {
        self.folder.path().join("secret")
    }

    fn outside(&self) -> PathBuf {
        self.folder.path().join("outside")
    }

    fn defines(&self) -> Vec<String> {
        let port = self.tcp.local_addr().expect("bound").port();
        vec![
            format!("-DSECRET={:?}", self.secret()),
            format!("-DOUTSIDE={:?}", self.outside()),
            format!("-DPORT={port}"),
        ]
    }
}

fn open_ones(attempts: &[u8]) -> Vec<&'static str> {
    let open = |(name, open): (&'static str, &u8)| (*open != 0).then_some(name);
    ESCAPES.into_iter().zip(attempts).filter_map(open).collect()
}

#[test]
fn every_way_out_is_open_to_a_program_and_closed_to_a_plugin() {
    let targets = Targets::new();
    let program = targets.folder.path().join("escapes");
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/hostile/escapes.h");
    let built = Command::new("cc")
        .args([
            "-std=c11",
            "-D_GNU_SOURCE",
            "-DESCAPES_MAIN",
            "-w",
            "-x",
            "c",
        ])
        .args(targets.defines())
        .arg(source)
        .arg("-o")
        .arg(&program)
        .status()
        .expect("a compiler of C");
    assert!(built.success());
    let ran = Command::new(&program).output().expect("it runs");
    let open = open_ones(&ran.stdout);
    if rustix::process::geteuid().is_root() {
        assert_eq!(
            open, ESCAPES,
            "an attempt that cannot succeed proves nothing"
        );
    } else {
        // A normal user may not mount. Some systems also forbid it to trace processes other than its children.
        assert!(open.len() >= 12, "{open:?}");
    }
    std::fs::remove_file(targets.outside()).expect("it was written");

    let plugin = Plugin::build("escapes", &targets.defines());
    let session = plugin.start(Patience::default(), None).expect("a child");
    let isolation = session.child().isolation();
    assert!(isolation.is_whole(), "{isolation}");
    let frame = capture(&mut *sensor(&session).expect("a sensor")).expect("a frame");
    assert_eq!(frame[ESCAPES.len()], 255, "all were tried");
    assert_eq!(open_ones(&frame), Vec::<&str>::new());
    assert!(!targets.outside().exists());
}

/// Repeats the attempts as a user who owns nothing, if the present user may switch to that user.
#[test]
fn every_way_out_is_closed_to_a_plugin_of_a_normal_user_too() {
    if !rustix::process::geteuid().is_root() {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let user = 65_533;
    std::os::unix::fs::chown(folder.path(), Some(user), Some(user)).expect("given away");
    let again = Command::new(std::env::current_exe().expect("this program"))
        .args([
            "--exact",
            "escape::every_way_out_is_open_to_a_program_and_closed_to_a_plugin",
        ])
        .env("TMPDIR", folder.path())
        .uid(user)
        .gid(user)
        .output()
        .expect("it runs");
    let said = String::from_utf8_lossy(&again.stdout);
    assert!(again.status.success(), "{said}");
    assert!(said.contains("1 passed"), "{said}");
}
