//! Checks the certificates of a rig file: compares them with the devices and with today's date, and searches for their files.

use std::fs::{self, File};
use std::io::{self, ErrorKind};
use std::path::Path;

use taceva_core::{Certificate, Instrument, shown};
use taceva_dataset::Digest;
use taceva_protocol::RigFile;

use super::check::RigCheck;
use super::problem::RigProblem;
use crate::instruments::{faults_today, kept, of_rig, remedy};

impl RigCheck {
    /// Compares the certificates of `rig` with the serial numbers in the settings and with today's date. Also searches for the files of the certificates.
    pub(super) fn look_at_certificates(&mut self, rig: &RigFile) {
        let instruments = kept(of_rig(rig), &self.settings);
        for fault in faults_today(&instruments) {
            let why = remedy(&fault);
            match fault.is_error() {
                true => self.problems.push(RigProblem::Certificate {
                    device: fault.instrument.name(),
                    why,
                }),
                false => self.warnings.push(why),
            }
        }
        let folder = Path::new(rig.name()).parent().unwrap_or(Path::new(""));
        for traced in &instruments {
            if let Some(certificate) = &traced.certificate {
                let found = file_problem(folder, traced.instrument, certificate);
                self.warnings.extend(found);
            }
        }
    }
}

/// Problem of the certificate's file in `folder`; `None` if the file agrees or the rig file names no certificate file.
fn file_problem(
    folder: &Path,
    instrument: Instrument,
    certificate: &Certificate,
) -> Option<String> {
    let name = certificate.file.as_ref()?;
    let path = folder.join(name);
    let opened = fs::metadata(&path).and_then(|found| match found.is_file() {
        true => File::open(&path),
        // Opening a FIFO would block, and a device may have no end.
        false => Err(io::Error::new(
            ErrorKind::InvalidInput,
            "not a regular file",
        )),
    });
    let digest = opened.and_then(|mut file| Digest::of_reader(&mut file));
    let digest = match digest {
        Ok(digest) => digest.to_string(),
        Err(error) => {
            let why = match error.kind() {
                ErrorKind::NotFound => "no such file".to_owned(),
                _ => error.to_string(),
            };
            return Some(format!(
                "[{instrument}.certificate]: `file` is `{}`, expected a file beside the rig file ({}: {why}); copy the file there, or correct the key",
                shown(name),
                shown(&path)
            ));
        }
    };
    let stated = certificate.sha256.as_ref()?.to_ascii_lowercase();
    let found = digest.trim_start_matches("sha256:");
    (found != stated).then(|| {
        format!(
            "[{instrument}.certificate]: `sha256` is `{stated}`, but {} has {found}: name the file of this certificate, or correct the key",
            shown(&path)
        )
    })
}

#[cfg(test)]
mod tests {
    use taceva_core::Coverage;

    use super::*;

    #[test]
    fn a_folder_or_a_device_in_place_of_a_certificates_file_is_a_warning_and_is_not_read() {
        let issued = "2026-05-12".parse().expect("a day");
        let coverage = Coverage::Factor(2.0);
        let mut certificate = Certificate::new("D-K-1", "a laboratory", issued, "42", coverage);
        for name in [".", "/dev/zero"] {
            certificate.file = Some(name.to_owned());
            let found = file_problem(Path::new(""), Instrument::Force, &certificate);
            let found = found.expect("a problem");
            assert!(found.contains("not a regular file"), "{found}");
        }
    }
}
