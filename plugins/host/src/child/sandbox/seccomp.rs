//! System-call filter of a child: a fixed list of allowed calls. Every other call fails with "not permitted".
//!
//! Filters accumulate. The first filter is set before the library is loaded. The second filter is set afterwards, because only loading maps code. No memory is
//! ever both writable and executable.

mod numbers;

use std::collections::BTreeMap;

use libc::{
    SYS_clone, SYS_clone3, SYS_fcntl, SYS_ioctl, SYS_kill, SYS_mmap, SYS_mprotect, SYS_prctl,
    SYS_prlimit64, SYS_seccomp, SYS_socket, SYS_tgkill,
};
use seccompiler::{
    BackendError, BpfProgram, SeccompAction, SeccompCmpArgLen, SeccompCmpOp, SeccompCondition,
    SeccompFilter, SeccompRule, TargetArch, apply_filter, apply_filter_all_threads,
};

use self::numbers::{ALWAYS, ALWAYS_TOO, FILE_CONTROLS, LISTENING, PROCESS_CONTROLS, SOCKETS};
use super::Need;

type Rules = BTreeMap<i64, Vec<SeccompRule>>;

/// Allows the listed calls and the calls that `needs` require. Returns the number of distinct calls.
///
/// # Errors
/// A message that names the failure.
pub(super) fn filter_for_loading(needs: &[Need]) -> Result<Option<u32>, String> {
    let rules = rules(needs).map_err(|error| said(&error))?;
    let count = u32::try_from(rules.len()).ok();
    // A denied call fails with EPERM, like a privileged one. `clone3`, whose arguments cannot be checked, fails with ENOSYS, as on an old
    // kernel.
    let denied = SeccompAction::Errno(libc::EPERM.unsigned_abs());
    let allowed = program(rules, denied, SeccompAction::Allow)?;
    let unknown = SeccompAction::Errno(libc::ENOSYS.unsigned_abs());
    let absent = program(
        Rules::from([(SYS_clone3, Vec::new())]),
        SeccompAction::Allow,
        unknown,
    )?;
    apply_filter(&absent).map_err(|error| said(&error))?;
    apply_filter(&allowed).map_err(|error| said(&error))?;
    Ok(count)
}

/// Denies mapping of code, on every thread.
///
/// # Errors
/// As [`filter_for_loading`].
pub(super) fn filter_after_loading() -> Result<(), String> {
    let executable = || -> Result<Vec<SeccompRule>, BackendError> {
        Ok(vec![rule(&[masked(2, libc::PROT_EXEC, libc::PROT_EXEC)?])?])
    };
    let rules = executable().map_err(|error| said(&error))?;
    let denied = SeccompAction::Errno(libc::EPERM.unsigned_abs());
    let rules = Rules::from([(SYS_mmap, rules)]);
    let filter = program(rules, SeccompAction::Allow, denied)?;
    apply_filter_all_threads(&filter).map_err(|error| said(&error))
}

fn said(error: &dyn std::fmt::Display) -> String {
    format!("cannot filter system calls: {error}")
}

fn program(
    rules: Rules,
    otherwise: SeccompAction,
    matching: SeccompAction,
) -> Result<BpfProgram, String> {
    let architecture = std::env::consts::ARCH;
    let architecture = TargetArch::try_from(architecture).map_err(|error| said(&error))?;
    SeccompFilter::new(rules, otherwise, matching, architecture)
        .and_then(BpfProgram::try_from)
        .map_err(|error| said(&error))
}

fn rules(needs: &[Need]) -> Result<Rules, BackendError> {
    let own = u64::from(std::process::id());
    let mut rules: Rules = ALWAYS
        .iter()
        .chain(ALWAYS_TOO)
        .map(|call| (*call, Vec::new()))
        .collect();
    // The other filter denies `clone3`, because its arguments are in memory. The C library then falls back to `clone`.
    rules.insert(SYS_clone3, Vec::new());
    rules.insert(
        SYS_clone,
        vec![rule(&[masked(0, libc::CLONE_THREAD, libc::CLONE_THREAD)?])?],
    );
    rules.insert(
        SYS_mmap,
        vec![
            rule(&[masked(2, libc::PROT_EXEC, 0)?])?,
            // Code must come from a private mapping of a file.
            rule(&[
                masked(2, libc::PROT_EXEC | libc::PROT_WRITE, libc::PROT_EXEC)?,
                masked(3, libc::MAP_ANONYMOUS | libc::MAP_SHARED, 0)?,
            ])?,
        ],
    );
    rules.insert(SYS_mprotect, vec![rule(&[masked(2, libc::PROT_EXEC, 0)?])?]);
    for call in [SYS_kill, SYS_tgkill] {
        rules.insert(call, vec![rule(&[equal(0, own)?])?]);
    }
    rules.insert(
        SYS_prlimit64,
        vec![rule(&[equal(0, 0)?])?, rule(&[equal(0, own)?])?],
    );
    // Sets the second filter. Filters can only remove rights.
    let add_filter = u64::from(libc::SECCOMP_SET_MODE_FILTER);
    rules.insert(SYS_seccomp, vec![rule(&[equal(0, add_filter)?])?]);
    rules.insert(SYS_fcntl, any_of(1, FILE_CONTROLS)?);
    rules.insert(SYS_prctl, any_of(0, PROCESS_CONTROLS)?);
    rules.insert(SYS_ioctl, device_controls(needs)?);
    let sockets = sockets(needs)?;
    if !sockets.is_empty() {
        rules.insert(SYS_socket, sockets);
        rules.extend(SOCKETS.iter().map(|call| (*call, Vec::new())));
    }
    if needs.iter().any(|need| matches!(need, Need::Listen { .. })) {
        rules.extend(LISTENING.iter().map(|call| (*call, Vec::new())));
    }
    Ok(rules)
}

/// Allowed `ioctl` requests: queries and flags of open files. A process with a device may send all requests except those that inject input into a terminal or
/// take over a terminal.
fn device_controls(needs: &[Need]) -> Result<Vec<SeccompRule>, BackendError> {
    let has_device = needs.iter().any(|need| {
        matches!(
            need,
            Need::Usb | Need::Camera | Need::Hid | Need::Serial { .. } | Need::Device { .. }
        )
    });
    if has_device {
        // All except injecting input into a terminal or taking one over.
        let denied = [libc::TIOCSTI, libc::TIOCLINUX, libc::TIOCSCTTY];
        let conditions: Result<Vec<_>, _> = denied
            .into_iter()
            .map(|request| {
                SeccompCondition::new(1, SeccompCmpArgLen::Dword, SeccompCmpOp::Ne, request)
            })
            .collect();
        return Ok(vec![rule(&conditions?)?]);
    }
    [libc::TCGETS, libc::FIONREAD, libc::FIONBIO, libc::FIOCLEX]
        .into_iter()
        .map(|request| rule(&[equal(1, request)?]))
        .collect()
}

/// Socket types that `needs` require.
fn sockets(needs: &[Need]) -> Result<Vec<SeccompRule>, BackendError> {
    // Flags occupy the bits above the four bits of the type.
    let kind = |family: i32, kind: i32| {
        rule(&[
            equal(0, u64::from(family.unsigned_abs()))?,
            masked(1, 0xF, kind)?,
        ])
    };
    let mut rules = Vec::new();
    for need in needs {
        match need {
            Need::Tcp { .. } | Need::Listen { .. } => {
                rules.push(kind(libc::AF_INET, libc::SOCK_STREAM)?);
                rules.push(kind(libc::AF_INET6, libc::SOCK_STREAM)?);
            }
            Need::Udp { .. } => {
                rules.push(kind(libc::AF_INET, libc::SOCK_DGRAM)?);
                rules.push(kind(libc::AF_INET6, libc::SOCK_DGRAM)?);
            }
            // The kernel reports USB hotplug events over netlink.
            Need::Usb => rules.push(rule(&[equal(
                0,
                u64::from(libc::AF_NETLINK.unsigned_abs()),
            )?])?),
            Need::Camera
            | Need::Hid
            | Need::Serial { .. }
            | Need::Device { .. }
            | Need::Read { .. } => {}
        }
    }
    Ok(rules)
}

fn any_of(argument: u8, values: &[i32]) -> Result<Vec<SeccompRule>, BackendError> {
    values
        .iter()
        .map(|value| rule(&[equal(argument, u64::from(value.unsigned_abs()))?]))
        .collect()
}

fn rule(conditions: &[SeccompCondition]) -> Result<SeccompRule, BackendError> {
    SeccompRule::new(conditions.to_vec())
}

/// Condition that the low 32 bits of system-call argument number `argument` equal `value`. The kernel reads only these bits.
fn equal(argument: u8, value: u64) -> Result<SeccompCondition, BackendError> {
    SeccompCondition::new(argument, SeccompCmpArgLen::Dword, SeccompCmpOp::Eq, value)
}

/// Condition that the bits under `mask` of system-call argument number `argument` equal `value`.
fn masked(argument: u8, mask: i32, value: i32) -> Result<SeccompCondition, BackendError> {
    let (mask, value) = (
        u64::from(mask.unsigned_abs()),
        u64::from(value.unsigned_abs()),
    );
    SeccompCondition::new(
        argument,
        SeccompCmpArgLen::Dword,
        SeccompCmpOp::MaskedEq(mask),
        value,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sockets_are_allowed_to_those_who_need_them_alone() {
        let need = |text: &str| [text.parse::<Need>().expect("a need")];
        let count = |needs: &[Need]| rules(needs).expect("sound").len();
        let bare = count(&[]);
        assert_eq!(count(&need("serial:/dev/ttyUSB0")), bare);
        assert_eq!(count(&need("tcp:10.0.0.1:502")), bare + 1 + SOCKETS.len());
        let listening = bare + 1 + SOCKETS.len() + LISTENING.len();
        assert_eq!(count(&need("listen:5025")), listening);
        assert_eq!(count(&need("read:/run/scale")), bare);
        assert!(!rules(&[]).expect("sound").contains_key(&SYS_socket));
    }

    #[test]
    fn no_call_that_starts_a_program_or_looks_into_another_process_is_on_the_list() {
        let rules = rules(&need_everything()).expect("sound");
        for call in [
            libc::SYS_execve,
            libc::SYS_execveat,
            libc::SYS_ptrace,
            libc::SYS_process_vm_readv,
            libc::SYS_process_vm_writev,
            libc::SYS_pidfd_open,
            libc::SYS_pidfd_getfd,
            libc::SYS_mount,
            libc::SYS_unshare,
            libc::SYS_setns,
            libc::SYS_memfd_create,
            libc::SYS_io_uring_setup,
            libc::SYS_bpf,
            libc::SYS_keyctl,
            libc::SYS_userfaultfd,
        ] {
            assert!(!rules.contains_key(&call), "{call}");
        }
    }

    fn need_everything() -> Vec<Need> {
        [
            "usb",
            "camera",
            "hid",
            "serial:/dev/ttyUSB*",
            "device:/dev/spidev0.0",
            "listen:5025",
            "read:/run/scale",
            "tcp:10.0.0.1:502",
            "udp:10.0.0.1:502",
        ]
        .map(|text| text.parse().expect("a need"))
        .to_vec()
    }
}
