//! Virtual machine that boots a Debian kernel and runs this program in it.

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::mpsc;
use std::time::{Duration, Instant};

use taceva_needs::{Need, skip};

use super::archive::Archive;
use super::modules;

/// Folder in which `.ci/install` unpacks Debian's kernel package.
const INSTALLED: &str = "../../target/kernel";
const QEMU: &str = "qemu-system-x86_64";
const BUSYBOX: &str = "/bin/busybox";
/// Kernel modules through which the virtual machine reads files of its host.
const FILES: [&str; 3] = ["virtio_pci", "9pnet_virtio", "9p"];
/// Longest run time of a machine with an emulated processor.
const PATIENCE: Duration = Duration::from_secs(400);
/// Start of the machine's last line.
const ENDED: &str = "the test ended with ";

struct Kernel {
    image: PathBuf,
    modules: PathBuf,
}

impl Kernel {
    /// Kernel in the folder named by `TACEVA_KERNEL`, or in the folder that `.ci/install` creates; `None` without a kernel.
    fn find() -> Option<Kernel> {
        let named = std::env::var_os("TACEVA_KERNEL").map(PathBuf::from);
        let folder = named.unwrap_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join(INSTALLED));
        let folder = fs::canonicalize(folder).ok()?;
        let only = |folder: PathBuf, prefix: &str| {
            let entries = fs::read_dir(folder).ok()?;
            let mut paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
            paths.find(|path| {
                path.file_name()
                    .is_some_and(|name| name.to_string_lossy().starts_with(prefix))
            })
        };
        let image = only(folder.join("boot"), "vmlinuz-")?;
        let modules = ["lib/modules", "usr/lib/modules"]
            .into_iter()
            .find_map(|path| only(folder.join(path), ""))?;
        Some(Kernel { image, modules })
    }
}

/// Runs the ignored test `name` of this program in a machine with the modules `wanted`; records a skip if no machine is available.
///
/// # Panics
/// If the test fails in the machine.
pub(crate) fn carry_out(name: &str, wanted: &[&str]) {
    let Some(kernel) = Kernel::find() else {
        return skip(
            Need::Kernel,
            "no kernel in target/kernel, and TACEVA_KERNEL names none",
        );
    };
    let qemu = Command::new(QEMU)
        .arg("--version")
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status();
    if !cfg!(target_arch = "x86_64") || !qemu.is_ok_and(|status| status.success()) {
        return skip(Need::Kernel, format!("no {QEMU} for this processor"));
    }
    let Ok(busybox) = fs::read(BUSYBOX) else {
        return skip(
            Need::Kernel,
            format!("no {BUSYBOX}, as busybox-static has it"),
        );
    };
    let folder = tempfile::tempdir().expect("a folder");
    let archive = folder.path().join("initial.cpio");
    fs::write(&archive, initial(&kernel, &busybox, name, wanted)).expect("room for an archive");
    let said = boot(&kernel, &archive);
    let whole = said.join("\n");
    let ended = said.iter().rev().find_map(|line| line.strip_prefix(ENDED));
    assert_eq!(ended, Some("0"), "in the machine:\n{whole}");
    // An unknown test name would succeed too.
    assert!(whole.contains("1 passed"), "in the machine:\n{whole}");
}

/// Archive with the initial files of the kernel. They load modules, mount the files of the host and run the test.
fn initial(kernel: &Kernel, busybox: &[u8], name: &str, wanted: &[&str]) -> Vec<u8> {
    let wanted = [&FILES[..], wanted].concat();
    let modules = modules::in_order(&kernel.modules, &wanted);
    let program = std::env::current_exe().expect("a test knows where it is");
    let program = fs::canonicalize(program).expect("it is there");
    let insert: String = modules
        .iter()
        .map(|(name, _)| format!("$b insmod /modules/{name}.ko\n"))
        .collect();
    let script = format!(
        "#!/bin/busybox sh
b=/bin/busybox
$b mkdir -p /proc /sys /dev /host
$b mount -t proc proc /proc
$b mount -t sysfs sys /sys
$b mount -t devtmpfs dev /dev
{insert}$b mount -t 9p -o trans=virtio,version=9p2000.L,ro,msize=262144,cache=loose host /host
for folder in proc sys dev; do $b mount --bind /$folder /host/$folder; done
$b mkdir -p /dev/shm
$b mount -t tmpfs shm /dev/shm
export TMPDIR=/dev/shm RUST_BACKTRACE=1
$b chroot /host '{program}' --ignored --exact '{name}' --nocapture --test-threads 1 2>&1
$b echo \"{ENDED}$?\"
$b poweroff -f
",
        program = program.display()
    );
    let mut archive = Archive::default();
    for folder in ["bin", "modules"] {
        archive.folder(folder);
    }
    archive.file("bin/busybox", busybox);
    for (name, bytes) in &modules {
        archive.file(&format!("modules/{name}.ko"), bytes);
    }
    archive.file("init", script.as_bytes());
    archive.finish()
}

/// Boots, and returns the output lines of the machine until it switches off.
fn boot(kernel: &Kernel, archive: &Path) -> Vec<String> {
    let files = "local,path=/,mount_tag=host,security_model=none,readonly=on,multidevs=remap";
    let mut machine = Command::new(QEMU)
        .args([
            "-machine",
            "q35,accel=tcg",
            "-cpu",
            "max",
            "-m",
            "1024",
            "-nographic",
            "-no-reboot",
            "-net",
            "none",
        ])
        .args(["-append", "console=ttyS0 quiet panic=-1", "-virtfs", files])
        .arg("-kernel")
        .arg(&kernel.image)
        .arg("-initrd")
        .arg(archive)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program that was just tried");
    let output = machine.stdout.take().expect("piped");
    let (sender, lines) = mpsc::channel();
    let reader = std::thread::spawn(move || {
        let mut output = BufReader::new(output);
        let mut line = Vec::new();
        while output
            .read_until(b'\n', &mut line)
            .is_ok_and(|count| count > 0)
        {
            let text = String::from_utf8_lossy(&line).trim_end().to_owned();
            line.clear();
            if sender.send(text).is_err() {
                break;
            }
        }
    });
    let began = Instant::now();
    let mut said = Vec::new();
    loop {
        match lines.recv_timeout(PATIENCE.saturating_sub(began.elapsed())) {
            Ok(line) => said.push(line),
            Err(mpsc::RecvTimeoutError::Disconnected) => break,
            Err(mpsc::RecvTimeoutError::Timeout) => {
                said.push(format!("the machine did not end within {PATIENCE:?}"));
                break;
            }
        }
    }
    // The machine has ended, or takes too long.
    let _ = machine.kill();
    let _ = machine.wait();
    reader.join().expect("no panic");
    said
}
