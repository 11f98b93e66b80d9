//! The words for what a machine may lack.

use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::fmt;

/// What a test may need beside a Rust toolchain and a Unix shell.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Need {
    /// Chromium on the path, which pages are opened in.
    Browser,
    /// axe-core, found by node or named by `TACEVA_AXE`, which checks the accessibility of a page.
    Axe,
    /// `pdflatex`, which sets tables for papers.
    Latex,
    /// `strace`, which follows what a program writes and makes a disk refuse it.
    Strace,
    /// The right to mount a disk in memory that is seen by one program alone.
    Mount,
    /// A compiler of C, and make.
    CCompiler,
    /// A compiler of C++.
    CppCompiler,
    /// `clang`, a second compiler of C, whose plugins must keep the same contracts.
    Clang,
    /// `script`, which shows a program a terminal.
    Terminal,
    /// `djpeg`, which says what libjpeg warns of in a picture.
    Libjpeg,
    /// `pdffonts` and `pdftotext` of Poppler, which say what a PDF holds.
    Poppler,
    /// Real recordings, in the folder that `TACEVA_DATA` names.
    Recordings,
    /// The public collection of HDF5 files that broke other readers, in the folder `cve_hdf5` of the one that `TACEVA_DATA` names.
    HostileHdf5,
    /// A GPU that the features which were built in can reach.
    Gpu,
    /// Python with the public clients of devices, and ports that they expect: what proves that emulated devices speak as real ones.
    PublicClients,
    /// `ffmpeg`, which serves a stream of pictures and decodes clips.
    Ffmpeg,
    /// QEMU, a static busybox and a kernel with its modules: a virtual machine for devices that only a kernel can emulate.
    Kernel,
    /// Python with OctoPrint, whose virtual printer speaks as Marlin does.
    VirtualPrinter,
    /// Python with the libraries that exports are for: `datasets`, h5py, pandas, Pillow, pyarrow.
    Libraries,
    /// Python with LeRobot and its torch, 8 GB, which nothing installs here; who has one names its interpreter in `TACEVA_LEROBOT`.
    Lerobot,
    /// The right to make device files, which stand for cameras and scales that are not there.
    DeviceFiles,
    /// `slurmctld`, `slurmd`, `munged` and the right to start them: a cluster of two virtual nodes on loopback.
    Slurm,
    /// `faketime`, which shows a program another time of day.
    Faketime,
    /// A machine without other load, on which bounds of milliseconds hold. No test can find that out: it is named in `TACEVA_REQUIRE`.
    QuietMachine,
    /// An example that is built where a whole package is tested, and not by a single test of it.
    Example,
}

/// `TACEVA_REQUIRE` names something that no test needs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownNeed(
    /// The word that was found.
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

    /// The word for it, in `TACEVA_REQUIRE` and in the list.
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

/// The needs that the value of `TACEVA_REQUIRE` names: words with commas between them, none where it is not set.
///
/// # Errors
/// [`UnknownNeed`] for a word that stands for none: a misspelt need would not be required at all.
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
