//! Locks on the devices of a rig. The operating system releases them when the process ends, however it ends.

use std::collections::BTreeMap;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use taceva_protocol::{ContentId, RigFile};

use crate::error::AcquireError;
use crate::scene::{PlannedScene, StudySource};

/// Locked devices of rig files. Dropping this value releases the locks.
#[derive(Debug)]
pub struct HeldRigs {
    // Open files hold the locks.
    _locks: Vec<File>,
}

impl PlannedScene {
    /// Locks every device in the rig files of the scene against other runs. A scene without a rig file needs no lock.
    ///
    /// Each lock file is in the temporary folder of the machine, named by the digest of a device selector. Two rig files with the same robot selector
    /// therefore exclude each other. The files are empty and never removed.
    ///
    /// # Errors
    /// [`AcquireError::RigTaken`] if another process uses a device. [`AcquireError::RigLock`] if a lock cannot be acquired.
    pub fn hold_rigs(&self) -> Result<HeldRigs, AcquireError> {
        self.hold_rigs_in(&std::env::temp_dir())
    }

    fn hold_rigs_in(&self, folder: &Path) -> Result<HeldRigs, AcquireError> {
        let mut devices = BTreeMap::new();
        for study in &self.studies {
            let (StudySource::Rig(spec), Some(rig)) = (&study.source, &study.study.rig) else {
                continue;
            };
            let selectors = [&spec.sensor, &spec.robot, &spec.force];
            let operator = rig.operator.as_ref();
            let switch = operator.map(|operator| &operator.enable);
            let changers = [&rig.changers.specimen, &rig.changers.unit, &spec.lighting];
            let devices_of = selectors.into_iter().chain(changers).flatten();
            for device in devices_of.chain(switch) {
                devices.insert(device.value.clone(), rig.name().to_owned());
            }
        }
        HeldRigs::take(folder, devices)
    }
}

impl HeldRigs {
    /// Locks every device of `rig` for its setup.
    ///
    /// # Errors
    /// Errors of [`PlannedScene::hold_rigs`].
    pub fn of_file(rig: &RigFile) -> Result<HeldRigs, AcquireError> {
        let drivers = [
            rig.sensor.as_ref().map(|sensor| &sensor.driver),
            rig.robot.as_ref().map(|robot| &robot.driver),
            rig.force.as_ref().map(|force| &force.driver),
            rig.operator.as_ref().map(|operator| &operator.enable),
            rig.changers.specimen.as_ref(),
            rig.changers.unit.as_ref(),
            rig.changers.light.as_ref(),
        ];
        let devices = drivers.into_iter().flatten();
        let devices = devices.map(|driver| (driver.value.clone(), rig.name().to_owned()));
        HeldRigs::take(&std::env::temp_dir(), devices.collect())
    }

    /// Locks `devices`, each with the rig file or option that names it.
    pub(crate) fn take(
        folder: &Path,
        devices: BTreeMap<String, String>,
    ) -> Result<HeldRigs, AcquireError> {
        // Two spellings of one device share a lock.
        let devices = devices.into_iter();
        let by_path: BTreeMap<PathBuf, (String, String)> = devices
            .map(|(device, rig)| (lock_path(folder, &device), (device, rig)))
            .collect();
        let locks = by_path
            .iter()
            .map(|(path, (device, rig))| take(path, device, rig));
        let locks: Result<Vec<File>, AcquireError> = locks.collect();
        Ok(HeldRigs { _locks: locks? })
    }
}

/// Path of the lock file of a device. Blanks in its selector and the order of arguments do not change the path.
fn lock_path(folder: &Path, device: &str) -> PathBuf {
    let (driver, arguments) = device.split_once(':').unwrap_or((device, ""));
    let mut words: Vec<&str> = arguments.split(';').map(str::trim).collect();
    words.sort_unstable();
    let identity = format!("{}:{}", driver.trim(), words.join(";"));
    folder.join(format!("taceva-rig-{}.lock", ContentId::of_text(&identity)))
}

fn take(path: &Path, device: &str, rig: &str) -> Result<File, AcquireError> {
    let unusable = |error: std::io::Error| AcquireError::RigLock {
        path: path.to_owned(),
        problem: format!(
            "cannot create the lock of `{}`: {error}",
            taceva_core::shown(device)
        ),
    };
    // A lock file of another user is readable, which is enough to lock it.
    let file = match File::open(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => {
            let made = OpenOptions::new().write(true).create_new(true).open(path);
            match made {
                // Another process has created the file meanwhile.
                Err(error) if error.kind() == ErrorKind::AlreadyExists => File::open(path),
                made => made,
            }
        }
        opened => opened,
    };
    let file = file.map_err(unusable)?;
    match file.try_lock() {
        Ok(()) => Ok(file),
        Err(TryLockError::WouldBlock) => Err(AcquireError::RigTaken {
            rig: rig.to_owned(),
            device: device.to_owned(),
        }),
        Err(TryLockError::Error(error)) => Err(unusable(error)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_device_that_is_held_is_refused_by_name_until_it_is_let_go() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = lock_path(folder.path(), "ufactory/xarm:host=10.0.0.2");
        let (device, rig) = ("ufactory/xarm:host=10.0.0.2", "lab.toml");
        let held = take(&path, device, rig).expect("free");
        let error = take(&path, device, rig).expect_err("held");
        let said = error.to_string();
        assert!(
            said.starts_with("lab.toml: `ufactory/xarm:host=10.0.0.2` is in use by another run"),
            "{said}"
        );
        let named = |device: &str| lock_path(folder.path(), device);
        assert_eq!(named("lab/arm:a=1;b=2"), named(" lab/arm: b=2; a=1"));
        let other = named("ufactory/xarm:host=10.0.0.3");
        take(&other, device, rig).expect("another arm is free");
        drop(held);
        take(&path, device, rig).expect("free again");
    }

    #[test]
    fn the_light_of_a_rig_file_is_held_too() {
        // Locks are those of the machine: no other process has this lamp.
        let lamp = format!("lab/lamp:id={}", std::process::id());
        let text = format!("rig_version = 1\n[changers]\nlight = \"{lamp}\"\n");
        let rig = RigFile::parse("lab.toml", &text).expect("a rig file");
        let _held = HeldRigs::of_file(&rig).expect("free");
        let error = HeldRigs::of_file(&rig).expect_err("held").to_string();
        assert!(error.contains(&lamp), "{error}");
    }
}
