//! Confinement of the child process before it reads a clip.

/// Restricts all threads to reading and writing open files, and to `memory` bytes of memory, on Linux. Does nothing on other systems.
#[cfg(not(target_os = "linux"))]
pub(super) fn confine(_memory: u64) -> Result<(), String> {
    Ok(())
}

#[cfg(target_os = "linux")]
pub(super) use linux::confine;

#[cfg(target_os = "linux")]
mod linux {
    use std::collections::BTreeMap;

    use rustix::process::{
        Resource, Rlimit, Signal, getpid, set_parent_process_death_signal, setrlimit,
    };
    use seccompiler::{
        BackendError, BpfProgram, SeccompAction, SeccompCmpArgLen, SeccompCmpOp, SeccompCondition,
        SeccompFilter, SeccompRule, TargetArch, apply_filter_all_threads,
    };

    /// System calls that are allowed with any arguments: for open files, memory, time and exit.
    const ALWAYS: [i64; 21] = [
        libc::SYS_brk,
        libc::SYS_clock_gettime,
        libc::SYS_close,
        libc::SYS_exit,
        libc::SYS_exit_group,
        libc::SYS_futex,
        libc::SYS_getpid,
        libc::SYS_getrandom,
        libc::SYS_gettid,
        libc::SYS_madvise,
        libc::SYS_mremap,
        libc::SYS_munmap,
        libc::SYS_read,
        libc::SYS_readv,
        libc::SYS_restart_syscall,
        libc::SYS_rt_sigprocmask,
        libc::SYS_rt_sigreturn,
        libc::SYS_sched_yield,
        libc::SYS_sigaltstack,
        libc::SYS_write,
        libc::SYS_writev,
    ];

    pub(in super::super) fn confine(memory: u64) -> Result<(), String> {
        // If the parent has already exited, the closed input ends the child too.
        set_parent_process_death_signal(Some(Signal::KILL))
            .map_err(|error| format!("cannot set the signal on exit of the parent: {error}"))?;
        for (resource, most, name) in [
            (Resource::As, memory, "memory"),
            (Resource::Fsize, 0, "the size of files"),
            (Resource::Core, 0, "core dumps"),
            (Resource::Nofile, 3, "open files"),
        ] {
            let limit = Rlimit {
                current: Some(most),
                maximum: Some(most),
            };
            setrlimit(resource, limit)
                .map_err(|error| format!("{name} cannot be limited: {error}"))?;
        }
        let filter =
            filter().map_err(|error| format!("system calls cannot be filtered: {error}"))?;
        apply_filter_all_threads(&filter)
            .map_err(|error| format!("system calls cannot be filtered: {error}"))
    }

    fn filter() -> Result<BpfProgram, BackendError> {
        let mut rules: BTreeMap<i64, Vec<SeccompRule>> =
            ALWAYS.iter().map(|call| (*call, Vec::new())).collect();
        // Memory must not become executable.
        let is_no_code = || -> Result<Vec<SeccompRule>, BackendError> {
            let executable = u64::from(libc::PROT_EXEC.unsigned_abs());
            let masked = SeccompCmpOp::MaskedEq(executable);
            Ok(vec![SeccompRule::new(vec![SeccompCondition::new(
                2,
                SeccompCmpArgLen::Dword,
                masked,
                0,
            )?])?])
        };
        rules.insert(libc::SYS_mmap, is_no_code()?);
        rules.insert(libc::SYS_mprotect, is_no_code()?);
        // A panic ends the process by a signal to itself.
        let own = u64::from(getpid().as_raw_nonzero().get().unsigned_abs());
        let to_itself = SeccompCondition::new(0, SeccompCmpArgLen::Dword, SeccompCmpOp::Eq, own)?;
        rules.insert(libc::SYS_tgkill, vec![SeccompRule::new(vec![to_itself])?]);
        rules.insert(libc::SYS_rt_sigaction, Vec::new());
        let denied = SeccompAction::Errno(libc::EPERM.unsigned_abs());
        let architecture = TargetArch::try_from(std::env::consts::ARCH)?;
        SeccompFilter::new(rules, denied, SeccompAction::Allow, architecture)?.try_into()
    }
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use std::fs::{self, File};
    use std::net::{TcpListener, UdpSocket};
    use std::path::Path;
    use std::process::Command;

    use super::confine;

    /// Environment variable with a folder for the confined process that the test starts.
    const CONFINED: &str = "TACEVA_VIDEO_CONFINED";

    #[test]
    fn a_confined_process_opens_nothing_starts_nothing_and_has_no_more_memory() {
        let Some(folder) = std::env::var_os(CONFINED) else {
            let folder = tempfile::tempdir().expect("a folder");
            let mut this = Command::new(std::env::current_exe().expect("a program"));
            let name = "av1::sandbox::tests::a_confined_process_opens_nothing_starts_nothing_and_has_no_more_memory";
            let output = this
                .args(["--exact", name, "--nocapture"])
                .env(CONFINED, folder.path())
                .output()
                .expect("starts");
            let said = String::from_utf8_lossy(&output.stdout).into_owned();
            assert!(
                output.status.success() && said.contains("1 passed"),
                "{said}{output:?}"
            );
            return;
        };
        let can = || {
            let huge = Vec::<u8>::new().try_reserve_exact(2 << 30).is_ok();
            let open = File::open("/dev/null").is_ok();
            let written = fs::write(Path::new(&folder).join("x"), "x").is_ok();
            let connected =
                TcpListener::bind("127.0.0.1:0").is_ok() || UdpSocket::bind("127.0.0.1:0").is_ok();
            let started = Command::new("/bin/true").spawn().is_ok();
            [huge, open, written, connected, started]
        };
        assert_eq!(can(), [true; 5], "before it is confined");
        confine(1 << 30).expect("confined");
        assert_eq!(can(), [false; 5]);
    }
}
