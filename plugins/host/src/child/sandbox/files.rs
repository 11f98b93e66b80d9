//! Files, ports and other processes, closed off by Landlock.

use std::path::{Path, PathBuf};

use landlock::{
    ABI, Access, AccessFs, AccessNet, BitFlags, CompatLevel, Compatible, LandlockStatus, NetPort,
    PathBeneath, PathFd, Ruleset, RulesetAttr, RulesetCreated, RulesetCreatedAttr, RulesetError,
    Scope,
};

use super::{Confinement, Need, devices};

/// The newest version of Landlock whose rights are handled; an older kernel handles what it knows.
const NEWEST: ABI = ABI::V7;

/// What is read by the loader and by the C library: no file of a user.
const READABLE: [&str; 12] = [
    "/lib",
    "/lib64",
    "/usr/lib",
    "/usr/lib64",
    "/usr/local/lib",
    "/etc/ld.so.cache",
    "/etc/localtime",
    "/usr/share/zoneinfo",
    // By which pointers of a plugin are checked; of this process alone.
    "/proc/self/maps",
    "/dev/zero",
    "/dev/random",
    "/dev/urandom",
];

/// Where the devices of USB and what describes them are.
const USB: [&str; 3] = ["/dev/bus/usb", "/sys/bus/usb", "/sys/devices"];

/// Closes off every file but the libraries of the system, what is its own to read and the devices needed, every TCP port but those needed, and every other process.
/// Says which version of Landlock does so.
pub(super) fn close_off(confinement: &Confinement) -> Result<Option<u32>, String> {
    restrict(confinement).map_err(|error| format!("cannot close off files: {error}"))
}

fn restrict(confinement: &Confinement) -> Result<Option<u32>, RulesetError> {
    let needs = confinement.needs.as_slice();
    let ruleset = Ruleset::default()
        .set_compatibility(CompatLevel::BestEffort)
        .handle_access(AccessFs::from_all(NEWEST))?
        .handle_access(AccessNet::from_all(NEWEST))?
        .scope(Scope::from_all(NEWEST))?
        .create()?;
    // Without the right to execute: a library is mapped by whoever may read it.
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

/// Allows `access` to the paths that exist; of a file only what a file can have.
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
