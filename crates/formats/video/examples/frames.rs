//! Prints the properties of a clip, and the time (in s) and luma digest of each frame.
//!
//! Arguments: `frames CLIP [--digests] [--ffmpeg PROGRAM] [--child PROGRAM]`.

use std::error::Error;
use std::io::Write;
use std::path::PathBuf;

use sha2::{Digest, Sha256};
use taceva_video::{Colours, Decoders, Picture, Video};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args_os().skip(1);
    let path = PathBuf::from(arguments.next().ok_or("which clip?")?);
    let mut decoders = Decoders::default();
    let mut has_digests = false;
    while let Some(option) = arguments.next() {
        let mut program = || arguments.next().ok_or("which program?");
        match option.to_str() {
            Some("--digests") => has_digests = true,
            Some("--ffmpeg") => decoders.ffmpeg = Some(program()?.into()),
            Some("--child") => decoders.av1 = Some(vec![program()?]),
            _ => return Err("expected --digests, --ffmpeg PROGRAM or --child PROGRAM".into()),
        }
    }
    let clip = Video::open(&path, &decoders)?;
    let info = clip.info();
    let mut out = std::io::stdout().lock();
    writeln!(
        out,
        "{} {} {} {}×{}, {} frames by {}",
        info.container,
        info.codec,
        info.pixel_format,
        info.width,
        info.height,
        info.frames,
        info.decoder.as_deref().unwrap_or("nobody"),
    )?;
    let all: Vec<u64> = (0..info.frames).collect();
    let mut bytes = 0;
    clip.visit(&all, Colours::Luma, &mut |index, picture| {
        let luma = match picture {
            Picture::Jpeg(bytes) => bytes,
            Picture::Pixels { samples, .. } => samples,
            Picture::Deep { samples, .. } => {
                samples.into_iter().flat_map(u16::to_le_bytes).collect()
            }
            other => return Err(std::io::Error::other(format!("{other:?}"))),
        };
        bytes += luma.len();
        if has_digests {
            let digest: String = Sha256::digest(&luma)
                .iter()
                .map(|byte| format!("{byte:02x}"))
                .collect();
            let times = info.times_s.as_ref().zip(usize::try_from(index).ok());
            let time_s = times.and_then(|(times, index)| times.get(index));
            writeln!(out, "{digest} {}", time_s.copied().unwrap_or(f64::NAN))?;
        }
        Ok(())
    })?;
    writeln!(out, "{bytes} bytes")?;
    if let Some(peak) = peak() {
        writeln!(out, "most memory:{peak}")?;
    }
    Ok(())
}

/// Peak memory of this process; `None` if the system does not report it.
fn peak() -> Option<String> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(line.trim_end().to_owned())
}
