//! Files that needs require: device files of the requested kinds, and system files that describe the devices.

use std::fs::{self, Metadata};
use std::os::unix::fs::{FileTypeExt, MetadataExt};
use std::path::{Path, PathBuf};

use super::Need;
use crate::manifest::matches;

/// Major device numbers of the kernel, from `Documentation/admin-guide/devices.txt`.
mod major {
    pub(super) const MEMORY: u32 = 1;
    pub(super) const CONSOLES_AND_PORTS: u32 = 4;
    pub(super) const OWN_TERMINAL: u32 = 5;
    pub(super) const PSEUDO_TERMINALS: std::ops::RangeInclusive<u32> = 136..=143;
}
/// First minor number of a serial port. Lower numbers are consoles.
const FIRST_PORT: u32 = 64;

/// Folders in which libraries find cameras.
const CAMERAS: [&str; 2] = ["/sys/class/video4linux", "/sys/devices"];
const HIDS: [&str; 3] = ["/sys/class/hidraw", "/sys/bus/hid", "/sys/devices"];

/// Existing device files that match `needs` and are of the requested kind.
pub(super) fn devices(needs: &[Need]) -> Vec<PathBuf> {
    let mut devices = Vec::new();
    for need in needs {
        let (pattern, is_kind): (&str, fn(&Path, &Metadata) -> bool) = match need {
            Need::Serial { path } => (path, |_, metadata| is_serial(metadata)),
            Need::Device { path } => (path, |_, metadata| is_device(metadata)),
            Need::Camera => ("/dev/video*", |_, metadata| is_device(metadata)),
            Need::Hid => ("/dev/hidraw*", |_, metadata| is_device(metadata)),
            _ => continue,
        };
        devices.extend(matching(pattern).into_iter().filter(|path| {
            let metadata = fs::metadata(path);
            metadata.is_ok_and(|metadata| is_kind(path, &metadata))
        }));
    }
    devices.sort();
    devices.dedup();
    devices
}

/// Files and folders that `needs` make readable.
pub(super) fn readable(needs: &[Need]) -> Vec<PathBuf> {
    let mut readable = Vec::new();
    for need in needs {
        match need {
            Need::Read { path } => readable.extend(matching(path)),
            Need::Camera => readable.extend(CAMERAS.map(PathBuf::from)),
            Need::Hid => readable.extend(HIDS.map(PathBuf::from)),
            _ => {}
        }
    }
    readable
}

/// True for a character device that is neither the machine's memory nor a user's terminal.
fn is_device(metadata: &Metadata) -> bool {
    let (major, minor) = numbers(metadata);
    let is_terminal =
        major == major::OWN_TERMINAL || (major == major::CONSOLES_AND_PORTS && minor < FIRST_PORT);
    metadata.file_type().is_char_device()
        && major != major::MEMORY
        && !is_terminal
        && own_terminal() != Some((major, minor))
}

/// Error text for the first serial need in `needs` whose file exists but is not a serial port. Patterns with a star are skipped.
pub(crate) fn no_port(needs: &[Need]) -> Option<String> {
    needs.iter().find_map(|need| match need {
        Need::Serial { path } if !need.has_star() => {
            let is_other = fs::metadata(path).is_ok_and(|metadata| !is_serial(&metadata));
            is_other.then(|| format!("`{need}`: not a serial port; use `device:` for other files"))
        }
        _ => None,
    })
}

/// True for a serial port or a pseudo-terminal. Does not open the port, because opening resets some boards.
fn is_serial(metadata: &Metadata) -> bool {
    let (major, minor) = numbers(metadata);
    let class = format!("/sys/dev/char/{major}:{minor}/subsystem");
    let is_tty = fs::read_link(class).is_ok_and(|class| class.ends_with("tty"));
    is_device(metadata) && (is_tty || major::PSEUDO_TERMINALS.contains(&major))
}

fn numbers(metadata: &Metadata) -> (u32, u32) {
    let device = metadata.rdev();
    (rustix::fs::major(device), rustix::fs::minor(device))
}

/// Device number of the process's controlling terminal; `None` without one.
fn own_terminal() -> Option<(u32, u32)> {
    let status = fs::read_to_string("/proc/self/stat").ok()?;
    // The name, in parentheses, may contain spaces. The terminal is the fifth field after it.
    let (_, behind) = status.rsplit_once(')')?;
    let number: u32 = behind
        .split_whitespace()
        .nth(4)?
        .parse::<i32>()
        .ok()?
        .cast_unsigned();
    let (major, minor) = (
        (number >> 8) & 0xfff,
        (number & 0xff) | ((number >> 12) & 0xf_ff00),
    );
    (number != 0).then_some((major, minor))
}

/// Existing paths that match `pattern`. `*` stands for any characters except `/`.
fn matching(pattern: &str) -> Vec<PathBuf> {
    if !pattern.contains('*') {
        let path = PathBuf::from(pattern);
        return if path.exists() {
            vec![path]
        } else {
            Vec::new()
        };
    }
    let mut found = vec![PathBuf::from("/")];
    for part in pattern.split('/').filter(|part| !part.is_empty()) {
        found = found
            .iter()
            .flat_map(|folder| {
                let entries = fs::read_dir(folder).into_iter().flatten().flatten();
                entries.map(|entry| entry.path())
            })
            .filter(|path| {
                let name = path.file_name().and_then(|name| name.to_str());
                name.is_some_and(|name| matches(part, name))
            })
            .collect();
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn need(text: &str) -> [Need; 1] {
        [text.parse().expect("a need")]
    }

    #[test]
    fn a_star_names_the_files_that_are_there() {
        let null = [PathBuf::from("/dev/null")];
        assert_eq!(matching("/dev/nul*"), null);
        assert_eq!(matching("/dev/n*l"), null);
        assert!(matching("/dev/no-such-port*").is_empty());
        assert!(matching("/dev/nul").is_empty());
        assert!(devices(&[Need::Usb]).is_empty());
    }

    #[test]
    fn memory_disks_folders_and_terminals_of_people_are_no_devices_of_a_plugin() {
        for text in [
            "device:/dev/null",
            "device:/dev/zero",
            "device:/dev/mem",
            "device:/dev/shm",
            "device:/dev/tty",
            "device:/dev/s*",
            "serial:/dev/null",
            "serial:/dev/tty",
            "serial:/dev/console",
            "serial:/dev/ptmx",
            "serial:/dev/shm",
        ] {
            let found = devices(&need(text));
            let is_plain =
                |path: &PathBuf| fs::metadata(path).is_ok_and(|metadata| is_device(&metadata));
            assert!(found.iter().all(is_plain), "{text}: {found:?}");
            if !text.contains('*') {
                assert!(found.is_empty(), "{text}: {found:?}");
            }
        }
    }

    #[test]
    fn what_is_no_serial_port_is_named() {
        let why = no_port(&need("serial:/dev/null")).expect("it is none");
        assert!(why.starts_with("`serial:/dev/null`: "), "{why}");
        assert_eq!(no_port(&need("serial:/dev/no-such-port")), None);
        assert_eq!(no_port(&need("usb")), None);
    }

    #[test]
    fn a_file_of_a_user_is_read_and_never_a_device() {
        let folder = tempfile::tempdir().expect("a folder");
        let text = format!("read:{}", folder.path().display());
        assert_eq!(readable(&need(&text)), [folder.path().to_owned()]);
        assert!(devices(&need(&text)).is_empty());
        assert!(readable(&need("usb")).is_empty());
    }
}
