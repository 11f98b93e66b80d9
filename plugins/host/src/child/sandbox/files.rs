//! Restriction of files, TCP ports and other processes by Landlock.

use std::path::{Path, PathBuf};

use landlock::{
    ABI, Access, AccessFs, AccessNet, BitFlags, CompatLevel, Compatible, LandlockStatus, NetPort,
    PathBeneath, PathFd, Ruleset, RulesetAttr, RulesetCreated, RulesetCreatedAttr, RulesetError,
    Scope,
};

use super::{Confinement, Need, devices};

/// Newest supported Landlock version. An older kernel enforces the rights that it supports.
const NEWEST: ABI = ABI::V7;

/// Files of the loader and the C library, which every child may read; no user files.
const READABLE: [&str; 12] = [
    "/lib",
    "/lib64",
    "/usr/lib",
    "/usr/lib64",
    "/usr/local/lib",
    "/etc/ld.so.cache",
    "/etc/localtime",
    "/usr/share/zoneinfo",
    // Memory map of this process only, to check the plugin's pointers.
    "/proc/self/maps",
    "/dev/zero",
    "/dev/random",
    "/dev/urandom",
];

/// Folders of the USB devices and their descriptions.
const USB: [&str; 3] = ["/dev/bus/usb", "/sys/bus/usb", "/sys/devices"];

/// Denies all files except system libraries, readable files and needed devices. Denies all TCP ports except needed ones, and access to all other
/// processes. Returns the enforcing Landlock version; `None` if the kernel has no Landlock.
pub(super) fn close_off(confinement: &Confinement) -> Result<Option<u32>, String> {
    restrict(confinement).map_err(|error| format!("cannot restrict files with Landlock: {error}"))
}

fn restrict(confinement: &Confinement) -> Result<Option<u32>, RulesetError> {
    let needs = confinement.needs.as_slice();
    let ruleset = Ruleset::default()
        .set_compatibility(CompatLevel::BestEffort)
        .handle_access(AccessFs::from_all(NEWEST))?
        .handle_access(AccessNet::from_all(NEWEST))?
        .scope(Scope::from_all(NEWEST))?
        .create()?;
    // No right to execute: mapping a library needs only read access.
    let read = AccessFs::ReadFile | AccessFs::ReadDir;
    let write = AccessFs::ReadFile | AccessFs::WriteFile;
    let device = read | AccessFs::WriteFile | AccessFs::IoctlDev;
    let mut ruleset = allow(ruleset, READABLE.iter().map(Path::new), read)?;
    ruleset = allow(ruleset, [Path::new("/dev/null")], write)?;
    let devices = devices::devices(needs);
    ruleset = allow(ruleset, devices.iter().map(PathBuf::as_path), device)?;
    let readable = devices::readable(needs);
    ruleset = allow(ruleset, readable.iter().map(PathBuf::as_path), read)?;
    let own = confinement.readable.iter().map(PathBuf::as_path);
    ruleset = allow(ruleset, own, read)?;
    if needs.contains(&Need::Usb) {
        ruleset = allow(ruleset, USB.iter().map(Path::new), device)?;
    }
    for need in needs {
        let (port, access) = match need {
            Need::Tcp { port, .. } => (*port, AccessNet::ConnectTcp),
            Need::Listen { port } => (*port, AccessNet::BindTcp),
            _ => continue,
        };
        ruleset = ruleset.add_rule(NetPort::new(port, access))?;
    }
    let status = ruleset.restrict_self()?;
    Ok(match status.landlock {
        LandlockStatus::Available {
            effective_abi,
            kernel_abi,
        } => {
            let version = kernel_abi.unwrap_or(effective_abi as i32);
            u32::try_from(version).ok()
        }
        LandlockStatus::NotEnabled | LandlockStatus::NotImplemented => None,
    })
}

/// Allows `access` to the existing `paths`. For a file, only rights that apply to files are allowed.
fn allow<'a>(
    mut ruleset: RulesetCreated,
    paths: impl IntoIterator<Item = &'a Path>,
    access: BitFlags<AccessFs>,
) -> Result<RulesetCreated, RulesetError> {
    for path in paths {
        let Ok(file) = PathFd::new(path) else {
            continue;
        };
        let access = if path.is_dir() {
            access
        } else {
            access & AccessFs::from_file(NEWEST)
        };
        ruleset = ruleset.add_rule(PathBeneath::new(file, access))?;
    }
    Ok(ruleset)
}
