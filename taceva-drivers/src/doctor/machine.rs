//! The machine that is looked at: a tree of files laid out as Linux lays them out, and what is plugged into its USB.

use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};

use super::usb::{UsbDevice, plugged_in};
use super::user::User;
use crate::name_order;

/// Longest file that is read of a machine: its table of groups.
const TEXT_BYTES: u64 = 1 << 20;

/// A machine, as its files and the list of its USB devices describe it.
#[derive(Clone, Debug)]
pub struct Machine {
    root: PathBuf,
    /// Or why they cannot be listed.
    pub(super) usb: Result<Vec<UsbDevice>, String>,
}

impl Machine {
    /// This machine.
    pub fn this() -> Machine {
        Machine {
            root: PathBuf::from("/"),
            usb: plugged_in(),
        }
    }

    /// The machine whose root folder is `root`, with nothing on its USB; for a mounted image, and for tests.
    pub fn at(root: impl Into<PathBuf>) -> Machine {
        Machine {
            root: root.into(),
            usb: Ok(Vec::new()),
        }
    }

    /// The same machine with `devices` on its USB.
    pub fn with_usb(self, devices: Vec<UsbDevice>) -> Machine {
        Machine {
            usb: Ok(devices),
            ..self
        }
    }

    /// Who runs the program, if the machine says so.
    pub(super) fn user(&self) -> Option<User> {
        let status = self.text("proc/self/status")?;
        let passwords = self.text("etc/passwd").unwrap_or_default();
        let groups = self.text("etc/group").unwrap_or_default();
        User::parse(&status, &passwords, &groups)
    }

    /// The names in a folder, in their order; none if there is no such folder.
    pub(super) fn names(&self, folder: &str) -> Vec<String> {
        let entries = fs::read_dir(self.path(folder)).into_iter().flatten();
        let mut names: Vec<String> = entries
            .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
            .collect();
        names.sort_by(|first, second| name_order::compare(first, second));
        names
    }

    /// The text of a small file without the white space around it, if it can be read.
    pub(crate) fn text(&self, path: &str) -> Option<String> {
        let mut bytes = Vec::new();
        let file = fs::File::open(self.path(path)).ok()?;
        file.take(TEXT_BYTES).read_to_end(&mut bytes).ok()?;
        Some(String::from_utf8_lossy(&bytes).trim().to_owned())
    }

    /// Where `path`, which has no leading `/`, lies.
    pub(crate) fn path(&self, path: &str) -> PathBuf {
        self.root.join(Path::new(path))
    }
}
