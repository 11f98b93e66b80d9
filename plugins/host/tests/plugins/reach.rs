//! Access to each needed resource, tested by a plugin that uses it. Without permission, the access fails with the command that allows it. With
//! permission, the access succeeds. All other needs are allowed meanwhile, so a test also shows that none of them grants this access.

use std::collections::BTreeSet;
use std::fs;
use std::net::{TcpListener, UdpSocket};
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;

use rustix::fs::{FileType, Mode, makedev, mknodat};
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use taceva_core::{Args, Lighting};
use taceva_host::{Children, Need, PluginConfig, PluginHost, Plugins, SearchPath};
use taceva_needs::{Need as Missing, skip};
use tempfile::TempDir;

const ID: &str = "org.example.reach";
/// Device number of a character device that any user may open: `fuse`.
const OPENED_BY_ANYBODY: (u32, u32) = (10, 229);

/// Built test plugin and its needs.
struct Reach {
    folder: TempDir,
    needs: Vec<String>,
}

impl Reach {
    /// Builds the plugin with `needs`; `None` without a C compiler.
    fn built(needs: &[String]) -> Option<Reach> {
        let folder = tempfile::tempdir().expect("a folder");
        let here = Path::new(env!("CARGO_MANIFEST_DIR"));
        let built = Command::new("cc")
            .args(["-std=c11", "-shared", "-fPIC", "-fvisibility=hidden"])
            .args(["-Wall", "-Wextra", "-Werror", "-I"])
            .arg(here.join("../abi/include"))
            .arg(here.join("tests/reach/reach.c"))
            .arg("-o")
            .arg(folder.path().join("libreach.so"))
            .output();
        match built {
            Ok(done) => assert!(
                done.status.success(),
                "{}",
                String::from_utf8_lossy(&done.stderr)
            ),
            Err(error) => {
                skip(Missing::CCompiler, format!("`cc`: {error}"));
                return None;
            }
        }
        let quoted: Vec<String> = needs.iter().map(|need| format!("{need:?}")).collect();
        let manifest = format!(
            r#"manifest_version = 1
id = "{ID}"
name = "reach"
version = "1.0.0"
license = "MIT"
abi = {{ major = 1, minor = 0 }}
needs = [{}]
library.linux-x86_64.path = "libreach.so"
library.linux-aarch64.path = "libreach.so"

[[provides]]
kind = "lighting"
key = "lamp"
title = "lamp"
source = "real"
scenes = ["dark"]

[[provides.args]]
key = "way"
type = "text"

[[provides.args]]
key = "path"
type = "path"
optional = true

[[provides.args]]
key = "port"
type = "whole"
range = [1, 65535]
optional = true
"#,
            quoted.join(", ")
        );
        fs::write(folder.path().join("plugin.toml"), manifest).expect("written");
        Some(Reach {
            folder,
            needs: needs.to_vec(),
        })
    }

    /// Opens the lamp of the plugin with `arguments` and the needs in `allowed`. The error is a message.
    fn opened(&self, arguments: &str, allowed: &BTreeSet<Need>) -> Result<(), String> {
        let path = SearchPath::empty().given([self.folder.path().to_owned()]);
        let mut config = PluginConfig::default();
        let id = ID.parse().expect("an id");
        config.allow.insert(id, allowed.clone());
        let children = Children {
            program: Some(PathBuf::from(env!("CARGO_BIN_EXE_taceva-host-child"))),
            quarantine: None,
        };
        let log = Arc::new(|_: &_, _, _: &str, _: &str| {});
        let host = PluginHost::with_children(Plugins::search(path, &[]), config, log, children);
        let lamp = host.drivers::<dyn Lighting>().swap_remove(0);
        let args: Args = lamp.descriptor().args(arguments).expect("its own");
        let opened = lamp.open(&args, &mut taceva_core::Rig::new());
        opened.map(drop).map_err(|error| error.to_string())
    }

    /// All needs except `one`.
    fn all_but(&self, one: &str) -> BTreeSet<Need> {
        let others = self.needs.iter().filter(|need| *need != one);
        others.map(|need| need.parse().expect("a need")).collect()
    }

    /// Checks that a lamp with `arguments` is denied without `need`, and that the suggested command allows it.
    fn proves(&self, need: &str, arguments: &str) {
        let mut allowed = self.all_but(need);
        let why = self.opened(arguments, &allowed);
        let why = why.expect_err(&format!("{need}: nobody allowed it"));
        let (_, line) = why
            .split_once("; allow it: taceva plugin allow org.example.reach ")
            .unwrap_or_else(|| panic!("{need}: {why}"));
        let (words, _) = line
            .split_once(" --plugin-dir ")
            .expect("it is not installed");
        // Remove the shell quotes.
        let word = words.trim_matches('\'');
        assert_eq!(word, need, "{why}");
        allowed.insert(word.parse().expect("a need"));
        let opened = self.opened(arguments, &allowed);
        opened.unwrap_or_else(|why| panic!("{need} was allowed: {why}"));
    }
}

/// File that is removed on drop.
struct Removed(PathBuf);

impl Drop for Removed {
    fn drop(&mut self) {
        drop(fs::remove_file(&self.0));
    }
}

/// Creates a device file for all users; `None` if this user may not create it.
fn device(path: &str) -> Option<Removed> {
    let (major, minor) = OPENED_BY_ANYBODY;
    let mode = Mode::from_raw_mode(0o666);
    let made = mknodat(
        rustix::fs::CWD,
        path,
        FileType::CharacterDevice,
        mode,
        makedev(major, minor),
    );
    let removed = made.map(|()| Removed(PathBuf::from(path)));
    let usable = removed.map_err(std::io::Error::from).and_then(|removed| {
        fs::set_permissions(&removed.0, fs::Permissions::from_mode(0o666))?;
        fs::File::open(&removed.0)?;
        Ok(removed)
    });
    match usable {
        Ok(removed) => Some(removed),
        Err(error) => {
            skip(Missing::DeviceFiles, format!("{path}: {error}"));
            None
        }
    }
}

#[test]
fn connections_messages_and_waiting_are_given_word_by_word() {
    let tcp = TcpListener::bind("127.0.0.1:0").expect("a port");
    let udp = UdpSocket::bind("127.0.0.1:0").expect("a port");
    let free = TcpListener::bind("127.0.0.1:0").expect("a port");
    let port = |address: std::io::Result<std::net::SocketAddr>| address.expect("bound").port();
    let (to, message) = (port(tcp.local_addr()), port(udp.local_addr()));
    let wait = port(free.local_addr());
    drop(free);
    let words = [
        format!("tcp:127.0.0.1:{to}"),
        format!("udp:127.0.0.1:{message}"),
        format!("listen:{wait}"),
        "usb".to_owned(),
    ];
    let Some(reach) = Reach::built(&words) else {
        return;
    };
    reach.proves(&words[0], &format!("way=tcp;port={to}"));
    reach.proves(&words[1], &format!("way=udp;port={message}"));
    reach.proves(&words[2], &format!("way=listen;port={wait}"));
    reach.proves("usb", "way=usb");
    // With all needs, another port stays closed. No permission is suggested for undeclared needs.
    let other = TcpListener::bind("127.0.0.1:0").expect("a port");
    let other = other.local_addr().expect("bound").port();
    let all = reach.all_but("");
    for way in ["tcp", "listen"] {
        let why = reach.opened(&format!("way={way};port={other}"), &all);
        let why = why.expect_err("another port");
        assert!(
            why.contains("os error 13") && !why.contains("allow it"),
            "{why}"
        );
    }
}

#[test]
fn a_file_is_given_to_be_read_and_a_folder_with_all_in_it() {
    let files = tempfile::tempdir().expect("a folder");
    let everybody = fs::Permissions::from_mode(0o755);
    fs::set_permissions(files.path(), everybody).expect("ours");
    let (file, other) = (files.path().join("load"), files.path().join("other"));
    for path in [&file, &other] {
        fs::write(path, "51.2").expect("written");
        fs::set_permissions(path, fs::Permissions::from_mode(0o666)).expect("ours");
    }
    let (file, other) = (file.display(), other.display());
    let need = format!("read:{file}");
    let Some(reach) = Reach::built(std::slice::from_ref(&need)) else {
        return;
    };
    reach.proves(&need, &format!("way=read;path={file}"));
    let all = reach.all_but("");
    assert!(
        reach
            .opened(&format!("way=write;path={file}"), &all)
            .is_err()
    );
    assert!(
        reach
            .opened(&format!("way=read;path={other}"), &all)
            .is_err()
    );
    let folder = [format!("read:{}", files.path().display())];
    let Some(reach) = Reach::built(&folder) else {
        return;
    };
    reach.proves(&folder[0], &format!("way=read;path={other}"));
}

#[test]
fn cameras_scales_and_other_devices_are_given_by_their_words() {
    let name = format!("/dev/taceva-test-{}", std::process::id());
    let number = 200 + std::process::id() % 50;
    let paths = [
        format!("/dev/video{number}"),
        format!("/dev/hidraw{number}"),
        name,
    ];
    if paths.iter().any(|path| Path::new(path).exists()) {
        return;
    }
    let made: Vec<Removed> = paths.iter().map_while(|path| device(path)).collect();
    if made.len() < paths.len() {
        return;
    }
    let words = [
        "camera".to_owned(),
        "hid".to_owned(),
        format!("device:{}", paths[2]),
    ];
    let Some(reach) = Reach::built(&words) else {
        return;
    };
    for (word, path) in words.iter().zip(&paths) {
        reach.proves(word, &format!("way=device;path={path}"));
    }
}

#[test]
fn a_serial_port_is_given_and_by_that_word_nothing_that_is_none() {
    let master = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY).expect("a terminal");
    grantpt(&master).expect("ours");
    unlockpt(&master).expect("ours");
    let name = ptsname(&master, Vec::new()).expect("it has a name");
    let port = name.to_str().expect("plain").to_owned();
    fs::set_permissions(&port, fs::Permissions::from_mode(0o666)).expect("ours");
    let star = format!("serial:{}*", &port[..port.len() - 1]);
    for need in [format!("serial:{port}"), star] {
        let Some(reach) = Reach::built(std::slice::from_ref(&need)) else {
            return;
        };
        reach.proves(&need, &format!("way=device;path={port}"));
    }
    // A user may allow a part of a need.
    let Some(reach) = Reach::built(&["serial:/dev/pts/*".to_owned()]) else {
        return;
    };
    let one = format!("serial:{port}").parse().expect("a need");
    reach
        .opened(&format!("way=device;path={port}"), &BTreeSet::from([one]))
        .unwrap_or_else(|why| panic!("{why}"));
    // The file is a device but not a serial port.
    let path = format!("/dev/taceva-serial-{}", std::process::id());
    let Some(_device) = device(&path) else {
        return;
    };
    let need = format!("serial:{path}");
    let Some(reach) = Reach::built(std::slice::from_ref(&need)) else {
        return;
    };
    let why = reach.opened(&format!("way=device;path={path}"), &reach.all_but(""));
    let why = why.expect_err("no port");
    assert!(why.contains("not a serial port"), "{why}");
    // A need with a star does not open it either.
    let Some(reach) = Reach::built(&["serial:/dev/taceva-*".to_owned()]) else {
        return;
    };
    let why = reach.opened(&format!("way=device;path={path}"), &reach.all_but(""));
    assert!(why.expect_err("no port").contains("os error 13"));
}
