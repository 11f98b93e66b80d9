//! Needs of tests, and their names.

use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::fmt;

/// Need of a test beyond a Rust toolchain and a Unix shell.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Need {
    /// Chromium on the path, to open pages.
    Browser,
    /// axe-core, found by node or named by `TACEVA_AXE`, to check the accessibility of a page.
    Axe,
    /// `pdflatex`, to set tables for papers.
    Latex,
    /// `strace`, to trace the writes of a program and to inject write errors.
    Strace,
    /// Permission to mount a disk in memory that only one program sees.
    Mount,
    /// A compiler of C, and make.
    CCompiler,
    /// A compiler of C++.
    CppCompiler,
    /// `clang`, a second C compiler, whose plugins must meet the same contracts.
    Clang,
    /// `script`, to run a program in a terminal.
    Terminal,
    /// `djpeg`, to get libjpeg's warnings about a picture.
    Libjpeg,
    /// `pdffonts` and `pdftotext` of Poppler, to read the content of a PDF.
    Poppler,
    /// Real recordings, in the folder named by `TACEVA_DATA`.
    Recordings,
    /// Public collection of HDF5 files that broke other readers, in the folder `cve_hdf5` below `TACEVA_DATA`.
    HostileHdf5,
    /// A GPU supported by the features of this build.
    Gpu,
    /// Python with the public clients of devices, and their fixed ports, to verify emulated devices.
    PublicClients,
    /// `ffmpeg`, to serve a stream of pictures and to decode clips.
    Ffmpeg,
    /// QEMU, a static busybox and a kernel with its modules: a virtual machine for devices that only a kernel can emulate.
    Kernel,
    /// Python with OctoPrint, whose virtual printer emulates Marlin.
    VirtualPrinter,
    /// Python with the libraries that read exports: `datasets`, h5py, pandas, Pillow, pyarrow.
    Libraries,
    /// Python with LeRobot and its torch (8 GB), which nothing here installs; `TACEVA_LEROBOT` names its interpreter.
    Lerobot,
    /// Permission to create device files that emulate cameras and scales.
    DeviceFiles,
    /// `slurmctld`, `slurmd`, `munged` and permission to start them: a cluster of two virtual nodes on loopback.
    Slurm,
    /// `faketime`, to run a program at another time of day.
    Faketime,
    /// A machine without other load, for limits of milliseconds. No test can detect other load, so `TACEVA_REQUIRE` must name this need.
    QuietMachine,
    /// An example program. Cargo builds it with a whole package, but not with a single test.
    Example,
}

/// `TACEVA_REQUIRE` names an unknown need.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownNeed(
    /// The unknown word.
    pub String,
);

impl Need {
    /// Every need.
    pub const ALL: [Need; 25] = [
        Need::Browser,
        Need::Axe,
        Need::Latex,
        Need::Strace,
        Need::Mount,
        Need::CCompiler,
        Need::CppCompiler,
        Need::Clang,
        Need::Terminal,
        Need::Libjpeg,
        Need::Poppler,
        Need::Recordings,
        Need::HostileHdf5,
        Need::Gpu,
        Need::PublicClients,
        Need::Ffmpeg,
        Need::Kernel,
        Need::VirtualPrinter,
        Need::Libraries,
        Need::Lerobot,
        Need::DeviceFiles,
        Need::Slurm,
        Need::Faketime,
        Need::QuietMachine,
        Need::Example,
    ];

    /// Word for the need in `TACEVA_REQUIRE` and in the list of skips.
    pub fn word(self) -> &'static str {
        match self {
            Need::Browser => "browser",
            Need::Axe => "axe",
            Need::Latex => "latex",
            Need::Strace => "strace",
            Need::Mount => "mount",
            Need::CCompiler => "c-compiler",
            Need::CppCompiler => "cpp-compiler",
            Need::Clang => "clang",
            Need::Terminal => "terminal",
            Need::Libjpeg => "libjpeg",
            Need::Poppler => "poppler",
            Need::Recordings => "recordings",
            Need::HostileHdf5 => "hostile-hdf5",
            Need::Gpu => "gpu",
            Need::PublicClients => "public-clients",
            Need::Ffmpeg => "ffmpeg",
            Need::Kernel => "kernel",
            Need::VirtualPrinter => "virtual-printer",
            Need::Libraries => "libraries",
            Need::Lerobot => "lerobot",
            Need::DeviceFiles => "device-files",
            Need::Slurm => "slurm",
            Need::Faketime => "faketime",
            Need::QuietMachine => "quiet-machine",
            Need::Example => "example",
        }
    }
}

impl fmt::Display for Need {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(self.word())
    }
}

impl fmt::Display for UnknownNeed {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let known = Need::ALL.map(Need::word).join(", ");
        write!(
            out,
            "TACEVA_REQUIRE names `{}`: expected words of {known}",
            self.0.escape_debug()
        )
    }
}

impl std::error::Error for UnknownNeed {}

/// Needs named in `TACEVA_REQUIRE`, separated by commas; empty without this variable.
///
/// # Errors
/// [`UnknownNeed`] for an unknown word, so that a misspelt need is noticed.
pub fn required(value: Option<&OsStr>) -> Result<BTreeSet<Need>, UnknownNeed> {
    let value = value.unwrap_or_default().to_string_lossy();
    let words = value.split(',').map(str::trim);
    words
        .filter(|word| !word.is_empty())
        .map(|word| {
            let known = Need::ALL.into_iter().find(|need| need.word() == word);
            known.ok_or_else(|| UnknownNeed(word.to_owned()))
        })
        .collect()
}
