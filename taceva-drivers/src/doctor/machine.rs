//! Machine under diagnosis: a tree of files in the layout of Linux, and its USB devices.

use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};

use super::usb::{UsbDevice, plugged_in};
use super::user::User;
use crate::name_order;

/// Maximum number of bytes that the diagnosis reads of a system file. The largest such file is the table of groups.
const TEXT_BYTES: u64 = 1 << 20;

/// A machine, described by its files and its list of USB devices.
#[derive(Clone, Debug)]
pub struct Machine {
    root: PathBuf,
    /// USB devices, or the reason why they cannot be listed.
    pub(super) usb: Result<Vec<UsbDevice>, String>,
}

impl Machine {
    /// Creates the description of this machine.
    pub fn this() -> Machine {
        Machine {
            root: PathBuf::from("/"),
            usb: plugged_in(),
        }
    }

    /// Describes a machine whose files lie below the folder `root`, such as a mounted disk image. Its list of USB devices is empty.
    pub fn at(root: impl Into<PathBuf>) -> Machine {
        Machine {
            root: root.into(),
            usb: Ok(Vec::new()),
        }
    }

    /// Replaces the USB devices.
    pub fn with_usb(self, devices: Vec<UsbDevice>) -> Machine {
        Machine {
            usb: Ok(devices),
            ..self
        }
    }

    /// User who runs the program; `None` if unknown.
    pub(super) fn user(&self) -> Option<User> {
        let status = self.text("proc/self/status")?;
        let passwords = self.text("etc/passwd").unwrap_or_default();
        let groups = self.text("etc/group").unwrap_or_default();
        User::parse(&status, &passwords, &groups)
    }

    /// Sorted names of the files in a folder; empty if the folder does not exist.
    pub(super) fn names(&self, folder: &str) -> Vec<String> {
        let entries = fs::read_dir(self.path(folder)).into_iter().flatten();
        let mut names: Vec<String> = entries
            .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
            .collect();
        names.sort_by(|first, second| name_order::compare(first, second));
        names
    }

    /// Trimmed text of a small file; `None` if it cannot be read.
    pub(crate) fn text(&self, path: &str) -> Option<String> {
        let mut bytes = Vec::new();
        let file = fs::File::open(self.path(path)).ok()?;
        file.take(TEXT_BYTES).read_to_end(&mut bytes).ok()?;
        Some(String::from_utf8_lossy(&bytes).trim().to_owned())
    }

    /// Joins the root folder of this machine with `path`, which has no leading `/`.
    pub(crate) fn path(&self, path: &str) -> PathBuf {
        self.root.join(Path::new(path))
    }
}
